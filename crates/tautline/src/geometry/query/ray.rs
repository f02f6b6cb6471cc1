//! Where a ray enters a shape. Spheres and capsules are exact, polytopes are cut out of space by their faces.

use glam::{DQuat, DVec3, Vec3};

use super::cast::{Motion, Rounded, first_touch};
use super::closest::closest_to_convex;
use super::fan;
use crate::geometry::closest::closest_on_segment;
use crate::norm::Norm;
use crate::shape::Convex;

/// The points origin + t · direction, 0 ≤ t ≤ max. The direction need not be unit; zero makes the ray a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) max: f64,
}

/// Where a ray enters a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RayHit {
    /// 0 if the ray begins inside.
    pub(crate) t: f64,
    /// Unit, out of the shape; if the ray begins inside, that of the closest place on the surface.
    pub(crate) normal: DVec3,
}

impl Ray {
    pub(crate) fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// The time if the ray comes that far.
    fn reaches(&self, t: f64) -> Option<f64> {
        (0.0..=self.max).contains(&t).then_some(t)
    }
}

/// Where the ray enters a convex part, in the part's frame.
pub(crate) fn ray_to_convex(ray: &Ray, part: &Convex) -> Option<RayHit> {
    let radius = f64::from(part.radius);
    let entry = match *part.vertices {
        [center] => enter_ball(ray, center.as_dvec3(), radius),
        [a, b] => enter_capsule(ray, [a, b].map(|end| end.as_dvec3()), radius),
        _ if part.radius > 0.0 => return enter_rounded(ray, part),
        _ if part.faces.len() <= 2 => return enter_flat(ray, part),
        _ => enter_polytope(ray, part),
    };
    match entry? {
        Entry::Inside => Some(RayHit { t: 0.0, normal: closest_to_convex(ray.origin, part).normal }),
        Entry::At(hit) => ray.reaches(hit.t).map(|_| hit),
    }
}

/// Where the ray crosses a triangle, from either side. The normal is the one on the side it comes from. A ray in the
/// triangle's plane passes it by.
pub(crate) fn ray_to_triangle(ray: &Ray, corners: [Vec3; 3]) -> Option<RayHit> {
    // From the ray's origin: the signs of the volumes between it and the sides say on which side it passes, the same
    // for two triangles that share one, so that no ray slips through between them (Woop, Benthin & Wald 2013).
    let [a, b, c] = corners.map(|corner| corner.as_dvec3() - ray.origin);
    let sides = [b.cross(c), c.cross(a), a.cross(b)].map(|area| area.dot(ray.direction));
    let is_within = sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0);
    let normal = (b - a).cross(c - a).unit_or_zero();
    let along = normal.dot(ray.direction);
    if !is_within || along == 0.0 {
        return None;
    }
    let t = ray.reaches(normal.dot(a) / along)?;
    Some(RayHit { t, normal: if along > 0.0 { -normal } else { normal } })
}

/// Where the ray enters the solid n · x < offset, with unit n.
pub(crate) fn ray_to_half_space(ray: &Ray, normal: DVec3, offset: f64) -> Option<RayHit> {
    let height = normal.dot(ray.origin) - offset;
    let along = normal.dot(ray.direction);
    if height <= 0.0 {
        return Some(RayHit { t: 0.0, normal });
    }
    let t = (along < 0.0).then(|| height / -along)?;
    ray.reaches(t).map(|t| RayHit { t, normal })
}

/// How a line meets a solid.
enum Entry {
    /// The origin is in it.
    Inside,
    /// However far.
    At(RayHit),
}

fn enter_ball(ray: &Ray, center: DVec3, radius: f64) -> Option<Entry> {
    let from = ray.origin - center;
    if from.length_squared() <= radius * radius {
        return Some(Entry::Inside);
    }
    let length_squared = ray.direction.length_squared();
    let middle = -from.dot(ray.direction) / length_squared;
    // From the distance of the line, which does not cancel as the textbook's b² − 4ac does (Haines, Günther &
    // Akenine-Möller 2019, "Precision improvements for ray/sphere intersection").
    let depth_squared = radius * radius - (from + ray.direction * middle).length_squared();
    if middle.is_nan() || middle < 0.0 || depth_squared < 0.0 {
        return None;
    }
    let t = middle - (depth_squared / length_squared).sqrt();
    Some(Entry::At(RayHit { t, normal: (from + ray.direction * t).unit_or(DVec3::Y) }))
}

/// A capsule is a pipe between two balls: of the places where these are entered the first.
fn enter_capsule(ray: &Ray, ends: [DVec3; 2], radius: f64) -> Option<Entry> {
    let axis = ends[1] - ends[0];
    let [s, t] = closest_on_segment(ray.origin, ends);
    if ray.origin.distance_squared(ends[0] * s + ends[1] * t) <= radius * radius {
        return Some(Entry::Inside);
    }
    let pipe = enter_pipe(ray, ends[0], axis, radius);
    let balls = ends.map(|end| enter_ball(ray, end, radius));
    let hits = balls.into_iter().chain([pipe]).filter_map(|entry| match entry {
        Some(Entry::At(hit)) => Some(hit),
        _ => None,
    });
    hits.min_by(|a, b| a.t.total_cmp(&b.t)).map(Entry::At)
}

/// The side of a cylinder without ends: a circle, seen along its axis.
fn enter_pipe(ray: &Ray, base: DVec3, axis: DVec3, radius: f64) -> Option<Entry> {
    let length_squared = axis.length_squared();
    if length_squared == 0.0 {
        return None;
    }
    let across = |v: DVec3| v - axis * (v.dot(axis) / length_squared);
    let seen = Ray { origin: across(ray.origin - base), direction: across(ray.direction), max: ray.max };
    let Entry::At(hit) = enter_ball(&seen, DVec3::ZERO, radius)? else { return None };
    let height = (ray.at(hit.t) - base).dot(axis);
    (0.0..=length_squared).contains(&height).then_some(Entry::At(hit))
}

/// Between entering the last and leaving the first of the half-spaces of its faces a line is inside.
fn enter_polytope(ray: &Ray, part: &Convex) -> Option<Entry> {
    let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut normal = DVec3::ZERO;
    for face in &part.faces {
        let outward = face.normal.as_dvec3();
        let height = outward.dot(ray.origin) - f64::from(face.offset);
        let along = outward.dot(ray.direction);
        if along == 0.0 {
            if height > 0.0 {
                return None;
            }
            continue;
        }
        let t = -height / along;
        if along > 0.0 {
            leave = leave.min(t);
        } else if t > enter {
            (enter, normal) = (t, outward);
        }
    }
    if enter > leave || leave < 0.0 {
        return None;
    }
    Some(if enter <= 0.0 { Entry::Inside } else { Entry::At(RayHit { t: enter, normal }) })
}

/// A face without an inside.
fn enter_flat(ray: &Ray, part: &Convex) -> Option<RayHit> {
    fan(part, part.faces.first()?).find_map(|corners| ray_to_triangle(ray, corners))
}

/// A polytope with a radius: a point is sent towards it.
fn enter_rounded(ray: &Ray, part: &Convex) -> Option<RayHit> {
    let point = Rounded { corners: &[Vec3::ZERO], radius: 0.0 };
    // A time of 1 is the end of the ray, which may be infinitely far.
    let max = ray.max.min(1e9 / ray.direction.norm().max(f64::MIN_POSITIVE));
    let moving = Motion::translation(point, ray.origin, DQuat::IDENTITY, ray.direction * max);
    let fixed = Motion::translation(Rounded::of(part), DVec3::ZERO, DQuat::IDENTITY, DVec3::ZERO);
    first_touch(&moving, &fixed, 0.0).map(|touch| RayHit { t: touch.time * max, normal: -touch.at.normal })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tests::{parts, vector};
    use super::*;

    /// What may differ because faces are in f32, in m.
    const ROUNDING: f64 = 2e-6;

    fn ray(origin: DVec3, direction: DVec3) -> Ray {
        Ray { origin, direction, max: 10.0 }
    }

    proptest! {
        #[test]
        fn a_ray_enters_where_the_distance_is_first_zero(
            part in parts(),
            origin in vector(3.0),
            target in vector(0.5),
        ) {
            let ray = Ray { origin, direction: target - origin, max: 1.5 };
            let hit = ray_to_convex(&ray, &part);
            let end = hit.map_or(ray.max, |hit| hit.t);
            let distance = |t: f64| closest_to_convex(ray.at(t), &part).distance;
            for i in 0..100 {
                let t = end * f64::from(i) / 100.0;
                // A ray along a face, or one that grazes a corner, may or may not hit.
                prop_assert!(end == 0.0 || distance(t) > -ROUNDING, "inside at {t}: {hit:?}");
            }
            if let Some(hit) = hit {
                prop_assert!(distance(hit.t) < ROUNDING * (1.0 + ray.direction.length()), "{hit:?}");
                prop_assert!((hit.normal.length() - 1.0).abs() < 1e-6);
                prop_assert!(hit.t == 0.0 || hit.normal.dot(ray.direction) <= ROUNDING);
            }
        }

        #[test]
        fn no_ray_slips_through_between_two_triangles(
            corners in prop::array::uniform4(vector(1.0)),
            origin in vector(3.0),
            along in 0.0..1.0,
        ) {
            let [a, b, c, d] = corners.map(|corner| corner.as_vec3());
            let target = a.as_dvec3().lerp(b.as_dvec3(), along);
            let through = Ray { origin, direction: target - origin, max: 2.0 };
            let side = |corner: Vec3| {
                let [a, b, corner] = [a, b, corner].map(|p| p.as_dvec3() - origin);
                a.cross(b).dot(corner)
            };
            // Seen from the origin on different sides of the edge that they share, and neither from its edge.
            let d = if side(c) * side(d) > 0.0 { a + b - d } else { d };
            prop_assume!(side(c).abs() > 1e-3 && side(d).abs() > 1e-3);
            let hits = [[a, b, c], [b, a, d]].map(|corners| ray_to_triangle(&through, corners));
            let hit = hits[0].or(hits[1]);
            prop_assert!(hit.is_some_and(|hit| (hit.t - 1.0).abs() < 1e-5), "{hits:?}");
        }
    }

    #[test]
    fn round_shapes_are_exact_also_from_afar() {
        let ball = Convex::new(vec![Vec3::new(0.0, 0.0, 0.01)], Vec::new(), Vec::new(), 0.02);
        let from_afar = Ray { origin: DVec3::new(-1e5, 0.0, 0.0), direction: DVec3::X * 2.0, max: 1e6 };
        let hit = ray_to_convex(&from_afar, &ball).unwrap();
        let height = f64::from(0.01_f32) / f64::from(0.02_f32);
        let exact = 0.5 * (1e5 - f64::from(0.02_f32) * (1.0 - height * height).sqrt());
        assert!((hit.t - exact).abs() < 1e-10, "{} {exact}", hit.t);
        assert!((hit.normal.z + height).abs() < 1e-9);

        let capsule = Convex::new(vec![Vec3::NEG_Y, Vec3::Y], Vec::new(), Vec::new(), 0.5);
        let times =
            |x: f64, y: f64| ray_to_convex(&ray(DVec3::new(x, y, -3.0), DVec3::Z), &capsule).map(|hit| hit.t);
        assert_eq!(times(0.0, 0.9), Some(2.5), "its side");
        assert_eq!(times(0.3, 0.5), Some(3.0 - 0.4), "beside its axis");
        assert_eq!(times(0.0, 1.3), Some(3.0 - 0.4), "its cap");
        assert_eq!(times(0.0, 1.501), None);
        let down = ray_to_convex(&ray(DVec3::new(0.3, 4.0, 0.0), DVec3::NEG_Y), &capsule).unwrap();
        assert!((down.t - 2.6).abs() < 1e-12 && (down.normal - DVec3::new(0.6, 0.8, 0.0)).length() < 1e-12);
    }

    #[test]
    fn what_lies_behind_or_too_far_is_not_hit_and_what_is_around_is() {
        let ball = Convex::new(vec![Vec3::ZERO], Vec::new(), Vec::new(), 0.5);
        assert_eq!(ray_to_convex(&ray(DVec3::X, DVec3::X), &ball), None);
        assert_eq!(ray_to_convex(&ray(DVec3::X * 20.0, DVec3::NEG_X), &ball), None);
        assert_eq!(ray_to_convex(&ray(DVec3::X, DVec3::ZERO), &ball), None, "a point outside");
        let inside = ray_to_convex(&ray(DVec3::X * 0.25, DVec3::ZERO), &ball);
        assert_eq!(inside, Some(RayHit { t: 0.0, normal: DVec3::X }));
    }

    #[test]
    fn a_half_space_is_entered_from_above_only() {
        let time = |y: f64, direction: DVec3| {
            ray_to_half_space(&ray(DVec3::new(4.0, y, 0.0), direction), DVec3::Y, 1.0).map(|hit| hit.t)
        };
        assert_eq!(time(3.0, DVec3::new(7.0, -0.5, 0.0)), Some(4.0));
        assert_eq!(time(3.0, DVec3::Y), None);
        assert_eq!(time(3.0, DVec3::X), None);
        assert_eq!(time(0.5, DVec3::Y), Some(0.0));
        assert_eq!(time(30.0, DVec3::NEG_Y), None, "too far");
    }
}
