//! When two things that move meet: a vertex and a face, or two edges, each corner on a straight line of its own. It may be
//! too early, but never misses.
//!
//! Conservative advancement along separating axes (Mirtich 1996, Impulse-based dynamic simulation of rigid body systems,
//! 2.3): of the closest points at some time the direction between them is kept as an axis, and along an axis every corner
//! moves evenly, so that the time until which it still separates is exact. There the next axis is found. What the closest
//! points suffer from rounding only makes the axis worse, not the answer wrong.

use glam::{DVec3, Vec3};

use super::closest::{closest_between_segments, closest_on_triangle};
use crate::error::{Error, all_coordinates, within};
use crate::norm::Norm;

/// Most axes that are tried before two things count as meeting.
const MAX_AXES: u32 = 64;
/// What heights along an axis may suffer from rounding, as part of the extent of all corners and ways: 50 roundings.
const ROUNDING: f64 = 1e-14;
/// As part of the same extent, nearer than this counts as meeting.
const MEETING: f64 = 1e-9;

/// When a moving vertex may first be within `margin` (m) of a moving face, as a share of the motion: 0 at its start, 1 at its
/// end. `vertex` and `face` are the places at the start and at the end, in m, between which every corner moves evenly on a
/// straight line; faces that are segments or points are allowed.
///
/// `None` is certain: they stay further apart than `margin` all the time. A time may be too early, or for a pair that only
/// comes close; that takes passing at less than `margin` and a billionth of the size of the whole, or tangled motions that 64
/// axes do not tell apart.
///
/// # Errors
///
/// [`Error::OutOfRange`] names a coordinate that is not from −1e9 to 1e9, such as `face[1][2].x`, or a `margin` that is not
/// from 0 to 1e9.
pub fn vertex_face(vertex: [Vec3; 2], face: [[Vec3; 3]; 2], margin: f32) -> Result<Option<f32>, Error> {
    all_coordinates("vertex", &vertex)?;
    all_coordinates("face[0]", &face[0])?;
    all_coordinates("face[1]", &face[1])?;
    let gap = |[p]: [DVec3; 1], corners: [DVec3; 3]| {
        let weights = closest_on_triangle(p, corners);
        corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2] - p
    };
    let origin = face[0][0];
    first_meeting(paths(vertex.map(|p| [p]), origin), paths(face, origin), margin, gap)
}

/// When two moving edges may first be within `margin` (m) of each other; otherwise as [`vertex_face`]. `a` and `b` are the
/// ends at the start and at the end.
///
/// # Errors
///
/// [`Error::OutOfRange`] names a coordinate that is not from −1e9 to 1e9, such as `a[1][0].x`, or a `margin` that is not from
/// 0 to 1e9.
pub fn edge_edge(a: [[Vec3; 2]; 2], b: [[Vec3; 2]; 2], margin: f32) -> Result<Option<f32>, Error> {
    for (name, edge) in [("a", &a), ("b", &b)] {
        all_coordinates(&format!("{name}[0]"), &edge[0])?;
        all_coordinates(&format!("{name}[1]"), &edge[1])?;
    }
    let gap = |a: [DVec3; 2], b: [DVec3; 2]| {
        let [on_a, on_b] = closest_between_segments(a, b);
        b[0] * on_b[0] + b[1] * on_b[1] - a[0] * on_a[0] - a[1] * on_a[1]
    };
    let origin = a[0][0];
    first_meeting(paths(a, origin), paths(b, origin), margin, gap)
}

/// A point that moves evenly from one place to another.
#[derive(Debug, Clone, Copy)]
struct Path {
    start: DVec3,
    way: DVec3,
}

/// Relative to an origin that is near, so that little is lost far from that of the world.
fn paths<const N: usize>([start, end]: [[Vec3; N]; 2], origin: Vec3) -> [Path; N] {
    std::array::from_fn(|i| {
        let [start, end] = [start[i], end[i]].map(|p| p.as_dvec3() - origin.as_dvec3());
        Path { start, way: end - start }
    })
}

impl Path {
    fn at(&self, time: f64) -> DVec3 {
        self.start + self.way * time
    }

    fn extent(&self) -> f64 {
        self.start.abs().max_element() + self.way.abs().max_element()
    }
}

/// `gap` leads from the closest point of A to that of B.
fn first_meeting<const A: usize, const B: usize>(
    a: [Path; A],
    b: [Path; B],
    margin: f32,
    gap: impl Fn([DVec3; A], [DVec3; B]) -> DVec3,
) -> Result<Option<f32>, Error> {
    let margin = f64::from(within("margin", margin, 0.0, 1e9, "a distance from 0 to 1e9 m")?);
    let extent = margin + a.iter().chain(&b).map(Path::extent).fold(0.0, f64::max);
    let (sure, meeting) = (margin + ROUNDING * extent, margin + MEETING * extent);
    let mut time = 0.0;
    for _ in 0..MAX_AXES {
        let gap = gap(a.map(|path| path.at(time)), b.map(|path| path.at(time)));
        let distance = gap.norm();
        if distance <= meeting {
            return Ok(Some(not_after(time)));
        }
        let until = separated_until(&a, &b, gap / distance, sure, time);
        if until > 1.0 {
            return Ok(None);
        }
        if until <= time {
            break;
        }
        time = until;
    }
    Ok(Some(not_after(time)))
}

/// The time, from `time` on, until which every point of B is higher than every point of A along a unit axis by `apart`.
fn separated_until(a: &[Path], b: &[Path], axis: DVec3, apart: f64, time: f64) -> f64 {
    let mut until = f64::INFINITY;
    for (p, q) in a.iter().flat_map(|p| b.iter().map(move |q| (p, q))) {
        let height = axis.dot(q.start - p.start);
        let speed = axis.dot(q.way - p.way);
        if height + speed * time <= apart {
            return time;
        }
        if speed < 0.0 {
            until = until.min((apart - height) / speed);
        }
    }
    until
}

/// The largest f32 that is not above a time from 0 to 1.
fn not_after(time: f64) -> f32 {
    let rounded = time as f32;
    if f64::from(rounded) > time { rounded.next_down().max(0.0) } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACE: [Vec3; 3] = [Vec3::NEG_X, Vec3::X, Vec3::Z];

    fn assert_just_before(found: Result<Option<f32>, Error>, expected: f32) {
        let time = found.unwrap().unwrap();
        assert!((expected - 1e-6..=expected).contains(&time), "{time} is not {expected}");
    }

    #[test]
    fn a_vertex_falls_on_a_face() {
        let fall = [Vec3::new(0.0, 3.0, 0.25), Vec3::new(0.0, -1.0, 0.25)];
        assert_just_before(vertex_face(fall, [FACE; 2], 0.0), 0.75);
        assert_just_before(vertex_face(fall, [FACE; 2], 1.0), 0.5);
        let up = [fall[1], fall[1] - Vec3::Y];
        assert_eq!(vertex_face(up, [FACE; 2], 0.5).unwrap(), None);
        assert_eq!(vertex_face(up, [FACE; 2], 1.0).unwrap(), Some(0.0));
    }

    #[test]
    fn a_vertex_beside_a_face_that_turns_over_is_missed() {
        let turned = FACE.map(|p| Vec3::new(-p.x, p.y, p.z));
        let beside = Vec3::new(1.1, 0.0, 0.5);
        assert_eq!(vertex_face([beside; 2], [FACE, turned], 0.0).unwrap(), None);
    }

    #[test]
    fn edges_that_cross_meet_when_they_are_in_one_plane() {
        let still = [Vec3::NEG_X, Vec3::X];
        let at = |y: f32| [Vec3::new(0.5, y, -1.0), Vec3::new(0.5, y, 1.0)];
        assert_just_before(edge_edge([still; 2], [at(1.0), at(-3.0)], 0.0), 0.25);
        assert_eq!(edge_edge([still; 2], [at(1.0), at(0.5)], 0.25).unwrap(), None);
    }

    #[test]
    fn bad_input_is_refused_by_name() {
        let refusal = |found: Result<Option<f32>, Error>| match found {
            Err(Error::OutOfRange { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        let bad = [Vec3::X, Vec3::new(0.0, f32::NAN, 0.0)];
        assert_eq!(refusal(vertex_face(bad, [FACE; 2], 0.0)), "vertex[1].y");
        assert_eq!(refusal(edge_edge([[Vec3::ZERO; 2]; 2], [[Vec3::X; 2], bad], 0.0)), "b[1][1].y");
        assert_eq!(refusal(vertex_face([Vec3::X; 2], [FACE; 2], -1.0)), "margin");
    }
}
