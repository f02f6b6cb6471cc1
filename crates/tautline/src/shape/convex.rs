//! A convex part of a shape: a core of corners, and a radius around it.
//!
//! A core of one corner with a radius is a sphere, one of two a capsule, a polytope without radius is itself. GJK
//! and clipping see the core only; the radius is taken off the distance.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::norm::Norm;
use crate::simd::{LANES, Lanes, Row, Vec3x8};

/// The points within `radius` of the convex hull of `vertices`. The frame is that of the body: its centre of mass
/// and principal axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "Stored", into = "Stored")]
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

/// What a core is stored as: the groups of eight follow from it.
#[derive(Serialize, Deserialize)]
struct Stored {
    vertices: Vec<Vec3>,
    faces: Vec<Face>,
    loops: Vec<u16>,
    radius: f32,
}

impl From<Convex> for Stored {
    fn from(Convex { vertices, faces, loops, radius, .. }: Convex) -> Self {
        Self { vertices, faces, loops, radius }
    }
}

impl From<Stored> for Convex {
    fn from(Stored { vertices, faces, loops, radius }: Stored) -> Self {
        Self::new(vertices, faces, loops, radius)
    }
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
        let size = 0.5 * (high - low).norm() + radius;
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

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::simd::{Instructions, Kernel, run};

    struct Farthest<'a>(&'a Convex, Vec3);

    impl Kernel for Farthest<'_> {
        type Output = [(usize, f32); 2];

        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            [self.0.support::<L>(self.1), self.0.facing::<L>(self.1)]
        }
    }

    fn brute_force(points: impl Iterator<Item = Vec3>, direction: Vec3) -> (usize, f32) {
        points.map(|p| p.x * direction.x + p.y * direction.y + p.z * direction.z).enumerate().fold(
            (0, f32::NEG_INFINITY),
            |best, (index, height)| if height > best.1 { (index, height) } else { best },
        )
    }

    /// Few coordinates, so that ties are common.
    fn vector() -> impl Strategy<Value = Vec3> {
        let lattice = prop::array::uniform3(-2..=2).prop_map(|c: [i32; 3]| Vec3::from(c.map(|k| k as f32)));
        prop_oneof![lattice, prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from)]
    }

    proptest! {
        #[test]
        fn the_farthest_is_that_of_brute_force(
            points in prop::collection::vec(vector(), 1..40),
            normals in prop::collection::vec(vector(), 0..20),
            direction in vector(),
        ) {
            let face = |&normal: &Vec3| Face { normal, offset: 0.0, first: 0, count: 0 };
            let convex = Convex::new(points, normals.iter().map(face).collect(), Vec::new(), 0.0);
            let expected = [
                brute_force(convex.vertices.iter().copied(), direction),
                brute_force(normals.iter().copied(), direction),
            ];
            for instructions in [Instructions::Widest, Instructions::Baseline, Instructions::Scalar] {
                prop_assert_eq!(run(instructions, Farthest(&convex, direction)), expected);
            }
        }
    }
}
