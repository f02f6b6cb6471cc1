//! Face on face.

use std::f32::consts::{FRAC_PI_4, TAU};

use glam::{Quat, Vec3};

use super::shapes::*;
use super::*;

fn above(height: f32, turn: f32, offset: Vec3) -> Placement {
    placed(Quat::from_rotation_y(turn), Vec3::Y * height + offset)
}

#[test]
fn stacked_boxes_touch_at_the_corners() {
    let (lower, upper) = (cuboid(Vec3::new(1.0, 0.5, 1.0)), cuboid(Vec3::new(0.5, 0.25, 0.5)));
    for gap in [-0.002, 0.0, 0.01] {
        let manifold = collide_new(&lower, &upper, &above(0.75 + gap, 0.3, Vec3::X * 0.2), 0.02);
        assert_eq!((manifold.count, manifold.normal), (4, Vec3::Y));
        assert!((manifold.area() - 1.0).abs() < 1e-5, "{}", manifold.area());
        for point in manifold.used() {
            assert!((point.separation - gap).abs() < 1e-6);
            assert!((point.on_b.abs() - Vec3::new(0.5, 0.25, 0.5)).length() < 1e-6, "{point:?}");
            assert!((point.on_a.y - 0.5).abs() < 1e-6);
        }
    }
}

#[test]
fn the_overlap_of_two_faces_is_covered() {
    let cube = cuboid(Vec3::splat(0.5));
    let offset = Vec3::new(0.6, 0.0, 0.3);
    let manifold = collide_new(&cube, &cube, &above(0.999, 0.0, offset), 0.02);
    assert!((manifold.area() - 0.4 * 0.7).abs() < 1e-5, "{manifold:?}");
    // An octagon: the inscribed square through every second corner is the largest quadrilateral.
    let octagon = 2.0 * (2.0_f32.sqrt() - 1.0);
    let manifold = collide_new(&cube, &cube, &above(0.999, FRAC_PI_4, Vec3::ZERO), 0.02);
    let radius_squared = octagon / (2.0 * 2.0_f32.sqrt());
    assert!((manifold.area() - 2.0 * radius_squared).abs() < 1e-3, "{manifold:?}");
    // Faces with many corners.
    let disc = prism(32, 0.5, 0.1);
    let manifold = collide_new(&disc, &disc, &above(0.199, 0.05, Vec3::ZERO), 0.02);
    assert!(manifold.count == 4 && manifold.area() > 0.48, "{}", manifold.area());
}

#[test]
fn a_tilted_box_keeps_the_points_within_the_margin() {
    let cube = cuboid(Vec3::splat(0.5));
    let tilt = Quat::from_rotation_z(0.03);
    // Its lower edge is on the face, the other 3 cm above.
    let height = 0.5 + 0.5 * (0.03_f32 + 1.0 - 0.00045);
    let narrow = collide_new(&cube, &cube, &placed(tilt, Vec3::Y * height), 0.02);
    let wide = collide_new(&cube, &cube, &placed(tilt, Vec3::Y * height), 0.05);
    assert_eq!((narrow.count, wide.count), (2, 4), "{narrow:?}\n{wide:?}");
    assert!(narrow.used().iter().all(|point| point.separation.abs() < 1e-3));
}

#[test]
fn keys_stay_while_the_features_stay() {
    let shapes = [cuboid(Vec3::splat(0.5)), icosahedron(0.6), prism(12, 0.5, 0.3), tetrahedron(0.4)];
    let mut random = Random(11);
    for shape in &shapes {
        for _ in 0..50 {
            let face = shape.faces[random.below(shape.faces.len())];
            let turn = Quat::from_axis_angle(face.normal, random.signed() * 3.0)
                * Quat::from_rotation_arc(shape.faces[0].normal, -face.normal);
            let at = face.normal * (face.offset + shape.faces[0].offset - 0.001);
            let mut memory = Memory::default();
            let first = collide_with(shape, shape, &placed(turn, at), &mut memory, 0.02);
            assert!(first.count >= 3, "{first:?}");
            for _ in 0..5 {
                let stir = Quat::from_scaled_axis(random.vector() * 1e-5);
                let moved = placed(stir * turn, at + random.vector() * 1e-5);
                let again = collide_with(shape, shape, &moved, &mut memory, 0.02);
                assert_eq!(again.keys(), first.keys(), "{first:?}\n{again:?}");
            }
        }
    }
}

#[test]
fn a_fall_down_all_orientations_never_turns_the_normal_inside_out() {
    // Dropped a little deeper each call, past coincidence of the faces, with memory.
    let cube = cuboid(Vec3::splat(0.5));
    let mut memory = Memory::default();
    for step in 0..60 {
        let depth = step as f32 * 0.002 - 0.02;
        let turn = Quat::from_rotation_y(step as f32 * TAU / 60.0);
        let manifold = collide_with(&cube, &cube, &placed(turn, Vec3::Y * (1.0 - depth)), &mut memory, 0.03);
        assert_eq!(manifold.count, 4);
        assert!(manifold.normal.y > 0.999 && (manifold.deepest() + depth).abs() < 1e-5);
    }
}
