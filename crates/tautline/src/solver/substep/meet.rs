//! Whether two parts meet on the ways of their bodies, and when.

use glam::Vec3;

use super::way::Way;
use crate::geometry::manifold::Triangle;
use crate::geometry::query::{Rounded, Touch, first_touch};
use crate::norm::Norm;
use crate::shape::{Convex, Shape};

/// Bodies that move less than this share of their inner radius against each other do not go through each other.
const FAST_TOGETHER: f64 = 0.75;
/// A core in another by less than this share of its inner radius, and this (m), touches it.
const TOUCHING: f32 = 0.1;
const ROUNDING: f32 = 1e-6;

/// A pair of parts of which one is fast.
pub(super) struct Candidate<'a> {
    /// Where their bodies move.
    pub(super) places: [usize; 2],
    /// The sizes of their cores, as shares of that of the part; the first counts until it is in the other part.
    pub(super) cores: &'static [f32],
    a: &'a Convex,
    b: Other<'a>,
    /// From the centre of either body, how far its parts reach, in m; of a triangle the ball around it.
    balls: [(Vec3, f32); 2],
    /// The smaller one of those that are solid, in m.
    inner_radius: f32,
    /// How far the corners of either body stand out over its inner radius, in m.
    corners: [f32; 2],
}

enum Other<'a> {
    Part(&'a Convex),
    Triangle(Triangle),
}

impl Other<'_> {
    fn ball(&self, reach: f32) -> (Vec3, f32) {
        match self {
            Self::Part(_) => (Vec3::ZERO, reach),
            Self::Triangle(triangle) => {
                let center = mean(&triangle.corners);
                (center, triangle.corners.iter().map(|p| p.distance_to(center)).fold(0.0, f32::max))
            }
        }
    }

    fn rounded(&self) -> Rounded<'_> {
        match self {
            Self::Part(part) => Rounded::of(part),
            Self::Triangle(triangle) => Rounded { corners: &triangle.corners, radius: 0.0 },
        }
    }

    fn size(&self) -> f32 {
        match self {
            Self::Part(part) => part.size,
            Self::Triangle(_) => f32::INFINITY,
        }
    }
}

impl<'a> Candidate<'a> {
    /// Of parts, given by their numbers, of two bodies that move in these places; `None` if there are none such.
    pub(super) fn new(
        places: [usize; 2],
        cores: &'static [f32],
        shapes: [&'a Shape; 2],
        parts: [u32; 2],
    ) -> Option<Self> {
        let [shape_a, shape_b] = shapes;
        let a = &shape_a.parts().get(parts[0] as usize)?.convex;
        let b = match shape_b.surface() {
            Some(surface) => Other::Triangle(surface.triangle(parts[1])),
            None => Other::Part(&shape_b.parts().get(parts[1] as usize)?.convex),
        };
        let balls = [(Vec3::ZERO, shape_a.reach()), b.ball(shape_b.reach())];
        let solid = shapes.into_iter().filter(|shape| shape.is_solid());
        let inner_radius = solid.map(Shape::inner_radius).fold(f32::INFINITY, f32::min);
        let corners = shapes.map(|shape| shape.reach() - shape.inner_radius());
        Some(Self { places, cores, a, b, balls, inner_radius, corners })
    }
}

impl Candidate<'_> {
    /// When the core of the smaller part enters the other; or rather when the parts first touch before that.
    pub(super) fn first_touch(&self, a: &Way, b: &Way) -> Option<Touch> {
        if self.is_slow(a, b) || self.is_wide_of(a, b) || self.begins_behind(a, b) {
            return None;
        }
        // What has its core in another already may still not get a smaller one there.
        for &share in self.cores {
            let mut corners = Vec::new();
            let [core_a, core_b] = self.shapes(share, &mut corners);
            let touch = |target: f64| first_touch(&a.motion(core_a), &b.motion(core_b), target);
            let found = touch(0.0)?;
            if found.time > 0.0 {
                let [whole_a, whole_b] = self.shapes(1.0, &mut corners);
                let whole = first_touch(&a.motion(whole_a), &b.motion(whole_b), 0.0);
                return whole.filter(|whole| whole.time > 0.0).or(Some(found));
            }
            // It was stopped here before; it may come half as near to being in it.
            let deep = f64::from(TOUCHING * self.inner_radius + ROUNDING);
            if found.at.gap > -deep {
                return touch(0.5 * (found.at.gap - deep));
            }
        }
        None
    }

    /// Both parts, the smaller one drawn towards the mean of its corners.
    fn shapes<'c>(&'c self, share: f32, corners: &'c mut Vec<Vec3>) -> [Rounded<'c>; 2] {
        let (whole_a, whole_b) = (Rounded::of(self.a), self.b.rounded());
        let is_a_smaller = self.a.size <= self.b.size();
        let whole = if is_a_smaller { whole_a } else { whole_b };
        let middle = mean(whole.corners);
        corners.clear();
        corners.extend(whole.corners.iter().map(|corner| middle + (*corner - middle) * share));
        let core = Rounded { corners, radius: whole.radius * share };
        if is_a_smaller { [core, whole_b] } else { [whole_a, core] }
    }

    /// Whether they hardly move against each other, for their size. What turns is as large as it was but for its corners.
    fn is_slow(&self, a: &Way, b: &Way) -> bool {
        let [stir_a, stir_b] = [(a, 0), (b, 1)].map(|(way, i)| way.turn.norm() * f64::from(self.corners[i]));
        let least = f64::from(self.inner_radius);
        (a.shift - b.shift).norm() + stir_a + stir_b < FAST_TOGETHER * least
    }

    /// Whether balls around both pass each other.
    fn is_wide_of(&self, a: &Way, b: &Way) -> bool {
        let [(at_a, reach_a), (at_b, reach_b)] = self.balls;
        let [place_a, place_b] =
            [(a, at_a), (b, at_b)].map(|(way, at)| way.center + way.rotation * at.as_dvec3());
        // A point of a body that turns leaves its straight way.
        let stray = f64::from(at_b.norm()) * b.turn.norm();
        let (between, closing) = (place_b - place_a, a.shift - b.shift);
        let time = (between.dot(closing) / closing.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (between - closing * time).norm() > f64::from(reach_a) + f64::from(reach_b) + stray
    }

    /// Whether the middle of a starts behind the triangle: triangles stop what comes from the front.
    fn begins_behind(&self, a: &Way, b: &Way) -> bool {
        let Other::Triangle(triangle) = &self.b else { return false };
        let middle = a.center + a.rotation * mean(&self.a.vertices).as_dvec3();
        let in_b = b.rotation.inverse() * (middle - b.center);
        (in_b - triangle.corners[0].as_dvec3()).dot(triangle.normal.as_dvec3()) <= 0.0
    }
}

fn mean(corners: &[Vec3]) -> Vec3 {
    corners.iter().sum::<Vec3>() / corners.len().max(1) as f32
}
