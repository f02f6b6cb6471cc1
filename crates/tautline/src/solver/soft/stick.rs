//! Eight sticks at a time.

use super::points::{Knots, Moving, first};
use crate::simd::{LANES, Lanes, Row, Vec3x8};

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

    /// Those of the first `count`; the others may have any length.
    #[inline(always)]
    fn of_first(self, count: usize) -> Self {
        let is_in = first::<L>(count);
        let [low, high] = [is_in.and(self.low), is_in.select(self.high, L::splat(f32::INFINITY))];
        Self { low, high, ..self }
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

/// Relaxes runs of `count` sticks, of which each is `stride` places from the one before: number k of the first is from place
/// `a + k` to `b + k`, and no place is in two of them. What lies beyond is read and written too, but not changed. Runs go
/// side by side: where the last eight of one reach over places that its first have just written, a processor waits.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn relax_runs<L: Lanes>(
    knots: &mut Knots<'_>,
    (a, b, count): (usize, usize, usize),
    (runs, stride): (usize, usize),
    spans: Spans<L>,
) {
    let last = spans.of_first(count % LANES);
    for k in (0..count).step_by(LANES) {
        let spans = if k + LANES <= count { spans } else { last };
        for run in 0..runs {
            relax(knots, [a + k + run * stride, b + k + run * stride], spans);
        }
    }
}

#[inline(always)]
fn relax<L: Lanes>(knots: &mut Knots<'_>, [a, b]: [usize; 2], spans: Spans<L>) {
    // Told here, it need not be told at each reading.
    if !(knots.has_eight_at(a) && knots.has_eight_at(b)) {
        return;
    }
    let ([start_a, offset_a], [start_b, offset_b]) = (knots.read(a), knots.read(b));
    let masses = [knots.inverse_masses(a), knots.inverse_masses(b)];
    let before = start_b - start_a;
    let pull = pull(before + (offset_b - offset_a), before, masses, spans);
    // Where the last sticks of a run of few end, the first ones may begin: what is theirs is written last.
    knots.write(b, offset_b - pull * masses[1]);
    knots.write(a, offset_a + pull * masses[0]);
}

/// Relaxes the eight sticks from the places `a` on to those from `b` on.
#[inline(always)]
pub(super) fn relax_spans<L: Lanes>(
    moving: &mut Moving<'_>,
    masses: &[f32],
    [a, b]: [usize; 2],
    spans: Spans<L>,
) {
    relax_runs(&mut Knots::of(moving, masses), (a, b, LANES), (1, 0), spans);
}

#[cfg(test)]
#[path = "tests/stick.rs"]
mod tests;
