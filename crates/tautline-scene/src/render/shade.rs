//! One picture: which triangle each sample shows, then one colour per triangle and pixel.

use tautline::Vec3;

use super::light::{Spot, background, light, to_srgb, tone_map};
use super::occlusion::{Geometry, openness};
use super::raster::for_each_span;
use super::shadow::ShadowMap;
use super::stage::Pose;
use super::{Image, Renderer};
use crate::recording::Surface;

/// The triangle of a sample that shows the background.
const NOTHING: u32 = u32::MAX;
/// How far what hides the sky from a spot may be, as a share of the radius of all that moves.
const OCCLUSION_RADIUS: f32 = 0.07;
/// Where walls begin to fade into the background and where they are gone, in radii of all that moves.
const FADE: [f32; 2] = [1.15, 2.4];

/// Memory for one picture after the other: to ask for it anew each time costs a fifth of the time.
#[derive(Default)]
pub(crate) struct Scratch {
    inverse_depth: Vec<f32>,
    triangle: Vec<u32>,
    depth: Vec<f32>,
    normals: Vec<Vec3>,
    pub(super) shadow_map: Vec<f32>,
}

/// As many values as asked for, all the same, in memory that may have been used before.
pub(super) fn refill<T: Clone>(memory: &mut Vec<T>, count: usize, value: T) -> &mut [T] {
    memory.clear();
    memory.resize(count, value);
    memory
}

/// What each sample shows.
struct Samples<'a> {
    /// Samples along a side of a pixel.
    per_pixel: usize,
    width: usize,
    /// 1 / depth; 0 for the background.
    inverse_depth: &'a [f32],
    triangle: &'a [u32],
}

/// Samples of one pixel that show the same triangle.
struct Fragment {
    triangle: u32,
    samples: f32,
    /// Sums over its samples.
    x: f32,
    y: f32,
    inverse_depth: f32,
}

/// Uses all of the scratch but its shadow map.
pub(super) fn picture(
    renderer: &Renderer,
    pose: &Pose,
    shadow_map: &ShadowMap,
    scratch: &mut Scratch,
) -> Image {
    let (width, height) = (renderer.settings.width as usize, renderer.settings.height as usize);
    let samples = visible(renderer, pose, &mut scratch.inverse_depth, &mut scratch.triangle);
    let open = sky(renderer, pose, &samples, &mut scratch.depth, &mut scratch.normals);
    let mut pixels = Vec::with_capacity(width * height);
    for y in 0..height {
        let behind = background((y as f32 + 0.5) / height as f32);
        for x in 0..width {
            let mut color = Vec3::ZERO;
            let openness = open[y * width + x];
            samples.for_each_fragment(x, y, |fragment| {
                color += renderer.color(pose, shadow_map, fragment, behind, openness) * fragment.samples;
            });
            pixels.push(to_srgb(color / (samples.per_pixel * samples.per_pixel) as f32));
        }
    }
    Image { width, height, pixels }
}

/// Draws every triangle that can be seen into a depth buffer.
fn visible<'a>(
    renderer: &Renderer,
    pose: &Pose,
    inverse_depth: &'a mut Vec<f32>,
    triangle: &'a mut Vec<u32>,
) -> Samples<'a> {
    let per_pixel = renderer.settings.supersampling as usize;
    let width = renderer.settings.width as usize * per_pixel;
    let height = renderer.settings.height as usize * per_pixel;
    let inverse_depth = refill(inverse_depth, width * height, 0.0);
    let triangle = refill(triangle, width * height, NOTHING);
    for t in 0..renderer.stage.triangle_count() {
        let corners = renderer.stage.corners(pose, t);
        let faces_camera = pose.face_normals[t].dot(renderer.view.eye - corners[0]) > 0.0;
        let surface = renderer.materials[renderer.stage.track_of[t] as usize].surface;
        if !faces_camera && surface != Surface::Sheet {
            continue;
        }
        let in_view = corners.map(|p| renderer.view.to_view(p));
        renderer.view.clip_and_project(in_view, |projected| {
            for_each_span(projected, width, height, |span| {
                let depths = inverse_depth[span.samples.clone()].iter_mut();
                let triangles = triangle[span.samples.clone()].iter_mut();
                for (i, (nearest, shown)) in depths.zip(triangles).enumerate() {
                    let depth = span.depth(i);
                    if depth > *nearest {
                        (*nearest, *shown) = (depth, t as u32);
                    }
                }
            });
        });
    }
    Samples { per_pixel, width, inverse_depth, triangle }
}

/// Openness to the sky of the first sample of every pixel.
fn sky(
    renderer: &Renderer,
    pose: &Pose,
    samples: &Samples,
    depth: &mut Vec<f32>,
    normals: &mut Vec<Vec3>,
) -> Vec<f32> {
    let (width, height) = (renderer.settings.width as usize, renderer.settings.height as usize);
    let depth = refill(depth, width * height, f32::INFINITY);
    let normals = refill(normals, width * height, Vec3::ZERO);
    // Neighbours mostly show the same triangle: its normal is turned once.
    let mut last = (NOTHING, Vec3::ZERO);
    for i in 0..width * height {
        let sample = ((i / width) * samples.width + i % width) * samples.per_pixel;
        let triangle = samples.triangle[sample];
        if triangle == NOTHING {
            continue;
        }
        if triangle != last.0 {
            let normal = renderer.view.turn(pose.face_normals[triangle as usize]);
            let towards = renderer.view.to_view(renderer.stage.corners(pose, triangle as usize)[0]);
            last = (triangle, if normal.dot(towards) < 0.0 { normal } else { -normal });
        }
        (depth[i], normals[i]) = (1.0 / samples.inverse_depth[sample], last.1);
    }
    let focal = renderer.view.focal() / samples.per_pixel as f32;
    let radius = OCCLUSION_RADIUS * renderer.focus.1;
    openness(&Geometry { focal, width, height, depth, normals }, radius)
}

impl Samples<'_> {
    /// Hands out what a pixel shows, in the order of its samples.
    fn for_each_fragment(&self, x: usize, y: usize, mut show: impl FnMut(&Fragment)) {
        let n = self.per_pixel;
        let corner = y * n * self.width + x * n;
        let index = |sample: usize| corner + sample / n * self.width + sample % n;
        let mut left: u32 = (1 << (n * n)) - 1;
        while left != 0 {
            let triangle = self.triangle[index(left.trailing_zeros() as usize)];
            let mut fragment = Fragment { triangle, samples: 0.0, x: 0.0, y: 0.0, inverse_depth: 0.0 };
            for sample in 0..n * n {
                let i = index(sample);
                if self.triangle[i] != triangle {
                    continue;
                }
                left &= !(1 << sample);
                fragment.samples += 1.0;
                fragment.x += (x * n + sample % n) as f32 + 0.5;
                fragment.y += (y * n + sample / n) as f32 + 0.5;
                fragment.inverse_depth += self.inverse_depth[i];
            }
            show(&fragment);
        }
    }
}

impl Renderer<'_> {
    /// The colour of a fragment, ready to be averaged with others.
    fn color(
        &self,
        pose: &Pose,
        shadow_map: &ShadowMap,
        fragment: &Fragment,
        behind: Vec3,
        openness: f32,
    ) -> Vec3 {
        if fragment.triangle == NOTHING {
            return behind;
        }
        let triangle = fragment.triangle as usize;
        let material = &self.materials[self.stage.track_of[triangle] as usize];
        let ray = self.view.ray(fragment.x / fragment.samples, fragment.y / fragment.samples);
        let p = self.view.eye + ray * (fragment.samples / fragment.inverse_depth);
        let fade = if material.surface == Surface::Wall { self.fade(p) } else { 0.0 };
        if fade >= 1.0 {
            return behind;
        }

        let outside = pose.face_normals[triangle].dot(ray) < 0.0;
        let side = if outside { 1.0 } else { -1.0 };
        let normal = if material.is_smooth() {
            self.stage.smooth_normal(pose, triangle, p) * side
        } else {
            pose.face_normals[triangle] * side
        };
        let facing_sun = normal.dot(self.sun.direction) > 0.0;
        let spot = Spot {
            albedo: material.albedo[usize::from(!outside)],
            normal,
            towards_eye: -ray.normalize(),
            sunlight: if facing_sun { shadow_map.light_at(p, normal) } else { 0.0 },
            openness,
            glossy: matches!(material.surface, Surface::Solid | Surface::Round),
        };
        tone_map(light(&spot, self.sun.direction)).lerp(behind, fade)
    }

    /// How much of the background shows through a wall at a point: 0 to 1, smooth.
    fn fade(&self, p: Vec3) -> f32 {
        let (middle, radius) = self.focus;
        let t = ((p - middle).length() / radius.max(1e-6) - FADE[0]) / (FADE[1] - FADE[0]);
        let t = t.clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}
