//! What the sun sees: a shadow map with soft edges.

use tautline::Vec3;

use super::camera::basis;
use super::raster::for_each_span;

/// Texels along a side of the map.
const SIZE: usize = 640;
/// Texels along a side of the tiles whose nearest depth is kept to answer most questions at once.
const TILE: usize = 8;
/// The penumbra's half-width, in texels: percentages of light are taken over (2 · 3 + 2)² of them.
const REACH: usize = 3;

/// Orthographic depths towards the sun; greater is nearer to it. Made for a volume, filled for a frame.
#[derive(Debug, Clone)]
pub(super) struct ShadowMap {
    towards_sun: Vec3,
    right: Vec3,
    up: Vec3,
    /// Map coordinates of a point p: (right · p − origin₀, up · p − origin₁) · texels_per_metre.
    origin: [f32; 2],
    texels_per_metre: f32,
    depth: Vec<f32>,
    /// Nearest depth in each tile and the eight around it.
    nearest: Vec<f32>,
}

impl ShadowMap {
    /// A map of everything that will ever be between `low` and `high` (m).
    pub(super) fn new(towards_sun: Vec3, low: Vec3, high: Vec3) -> Self {
        let [right, up, _] = basis(-towards_sun);
        let (center, half) = ((low + high) / 2.0, (high - low) / 2.0);
        // Half the extent of a box along an axis, plus the border that filtering reads.
        let extent = half.dot(right.abs()).max(half.dot(up.abs())).max(1e-3);
        let texels_per_metre = (SIZE - 4 * REACH) as f32 / (2.0 * extent);
        let side = SIZE as f32 / texels_per_metre;
        let origin = [center.dot(right) - side / 2.0, center.dot(up) - side / 2.0];
        let tiles = SIZE.div_ceil(TILE);
        let (depth, nearest) = (vec![f32::MIN; SIZE * SIZE], vec![f32::MIN; tiles * tiles]);
        Self { towards_sun, right, up, origin, texels_per_metre, depth, nearest }
    }

    /// Forgets everything and takes these triangles (world, m) as what casts shadows.
    pub(super) fn fill(&mut self, casters: impl Iterator<Item = [Vec3; 3]>) {
        self.depth.fill(f32::MIN);
        for corners in casters {
            let depth = &mut self.depth;
            let mapped = corners.map(|p| {
                to_map(p, self.right, self.up, self.towards_sun, self.origin, self.texels_per_metre)
            });
            for_each_span(mapped, SIZE, SIZE, |span| {
                for (i, texel) in depth[span.samples.clone()].iter_mut().enumerate() {
                    *texel = texel.max(span.depth(i));
                }
            });
        }
        self.find_nearest();
    }

    fn find_nearest(&mut self) {
        let tiles = SIZE.div_ceil(TILE);
        self.nearest.fill(f32::MIN);
        for (y, row) in self.depth.chunks_exact(SIZE).enumerate() {
            for (tx, texels) in row.chunks(TILE).enumerate() {
                let nearest = texels.iter().fold(f32::MIN, |a, &b| a.max(b));
                if nearest == f32::MIN {
                    continue;
                }
                for ny in (y / TILE).saturating_sub(1)..(y / TILE + 2).min(tiles) {
                    for tile in
                        &mut self.nearest[ny * tiles + tx.saturating_sub(1)..ny * tiles + (tx + 2).min(tiles)]
                    {
                        *tile = tile.max(nearest);
                    }
                }
            }
        }
    }

    /// The share of sunlight, 0 to 1, that reaches a point `p` (m) on a plane with unit normal `normal`, on the
    /// side the sun is on.
    ///
    /// Percentage-closer filtering (Reeves et al. 1987) against the receiver's own plane (Isidoro 2006), so
    /// that a wide filter puts no false shadow on slanted faces.
    pub(super) fn light_at(&self, p: Vec3, normal: Vec3) -> f32 {
        let at = to_map(p, self.right, self.up, self.towards_sun, self.origin, self.texels_per_metre);
        let (x, y) = (at.x - 0.5 - REACH as f32, at.y - 0.5 - REACH as f32);
        let taps = 2 * REACH + 2;
        let limit = (SIZE - taps) as f32;
        if !(x >= 0.0 && y >= 0.0 && x < limit && y < limit) {
            return 1.0;
        }
        let facing = normal.dot(self.towards_sun).max(0.15);
        let slope =
            [-normal.dot(self.right), -normal.dot(self.up)].map(|n| n / (facing * self.texels_per_metre));
        let bias = 1.0 / self.texels_per_metre;
        let least = at.z + bias - (slope[0].abs() + slope[1].abs()) * (REACH as f32 + 1.0);
        let tile = (at.y as usize / TILE) * SIZE.div_ceil(TILE) + at.x as usize / TILE;
        if self.nearest[tile] <= least {
            return 1.0;
        }

        let (column, row) = (x as usize, y as usize);
        let (fx, fy) = (x - column as f32, y - row as f32);
        let mut lit = 0.0;
        for j in 0..taps {
            let start = (row + j) * SIZE + column;
            let along_y = at.z + bias + slope[1] * ((row + j) as f32 + 0.5 - at.y);
            let mut in_row = 0.0;
            for (i, &depth) in self.depth[start..start + taps].iter().enumerate() {
                let reference = along_y + slope[0] * ((column + i) as f32 + 0.5 - at.x);
                in_row += if depth <= reference { tent(i, fx) } else { 0.0 };
            }
            lit += in_row * tent(j, fy);
        }
        lit / (tent_sum(fx) * tent_sum(fy))
    }
}

/// Map coordinates in texels, and the depth in m.
fn to_map(
    p: Vec3,
    right: Vec3,
    up: Vec3,
    towards_sun: Vec3,
    origin: [f32; 2],
    texels_per_metre: f32,
) -> Vec3 {
    let (x, y) = (p.dot(right) - origin[0], p.dot(up) - origin[1]);
    Vec3::new(x * texels_per_metre, y * texels_per_metre, p.dot(towards_sun))
}

/// Weight of the i-th tap of a filter whose middle lies `fraction` after tap `REACH`.
fn tent(i: usize, fraction: f32) -> f32 {
    REACH as f32 + 1.0 - (i as f32 - REACH as f32 - fraction).abs()
}

fn tent_sum(fraction: f32) -> f32 {
    (0..2 * REACH + 2).map(|i| tent(i, fraction)).sum()
}
