//! Tiles: patches of up to 128 particles that are near each other in the material, and the boxes around them.

use std::ops::Range;

use glam::Vec3;

use super::grid::Grid;
use super::points::{Coordinates, Points};
use crate::simd::{LANES, Lanes, Vec3x8};

/// Runs of eight places that a tile has at most.
pub(super) const MOST_EIGHTS: usize = 16;
/// Rows of a tile of a sheet; it has twice as many columns.
const ROWS: usize = 8;

/// A tile: first places of its runs of eight.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tile {
    pub(super) eights: Vec<u32>,
    /// Where it is in its sheet, in tiles: row and column; (number, 0) in what is no sheet.
    pub(super) at: [u32; 2],
}

/// A box, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: Vec3,
    pub(super) high: Vec3,
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    pub(super) fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(super) fn grown(self, by: f32) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }

    /// Touching counts.
    pub(super) fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// The tiles of a sheet.
pub(super) fn tiles_of_grid(grid: &Grid) -> Vec<Tile> {
    let bands = (0..grid.rows).step_by(ROWS);
    bands
        .enumerate()
        .flat_map(|(band, row)| tiles_of_band(grid, row..(row + ROWS).min(grid.rows), band))
        .collect()
}

fn tiles_of_band(grid: &Grid, rows: Range<usize>, band: usize) -> impl Iterator<Item = Tile> {
    let across = (0..grid.columns.div_ceil(2)).step_by(LANES).enumerate();
    across.map(move |(number, of_half)| {
        let eight = |row: usize, parity: usize| {
            (grid.start + row * grid.stride() + parity * grid.half + of_half) as u32
        };
        let eights = rows.clone().flat_map(|row| [eight(row, 0), eight(row, 1)]).collect();
        Tile { eights, at: [band as u32, number as u32] }
    })
}

/// The tiles of places that follow each other.
pub(super) fn tiles_of_run(places: Range<usize>) -> Vec<Tile> {
    let starts: Vec<u32> = places.step_by(LANES).map(|place| place as u32).collect();
    let tile = |(number, eights): (usize, &[u32])| Tile { eights: eights.to_vec(), at: [number as u32, 0] };
    starts.chunks(MOST_EIGHTS).enumerate().map(tile).collect()
}

impl Tile {
    /// The box around its particles.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn bounds<L: Lanes>(&self, points: &Points) -> Bounds {
        let mut around = Around::<L>::nothing();
        for &place in &self.eights {
            around.add(points.are_there(place as usize), points.eight_at(place as usize));
        }
        around.bounds()
    }
}

/// Bounds of many vectors, eight side by side.
pub(super) struct Around<L> {
    low: Vec3x8<L>,
    high: Vec3x8<L>,
}

impl<L: Lanes> Around<L> {
    #[inline(always)]
    pub(super) fn nothing() -> Self {
        Self { low: Vec3x8::splat(Vec3::INFINITY), high: Vec3x8::splat(Vec3::NEG_INFINITY) }
    }

    /// Adds those of eight that are there.
    #[inline(always)]
    pub(super) fn add(&mut self, are_there: L, eight: Vec3x8<L>) {
        let Self { low, high } = self;
        // Of what is no number and another, `min` and `max` give the second.
        let eight = Vec3x8::select(are_there, eight, Vec3x8::splat(Vec3::NAN));
        *low = Vec3x8::new(eight.x.min(low.x), eight.y.min(low.y), eight.z.min(low.z));
        *high = Vec3x8::new(eight.x.max(high.x), eight.y.max(high.y), eight.z.max(high.z));
    }

    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        let (low, high) = (-self.low, self.high);
        Bounds {
            low: -Vec3::new(low.x.largest(), low.y.largest(), low.z.largest()),
            high: Vec3::new(high.x.largest(), high.y.largest(), high.z.largest()),
        }
    }
}

/// Bits of those of the eight places from `place` on that have a particle in a box, when they are at `positions`.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn inside<L: Lanes>(
    points: &Points,
    positions: &Coordinates,
    place: usize,
    bounds: &Bounds,
) -> u32 {
    within(Vec3x8::<L>::read(positions, place), bounds) & points.are_there::<L>(place).bits()
}

/// Bits of those of eight places that are in a box.
#[inline(always)]
pub(super) fn within<L: Lanes>(at: Vec3x8<L>, bounds: &Bounds) -> u32 {
    let (low, high) = (Vec3x8::<L>::splat(bounds.low), Vec3x8::splat(bounds.high));
    let below = low.x.greater(at.x).bits() | low.y.greater(at.y).bits() | low.z.greater(at.z).bits();
    let above = at.x.greater(high.x).bits() | at.y.greater(high.y).bits() | at.z.greater(high.z).bits();
    !(below | above) & ((1 << LANES) - 1)
}

#[cfg(test)]
#[path = "tests/tile.rs"]
mod tests;
