//! The particles of all awake cloth and rope, coordinate by coordinate, so that eight are moved at a time.

use glam::Vec3;

use super::rest::Calming;
use crate::simd::{LANES, Lanes, Vec3x8, read};

/// Numbers by place: all x, all y, all z.
pub(super) type Coordinates = [Vec<f32>; 3];

/// Particles by place. Where a place is of no particle, it weighs nothing (inverse mass 0) and is far from all others.
///
/// The Verlet pair is kept as in the store, a position and a displacement, not as two positions. What constraints do to
/// positions is found by comparison with where the integrator had put them, and so what nothing touches is never
/// rounded to the grid of its coordinates.
#[derive(Debug, Clone, Default)]
pub(super) struct Points {
    /// x, in m.
    pub(super) position: Coordinates,
    /// x as the integrator left it, in m.
    pub(super) predicted: Coordinates,
    /// The motion over a small step, in m, as the integrator left it.
    pub(super) displacement: Coordinates,
    /// What forces add to the displacement in a small step, in m; as long as the others only if there are any.
    pub(super) kick: Coordinates,
    /// 1/m, in 1/kg; 0 = held.
    pub(super) inverse_mass: Vec<f32>,
    /// 1 where there is a particle, 0 where there is none.
    pub(super) presence: Vec<f32>,
}

/// Places that belong to nothing, apart by this much in m.
const NOWHERE: f32 = 1e6;

impl Points {
    /// Forgets all, and makes room for so many places; a multiple of eight, and eight more that only reading needs.
    pub(super) fn reset(&mut self, places: usize) {
        let length = places.next_multiple_of(LANES) + LANES;
        for numbers in [&mut self.position, &mut self.predicted, &mut self.displacement].into_iter().flatten()
        {
            numbers.clear();
            numbers.resize(length, 0.0);
        }
        for (place, x) in self.position[0].iter_mut().enumerate() {
            *x = NOWHERE * (1.0 + place as f32 / 1024.0);
        }
        self.predicted[0].clone_from(&self.position[0]);
        self.kick.iter_mut().for_each(Vec::clear);
        for numbers in [&mut self.inverse_mass, &mut self.presence] {
            numbers.clear();
            numbers.resize(length, 0.0);
        }
    }

    #[inline(always)]
    pub(super) fn at(&self, place: usize) -> Vec3 {
        get(&self.position, place)
    }

    /// Moves a particle by `shift` (m).
    #[inline(always)]
    pub(super) fn shift(&mut self, place: usize, shift: Vec3) {
        for (numbers, by) in self.position.iter_mut().zip(shift.to_array()) {
            numbers[place] += by;
        }
    }

    /// Moves a particle by `shift` (m) without giving it velocity.
    #[inline(always)]
    pub(super) fn carry(&mut self, place: usize, shift: Vec3) {
        for numbers in [&mut self.position, &mut self.predicted] {
            for (numbers, by) in numbers.iter_mut().zip(shift.to_array()) {
                numbers[place] += by;
            }
        }
    }

    /// Moves a held particle on by `motion` (m).
    pub(super) fn lead(&mut self, place: usize, motion: Vec3) {
        let to = self.at(place) + motion;
        set(&mut self.position, place, to);
        set(&mut self.predicted, place, to);
        set(&mut self.displacement, place, motion);
    }

    /// How far a particle has moved in this small step, in m.
    #[inline(always)]
    pub(super) fn motion(&self, place: usize) -> Vec3 {
        get(&self.displacement, place) + (self.at(place) - get(&self.predicted, place))
    }

    /// As [`Points::motion`], of eight.
    #[inline(always)]
    pub(super) fn motions<L: Lanes>(&self, place: usize) -> Vec3x8<L> {
        let moved = Vec3x8::<L>::read(&self.position, place) - Vec3x8::read(&self.predicted, place);
        Vec3x8::read(&self.displacement, place) + moved
    }

    /// Ends the last small step and begins the next one (paper, Eq 1): what constraints did becomes motion, gravity is
    /// added, and all moves on, each particle by `limit` (m) at most. Returns how far the fastest goes, in m.
    #[inline(always)]
    pub(super) fn integrate<L: Lanes>(&mut self, places: std::ops::Range<usize>, step: SmallStep) -> f32 {
        let fall = Vec3x8::<L>::splat(step.fall);
        let (keep, limit, tiny) = (L::splat(step.keep), L::splat(step.limit), L::splat(1e-30));
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let Self { position, predicted, displacement, kick, inverse_mass, .. } = self;
        let (mut positions, mut starts) = (Eights::of(position), Eights::of(predicted));
        let (mut displacements, kicks) = (Eights::of(displacement), Eights::of(kick));
        let (masses, is_kicked) = (eights(inverse_mass), !kicks.0[0].is_empty());
        let (share, per_lively) = (L::splat(step.calming.share), L::splat(1.0 / step.calming.lively));
        let mut fastest = zero;
        let masses = &masses[..places.end / LANES];
        for (eight, mass) in masses.iter().enumerate().skip(places.start / LANES) {
            let is_free = L::read(mass).greater(zero);
            let at = positions.read::<L>(eight);
            let moved = displacements.read(eight) + (at - starts.read(eight));
            let mut motion = moved * keep + fall;
            if is_kicked {
                motion = motion + kicks.read(eight);
            }
            let length = motion.length_squared().max(tiny).sqrt();
            let lost = share * (one - length * per_lively).max(zero);
            motion = motion * is_free.and((limit / length).min(one - lost));
            fastest = fastest.max(is_free.and(length.min(limit)));
            displacements.write(eight, motion);
            positions.write(eight, at + motion);
            starts.write(eight, at + motion);
        }
        fastest.largest()
    }

    /// A mask of those of eight places where there is a particle.
    #[inline(always)]
    pub(super) fn are_there<L: Lanes>(&self, place: usize) -> L {
        read::<L>(&self.presence, place).greater(L::splat(0.0))
    }
}

/// What the integrator does in a small step.
#[derive(Debug, Clone, Copy)]
pub(super) struct SmallStep {
    /// What is left of the last displacement.
    pub(super) keep: f32,
    /// What gravity adds to it, in m.
    pub(super) fall: Vec3,
    /// The longest a displacement may be, in m.
    pub(super) limit: f32,
    pub(super) calming: Calming,
}

/// Coordinates in groups of eight places: what is read and written so needs one comparison, and no more looking up of
/// where the numbers are.
pub(super) struct Eights<'a>([&'a mut [[f32; LANES]]; 3]);

impl<'a> Eights<'a> {
    #[inline(always)]
    pub(super) fn of(numbers: &'a mut Coordinates) -> Self {
        let [x, y, z] = numbers;
        let [x, y, z] = [x.as_chunks_mut().0, y.as_chunks_mut().0, z.as_chunks_mut().0];
        let count = x.len().min(y.len()).min(z.len());
        Self([&mut x[..count], &mut y[..count], &mut z[..count]])
    }

    /// The eight of this number.
    #[inline(always)]
    pub(super) fn read<L: Lanes>(&self, eight: usize) -> Vec3x8<L> {
        let [x, y, z] = &self.0;
        Vec3x8::new(L::read(&x[eight]), L::read(&y[eight]), L::read(&z[eight]))
    }

    #[inline(always)]
    pub(super) fn write<L: Lanes>(&mut self, eight: usize, value: Vec3x8<L>) {
        let [x, y, z] = &mut self.0;
        value.x.write(&mut x[eight]);
        value.y.write(&mut y[eight]);
        value.z.write(&mut z[eight]);
    }
}

/// Numbers in groups of eight.
#[inline(always)]
pub(super) fn eights(numbers: &[f32]) -> &[[f32; LANES]] {
    numbers.as_chunks().0
}

#[inline(always)]
pub(super) fn get(numbers: &Coordinates, place: usize) -> Vec3 {
    Vec3::new(numbers[0][place], numbers[1][place], numbers[2][place])
}

#[inline(always)]
pub(super) fn set(numbers: &mut Coordinates, place: usize, value: Vec3) {
    for (numbers, number) in numbers.iter_mut().zip(value.to_array()) {
        numbers[place] = number;
    }
}

/// Adds to eight positions.
#[inline(always)]
pub(super) fn add<L: Lanes>(positions: &mut Coordinates, place: usize, shift: Vec3x8<L>) {
    (Vec3x8::read(positions, place) + shift).write(positions, place);
}

/// A mask of the first `count` lanes.
#[inline(always)]
pub(super) fn first<L: Lanes>(count: usize) -> L {
    const NUMBERS: [f32; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    L::splat(count as f32).greater(L::read(&NUMBERS))
}

#[cfg(test)]
#[path = "tests/points.rs"]
mod tests;
