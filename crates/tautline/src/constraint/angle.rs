//! The angular constraint at a particle: the angle between its two sticks is held, or kept in a range
//! (paper, 4; for ropes).

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{AngleLimit, any_perpendicular};
use crate::norm::Norm;

/// The angle at particle `b` between the directions to `a` and to `c`; π = straight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Angle {
    /// One neighbour, counted within the body.
    pub a: u32,
    /// The particle at which the angle is measured.
    pub b: u32,
    /// The other neighbour.
    pub c: u32,
    /// Target or range, in rad, 0 to π.
    pub limit: AngleLimit,
    /// α, in rad/(N·m): 0 = rigid.
    pub compliance: f32,
}

/// θ in [0, π] and its gradients ∂θ/∂x_a, ∂θ/∂x_b, ∂θ/∂x_c in rad/m.
///
/// With u = a − b, v = c − b and n = u × v/|u × v|: ∂θ/∂a = u × n/|u|², ∂θ/∂c = n × v/|v|², and b takes what
/// is left. In a line n is any perpendicular (the same for the same u). `None` if a neighbour coincides with b.
pub(crate) fn gradient(a: Vec3, b: Vec3, c: Vec3) -> Option<(f32, [Vec3; 3])> {
    let (u, v) = (a - b, c - b);
    let (u_squared, v_squared) = (u.length_squared(), v.length_squared());
    if u_squared < 1e-20 || v_squared < 1e-20 {
        return None;
    }
    let cross = u.cross(v);
    let sine = cross.norm();
    let angle = libm::atan2f(sine, u.dot(v));
    let flat = sine * sine < 1e-12 * u_squared * v_squared;
    let normal = if flat { any_perpendicular(u) } else { cross / sine };
    let (grad_a, grad_c) = (u.cross(normal) / u_squared, normal.cross(v) / v_squared);
    Some((angle, [grad_a, -grad_a - grad_c, grad_c]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_agree_with_finite_differences_and_sum_to_zero() {
        let points = [Vec3::new(0.3, 1.0, -0.2), Vec3::new(0.1, 0.0, 0.4), Vec3::new(-0.9, 0.5, 0.8)];
        let (angle, gradients) = gradient(points[0], points[1], points[2]).unwrap();
        let expected = (points[0] - points[1]).angle_between(points[2] - points[1]);
        assert!((angle - expected).abs() < 1e-6);
        for particle in 0..3 {
            for axis in 0..3 {
                let at = |step: f32| {
                    let mut moved = points;
                    moved[particle][axis] += step;
                    gradient(moved[0], moved[1], moved[2]).unwrap().0
                };
                let difference = (at(1e-2) - at(-1e-2)) / 2e-2;
                assert!((difference - gradients[particle][axis]).abs() < 2e-3, "{particle} {axis}");
            }
        }
        assert!(gradients.iter().sum::<Vec3>().length() < 1e-6);
    }

    #[test]
    fn a_line_has_an_angle_and_a_direction_to_bend() {
        let (straight, gradients) = gradient(-Vec3::X, Vec3::ZERO, Vec3::X).unwrap();
        assert_eq!(straight, std::f32::consts::PI);
        assert!((gradients[0].length() - 1.0).abs() < 1e-6);
        let (folded, _) = gradient(Vec3::X, Vec3::ZERO, Vec3::X).unwrap();
        assert_eq!(folded, 0.0);
        assert_eq!(gradient(Vec3::X, Vec3::X, Vec3::Y), None);
    }
}
