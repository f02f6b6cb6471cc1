//! A convex part with its bounds.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::Convex;
use crate::geometry::{Sphere, smallest_enclosing_sphere};

/// A convex part of a shape; in the frame of the body, its centre of mass and principal axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "Convex", into = "Convex")]
pub(crate) struct Part {
    pub(crate) convex: Convex,
    /// The smallest around it.
    pub(crate) bound: Sphere,
    /// Lower corner of its box, in m.
    pub(crate) low: Vec3,
    /// Upper corner of its box, in m.
    pub(crate) high: Vec3,
}

impl From<Part> for Convex {
    fn from(part: Part) -> Self {
        part.convex
    }
}

impl From<Convex> for Part {
    fn from(convex: Convex) -> Self {
        let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) = convex.vertices.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)));
        let radius = Vec3::splat(convex.radius);
        // What has no bound, from bytes that mean nothing, is refused afterwards.
        let core = smallest_enclosing_sphere(&convex.vertices).map(|found| found.sphere).unwrap_or_default();
        let bound = Sphere { center: core.center, radius: core.radius + convex.radius };
        Self { convex, bound, low: low - radius, high: high + radius }
    }
}

impl Part {
    /// Of all together, in m: the greatest distance of a point from the centre of mass, and the radius of a ball that
    /// fits into each.
    pub(super) fn extent_of(parts: &[Self]) -> (f32, f32) {
        let reach = parts.iter().map(Self::reach).fold(0.0, f32::max);
        (reach, parts.iter().map(Self::inner_radius).fold(f32::INFINITY, f32::min))
    }

    fn reach(&self) -> f32 {
        let squared = self.convex.vertices.iter().map(|p| p.length_squared()).fold(0.0, f32::max);
        squared.sqrt() + self.convex.radius
    }

    /// The radius of a ball within it, in m: the greater of those around the body's centre of mass and around the
    /// mean of its corners.
    fn inner_radius(&self) -> f32 {
        let Convex { vertices, faces, radius, .. } = &self.convex;
        if faces.is_empty() {
            return *radius;
        }
        let ball = |center: Vec3| {
            faces.iter().map(|face| face.offset - face.normal.dot(center)).fold(f32::INFINITY, f32::min)
        };
        let mean = vertices.iter().sum::<Vec3>() / vertices.len() as f32;
        ball(Vec3::ZERO).max(ball(mean)).max(0.0) + radius
    }
}
