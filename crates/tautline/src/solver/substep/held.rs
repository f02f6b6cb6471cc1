//! Where two parts touch, as it is kept from step to step with the multipliers that hold it.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::body::Touch;
use crate::simd::Row;

/// The most points that a pair is held at.
pub(crate) const MOST_POINTS: usize = 4;

/// The contact of a pair, with as many points as it has. It is rows of eight numbers because the solver reads it for
/// eight pairs at a time: first the header, then two rows for each point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Held {
    rows: Box<[Row]>,
}

/// Rows of a point.
const POINT_ROWS: usize = 2;

/// One point of a contact: a material point of either body.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct HeldPoint {
    /// On a, in its frame (m); the normal multiplier (kg m); on b, in its frame (m); the key's bits.
    anchors: Row,
    /// What the anchors have slid, to be taken off their distance (m, world); 0; the tangential multiplier (kg m,
    /// world); 0.
    friction: Row,
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
        let mut held = Self { rows: vec![Row::ZERO; 1 + POINT_ROWS * points.len()].into() };
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
        for (rows, point) in self.rows[1..].chunks_exact_mut(POINT_ROWS).zip(points) {
            rows.copy_from_slice(&[point.anchors, point.friction]);
        }
    }

    /// Whether it has so many points, 1 at least, and its numbers are finite, names aside.
    pub(super) fn is_sound(&self, count: usize) -> bool {
        let are_finite = |numbers: &[f32]| numbers.iter().all(|number| number.is_finite());
        self.rows.len() == 1 + POINT_ROWS * count
            && are_finite(&self.rows[0].0)
            && self.points().all(|point| are_finite(&point.anchors.0[..7]) && are_finite(&point.friction.0))
    }

    fn count(&self) -> usize {
        self.rows.len() / POINT_ROWS
    }

    /// Normal from a to b (unit, world), friction, restitution, rolling friction (m).
    #[inline(always)]
    pub(super) fn header(held: Option<&Self>) -> &Row {
        held.and_then(|held| held.rows.first()).unwrap_or(&NOTHING)
    }

    /// The anchors and the friction of point k, see [`HeldPoint`].
    #[inline(always)]
    pub(super) fn rows_of_point(held: Option<&Self>, k: usize) -> [&Row; POINT_ROWS] {
        let rows = held.and_then(|held| held.rows.get(1 + POINT_ROWS * k..1 + POINT_ROWS * (k + 1)));
        match rows {
            Some([anchors, friction]) => [anchors, friction],
            _ => [&NOTHING; POINT_ROWS],
        }
    }

    pub(super) fn points(&self) -> impl Iterator<Item = HeldPoint> {
        let points = self.rows.get(1..).unwrap_or_default().chunks_exact(POINT_ROWS);
        points.map(|rows| HeldPoint { anchors: rows[0], friction: rows[1] })
    }

    /// The anchors and the friction of point k, if it has that.
    #[inline(always)]
    pub(super) fn rows_of_point_mut(&mut self, k: usize) -> Option<&mut [Row; POINT_ROWS]> {
        self.rows.get_mut(1 + POINT_ROWS * k..)?.first_chunk_mut()
    }

    pub(crate) fn normal(&self) -> Vec3 {
        vector(&self.rows[0], 0)
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

    pub(super) fn slip(&self) -> Vec3 {
        vector(&self.friction, 0)
    }

    pub(super) fn tangent_impulse(&self) -> Vec3 {
        vector(&self.friction, 4)
    }

    /// Goes on as another point did: with its multipliers, and with what it has slid.
    pub(super) fn continue_from(&mut self, normal_impulse: f32, tangent_impulse: Vec3, slip: Vec3) {
        self.anchors.0[3] = normal_impulse;
        set_vector(&mut self.friction, 0, slip);
        set_vector(&mut self.friction, 4, tangent_impulse);
    }
}
