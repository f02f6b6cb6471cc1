//! Sums of squared distances from planes.

use std::ops::{Add, AddAssign};

use glam::{DMat3, DVec3};

use crate::norm::Norm;

/// What the distance from a triangle's own middle counts, as a share of that from its plane: it keeps the triangles of
/// flat and straight places round.
const KEEP_PLACE: f64 = 1e-4;
/// The least determinant, of a matrix with trace 1, that is worth solving for.
const SINGULAR: f64 = 1e-9;

/// x · A x + 2 b · x + c, in m⁴: squared distances, weighted by areas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
}

impl Default for Quadric {
    fn default() -> Self {
        Self { a: DMat3::ZERO, b: DVec3::ZERO, c: 0.0 }
    }
}

impl Quadric {
    pub(super) fn of_triangle([p, q, r]: [DVec3; 3]) -> Self {
        let normal = (q - p).cross(r - p);
        let area = normal.norm() / 2.0;
        let normal = normal.unit_or_zero();
        let middle = (p + q + r) / 3.0;
        let outer = DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
        let a = (outer + DMat3::from_diagonal(DVec3::splat(KEEP_PLACE))) * area;
        Self { a, b: -(a * middle), c: middle.dot(a * middle) }
    }

    pub(super) fn at(&self, x: DVec3) -> f64 {
        (x.dot(self.a * x) + 2.0 * self.b.dot(x) + self.c).max(0.0)
    }

    /// Where it is least; `None` if that is hard to tell. Worked out relative to a place nearby.
    pub(super) fn lowest(&self, near: DVec3) -> Option<DVec3> {
        let trace = self.a.x_axis.x + self.a.y_axis.y + self.a.z_axis.z;
        let scaled = self.a * (1.0 / trace);
        let slope = (self.b + self.a * near) * (1.0 / trace);
        (scaled.determinant() > SINGULAR).then(|| near - scaled.inverse() * slope)
    }
}

impl Add for Quadric {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c }
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
