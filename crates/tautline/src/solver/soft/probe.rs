//! How far eight points are from a convex part, and which way is out.

use glam::{DVec3, Mat3, Vec3};

use crate::geometry::query::closest_to_convex;
use crate::norm::Norm;
use crate::shape::{Convex, Face};
use crate::simd::{LANES, Lanes, Row, Vec3x8};

/// A convex part, told by what is fast to ask.
#[derive(Debug, Clone, Copy)]
pub(super) enum Form<'a> {
    Point(Vec3),
    Segment([Vec3; 2]),
    /// A box: its centre, axes, and half extents.
    Cuboid(Vec3, Mat3, Vec3),
    Polytope(&'a Convex),
}

/// Of eight points in the part's frame.
#[derive(Clone, Copy)]
pub(super) struct Probe<L> {
    /// In m, below 0 inside.
    pub(super) distance: L,
    /// Unit, out of the part.
    pub(super) normal: Vec3x8<L>,
}

impl<'a> Form<'a> {
    pub(super) fn of(convex: &'a Convex) -> Self {
        match convex.vertices[..] {
            [center] => Self::Point(center),
            [a, b] => Self::Segment([a, b]),
            _ => cuboid(convex).unwrap_or(Self::Polytope(convex)),
        }
    }

    /// Of the core, without the radius around it. Beyond `reach` (m) a distance may be less than it is.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn probe<L: Lanes>(&self, points: Vec3x8<L>, reach: f32) -> Probe<L> {
        match *self {
            Self::Point(center) => around(points - Vec3x8::splat(center)),
            Self::Segment([a, b]) => {
                let (along, from) = (b - a, points - Vec3x8::splat(a));
                let share = from.dot(Vec3x8::splat(along)) / L::splat(along.length_squared().max(1e-30));
                let share = share.max(L::splat(0.0)).min(L::splat(1.0));
                around(from - Vec3x8::splat(along) * share)
            }
            Self::Cuboid(center, axes, half) => probe_cuboid(points - Vec3x8::splat(center), &axes, half),
            Self::Polytope(convex) => probe_polytope(points, convex, reach),
        }
    }
}

/// A part with six faces, each square to the others.
fn cuboid(convex: &Convex) -> Option<Form<'_>> {
    let is_box = convex.faces.len() == 6 && convex.vertices.len() == 8;
    let first = convex.faces.first().filter(|_| is_box)?.normal;
    let second = convex.faces.iter().find(|face| is_square(face.normal, first))?.normal;
    let axes = Mat3::from_cols(first, second, first.cross(second));
    let is_along = |face: &Face| (0..3).filter(|&k| is_square(face.normal, axes.col(k))).count() == 2;
    if !convex.faces.iter().all(is_along) {
        return None;
    }
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = convex.vertices.iter().fold(start, |(low, high), &vertex| {
        let local = axes.transpose() * vertex;
        (low.min(local), high.max(local))
    });
    Some(Form::Cuboid(axes * ((low + high) * 0.5), axes, (high - low) * 0.5))
}

fn is_square(a: Vec3, b: Vec3) -> bool {
    a.dot(b).abs() < 1e-6
}

#[inline(always)]
fn around<L: Lanes>(from: Vec3x8<L>) -> Probe<L> {
    let distance = from.length_squared().max(L::splat(1e-24)).sqrt();
    // In the very middle any way is out.
    let is_out = distance.greater(L::splat(1e-11));
    let normal = Vec3x8::select(is_out, from * (L::splat(1.0) / distance), Vec3x8::splat(Vec3::Y));
    Probe { distance, normal }
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn probe_cuboid<L: Lanes>(points: Vec3x8<L>, axes: &Mat3, half: Vec3) -> Probe<L> {
    let zero = L::splat(0.0);
    let local = [axes.x_axis, axes.y_axis, axes.z_axis];
    let [x, y, z] = [
        points.dot(Vec3x8::splat(local[0])),
        points.dot(Vec3x8::splat(local[1])),
        points.dot(Vec3x8::splat(local[2])),
    ];
    let (size_x, size_y, size_z) = (x.max(-x), y.max(-y), z.max(-z));
    let beyond = Vec3x8::new(size_x - L::splat(half.x), size_y - L::splat(half.y), size_z - L::splat(half.z));
    let out = Vec3x8::new(beyond.x.max(zero), beyond.y.max(zero), beyond.z.max(zero));
    let outside = out.length_squared().greater(L::splat(1e-14));
    let distance = out.length_squared().max(L::splat(1e-24)).sqrt();
    let unit = out * (L::splat(1.0) / distance);
    // Inside, the nearest face; of equally near ones y, then x.
    let highest = beyond.x.max(beyond.y).max(beyond.z);
    let is_y = beyond.y.equal(highest);
    let is_x = beyond.x.equal(highest);
    let one = L::splat(1.0);
    let nearest = Vec3x8::new(
        is_y.select(zero, is_x.select(one, zero)),
        is_y.and(one),
        is_y.select(zero, is_x.select(zero, one)),
    );
    let normal = Vec3x8::select(outside, unit, nearest);
    let signed = Vec3x8::new(
        zero.greater(x).select(-normal.x, normal.x),
        zero.greater(y).select(-normal.y, normal.y),
        zero.greater(z).select(-normal.z, normal.z),
    );
    let normal = Vec3x8::splat(local[0]) * signed.x
        + Vec3x8::splat(local[1]) * signed.y
        + Vec3x8::splat(local[2]) * signed.z;
    Probe { distance: outside.select(distance, highest), normal }
}

/// Above no face the point is inside, and the highest face is the nearest. Else the distance to the highest face's plane
/// is a lower bound, and where it is within reach the exact answer is looked up, point by point.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn probe_polytope<L: Lanes>(points: Vec3x8<L>, convex: &Convex, reach: f32) -> Probe<L> {
    let (mut distance, mut normal) = (L::splat(f32::NEG_INFINITY), Vec3x8::<L>::splat(Vec3::Y));
    for face in &convex.faces {
        let outward = Vec3x8::<L>::splat(face.normal);
        let height = points.dot(outward) - L::splat(face.offset);
        let is_higher = height.greater(distance);
        distance = is_higher.select(height, distance);
        normal = Vec3x8::select(is_higher, outward, normal);
    }
    let is_solid = convex.faces.len() > 2;
    let is_far = distance.greater(L::splat(reach));
    let is_inside =
        if is_solid { L::splat(0.0).greater(distance) } else { L::splat(0.0).greater(L::splat(0.0)) };
    let unclear = !(is_far.bits() | is_inside.bits()) & 0xFF;
    if unclear == 0 {
        return Probe { distance, normal };
    }
    refine(points, convex, unclear, Probe { distance, normal })
}

/// Looks up the exact answer for the points whose bits are set.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn refine<L: Lanes>(points: Vec3x8<L>, convex: &Convex, lanes: u32, probe: Probe<L>) -> Probe<L> {
    let (mut at, mut normals, mut distances) = ([Row::ZERO; 3], [Row::ZERO; 3], Row::ZERO);
    points.store(&mut at);
    probe.normal.store(&mut normals);
    probe.distance.store(&mut distances);
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
        let [x, y, z] = at.each_ref().map(|row| f64::from(row.0[lane]));
        let closest = closest_to_convex(DVec3::new(x, y, z), convex);
        distances.0[lane] = closest.distance as f32 + convex.radius;
        let normal = closest.normal.as_vec3().to_array();
        normals.iter_mut().zip(normal).for_each(|(row, number)| row.0[lane] = number);
    }
    Probe { distance: L::load(&distances), normal: Vec3x8::load(&normals) }
}

/// A triangle and the box around it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facet {
    corners: [Vec3; 3],
    low: Vec3,
    high: Vec3,
}

impl Facet {
    pub(super) fn new(corners: [Vec3; 3]) -> Self {
        let [a, b, c] = corners;
        Self { corners, low: a.min(b).min(c), high: a.max(b).max(c) }
    }
}

/// Of the nearest of some triangles, from either side of it. Beyond `reach` (m) a distance may be more than it is: most
/// triangles are passed over, for they are farther than that from all eight points.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn probe_triangles<L: Lanes>(points: Vec3x8<L>, facets: &[Facet], reach: f32) -> Probe<L> {
    let mut least = L::splat(f32::MAX);
    let mut nearest = Vec3x8::<L>::splat(Vec3::Y);
    // With room for rounding.
    let reach = Vec3::splat(1.25 * reach);
    let (low, high) = (-largest(-points) - reach, largest(points) + reach);
    for facet in facets.iter().filter(|facet| !(facet.low.cmpgt(high) | facet.high.cmplt(low)).any()) {
        let from = from_triangle(points, &facet.corners);
        let squared = from.length_squared();
        let is_nearer = least.greater(squared);
        least = is_nearer.select(squared, least);
        nearest = Vec3x8::select(is_nearer, from, nearest);
    }
    let found = around(nearest);
    Probe { distance: least.greater(L::splat(1e30)).select(least, found.distance), normal: found.normal }
}

#[inline(always)]
fn largest<L: Lanes>(points: Vec3x8<L>) -> Vec3 {
    Vec3::new(points.x.largest(), points.y.largest(), points.z.largest())
}

/// From the nearest point of a triangle to eight points.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn from_triangle<L: Lanes>(points: Vec3x8<L>, corners: &[Vec3; 3]) -> Vec3x8<L> {
    let [a, b, c] = *corners;
    let across = (b - a).cross(c - a);
    let normal = Vec3x8::<L>::splat(across.unit_or(Vec3::Y));
    let mut over = L::splat(1.0).greater(L::splat(0.0));
    let (mut least, mut nearest) = (L::splat(f32::MAX), Vec3x8::<L>::zero());
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let (edge, start) = (to - from, points - Vec3x8::splat(from));
        let share = start.dot(Vec3x8::splat(edge)) / L::splat(edge.length_squared().max(1e-30));
        let share = share.max(L::splat(0.0)).min(L::splat(1.0));
        let gap = start - Vec3x8::splat(edge) * share;
        let is_nearer = least.greater(gap.length_squared());
        least = is_nearer.select(gap.length_squared(), least);
        nearest = Vec3x8::select(is_nearer, gap, nearest);
        over = over.and(start.dot(Vec3x8::splat(across.cross(edge))).greater(L::splat(0.0)));
    }
    let height = (points - Vec3x8::splat(a)).dot(normal);
    Vec3x8::select(over, normal * height, nearest)
}

#[cfg(test)]
#[path = "tests/probe.rs"]
mod tests;
