//! How open each pixel is to the sky: the soft dark seams where things touch.

use tautline::Vec3;

/// Neighbours looked at per pixel; sixteen pixels in a square share sixteen times as many.
const TAPS: usize = 4;
/// Sides of the squares over which results are averaged.
const BLOCK: usize = 4;
/// Darkness of a spot that is hidden all around, and the least light anywhere.
const STRENGTH: f32 = 1.8;
const DARKEST: f32 = 0.15;

/// What a picture's pixels show, in the camera's axes (right, up, depth).
pub(super) struct Geometry<'a> {
    /// Length, in pixels, of something 1 m long at a depth of 1 m.
    pub(super) focal: f32,
    pub(super) width: usize,
    pub(super) height: usize,
    /// In m; infinite for the background.
    pub(super) depth: &'a [f32],
    /// Unit, on the camera's side.
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
    let spiral = spiral();
    let mut open = vec![1.0; geometry.depth.len()];
    for (i, open) in open.iter_mut().enumerate() {
        let z = geometry.depth[i];
        if z == f32::INFINITY {
            continue;
        }
        let (x, y) = (i % geometry.width, i / geometry.width);
        // Nothing is looked for farther away than a quarter of the picture.
        let reach = (radius * geometry.focal / z).min(geometry.width as f32 / 4.0);
        let offsets = &spiral[(y % BLOCK) * BLOCK + x % BLOCK];
        let point = geometry.point(x, y, z);
        let hidden: f32 = offsets
            .iter()
            .filter_map(|[dx, dy]| {
                let neighbour =
                    geometry.neighbour(x as f32 + 0.5 + dx * reach, y as f32 + 0.5 + dy * reach)?;
                Some(obscurance(neighbour - point, geometry.normals[i], radius))
            })
            .sum();
        *open = (1.0 - STRENGTH * hidden / TAPS as f32).max(DARKEST);
    }
    open
}

/// How much a neighbour at an offset (m) hides: by the sine of its height above the tangent plane, and less the
/// farther it is.
fn obscurance(offset: Vec3, normal: Vec3, radius: f32) -> f32 {
    // What is nearly in the plane does not count: depths are not exact.
    let margin = 0.02 * radius;
    let rise = offset.dot(normal) - margin;
    let nearness = 1.0 - offset.length_squared() / (radius * radius);
    if rise <= 0.0 || nearness <= 0.0 { 0.0 } else { nearness * rise / (offset.length() + margin) }
}

impl Geometry<'_> {
    /// The point shown by a pixel of that depth.
    fn point(&self, x: usize, y: usize, z: f32) -> Vec3 {
        let scale = z / self.focal;
        let (cx, cy) = (self.width as f32 / 2.0, self.height as f32 / 2.0);
        Vec3::new((x as f32 + 0.5 - cx) * scale, (cy - y as f32 - 0.5) * scale, z)
    }

    /// The point shown at a place in the picture (in pixels), if there is one.
    fn neighbour(&self, x: f32, y: f32) -> Option<Vec3> {
        if x < 0.0 || y < 0.0 || x >= self.width as f32 || y >= self.height as f32 {
            return None;
        }
        let (x, y) = (x as usize, y as usize);
        let z = self.depth[y * self.width + x];
        (z != f32::INFINITY).then(|| self.point(x, y, z))
    }
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

/// The mean over [`BLOCK`] pixels in a line, leaving out those of another depth and those beyond the picture.
fn average(values: &[f32], geometry: &Geometry, stride: usize, tolerance: f32) -> Vec<f32> {
    let depth = geometry.depth;
    let mut means = vec![1.0; values.len()];
    for (i, mean) in means.iter_mut().enumerate() {
        let z = depth[i];
        if z == f32::INFINITY {
            continue;
        }
        // A row's end runs on into the next row: what is there is mostly of another depth, and harmless if not.
        let (mut sum, mut count) = (values[i], 1.0);
        for j in [i.wrapping_sub(stride), i + stride, i + 2 * stride] {
            if j < depth.len() && (depth[j] - z).abs() < tolerance {
                sum += values[j];
                count += 1.0;
            }
        }
        *mean = sum / count;
    }
    means
}
