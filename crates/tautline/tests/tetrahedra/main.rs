//! Dividing closed surfaces into tetrahedra without touching the surface.

mod shapes;

use std::f32::consts::PI;
use std::time::Instant;

use glam::Vec3;
use proptest::prelude::*;
use shapes::*;
use tautline::mesh::{Tetrahedra, TriMesh, tetrahedralise};

fn divided(name: &str, mesh: &TriMesh) -> Tetrahedra {
    let start = Instant::now();
    let result = tetrahedralise(mesh).unwrap_or_else(|e| panic!("{name}: {e}"));
    let took = start.elapsed().as_secs_f64() * 1e3;
    let quality = result.quality();
    println!(
        "{name:24} {:6} triangles {:6} tetrahedra {:4} interior points  dihedral {:8.4}° to {:8.4}°, roundness {:.3} and {:.3} on the mean  {took:9.2} ms",
        mesh.triangles.len(),
        result.tetrahedra.len(),
        result.interior_points,
        quality.min_dihedral_angle.to_degrees(),
        quality.max_dihedral_angle.to_degrees(),
        quality.worst_roundness,
        quality.mean_roundness,
    );
    result.validate(mesh).unwrap_or_else(|e| panic!("{name}: {e}"));
    result
}

fn gallery() -> Vec<(&'static str, TriMesh)> {
    let straight = |_, _| true;
    let l = polygon(&[[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 3.], [0., 3.]]);
    let channel =
        polygon(&[[0., 0.], [3., 0.], [3., 2.], [2.9, 2.], [2.9, 0.1], [0.1, 0.1], [0.1, 2.], [0., 2.]]);
    let sheets = polygon(&[
        [0., 0.],
        [1.001, 0.],
        [1.001, 4.],
        [0.501, 4.],
        [0.501, 0.1],
        [0.5, 0.1],
        [0.5, 4.],
        [0., 4.],
    ]);
    let disc = regular(24);
    vec![
        ("cube", cube(0)),
        ("icosahedron", icosahedron()),
        ("icosphere 2", icosphere(2)),
        ("L", extrusion(&l, 1.0, 1, 0.0, straight)),
        ("L layered", extrusion(&l, 4.0, 6, 0.0, |k, i| (k + i) % 2 == 0)),
        ("channel", extrusion(&channel, 5.0, 1, 0.0, straight)),
        ("channel layered", extrusion(&channel, 5.0, 10, 0.0, |k, i| (k * i) % 3 == 0)),
        ("close sheets", extrusion(&sheets, 4.0, 4, 0.0, straight)),
        ("star prism", extrusion(&star(7, 0.4), 1.0, 1, 0.0, straight)),
        ("star screw", extrusion(&star(7, 0.4), 2.0, 8, 1.5, straight)),
        ("letter C", extrusion(&letter_c(20), 0.5, 1, 0.0, straight)),
        ("letter C layered", extrusion(&letter_c(40), 0.5, 4, 0.0, straight)),
        ("comb", extrusion(&comb(8), 1.0, 1, 0.0, straight)),
        ("plate", extrusion(&disc, 1e-3, 1, 0.0, straight)),
        ("plate layered", extrusion(&disc, 1e-3, 2, 0.0, |k, i| (k + i) % 2 == 0)),
        ("long twisted bar", extrusion(&regular(4), 10.0, 30, 6.0, straight)),
        ("torus 12x8", torus(12, 8, 0.3)),
        ("torus 40x20", torus(40, 20, 0.4)),
        ("trefoil 60x6", trefoil(60, 6, 0.3)),
        ("dented 2", dented(2)),
        ("dented 3", dented(3)),
        ("hollow 2", hollow(2)),
        ("box 4", subdivided_box(4, Vec3::ONE, 1)),
        ("box 8", subdivided_box(8, Vec3::new(1.0, 2.0, 3.0), 2)),
        ("thin box 8", subdivided_box(8, Vec3::new(1.0, 0.01, 1.0), 3)),
        ("spiky 1", spiky(1, 0.8, 1)),
        ("spiky 2", spiky(2, 0.5, 2)),
        ("spiky 3", spiky(3, 0.3, 3)),
        ("spiky 3 deep", spiky(3, 0.8, 4)),
    ]
}

#[test]
fn the_gallery_is_divided() {
    for (name, mesh) in gallery() {
        divided(name, &mesh);
    }
}

#[test]
fn large_meshes_are_divided() {
    divided("thin torus", &torus(60, 5, 0.03));
    divided("trefoil 2 400", &trefoil(150, 8, 0.35));
    divided("spiky 20 480", &spiky(5, 0.1, 1));
    for seed in 0..2 {
        divided("needles", &spiky(3, 0.95, seed));
    }
}

#[test]
fn strictly_convex_solids_need_no_interior_point() {
    for mesh in [icosahedron(), icosphere(1), icosphere(3)] {
        assert_eq!(divided("convex", &mesh).interior_points, 0);
    }
}

/// Flat sides are another matter: some ways to draw the cube's diagonals admit no tetrahedra without a
/// point inside, as they do for the prism.
#[test]
fn every_triangulation_of_the_cube_needs_one_point_at_most() {
    for diagonals in 0..64 {
        let result = divided("cube", &cube(diagonals));
        assert!(result.interior_points <= 1);
        assert!((result.volume() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn cube_has_its_surface_edges_and_one_diagonal() {
    let result = divided("cube", &cube(0b010101));
    assert_eq!(result.interior_points, 0);
    let edges = result.edges();
    assert!(edges.windows(2).all(|pair| pair[0] < pair[1]) && edges.iter().all(|[a, b]| a < b));
    // Kuhn's division: six tetrahedra around one main diagonal.
    assert_eq!((result.tetrahedra.len(), edges.len()), (6, 12 + 6 + 1));
}

/// Schönhardt, "Über die Zerlegung von Dreieckspolyedern in Tetraeder", 1928.
#[test]
fn schoenhardts_polyhedron_needs_one_point() {
    let schoenhardt = extrusion(&regular(3), 1.0, 1, PI / 6.0, |_, _| true);
    assert_eq!(divided("Schönhardt", &schoenhardt).interior_points, 1);
    let convex = extrusion(&regular(3), 1.0, 1, -PI / 6.0, |_, _| true);
    assert_eq!(divided("twisted the other way", &convex).interior_points, 0);
}

#[test]
fn the_quality_of_a_corner_of_the_cube_is_known() {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let corner = TriMesh { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] };
    let result = divided("corner", &corner);
    assert!((result.volume() - 1.0 / 6.0).abs() < 1e-12);
    // Between a coordinate plane and the slanted face: cos = 1/√3.
    assert!((result.min_dihedral_angle() - (1.0f64 / 3.0).sqrt().acos()).abs() < 1e-12);
}

#[test]
fn validation_notices_what_is_wrong() {
    let mesh = cube(0);
    let good = divided("cube", &mesh);
    let spoilt = |spoil: fn(&mut Tetrahedra)| {
        let mut bad = good.clone();
        spoil(&mut bad);
        bad.validate(&mesh).is_err()
    };
    assert!(spoilt(|t| t.tetrahedra[0].swap(0, 1)));
    assert!(spoilt(|t| t.tetrahedra.truncate(5)));
    assert!(spoilt(|t| t.tetrahedra.push(t.tetrahedra[0])));
    assert!(spoilt(|t| t.points[0].x += 0.1));
    assert!(spoilt(|t| t.interior_points = 1));
}

#[test]
fn the_same_mesh_gives_the_same_tetrahedra() {
    let mesh = trefoil(60, 6, 0.3);
    assert_eq!(tetrahedralise(&mesh), tetrahedralise(&mesh));
}

fn refusal(mesh: &TriMesh) -> String {
    tetrahedralise(mesh).expect_err("this is no solid").to_string()
}

#[test]
fn surfaces_that_enclose_nothing_are_refused() {
    assert_eq!(refusal(&TriMesh::default()), "mesh: it has no triangles");
    let spoilt = |spoil: fn(&mut TriMesh)| {
        let mut mesh = cube(0);
        spoil(&mut mesh);
        refusal(&mesh)
    };
    assert!(spoilt(|m| m.triangles.truncate(11)).contains("is open"));
    assert!(spoilt(|m| m.triangles[3].swap(0, 1)).contains("is flipped"));
    assert!(spoilt(|m| m.triangles.iter_mut().for_each(|t| t.swap(0, 1))).contains("counter-clockwise"));
    assert!(spoilt(|m| m.positions[2].y = f32::NAN).contains("vertex 2"));
    assert!(spoilt(|m| m.triangles[4][1] = 8).contains("names vertex 8"));
    assert!(spoilt(|m| m.positions.push(Vec3::ONE * 0.5)).contains("vertex 8 belongs to no triangle"));
    assert!(spoilt(|m| m.positions[7] = m.positions[6]).contains("degenerate"));
    assert!(spoilt(|m| m.positions.iter_mut().for_each(|p| p.z = 0.0)).contains("degenerate"));
}

#[test]
fn surfaces_that_cross_or_touch_themselves_are_refused_by_triangle() {
    let mut two = cube(0);
    let second = cube(0);
    two.triangles.extend(second.triangles.iter().map(|t| t.map(|v| v + 8)));
    let shifted = |by: Vec3| {
        let mut mesh = two.clone();
        mesh.positions.extend(second.positions.iter().map(|p| p + by));
        mesh
    };
    assert!(refusal(&shifted(Vec3::splat(0.5))).contains("cross or touch"));
    assert!(refusal(&shifted(Vec3::new(1.0, 0.25, 0.25))).contains("cross or touch"));
    assert!(refusal(&shifted(Vec3::ONE)).contains("vertices 7 and 8 are in the same place"));
    divided("two cubes", &shifted(Vec3::new(1.001, 0.25, 0.25)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn random_star_shaped_solids_are_divided(seed: u64, levels in 1u32..3, depth in 0.0f32..0.9) {
        let mesh = spiky(levels, depth, seed);
        let result = tetrahedralise(&mesh).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(result.validate(&mesh), Ok(()));
    }

    #[test]
    fn random_screws_are_divided(sides in 3u32..8, layers in 1u32..5, twist in -1.5f32..1.5, pattern: u32) {
        let diagonal = |k: u32, i: u32| pattern >> ((5 * k + i) % 32) & 1 == 0;
        let mesh = extrusion(&regular(sides), 2.0, layers, twist, diagonal);
        // Few sides turned far in one layer run through one another.
        if let Ok(result) = tetrahedralise(&mesh) {
            prop_assert_eq!(result.validate(&mesh), Ok(()));
        } else {
            prop_assert!(twist.abs() / layers as f32 > 0.5);
        }
    }

    /// Whatever the triangles, the answer comes and is a valid division or a refusal.
    #[test]
    fn moved_vertices_are_divided_or_refused(seed: u64, reach in 0.0f32..2.0) {
        let mut random = Random(seed);
        let mut mesh = icosphere(1);
        for p in &mut mesh.positions {
            *p += reach * (Vec3::new(random.unit(), random.unit(), random.unit()) - 0.5);
        }
        if let Ok(result) = tetrahedralise(&mesh) {
            prop_assert_eq!(result.validate(&mesh), Ok(()));
        }
    }
}
