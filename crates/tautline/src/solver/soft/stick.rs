//! Eight sticks at a time.

use super::points::{Moving, MovingEights, eights, first};
use crate::simd::{LANES, Lanes, Row, Vec3x8, read};

/// What lengths a stick may have, and how it gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    /// Least and greatest length at which it is at rest, in m.
    pub(super) low: f32,
    pub(super) high: f32,
    /// α/h², in 1/kg: 0 = stiff.
    pub(super) compliance: f32,
}

/// A span for eight sticks.
#[derive(Clone, Copy)]
pub(super) struct Spans<L> {
    pub(super) low: L,
    pub(super) high: L,
    pub(super) compliance: L,
}

impl<L: Lanes> Spans<L> {
    #[inline(always)]
    pub(super) fn splat(span: Span) -> Self {
        Self { low: L::splat(span.low), high: L::splat(span.high), compliance: L::splat(span.compliance) }
    }
}

/// The spans of sticks that follow each other, eight side by side.
pub(super) trait SpanAt<L: Lanes>: Copy {
    fn span(self, stick: usize) -> Spans<L>;
}

/// All alike.
impl<L: Lanes> SpanAt<L> for Span {
    #[inline(always)]
    fn span(self, _: usize) -> Spans<L> {
        Spans::splat(self)
    }
}

/// Each its own.
impl<L: Lanes> SpanAt<L> for &[[Row; 3]] {
    #[inline(always)]
    fn span(self, stick: usize) -> Spans<L> {
        let [low, high, compliance] = &self[stick];
        Spans { low: L::load(low), high: L::load(high), compliance: L::load(compliance) }
    }
}

/// The bits of a mask that is set in every lane.
const ALL: u32 = (1 << LANES) - 1;

/// How eight sticks want their ends moved, per unit of inverse mass: the end at `from` by the result, the other by its
/// reverse. C = l − (l kept in the span), along what lay between the ends when the small step began, b: s = C l/(r·b (w_a +
/// w_b + α/h²)) (Macklin, Müller and Chentanez 2016, Eq 18, with one iteration). Impulses along r, as it is now, would
/// brake what turns, by ω³h; those along b keep its angular momentum to the last bit that rounding leaves (SHAKE; Ryckaert,
/// Ciccotti and Berendsen 1977). What has turned by more than 60° goes along r. Nothing where both ends are held.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn pull<L: Lanes>(
    between: Vec3x8<L>,
    before: Vec3x8<L>,
    masses: [L; 2],
    spans: Spans<L>,
) -> Vec3x8<L> {
    let free = masses[0] + masses[1];
    let squared = between.length_squared().max(L::splat(1e-24));
    let (length, along) = (squared.sqrt(), between.dot(before));
    let is_steady = along.greater(squared * L::splat(0.5));
    let (direction, along) = if is_steady.bits() == ALL {
        (before, along)
    } else {
        (Vec3x8::select(is_steady, before, between), is_steady.select(along, squared))
    };
    let excess = length - length.max(spans.low).min(spans.high);
    let share = excess * length / (along * (free + spans.compliance));
    direction * free.greater(L::splat(0.0)).and(share)
}

/// Relaxes `count` sticks: number k is from place `a + k` to `b + k`, and no place is in two of them.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn relax_run<L: Lanes>(
    moving: &mut Moving<'_>,
    masses: &[f32],
    (a, b, count): (usize, usize, usize),
    spans: Spans<L>,
) {
    let full = count - count % LANES;
    let (masses_a, masses_b) = (eights(&masses[a..a + full]), eights(&masses[b..b + full]));
    let [mut from, mut to] = moving.two_runs(a, b, full);
    for (eight, (wa, wb)) in masses_a.iter().zip(masses_b).enumerate() {
        let ([start_a, offset_a], [start_b, offset_b]) = (from.read(eight), to.read(eight));
        let (before, masses) = (start_b - start_a, [L::read(wa), L::read(wb)]);
        let pull = pull(before + (offset_b - offset_a), before, masses, spans);
        from.write(eight, offset_a + pull * masses[0]);
        to.write(eight, offset_b - pull * masses[1]);
    }
    if full < count {
        let mask = first::<L>(count - full);
        let (a, b) = (a + full, b + full);
        relax([a, b], moving, [mask.and(read(masses, a)), mask.and(read(masses, b))], spans);
    }
}

/// Relaxes the sticks between the eights of numbers `a` and `b`: those that are set in `mask`, if there is one.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn relax_eights<L: Lanes>(
    moving: &mut MovingEights<'_>,
    masses: &[[f32; LANES]],
    [a, b]: [usize; 2],
    mask: Option<L>,
    spans: Spans<L>,
) {
    let ([start_a, offset_a], [start_b, offset_b]) = (moving.read(a), moving.read(b));
    let mut masses = [L::read(&masses[a]), L::read(&masses[b])];
    if let Some(mask) = mask {
        masses = [mask.and(masses[0]), mask.and(masses[1])];
    }
    let before = start_b - start_a;
    let pull = pull(before + (offset_b - offset_a), before, masses, spans);
    moving.write(a, offset_a + pull * masses[0]);
    moving.write(b, offset_b - pull * masses[1]);
}

/// Relaxes the eight sticks from the places `a` on to those from `b` on.
#[inline(always)]
pub(super) fn relax_spans<L: Lanes>(
    moving: &mut Moving<'_>,
    masses: &[f32],
    [a, b]: [usize; 2],
    spans: Spans<L>,
) {
    relax([a, b], moving, [read(masses, a), read(masses, b)], spans);
}

#[inline(always)]
fn relax<L: Lanes>([a, b]: [usize; 2], moving: &mut Moving<'_>, masses: [L; 2], spans: Spans<L>) {
    let before = Vec3x8::read(moving.start, b) - Vec3x8::read(moving.start, a);
    let apart = Vec3x8::read(moving.offset, b) - Vec3x8::read(moving.offset, a);
    let pull = pull(before + apart, before, masses, spans);
    moving.shift(a, pull * masses[0]);
    moving.shift(b, -(pull * masses[1]));
}

#[cfg(test)]
#[path = "tests/stick.rs"]
mod tests;
