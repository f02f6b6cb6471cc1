//! The features of contacts whose answer is known.

use tautline::geometry::distance::contact;
use tautline::geometry::epa::Epa;
use tautline::geometry::feature::{ContactFeatures, Feature};
use tautline::geometry::support::Points;
use tautline::{Quat, Vec3};

use crate::cases::{block_of, moved, turned};

fn touch(a: &[Vec3], b: &[Vec3]) -> ContactFeatures {
    let mut axis = Vec3::ZERO;
    let found = contact(&Points(a), &Points(b), &mut axis, &mut Epa::default());
    assert!(found.converged);
    let features = found.features.unwrap();
    assert_eq!(axis, features.normal);
    for (feature, points, point) in [(features.a, a, features.point_a), (features.b, b, features.point_b)] {
        let sum: Vec3 = feature.iter().map(|(i, weight)| points[i as usize] * weight).sum();
        assert!(sum.distance(point) < 1e-6, "{feature:?} is not at {point}");
        assert!((feature.weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
    }
    let apart = features.point_a - features.point_b - features.normal * features.depth;
    assert!(apart.length() < 1e-6, "{features:?}");
    features
}

/// Corners 2, 3, 6 and 7 are its top, at y = 0.
fn floor() -> Vec<Vec3> {
    moved(block_of(Vec3::new(2.0, 0.5, 2.0)), Vec3::NEG_Y * 0.5)
}

/// Corner 0 points down and is 0.1 deep in the floor, above (0.3, 0.4).
fn dart() -> Vec<Vec3> {
    let at = Vec3::new(0.3, -0.1, 0.4);
    let corners =
        [Vec3::ZERO, Vec3::new(-1.0, 2.0, -1.0), Vec3::new(1.0, 2.0, -1.0), Vec3::new(0.0, 2.0, 1.0)];
    corners.map(|p| p + at).to_vec()
}

/// A bar along `turn`·x with a sharp edge (0 and 1) on its lower side, at the origin.
fn roof(turn: Quat) -> Vec<Vec3> {
    let ends = [-1.0, 1.0].map(|x| [Vec3::new(x, 0.0, 0.0), Vec3::new(x, 1.0, 0.5), Vec3::new(x, 1.0, -0.5)]);
    let [[p, q, r], [s, t, u]] = ends;
    turned(vec![p, s, q, t, r, u], turn)
}

fn assert_near(found: Vec3, expected: Vec3) {
    assert!(found.distance(expected) < 1e-6, "{found} is not {expected}");
}

#[test]
fn a_vertex_on_a_face() {
    let found = touch(&dart(), &floor());
    assert_eq!(found.a.feature(), Feature::Vertex(0));
    let Feature::Face(corners) = found.b.feature() else { panic!("{found:?}") };
    assert!(corners.iter().all(|corner| [2, 3, 6, 7].contains(corner)), "{corners:?}");
    assert_near(found.point_a, Vec3::new(0.3, -0.1, 0.4));
    assert_near(found.point_b, Vec3::new(0.3, 0.0, 0.4));
    assert_near(found.normal, Vec3::NEG_Y);
    assert!((found.depth - 0.1).abs() < 1e-6);
}

#[test]
fn a_face_on_a_vertex() {
    let found = touch(&floor(), &dart());
    assert!(matches!(found.a.feature(), Feature::Face(_)));
    assert_eq!(found.b.feature(), Feature::Vertex(0));
    assert_near(found.normal, Vec3::Y);
}

#[test]
fn two_edges_across_each_other() {
    let upper = moved(roof(Quat::from_rotation_y(0.7)), Vec3::new(0.2, -0.05, 0.0));
    // Turned over: its sharp edge is on top.
    let lower = roof(Quat::from_rotation_x(std::f32::consts::PI));
    let found = touch(&upper, &lower);
    assert_eq!((found.a.feature(), found.b.feature()), (Feature::Edge([0, 1]), Feature::Edge([0, 1])));
    assert_near(found.point_a, Vec3::new(0.2, -0.05, 0.0));
    assert_near(found.point_b, Vec3::new(0.2, 0.0, 0.0));
    assert_near(found.normal, Vec3::NEG_Y);
    // λ along x from −1 to 1.
    assert!((found.b.weights[1] - 0.6).abs() < 1e-6);
}

#[test]
fn an_edge_flat_on_a_face() {
    let found = touch(&moved(roof(Quat::IDENTITY), Vec3::NEG_Y * 0.05), &floor());
    assert!(matches!(found.a.feature(), Feature::Vertex(0 | 1)), "{found:?}");
    assert!(matches!(found.b.feature(), Feature::Face(_)), "{found:?}");
    assert!((found.depth - 0.05).abs() < 1e-6);
}

#[test]
fn a_face_flat_on_a_face_becomes_a_vertex_or_crossing_edges_of_their_overlap() {
    for x in [0.0, 0.3, 1.9, 2.3] {
        let cube = moved(block_of(Vec3::splat(0.5)), Vec3::new(x, 0.49, 0.1));
        let found = touch(&cube, &floor());
        assert_near(found.normal, Vec3::NEG_Y);
        assert!((found.depth - 0.01).abs() < 1e-6);
        let kinds = (found.a.count, found.b.count);
        assert!(matches!(kinds, (1, 3) | (3, 1) | (2, 2)), "{kinds:?}");
    }
}

#[test]
fn parallel_sharp_edges_touch_in_a_point_of_their_overlap() {
    let upper = moved(roof(Quat::IDENTITY), Vec3::new(0.5, -0.05, 0.0));
    let lower = roof(Quat::from_rotation_x(std::f32::consts::PI));
    let found = touch(&upper, &lower);
    assert!((-0.5 - 1e-6..=1.0 + 1e-6).contains(&found.point_a.x), "{found:?}");
}

#[test]
fn crossing_segments_touch_without_depth() {
    let found = touch(&[Vec3::NEG_X, Vec3::X], &[Vec3::NEG_Z, Vec3::Z * 3.0]);
    assert_eq!((found.a.feature(), found.b.feature()), (Feature::Edge([0, 1]), Feature::Edge([0, 1])));
    assert_eq!(found.normal.abs(), Vec3::Y);
    assert_eq!(found.depth, 0.0);
}
