//! Triangles to spans of samples, with exact coverage.
//!
//! Corners are snapped to sixteenths of a sample and edges evaluated in integers, so that neighbours leave no
//! cracks between them and every machine fills the same samples.

use std::ops::Range;

use tautline::Vec3;

/// Steps of the grid that corners are snapped to, per sample.
const SUBSAMPLES: i64 = 16;

/// Samples side by side in one row, and their depths.
pub(super) struct Span {
    /// Indices into a buffer of the grid's width × height, row by row.
    pub(super) samples: Range<usize>,
    first_depth: f32,
    slope: f32,
    bounds: [f32; 2],
}

impl Span {
    /// Depth of the i-th sample. Clamped to the corners' depths: slivers have wild slopes.
    pub(super) fn depth(&self, i: usize) -> f32 {
        (self.first_depth + self.slope * i as f32).clamp(self.bounds[0], self.bounds[1])
    }
}

/// Hands out the spans of a triangle, either way round, with corners (x, y in samples, depth), inside a grid.
/// Samples lie at half-integer coordinates; those on an edge are included.
pub(super) fn for_each_span(corners: [Vec3; 3], width: usize, height: usize, mut fill: impl FnMut(Span)) {
    let mut points = corners.map(|c| [snap(c.x), snap(c.y)]);
    let mut depths = corners.map(|c| c.z);
    let mut area = cross(points[0], points[1], points[2]);
    if area < 0 {
        points.swap(1, 2);
        depths.swap(1, 2);
        area = -area;
    }
    if area == 0 {
        return;
    }
    let [p, q, r] = points.map(|p| p.map(|c| c as f32 / SUBSAMPLES as f32));
    let doubled_area = area as f32 / (SUBSAMPLES * SUBSAMPLES) as f32;
    let (dq, dr) = (depths[1] - depths[0], depths[2] - depths[0]);
    let slope = (dq * (r[1] - p[1]) - dr * (q[1] - p[1])) / doubled_area;
    let rise = (dr * (q[0] - p[0]) - dq * (r[0] - p[0])) / doubled_area;
    let bounds = [depths[0].min(depths[1]).min(depths[2]), depths[0].max(depths[1]).max(depths[2])];

    for y in covered(points.map(|p| p[1]), height) {
        let Some(columns) = row_columns(&points, y, width) else { continue };
        let (x, y) = (columns.start as f32 + 0.5, y as f32 + 0.5);
        let first_depth = depths[0] + slope * (x - p[0]) + rise * (y - p[1]);
        let row = (y as usize) * width;
        fill(Span { samples: row + columns.start..row + columns.end, first_depth, slope, bounds });
    }
}

fn snap(coordinate: f32) -> i64 {
    (coordinate * SUBSAMPLES as f32).round() as i64
}

fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The samples along one axis between the least and the greatest coordinate.
fn covered(coordinates: [i64; 3], count: usize) -> Range<usize> {
    let [a, b, c] = coordinates;
    let first = div_ceil(a.min(b).min(c) - SUBSAMPLES / 2, SUBSAMPLES).max(0);
    let last = (a.max(b).max(c) - SUBSAMPLES / 2).div_euclid(SUBSAMPLES).min(count as i64 - 1);
    first as usize..(last + 1).max(first) as usize
}

/// The columns of a row on the inner side of all three edges.
fn row_columns(points: &[[i64; 2]; 3], row: usize, width: usize) -> Option<Range<usize>> {
    let y = row as i64 * SUBSAMPLES + SUBSAMPLES / 2;
    let (mut first, mut last) = (0, width as i64 - 1);
    for i in 0..3 {
        let (a, b) = (points[i], points[(i + 1) % 3]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        // Inside: dx (y − a_y) − dy (x − a_x) ≥ 0 at x = 16 column + 8.
        let level = dx * (y - a[1]) + dy * (a[0] - SUBSAMPLES / 2);
        match dy {
            0 if level < 0 => return None,
            0 => {}
            1.. => last = last.min(level.div_euclid(SUBSAMPLES * dy)),
            _ => first = first.max(div_ceil(-level, SUBSAMPLES * -dy)),
        }
    }
    (first <= last).then(|| first as usize..last as usize + 1)
}

fn div_ceil(numerator: i64, positive: i64) -> i64 {
    -(-numerator).div_euclid(positive)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: usize = 24;

    fn coverage(corners: [Vec3; 3]) -> Vec<usize> {
        let mut hits = vec![0; SIZE * SIZE];
        for_each_span(corners, SIZE, SIZE, |span| span.samples.for_each(|i| hits[i] += 1));
        hits
    }

    fn corner() -> impl proptest::strategy::Strategy<Value = Vec3> {
        use proptest::prelude::*;
        (-160..560, -160..560, 1..100)
            .prop_map(|(x, y, z)| Vec3::new(x as f32 / 16.0, y as f32 / 16.0, z as f32 / 100.0))
    }

    proptest::proptest! {
        #[test]
        fn covers_what_the_edge_functions_say(a in corner(), b in corner(), c in corner()) {
            let hits = coverage([a, b, c]);
            let area = (b - a).cross(c - a).z;
            for (i, &hit) in hits.iter().enumerate() {
                let p = Vec3::new((i % SIZE) as f32 + 0.5, (i / SIZE) as f32 + 0.5, 0.0);
                let side = |a: Vec3, b: Vec3| (b - a).cross(p - a).z * area.signum();
                let inside = area != 0.0 && side(a, b) >= 0.0 && side(b, c) >= 0.0 && side(c, a) >= 0.0;
                proptest::prop_assert_eq!(hit, usize::from(inside));
            }
        }

        #[test]
        fn depth_is_the_plane_through_the_corners(a in corner(), b in corner(), c in corner()) {
            for_each_span([a, b, c], SIZE, SIZE, |span| {
                for (k, i) in span.samples.clone().enumerate() {
                    let p = point((i % SIZE) as f32 + 0.5, (i / SIZE) as f32 + 0.5);
                    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
                    let from = |q: Vec3| [q.x as f64 - p[0], q.y as f64 - p[1]];
                    let [u, v, w] = [cross(from(b), from(c)), cross(from(c), from(a)), cross(from(a), from(b))];
                    let expected = (u * a.z as f64 + v * b.z as f64 + w * c.z as f64) / (u + v + w);
                    let error = (span.depth(k) as f64 - expected).abs();
                    // Slivers are clamped to the corners: nothing better can be said of them.
                    assert!(error < 1e-3 || (u + v + w).abs() < 1.0, "{error}");
                }
            });
        }
    }

    fn point(x: f32, y: f32) -> [f64; 2] {
        [x as f64, y as f64]
    }
}
