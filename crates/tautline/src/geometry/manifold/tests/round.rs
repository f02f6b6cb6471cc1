//! Spheres and capsules, against closed forms.

use glam::{Quat, Vec3};

use super::shapes::*;
use super::*;

fn is_near(a: f32, b: f32, scale: f32) -> bool {
    (a - b).abs() <= 1e-5 * scale
}

#[test]
fn balls_are_exact_at_any_size() {
    let mut random = Random(21);
    for scale in [1e-3, 0.1, 1.0, 100.0] {
        for _ in 0..200 {
            let (r, s) = (random.between(0.2, 1.0) * scale, random.between(0.2, 1.0) * scale);
            let direction = random.direction();
            let distance = (r + s) * random.between(0.05, 1.2);
            let b_in_a = placed(random.rotation(), direction * distance);
            let manifold = collide_new(&ball(r), &ball(s), &b_in_a, scale);
            assert_eq!(manifold.count, 1);
            let point = manifold.points[0];
            assert!((manifold.normal - direction).length() < 1e-5);
            assert!(is_near(point.separation, distance - r - s, scale));
            assert!((point.on_a - direction * r).length() < 1e-5 * scale);
            assert!((b_in_a.point(point.on_b) - direction * (distance - s)).length() < 1e-5 * scale);
        }
    }
}

#[test]
fn a_ball_finds_the_face_edge_and_corner_of_a_box() {
    let (cube, ball) = (cuboid(Vec3::splat(1.0)), ball(0.5));
    let mut random = Random(22);
    for _ in 0..2000 {
        // Over the part of the surface where coordinates within the box stay.
        let center =
            Vec3::new(random.between(-1.6, 1.6), random.between(-1.6, 1.6), random.between(-1.6, 1.6));
        let nearest = center.clamp(Vec3::NEG_ONE, Vec3::ONE);
        let offset = center - nearest;
        let distance = offset.length();
        if distance < 1e-2 || distance > 0.6 {
            continue;
        }
        let manifold = collide_new(&cube, &ball, &placed(random.rotation(), center), 0.2);
        assert_eq!(manifold.count, 1);
        assert!((manifold.normal - offset / distance).length() < 2e-4, "{manifold:?} {offset}");
        assert!(is_near(manifold.points[0].separation, distance - 0.5, 1.0));
        assert!((manifold.points[0].on_a - nearest).length() < 2e-4, "{manifold:?} {nearest}");
    }
}

#[test]
fn a_ball_deep_in_a_box_leaves_by_the_nearest_face() {
    let (cuboid, ball) = (cuboid(Vec3::new(1.0, 0.5, 0.8)), ball(0.2));
    let manifold = collide_new(&cuboid, &ball, &placed(Quat::IDENTITY, Vec3::new(0.4, 0.3, -0.2)), 0.0);
    assert!((manifold.normal - Vec3::Y).length() < 1e-6 && is_near(manifold.points[0].separation, -0.4, 1.0));
}

#[test]
fn crossed_capsules_touch_once_and_parallel_ones_twice() {
    let capsule = capsule(0.2, 0.5);
    let crossed = placed(Quat::from_rotation_x(1.2), Vec3::new(0.39, 0.1, 0.0));
    let manifold = collide_new(&capsule, &capsule, &crossed, 0.05);
    assert!(manifold.count == 1 && is_near(manifold.deepest(), -0.01, 1.0));
    assert!((manifold.points[0].on_a - Vec3::new(0.2, 0.1, 0.0)).length() < 1e-5);

    let beside = placed(Quat::from_rotation_x(0.01), Vec3::new(0.39, 0.6, 0.0));
    let manifold = collide_new(&capsule, &capsule, &beside, 0.05);
    assert_eq!(manifold.count, 2);
    let mut heights = [manifold.points[0].on_a.y, manifold.points[1].on_a.y];
    heights.sort_by(f32::total_cmp);
    assert!((heights[0] - 0.1).abs() < 1e-3 && (heights[1] - 0.5).abs() < 1e-5, "{heights:?}");

    let coincident = collide_new(&capsule, &capsule, &placed(Quat::IDENTITY, Vec3::ZERO), 0.05);
    assert!(is_near(coincident.deepest(), -0.4, 1.0) && coincident.normal.y.abs() < 1e-5, "{coincident:?}");
}

#[test]
fn a_lying_capsule_rests_on_two_points() {
    let (table, capsule) = (cuboid(Vec3::new(1.0, 0.1, 1.0)), capsule(0.2, 0.5));
    let lying = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
    let manifold = collide_new(&table, &capsule, &placed(lying, Vec3::new(0.0, 0.299, 0.0)), 0.02);
    assert_eq!((manifold.count, manifold.normal), (2, Vec3::Y));
    assert!(
        manifold
            .used()
            .iter()
            .all(|p| is_near(p.separation, -0.001, 1.0) && is_near(p.on_a.x.abs(), 0.5, 1.0))
    );

    let over_the_edge = placed(lying, Vec3::new(0.8, 0.299, 0.0));
    let manifold = collide_new(&table, &capsule, &over_the_edge, 0.02);
    let reach = manifold.used().iter().map(|p| p.on_a.x).fold(f32::NEG_INFINITY, f32::max);
    assert!(manifold.count == 2 && is_near(reach, 1.0, 1.0), "{manifold:?}");
}
