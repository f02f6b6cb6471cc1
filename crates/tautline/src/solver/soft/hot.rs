//! Hot windows: where a sheet is stretched although the sweep has gone over it, small parts of it are swept again.
//!
//! Almost all the strain that small steps leave is in a few edges: at corners of what the sheet lies on, and in folds that
//! are pressed together. Sweeping the whole sheet more often would mend the mean, which is fine already; sweeping about the
//! worst edges mends the maximum. What is in a window is pulled in to a limit and no further, and pushed by all that touches
//! it: swept to its lengths, or through what it lies on, it would gain energy.

use super::grid::{Grid, Weave, Window};
use super::points::Points;
use super::strand::Brush;
use super::touch::Touch;
use crate::simd::{LANES, Lanes, Vec3x8};

/// How far a window reaches from the edge it is about, in edges.
const RADIUS: usize = 6;
/// The most windows of a sheet; no more than `Windows::members` has bits.
const MOST: usize = 24;

/// The hot windows of a sheet.
#[derive(Debug, Clone, Default)]
pub(super) struct Windows {
    pub(super) windows: Vec<Window>,
    /// Of each window, what is in it.
    pub(super) contacts: Vec<Contacts>,
    /// By place from the sheet's first on: a bit for each window that it is in.
    members: Vec<u32>,
}

/// What touches a window.
#[derive(Debug, Clone, Default)]
pub(super) struct Contacts {
    /// Numbers of touches.
    pub(super) touches: Vec<u32>,
    /// Numbers of brushes.
    pub(super) brushes: Vec<u32>,
    /// Pairs of particles, and how far they are kept apart (m).
    pub(super) pairs: Vec<([u32; 2], f32)>,
}

impl Contacts {
    pub(super) fn is_empty(&self) -> bool {
        self.touches.is_empty() && self.brushes.is_empty() && self.pairs.is_empty()
    }
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
                let (even, odd, column) = (start + of_half, start + half + of_half, 2 * of_half);
                let (at_even, at_odd) = (points.eight_at::<L>(even), points.eight_at::<L>(odd));
                self.mark(grid, points, [even, odd], at_odd - at_even, along, (row, column));
                if of_half + LANES < half {
                    let between = points.eight_at::<L>(even + 1) - at_odd;
                    self.mark(grid, points, [odd, even + 1], between, along, (row, column + 1));
                }
                if row + 1 < grid.rows {
                    let between = points.eight_at::<L>(even + stride) - at_even;
                    self.mark(grid, points, [even, even + stride], between, down, (row, column));
                    let between = points.eight_at::<L>(odd + stride) - at_odd;
                    self.mark(grid, points, [odd, odd + stride], between, down, (row, column + 1));
                }
            }
        }
    }

    /// Finds out which places are in which window.
    pub(super) fn list_members(&mut self, grid: &Grid) {
        self.members.clear();
        self.members.resize(grid.places().len(), 0);
        self.contacts.resize(self.windows.len(), Contacts::default());
        for (number, window) in self.windows.iter().enumerate() {
            for place in window.runs(grid).flatten() {
                self.members[place - grid.start] |= 1 << number;
            }
        }
    }

    /// Finds out which touches are in which window.
    pub(super) fn list_touches(&mut self, grid: &Grid, touches: &[Touch]) {
        self.contacts.iter_mut().for_each(|contacts| contacts.touches.clear());
        if self.windows.is_empty() {
            return;
        }
        for (number, touch) in (0..).zip(touches) {
            let first = touch.place().wrapping_sub(grid.start);
            let eight = self.members.get(first..first.saturating_add(LANES)).unwrap_or(&[]);
            for window in bits(eight.iter().fold(0, |all, members| all | members)) {
                self.contacts[window].touches.push(number);
            }
        }
    }

    /// Finds out which brushes and pairs are in which window.
    pub(super) fn list_meetings(
        &mut self,
        grid: &Grid,
        brushes: &[Brush],
        pairs: impl Iterator<Item = ([u32; 2], f32)>,
    ) {
        for Contacts { brushes, pairs, .. } in &mut self.contacts {
            brushes.clear();
            pairs.clear();
        }
        if self.windows.is_empty() {
            return;
        }
        for (number, brush) in (0..).zip(brushes) {
            for window in bits(self.members_of(grid, brush.place)) {
                self.contacts[window].brushes.push(number);
            }
        }
        for (pair, distance) in pairs {
            let members = self.members_of(grid, pair[0]) | self.members_of(grid, pair[1]);
            for window in bits(members) {
                self.contacts[window].pairs.push((pair, distance));
            }
        }
    }

    fn members_of(&self, grid: &Grid, place: u32) -> u32 {
        self.members.get((place as usize).wrapping_sub(grid.start)).copied().unwrap_or(0)
    }

    /// Puts windows around those of eight sticks, in every second column, that are longer than `most` (m), given what lies
    /// between their ends.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn mark<L: Lanes>(
        &mut self,
        grid: &Grid,
        points: &Points,
        [a, b]: [usize; 2],
        between: Vec3x8<L>,
        most: f32,
        at: (usize, usize),
    ) {
        let is_long = between.length_squared().greater(L::splat(most * most));
        if is_long.bits() == 0 {
            return;
        }
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

/// The numbers of the bits that are set.
fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (set != 0).then(|| set.trailing_zeros() as usize)?;
        set &= set - 1;
        Some(lowest)
    })
}

impl Window {
    /// The runs of places that it is made of.
    fn runs(&self, grid: &Grid) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let (first, last) = (self.columns.start / 2, self.columns.end.div_ceil(2));
        let (grid, rows) = (*grid, self.rows.clone());
        rows.flat_map(move |row| {
            let start = grid.start + row * grid.stride();
            [0, grid.half].map(|parity| start + parity + first..start + parity + last)
        })
    }
}
