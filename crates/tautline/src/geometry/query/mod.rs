//! Queries on single shapes: where a ray enters, which point is closest, when a moving shape touches another.
//!
//! All in f64: what comes in is f32, so that the differences of far places are exact. Whoever asks brings both into one
//! frame and turns the answer back.

mod cast;
mod closest;
mod ray;

pub(crate) use cast::{Motion, Rounded, Touch, first_touch, first_touch_of_half_space, separation};
pub(crate) use closest::{Closest, closest_to_convex, closest_to_half_space, closest_to_triangle};
pub(crate) use ray::{Ray, RayHit, ray_to_convex, ray_to_half_space, ray_to_triangle};

use glam::Vec3;

use crate::shape::{Convex, Face};

/// The triangles of a face, all from its first corner.
fn fan<'a>(part: &'a Convex, face: &Face) -> impl Iterator<Item = [Vec3; 3]> + 'a {
    let mut corners = part.corners(*face).map(|(_, corner)| corner);
    let first = corners.next().unwrap_or_default();
    let mut last = corners.next().unwrap_or_default();
    corners.map(move |next| [first, std::mem::replace(&mut last, next), next])
}

/// What the tests of all queries share.
#[cfg(test)]
mod tests {
    use glam::DVec3;
    use proptest::prelude::*;

    use super::*;
    use crate::shape::Shape;

    /// Balls, capsules, plates, rods, hulls, hulls with a radius, triangles: about 1 m large.
    pub(super) fn parts() -> impl Strategy<Value = Convex> {
        let size = || prop_oneof![Just(0.01_f32), 0.1_f32..1.0];
        let points = prop::collection::vec(prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from), 8..30);
        let hull = points.prop_map(|points| Shape::convex_hull(&points));
        let shape = prop_oneof![
            size().prop_map(Shape::sphere),
            (size(), size()).prop_map(|(radius, half)| Shape::capsule(radius, half)),
            (size(), size()).prop_map(|(radius, half)| Shape::cylinder(radius, half)),
            prop::array::uniform3(size()).prop_map(|half| Shape::cuboid(half.into())),
            hull,
        ];
        // Shrinking may leave a hull without volume.
        let solid = shape.prop_filter_map("no shape", |shape| Some(shape.ok()?.parts()[0].convex.clone()));
        let flat =
            prop::array::uniform3(prop::array::uniform3(-1.0_f32..1.0)).prop_map(|c| flat(c.map(Vec3::from)));
        (prop_oneof![4 => solid, 1 => flat], prop_oneof![3 => Just(0.0_f32), 1 => Just(0.1)]).prop_map(
            |(part, radius)| Convex::new(part.vertices, part.faces, part.loops, part.radius + radius),
        )
    }

    fn flat(corners: [Vec3; 3]) -> Convex {
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        let normal = (b - a).cross(c - a).normalize_or(DVec3::Y);
        let face = |sign: f64, first| {
            let offset = (sign * normal.dot(a)) as f32;
            Face { normal: (sign * normal).as_vec3(), offset, first, count: 3 }
        };
        Convex::new(corners.to_vec(), vec![face(1.0, 0), face(-1.0, 3)], vec![0, 1, 2, 0, 2, 1], 0.0)
    }

    pub(super) fn vector(reach: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(prop_oneof![4 => -reach..reach, 1 => Just(0.0)]).prop_map(DVec3::from)
    }
}
