//! Sticks in any order, in batches of eight that share no particle: for cloth that is no rectangular grid, and nets.

use super::points::Points;
use super::stick::{Span, Spans, pull};
use crate::simd::{LANES, Lanes, Row, Vec3x8, column};

/// Eight sticks: where they begin and end, and their spans. What is missing in the last has no mass on either side.
#[derive(Debug, Clone)]
struct Batch {
    ends: [[u32; LANES]; 2],
    spans: [Row; 3],
    count: usize,
}

/// The colour of each group of places: the first one in which no group has a place of it (greedy colouring). What finds
/// none among the first 63 has the last, which they do not share.
pub(crate) fn colors<const N: usize>(groups: &[[u32; N]]) -> Vec<u32> {
    let places = groups.iter().flatten().max().map_or(0, |&most| most as usize + 1);
    let mut taken: Vec<u64> = vec![0; places];
    let color_of = |group: &[u32; N]| {
        let used = group.iter().fold(0, |used, &place| used | taken[place as usize]);
        let color = used.trailing_ones().min(63);
        group.iter().for_each(|&place| taken[place as usize] |= 1 << color);
        color
    };
    groups.iter().map(color_of).collect()
}

/// Numbers of groups of places, in batches of at most eight groups of which no two have a place in common.
pub(super) fn without_sharing<const N: usize>(groups: &[[u32; N]]) -> Vec<Vec<usize>> {
    let mut colours: Vec<Vec<usize>> = Vec::new();
    for (number, colour) in colors(groups).into_iter().enumerate() {
        if colour as usize >= colours.len() {
            colours.resize(colour as usize + 1, Vec::new());
        }
        colours[colour as usize].push(number);
    }
    // What has no colour left goes alone.
    let size = |colour| if colour == 63 { 1 } else { LANES };
    let batches = colours.iter().enumerate();
    batches.flat_map(|(colour, members)| members.chunks(size(colour)).map(<[usize]>::to_vec)).collect()
}

/// All sticks of a piece.
#[derive(Debug, Clone)]
pub(super) struct Batches {
    batches: Vec<Batch>,
    /// How much longer than they were laid out they are.
    pub(super) scale: f32,
}

impl Batches {
    /// Of sticks between places.
    pub(super) fn new(sticks: &[([u32; 2], Span)]) -> Self {
        let ends: Vec<[u32; 2]> = sticks.iter().map(|(ends, _)| *ends).collect();
        let batches = without_sharing(&ends).iter().map(|members| Batch::new(sticks, members)).collect();
        Self { batches, scale: 1.0 }
    }

    /// Relaxes every stick once.
    #[inline(always)]
    pub(super) fn sweep<L: Lanes>(&self, points: &mut Points) {
        for batch in &self.batches {
            batch.relax::<L>(points, self.scale);
        }
    }
}

impl Batch {
    fn new(sticks: &[([u32; 2], Span)], members: &[usize]) -> Self {
        let mut batch = Self { ends: [[0; LANES]; 2], spans: [Row::ZERO; 3], count: members.len() };
        for (lane, &member) in members.iter().enumerate() {
            let ([a, b], span) = sticks[member];
            (batch.ends[0][lane], batch.ends[1][lane]) = (a, b);
            let numbers = [span.low, span.high, span.compliance];
            batch.spans.iter_mut().zip(numbers).for_each(|(row, number)| row.0[lane] = number);
        }
        batch
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn relax<L: Lanes>(&self, points: &mut Points, scale: f32) {
        let (mut between, mut before, mut free) = ([Row::ZERO; 3], [Row::ZERO; 3], [Row::ZERO; 2]);
        for lane in 0..self.count {
            let (a, b) = (self.ends[0][lane] as usize, self.ends[1][lane] as usize);
            for (row, numbers) in before.iter_mut().zip(&points.start) {
                row.0[lane] = numbers[b] - numbers[a];
            }
            for (axis, numbers) in points.offset.iter().enumerate() {
                between[axis].0[lane] = before[axis].0[lane] + (numbers[b] - numbers[a]);
            }
            (free[0].0[lane], free[1].0[lane]) = (points.inverse_mass[a], points.inverse_mass[b]);
        }
        let [low, high, compliance] = &self.spans;
        let scale = L::splat(scale);
        let [low, high] = [L::load(low) * scale, L::load(high) * scale];
        let spans = Spans { low, high, compliance: L::load(compliance) };
        let [first, second] = [L::load(&free[0]), L::load(&free[1])];
        let pull = pull(Vec3x8::load(&between), Vec3x8::load(&before), [first, second], spans);
        let mut shifts = [[Row::ZERO; 3]; 2];
        (pull * first).store(&mut shifts[0]);
        (pull * second).store(&mut shifts[1]);
        for lane in 0..self.count {
            let (a, b) = (self.ends[0][lane] as usize, self.ends[1][lane] as usize);
            points.shift(a, column(&shifts[0], lane));
            points.shift(b, -column(&shifts[1], lane));
        }
    }
}

#[cfg(test)]
#[path = "tests/batch.rs"]
mod tests;
