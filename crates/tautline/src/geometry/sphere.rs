//! Spheres, and the smallest spheres around one to four points and around two spheres.
//!
//! Every function here returns a sphere that really contains what it was asked to contain: the radius
//! is measured from the rounded centre and then widened by the rounding of the measurement itself.

mod enclosing;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::norm::Norm;

pub use enclosing::{EnclosingSphere, SupportPoints, circumsphere, smallest_enclosing_sphere};

/// Widening that covers the rounding of a distance: 4 units in the last place.
const DISTANCE_ROUNDING: f32 = 1.0 + 4.0 * f32::EPSILON;
/// How much larger than the smallest the sphere of four points may be, as a factor on the squared radius.
const QUAD_SLACK_SQUARED: f32 = 1.02;

/// A ball: all points within `radius` of `center`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Sphere {
    /// Centre, in m, in the frame of the points it was made from.
    pub center: Vec3,
    /// Radius, in m; 0 is a point.
    pub radius: f32,
}

impl Sphere {
    /// Whether two spheres share a point; touching counts. False as soon as a number is NaN.
    #[inline]
    pub fn overlaps(&self, other: &Sphere) -> bool {
        let reach = self.radius + other.radius;
        self.center.distance_squared(other.center) <= reach * reach
    }

    /// Whether `point` is inside or at most `margin` (m, may be negative) outside.
    #[inline]
    pub fn contains_point(&self, point: Vec3, margin: f32) -> bool {
        let reach = self.radius + margin;
        reach >= 0.0 && self.center.distance_squared(point) <= reach * reach
    }

    /// The smallest sphere around two spheres; one of the two where it contains the other.
    ///
    /// Its diameter runs through both centres, from the far side of `a` to the far side of `b`.
    #[inline]
    pub fn around_two(a: Sphere, b: Sphere) -> Sphere {
        let offset = b.center - a.center;
        let distance = offset.norm();
        // Where on the way from a's centre to b's; clamped, it is the centre of the one that contains the other.
        let along = 0.5 + 0.5 * (b.radius - a.radius) / larger(distance, f32::MIN_POSITIVE);
        let center = a.center + offset * along.clamp(0.0, 1.0);
        let radius = larger(0.5 * (distance + a.radius + b.radius), larger(a.radius, b.radius));
        // Here the radius is not measured from the centre, so the centre's own rounding counts too.
        let center_rounding = f32::EPSILON * (center.x.abs() + center.y.abs() + center.z.abs());
        Sphere { center, radius: radius * DISTANCE_ROUNDING + center_rounding }
    }

    /// The smallest sphere around two points.
    #[inline]
    pub fn around_segment(a: Vec3, b: Vec3) -> Sphere {
        let center = a + (b - a) * 0.5;
        widened(center, center.distance_squared(a).max(center.distance_squared(b)))
    }

    /// The smallest sphere around three points: on the longest side as diameter, or, where all angles are
    /// acute, through the three corners. The corners may coincide or lie on a line.
    #[inline]
    pub fn around_triangle(a: Vec3, b: Vec3, c: Vec3) -> Sphere {
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let (side_a, side_b, side_c) = (bc.length_squared(), ac.length_squared(), ab.length_squared());
        // Barycentric weights of the circumcentre; one that is not positive faces an angle of 90° or more.
        let weight_a = side_a * (side_b + side_c - side_a);
        let weight_b = side_b * (side_c + side_a - side_b);
        let weight_c = side_c * (side_a + side_b - side_c);
        if weight_a.min(weight_b).min(weight_c) <= 0.0 {
            let center = if side_a >= side_b && side_a >= side_c {
                b + bc * 0.5
            } else if side_b >= side_c {
                a + ac * 0.5
            } else {
                a + ab * 0.5
            };
            return widened(center, farthest_squared(center, a, b, c, c));
        }
        let center = a + (ab * weight_b + ac * weight_c) / (weight_a + weight_b + weight_c);
        widened(center, farthest_squared(center, a, b, c, c))
    }

    /// A sphere around the four corners of a quad, given in order around it; its radius is at most 1 %
    /// above the smallest. Any four points are allowed, coplanar or not.
    #[inline]
    pub fn around_quad(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> Sphere {
        // A parallelogram's smallest sphere has the longer diagonal as diameter; a cell of a cloth is nearly one.
        let ac_longer = a.distance_squared(c) >= b.distance_squared(d);
        let (start, end) = if ac_longer { (a, c) } else { (b, d) };
        let center = start + (end - start) * 0.5;
        let needed = farthest_squared(center, a, b, c, d);
        if needed <= center.distance_squared(start) * QUAD_SLACK_SQUARED {
            return widened(center, needed);
        }
        around_four([a, b, c, d])
    }
}

/// The smallest sphere of four points is that of the first three of them whose smallest sphere contains
/// the fourth, and otherwise the sphere through all four.
#[cold]
fn around_four([a, b, c, d]: [Vec3; 4]) -> Sphere {
    for (p, q, r, left_out) in [(b, c, d, a), (c, d, a, b), (d, a, b, c), (a, b, c, d)] {
        let sphere = Sphere::around_triangle(p, q, r);
        let needed = sphere.center.distance_squared(left_out);
        if needed <= sphere.radius * sphere.radius * QUAD_SLACK_SQUARED {
            return widened(sphere.center, farthest_squared(sphere.center, a, b, c, d));
        }
    }
    // Without a circumsphere the points are flat to rounding; their mean is then as good a centre as any.
    let center = match circumsphere(&[a, b, c, d]) {
        Some(sphere) => sphere.center,
        None => (a + b + c + d) * 0.25,
    };
    widened(center, farthest_squared(center, a, b, c, d))
}

#[inline]
fn farthest_squared(center: Vec3, a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> f32 {
    let to = |point: Vec3| center.distance_squared(point);
    larger(larger(to(a), to(b)), larger(to(c), to(d)))
}

/// Plain comparison: one instruction, where `f32::max` takes several to see to NaN.
#[inline]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline]
fn widened(center: Vec3, radius_squared: f32) -> Sphere {
    Sphere { center, radius: radius_squared.sqrt() * DISTANCE_ROUNDING }
}
