//! What the sun sees: a shadow map with soft edges.

use tautline::Vec3;

use super::camera::basis;
use super::raster::for_each_span;
use super::shade::refill;

/// Texels along a side of the map.
const SIZE: usize = 640;
/// Texels along a side of the tiles whose greatest height is kept, to answer most questions at once.
const TILE: usize = 8;
const TILES: usize = SIZE / TILE;
/// The penumbra's half-width, in texels, and how many of them in a row the filter reads.
const REACH: usize = 3;
const TAPS: usize = 2 * REACH + 2;

/// The sun and the window through which it is looked from: the same for all frames.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sun {
    /// Unit direction to it.
    pub(super) direction: Vec3,
    right: Vec3,
    up: Vec3,
    /// The window's corner along `right` and `up`, in m.
    corner: [f32; 2],
    texels_per_metre: f32,
}

impl Sun {
    /// The sun over everything that will ever be between `low` and `high` (m).
    pub(super) fn new(direction: Vec3, low: Vec3, high: Vec3) -> Self {
        let [right, up, _] = basis(-direction);
        let (center, half) = ((low + high) / 2.0, (high - low) / 2.0);
        // Half the extent of a box along an axis, plus the border that filtering reads.
        let extent = half.dot(right.abs()).max(half.dot(up.abs())).max(1e-3);
        let texels_per_metre = (SIZE - 4 * REACH) as f32 / (2.0 * extent);
        let half_side = SIZE as f32 / texels_per_metre / 2.0;
        let corner = [center.dot(right) - half_side, center.dot(up) - half_side];
        Self { direction, right, up, corner, texels_per_metre }
    }

    /// Map coordinates in texels, and the height towards the sun in m.
    fn to_map(self, p: Vec3) -> Vec3 {
        let (x, y) = (p.dot(self.right) - self.corner[0], p.dot(self.up) - self.corner[1]);
        Vec3::new(x * self.texels_per_metre, y * self.texels_per_metre, p.dot(self.direction))
    }
}

/// What the sun sees in one frame.
pub(super) struct ShadowMap<'a> {
    sun: Sun,
    /// Height (m) towards the sun of what it sees at each texel; the least number where that is nothing.
    height: &'a [f32],
    /// The greatest height in each tile and the eight around it.
    highest: Vec<f32>,
}

impl<'a> ShadowMap<'a> {
    /// The shadows of these triangles (world, m), kept in `memory`.
    pub(super) fn cast(sun: Sun, casters: impl Iterator<Item = [Vec3; 3]>, memory: &'a mut Vec<f32>) -> Self {
        let height = refill(memory, SIZE * SIZE, f32::MIN);
        for corners in casters {
            for_each_span(corners.map(|p| sun.to_map(p)), SIZE, SIZE, |span| {
                for (i, texel) in height[span.samples.clone()].iter_mut().enumerate() {
                    *texel = texel.max(span.depth(i));
                }
            });
        }
        Self { sun, highest: highest_around(height), height }
    }

    /// The share of sunlight, 0 to 1, that reaches a point `p` (m) on a plane with unit normal `normal`, on the
    /// side the sun is on.
    ///
    /// Percentage-closer filtering (Reeves et al. 1987) against the receiver's own plane (Isidoro 2006), so
    /// that a wide filter puts no false shadow on slanted faces.
    pub(super) fn light_at(&self, p: Vec3, normal: Vec3) -> f32 {
        let sun = &self.sun;
        let at = sun.to_map(p);
        let (x, y) = (at.x - 0.5 - REACH as f32, at.y - 0.5 - REACH as f32);
        let limit = (SIZE - TAPS) as f32;
        if !(x >= 0.0 && y >= 0.0 && x < limit && y < limit) {
            return 1.0;
        }
        let facing = normal.dot(sun.direction).max(0.15);
        let slope =
            [-normal.dot(sun.right), -normal.dot(sun.up)].map(|n| n / (facing * sun.texels_per_metre));
        let bias = 1.0 / sun.texels_per_metre;
        let least = at.z + bias - (slope[0].abs() + slope[1].abs()) * (REACH as f32 + 1.0);
        let tile = (at.y as usize / TILE) * TILES + at.x as usize / TILE;
        if self.highest[tile] <= least {
            return 1.0;
        }

        let (column, row) = (x as usize, y as usize);
        let weights_x = tents(x - column as f32);
        let weights_y = tents(y - row as f32);
        let first_x = slope[0] * (column as f32 + 0.5 - at.x);
        let mut lit = 0.0;
        for (j, weight_y) in weights_y.into_iter().enumerate() {
            let start = (row + j) * SIZE + column;
            let mut reference = at.z + bias + slope[1] * ((row + j) as f32 + 0.5 - at.y) + first_x;
            let mut in_row = 0.0;
            for (&height, weight_x) in self.height[start..start + TAPS].iter().zip(weights_x) {
                in_row += if height <= reference { weight_x } else { 0.0 };
                reference += slope[0];
            }
            lit += in_row * weight_y;
        }
        lit / TENT_SUM / TENT_SUM
    }
}

/// The greatest height in each tile and the eight around it.
fn highest_around(height: &[f32]) -> Vec<f32> {
    let mut highest = vec![f32::MIN; TILES * TILES];
    let around = |tile: usize| tile.saturating_sub(1)..(tile + 2).min(TILES);
    for (y, row) in height.chunks_exact(SIZE).enumerate() {
        for (tile_x, texels) in row.chunks_exact(TILE).enumerate() {
            let height = texels.iter().fold(f32::MIN, |a, &b| a.max(b));
            if height == f32::MIN {
                continue;
            }
            for tile in around(y / TILE).flat_map(|ty| around(tile_x).map(move |tx| ty * TILES + tx)) {
                highest[tile] = highest[tile].max(height);
            }
        }
    }
    highest
}

/// Weights of a filter whose middle lies `fraction` after tap [`REACH`].
fn tents(fraction: f32) -> [f32; TAPS] {
    std::array::from_fn(|i| REACH as f32 + 1.0 - (i as f32 - REACH as f32 - fraction).abs())
}

/// Their sum, wherever the middle lies.
const TENT_SUM: f32 = ((REACH + 1) * (REACH + 1)) as f32;
