//! Where two parts touch, as it is kept from step to step with the multipliers that hold it.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::body::Touch;
use crate::simd::Row;

/// The most points that a pair is held at.
pub(crate) const MOST_POINTS: usize = 4;

/// The name of points that are not there.
pub(super) const NAMELESS: u32 = 0;

/// The contact of a pair. It is rows of eight numbers because the solver reads it for eight pairs at a time.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Held {
    /// Normal from a to b (unit, world), friction, restitution, rolling friction (m).
    pub(super) header: Row,
    pub(super) points: [HeldPoint; MOST_POINTS],
}

/// One point of a contact: a material point of either body.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct HeldPoint {
    /// On a, in its frame (m); the normal multiplier (kg m); on b, in its frame (m); the key's bits.
    pub(super) anchors: Row,
    /// What the anchors have slid, to be taken off their distance (m, world); 0; the tangential multiplier (kg m,
    /// world); 0.
    pub(super) friction: Row,
}

fn vector(row: &Row, at: usize) -> Vec3 {
    Vec3::new(row.0[at], row.0[at + 1], row.0[at + 2])
}

fn set_vector(row: &mut Row, at: usize, value: Vec3) {
    row.0[at..at + 3].copy_from_slice(&value.to_array());
}

impl Held {
    pub(super) const EMPTY: Self = Self {
        header: Row::ZERO,
        points: [HeldPoint { anchors: Row::ZERO, friction: Row::ZERO }; MOST_POINTS],
    };

    pub(crate) fn new(normal: Vec3, touch: Touch) -> Self {
        let mut held = Self::default();
        set_vector(&mut held.header, 0, normal);
        held.header.0[3..6].copy_from_slice(&[touch.friction, touch.restitution, touch.rolling_friction]);
        held
    }

    /// Whether its numbers are finite, names aside.
    pub(super) fn is_sound(&self) -> bool {
        let points =
            self.points.iter().flat_map(|point| point.anchors.0[..7].iter().chain(&point.friction.0));
        self.header.0.iter().chain(points).all(|number| number.is_finite())
    }

    pub(crate) fn normal(&self) -> Vec3 {
        vector(&self.header, 0)
    }

    pub(super) fn friction(&self) -> f32 {
        self.header.0[3]
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

    /// Whether it is one: contacts have room for more points than they need.
    pub(super) fn is_there(&self) -> bool {
        self.key() != NAMELESS
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
