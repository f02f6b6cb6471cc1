//! Hot windows: where a sheet is stretched although the sweep has gone over it, small parts of it are swept again.
//!
//! Almost all the strain that small steps leave is in a few edges, at corners of what the sheet lies on. Sweeping the whole
//! sheet more often would mend the mean, which is fine already; sweeping about the worst edges mends the maximum.

use super::grid::{Grid, Weave, Window};
use super::points::{Coordinates, Points};
use super::touch::Touch;
use crate::simd::{LANES, Lanes, Vec3x8};

/// How far a window reaches from the edge it is about, in edges.
const RADIUS: usize = 6;
/// The most windows of a sheet.
const MOST: usize = 24;
/// What share of a window's motion is not to become velocity.
const STILL: f32 = 0.5;

/// The hot windows of a sheet.
#[derive(Debug, Clone, Default)]
pub(super) struct Windows {
    pub(super) windows: Vec<Window>,
    /// Of each window, the numbers of the touches in it.
    pub(super) touches: Vec<Vec<u32>>,
}

impl Windows {
    /// Looks for edges that are longer than they should be by more than the share `tolerance`.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn find<L: Lanes>(&mut self, grid: &Grid, weave: &Weave, points: &Points, tolerance: f32) {
        self.windows.clear();
        let [along, down] = [weave[0].high, weave[1].high].map(|length| length * (1.0 + tolerance));
        let (half, stride) = (grid.half, grid.stride());
        for row in 0..grid.rows {
            let start = grid.start + row * stride;
            for of_half in (0..half).step_by(LANES) {
                let (even, odd) = (start + of_half, start + half + of_half);
                self.mark::<L>(grid, points, [even, odd], along, (row, 2 * of_half));
                if of_half + LANES < half {
                    self.mark::<L>(grid, points, [odd, even + 1], along, (row, 2 * of_half + 1));
                }
                if row + 1 < grid.rows {
                    self.mark::<L>(grid, points, [even, even + stride], down, (row, 2 * of_half));
                    self.mark::<L>(grid, points, [odd, odd + stride], down, (row, 2 * of_half + 1));
                }
            }
        }
    }

    /// Finds out which touches are in which window.
    pub(super) fn list_touches(&mut self, grid: &Grid, touches: &[Touch]) {
        self.touches.resize(self.windows.len(), Vec::new());
        for (window, listed) in self.windows.iter().zip(&mut self.touches) {
            listed.clear();
            let inside = |(_, touch): &(u32, &Touch)| window.holds(grid, touch.place());
            listed.extend((0..).zip(touches).filter(inside).map(|(number, _)| number));
        }
    }

    /// Puts windows around those of eight sticks, in every second column, that are longer than `most` (m).
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn mark<L: Lanes>(
        &mut self,
        grid: &Grid,
        points: &Points,
        [a, b]: [usize; 2],
        most: f32,
        at: (usize, usize),
    ) {
        let between = Vec3x8::<L>::read(&points.position, b) - Vec3x8::read(&points.position, a);
        let is_long = between.length_squared().greater(L::splat(most * most));
        let mut lanes = is_long.and(points.are_there::<L>(a)).and(points.are_there::<L>(b)).bits();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            self.put(grid, at.0, at.1 + 2 * lane);
        }
    }

    /// Puts a window around an edge, unless it is well inside one.
    fn put(&mut self, grid: &Grid, row: usize, column: usize) {
        let well = RADIUS / 2;
        let is_inside = |range: &std::ops::Range<usize>, at: usize, end: usize| {
            (range.start == 0 || at >= range.start + well) && (range.end == end || at + well < range.end)
        };
        let has = |window: &Window| {
            is_inside(&window.rows, row, grid.rows) && is_inside(&window.columns, column, grid.columns)
        };
        if self.windows.len() < MOST && !self.windows.iter().any(has) {
            let rows = row.saturating_sub(RADIUS)..(row + RADIUS + 1).min(grid.rows);
            let columns = (column.saturating_sub(RADIUS) & !1)..(column + RADIUS + 1).min(grid.columns);
            self.windows.push(Window { rows, columns });
        }
    }
}

impl Window {
    /// Whether any of the eight places from `place` on is in it.
    pub(super) fn holds(&self, grid: &Grid, place: usize) -> bool {
        if !grid.places().contains(&place) {
            return false;
        }
        let (row, in_row) = ((place - grid.start) / grid.stride(), (place - grid.start) % grid.stride());
        let first = 2 * (in_row % grid.half);
        self.rows.contains(&row) && first < self.columns.end && first + 2 * LANES > self.columns.start
    }

    /// The runs of places that it is made of.
    fn runs(&self, grid: &Grid) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let (first, last) = (self.columns.start / 2, self.columns.end.div_ceil(2));
        let (grid, rows) = (*grid, self.rows.clone());
        rows.flat_map(move |row| {
            let start = grid.start + row * grid.stride();
            [0, grid.half].map(|parity| start + parity + first..start + parity + last)
        })
    }

    /// Remembers where its particles are.
    pub(super) fn save(&self, grid: &Grid, positions: &Coordinates, saved: &mut Coordinates) {
        for (numbers, kept) in positions.iter().zip(saved) {
            kept.clear();
            self.runs(grid).for_each(|run| kept.extend_from_slice(&numbers[run]));
        }
    }

    /// Takes a share of how its particles have moved since then out of their velocity.
    pub(super) fn still(&self, grid: &Grid, points: &mut Points, saved: &Coordinates) {
        for (axis, saved) in saved.iter().enumerate() {
            let (positions, displacements) = (&points.position[axis], &mut points.displacement[axis]);
            let mut before = saved.iter();
            for place in self.runs(grid).flatten() {
                let Some(before) = before.next() else { break };
                displacements[place] -= STILL * (positions[place] - before);
            }
        }
    }
}
