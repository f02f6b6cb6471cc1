//! A square frame on four feet, which something is stretched in.

use tautline::Vec3;

use crate::document::{AxisAngle, Color, Rigid, Rotation, Shape};

/// Four poles, with their middle lines `out` from the centre (m) and `height` above the floor (m), and four to stand on.
pub(super) fn square_frame(out: f32, height: f32, radius: f32, color: Color) -> Vec<Rigid> {
    let pole = |position: Vec3, length: f32, axis: Vec3| Rigid {
        shape: Shape::Capsule { radius, height: length, segments: None, rings: None },
        position: position.to_array(),
        rotation: Rotation::AxisAngle(AxisAngle { axis: axis.to_array(), degrees: 90.0 }),
        fixed: true,
        color: Some(color),
        ..Rigid::default()
    };
    let mut poles = Vec::new();
    for side in [-1.0, 1.0] {
        poles.push(pole(Vec3::new(0.0, height, side * out), 2.0 * out, Vec3::Z));
        poles.push(pole(Vec3::new(side * out, height, 0.0), 2.0 * out, Vec3::X));
        for other in [-1.0, 1.0] {
            let foot = Vec3::new(side * out, height / 2.0, other * out);
            poles.push(pole(foot, height - 2.0 * radius, Vec3::Y));
        }
    }
    poles
}
