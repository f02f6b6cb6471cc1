//! A rectangular sheet: its particles stand in rows that are split by parity, [even columns | odd columns], so that no
//! two sticks of a run share a particle and every run is read and written as it lies in memory.

use std::ops::Range;

use super::points::{Knots, Moving};
use super::stick::{Span, Spans, relax_runs};
use crate::simd::{LANES, Lanes};

/// So many rows are relaxed in one colour before the next: a processor waits for what it has just written if it reads it
/// otherwise aligned.
const BLOCK: usize = 8;

/// Where the particles of a sheet stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    /// The place of the first.
    pub(super) start: usize,
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Places of a parity in a row.
    pub(super) half: usize,
}

/// The spans of a sheet's sticks: along rows, along columns, across cells.
pub(super) type Weave = [Span; 3];

/// A window of a sheet: rows, and columns from an even one on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Window {
    pub(super) rows: Range<usize>,
    pub(super) columns: Range<usize>,
}

impl Grid {
    pub(super) fn new(start: usize, columns: usize, rows: usize) -> Self {
        // One beyond, since runs of odd columns reach one place further.
        let half = (columns.div_ceil(2) + 1).next_multiple_of(LANES);
        Self { start, columns, rows, half }
    }

    /// Places from row to row.
    pub(super) fn stride(&self) -> usize {
        2 * self.half
    }

    pub(super) fn places(&self) -> Range<usize> {
        self.start..self.start + self.rows * self.stride()
    }

    pub(super) fn place(&self, row: usize, column: usize) -> usize {
        self.start + row * self.stride() + (column & 1) * self.half + column / 2
    }

    pub(super) fn whole(&self) -> Window {
        Window { rows: 0..self.rows, columns: 0..self.columns }
    }

    /// Relaxes every stick once, colour by colour: along rows, along columns, across cells. In this order a sweep
    /// spreads alike in all directions; in the order of rows, two that alternate blow sheets up. Where something is held,
    /// the two colours across cells are to take turns at being the last: under a load, what is always relaxed last always
    /// pushes, and a hung sheet trembles. Loose sheets that collide gain energy by turns.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn sweep<L: Lanes>(
        &self,
        moving: &mut Moving<'_>,
        masses: &[f32],
        window: &Window,
        (weave, is_even): (&Weave, bool),
    ) {
        let [along, down, across] =
            [Spans::<L>::splat(weave[0]), Spans::splat(weave[1]), Spans::splat(weave[2])];
        let (columns, half, stride) = (window.columns.len(), self.half, self.stride());
        let first = self.start + window.columns.start / 2;
        let (even, odd) = (columns.div_ceil(2), columns / 2);
        // Sticks from even columns and from odd ones.
        let (from_even, from_odd) = (odd, columns.saturating_sub(1) / 2);
        let mut knots = Knots::of(moving, masses);
        let Range { start: top, end: bottom } = window.rows.clone();
        for block in window.rows.clone().step_by(BLOCK) {
            let (place, rows) = (first + block * stride, BLOCK.min(bottom - block));
            relax_runs(&mut knots, (place, place + half, from_even), (rows, stride), along);
            relax_runs(&mut knots, (place + half, place + 1, from_odd), (rows, stride), along);
        }
        for parity in 0..2 {
            for row in (top + parity..bottom - 1).step_by(2) {
                let place = first + row * stride;
                relax_runs(&mut knots, (place, place + stride, even), (1, 0), down);
                relax_runs(&mut knots, (place + half, place + half + stride, odd), (1, 0), down);
            }
        }
        for parity in if is_even { [0, 1] } else { [1, 0] } {
            for block in (top + parity..bottom - 1).step_by(BLOCK) {
                let (place, rows) = (first + block * stride, BLOCK.min(bottom - block) / 2);
                let runs = (rows, 2 * stride);
                relax_runs(&mut knots, (place, place + stride + half, from_even), runs, across);
                relax_runs(&mut knots, (place + half, place + stride + 1, from_odd), runs, across);
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/grid.rs"]
mod tests;
