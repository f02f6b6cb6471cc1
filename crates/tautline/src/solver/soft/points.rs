//! The particles of all awake cloth and rope, coordinate by coordinate, so that eight are moved at a time.

use glam::Vec3;

use super::rest::Calming;
use crate::simd::{LANES, Lanes, Vec3x8, read};

/// Numbers by place: all x, all y, all z.
pub(super) type Coordinates = [Vec<f32>; 3];

/// Particles by place. Where a place is of no particle, it weighs nothing (inverse mass 0) and is far from all others.
///
/// The Verlet pair is kept as in the store, a position and a displacement, and whatever moves a particle changes both
/// alike. Were motion found by comparing positions, it would be rounded to their grid in every small step, and impulses
/// that are opposite would not be equal.
#[derive(Debug, Clone, Default)]
pub(super) struct Points {
    /// x, in m.
    pub(super) position: Coordinates,
    /// d = x − x⁻, in m: the motion over a small step.
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
        for numbers in [&mut self.position, &mut self.displacement].into_iter().flatten() {
            numbers.clear();
            numbers.resize(length, 0.0);
        }
        for (place, x) in self.position[0].iter_mut().enumerate() {
            *x = NOWHERE * (1.0 + place as f32 / 1024.0);
        }
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

    /// What kernels move, and the inverse masses of the particles.
    #[inline(always)]
    pub(super) fn moving(&mut self) -> (Moving<'_>, &[f32]) {
        let Self { position, displacement, inverse_mass, .. } = self;
        (Moving { position, displacement }, inverse_mass)
    }

    /// Moves a particle by `shift` (m), which becomes velocity.
    #[inline(always)]
    pub(super) fn shift(&mut self, place: usize, shift: Vec3) {
        self.carry(place, shift);
        for (numbers, by) in self.displacement.iter_mut().zip(shift.to_array()) {
            numbers[place] += by;
        }
    }

    /// Moves a particle by `shift` (m) without giving it velocity.
    #[inline(always)]
    pub(super) fn carry(&mut self, place: usize, shift: Vec3) {
        for (numbers, by) in self.position.iter_mut().zip(shift.to_array()) {
            numbers[place] += by;
        }
    }

    /// Moves a held particle on by `motion` (m).
    pub(super) fn lead(&mut self, place: usize, motion: Vec3) {
        self.carry(place, motion);
        set(&mut self.displacement, place, motion);
    }

    /// How far a particle has moved in this small step, in m.
    #[inline(always)]
    pub(super) fn motion(&self, place: usize) -> Vec3 {
        get(&self.displacement, place)
    }

    /// Begins a small step (paper, Eq 1): gravity is added, and all moves on, each particle by `limit` (m) at most. Returns how
    /// far the fastest goes, in m.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn integrate<L: Lanes>(&mut self, places: std::ops::Range<usize>, step: SmallStep) -> f32 {
        let fall = Vec3x8::<L>::splat(step.fall);
        let (keep, limit, tiny) = (L::splat(step.keep), L::splat(step.limit), L::splat(1e-30));
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let Self { position, displacement, kick, inverse_mass, .. } = self;
        let (mut positions, mut displacements) = (Eights::of(position), Eights::of(displacement));
        let kicks = Eights::of(kick);
        let (masses, is_kicked) = (eights(inverse_mass), !kicks.0[0].is_empty());
        let (share, per_lively) = (L::splat(step.calming.share), L::splat(1.0 / step.calming.lively));
        let mut fastest = zero;
        let masses = &masses[..places.end / LANES];
        for (eight, mass) in masses.iter().enumerate().skip(places.start / LANES) {
            let is_free = L::read(mass).greater(zero);
            let mut motion = displacements.read::<L>(eight) * keep + fall;
            if is_kicked {
                motion = motion + kicks.read(eight);
            }
            let length = motion.length_squared().max(tiny).sqrt();
            let lost = share * (one - length * per_lively).max(zero);
            motion = motion * is_free.and((limit / length).min(one - lost));
            fastest = fastest.max(is_free.and(length.min(limit)));
            displacements.write(eight, motion);
            positions.write(eight, positions.read(eight) + motion);
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

/// Positions and displacements that a kernel moves.
pub(super) struct Moving<'a> {
    pub(super) position: &'a mut Coordinates,
    pub(super) displacement: &'a mut Coordinates,
}

impl Moving<'_> {
    /// Moves the eight particles from `place` on.
    #[inline(always)]
    pub(super) fn shift<L: Lanes>(&mut self, place: usize, by: Vec3x8<L>) {
        for numbers in [&mut *self.position, &mut *self.displacement] {
            (Vec3x8::read(numbers, place) + by).write(numbers, place);
        }
    }

    /// In groups of eight from the first place on.
    #[inline(always)]
    pub(super) fn eights(&mut self) -> MovingEights<'_> {
        MovingEights { at: Eights::of(self.position), moved: Eights::of(self.displacement) }
    }

    /// Those of two runs of `length` places, from `a` and from `b` on, which do not overlap.
    #[inline(always)]
    pub(super) fn two_runs(&mut self, a: usize, b: usize, length: usize) -> [MovingEights<'_>; 2] {
        let [at_a, at_b] = two_runs(self.position, a, b, length);
        let [moved_a, moved_b] = two_runs(self.displacement, a, b, length);
        [MovingEights { at: at_a, moved: moved_a }, MovingEights { at: at_b, moved: moved_b }]
    }
}

/// Positions and displacements in groups of eight places.
pub(super) struct MovingEights<'a> {
    at: Eights<'a>,
    moved: Eights<'a>,
}

impl MovingEights<'_> {
    /// The positions of the eight of this number.
    #[inline(always)]
    pub(super) fn read<L: Lanes>(&self, eight: usize) -> Vec3x8<L> {
        self.at.read(eight)
    }

    /// The positions of the eight of this number, and how they have moved in this small step.
    #[inline(always)]
    pub(super) fn read_both<L: Lanes>(&self, eight: usize) -> [Vec3x8<L>; 2] {
        [self.at.read(eight), self.moved.read(eight)]
    }

    /// Moves them by `by` from `at`, where they are.
    #[inline(always)]
    pub(super) fn shift<L: Lanes>(&mut self, eight: usize, at: Vec3x8<L>, by: Vec3x8<L>) {
        self.at.write(eight, at + by);
        self.moved.write(eight, self.moved.read(eight) + by);
    }
}

#[inline(always)]
fn two_runs(numbers: &mut Coordinates, a: usize, b: usize, length: usize) -> [Eights<'_>; 2] {
    let [x, y, z] = numbers;
    let ([xa, xb], [ya, yb], [za, zb]) =
        (split(x, a, b, length), split(y, a, b, length), split(z, a, b, length));
    let count = length / LANES;
    let first = Eights([&mut xa[..count], &mut ya[..count], &mut za[..count]]);
    [first, Eights([&mut xb[..count], &mut yb[..count], &mut zb[..count]])]
}

#[inline(always)]
fn split(numbers: &mut [f32], a: usize, b: usize, length: usize) -> [&mut [[f32; LANES]]; 2] {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    let (head, tail) = numbers.split_at_mut(high);
    let first = head[low..low + length].as_chunks_mut().0;
    let second = tail[..length].as_chunks_mut().0;
    if a < b { [first, second] } else { [second, first] }
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

/// A mask of the first `count` lanes.
#[inline(always)]
pub(super) fn first<L: Lanes>(count: usize) -> L {
    const NUMBERS: [f32; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    L::splat(count as f32).greater(L::read(&NUMBERS))
}

#[cfg(test)]
#[path = "tests/points.rs"]
mod tests;
