//! Contacts, solved eight pairs at a time.
//!
//! A point has the constraint s ≥ 0 on the distance s of its surfaces along the normal, and Coulomb's cone on the
//! tangential impulse. With J v the approach over a substep (v in the scaled variables of `block`), the multiplier
//! λ ≥ 0 and the effective mass m, one Gauss–Seidel visit is
//!
//! - still apart (s > 0): J v ≥ −s, so that what meets within the substep meets exactly;
//! - in each other (s ≤ 0): λ ← λ + m_s m (β(−s) − J v) − i_s λ, a critically overdamped spring of frequency ω and ratio
//!   ζ that does not depend on the mass: β = hω/(2ζ + hω), m_s = a/(1 + a), i_s = 1/(1 + a), a = hω(2ζ + hω)
//!   (soft constraints; Catto 2011, and Box2D's solver since).
//!
//! The biased pass moves bodies apart; after they have been moved, the relaxing pass takes the velocity that the bias
//! gave them out again. Friction is solved together with the normal from the same velocities, |λ_t| ≤ μ λ, and pulls
//! the anchors of what sticks back to each other at a quarter of the rate.

use crate::simd::{LANES, Lanes, Row, Vec3x8, rows_at};

use super::batch::{Batch, HeaderRows, PointRows};
use super::block::Rows3;

/// How a substep corrects what is in each other.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Softness {
    /// β: the share of the depth that a substep undoes.
    pub(super) bias: f32,
    /// i_s = 1 − m_s.
    give: f32,
    /// The most a substep undoes, in m.
    pub(super) limit: f32,
    /// The share of the anchors' drift that a substep undoes.
    pub(super) drift_rate: f32,
}

/// ωh / 2π: the springs' frequency as a share of the substeps' rate, 106 Hz at 1/480 s. Stiffer ones pull at joints.
const FREQUENCY: f32 = 0.22;
/// ζ: far over critical, so that nothing rings.
const DAMPING_RATIO: f32 = 10.0;
/// Drift of the anchors is undone at this share of the rate of depth.
const DRIFT_SHARE: f32 = 0.25;

impl Softness {
    /// For substeps of `h` (s) in which bodies are moved apart at no more than `speed` (m/s).
    pub(super) fn new(h: f32, speed: f32) -> Self {
        let turn = std::f32::consts::TAU * FREQUENCY;
        let damping = 2.0 * DAMPING_RATIO + turn;
        let a = turn * damping;
        let bias = turn / damping;
        Self { bias, give: 1.0 / (1.0 + a), limit: speed * h, drift_rate: bias * DRIFT_SHARE }
    }
}

/// The two passes of a substep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pass {
    /// Moves bodies apart.
    Biased,
    /// Only velocities: the constraint is J v ≥ 0.
    Relaxing,
}

/// The velocities of eight bodies.
#[derive(Clone, Copy)]
pub(super) struct Body<L> {
    linear: Vec3x8<L>,
    inverse_mass: L,
    pub(super) angular: Vec3x8<L>,
    pub(super) response: L,
}

impl<L: Lanes> Body<L> {
    #[inline(always)]
    pub(super) fn gather(rows: &[Row], index: &[u32; LANES]) -> Self {
        let [x, y, z, inverse_mass, p, q, r, response] = L::gather(rows_at(rows, index));
        let (linear, angular) = (Vec3x8::new(x, y, z), Vec3x8::new(p, q, r));
        Self { linear, inverse_mass, angular, response }
    }

    /// The same bodies with other velocities.
    #[inline(always)]
    pub(super) fn with_rows(&self, [x, y, z, _, p, q, r, _]: [L; LANES]) -> Self {
        Self { linear: Vec3x8::new(x, y, z), angular: Vec3x8::new(p, q, r), ..*self }
    }

    /// The velocities as something to be added to others.
    #[inline(always)]
    pub(super) fn changes(self) -> [L; LANES] {
        let (v, w, zero) = (self.linear, self.angular, L::splat(0.0));
        [v.x, v.y, v.z, zero, w.x, w.y, w.z, zero]
    }

    #[inline(always)]
    pub(super) fn columns(self) -> [L; LANES] {
        let (v, w) = (self.linear, self.angular);
        [v.x, v.y, v.z, self.inverse_mass, w.x, w.y, w.z, self.response]
    }

    #[inline(always)]
    fn scatter(self, rows: &mut [Row], index: &[u32; LANES]) {
        L::scatter(self.columns(), rows, index);
    }
}

/// Visits every batch once, in order; two at a time where they move no body in common, so that the processor has
/// something to do while one point waits for the one before.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn pass<L: Lanes>(
    pass: Pass,
    softness: &Softness,
    batches: &[Batch],
    headers: &[HeaderRows],
    points: &mut [PointRows],
    velocities: &mut [Row],
) {
    let mut number = 0;
    while let (Some(batch), Some(header)) = (batches.get(number), headers.get(number)) {
        number += 1;
        let mut a = Body::<L>::gather(velocities, &batch.a);
        let mut b = Body::<L>::gather(velocities, &batch.b);
        if batch.has_twin
            && let (Some(twin), Some(twin_header)) = (batches.get(number), headers.get(number))
        {
            number += 1;
            let mut twin_a = Body::<L>::gather(velocities, &twin.a);
            let mut twin_b = Body::<L>::gather(velocities, &twin.b);
            let (own, twins) =
                points[batch.range().start..twin.range().end].split_at_mut(batch.range().len());
            for k in 0..own.len().max(twins.len()) {
                if let Some(point) = own.get_mut(k) {
                    solve(pass, softness, header, point, &mut a, &mut b);
                }
                if let Some(point) = twins.get_mut(k) {
                    solve(pass, softness, twin_header, point, &mut twin_a, &mut twin_b);
                }
            }
            twin_a.scatter(velocities, &twin.a);
            twin_b.scatter(velocities, &twin.b);
        } else {
            for point in &mut points[batch.range()] {
                solve(pass, softness, header, point, &mut a, &mut b);
            }
        }
        a.scatter(velocities, &batch.a);
        b.scatter(velocities, &batch.b);
    }
}

#[inline(always)]
fn load_both<L: Lanes>(rows: &[Rows3; 2]) -> [Vec3x8<L>; 2] {
    [Vec3x8::load(&rows[0]), Vec3x8::load(&rows[1])]
}

/// One point of eight pairs: normal and friction from the same velocities.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn solve<L: Lanes>(
    pass: Pass,
    softness: &Softness,
    header: &HeaderRows,
    rows: &mut PointRows,
    a: &mut Body<L>,
    b: &mut Body<L>,
) {
    let zero = L::splat(0.0);
    let normal = Vec3x8::<L>::load(&header.normal);
    let (normal_a, normal_b) = (Vec3x8::load(&rows.normal_a), Vec3x8::load(&rows.normal_b));
    let relative = b.linear - a.linear;
    let opening = normal.dot(relative) + (normal_b.dot(b.angular) - normal_a.dot(a.angular));
    let impulse = L::load(&rows.normal_impulse);

    let separation = L::load(&rows.separation);
    let apart = separation.greater(zero);
    let mass = L::load(&rows.normal_mass);
    let new = match pass {
        Pass::Biased => {
            let correction = (separation * L::splat(-softness.bias)).min(L::splat(softness.limit));
            let target = apart.select(-separation, correction);
            let stays =
                L::splat(1.0) - apart.select(zero, L::load(&header.is_soft) * L::splat(softness.give));
            ((target - opening) * mass + impulse) * stays
        }
        Pass::Relaxing => {
            (separation + opening).store(&mut rows.separation);
            (apart.and(-separation) - opening) * mass + impulse
        }
    };
    let new = new.max(zero);
    new.store(&mut rows.normal_impulse);

    let tangents = load_both::<L>(&header.tangents);
    let tangents_a = load_both::<L>(&rows.tangents_a);
    let tangents_b = load_both::<L>(&rows.tangents_b);
    let tangent_mass = L::load(&rows.tangent_mass);
    let old = [L::load(&rows.tangent_impulses[0]), L::load(&rows.tangent_impulses[1])];
    let rate = L::splat(softness.drift_rate);
    let mut drift = [L::load(&rows.drift[0]), L::load(&rows.drift[1])];
    let mut wanted = old;
    for axis in 0..2 {
        let turning = tangents_b[axis].dot(b.angular) - tangents_a[axis].dot(a.angular);
        let slide = tangents[axis].dot(relative) + turning;
        let corrected = match pass {
            Pass::Biased => slide + drift[axis] * rate,
            Pass::Relaxing => {
                drift[axis] = drift[axis] + slide;
                slide
            }
        };
        wanted[axis] = old[axis] - corrected * tangent_mass;
    }
    // By the multiplier that this visit found: the one before is a soft pass's, too small while a contact takes up
    // its load.
    let limit = L::load(&header.friction) * new;
    let size = (wanted[0] * wanted[0] + wanted[1] * wanted[1]).max(L::splat(TINY)).sqrt();
    let over = size.greater(limit);
    let scale = over.select(limit / size, L::splat(1.0));
    let friction = [wanted[0] * scale, wanted[1] * scale];
    friction[0].store(&mut rows.tangent_impulses[0]);
    friction[1].store(&mut rows.tangent_impulses[1]);
    if pass == Pass::Relaxing {
        // The anchors of what slides follow it at once, or it would be pulled back when it stops.
        for (drift, (slid, row)) in drift.into_iter().zip(rows.slid.iter_mut().zip(&mut rows.drift)) {
            (L::load(slid) + over.and(drift)).store(slid);
            over.select(zero, drift).store(row);
        }
    }

    let change = new - impulse;
    let changes = [friction[0] - old[0], friction[1] - old[1]];
    let linear = normal * change + tangents[0] * changes[0] + tangents[1] * changes[1];
    a.linear = a.linear - linear * a.inverse_mass;
    b.linear = b.linear + linear * b.inverse_mass;
    let turn_a = normal_a * change + tangents_a[0] * changes[0] + tangents_a[1] * changes[1];
    let turn_b = normal_b * change + tangents_b[0] * changes[0] + tangents_b[1] * changes[1];
    a.angular = a.angular - turn_a * a.response;
    b.angular = b.angular + turn_b * b.response;
}

/// Squared multipliers below this are none.
const TINY: f32 = 1e-30;

/// How fast the surfaces of a point move apart along the normal, over a substep, in m.
#[inline(always)]
pub(super) fn opening<L: Lanes>(header: &HeaderRows, rows: &PointRows, a: &Body<L>, b: &Body<L>) -> L {
    let turning =
        Vec3x8::<L>::load(&rows.normal_b).dot(b.angular) - Vec3x8::<L>::load(&rows.normal_a).dot(a.angular);
    Vec3x8::load(&header.normal).dot(b.linear - a.linear) + turning
}

/// Applies impulses along the normal and the tangents to b, and their opposites to a.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn push_apart<L: Lanes>(
    header: &HeaderRows,
    rows: &PointRows,
    impulses: [L; 3],
    a: &mut Body<L>,
    b: &mut Body<L>,
) {
    let [normal, first, second] = impulses;
    let directions = load_both::<L>(&header.tangents);
    let linear = Vec3x8::load(&header.normal) * normal + directions[0] * first + directions[1] * second;
    let (turns_a, turns_b) = (load_both::<L>(&rows.tangents_a), load_both::<L>(&rows.tangents_b));
    let turn_a = Vec3x8::load(&rows.normal_a) * normal + turns_a[0] * first + turns_a[1] * second;
    let turn_b = Vec3x8::load(&rows.normal_b) * normal + turns_b[0] * first + turns_b[1] * second;
    a.linear = a.linear - linear * a.inverse_mass;
    b.linear = b.linear + linear * b.inverse_mass;
    a.angular = a.angular - turn_a * a.response;
    b.angular = b.angular + turn_b * b.response;
}

/// Stops sliding, in the lanes of a mask, as far as Coulomb's cone over the normal impulse allows.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn solve_friction<L: Lanes>(
    header: &HeaderRows,
    rows: &mut PointRows,
    mask: L,
    a: &mut Body<L>,
    b: &mut Body<L>,
) {
    let tangents = load_both::<L>(&header.tangents);
    let (turns_a, turns_b) = (load_both::<L>(&rows.tangents_a), load_both::<L>(&rows.tangents_b));
    let (relative, mass) = (b.linear - a.linear, L::load(&rows.tangent_mass));
    let old = [L::load(&rows.tangent_impulses[0]), L::load(&rows.tangent_impulses[1])];
    let mut wanted = old;
    for axis in 0..2 {
        let turning = turns_b[axis].dot(b.angular) - turns_a[axis].dot(a.angular);
        wanted[axis] = old[axis] - (tangents[axis].dot(relative) + turning) * mass;
    }
    let limit = L::load(&header.friction) * L::load(&rows.normal_impulse);
    let size = (wanted[0] * wanted[0] + wanted[1] * wanted[1]).max(L::splat(TINY)).sqrt();
    let scale = size.greater(limit).select(limit / size, L::splat(1.0));
    let new = [mask.select(wanted[0] * scale, old[0]), mask.select(wanted[1] * scale, old[1])];
    new[0].store(&mut rows.tangent_impulses[0]);
    new[1].store(&mut rows.tangent_impulses[1]);
    push_apart(header, rows, [L::splat(0.0), new[0] - old[0], new[1] - old[1]], a, b);
}
