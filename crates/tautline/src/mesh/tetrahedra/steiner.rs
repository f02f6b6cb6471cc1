//! Interior points, for cavities that cannot be filled without: one that sees every face of the cavity,
//! or else one that sees many of them.

use std::collections::BTreeSet;

use glam::DVec3;

use super::predicates::{Face, Tet, orient, tet_crosses_face, tet_on};

/// Steps of the search for a point that sees all faces.
const KERNEL_STEPS: u32 = 2000;
/// Faces from which a point that sees many is looked for.
const MAX_SEEDS: usize = 48;

/// Adds a point that sees every face of the cavity, and joins it to them; `None` if none was found.
pub(super) fn star(points: &mut Vec<DVec3>, faces: &BTreeSet<Face>) -> Option<Vec<Tet>> {
    let apex = points.len() as u32;
    points.push(kernel_point(points, faces)?.as_vec3().as_dvec3());
    let tets: Vec<Tet> = faces.iter().map(|&f| tet_on(f, apex)).collect();
    if faces.iter().all(|&f| orient(points, f, apex) < 0.0) {
        return Some(tets);
    }
    points.pop();
    None
}

/// The point deepest behind the planes of all faces, roughly: from the middle, step after step away from
/// the plane that is nearest or most violated, by less and less (a subgradient method for the largest
/// inscribed sphere).
fn kernel_point(points: &[DVec3], faces: &BTreeSet<Face>) -> Option<DVec3> {
    let planes: Vec<(DVec3, DVec3)> = faces
        .iter()
        .map(|f| f.map(|v| points[v as usize]))
        .map(|[a, b, c]| ((b - a).cross(c - a).normalize_or_zero(), a))
        .collect();
    let mut p = planes.iter().map(|plane| plane.1).sum::<DVec3>() / planes.len() as f64;
    let size = planes.iter().map(|plane| plane.1.distance(p)).fold(0.0, f64::max);
    let mut best = (0.0, None);
    for k in 0..KERNEL_STEPS {
        let above = planes.iter().map(|&(normal, a)| (normal.dot(p - a), normal));
        let (height, normal) = above.max_by(|a, b| a.0.total_cmp(&b.0))?;
        if height < best.0 {
            best = (height, Some(p));
        }
        // Back to the plane if beyond it, and a shrinking step further.
        p -= normal * (height.max(0.0) + 0.3 * size / f64::from(k + 1));
    }
    best.1
}

/// Adds a point that sees as many faces of the cavity as possible, and joins it to those; `None` if no
/// point was found that sees any.
pub(super) fn partial_star(points: &mut Vec<DVec3>, faces: &BTreeSet<Face>) -> Option<Vec<Tet>> {
    let apex = points.len() as u32;
    let mut best: (Vec<Tet>, DVec3) = (Vec::new(), DVec3::ZERO);
    let stride = faces.len().div_ceil(MAX_SEEDS);
    for &seed in faces.iter().step_by(stride) {
        let corners = seed.map(|v| points[v as usize]);
        let [a, b, c] = corners;
        let (middle, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a).normalize_or_zero());
        let depth = depth_below(points, faces, middle, -normal);
        for share in [0.5, 0.1] {
            points.push((middle - normal * depth * share).as_vec3().as_dvec3());
            let seen = visible(points, faces, apex);
            let candidate = points.pop()?;
            if seen.len() > best.0.len() {
                best = (seen, candidate);
            }
        }
    }
    let (tets, point) = best;
    if tets.is_empty() {
        return None;
    }
    points.push(point);
    Some(tets)
}

/// How far a ray runs before it meets a face from inside.
fn depth_below(points: &[DVec3], faces: &BTreeSet<Face>, from: DVec3, direction: DVec3) -> f64 {
    let hit = |face: &Face| {
        let [a, b, c] = face.map(|v| points[v as usize] - from);
        let normal = (b - a).cross(c - a);
        let within = [(a, b), (b, c), (c, a)].iter().all(|(p, q)| p.cross(*q).dot(direction) >= 0.0);
        let distance = a.dot(normal) / direction.dot(normal);
        (within && direction.dot(normal) > 0.0 && distance > 0.0).then_some(distance)
    };
    faces.iter().filter_map(hit).fold(f64::INFINITY, f64::min).min(1e30)
}

fn visible(points: &[DVec3], faces: &BTreeSet<Face>, apex: u32) -> Vec<Tet> {
    let inward = faces.iter().filter(|f| orient(points, **f, apex) < 0.0);
    let tets = inward.map(|&f| tet_on(f, apex));
    tets.filter(|tet| !faces.iter().any(|&g| tet_crosses_face(points, tet, g))).collect()
}
