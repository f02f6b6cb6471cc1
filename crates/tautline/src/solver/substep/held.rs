//! Where two parts touch, as it is kept from step to step with the multipliers that hold it.

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::tangents::Tangents;
use crate::body::Touch;
use crate::simd::Row;

/// The most points that a pair is held at.
pub(crate) const MOST_POINTS: usize = 4;

/// The contact of a pair, with as many points as it has. It is rows of eight numbers because the solver reads it for
/// eight pairs at a time: first the header, then for every two points the anchors of one, the friction of both and the
/// anchors of the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Held {
    rows: Box<[Row]>,
}

/// Where the anchors of point k are.
const fn place_of_anchors(k: usize) -> usize {
    1 + (3 * k).div_ceil(2)
}

/// Where the friction of points 2 i and 2 i + 1 is.
const fn place_of_friction(i: usize) -> usize {
    2 + 3 * i
}

/// Rows of a contact of so many points.
const fn row_count(points: usize) -> usize {
    1 + points + points.div_ceil(2)
}

/// One point of a contact: a material point of either body.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct HeldPoint {
    /// On a, in its frame (m); the normal multiplier (kg m); on b, in its frame (m); the key's bits.
    anchors: Row,
    /// Along the tangents of the contact's normal: what the anchors have slid, to be taken off their distance (m), and
    /// the multipliers (kg m).
    friction: [f32; 4],
}

/// In lanes without a pair.
static NOTHING: Row = Row::ZERO;

fn vector(row: &Row, at: usize) -> Vec3 {
    Vec3::new(row.0[at], row.0[at + 1], row.0[at + 2])
}

fn set_vector(row: &mut Row, at: usize, value: Vec3) {
    row.0[at..at + 3].copy_from_slice(&value.to_array());
}

impl Held {
    pub(crate) fn new(normal: Vec3, touch: Touch, points: &[HeldPoint]) -> Self {
        let mut held = Self { rows: vec![Row::ZERO; row_count(points.len())].into() };
        held.set(normal, touch, points);
        held
    }

    /// Has another contact in its place, in the same memory if it has as many points.
    pub(super) fn replace(&mut self, normal: Vec3, touch: Touch, points: &[HeldPoint]) {
        if self.count() == points.len() {
            self.set(normal, touch, points);
        } else {
            *self = Self::new(normal, touch, points);
        }
    }

    fn set(&mut self, normal: Vec3, touch: Touch, points: &[HeldPoint]) {
        let [x, y, z] = normal.to_array();
        self.rows[0] = Row([x, y, z, touch.friction, touch.restitution, touch.rolling_friction, 0.0, 0.0]);
        for (i, two) in points.chunks(2).enumerate() {
            let mut friction = Row::ZERO;
            for (k, point) in (2 * i..).zip(two) {
                self.rows[place_of_anchors(k)] = point.anchors;
                friction.0[4 * (k % 2)..][..4].copy_from_slice(&point.friction);
            }
            self.rows[place_of_friction(i)] = friction;
        }
    }

    /// Whether it has so many points, 1 at least, and its numbers are finite, names aside.
    pub(super) fn is_sound(&self, count: usize) -> bool {
        let are_finite = |numbers: &[f32]| numbers.iter().all(|number| number.is_finite());
        self.rows.len() == row_count(count)
            && are_finite(&self.rows[0].0)
            && self.points().all(|point| are_finite(&point.anchors.0[..7]) && are_finite(&point.friction))
    }

    fn count(&self) -> usize {
        2 * self.rows.len().saturating_sub(1) / 3
    }

    /// Normal from a to b (unit, world), friction, restitution, rolling friction (m).
    #[inline(always)]
    pub(super) fn header(held: Option<&Self>) -> &Row {
        held.and_then(|held| held.rows.first()).unwrap_or(&NOTHING)
    }

    /// The anchors of point k, see [`HeldPoint`].
    #[inline(always)]
    pub(super) fn anchors(held: Option<&Self>, k: usize) -> &Row {
        held.and_then(|held| held.rows.get(place_of_anchors(k))).unwrap_or(&NOTHING)
    }

    /// The friction of points 2 i and 2 i + 1, see [`HeldPoint`].
    #[inline(always)]
    pub(super) fn friction_of_two(held: Option<&Self>, i: usize) -> &Row {
        held.and_then(|held| held.rows.get(place_of_friction(i))).unwrap_or(&NOTHING)
    }

    #[inline(always)]
    pub(super) fn points(&self) -> impl Iterator<Item = HeldPoint> {
        (0..self.count()).map(|k| {
            let (anchors, friction) =
                (Self::anchors(Some(self), k), Self::friction_of_two(Some(self), k / 2));
            let [even @ .., _, _, _, _] = friction.0;
            let [_, _, _, _, odd @ ..] = friction.0;
            HeldPoint { anchors: *anchors, friction: if k % 2 == 0 { even } else { odd } }
        })
    }

    /// The names of its points.
    #[inline(always)]
    pub(super) fn keys(&self) -> impl Iterator<Item = u32> {
        (0..self.count()).map(|k| self.rows[place_of_anchors(k)].0[7].to_bits())
    }

    /// Keeps the normal multipliers and the friction of points 2 i and 2 i + 1, as far as it has them.
    #[inline(always)]
    pub(super) fn keep_two(
        &mut self,
        i: usize,
        normal_impulses: impl Iterator<Item = f32>,
        mut friction: Row,
    ) {
        for (k, impulse) in (2 * i..).zip(normal_impulses) {
            match self.rows.get_mut(place_of_anchors(k)) {
                Some(anchors) => anchors.0[3] = impulse,
                None => friction.0[4 * (k % 2)..][..4].fill(0.0),
            }
        }
        if let Some(row) = self.rows.get_mut(place_of_friction(i)) {
            *row = friction;
        }
    }

    pub(crate) fn normal(&self) -> Vec3 {
        vector(&self.rows[0], 0)
    }

    pub(super) fn tangents(&self) -> Tangents {
        Tangents::new(self.normal())
    }

    /// The coefficients that it has between its surfaces.
    pub(super) fn touch(&self) -> Touch {
        let [_, _, _, friction, restitution, rolling_friction, ..] = self.rows[0].0;
        Touch { friction, restitution, rolling_friction }
    }

    pub(super) fn friction(&self) -> f32 {
        self.rows[0].0[3]
    }
}

impl HeldPoint {
    pub(super) fn new(on_a: Vec3, on_b: Vec3, key: u32) -> Self {
        let mut point = Self::default();
        set_vector(&mut point.anchors, 0, on_a);
        set_vector(&mut point.anchors, 4, on_b);
        point.anchors.0[7] = f32::from_bits(key);
        point
    }

    pub(super) fn on_a(&self) -> Vec3 {
        vector(&self.anchors, 0)
    }

    pub(super) fn on_b(&self) -> Vec3 {
        vector(&self.anchors, 4)
    }

    pub(super) fn key(&self) -> u32 {
        self.anchors.0[7].to_bits()
    }

    /// In kg m.
    pub(super) fn normal_impulse(&self) -> f32 {
        self.anchors.0[3]
    }

    /// In m, along the tangents.
    pub(super) fn slip(&self) -> Vec2 {
        Vec2::new(self.friction[0], self.friction[1])
    }

    /// In kg m, along the tangents.
    pub(super) fn tangent_impulse(&self) -> Vec2 {
        Vec2::new(self.friction[2], self.friction[3])
    }

    /// Goes on as another point did: with its multipliers, and with what it has slid.
    pub(super) fn continue_from(&mut self, normal_impulse: f32, tangent_impulse: Vec2, slip: Vec2) {
        self.anchors.0[3] = normal_impulse;
        self.friction = [slip.x, slip.y, tangent_impulse.x, tangent_impulse.y];
    }
}
