//! When moving shapes first touch: conservative advancement (Mirtich 1996, "Impulse-based dynamic simulation of rigid
//! body systems", 2.3.2). However the shapes turn, along the normal n between them they come nearer at most at some
//! speed, so for the time gap / speed they cannot touch; after that the gap is measured anew.
//!
//! Every time found is a lower bound: it is never late. Without rotation the gap is a convex function of time and this
//! is Newton's iteration on it; with rotation the gap shrinks by a factor each time.

use glam::{DMat3, DQuat, DVec3, Vec3};

use crate::geometry::distance;
use crate::geometry::epa::Epa;
use crate::geometry::gjk::{self, Proximity};
use crate::geometry::simplex::CsoVertex;
use crate::geometry::support::Support;
use crate::norm::Norm;
use crate::shape::Convex;

/// Once an advance is smaller, as part of the whole motion, the time is good enough.
const CLOSE_ENOUGH: f64 = 1e-6;
/// Most advances. Only shapes that turn fast and just miss each other need as many; they count as touching.
const MAX_ADVANCES: usize = 256;

/// The points within `radius` of the convex hull of `corners`, at least one, in m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rounded<'a> {
    pub(crate) corners: &'a [Vec3],
    pub(crate) radius: f32,
}

impl<'a> Rounded<'a> {
    pub(crate) fn of(part: &'a Convex) -> Self {
        Self { corners: &part.vertices, radius: part.radius }
    }
}

/// A shape that moves steadily for a unit of time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion<'a> {
    pub(crate) shape: Rounded<'a>,
    /// Where the shape's origin, which it turns about, starts, in m.
    pub(crate) position: DVec3,
    /// From the shape's frame to the world's, at the start.
    pub(crate) rotation: DQuat,
    /// The way of the origin, in m.
    pub(crate) linear: DVec3,
    /// Axis times angle, in rad.
    pub(crate) angular: DVec3,
}

impl<'a> Motion<'a> {
    /// Without rotation.
    pub(crate) fn translation(shape: Rounded<'a>, position: DVec3, rotation: DQuat, linear: DVec3) -> Self {
        Self { shape, position, rotation, linear, angular: DVec3::ZERO }
    }

    fn at(&self, time: f64) -> Placed<'a> {
        let turn = DQuat::from_scaled_axis(self.angular * time);
        let axes = DMat3::from_quat(turn * self.rotation);
        Placed { shape: self.shape, position: self.position + self.linear * time, axes }
    }

    /// The largest distance of a corner from the axis that it turns about: that it keeps.
    fn arm(&self) -> f64 {
        let axis = self.rotation.inverse() * self.angular.unit_or_zero();
        self.shape.corners.iter().map(|corner| axis.cross(corner.as_dvec3()).norm()).fold(0.0, f64::max)
    }
}

/// A shape somewhere.
#[derive(Debug, Clone, Copy)]
struct Placed<'a> {
    shape: Rounded<'a>,
    position: DVec3,
    axes: DMat3,
}

impl Support for Placed<'_> {
    fn support(&self, direction: DVec3) -> u32 {
        let direction = self.axes.transpose() * direction;
        let (mut farthest, mut index) = (f64::NEG_INFINITY, 0);
        for (i, corner) in (0..).zip(self.shape.corners) {
            let height = corner.as_dvec3().dot(direction);
            if height > farthest {
                (farthest, index) = (height, i);
            }
        }
        index
    }

    fn point(&self, index: u32) -> DVec3 {
        self.position + self.axes * self.shape.corners[index as usize].as_dvec3()
    }
}

/// How far two shapes are apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Separation {
    /// In m, below 0 if they overlap. Never more than it is.
    pub(crate) gap: f64,
    /// Unit, from A to B.
    pub(crate) normal: DVec3,
    /// The point of B's surface closest to A, or deepest in it, in m.
    pub(crate) point: DVec3,
}

/// When two shapes first touch, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Touch {
    /// From 0 to 1; 0 if they touch from the start.
    pub(crate) time: f64,
    pub(crate) at: Separation,
}

/// How far two shapes are apart at the start of their motions.
pub(crate) fn separation(a: &Motion, b: &Motion) -> Separation {
    measure(&a.at(0.0), &b.at(0.0), &mut (b.position - a.position).as_vec3())
}

/// When two shapes come as near as `target` (m, 0 or more) to each other; `None` if they do not while they move.
///
/// Never late, and early by about a millionth of the motion at most, unless they pass each other at about this
/// distance.
pub(crate) fn first_touch(a: &Motion, b: &Motion, target: f64) -> Option<Touch> {
    let (arm_a, arm_b) = (a.arm(), b.arm());
    let closing = |normal: DVec3| {
        // (ω × r) · n = (n × ω) · r, of which only the part of r across ω counts.
        let turning = normal.cross(a.angular).norm() * arm_a + normal.cross(b.angular).norm() * arm_b;
        (a.linear - b.linear).dot(normal) + turning
    };
    let mut axis = (b.position - a.position).as_vec3();
    advance(target, closing, |time| measure(&a.at(time), &b.at(time), &mut axis))
}

/// [`first_touch`] of a shape and the solid n · x < offset, which does not move; n is unit.
pub(crate) fn first_touch_of_half_space(
    a: &Motion,
    normal: DVec3,
    offset: f64,
    target: f64,
) -> Option<Touch> {
    let turning = normal.cross(a.angular).norm() * a.arm();
    let closing = |_| turning - a.linear.dot(normal);
    advance(target, closing, |time| {
        let placed = a.at(time);
        let lowest = placed.point(placed.support(-normal));
        let height = normal.dot(lowest) - offset;
        let gap = height - f64::from(a.shape.radius);
        Separation { gap, normal: -normal, point: lowest - normal * height }
    })
}

fn advance(
    target: f64,
    closing: impl Fn(DVec3) -> f64,
    mut separation: impl FnMut(f64) -> Separation,
) -> Option<Touch> {
    let mut time = 0.0;
    let mut at = separation(time);
    for _ in 0..MAX_ADVANCES {
        let left = at.gap - target;
        if left <= 0.0 {
            break;
        }
        let speed = closing(at.normal);
        let step = left / speed;
        if speed <= 0.0 || time + step > 1.0 {
            return None;
        }
        time += step;
        at = separation(time);
        if step < CLOSE_ENOUGH {
            break;
        }
    }
    Some(Touch { time, at })
}

/// `axis` leads from A to B, roughly, or is zero; it is replaced by what it is.
fn measure(a: &Placed, b: &Placed, axis: &mut Vec3) -> Separation {
    let radii = [a.shape.radius, b.shape.radius].map(f64::from);
    let gjk = gjk::closest(a, b, axis);
    if gjk.proximity == Proximity::Intersecting {
        return overlap(a, b, axis, radii);
    }
    let (vertices, weights) = gjk.simplex.triangle();
    let on_b: DVec3 = vertices.into_iter().zip(weights).map(|(v, weight)| b.point(v.b) * weight).sum();
    let normal = (-gjk.simplex.closest_point()).unit_or(axis.as_dvec3());
    // What separates them along this normal is certain, also where GJK stopped short of the closest points.
    let gap = -normal.dot(CsoVertex::support(a, b, normal).point);
    Separation { gap: gap - radii[0] - radii[1], normal, point: on_b - normal * radii[1] }
}

/// Of shapes whose cores overlap.
fn overlap(a: &Placed, b: &Placed, axis: &mut Vec3, radii: [f64; 2]) -> Separation {
    let found = distance::contact(a, b, axis, &mut Epa::default()).features;
    let normal = found.map_or(*axis, |found| found.normal).as_dvec3().unit_or(DVec3::Y);
    let (depth, point) =
        found.map_or((0.0, b.position), |found| (f64::from(found.depth), found.point_b.as_dvec3()));
    Separation { gap: -depth - radii[0] - radii[1], normal, point: point - normal * radii[1] }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tests::{parts, vector};
    use super::*;

    const POINT: &[Vec3] = &[Vec3::ZERO];

    fn ball(radius: f32, position: DVec3, linear: DVec3) -> Motion<'static> {
        Motion::translation(Rounded { corners: POINT, radius }, position, DQuat::IDENTITY, linear)
    }

    fn motion<'a>(part: &'a Convex, [position, turn, linear, angular]: [DVec3; 4]) -> Motion<'a> {
        let rotation = DQuat::from_scaled_axis(turn);
        Motion { shape: Rounded::of(part), position, rotation, linear, angular }
    }

    /// The gap as the public query on points finds it.
    fn gap(a: &Motion, b: &Motion, time: f64) -> f64 {
        let corners = |motion: &Motion| -> Vec<Vec3> {
            let placed = motion.at(time);
            (0..placed.shape.corners.len() as u32).map(|i| placed.point(i).as_vec3()).collect()
        };
        let found = distance::distance(&corners(a), &corners(b)).unwrap();
        f64::from(found.distance - a.shape.radius - b.shape.radius)
    }

    proptest! {
        #[test]
        fn balls_touch_when_their_centres_are_as_far_as_their_radii(
            start in vector(3.0),
            way in vector(6.0),
            radii in prop::array::uniform2(0.01_f32..1.0),
        ) {
            let (a, b) = (ball(radii[0], DVec3::ZERO, way), ball(radii[1], start, DVec3::ZERO));
            let reach = f64::from(radii[0]) + f64::from(radii[1]);
            let [aa, ab, bb] = [way.dot(way), way.dot(start), start.dot(start) - reach * reach];
            let exact = (ab - (ab * ab - aa * bb).sqrt()) / aa;
            match first_touch(&a, &b, 0.0) {
                Some(touch) if bb > 0.0 => {
                    let late = (touch.time - exact) * aa.sqrt();
                    // Exact is NaN if they just miss, which has to be by less than rounding.
                    prop_assert!(late < 1e-9 && late > -2e-5 || ab * ab - aa * bb < 1e-4, "{late}");
                }
                Some(touch) => prop_assert!(touch.time == 0.0 && (touch.at.gap - start.length() + reach).abs() < 1e-9),
                None => prop_assert!(!(0.0..=1.0).contains(&exact)),
            }
        }

        #[test]
        fn nothing_overlaps_before_the_first_touch(
            parts in prop::array::uniform2(parts()),
            start in prop::array::uniform2(vector(2.0)),
            turn in prop::array::uniform2(vector(3.0)),
            linear in prop::array::uniform2(vector(4.0)),
            angular in prop::array::uniform2(vector(6.0)),
            turns in any::<bool>(),
        ) {
            let angular = if turns { angular } else { [DVec3::ZERO; 2] };
            let [a, b] = [0, 1].map(|i| motion(&parts[i], [start[i], turn[i], linear[i], angular[i]]));
            let touch = first_touch(&a, &b, 0.0);
            let end = touch.map_or(1.0, |touch| touch.time);
            for i in 0..60 {
                let time = end * f64::from(i) / 60.0;
                prop_assert!(end == 0.0 || gap(&a, &b, time) > -2e-6, "overlap at {time}: {touch:?}");
            }
            if let Some(Touch { time, at }) = touch {
                let found = gap(&a, &b, time);
                prop_assert!(time > 0.0 || (found - at.gap).abs() < 1e-4, "{found} {at:?}");
                prop_assert!(time == 0.0 || found < 1e-4, "early: {found} at {time}");
                prop_assert!((at.normal.length() - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_turning_rod_reaches_floor_and_ball_at_the_exact_angle() {
        let rod = [Vec3::NEG_X, Vec3::X];
        let turning = |angle: f64| Motion {
            shape: Rounded { corners: &rod, radius: 0.0 },
            position: DVec3::Y * 0.5,
            rotation: DQuat::IDENTITY,
            linear: DVec3::ZERO,
            angular: DVec3::Z * angle,
        };
        // sin(ωt) = 1/2 for its end on the floor.
        let exact = std::f64::consts::FRAC_PI_6 / 1.5;
        let floor = first_touch_of_half_space(&turning(1.5), DVec3::Y, 0.0, 0.0).unwrap();
        assert!(floor.time <= exact && floor.time > exact - 1e-5, "{} {exact}", floor.time);
        assert!((floor.at.point - DVec3::new(-0.75_f64.sqrt(), 0.0, 0.0)).length() < 1e-5);
        assert!(first_touch_of_half_space(&turning(0.5), DVec3::Y, 0.0, 0.0).is_none());
        // sin(φ − ωt) = r/d for its side at a ball at the angle φ, here 90°, at the distance d.
        let above = ball(0.1, DVec3::Y * 1.0, DVec3::ZERO);
        let exact = (std::f64::consts::FRAC_PI_2 - (f64::from(0.1_f32) / 0.5).asin()) / 3.0;
        let touch = first_touch(&turning(3.0), &above, 0.0).unwrap();
        assert!(touch.time <= exact && touch.time > exact - 1e-5, "{} {exact}", touch.time);
        let around_itself = Motion { angular: DVec3::X * 1e3, linear: DVec3::X, ..turning(0.0) };
        assert!(
            first_touch(&around_itself, &above, 0.0).is_none(),
            "what turns about its axis sweeps nothing"
        );
    }

    #[test]
    fn a_bullet_does_not_pass_a_sheet_however_far_from_the_origin() {
        let sheet = [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
        for place in [DVec3::ZERO, DVec3::new(1e4, -1e4, 1e4)] {
            let bullet = ball(0.005, place - DVec3::Z * 50.0, DVec3::Z * 100.0);
            let shape = Rounded { corners: &sheet, radius: 0.0 };
            let sheet = Motion::translation(shape, place, DQuat::IDENTITY, DVec3::ZERO);
            let touch = first_touch(&bullet, &sheet, 1e-3).unwrap();
            let exact = (50.0 - f64::from(0.005_f32) - 1e-3) / 100.0;
            assert!((touch.time - exact).abs() < 1e-9 && touch.time <= exact + 1e-12, "{}", touch.time);
            assert!((touch.at.gap - 1e-3).abs() < 1e-8 && (touch.at.point - place).length() < 1e-8);
            let back = Motion { linear: DVec3::NEG_Z, ..bullet };
            assert!(first_touch(&back, &sheet, 1e-3).is_none());
        }
    }

    #[test]
    fn what_overlaps_is_separated_by_its_depth_along_the_normal() {
        let cube: Vec<Vec3> =
            (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
        let shape = Rounded { corners: &cube, radius: 0.0 };
        let place = |position| Motion::translation(shape, position, DQuat::IDENTITY, DVec3::ONE);
        let (a, b) = (place(DVec3::ZERO), place(DVec3::new(0.1, 0.8, 0.3)));
        let found = separation(&a, &b);
        assert!((found.gap + 0.2).abs() < 1e-6 && (found.normal - DVec3::Y).length() < 1e-6, "{found:?}");
        assert!(separation(&a, &place(b.position + found.normal * 0.2001)).gap > 0.0);
        assert_eq!(first_touch(&a, &b, 0.0), Some(Touch { time: 0.0, at: found }));
        assert!(separation(&a, &a).gap <= 0.0);
    }
}
