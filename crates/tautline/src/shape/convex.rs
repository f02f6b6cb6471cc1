//! A convex part of a shape: a core of corners, and a radius around it.
//!
//! A core of one corner with a radius is a sphere, one of two a capsule, a polytope without radius is itself. GJK
//! and clipping see the core only; the radius is taken off the distance.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::simd::{LANES, Lanes, Row, Vec3x8};

/// The points within `radius` of the convex hull of `vertices`. The frame is that of the body: its centre of mass
/// and principal axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Convex {
    /// Corners of the core, in m; at least one.
    pub(crate) vertices: Vec<Vec3>,
    /// The faces of the core; empty for points and segments, two for a triangle.
    pub(crate) faces: Vec<Face>,
    /// The corners of all faces, face after face, each counter-clockwise seen from outside.
    pub(crate) loops: Vec<u16>,
    /// In m.
    pub(crate) radius: f32,
    /// Half the diagonal of the box around its corners, and the radius, in m.
    pub(crate) size: f32,
    /// Corners in groups of eight, by coordinate; the last group is filled with its first corner.
    packed_vertices: Vec<[Row; 3]>,
    /// Normals of the faces, alike.
    packed_normals: Vec<[Row; 3]>,
}

/// A flat face of a core.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Face {
    /// Unit, outward.
    pub(crate) normal: Vec3,
    /// normal · x of its points x, in m.
    pub(crate) offset: f32,
    /// Where its corners begin in `loops`.
    pub(crate) first: u32,
    /// How many corners it has.
    pub(crate) count: u32,
}

impl Convex {
    pub(crate) fn new(vertices: Vec<Vec3>, faces: Vec<Face>, loops: Vec<u16>, radius: f32) -> Self {
        let packed_vertices = pack(&vertices);
        let normals: Vec<Vec3> = faces.iter().map(|face| face.normal).collect();
        let packed_normals = pack(&normals);
        let low = vertices.iter().copied().reduce(Vec3::min).unwrap_or_default();
        let high = vertices.iter().copied().reduce(Vec3::max).unwrap_or_default();
        let size = 0.5 * (high - low).length() + radius;
        Self { vertices, faces, loops, radius, size, packed_vertices, packed_normals }
    }

    /// The corner farthest along `direction` (any length), and how far it is in its units. Of several the first.
    #[inline(always)]
    pub(crate) fn support<L: Lanes>(&self, direction: Vec3) -> (usize, f32) {
        farthest::<L>(&self.packed_vertices, direction)
    }

    /// The face whose normal is nearest to `direction` (any length), and the product of both. (0, −∞) without faces.
    #[inline(always)]
    pub(crate) fn facing<L: Lanes>(&self, direction: Vec3) -> (usize, f32) {
        farthest::<L>(&self.packed_normals, direction)
    }

    /// The corners of a face, counter-clockwise seen from outside.
    #[inline(always)]
    pub(crate) fn corners(&self, face: Face) -> impl ExactSizeIterator<Item = (u16, Vec3)> + Clone + '_ {
        let range = face.first as usize..(face.first + face.count) as usize;
        self.loops[range].iter().map(|&v| (v, self.vertices[v as usize]))
    }
}

fn pack(points: &[Vec3]) -> Vec<[Row; 3]> {
    let group = |chunk: &[Vec3]| {
        let point = |lane: usize| *chunk.get(lane).unwrap_or(&chunk[0]);
        let row = |axis: usize| Row(std::array::from_fn(|lane| point(lane)[axis]));
        [row(0), row(1), row(2)]
    };
    points.chunks(LANES).map(group).collect()
}

#[inline(always)]
fn farthest<L: Lanes>(groups: &[[Row; 3]], direction: Vec3) -> (usize, f32) {
    let direction = Vec3x8::<L>::splat(direction);
    let (mut best, mut height) = (0, f32::NEG_INFINITY);
    for (number, group) in groups.iter().enumerate() {
        let heights = Vec3x8::<L>::load(group).dot(direction);
        let highest = heights.largest();
        if highest > height {
            let lane = heights.equal(L::splat(highest)).bits().trailing_zeros() as usize;
            (best, height) = (number * LANES + lane % LANES, highest);
        }
    }
    (best, height)
}
