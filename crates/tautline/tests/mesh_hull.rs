//! The convex hull against exact predicates and known shapes.

use proptest::prelude::*;
use robust::{Coord3D, orient3d};
use tautline::mesh::{ConvexHull, HalfEdgeMesh, convex_hull, primitives};
use tautline::{Error, MeshDefect, Vec3};

fn coord(p: Vec3) -> Coord3D<f64> {
    Coord3D { x: p.x.into(), y: p.y.into(), z: p.z.into() }
}

/// Whether p is strictly outside the plane of a triangle; exact.
fn is_above([a, b, c]: [Vec3; 3], p: Vec3) -> bool {
    orient3d(coord(a), coord(b), coord(c), coord(p)) < 0.0
}

/// Closed, spherical, made of input points and around all of them; no vertex but corners.
fn check(points: &[Vec3]) -> ConvexHull {
    let hull = convex_hull(points).unwrap();
    let topology = HalfEdgeMesh::from_mesh(&hull.mesh).unwrap();
    topology.validate().unwrap();
    topology.require_closed().unwrap();
    assert_eq!(topology.vertex_count() + topology.face_count(), topology.edge_count() + 2);
    assert!(hull.sources.is_sorted_by(|a, b| a < b));
    for (&source, position) in hull.sources.iter().zip(&hull.mesh.positions) {
        assert_eq!(points[source as usize], *position);
        assert_eq!(points.iter().position(|point| point == position), Some(source as usize));
    }
    for corners in &hull.mesh.triangles {
        let face = corners.map(|i| hull.mesh.positions[i as usize]);
        assert!(!points.iter().any(|&point| is_above(face, point)));
    }
    for vertex in topology.vertices() {
        // Without a corner the hull of the rest does not contain it.
        let rest: Vec<Vec3> = (hull.mesh.positions.iter().zip(0..))
            .filter(|&(_, other)| other != vertex)
            .map(|(&position, _)| position)
            .collect();
        let corner = hull.mesh.positions[vertex as usize];
        let outside = convex_hull(&rest).map(|smaller| {
            let mesh = smaller.mesh;
            mesh.triangles.iter().any(|corners| is_above(corners.map(|i| mesh.positions[i as usize]), corner))
        });
        assert!(outside.unwrap_or(true), "{corner} is no corner");
    }
    hull
}

fn points(coordinate: impl Strategy<Value = f32> + Clone, most: usize) -> impl Strategy<Value = Vec<Vec3>> {
    let point = [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from);
    prop::collection::vec(point, 4..most)
}

/// All in one plane, exactly, by brute force over triples through the first.
fn is_flat(points: &[Vec3]) -> bool {
    let at = |i: usize| coord(points[i]);
    let n = points.len();
    (1..n).all(|i| (1..i).all(|j| (1..j).all(|k| orient3d(at(0), at(i), at(j), at(k)) == 0.0)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn points_at_random(points in points(-1.0_f32..1.0, 60)) {
        check(&points);
    }

    #[test]
    fn points_a_kilometre_away(points in points(999.0_f32..1000.0, 40)) {
        check(&points);
    }

    /// A thousandth of a millimetre thick: at that place f32 holds only a dozen distinct heights.
    #[test]
    fn slivers(points in points(-1.0_f32..1.0, 40)) {
        let flattened: Vec<Vec3> = points.iter().map(|p| Vec3::new(p.x, 1.0 + 1e-6 * p.y, p.z)).collect();
        if !is_flat(&flattened) {
            check(&flattened);
        }
    }

    /// Few lattice places: duplicates, points in line, coplanar facets, points within edges and faces.
    #[test]
    fn lattices(points in points((-1_i8..2).prop_map(f32::from), 40)) {
        match convex_hull(&points) {
            Ok(_) => { check(&points); }
            Err(error) => {
                prop_assert_eq!(error, MeshDefect::Flat { count: points.len() }.into());
                prop_assert!(is_flat(&points));
            }
        }
    }

    #[test]
    fn coordinates_of_any_size(points in points((-1.0_f32..1.0, -30_i32..30).prop_map(|(x, e)| x * 10_f32.powi(e)), 30)) {
        check(&points);
    }

    /// The order of the points does not change which of them are corners.
    #[test]
    fn order_changes_no_corner(points in points((-3_i8..4).prop_map(f32::from), 40), seed in any::<u64>()) {
        let Ok(hull) = convex_hull(&points) else { return Ok(()) };
        let mut shuffled = points.clone();
        let mut state = seed;
        for i in (1..shuffled.len()).rev() {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            shuffled.swap(i, (state >> 33) as usize % (i + 1));
        }
        let key = |hull: ConvexHull| {
            let mut corners: Vec<[i8; 3]> = hull.mesh.positions.iter().map(|p| p.to_array().map(|x| x as i8)).collect();
            corners.sort_unstable();
            corners
        };
        prop_assert_eq!(key(hull), key(convex_hull(&shuffled).unwrap()));
    }
}

#[test]
fn a_lattice_cube_keeps_its_eight_corners() {
    let lattice: Vec<Vec3> =
        (0..343).map(|i| Vec3::new((i % 7) as f32, (i / 7 % 7) as f32, (i / 49) as f32)).collect();
    let hull = check(&lattice);
    assert_eq!((hull.mesh.positions.len(), hull.mesh.triangles.len()), (8, 12));
    assert_eq!(hull.sources, [0, 6, 42, 48, 294, 300, 336, 342]);
}

#[test]
fn convex_primitives_are_their_own_hulls() {
    for mesh in [
        primitives::icosahedron(0.3),
        primitives::cube(1.0),
        primitives::octahedron(2.0),
        primitives::icosphere(1.0, 2),
    ] {
        let mesh = mesh.unwrap();
        let hull = check(&mesh.positions);
        assert_eq!(hull.mesh.positions, mesh.positions);
        assert_eq!(hull.mesh.triangles.len(), mesh.triangles.len());
    }
}

#[test]
fn twice_the_same_points_give_the_same_bits() {
    let sphere = primitives::uv_sphere(1.0, 24, 16).unwrap().positions;
    assert_eq!(convex_hull(&sphere).unwrap(), convex_hull(&sphere).unwrap());
}

#[test]
fn points_without_volume_are_refused() {
    let flat = |points: &[Vec3]| {
        assert_eq!(convex_hull(points), Err(MeshDefect::Flat { count: points.len() }.into()))
    };
    flat(&[]);
    flat(&[Vec3::X, Vec3::Y, Vec3::Z]);
    flat(&[Vec3::splat(0.1); 9]);
    flat(&(0..9).map(|i| Vec3::splat(i as f32)).collect::<Vec<_>>());
    flat(&primitives::grid(5, 5, 1.0, 1.0).unwrap().positions);
}

#[test]
fn a_point_that_is_not_finite_is_named() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut points = primitives::cube(1.0).unwrap().positions;
        points[5].z = bad;
        assert_eq!(convex_hull(&points), Err(Error::Mesh(MeshDefect::NotFinite { vertex: 5 })));
    }
}
