//! Ropes, up to eight side by side: solved as threads, then swept.

use super::points::{Coordinates, Moving, Points, get, set};
use super::stick::{Span, SpanAt, Spans, relax_spans};
use super::thread::{Pivot, REGULARISATION, Threads};
use crate::norm::Norm;
use crate::simd::{LANES, Lanes, Numbers, Row};

/// A rope among the points: its particles stand one after another.
#[derive(Debug, Clone)]
pub(super) struct Rope {
    pub(super) start: usize,
    pub(super) spans: Vec<Span>,
}

/// A rope whose heaviest knot weighs more than so many times the mean is solved once more for each of these: the threads'
/// regularisation lets it give by what it carries.
const SOLVED_AGAIN: [f32; 3] = [100.0, 250.0, 500.0];
/// By what share all sticks of a rope must be near their lengths for that.
const NEAR: f32 = 0.05;

/// Ropes side by side.
#[derive(Debug, Clone)]
pub(super) struct Bundle {
    ropes: Vec<Rope>,
    knots: usize,
    spans: Vec<[Row; 3]>,
    /// Of what is swept: sticks that do not give.
    stiff: Vec<[Row; 3]>,
    mean_inverse_mass: f32,
    start: Coordinates,
    offset: Coordinates,
    masses: Numbers,
}

impl Bundle {
    /// At most eight, all of as many knots.
    pub(super) fn new(ropes: Vec<Rope>, mean_inverse_mass: f32) -> Self {
        let knots = ropes.iter().map(|rope| rope.spans.len() + 1).max().unwrap_or(1);
        let mut spans = vec![[Row([1.0; LANES]), Row([1.0; LANES]), Row::ZERO]; knots - 1];
        for (lane, rope) in ropes.iter().enumerate() {
            for (rows, span) in spans.iter_mut().zip(&rope.spans) {
                let numbers = [span.low, span.high, span.compliance];
                rows.iter_mut().zip(numbers).for_each(|(row, number)| row.0[lane] = number);
            }
        }
        // What gives has all its force from being solved along the rope; sweeping it again would double that.
        let mut stiff = spans.clone();
        for [low, high, compliance] in &mut stiff {
            for lane in (0..LANES).filter(|&lane| compliance.0[lane] > 0.0) {
                (low.0[lane], high.0[lane]) = (0.0, f32::MAX);
            }
        }
        let length = (knots + 1) * LANES;
        let zeros = || Numbers::zeros(length);
        let [mut start, offset]: [Coordinates; 2] =
            [[zeros(), zeros(), zeros()], [zeros(), zeros(), zeros()]];
        // What is no knot is apart from its neighbours.
        start[0].iter_mut().enumerate().for_each(|(place, x)| *x = place as f32);
        Self { ropes, knots, spans, stiff, mean_inverse_mass, start, offset, masses: zeros() }
    }

    /// Solves all sticks of each rope together and sweeps once over them; again for ropes that carry much.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn solve<L: Lanes>(&mut self, points: &mut Points, pivots: &mut Vec<Pivot>) {
        self.read(points);
        self.pull::<L>(pivots);
        let solves = self.solves(points);
        let most = solves.into_iter().fold(1, u32::max);
        for done in 1..most {
            (0..self.ropes.len()).filter(|&lane| solves[lane] == done).for_each(|lane| self.hold(lane));
            self.pull::<L>(pivots);
        }
        self.write(points);
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn pull<L: Lanes>(&mut self, pivots: &mut Vec<Pivot>) {
        let Self { knots, spans, stiff, mean_inverse_mass, start, offset, masses, .. } = self;
        let mut moving = Moving { start, offset };
        let threads = Threads {
            start: 0,
            stride: LANES,
            knots: *knots,
            count: LANES,
            spans: &spans[..],
            regularisation: REGULARISATION * *mean_inverse_mass,
        };
        threads.solve::<L>(&mut moving, masses, pivots);
        for stick in 0..*knots - 1 {
            let of_stick: Spans<L> = (&stiff[..]).span(stick);
            relax_spans(&mut moving, masses, [stick * LANES, (stick + 1) * LANES], of_stick);
        }
    }

    /// How often each rope is to be solved. That follows from masses and not from what is too long, so that what hangs still
    /// is pulled alike from small step to small step.
    fn solves(&self, points: &Points) -> [u32; LANES] {
        let mut solves = [1; LANES];
        for (lane, (rope, solves)) in self.ropes.iter().zip(&mut solves).enumerate() {
            let masses = &points.inverse_mass[rope.start..=rope.start + rope.spans.len()];
            let heaviest = masses.iter().copied().filter(|&w| w > 0.0).fold(f32::MAX, f32::min);
            let load = self.mean_inverse_mass / heaviest;
            *solves += SOLVED_AGAIN.iter().filter(|&&from| load > from).count() as u32;
            if *solves > 1 && !self.is_taut(lane) {
                *solves = 1;
            }
        }
        solves
    }

    /// Whether all sticks of a rope are near their lengths, and none gives. One that is pushed together gets no better by
    /// being solved again, and what gives has had its force.
    fn is_taut(&self, lane: usize) -> bool {
        let place = |knot: usize| knot * LANES + lane;
        let at = |knot: usize| get(&self.start, place(knot)) + get(&self.offset, place(knot));
        let is_near = |stick: usize| {
            let [low, high, compliance] = &self.spans[stick];
            let length = at(stick).distance_to(at(stick + 1));
            let is_in = length > low.0[lane] * (1.0 - NEAR) && length < high.0[lane] * (1.0 + NEAR);
            is_in && compliance.0[lane] == 0.0
        };
        (0..self.ropes[lane].spans.len()).all(is_near)
    }

    /// Leaves a rope as it is for what is still to be solved.
    fn hold(&mut self, lane: usize) {
        (0..self.knots).for_each(|knot| self.masses[knot * LANES + lane] = 0.0);
    }

    /// Scales the lengths of the rope that starts at a place, if it is one of these, to so many times what they were laid
    /// out at.
    pub(super) fn scale(&mut self, start: usize, factor: f32) {
        let Some(lane) = self.ropes.iter().position(|rope| rope.start == start) else { return };
        for ([low, high, _], span) in self.spans.iter_mut().zip(&self.ropes[lane].spans) {
            (low.0[lane], high.0[lane]) = (span.low * factor, span.high * factor);
        }
    }

    fn read(&mut self, points: &Points) {
        for (lane, rope) in self.ropes.iter().enumerate() {
            for knot in 0..=rope.spans.len() {
                let (from, to) = (rope.start + knot, knot * LANES + lane);
                set(&mut self.start, to, get(&points.start, from));
                set(&mut self.offset, to, get(&points.offset, from));
                self.masses[to] = points.inverse_mass[from];
            }
        }
    }

    fn write(&self, points: &mut Points) {
        for (lane, rope) in self.ropes.iter().enumerate() {
            for knot in 0..=rope.spans.len() {
                let (from, to) = (knot * LANES + lane, rope.start + knot);
                set(&mut points.offset, to, get(&self.offset, from));
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/ropes.rs"]
mod tests;
