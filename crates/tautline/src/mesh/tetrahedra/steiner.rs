//! Interior points, for cavities that cannot be filled without: one that sees every face of the cavity,
//! or else one that sees many of them.

use std::collections::BTreeSet;

use glam::DVec3;

use super::filling::{Cavity, Filling};
use super::predicates::{Face, Tet, orient, tet_on};
use crate::norm::Norm;

/// Steps of the search for a point that sees all faces.
const KERNEL_STEPS: u32 = 2000;
/// Faces from which a point that sees many is looked for.
const MAX_SEEDS: usize = 8;
/// Stars have fewer faces than this.
const MAX_STAR: usize = 400;

/// Adds a point that sees every face of the cavity, widened where it does not, and joins it to them;
/// `None` if none was found.
pub(super) fn star(
    points: &mut Vec<DVec3>,
    filling: &Filling,
    cavity: &Cavity,
) -> Option<(Cavity, Vec<Tet>)> {
    if cavity.faces.len() > 2 * MAX_STAR {
        return None;
    }
    let apex = points.len() as u32;
    let kernel = kernel_point(points, &cavity.faces);
    let stride = cavity.faces.len().div_ceil(MAX_SEEDS);
    let seeds: Vec<Face> = cavity.faces.iter().copied().step_by(stride).collect();
    let chords = seeds.iter().map(|&f| chord(points, &cavity.faces, f, 0.5));
    let candidates: Vec<DVec3> = kernel.into_iter().chain(chords).collect();
    let mut best: Option<(Cavity, DVec3)> = None;
    for candidate in candidates {
        let point = candidate.as_vec3().as_dvec3();
        points.push(point);
        let fewest = best.as_ref().map_or(MAX_STAR, |(star, _)| star.faces.len());
        if let Some(star) = star_shaped(points, filling, cavity, apex, fewest) {
            best = Some((star, point));
        }
        points.pop();
    }
    let (cavity, point) = best?;
    points.push(point);
    let tets = cavity.faces.iter().map(|&f| tet_on(f, apex)).collect();
    Some((cavity, tets))
}

/// Adds a point that sees every one of the faces and joins it to them; `None` if none was found.
pub(super) fn kernel_star(points: &mut Vec<DVec3>, faces: &BTreeSet<Face>) -> Option<Vec<Tet>> {
    let apex = points.len() as u32;
    points.push(kernel_point(points, faces)?.as_vec3().as_dvec3());
    let sees_all = faces.iter().all(|&f| orient(points, f, apex) < 0.0);
    sees_all.then(|| faces.iter().map(|&f| tet_on(f, apex)).collect())
}

/// Widens the cavity across faces that `apex` does not see until it sees all, and they are fewer than
/// `limit`.
fn star_shaped(
    points: &[DVec3],
    filling: &Filling,
    from: &Cavity,
    apex: u32,
    limit: usize,
) -> Option<Cavity> {
    let mut cavity = from.clone();
    let is_hidden = |f: &&Face| f.contains(&apex) || orient(points, **f, apex) >= 0.0;
    loop {
        let hidden: Vec<Face> = cavity.faces.iter().filter(is_hidden).copied().collect();
        if hidden.is_empty() {
            break;
        }
        for face in hidden {
            let widened = !cavity.faces.contains(&face) || filling.widen_across(&mut cavity, face);
            if !widened || cavity.faces.len() > 2 * limit {
                return None;
            }
        }
    }
    (cavity.faces.len() < limit).then_some(cavity)
}

/// The point deepest behind the planes of all faces, roughly: from the middle, step after step away from
/// the plane that is nearest or most violated, by less and less (a subgradient method for the largest
/// inscribed sphere).
fn kernel_point(points: &[DVec3], faces: &BTreeSet<Face>) -> Option<DVec3> {
    let planes: Vec<(DVec3, DVec3)> = faces
        .iter()
        .map(|f| f.map(|v| points[v as usize]))
        .map(|[a, b, c]| ((b - a).cross(c - a).unit_or_zero(), a))
        .collect();
    let mut p = planes.iter().map(|plane| plane.1).sum::<DVec3>() / planes.len() as f64;
    let size = planes.iter().map(|plane| plane.1.distance_to(p)).fold(0.0, f64::max);
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

/// Points half way (or another `share`) through the solid behind the given faces, well apart.
pub(super) fn seed(points: &mut Vec<DVec3>, surface: &BTreeSet<Face>, faces: &[Face], share: f64) {
    let first = points.len();
    for &face in faces {
        let middle = face.iter().map(|&v| points[v as usize]).sum::<DVec3>() / 3.0;
        let point = chord(points, surface, face, share).as_vec3().as_dvec3();
        let apart = 0.5 * point.distance_to(middle);
        if points[first..].iter().all(|p| p.distance_to(point) > apart) {
            points.push(point);
        }
    }
}

/// The point at a share of the way from the face's middle, straight inwards, to the next face.
fn chord(points: &[DVec3], faces: &BTreeSet<Face>, face: Face, share: f64) -> DVec3 {
    let [a, b, c] = face.map(|v| points[v as usize]);
    let (middle, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a).unit_or_zero());
    middle - normal * (share * depth_below(points, faces, middle, -normal))
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
