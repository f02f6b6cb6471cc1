//! The angular constraint between the two triangles that share an edge (paper, 4; for cloth).

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::AngleLimit;
use crate::norm::Norm;

/// The dihedral angle at an edge: 0 = flat, positive when the surface folds towards its normals (a valley).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bending {
    /// The edge's ends, counted within the body, as the first triangle runs along it.
    pub edge: [u32; 2],
    /// The corner opposite the edge in the first and in the second triangle.
    pub wings: [u32; 2],
    /// Target or range, in rad, −π to π.
    pub limit: AngleLimit,
    /// α, in rad/(N·m): 0 = rigid.
    pub compliance: f32,
}

/// θ in (−π, π] and its gradients, in rad/m, for wing 0, wing 1, edge start and edge end.
///
/// The gradients are the bending mode of Bridson, Marino and Fedkiw (2003, section 4), which is the gradient of
/// the dihedral angle. `None` if a triangle has no area.
pub(crate) fn gradient(wings: [Vec3; 2], edge: [Vec3; 2]) -> Option<(f32, [Vec3; 4])> {
    let along = edge[1] - edge[0];
    let normal_0 = (wings[0] - edge[0]).cross(wings[0] - edge[1]);
    let normal_1 = (wings[1] - edge[1]).cross(wings[1] - edge[0]);
    let (squared_0, squared_1) = (normal_0.length_squared(), normal_1.length_squared());
    let length = along.norm();
    if squared_0 < 1e-24 || squared_1 < 1e-24 || length < 1e-10 {
        return None;
    }
    let direction = along / length;
    let angle = libm::atan2f(normal_1.cross(normal_0).dot(direction), normal_0.dot(normal_1));
    let (n0, n1) = (normal_0 / squared_0, normal_1 / squared_1);
    let part = |wing: Vec3, end: Vec3| (wing - end).dot(direction);
    let start = n0 * part(wings[0], edge[1]) + n1 * part(wings[1], edge[1]);
    let end = -(n0 * part(wings[0], edge[0]) + n1 * part(wings[1], edge[0]));
    Some((angle, [n0 * length, n1 * length, start, end]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_agree_with_finite_differences_and_move_nothing_as_a_whole() {
        let points = [
            Vec3::new(0.1, 0.4, 1.0),
            Vec3::new(-0.2, 0.3, -0.9),
            Vec3::new(-0.5, 0.1, 0.1),
            Vec3::new(0.6, -0.1, 0.0),
        ];
        let evaluate = |p: [Vec3; 4]| gradient([p[0], p[1]], [p[2], p[3]]).unwrap();
        let (_, gradients) = evaluate(points);
        for particle in 0..4 {
            for axis in 0..3 {
                let at = |step: f32| {
                    let mut moved = points;
                    moved[particle][axis] += step;
                    evaluate(moved).0
                };
                let difference = (at(1e-2) - at(-1e-2)) / 2e-2;
                assert!((difference - gradients[particle][axis]).abs() < 3e-3, "{particle} {axis}");
            }
        }
        assert!(gradients.iter().sum::<Vec3>().length() < 1e-5, "momentum");
        let turn: Vec3 = points.iter().zip(gradients).map(|(x, g)| x.cross(g)).sum();
        assert!(turn.length() < 1e-5, "angular momentum");
    }

    #[test]
    fn a_flat_pair_has_no_angle_and_a_right_angle_has_one() {
        let edge = [Vec3::ZERO, Vec3::X];
        let (flat, _) = gradient([Vec3::Z, -Vec3::Z], edge).unwrap();
        assert_eq!(flat, 0.0);
        // Triangle (edge, wing 0) seen counter-clockwise from +y when wing 0 is at −z.
        let (valley, _) = gradient([-Vec3::Z, Vec3::Y], edge).unwrap();
        let (ridge, _) = gradient([-Vec3::Z, -Vec3::Y], edge).unwrap();
        assert!((valley - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
        assert_eq!(ridge, -valley);
        assert_eq!(gradient([Vec3::X * 2.0, Vec3::Y], edge), None);
    }
}
