//! How pieces turn, and how angular momentum is given back that contacts and tetrahedra take by mistake.
//!
//! Particles that touch are a thickness apart, and so friction between them is a couple: it takes angular momentum from
//! them that only the cloth around could take up. How much is known at each contact. It is summed up, and given back
//! as a turn of the whole in the same small step: a turn changes no length and no momentum. Nor is it friction what turns
//! with the whole as if it were one body. Then contacts that rub lose energy ω · M less than the plain friction, and giving
//! back M costs just that, so that together they never gain any.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::{DMat3, DVec3, Vec3};

use super::piece::Piece;
use super::points::Points;
use crate::simd::{LANES, Lanes, Row, Vec3x8, read};

/// What is as thin as a line has a trace of inertia × trace of its inverse above this.
const LINEAR: f64 = 200.0;

/// How particles move as a whole in a small step, from where they were when it began.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spin {
    /// In kg.
    mass: f64,
    /// Centre of mass c, in m.
    center: DVec3,
    /// Of the centre of mass, in m.
    motion: DVec3,
    /// Σ m (x − c) × d, in kg m².
    pub(super) momentum: DVec3,
    /// In kg m².
    inertia: DMat3,
}

impl Spin {
    pub(super) fn of(points: &Points, places: Range<usize>) -> Self {
        let is_free = |place: &usize| points.inverse_mass[*place] > 0.0;
        let particles = || {
            places.clone().filter(is_free).map(|place| {
                let mass = 1.0 / f64::from(points.inverse_mass[place]);
                (mass, points.begun_at(place).as_dvec3(), points.motion(place).as_dvec3())
            })
        };
        let (mut mass, mut center, mut motion) = (0.0, DVec3::ZERO, DVec3::ZERO);
        for (m, x, d) in particles() {
            mass += m;
            center += x * m;
            motion += d * m;
        }
        let (center, motion) = (center / mass, motion / mass);
        let (mut momentum, mut inertia) = (DVec3::ZERO, DMat3::ZERO);
        for (m, x, d) in particles() {
            let arm = x - center;
            momentum += arm.cross(d) * m;
            inertia += of_point(m, arm);
        }
        Self { mass, center, motion, momentum, inertia }
    }

    /// As [`Spin::of`] in one pass over eight at a time, in f32 about one of them: to some millionths.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn sketched<L: Lanes>(points: &Points, places: Range<usize>) -> Self {
        let origin = points.begun_at(places.start);
        let zero = L::splat(0.0);
        let mut sums = [zero; SUMS];
        for place in places.step_by(LANES) {
            let inverse = read::<L>(&points.inverse_mass, place);
            let mass = inverse.greater(zero).and(L::splat(1.0) / inverse);
            let arm = points.eight_begun_at(place) - Vec3x8::splat(origin);
            let motion = points.motion_of_eight(place);
            let (first, moved) = (arm * mass, motion * mass);
            let spin = arm.cross(moved);
            let terms = [
                mass,
                first.x,
                first.y,
                first.z,
                moved.x,
                moved.y,
                moved.z,
                spin.x,
                spin.y,
                spin.z,
                first.x * arm.x,
                first.y * arm.y,
                first.z * arm.z,
                first.y * arm.z,
                first.z * arm.x,
                first.x * arm.y,
            ];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum = *sum + term;
            }
        }
        let mut totals = [0.0; SUMS];
        for (all, sum) in totals.iter_mut().zip(sums) {
            *all = total(sum);
        }
        let [mass, x, y, z, p, q, r, l, m, n, xx, yy, zz, yz, zx, xy] = totals;
        let (arm, motion) = (DVec3::new(x, y, z) / mass, DVec3::new(p, q, r) / mass);
        let about_origin = DMat3::from_cols(
            DVec3::new(yy + zz, -xy, -zx),
            DVec3::new(-xy, zz + xx, -yz),
            DVec3::new(-zx, -yz, xx + yy),
        );
        Self {
            mass,
            center: origin.as_dvec3() + arm,
            motion,
            momentum: DVec3::new(l, m, n) - arm.cross(motion) * mass,
            inertia: about_origin - of_point(mass, arm),
        }
    }

    /// Of two as if they were one.
    fn with(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        let center = (self.center * self.mass + other.center * other.mass) / mass;
        let motion = (self.motion * self.mass + other.motion * other.mass) / mass;
        let (mut momentum, mut inertia) = (DVec3::ZERO, DMat3::ZERO);
        for part in [self, other] {
            let arm = part.center - center;
            momentum += part.momentum + arm.cross(part.motion - motion) * part.mass;
            inertia += part.inertia + of_point(part.mass, arm);
        }
        Self { mass, center, motion, momentum, inertia }
    }

    /// By how much it turns in a small step (rad) with so much angular momentum (kg m² in a small step). What is as thin as a
    /// line takes up little of it along itself.
    fn turn_by(&self, momentum: DVec3) -> DVec3 {
        let size = trace(&self.inertia);
        if size < f64::MIN_POSITIVE {
            return DVec3::ZERO;
        }
        let inverse_with =
            |more: f64| (self.inertia * (1.0 / size) + DMat3::from_diagonal(DVec3::splat(more))).inverse();
        let inverse = inverse_with(1e-12);
        let inverse = if trace(&inverse) < LINEAR { inverse } else { inverse_with(1.0 / LINEAR) };
        inverse * momentum / size
    }

    /// Turns particles that are among these, such that all together gain so much angular momentum (kg m² in a small step).
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn give<L: Lanes>(&self, points: &mut Points, places: Range<usize>, momentum: DVec3) {
        let turn = Vec3x8::<L>::splat(self.turn_by(momentum).as_vec3());
        let center = Vec3x8::splat(self.center.as_vec3());
        let off = Vec3x8::splat((self.center - self.center.as_vec3().as_dvec3()).as_vec3());
        for place in places.step_by(LANES) {
            let is_free = read::<L>(&points.inverse_mass, place).greater(L::splat(0.0));
            let shift = turn.cross(points.eight_begun_at(place) - center - off);
            let shift = Vec3x8::new(is_free.and(shift.x), is_free.and(shift.y), is_free.and(shift.z));
            points.shift_eight(place, shift);
        }
    }
}

/// How many sums [`Spin::sketched`] is made of.
const SUMS: usize = 16;

#[inline(always)]
fn total<L: Lanes>(lanes: L) -> f64 {
    let mut row = Row::ZERO;
    lanes.store(&mut row);
    row.0.into_iter().map(f64::from).sum()
}

fn trace(matrix: &DMat3) -> f64 {
    matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z
}

/// Of a mass (kg) at an arm (m).
fn of_point(mass: f64, arm: DVec3) -> DMat3 {
    let outer = DMat3::from_cols(arm * arm.x, arm * arm.y, arm * arm.z);
    (DMat3::from_diagonal(DVec3::splat(arm.length_squared())) - outer) * mass
}

/// The angular momentum that contacts have added by mistake, by pairs of pieces.
#[derive(Debug, Clone, Default)]
pub(super) struct Couples {
    couples: Vec<Couple>,
    /// By the numbers of their pieces, ascending.
    numbers: BTreeMap<[u32; 2], u32>,
}

/// Two pieces that may touch, or one that may touch itself.
#[derive(Debug, Clone)]
struct Couple {
    pieces: [u32; 2],
    /// `None` where something is held or leans on what does not move: that keeps no angular momentum anyway.
    spin: Option<Spin>,
    /// How the whole turns in this small step, in rad.
    turn: Vec3,
    /// In kg m² in a small step.
    moment: DVec3,
}

impl Couples {
    pub(super) fn clear(&mut self) {
        self.couples.clear();
        self.numbers.clear();
    }

    /// The number of two pieces.
    pub(super) fn number(&mut self, [a, b]: [u32; 2]) -> u32 {
        let pieces = [a.min(b), a.max(b)];
        let next = self.couples.len() as u32;
        let number = *self.numbers.entry(pieces).or_insert(next);
        if number == next {
            self.couples.push(Couple { pieces, spin: None, turn: Vec3::ZERO, moment: DVec3::ZERO });
        }
        number
    }

    /// Finds how all turn in this small step.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn look<L: Lanes>(&mut self, points: &Points, pieces: &[Piece]) {
        for Couple { pieces: pair, spin, turn, .. } in &mut self.couples {
            let [a, b] = pair.map(|number| &pieces[number as usize]);
            let is_free = |piece: &Piece| !piece.is_held() && !piece.rest.leans;
            *spin = None;
            if is_free(a) && is_free(b) {
                let of_a = Spin::sketched::<L>(points, a.places.clone());
                let is_one = a.body == b.body;
                let both =
                    if is_one { of_a } else { of_a.with(&Spin::sketched::<L>(points, b.places.clone())) };
                *spin = Some(both);
            }
            *turn = spin.map_or(Vec3::ZERO, |spin| spin.turn_by(spin.momentum).as_vec3());
        }
    }

    /// How the whole of a couple turns in this small step, in rad.
    pub(super) fn turn(&self, number: u32) -> Vec3 {
        self.couples[number as usize].turn
    }

    /// Notes that contacts have added so much, in kg m² in a small step.
    pub(super) fn add(&mut self, number: u32, moment: DVec3) {
        self.couples[number as usize].moment += moment;
    }

    /// Takes all of it back.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn give_back<L: Lanes>(&mut self, points: &mut Points, pieces: &[Piece]) {
        for Couple { pieces: [a, b], spin, moment, .. } in &mut self.couples {
            let moment = std::mem::take(moment);
            let Some(spin) = spin.filter(|_| moment != DVec3::ZERO) else { continue };
            spin.give::<L>(points, pieces[*a as usize].places.clone(), -moment);
            if a != b {
                spin.give::<L>(points, pieces[*b as usize].places.clone(), -moment);
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/spin.rs"]
mod tests;
