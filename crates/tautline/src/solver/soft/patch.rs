//! Which tiles of cloth may touch each other: their boxes, and the cones that hold their normals.

use glam::Vec3;

use super::grid::Grid;
use super::points::{Coordinates, Points};
use super::tile::Tile;
use crate::norm::Norm;
use crate::simd::{LANES, Lanes, Vec3x8};

/// The directions that a tile faces: a mean, and how far from it any of its cells faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cone {
    pub(super) axis: Vec3,
    /// Cosine of the greatest angle to the axis.
    pub(super) cosine: f32,
}

impl Cone {
    /// Holds every direction.
    pub(super) const ALL: Self = Self { axis: Vec3::Y, cosine: -1.0 };

    /// Whether everything in both faces one way within `cosine` of the middle between their axes: a smooth patch that
    /// bends no more than that cannot touch itself.
    pub(super) fn is_smooth_with(&self, other: &Self, cosine: f32) -> bool {
        let between = self.axis.dot(other.axis).clamp(-1.0, 1.0);
        let widest = self.cosine.min(other.cosine);
        // cos(a + b), a half of the angle between the axes, b the widest cone.
        let (cos_a, sin_a) = ((0.5 * (1.0 + between)).sqrt(), (0.5 * (1.0 - between)).sqrt());
        let (cos_b, sin_b) = (widest, (1.0 - widest * widest).max(0.0).sqrt());
        widest > 0.0 && cos_a * cos_b - sin_a * sin_b > cosine
    }
}

/// A cell is folded where the square of its free diagonal is less than this share of that of the other: by 75° and more.
const FOLDED: f32 = 0.63;

/// The cone of a sheet's tile, whose particles are at `positions`, from the diagonals of its cells.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn cone_of<L: Lanes>(grid: &Grid, tile: &Tile, positions: &Coordinates, points: &Points) -> Cone {
    let mut normals = [Vec3x8::<L>::zero(); super::tile::MOST_EIGHTS];
    let mut sum = Vec3x8::<L>::zero();
    let mut folded = 0;
    for (normal, &place) in normals.iter_mut().zip(&tile.eights) {
        let cells = cells::<L>(grid, place as usize, positions, points);
        *normal = cells.0;
        folded |= cells.1.bits();
        sum = sum + *normal;
    }
    if folded != 0 {
        return Cone::ALL;
    }
    let axis = total(sum);
    let length = axis.norm();
    if length < 1e-6 {
        return Cone::ALL;
    }
    let axis = axis / length;
    let mut least = L::splat(1.0);
    for normal in &normals {
        // What is no cell has no direction.
        let is_cell = normal.length_squared().greater(L::splat(0.5));
        least = is_cell.select(normal.dot(Vec3x8::splat(axis)), L::splat(1.0)).min(least);
    }
    Cone { axis, cosine: -(-least).largest() }
}

/// Unit normals of the eight cells whose first corners are these places, 0 where there is no cell; and a mask of those that
/// are folded along the diagonal that holds them, whose halves face different ways.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn cells<L: Lanes>(grid: &Grid, place: usize, positions: &Coordinates, points: &Points) -> (Vec3x8<L>, L) {
    let (stride, half) = (grid.stride(), grid.half);
    let row = (place - grid.start) / stride;
    let none = L::splat(0.0).greater(L::splat(0.0));
    if row + 1 >= grid.rows {
        return (Vec3x8::zero(), none);
    }
    let is_odd = (place - grid.start) % stride >= half;
    let right = if is_odd { place - half + 1 } else { place + half };
    let there = points.are_there::<L>(place).and(points.are_there::<L>(right));
    let down = Vec3x8::<L>::read(positions, right + stride) - Vec3x8::read(positions, place);
    let up = Vec3x8::<L>::read(positions, place + stride) - Vec3x8::read(positions, right);
    let across = down.cross(up);
    let length = across.length_squared().max(L::splat(1e-30)).sqrt();
    let is_folded = (down.length_squared() * L::splat(FOLDED)).greater(up.length_squared());
    (across * there.and(L::splat(1.0) / length), there.and(is_folded))
}

#[inline(always)]
fn total<L: Lanes>(lanes: Vec3x8<L>) -> Vec3 {
    let mut rows = [crate::simd::Row::ZERO; 3];
    lanes.store(&mut rows);
    let sum = |row: &crate::simd::Row| (0..LANES).map(|lane| row.0[lane]).sum::<f32>();
    Vec3::new(sum(&rows[0]), sum(&rows[1]), sum(&rows[2]))
}

#[cfg(test)]
#[path = "tests/patch.rs"]
mod tests;
