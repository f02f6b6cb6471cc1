//! Restitution: contacts at which bodies meet fast enough part again at a share of the speed they met at.
//!
//! A substep lets them meet exactly (see `contact`) and then asks for the speed apart. Between two substeps gravity
//! goes on: with the opening speed u over the last substep (its middle), the acceleration a and the distance s, all
//! along the normal and over h, they meet at w = √((u + a/2)² − 2 a s), and the speed in the middle of the next
//! substep has to be e w − a/2. A ball that is dropped then comes back to e² of its height, whatever the substep.
//!
//! What would not meet in a substep by the motion it has when the substep begins does not feel the contact in it: a
//! blow passes on from body to body, one in each substep, as in a row of hanging balls.

use crate::simd::{LANES, Lanes, Row, rows_at};

use super::batch::{Batch, HeaderRows, PointRows};
use super::contact::{Body, opening, push_apart, solve_friction};
use super::held::MOST_POINTS;
use super::prepare::OUT_OF_REACH;

/// Eight pairs of which some have restitution.
#[derive(Debug, Clone)]
pub(super) struct Bounce {
    /// The number of their batch.
    pub(super) batch: u32,
    restitution: Row,
    points: [BouncePoint; MOST_POINTS],
}

#[derive(Debug, Clone, Copy, Default)]
struct BouncePoint {
    /// The speed apart that is asked for, over a substep, in m.
    target: Row,
    /// A mask: the bodies meet in this substep.
    meets: Row,
    /// A mask: the contact is not felt in this substep.
    is_off: Row,
    /// How far apart the surfaces were then, in m.
    separation: Row,
}

/// The slowest approach that bounces, in m/s; and how many substeps of gravity are added to it.
const LEAST_SPEED: f32 = 0.02;
const GRAVITY_STEPS: f32 = 2.0;
/// Most visits of the contacts of a blow that goes through several bodies.
pub(super) const MOST_VISITS: usize = 32;
/// How often the points of bodies that meet are visited in turn before these move: one visit would turn what lands flat.
pub(super) const LANDING_VISITS: usize = 32;

impl Bounce {
    pub(super) fn new(batch: u32, restitution: Row) -> Self {
        Self { batch, restitution, points: [BouncePoint::default(); MOST_POINTS] }
    }

    /// Before forces act: takes out the impulses of the last substep's blows, and finds who meets now.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn meet<L: Lanes>(
        &mut self,
        (batch, header, points): (&Batch, &HeaderRows, &mut [PointRows]),
        (velocities, kicks): (&[Row], &[Row]),
        accumulated: &mut [Row],
        h: f32,
    ) {
        let zero = L::splat(0.0);
        let (a, b) = (Body::<L>::gather(velocities, &batch.a), Body::gather(velocities, &batch.b));
        let (kick_a, kick_b) = (Body::<L>::gather(kicks, &batch.a), Body::gather(kicks, &batch.b));
        let mut sum_a = a.with_rows(L::gather(rows_at(accumulated, &batch.a)));
        let mut sum_b = b.with_rows(L::gather(rows_at(accumulated, &batch.b)));
        let restitution = L::load(&self.restitution);
        for (bounce, rows) in self.points.iter_mut().zip(points) {
            let met = L::load(&bounce.meets);
            let normal = met.and(L::load(&rows.normal_impulse));
            let tangents =
                [met.and(L::load(&rows.tangent_impulses[0])), met.and(L::load(&rows.tangent_impulses[1]))];
            push_apart(header, rows, [-normal, -tangents[0], -tangents[1]], &mut sum_a, &mut sum_b);
            (L::load(&rows.normal_impulse) - normal).store(&mut rows.normal_impulse);
            for (row, tangent) in rows.tangent_impulses.iter_mut().zip(tangents) {
                (L::load(row) - tangent).store(row);
            }

            let speed = opening(header, rows, &a, &b);
            let acceleration = opening(header, rows, &kick_a, &kick_b);
            let separation = L::load(&rows.separation);
            let comes_near = zero.greater(separation + speed + acceleration);
            let least = acceleration * L::splat(GRAVITY_STEPS) - L::splat(LEAST_SPEED * h);
            let meets = comes_near.and(least.min(zero).greater(speed)).and(restitution.greater(zero));
            let half = acceleration * L::splat(0.5);
            let ahead = separation.max(zero);
            let met_at =
                ((speed + half) * (speed + half) - (acceleration + acceleration) * ahead).max(zero).sqrt();
            (restitution * met_at - half).store(&mut bounce.target);
            meets.store(&mut bounce.meets);

            let is_off = restitution.greater(zero).and(separation.greater(zero));
            let is_off = comes_near.select(zero, is_off);
            is_off.store(&mut bounce.is_off);
            separation.store(&mut bounce.separation);
            is_off.select(L::splat(OUT_OF_REACH), separation).store(&mut rows.separation);
        }
        L::scatter(sum_a.changes(), accumulated, &batch.a);
        L::scatter(sum_b.changes(), accumulated, &batch.b);
    }

    /// Whether any of its bodies meet in this substep.
    pub(super) fn is_landing(&self) -> bool {
        self.points.iter().any(|point| point.meets.0.iter().any(|mask| mask.to_bits() != 0))
    }

    /// After the relaxing pass: the contacts that were not felt have moved too.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn wake<L: Lanes>(
        &mut self,
        (batch, header, points): (&Batch, &HeaderRows, &mut [PointRows]),
        velocities: &[Row],
    ) {
        let (a, b) = (Body::<L>::gather(velocities, &batch.a), Body::gather(velocities, &batch.b));
        for (bounce, rows) in self.points.iter().zip(points) {
            let moved = L::load(&bounce.separation) + opening(header, rows, &a, &b);
            L::load(&bounce.is_off).select(moved, L::load(&rows.separation)).store(&mut rows.separation);
        }
    }

    /// Gives the bodies that met their speed apart. Tells whether any impulse changed.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn part<L: Lanes>(
        &self,
        (batch, header, points): (&Batch, &HeaderRows, &mut [PointRows]),
        velocities: &mut [Row],
    ) -> bool {
        let zero = L::splat(0.0);
        let (mut a, mut b) = (Body::<L>::gather(velocities, &batch.a), Body::gather(velocities, &batch.b));
        let mut has_changed = 0;
        for (bounce, rows) in self.points.iter().zip(points) {
            let old = L::load(&rows.normal_impulse);
            let felt = L::load(&bounce.meets).and(old.greater(zero));
            let speed = opening(header, rows, &a, &b);
            let wanted = (L::load(&bounce.target) - speed) * L::load(&rows.normal_mass) + old;
            let new = felt.select(wanted.max(zero), old);
            let change = new - old;
            // What rounding leaves is no change.
            let noise = new * L::splat(1e-5);
            has_changed |= (change * change).greater(noise * noise).bits();
            new.store(&mut rows.normal_impulse);
            push_apart(header, rows, [change, zero, zero], &mut a, &mut b);
            solve_friction(header, rows, felt, &mut a, &mut b);
        }
        L::scatter(a.columns(), velocities, &batch.a);
        L::scatter(b.columns(), velocities, &batch.b);
        has_changed != 0
    }

    /// The impulses of a blow are over: they are not there in the next step.
    pub(super) fn forget_blows(&self, points: &mut [PointRows]) {
        for (bounce, rows) in self.points.iter().zip(points) {
            for lane in 0..LANES {
                if bounce.meets.0[lane].to_bits() != 0 {
                    rows.normal_impulse.0[lane] = 0.0;
                    rows.tangent_impulses.iter_mut().for_each(|row| row.0[lane] = 0.0);
                }
            }
        }
    }
}
