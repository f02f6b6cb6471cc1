//! Contact manifolds: where two convex parts touch, or soon will, by up to four points and one normal.
//!
//! A pair costs as little as it moves: mostly its remembered axis still separates it, which two supports tell;
//! else shifted GJK (see [`touch`]) takes an iteration or two from the remembered simplex, and faces that lie on
//! each other are clipped. Everything is seen from the frame of A. Cores are polytopes, segments and points; the
//! radii around them are taken off at the end, so spheres and capsules are exact.
//!
//! Functions over [`Lanes`] are to be called from a [`Kernel`](crate::simd::Kernel).

mod clip;
mod core;
mod exact;
mod faces;
mod key;
mod plane;
mod reduce;
mod round;
mod scale;
mod simplex;
mod touch;
mod triangle;
mod walk;

use glam::Vec3;
use serde::{Deserialize, Serialize};

pub(crate) use self::core::Placement;
pub(crate) use exact::Scratch;
pub(crate) use plane::collide_plane;
pub(crate) use reduce::Former;
pub(crate) use triangle::{Triangle, collide_triangle};

use self::core::{Core, Pair};
use crate::norm::Norm;
use crate::shape::Convex;
use crate::simd::Lanes;
use clip::Reference;
use key::{Body, Key};
use reduce::Candidate;
use simplex::{Simplex, Vertex};
use touch::{Search, Start, Touch, find};

/// Most points of a manifold.
pub(crate) const MAX_POINTS: usize = 4;

/// A place where two bodies touch, or soon will.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ManifoldPoint {
    /// On the surface of A, in A's frame, in m. (Of a rounded edge at an angle to the face it touches: the radius from
    /// its core along the normal, and so a little within the surface.)
    pub(crate) on_a: Vec3,
    /// On the surface of B, in B's frame, in m: `separation` from the former, along the normal.
    pub(crate) on_b: Vec3,
    /// In m; below 0 the bodies overlap.
    pub(crate) separation: f32,
    /// Names the features that touch: the same from call to call, no two alike in a manifold.
    pub(crate) key: u32,
}

/// How two convex bodies touch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Manifold {
    /// Unit, from A to B, in A's frame.
    pub(crate) normal: Vec3,
    /// How many points there are; 0 if the bodies are further apart than asked.
    pub(crate) count: usize,
    /// The first `count` are in use.
    pub(crate) points: [ManifoldPoint; MAX_POINTS],
}

/// What a pair remembers between calls. Any value will do, also one of another pair or from foreign bytes: a bad one
/// costs time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Memory {
    /// Unit, from A to B, in A's frame: the axis of the last call. Zero: none yet.
    pub(crate) axis: Vec3,
    /// Corners of A and of B that were nearest, up to the first that are none.
    pairs: [[u16; 2]; 3],
}

/// Corners that do not exist.
const NO_CORNERS: [u16; 2] = [u16::MAX; 2];

impl Default for Memory {
    fn default() -> Self {
        Self::of_axis(Vec3::ZERO)
    }
}

impl Memory {
    fn of_axis(axis: Vec3) -> Self {
        Self { axis, pairs: [NO_CORNERS; 3] }
    }

    fn corners(&self) -> impl Iterator<Item = [u16; 2]> {
        self.pairs.into_iter().take_while(|&pair| pair != NO_CORNERS)
    }

    /// Whether there is an axis, and all corners exist.
    #[inline(always)]
    fn is_usable<B: Core>(&self, pair: &Pair<B>) -> bool {
        let (count_a, count_b) = (pair.a.vertices.len(), pair.b.vertices().len());
        let exist = |[a, b]: [u16; 2]| usize::from(a) < count_a && usize::from(b) < count_b;
        (self.axis.length_squared() - 1.0).abs() < 1e-3 && self.corners().all(exist)
    }

    /// The remembered corners, or if there are none `support`.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn simplex(&self, support: [u16; 2]) -> Simplex {
        let mut simplex = Simplex::default();
        for pair in self.corners() {
            simplex.push(Vertex { pair, point: Vec3::ZERO });
        }
        if simplex.count == 0 {
            simplex.push(Vertex { pair: support, point: Vec3::ZERO });
        }
        simplex
    }

    #[inline(always)]
    fn keep(&mut self, touch: &Touch) {
        *self = Self::of_axis(touch.normal);
        self.pairs[..touch.count].copy_from_slice(&touch.pairs[..touch.count]);
    }
}

/// Where A and B touch, or will within `margin` m; no points if they are further apart.
///
/// The normal is that of a face where one takes part in the contact, else the direction of the distance, or
/// of the least depth. A pair that overlaps keeps to the way out that it came in by while that is about as short
/// as any, or the overlap less than a fiftieth of its width; otherwise it is the shortest. Coincident bodies
/// have one too; of equally short ones it is any.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(crate) fn collide<L: Lanes>(
    a: &Convex,
    b: &Convex,
    b_in_a: &Placement,
    (memory, scratch): (&mut Memory, &mut Scratch),
    margin: f32,
) -> Manifold {
    let pair = Pair { a, b, b_in_a };
    let axis = b_in_a.translation.unit_or(Vec3::Y);
    if a.vertices.len() == 1 && b.vertices.len() == 1 {
        return round::balls(&pair, memory, axis, margin);
    }
    let Some(start) = Start::new::<L, _>(&pair, memory, axis, margin) else { return Manifold::default() };
    let is_round = a.vertices.len() == 1 || b.vertices.len() == 1;
    if !is_round
        && !start.is_new
        && let Some(reference) = Reference::choose::<L, _>(&pair, memory.axis)
        && let Some(manifold) =
            faces::remembered::<L, _>(&pair, (memory, scratch), &reference, &start, margin, Search::Global)
    {
        return manifold;
    }
    let Some(touch) = find::<L, _>(&pair, (memory, scratch), &start, margin, Search::Global) else {
        return Manifold::default();
    };
    let limit = margin + pair.radii();
    if is_round {
        Manifold::single(&pair, &touch)
    } else if a.vertices.len() == 2 && b.vertices.len() == 2 {
        round::capsules(&pair, &touch, limit, scratch)
    } else {
        match Reference::choose::<L, _>(&pair, touch.normal) {
            Some(reference) => faces::touching::<L, _>(&pair, &touch, &reference, limit, scratch),
            None => Manifold::single(&pair, &touch),
        }
    }
}

impl Manifold {
    /// The nearest points alone.
    #[inline(always)]
    fn single<B: Core>(pair: &Pair<B>, touch: &Touch) -> Self {
        let mut manifold = Self { normal: touch.normal, ..Self::default() };
        manifold.push(pair, &touch.candidate());
        manifold
    }

    /// The best four of the scratch's candidates.
    #[inline(always)]
    fn of_candidates<B: Core>(pair: &Pair<B>, normal: Vec3, scratch: &mut Scratch, size: f32) -> Self {
        let mut manifold = Self { normal, ..Self::default() };
        for candidate in scratch.reduce(normal, size) {
            manifold.push(pair, candidate);
        }
        manifold
    }

    /// Adds a point, unless there is one of the same features.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn push<B: Core>(&mut self, pair: &Pair<B>, candidate: &Candidate) {
        let key = candidate.key.0;
        if self.points[..self.count].iter().any(|point| point.key == key) {
            return;
        }
        let on_b = candidate.on_a + self.normal * (candidate.separation - pair.b.radius());
        self.points[self.count] = ManifoldPoint {
            on_a: candidate.on_a + self.normal * pair.a.radius,
            on_b: pair.b_in_a.point_inside(on_b),
            separation: candidate.separation - pair.radii(),
            key,
        };
        self.count += 1;
    }
}

impl Touch {
    /// The nearest points, named by their features.
    #[inline(always)]
    fn candidate(&self) -> Candidate {
        let ((corners_a, count_a), (corners_b, count_b)) = (self.corners(0), self.corners(1));
        let key = match (count_a, count_b) {
            (1, 3) => Key::corner(Body::A, corners_a[0]),
            (3, 1) => Key::corner(Body::B, corners_b[0]),
            _ => Key::nearest(corners_a[0], corners_b[0]),
        };
        Candidate { on_a: self.on_a, separation: self.separation, key }
    }
}

#[cfg(test)]
mod tests;
