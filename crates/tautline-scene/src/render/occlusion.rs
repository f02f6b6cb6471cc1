//! How open each pixel is to the sky: the soft dark seams where things touch.

use tautline::Vec3;

use super::camera::View;

/// Neighbours looked at per pixel; sixteen pixels in a square share sixteen times as many.
const TAPS: usize = 4;
/// Sides of the squares over which results are averaged.
const BLOCK: usize = 4;

/// Depths (m; infinite for the background) and unit normals of a picture's pixels.
pub(super) struct Geometry<'a> {
    pub(super) view: &'a View,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) depth: &'a [f32],
    pub(super) normals: &'a [Vec3],
}

/// The open share, 0 to 1, of the sky at each pixel, as far as things within `radius` (m) hide it.
///
/// Scalable ambient obscurance (McGuire, Mara & Luebke 2012): neighbours in the picture on a spiral, each
/// counted by its height over the pixel's tangent plane. A fixed 4 × 4 pattern turns the spiral, and an average
/// over as many pixels of like depth takes the pattern out again: nothing is random.
pub(super) fn openness(geometry: &Geometry, radius: f32) -> Vec<f32> {
    let raw = obscured(geometry, radius);
    let tolerance = 0.25 * radius;
    let rows = average(&raw, geometry, 1, tolerance);
    average(&rows, geometry, geometry.width, tolerance)
}

fn obscured(geometry: &Geometry, radius: f32) -> Vec<f32> {
    let &Geometry { view, width, height, depth, normals } = geometry;
    let spiral = spiral();
    let mut open = vec![1.0; width * height];
    for (i, open) in open.iter_mut().enumerate() {
        let z = depth[i];
        if z == f32::INFINITY {
            continue;
        }
        let (x, y) = (i % width, i / width);
        let reach = (radius * view.focal() / z).min(width as f32 / 4.0);
        let point = view.ray(x as f32 + 0.5, y as f32 + 0.5) * z;
        let mut hidden = 0.0;
        for offset in &spiral[(y % BLOCK) * BLOCK + x % BLOCK] {
            let (tx, ty) = (x as f32 + 0.5 + offset[0] * reach, y as f32 + 0.5 + offset[1] * reach);
            if !(tx >= 0.0 && ty >= 0.0 && tx < width as f32 && ty < height as f32) {
                continue;
            }
            let (tx, ty) = (tx as usize, ty as usize);
            let neighbour_z = depth[ty * width + tx];
            if neighbour_z == f32::INFINITY {
                continue;
            }
            let towards = view.ray(tx as f32 + 0.5, ty as f32 + 0.5) * neighbour_z - point;
            let distance_squared = towards.length_squared();
            let fading = (1.0 - distance_squared / (radius * radius)).max(0.0);
            let rise = (towards.dot(normals[i]) - 0.02 * radius).max(0.0);
            hidden += fading * rise / (distance_squared.sqrt() + 0.02 * radius);
        }
        *open = (1.0 - 1.8 * hidden / TAPS as f32).max(0.15);
    }
    open
}

/// For each pixel of the pattern its offsets on a unit disc: together a spiral in golden angles.
fn spiral() -> [[[f32; 2]; TAPS]; BLOCK * BLOCK] {
    // Spreads neighbouring pixels over the spiral.
    const ORDER: [usize; BLOCK * BLOCK] = [0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5];
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    ORDER.map(|rank| {
        std::array::from_fn(|tap| {
            let k = (tap * ORDER.len() + rank) as f32 + 0.5;
            let (sin, cos) = libm::sincosf(k * GOLDEN_ANGLE);
            let r = (k / (TAPS * ORDER.len()) as f32).sqrt();
            [r * cos, r * sin]
        })
    })
}

/// The mean over four pixels in a line, leaving out those of another depth.
fn average(values: &[f32], geometry: &Geometry, stride: usize, tolerance: f32) -> Vec<f32> {
    let &Geometry { width, height, depth, .. } = geometry;
    let mut means = vec![1.0; values.len()];
    let along = if stride == 1 { width } else { height };
    for (i, mean) in means.iter_mut().enumerate() {
        let z = depth[i];
        if z == f32::INFINITY {
            continue;
        }
        let place = (i / stride) % along;
        let first = i - place.min(1) * stride;
        let (mut sum, mut count) = (0.0, 0.0);
        for k in 0..BLOCK.min(along - place + place.min(1)) {
            let j = first + k * stride;
            let alike = if (depth[j] - z).abs() < tolerance { 1.0 } else { 0.0 };
            sum += if alike > 0.0 { values[j] } else { 0.0 };
            count += alike;
        }
        *mean = sum / count;
    }
    means
}
