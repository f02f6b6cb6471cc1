//! Rolling friction: a moment that opposes the turning of two bodies against each other, at most the normal impulse
//! times a length.

use crate::simd::{Lanes, Row, Vec3x8};

use super::batch::{Batch, HeaderRows, PointRows};
use super::block::Rows3;
use super::contact::Body;
use super::prepare::Frames;

/// Eight pairs of which some have rolling friction.
#[derive(Debug, Clone, Default)]
pub(super) struct Rolling {
    /// The number of their batch.
    pub(super) batch: u32,
    /// In m.
    friction: Row,
    /// √I⁻¹ Rᵀd of either body, for the normal and both tangents.
    turns_a: [Rows3; 3],
    turns_b: [Rows3; 3],
    masses: [Row; 3],
    /// The multipliers, in kg m².
    impulses: [Row; 3],
}

impl Rolling {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn new<L: Lanes>(
        number: u32,
        friction: Row,
        header: &HeaderRows,
        [a, b]: &[Frames<L>; 2],
    ) -> Self {
        let mut rolling = Self { batch: number, friction, ..Self::default() };
        let [first, second] = &header.tangents;
        for (axis, rows) in [&header.normal, first, second].into_iter().enumerate() {
            let direction = Vec3x8::<L>::load(rows);
            let (turn_a, turn_b) = (a.turn(direction), b.turn(direction));
            let compliance = turn_a.length_squared() * a.response + turn_b.length_squared() * b.response;
            (L::splat(1.0) / compliance.max(L::splat(f32::MIN_POSITIVE))).store(&mut rolling.masses[axis]);
            turn_a.store(&mut rolling.turns_a[axis]);
            turn_b.store(&mut rolling.turns_b[axis]);
        }
        rolling
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn resist<L: Lanes>(
        &mut self,
        (batch, points): (&Batch, &[PointRows]),
        velocities: &mut [Row],
    ) {
        let (mut a, mut b) =
            (Body::<L>::gather(velocities, &batch.a), Body::<L>::gather(velocities, &batch.b));
        let mut pressed = L::splat(0.0);
        for point in points {
            pressed = pressed + L::load(&point.normal_impulse);
        }
        let limit = pressed * L::load(&self.friction);
        for axis in 0..3 {
            let (turn_a, turn_b) =
                (Vec3x8::<L>::load(&self.turns_a[axis]), Vec3x8::<L>::load(&self.turns_b[axis]));
            let turning = turn_b.dot(b.angular) - turn_a.dot(a.angular);
            let old = L::load(&self.impulses[axis]);
            let new = (old - turning * L::load(&self.masses[axis])).min(limit).max(-limit);
            new.store(&mut self.impulses[axis]);
            let impulse = new - old;
            a.angular = a.angular - turn_a * (impulse * a.response);
            b.angular = b.angular + turn_b * (impulse * b.response);
        }
        L::scatter(a.columns(), velocities, &batch.a);
        L::scatter(b.columns(), velocities, &batch.b);
    }
}
