//! The primitives: counts, closedness, orientation, symmetry, and the parameters they refuse.

use tautline::mesh::{HalfEdgeMesh, TriMesh, primitives as p};
use tautline::{Error, MeshDefect, Vec3};

fn solids() -> Vec<(&'static str, TriMesh, [usize; 3], isize)> {
    let named = |name, mesh: Result<TriMesh, Error>, counts, euler| (name, mesh.unwrap(), counts, euler);
    vec![
        named("tetrahedron", p::tetrahedron(0.7), [4, 6, 4], 2),
        named("cuboid", p::cuboid(Vec3::new(0.2, 1.0, 3.0)), [8, 18, 12], 2),
        named("cube", p::cube(0.5), [8, 18, 12], 2),
        named("octahedron", p::octahedron(2.0), [6, 12, 8], 2),
        named("icosahedron", p::icosahedron(0.3), [12, 30, 20], 2),
        named("dodecahedron", p::dodecahedron(0.3), [20, 54, 36], 2),
        named("uv_sphere", p::uv_sphere(1.0, 8, 5), [34, 96, 64], 2),
        named("uv_sphere, least", p::uv_sphere(1.0, 3, 2), [5, 9, 6], 2),
        named("icosphere", p::icosphere(1.5, 3), [642, 1920, 1280], 2),
        named("capsule", p::capsule(0.2, 0.5, 6, 2), [26, 72, 48], 2),
        named("cylinder", p::cylinder(0.2, 0.5, 7), [16, 42, 28], 2),
        named("torus", p::torus(1.0, 0.25, 9, 5), [45, 135, 90], 0),
    ]
}

#[test]
fn solids_are_closed_with_the_expected_counts_and_no_point_twice() {
    for (name, mesh, [vertices, edges, faces], euler) in solids() {
        let topology = HalfEdgeMesh::from_mesh(&mesh).unwrap();
        topology.require_closed().unwrap();
        let counts = [topology.vertex_count(), topology.edge_count(), topology.face_count()];
        assert_eq!(counts, [vertices, edges, faces], "{name}");
        assert_eq!(vertices as isize - edges as isize + faces as isize, euler, "{name}");
        let mut points: Vec<[u32; 3]> =
            mesh.positions.iter().map(|p| p.to_array().map(f32::to_bits)).collect();
        points.sort_unstable();
        points.dedup();
        assert_eq!(points.len(), vertices, "{name}");
    }
}

/// Around a point inside a convex solid every face turns outwards; the torus is checked against the centre of
/// its tube.
#[test]
fn faces_point_outwards() {
    for (name, mesh, _, euler) in solids() {
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|i| mesh.positions[i as usize].as_dvec3());
            let centroid = (a + b + c) / 3.0;
            let inside = if euler == 2 {
                centroid * 0.0
            } else {
                (centroid * glam::DVec3::new(1.0, 0.0, 1.0)).normalize()
            };
            assert!((b - a).cross(c - a).dot(centroid - inside) > 0.0, "{name} {corners:?}");
        }
    }
}

#[test]
fn opposite_corners_are_negatives_bit_for_bit() {
    for mesh in
        [p::icosahedron(0.3), p::dodecahedron(0.7), p::cube(1.1), p::octahedron(0.9), p::icosphere(0.37, 4)]
    {
        let positions = mesh.unwrap().positions;
        for v in &positions {
            assert!(positions.iter().any(|w| *w == -*v), "{v}");
        }
    }
}

#[test]
fn edges_and_radii_follow_the_closed_forms() {
    let golden = (1.0 + 5_f64.sqrt()) / 2.0;
    let icosahedron_edge = 1.0 / (0.4 * std::f64::consts::PI).sin();
    for (mesh, radius, edges) in [
        (p::tetrahedron(2.0), 2.0, vec![2.0 * (8.0_f64 / 3.0).sqrt()]),
        (p::octahedron(2.0), 2.0, vec![2.0 * 2_f64.sqrt()]),
        (p::icosahedron(2.0), 2.0, vec![2.0 * icosahedron_edge]),
        // The pentagons' diagonals are φ times their sides.
        (p::dodecahedron(2.0), 2.0, vec![4.0 / (3_f64.sqrt() * golden), 4.0 / 3_f64.sqrt()]),
        (p::cube(2.0), 3_f64.sqrt(), vec![2.0, 8_f64.sqrt()]),
    ] {
        let mesh = mesh.unwrap();
        for position in &mesh.positions {
            assert!((position.as_dvec3().length() - radius).abs() < 1e-6);
        }
        for [a, b] in HalfEdgeMesh::from_mesh(&mesh).unwrap().edges() {
            let length = (mesh.positions[a as usize] - mesh.positions[b as usize]).as_dvec3().length();
            assert!(edges.iter().any(|edge| (edge - length).abs() < 1e-6), "{length} {edges:?}");
        }
    }
}

#[test]
fn round_surfaces_have_their_vertices_on_the_surface() {
    let near = |distance: f32, radius: f32| assert!((distance - radius).abs() < 1e-6, "{distance} {radius}");
    for mesh in [p::uv_sphere(0.8, 12, 9), p::icosphere(0.8, 2)] {
        mesh.unwrap().positions.iter().for_each(|v| near(v.length(), 0.8));
    }
    for v in p::capsule(0.3, 0.5, 8, 4).unwrap().positions {
        near((v - Vec3::new(0.0, v.y.clamp(-0.5, 0.5), 0.0)).length(), 0.3);
    }
    for v in p::torus(1.0, 0.25, 16, 12).unwrap().positions {
        near((v - Vec3::new(v.x, 0.0, v.z).normalize()).length(), 0.25);
    }
    for v in p::cylinder(0.3, 0.5, 8).unwrap().positions {
        assert_eq!(v.y.abs(), 0.5);
        assert!(v.x == 0.0 && v.z == 0.0 || (v.x.hypot(v.z) - 0.3).abs() < 1e-6);
    }
}

#[test]
fn quarter_turns_are_exact() {
    let mesh = p::cylinder(1.0, 1.0, 8).unwrap();
    assert_eq!(mesh.positions[3], Vec3::new(0.0, -1.0, -1.0));
    assert_eq!(mesh.positions[5], Vec3::new(-1.0, -1.0, 0.0));
    assert_eq!(mesh.positions[2].x, -mesh.positions[2].z);
}

#[test]
fn grid_faces_up_row_by_row_with_parallel_diagonals() {
    let mesh = p::grid(4, 3, 3.0, 4.0).unwrap();
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (12, 12));
    for row in 0..3 {
        for column in 0..4 {
            let expected = Vec3::new(column as f32 - 1.5, 0.0, 2.0 * row as f32 - 2.0);
            assert_eq!(mesh.positions[row * 4 + column], expected);
        }
    }
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| mesh.positions[i as usize]);
        assert!((b - a).cross(c - a).y > 0.0);
    }
    let topology = HalfEdgeMesh::from_mesh(&mesh).unwrap();
    assert!(topology.edge_between(0, 5).is_some() && topology.edge_between(1, 4).is_none());
    assert_eq!(topology.boundary_loops().len(), 1);
    // Horizontal, vertical and diagonal edges.
    assert_eq!(topology.edge_count(), 3 * 3 + 4 * 2 + 3 * 2);
}

#[test]
fn polyline_is_even_and_includes_both_ends() {
    let (a, b) = (Vec3::new(-1.0, 2.0, 0.1), Vec3::new(1.0, 2.0, 0.7));
    let line = p::polyline(a, b, 51).unwrap();
    assert_eq!((line.len(), line[0], line[50]), (51, a, b));
    for pair in line.windows(2) {
        assert!((pair[1] - pair[0] - (b - a) / 50.0).length() < 1e-6);
    }
}

#[test]
fn bad_parameters_are_refused_by_name() {
    let field = |result: Result<TriMesh, Error>| match result.unwrap_err() {
        Error::OutOfRange { field, .. } => field,
        other => panic!("{other}"),
    };
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        for made in [p::tetrahedron(bad), p::octahedron(bad), p::icosahedron(bad), p::dodecahedron(bad)] {
            assert_eq!(field(made), "radius");
        }
        assert_eq!(field(p::cube(bad)), "side");
        assert_eq!(field(p::cuboid(Vec3::new(1.0, bad, 1.0))), "half_extents.y");
        assert_eq!(field(p::uv_sphere(bad, 8, 8)), "radius");
        assert_eq!(field(p::icosphere(bad, 1)), "radius");
        assert_eq!(field(p::capsule(1.0, bad, 8, 8)), "half_height");
        assert_eq!(field(p::cylinder(1.0, bad, 8)), "half_height");
        assert_eq!(field(p::torus(1.0, bad, 8, 8)), "minor_radius");
        assert_eq!(field(p::grid(8, 8, 1.0, bad)), "depth");
    }
    for bad in [0, 1, 1_000_000_000, u32::MAX] {
        assert_eq!(field(p::uv_sphere(1.0, bad, 8)), "segments");
        assert_eq!(field(p::uv_sphere(1.0, 8, bad)), "rings");
        assert_eq!(field(p::capsule(1.0, 1.0, 8, bad)), "rings");
        assert_eq!(field(p::cylinder(1.0, 1.0, bad)), "segments");
        assert_eq!(field(p::torus(1.0, 0.5, 8, bad)), "sides");
        assert_eq!(field(p::grid(8, bad, 1.0, 1.0)), "rows");
        let points = p::polyline(Vec3::ZERO, Vec3::X, bad);
        assert!(matches!(points, Err(Error::OutOfRange { field, .. }) if field == "points"));
    }
    assert_eq!(field(p::icosphere(1.0, 8)), "subdivisions");
    assert_eq!(field(p::torus(1.0, 1.0, 8, 8)), "minor_radius");
}

#[test]
fn sizes_that_f32_cannot_hold_are_refused() {
    assert!(matches!(p::uv_sphere(1e-44, 64, 32), Err(Error::Mesh(MeshDefect::DegenerateTriangle { .. }))));
    assert!(matches!(
        p::torus(f32::MAX, 0.9 * f32::MAX, 8, 8),
        Err(Error::Mesh(MeshDefect::NotFinite { .. }))
    ));
    assert!(matches!(p::polyline(Vec3::X, Vec3::X, 2), Err(Error::Invalid { .. })));
    assert!(matches!(p::polyline(Vec3::X, Vec3::X * (1.0 + 1e-6), 100), Err(Error::Invalid { .. })));
    assert!(
        matches!(p::polyline(Vec3::X, Vec3::NAN, 2), Err(Error::OutOfRange { field, .. }) if field == "b.x")
    );
}
