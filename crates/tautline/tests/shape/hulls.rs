//! Convex hulls: mass in any pose, and the frame.

use glam::{DMat3, DQuat, DVec3};
use proptest::prelude::*;
use tautline::mesh::{MassProperties, TriMesh, convex_hull, primitives};
use tautline::{Quat, Shape, Vec3};

use crate::{check_frame, close, close_matrix, particle_moments, scattered};

fn check_against(shape: &Shape, mesh: &TriMesh) {
    let expected = MassProperties::of(mesh, 1.0).unwrap();
    check_frame(shape);
    close(shape.volume(), expected.volume, 1e-6);
    let size = expected.center_of_mass.length() + f64::from(shape.reach());
    assert!(shape.center_of_mass().as_dvec3().distance(expected.center_of_mass) < 1e-6 * size);
    close_matrix(particle_moments(shape), expected.second_moments * (1.0 / expected.mass), 2e-6);
}

#[test]
fn regular_solids_keep_their_axes() {
    let solids = [
        primitives::tetrahedron(1.0),
        primitives::cube(1.0),
        primitives::octahedron(1.0),
        primitives::icosahedron(1.0),
        primitives::dodecahedron(1.0),
    ];
    for mesh in solids.map(Result::unwrap) {
        let shape = Shape::convex_hull(&mesh.positions).unwrap();
        assert_eq!(shape.principal_rotation(), Quat::IDENTITY);
        check_against(&shape, &mesh);
    }
}

#[test]
fn inside_points_do_not_matter() {
    let mut points = primitives::icosahedron(1.0).unwrap().positions;
    let bare = Shape::convex_hull(&points).unwrap();
    points.extend((0..100).map(|seed| scattered(seed) * 0.4));
    points.extend_from_within(..12);
    assert_eq!(Shape::convex_hull(&points).unwrap(), bare);
}

#[test]
fn a_turned_box_finds_its_axes() {
    let turn = Quat::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let offset = Vec3::new(3.0, -2.0, 1.0);
    let half = Vec3::new(3.0, 2.0, 1.0);
    let points: Vec<Vec3> =
        primitives::cuboid(half).unwrap().positions.iter().map(|&p| turn * p + offset).collect();
    let shape = Shape::convex_hull(&points).unwrap();
    check_frame(&shape);
    assert!(shape.center_of_mass().distance(offset) < 1e-6);
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        let found = shape.principal_rotation() * axis;
        assert!((found.dot(turn * axis).abs() - 1.0).abs() < 1e-6, "{axis}");
    }
    let turn = DMat3::from_quat(turn.as_dquat().normalize());
    let expected = turn * DMat3::from_diagonal(DVec3::new(9.0, 4.0, 1.0) / 3.0) * turn.transpose();
    close_matrix(particle_moments(&shape), expected, 1e-6);
}

fn points() -> impl Strategy<Value = Vec<Vec3>> {
    prop::collection::vec(prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from), 4..60)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_hulls_in_any_pose(
        points in points(),
        axis in prop::array::uniform3(-1.0..1.0_f64),
        far in 0.0_f32..1000.0,
    ) {
        let turn = DQuat::from_scaled_axis(DVec3::from(axis) * 3.0);
        let moved: Vec<Vec3> = points
            .iter()
            .map(|p| (turn * (p.as_dvec3() * DVec3::new(1.0, 0.3, 2.0))).as_vec3() + Vec3::Y * far)
            .collect();
        if let Ok(shape) = Shape::convex_hull(&moved) {
            check_against(&shape, &convex_hull(&moved).unwrap().mesh);
        }
    }
}
