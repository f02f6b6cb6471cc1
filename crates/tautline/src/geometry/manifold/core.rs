//! What the narrow phase asks of the two cores of a pair, and where they lie.

use glam::{Mat3, Vec3};

use super::triangle::Triangle;
use crate::shape::Convex;
use crate::simd::Lanes;

/// Where a frame lies in another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placement {
    pub(crate) rotation: Mat3,
    /// In m.
    pub(crate) translation: Vec3,
}

impl Placement {
    /// A point of the placed frame, in the outer one.
    #[inline(always)]
    pub(crate) fn point(&self, point: Vec3) -> Vec3 {
        self.rotation * point + self.translation
    }

    /// A point of the outer frame, in the placed one.
    #[inline(always)]
    pub(crate) fn point_inside(&self, point: Vec3) -> Vec3 {
        self.direction_inside(point - self.translation)
    }

    /// A direction of the outer frame, in the placed one.
    #[inline(always)]
    pub(crate) fn direction_inside(&self, direction: Vec3) -> Vec3 {
        let Mat3 { x_axis, y_axis, z_axis } = self.rotation;
        Vec3::new(x_axis.dot(direction), y_axis.dot(direction), z_axis.dot(direction))
    }
}

/// A polytope, a segment or a point, to be taken with a radius around it. Frames are its own.
pub(super) trait Core {
    fn radius(&self) -> f32;
    /// About half its length, in m.
    fn size(&self) -> f32;
    fn vertices(&self) -> &[Vec3];
    /// The corner farthest along a direction of any length, and how far it is. Of several the first.
    fn support<L: Lanes>(&self, direction: Vec3) -> (usize, f32);
    /// The face whose normal is nearest to a direction, and the product of both; (0, −∞) without faces.
    fn facing<L: Lanes>(&self, direction: Vec3) -> (usize, f32);
    /// Unit, outward.
    fn normal(&self, face: usize) -> Vec3;
    /// The corners of a face, counter-clockwise seen from outside.
    fn corners(&self, face: usize) -> impl Iterator<Item = (u16, Vec3)>;
}

impl Core for Convex {
    #[inline(always)]
    fn radius(&self) -> f32 {
        self.radius
    }
    #[inline(always)]
    fn size(&self) -> f32 {
        self.size
    }
    #[inline(always)]
    fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }
    #[inline(always)]
    fn support<L: Lanes>(&self, direction: Vec3) -> (usize, f32) {
        self.support::<L>(direction)
    }
    #[inline(always)]
    fn facing<L: Lanes>(&self, direction: Vec3) -> (usize, f32) {
        self.facing::<L>(direction)
    }
    #[inline(always)]
    fn normal(&self, face: usize) -> Vec3 {
        self.faces[face].normal
    }
    #[inline(always)]
    fn corners(&self, face: usize) -> impl Iterator<Item = (u16, Vec3)> {
        self.corners(self.faces[face])
    }
}

/// Its faces are 0, the front, and 1, the back.
impl Core for Triangle {
    #[inline(always)]
    fn radius(&self) -> f32 {
        0.0
    }
    #[inline(always)]
    fn size(&self) -> f32 {
        let [p, q, r] = self.corners;
        0.5 * (q - p).length_squared().max((r - p).length_squared()).sqrt()
    }
    #[inline(always)]
    fn vertices(&self) -> &[Vec3] {
        &self.corners
    }
    #[inline(always)]
    fn support<L: Lanes>(&self, direction: Vec3) -> (usize, f32) {
        let heights = self.corners.map(|corner| corner.dot(direction));
        let first = if heights[1] > heights[0] { 1 } else { 0 };
        let best = if heights[2] > heights[first] { 2 } else { first };
        (best, heights[best])
    }
    #[inline(always)]
    fn facing<L: Lanes>(&self, direction: Vec3) -> (usize, f32) {
        let along = self.normal.dot(direction);
        if along >= 0.0 { (0, along) } else { (1, -along) }
    }
    #[inline(always)]
    fn normal(&self, face: usize) -> Vec3 {
        if face == 0 { self.normal } else { -self.normal }
    }
    #[inline(always)]
    fn corners(&self, face: usize) -> impl Iterator<Item = (u16, Vec3)> {
        let order: [u16; 3] = if face == 0 { [0, 1, 2] } else { [0, 2, 1] };
        order.into_iter().map(|corner| (corner, self.corners[usize::from(corner)]))
    }
}

/// A pair of cores, seen from the frame of A.
pub(super) struct Pair<'a, B> {
    pub(super) a: &'a Convex,
    pub(super) b: &'a B,
    pub(super) b_in_a: &'a Placement,
}

impl<B: Core> Pair<'_, B> {
    /// The corner of A farthest along `direction`, that of B farthest against it, and how far the latter lies
    /// beyond the former, times the direction's length.
    #[inline(always)]
    pub(super) fn support<L: Lanes>(&self, direction: Vec3) -> ([u16; 2], f32) {
        let (a, highest) = self.a.support::<L>(direction);
        let (b, height) = self.b.support::<L>(-self.b_in_a.direction_inside(direction));
        ([a as u16, b as u16], self.b_in_a.translation.dot(direction) - height - highest)
    }

    #[inline(always)]
    pub(super) fn point_of_a(&self, index: u16) -> Vec3 {
        self.a.vertices[usize::from(index)]
    }

    #[inline(always)]
    pub(super) fn point_of_b(&self, index: u16) -> Vec3 {
        self.b_in_a.point(self.b.vertices()[usize::from(index)])
    }

    /// In m.
    #[inline(always)]
    pub(super) fn radii(&self) -> f32 {
        self.a.radius + self.b.radius()
    }
}
