//! Coarser hulls and surfaces, how far they are off, and fine points that go with coarse tetrahedra.

use tautline::geometry::distance::distance;
use tautline::mesh::{
    Embedding, HalfEdgeMesh, MassProperties, TriMesh, convex_hull, decimate, lattice, primitives,
    surface_deviation, tetrahedralise,
};
use tautline::{Error, Mat3, Vec3};

/// A ball with dents and bumps: smooth, closed and concave.
fn potato(subdivisions: u32) -> TriMesh {
    let mut mesh = primitives::icosphere(1.0, subdivisions).unwrap();
    for p in &mut mesh.positions {
        *p *= 1.0 + 0.2 * (3.0 * p.x).sin() * (4.0 * p.y).cos() + 0.1 * (5.0 * p.z).sin();
    }
    mesh
}

#[test]
fn the_error_of_a_coarse_hull_is_its_hausdorff_distance() {
    let hull = convex_hull(&primitives::icosphere(1.0, 3).unwrap().positions).unwrap();
    let mut last = f32::INFINITY;
    for corners in [4, 8, 16, 32, 64, 128] {
        let coarse = hull.coarsened(corners, 0.0).unwrap();
        let chosen = &coarse.hull.mesh.positions;
        assert!(chosen.len() <= corners);
        let outside = hull.mesh.positions.iter().map(|&p| distance(&[p], chosen).unwrap().distance);
        let farthest = outside.fold(0.0, f32::max);
        assert!((coarse.error - farthest).abs() < 1e-6, "{corners} corners: {} and {farthest}", coarse.error);
        for (position, &source) in chosen.iter().zip(&coarse.hull.sources) {
            assert_eq!(*position, primitives::icosphere(1.0, 3).unwrap().positions[source as usize]);
        }
        assert!(coarse.error < last);
        last = coarse.error;
    }
    // A ball of n corners about as good as can be is off by 2π/√27 · 2/n, about 2.4/n.
    assert!(last < 2.0 * 2.4 / 128.0, "{last}");
}

#[test]
fn a_tolerance_takes_as_many_corners_as_it_needs() {
    let hull = convex_hull(&primitives::icosphere(1.0, 3).unwrap().positions).unwrap();
    let coarse = hull.coarsened(usize::MAX, 0.05).unwrap();
    assert!(coarse.error <= 0.05);
    let fewer = hull.coarsened(coarse.hull.mesh.positions.len() - 1, 0.0).unwrap();
    assert!(fewer.error > 0.05, "one fewer would have done");
    assert_eq!(hull.coarsened(usize::MAX, 0.0).unwrap().hull.mesh.positions.len(), hull.mesh.positions.len());
    assert_eq!(hull.coarsened(usize::MAX, 1e9).unwrap().hull.mesh.positions.len(), 4);
    assert!(matches!(hull.coarsened(3, 0.0), Err(Error::OutOfRange { .. })));
    assert!(matches!(hull.coarsened(9, f32::NAN), Err(Error::OutOfRange { .. })));
}

#[test]
fn what_is_flat_loses_triangles_without_error() {
    let mut fine = primitives::grid(21, 21, 2.0, 2.0).unwrap();
    let coarse = decimate(&fine, 100).unwrap();
    assert!(coarse.error < 1e-6 && coarse.mesh.triangles.len() <= 2 * 100, "{}", coarse.error);
    // One vertex up: it is still there.
    fine.positions[220].y = 0.3;
    assert!(decimate(&fine, 200).unwrap().error < 0.05);
}

#[test]
fn a_closed_surface_stays_closed_and_close() {
    let fine = potato(4);
    let volume = |mesh: &TriMesh| MassProperties::of(mesh, 1.0).unwrap().volume;
    let mut last = 0.0;
    for triangles in [2000, 1000, 500, 250, 120] {
        let coarse = decimate(&fine, triangles).unwrap();
        let topology = HalfEdgeMesh::from_mesh(&coarse.mesh).unwrap();
        assert!(coarse.mesh.triangles.len() <= triangles, "{} of {triangles}", coarse.mesh.triangles.len());
        assert_eq!(
            topology.vertex_count() as i64 + 2 * 2,
            (coarse.mesh.triangles.len() / 2) as i64 + 2 + 4,
            "a sphere"
        );
        println!(
            "{triangles:5} triangles: {:.4} m off, volume {:.3} of {:.3}",
            coarse.error,
            volume(&coarse.mesh),
            volume(&fine)
        );
        assert!(
            coarse.error > last && coarse.error < 16.0 / triangles as f32,
            "{triangles}: {}",
            coarse.error
        );
        assert!((volume(&coarse.mesh) / volume(&fine) - 1.0).abs() < 0.06);
        last = coarse.error;
    }
}

#[test]
fn deviation_is_that_of_concentric_spheres() {
    let [inner, outer] = [1.0, 1.25].map(|radius| primitives::icosphere(radius, 3).unwrap());
    assert!((surface_deviation(&inner, &outer) - 0.25).abs() < 0.01);
    assert!(surface_deviation(&inner, &inner) < 1e-9);
}

#[test]
fn embedded_points_follow_any_affine_map_also_outside() {
    let solid = lattice(Vec3::splat(1.0), [3, 2, 4]).unwrap();
    let points: Vec<Vec3> = potato(2).positions.iter().map(|&p| p * 0.95).collect();
    let embedding = Embedding::new(&solid, &points).unwrap();
    assert!(embedding.farthest_outside() > 0.0);
    let map = Mat3::from_cols(Vec3::new(1.1, 0.2, 0.0), Vec3::new(-0.3, 0.9, 0.1), Vec3::new(0.0, 0.4, 1.3));
    let place = |p: Vec3| map * p + Vec3::new(3.0, -2.0, 1.0);
    let corners: Vec<Vec3> = solid.points.iter().map(|&p| place(p)).collect();
    for (found, &point) in embedding.positions(&corners).iter().zip(&points) {
        assert!(found.distance(place(point)) < 1e-5, "{found} is not {}", place(point));
    }
}

#[test]
fn a_fine_surface_goes_with_a_coarse_solid() {
    let fine = potato(4);
    let coarse = decimate(&fine, 200).unwrap();
    let solid = tetrahedralise(&coarse.mesh).unwrap();
    let embedding = Embedding::new(&solid, &fine.positions).unwrap();
    assert!(embedding.farthest_outside() <= coarse.error + 1e-6);
    for (found, point) in embedding.positions(&solid.points).iter().zip(&fine.positions) {
        assert!(found.distance(*point) < 1e-5);
    }
}

#[test]
fn bad_input_is_refused_by_name() {
    let field = |error: Error| match error {
        Error::OutOfRange { field, .. } => field,
        other => other.to_string(),
    };
    let solid = lattice(Vec3::splat(1.0), [1, 1, 1]).unwrap();
    let bad = [Vec3::ZERO, Vec3::new(0.0, f32::NAN, 0.0)];
    assert_eq!(field(Embedding::new(&solid, &bad).unwrap_err()), "points[1].y");
    let mut wild = solid.clone();
    wild.tetrahedra[2][1] = 99;
    assert_eq!(field(Embedding::new(&wild, &[]).unwrap_err()), "solid.tetrahedra[2]");
    wild.tetrahedra.clear();
    assert!(matches!(Embedding::new(&wild, &[]), Err(Error::Mesh(_))));
    let mut open = potato(1);
    open.positions[3].z = f32::INFINITY;
    assert_eq!(field(decimate(&open, 10).unwrap_err()), "positions[3].z");
    open = potato(1);
    open.triangles[0] = [0, 0, 1];
    assert!(matches!(decimate(&open, 10), Err(Error::Mesh(_))));
}
