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
use super::scale::Scale;
use super::simplex::Simplex;
use super::walk::{Walk, walk};
use crate::norm::Norm;
use crate::simd::Lanes;

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
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
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

/// Which answer to a deep overlap is wanted.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Search {
    /// The least depth of all.
    Global,
    /// The least depth next to the remembered axis.
    Local,
}

/// What the remembered axis tells of a pair that may touch.
pub(super) struct Start {
    /// Whether nothing was remembered.
    pub(super) is_new: bool,
    pub(super) scale: Scale,
    /// The foremost corners along the axis, and how far the cores are apart along it, in m.
    support: [u16; 2],
    separation: f32,
}

impl Start {
    /// `None` if the axis shows the surfaces to be further apart than `margin`. `axis`, unit, is that of a pair
    /// without memory.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn new<L: Lanes, B: Core>(
        pair: &Pair<B>,
        memory: &mut Memory,
        axis: Vec3,
        margin: f32,
    ) -> Option<Self> {
        let is_new = !memory.is_usable(pair);
        if is_new {
            *memory = Memory::of_axis(axis);
        }
        let (support, separation) = pair.support::<L>(memory.axis);
        // Not `>`: what is not a number touches nothing.
        let may_touch = separation - pair.radii() <= margin;
        may_touch.then(|| Self { is_new, scale: Scale::at(pair, support), support, separation })
    }

    /// Where the remembered axis does not separate the cores: what starts from another one, if that is better.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn or_along<L: Lanes, B: Core>(
        self,
        pair: &Pair<B>,
        memory: &mut Memory,
        axis: Vec3,
        margin: f32,
    ) -> Option<Self> {
        if self.separation > 0.0 || pair.support::<L>(axis).1 <= self.separation {
            return Some(self);
        }
        *memory = Memory::default();
        Self::new::<L, B>(pair, memory, axis, margin)
    }
}

/// Where the surfaces are nearest, or `None` if they are further apart than `margin`. Both ways the memory is
/// brought up to date.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn find<L: Lanes, B: Core>(
    pair: &Pair<B>,
    (memory, scratch): (&mut Memory, &mut Scratch),
    start: &Start,
    margin: f32,
    search: Search,
) -> Option<Touch> {
    let mut exact = |axis| exact::touch(pair, scratch, axis, start.scale.size);
    let found = match climb::<L, B>(pair, memory, start, margin) {
        Climb::Beyond => return None,
        Climb::Failed => {
            let touch = exact(memory.axis);
            let leads_elsewhere = touch.separation <= 0.0 && search == Search::Local;
            if leads_elsewhere { Touch::foremost(pair, memory.axis, start) } else { touch }
        }
        Climb::Touch(local) => {
            let Touch { normal, separation, size, .. } = local;
            if search == Search::Global && is_deep::<L, B>(pair, normal, separation, size, start.is_new) {
                shallower(local, exact(memory.axis))
            } else {
                local
            }
        }
    };
    memory.keep(&found);
    (found.separation - pair.radii() <= margin).then_some(found)
}

enum Climb {
    Beyond,
    Touch(Touch),
    /// The axis does not rest, or rounding stood in the way.
    Failed,
}

/// Shifted GJK from the remembered axis.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn climb<L: Lanes, B: Core>(pair: &Pair<B>, memory: &mut Memory, start: &Start, margin: f32) -> Climb {
    let radii = pair.radii();
    let &Start { scale, support, mut separation, .. } = start;
    let mut axis = memory.axis;
    let mut simplex = memory.simplex(support);
    for _ in 0..ROUNDS {
        let shift = scale.shift(separation);
        match walk::<L, B>(pair, axis * shift, simplex, margin + radii + shift, scale.coordinates) {
            Walk::Failed => return Climb::Failed,
            Walk::Beyond { axis: beyond } => {
                memory.axis = beyond;
                return Climb::Beyond;
            }
            Walk::Closest { point, simplex: reduced } => {
                let length = point.norm();
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

/// Whether the way out of an overlap, `-separation` deep along `normal`, may be shorter elsewhere.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn is_deep<L: Lanes, B: Core>(
    pair: &Pair<B>,
    normal: Vec3,
    separation: f32,
    size: f32,
    is_new: bool,
) -> bool {
    if separation >= -SHALLOW * size {
        return is_new && separation < 0.0;
    }
    let (_, averted) = pair.support::<L>(-normal);
    let width_a = pair.a.support::<L>(normal).1 + pair.a.support::<L>(-normal).1;
    // Minus the separations along both directions is the sum of both widths.
    let width_b = -separation - averted - width_a;
    is_new || separation < -DEEP * width_a.min(width_b)
}

/// The exact answer only where it is better: of two ways out alike, the pair keeps to the one it came.
fn shallower(local: Touch, exact: Touch) -> Touch {
    if exact.separation > local.separation + SHALLOW * local.size { exact } else { local }
}

impl Touch {
    /// Of the corners foremost along an axis.
    fn foremost<B: Core>(pair: &Pair<B>, axis: Vec3, start: &Start) -> Self {
        let on_a = pair.point_of_a(start.support[0]);
        Self {
            normal: axis,
            separation: start.separation,
            on_a,
            on_b: on_a + axis * start.separation,
            pairs: [start.support; 3],
            count: 1,
            size: start.scale.size,
        }
    }

    /// From a simplex and its weights, of a pair that may have been shifted.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
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
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
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
