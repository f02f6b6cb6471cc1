//! A rectangular sheet in a small step: threads along rows and columns in turn, a sweep over all sticks, bending.

use super::bend::Lines;
use super::grid::{Grid, Weave};
use super::hot::Windows;
use super::points::{Coordinates, Moving, Points, eights};
use super::stick::Span;
use super::thread::{Pivot, REGULARISATION, Threads};
use crate::simd::{LANES, Lanes, Numbers};

/// A sheet among the points.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    pub(super) grid: Grid,
    pub(super) weave: Weave,
    /// Compliances of bending along every row and along every column, by place as threads are solved: α/h² with the h of
    /// two small steps, in 1/kg; `None` = limp.
    pub(super) bending: Option<[Vec<f32>; 2]>,
    /// 1/m of a particle of mean mass, in 1/kg.
    pub(super) mean_inverse_mass: f32,
    pub(super) windows: Windows,
    turned: Turned,
}

/// Rows as columns, to be solved side by side.
#[derive(Debug, Clone, Default)]
struct Turned {
    start: Coordinates,
    offset: Coordinates,
    masses: Numbers,
}

impl Sheet {
    pub(super) fn new(grid: Grid, weave: Weave, bending: Option<[f32; 2]>, mean_inverse_mass: f32) -> Self {
        let bending = bending.map(|[along, down]| [along_rows(&grid, along), along_columns(&grid, down)]);
        Self {
            grid,
            weave,
            bending,
            mean_inverse_mass,
            windows: Windows::default(),
            turned: Turned::default(),
        }
    }

    /// Bends, and pulls threads tight if some of the sheet is held: along columns in even small steps, along rows in odd
    /// ones. What lies on something is better left to sweeps: threads through its folds would push and pull in turn.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn pull_threads<L: Lanes>(
        &mut self,
        points: &mut Points,
        is_held: bool,
        is_even: bool,
        pivots: &mut Vec<Pivot>,
    ) {
        let Grid { start, columns, rows, .. } = self.grid;
        let bending = self.bending.as_ref().map(|[along, down]| if is_even { &down[..] } else { &along[..] });
        if !is_held && bending.is_none() {
            return;
        }
        if is_even {
            let (stride, span) = (self.grid.stride(), is_held.then_some(self.weave[1]));
            let (mut moving, masses) = points.moving();
            self.solve::<L>(&mut moving, masses, (start, stride, rows, stride), (span, bending), pivots);
        } else {
            let (stride, span) = (rows.next_multiple_of(LANES), is_held.then_some(self.weave[0]));
            let mut turned = std::mem::take(&mut self.turned);
            turned.read::<L>(&self.grid, points, stride);
            let Turned { start, offset, masses } = &mut turned;
            let mut moving = Moving { start, offset };
            self.solve::<L>(&mut moving, masses, (0, stride, columns, stride), (span, bending), pivots);
            turned.write::<L>(&self.grid, points, stride);
            self.turned = turned;
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn solve<L: Lanes>(
        &self,
        moving: &mut Moving<'_>,
        masses: &[f32],
        (start, stride, knots, count): (usize, usize, usize, usize),
        (spans, bending): (Option<Span>, Option<&[f32]>),
        pivots: &mut Vec<Pivot>,
    ) {
        if let Some(spans) = spans {
            let regularisation = REGULARISATION * self.mean_inverse_mass;
            Threads { start, stride, knots, count, spans, regularisation }.solve::<L>(moving, masses, pivots);
        }
        if let Some(compliances) = bending {
            Lines { start, stride, knots, count, compliances }.straighten::<L>(moving, masses);
        }
    }
}

/// Of every row, in the places that rows have when they are solved as columns; the first and the last row carry half a
/// cell, and are twice as soft.
fn along_rows(grid: &Grid, compliance: f32) -> Vec<f32> {
    let mut compliances = vec![compliance; grid.rows.next_multiple_of(LANES)];
    for border in [0, grid.rows - 1] {
        compliances[border] = 2.0 * compliance;
    }
    compliances
}

/// Of every column, in the places of a row.
fn along_columns(grid: &Grid, compliance: f32) -> Vec<f32> {
    let mut compliances = vec![compliance; grid.stride()];
    for border in [0, grid.columns - 1] {
        compliances[grid.place(0, border) - grid.start] = 2.0 * compliance;
    }
    compliances
}

impl Turned {
    /// Copies a sheet, row to column, whose rows then have `stride` places.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn read<L: Lanes>(&mut self, grid: &Grid, points: &Points, stride: usize) {
        let length = grid.stride() * stride;
        let copies = self.start.iter_mut().chain(&mut self.offset);
        for (copy, numbers) in copies.zip(points.start.iter().chain(&points.offset)) {
            copy.resize(length, 0.0);
            turn::<L>(grid, numbers, copy, stride);
        }
        self.masses.resize(length, 0.0);
        turn::<L>(grid, &points.inverse_mass, &mut self.masses, stride);
    }

    #[inline(always)]
    fn write<L: Lanes>(&self, grid: &Grid, points: &mut Points, stride: usize) {
        for (copy, numbers) in self.offset.iter().zip(&mut points.offset) {
            turn_back::<L>(grid, copy, numbers, stride);
        }
    }
}

/// Column c of the sheet becomes row c.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn turn<L: Lanes>(grid: &Grid, numbers: &[f32], turned: &mut [f32], stride: usize) {
    let (numbers, turned) = (eights(numbers), turned.as_chunks_mut::<LANES>().0);
    let (step, stride) = (grid.stride() / LANES, stride / LANES);
    for band in 0..stride {
        let rows = LANES.min(grid.rows - band * LANES);
        for (parity, of_half) in eights_of_row(grid) {
            let from = (grid.start + parity * grid.half) / LANES + of_half + band * LANES * step;
            let mut lanes = [L::splat(0.0); LANES];
            for (k, lanes) in lanes.iter_mut().enumerate().take(rows) {
                *lanes = L::read(&numbers[from + k * step]);
            }
            let to = (2 * of_half * LANES + parity) * stride + band;
            for (k, column) in L::transpose(lanes).into_iter().enumerate() {
                column.write(&mut turned[to + 2 * k * stride]);
            }
        }
    }
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn turn_back<L: Lanes>(grid: &Grid, turned: &[f32], numbers: &mut [f32], stride: usize) {
    let (turned, numbers) = (eights(turned), numbers.as_chunks_mut::<LANES>().0);
    let (step, stride) = (grid.stride() / LANES, stride / LANES);
    for band in 0..stride {
        let rows = LANES.min(grid.rows - band * LANES);
        for (parity, of_half) in eights_of_row(grid) {
            let from = (2 * of_half * LANES + parity) * stride + band;
            let mut lanes = [L::splat(0.0); LANES];
            for (k, lanes) in lanes.iter_mut().enumerate() {
                *lanes = L::read(&turned[from + 2 * k * stride]);
            }
            let to = (grid.start + parity * grid.half) / LANES + of_half + band * LANES * step;
            for (k, row) in L::transpose(lanes).into_iter().enumerate().take(rows) {
                row.write(&mut numbers[to + k * step]);
            }
        }
    }
}

/// Where each run of eight places of a row begins: its parity, and its number in that half.
fn eights_of_row(grid: &Grid) -> impl Iterator<Item = (usize, usize)> + use<> {
    let eights = grid.half / LANES;
    (0..2).flat_map(move |parity| (0..eights).map(move |of_half| (parity, of_half)))
}

#[cfg(test)]
#[path = "tests/sheet.rs"]
mod tests;
