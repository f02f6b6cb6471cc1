//! Along which axis two cores are furthest apart, or least deep in each other, and where they are nearest.
//!
//! # Shifted GJK
//!
//! GJK knows no depth, and near zero distance f32 knows no direction. Both are mended by moving B away along the
//! axis of the last call, until the cores are a small part of their size apart, and taking the shift off what GJK
//! finds: if n is the direction of the shifted distance d, the cores are d − shift·n apart along n, and that is
//! never less than along the axis before. Repeated until the axis rests, this climbs to an axis along which no
//! neighbouring one separates better: the face of B ⊖ A through which the pair came, also if by now another one is
//! as near. Where that is not good enough (deep overlap, or no axis known), [`exact`](super::exact) decides.

use glam::Vec3;

use super::Memory;
use super::core::{Core, Pair};
use super::exact::{self, Scratch};
use super::simplex::{Simplex, Vertex};
use super::walk::{Walk, walk};
use crate::simd::Lanes;

/// Cores closer than this part of the smaller one's size are shifted apart …
const NEAR: f32 = 1e-3;
/// … to this part.
const APART: f32 = 1e-2;
/// The least shift as part of the larger coordinates: what f32 needs to tell directions.
const TELLABLE: f32 = 2e-4;
/// Cosine of the turn after which an axis rests: 0.26°.
const RESTING: f32 = 0.999_99;
/// Most turns of the axis.
const ROUNDS: usize = 4;
/// Overlap deeper than this part of the thinner core is left to the exact search …
const DEEP: f32 = 0.02;
/// … unless it is less than this part of its size.
const SHALLOW: f32 = 1e-3;

/// Where two cores are nearest, or deepest in each other. In A's frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    /// Unit, from A to B.
    pub(super) normal: Vec3,
    /// How far the core of B lies beyond that of A along it, in m.
    pub(super) separation: f32,
    /// A point on each core; the one on B is `separation · normal` further.
    pub(super) on_a: Vec3,
    pub(super) on_b: Vec3,
    /// Corners of A and of B that span the features; the first `count` are in use.
    pub(super) pairs: [[u16; 2]; 3],
    pub(super) count: usize,
    /// Size of the smaller body hereabouts, in m.
    pub(super) size: f32,
}

impl Touch {
    /// Of one body's corners among the pairs: the distinct ones, ascending, and how many.
    #[inline(always)]
    pub(super) fn corners(&self, body: usize) -> ([u16; 3], usize) {
        let mut corners = [0; 3];
        let mut count = 0;
        for pair in &self.pairs[..self.count] {
            if !corners[..count].contains(&pair[body]) {
                corners[count] = pair[body];
                count += 1;
            }
        }
        corners[..count].sort_unstable();
        (corners, count)
    }
}

/// Sizes near the place of contact, in m: of the smaller body, and of coordinates.
#[derive(Clone, Copy)]
struct Scale {
    size: f32,
    coordinates: f32,
}

impl Scale {
    #[inline(always)]
    fn at<B: Core>(pair: &Pair<B>, [a, b]: [u16; 2]) -> Self {
        let size_a = pair.a.vertices[usize::from(a)].length() + pair.a.radius;
        let size_b = pair.b.vertices()[usize::from(b)].length() + pair.b.radius();
        let size = if size_a < size_b { size_a } else { size_b };
        Self { size, coordinates: size_a + size_b }
    }

    /// By how much a pair at this separation has to be shifted, in m.
    #[inline(always)]
    fn shift(self, separation: f32) -> f32 {
        if separation > NEAR * self.size && separation > TELLABLE * self.coordinates {
            return 0.0;
        }
        (APART * self.size).max(TELLABLE * self.coordinates) - separation
    }
}

/// Which answer to a deep overlap is wanted.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Search {
    /// The least depth of all.
    Global,
    /// The least depth next to the remembered axis.
    Local,
}

/// Where the surfaces are nearest, or `None` if they are further apart than `margin`. Both ways the memory is
/// brought up to date. `start`: the axis of a pair without memory, unit.
#[inline(always)]
pub(super) fn find<L: Lanes, B: Core>(
    pair: &Pair<B>,
    (memory, scratch): (&mut Memory, &mut Scratch),
    start: Vec3,
    margin: f32,
    search: Search,
) -> Option<Touch> {
    let radii = pair.radii();
    let is_new = !memory.is_usable(pair);
    if is_new {
        *memory = Memory { axis: start, ..Memory::default() };
    }
    let (support, separation) = pair.support::<L>(memory.axis);
    memory.separation = separation - radii;
    if memory.separation > margin {
        return None;
    }
    let scale = Scale::at(pair, support);
    let found = match climb::<L, B>(pair, memory, (support, separation), margin, scale) {
        Climb::Beyond => return None,
        Climb::Touch(local) => {
            if search == Search::Global && is_deep::<L, B>(pair, &local, is_new) {
                shallower(local, exact::touch(pair, scratch, memory.axis, scale.size))
            } else {
                local
            }
        }
        Climb::Failed => exact::touch(pair, scratch, memory.axis, scale.size),
    };
    memory.keep(&found, radii);
    (found.separation - radii <= margin).then_some(found)
}

enum Climb {
    Beyond,
    Touch(Touch),
    /// The axis does not rest, or rounding stood in the way.
    Failed,
}

/// Shifted GJK from the remembered axis, along which the cores are `separation` apart with `support` in front.
#[inline(always)]
fn climb<L: Lanes, B: Core>(
    pair: &Pair<B>,
    memory: &mut Memory,
    (support, mut separation): ([u16; 2], f32),
    margin: f32,
    scale: Scale,
) -> Climb {
    let radii = pair.radii();
    let mut axis = memory.axis;
    let mut simplex = memory.simplex(support);
    for _ in 0..ROUNDS {
        let shift = scale.shift(separation);
        match walk::<L, B>(pair, axis * shift, simplex, margin + radii + shift, scale.coordinates) {
            Walk::Failed => return Climb::Failed,
            Walk::Beyond { axis: beyond, separation: shifted } => {
                memory.axis = beyond;
                memory.separation = shifted - shift * beyond.dot(axis) - radii;
                return Climb::Beyond;
            }
            Walk::Closest { point, simplex: reduced, .. } => {
                let length = point.length();
                let normal = point / length;
                let turn = normal.dot(axis);
                (axis, separation, simplex) = (normal, length - shift * turn, reduced);
                if shift == 0.0 || turn > RESTING {
                    return Climb::Touch(Touch::new(pair, normal, separation, &simplex, scale.size));
                }
            }
        }
    }
    Climb::Failed
}

/// Whether the way out may be shorter elsewhere.
#[inline(always)]
fn is_deep<L: Lanes, B: Core>(pair: &Pair<B>, touch: &Touch, is_new: bool) -> bool {
    let depth = -touch.separation;
    if depth <= SHALLOW * touch.size {
        return depth > 0.0 && is_new;
    }
    let (_, averted) = pair.support::<L>(-touch.normal);
    let width_a = pair.a.support::<L>(touch.normal).1 + pair.a.support::<L>(-touch.normal).1;
    // Minus the separations along both directions is the sum of both widths.
    let width_b = depth - averted - width_a;
    is_new || depth > DEEP * width_a.min(width_b)
}

/// The exact answer only where it is better: of two ways out alike, the pair keeps to the one it came.
fn shallower(local: Touch, exact: Touch) -> Touch {
    if exact.separation > local.separation + SHALLOW * local.size { exact } else { local }
}

impl Touch {
    /// From a simplex and its weights, of a pair that may have been shifted.
    #[inline(always)]
    fn new<B: Core>(pair: &Pair<B>, normal: Vec3, separation: f32, simplex: &Simplex, size: f32) -> Self {
        let (mut on_a, mut on_b) = (Vec3::ZERO, Vec3::ZERO);
        let mut pairs = [[0; 2]; 3];
        let count = simplex.count.min(3);
        for (i, vertex) in simplex.vertices[..count].iter().enumerate() {
            on_a += pair.point_of_a(vertex.pair[0]) * simplex.weights[i];
            on_b += pair.point_of_b(vertex.pair[1]) * simplex.weights[i];
            pairs[i] = vertex.pair;
        }
        Self { normal, separation, on_a, on_b, pairs, count, size }.aligned()
    }

    /// Takes out what a shift left between the points across the normal: on the side of a face or an edge, that of a
    /// vertex is exact.
    #[inline(always)]
    pub(super) fn aligned(mut self) -> Self {
        let across = self.on_b - self.on_a - self.normal * self.separation;
        let share = match (self.corners(0).1, self.corners(1).1) {
            (1, _) => 0.0,
            (_, 1) => 1.0,
            _ => 0.5,
        };
        self.on_a += across * share;
        self.on_b = self.on_a + self.normal * self.separation;
        self
    }
}
