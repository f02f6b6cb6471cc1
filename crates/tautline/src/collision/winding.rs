//! Whether a point is inside a closed surface of any shape.

use glam::{DVec3, Vec3};

use crate::norm::Norm;

/// Whether the surface winds around `point`: the solid angles of its triangles (Van Oosterom and Strackee 1983)
/// sum to 4π inside and to 0 outside.
pub(crate) fn is_inside(point: Vec3, positions: &[Vec3], triangles: &[[u32; 3]]) -> bool {
    let corner = |v: u32| (positions[v as usize] - point).as_dvec3();
    let angle: f64 = triangles.iter().map(|t| solid_angle(t.map(corner))).sum();
    angle > std::f64::consts::TAU
}

fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let volume = a.dot(b.cross(c));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(volume, denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;

    #[test]
    fn tells_the_tube_of_a_torus_from_its_hole() {
        let torus = primitives::torus(1.0, 0.3, 32, 16).unwrap();
        let inside = |point| is_inside(point, &torus.positions, &torus.triangles);
        assert!(inside(Vec3::new(1.0, 0.0, 0.1)) && inside(Vec3::new(-0.7, 0.1, 0.7)));
        assert!(!inside(Vec3::ZERO));
        assert!(!inside(Vec3::splat(3.0)));
    }
}
