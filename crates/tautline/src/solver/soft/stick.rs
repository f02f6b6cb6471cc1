//! Eight sticks at a time.

use super::points::{Coordinates, add, first};
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

/// How eight sticks want their ends moved, per unit of inverse mass: the end at `from` by the result, the other by its
/// reverse. C = l − (l kept in the span), s = C/(l (w_a + w_b + α/h²)) (Macklin, Müller and Chentanez 2016, Eq 18, with
/// one iteration). Nothing where both ends are held.
#[inline(always)]
pub(super) fn pull<L: Lanes>(between: Vec3x8<L>, masses: [L; 2], spans: Spans<L>) -> Vec3x8<L> {
    let free = masses[0] + masses[1];
    let length = between.length_squared().max(L::splat(1e-24)).sqrt();
    let excess = length - length.max(spans.low).min(spans.high);
    let share = excess / (length * (free + spans.compliance));
    between * free.greater(L::splat(0.0)).and(share)
}

/// Relaxes `count` sticks: number k is from place `a + k` to `b + k`, and no place is in two of them.
#[inline(always)]
pub(super) fn relax_run<L: Lanes>(
    positions: &mut Coordinates,
    masses: &[f32],
    (a, b, count): (usize, usize, usize),
    spans: Spans<L>,
) {
    let full = count - count % LANES;
    let [x, y, z] = positions;
    let (xs, ys, zs) = (two_runs(x, a, b, full), two_runs(y, a, b, full), two_runs(z, a, b, full));
    let masses_a = masses[a..a + full].as_chunks::<LANES>().0;
    let masses_b = masses[b..b + full].as_chunks::<LANES>().0;
    let places = xs.0.iter_mut().zip(xs.1).zip(ys.0.iter_mut().zip(ys.1)).zip(zs.0.iter_mut().zip(zs.1));
    for ((((xa, xb), (ya, yb)), (za, zb)), (wa, wb)) in places.zip(masses_a.iter().zip(masses_b)) {
        let at_a = Vec3x8::new(L::read(xa), L::read(ya), L::read(za));
        let at_b = Vec3x8::new(L::read(xb), L::read(yb), L::read(zb));
        let masses = [L::read(wa), L::read(wb)];
        let pull = pull(at_b - at_a, masses, spans);
        let (moved_a, moved_b) = (at_a + pull * masses[0], at_b - pull * masses[1]);
        moved_a.x.write(xa);
        moved_a.y.write(ya);
        moved_a.z.write(za);
        moved_b.x.write(xb);
        moved_b.y.write(yb);
        moved_b.z.write(zb);
    }
    if full < count {
        let mask = first::<L>(count - full);
        let (a, b) = (a + full, b + full);
        let masses = [mask.and(read(masses, a)), mask.and(read(masses, b))];
        let between = Vec3x8::read(positions, b) - Vec3x8::read(positions, a);
        let pull = pull(between, masses, spans);
        add(positions, a, pull * masses[0]);
        add(positions, b, -(pull * masses[1]));
    }
}

/// Two runs of `length` numbers, from `a` and from `b` on, in groups of eight. They do not overlap.
#[inline(always)]
fn two_runs(numbers: &mut [f32], a: usize, b: usize, length: usize) -> (Eights<'_>, Eights<'_>) {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    let (head, tail) = numbers.split_at_mut(high);
    let first = head[low..low + length].as_chunks_mut::<LANES>().0;
    let second = tail[..length].as_chunks_mut::<LANES>().0;
    if a < b { (first, second) } else { (second, first) }
}

type Eights<'a> = &'a mut [[f32; LANES]];

/// Relaxes the eight sticks from the places `a` on to those from `b` on.
#[inline(always)]
pub(super) fn relax_spans<L: Lanes>(
    positions: &mut Coordinates,
    masses: &[f32],
    [a, b]: [usize; 2],
    spans: Spans<L>,
) {
    let (at_a, at_b) = (Vec3x8::read(positions, a), Vec3x8::read(positions, b));
    let masses = [read::<L>(masses, a), read(masses, b)];
    let pull = pull(at_b - at_a, masses, spans);
    (at_a + pull * masses[0]).write(positions, a);
    (at_b - pull * masses[1]).write(positions, b);
}

#[cfg(test)]
#[path = "tests/stick.rs"]
mod tests;
