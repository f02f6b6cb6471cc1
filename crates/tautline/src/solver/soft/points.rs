//! The particles of all awake cloth and rope, coordinate by coordinate, so that eight are moved at a time.

use std::ops::{Deref, DerefMut};

use glam::Vec3;

use super::rest::Calming;
use crate::simd::{LANES, Lanes, Numbers, Vec3x8, read};

/// Numbers by place: all x, all y, all z.
pub(super) type Coordinates = [Numbers; 3];

/// Particles by place. Where a place is of no particle, it weighs nothing (inverse mass 0) and is far from all others.
///
/// A particle is at x = x₀ + e, and has moved by d = e − r in this small step. All that moves it adds to e, which is small,
/// so that what two particles give each other is rounded alike; x₀, which is large, is rounded once in a small step, and
/// what that leaves is carried on as r. Were a large number rounded with every correction, momentum would drift.
///
/// `R` is how numbers are held that contacts only read, `W` those that they write: see [`PointSlices`].
#[derive(Debug, Clone, Default)]
pub(super) struct Points<R = Numbers, W = Numbers> {
    /// x₀, in m: where the small step began, to the nearest number.
    pub(super) start: [R; 3],
    /// e, in m: how far the particle is from there.
    pub(super) offset: [W; 3],
    /// r, in m: how far it was from there when the small step began.
    pub(super) remainder: [W; 3],
    /// What forces add to the displacement in a small step, in m; as long as the others only if there are any.
    pub(super) kick: [R; 3],
    /// 1/m, in 1/kg; 0 = held.
    pub(super) inverse_mass: R,
    /// 1 where there is a particle, 0 where there is none.
    pub(super) presence: R,
}

/// All points in slices of one length, for what pushes them here and there: one comparison tells that a particle is there, or
/// eight.
pub(super) type PointSlices<'a> = Points<&'a [f32], &'a mut [f32]>;

/// Places that belong to nothing, apart by this much in m.
const NOWHERE: f32 = 1e6;

impl Points {
    /// Forgets all, and makes room for so many places; a multiple of eight, and eight more that only reading needs.
    pub(super) fn reset(&mut self, places: usize) {
        let length = places.next_multiple_of(LANES) + LANES;
        for numbers in [&mut self.start, &mut self.offset, &mut self.remainder].into_iter().flatten() {
            numbers.clear();
            numbers.resize(length, 0.0);
        }
        for (place, x) in self.start[0].iter_mut().enumerate() {
            *x = NOWHERE * (1.0 + place as f32 / 1024.0);
        }
        self.kick.iter_mut().for_each(Numbers::clear);
        for numbers in [&mut self.inverse_mass, &mut self.presence] {
            numbers.clear();
            numbers.resize(length, 0.0);
        }
    }

    /// Puts a particle where a small step begins, or ends, that has moved it by `motion` (m).
    pub(super) fn put(&mut self, place: usize, position: Vec3, motion: Vec3) {
        set(&mut self.start, place, position);
        set(&mut self.offset, place, Vec3::ZERO);
        set(&mut self.remainder, place, -motion);
    }

    /// For what pushes particles here and there.
    #[inline(always)]
    pub(super) fn slices(&mut self) -> PointSlices<'_> {
        let Self { start, offset, remainder, kick, inverse_mass, presence } = self;
        let count = inverse_mass.len();
        PointSlices {
            start: cut(start, count),
            offset: cut_mut(offset, count),
            remainder: cut_mut(remainder, count),
            kick: cut(kick, kick[0].len()),
            inverse_mass,
            presence,
        }
    }

    /// What kernels move, and the inverse masses of the particles.
    #[inline(always)]
    pub(super) fn moving(&mut self) -> (Moving<'_>, &[f32]) {
        let Self { start, offset, inverse_mass, .. } = self;
        (Moving { start, offset }, inverse_mass)
    }

    /// Moves a held particle on by `motion` (m), to the bit.
    pub(super) fn lead(&mut self, place: usize, motion: Vec3) {
        let at = self.at(place);
        set(&mut self.start, place, at);
        set(&mut self.offset, place, motion);
        set(&mut self.remainder, place, Vec3::ZERO);
    }

    /// Ends a substep: where a particle is, what rounding left of that and how it moves are told apart without a loss, so
    /// that substeps are as steps.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn settle<L: Lanes>(&mut self) {
        let Self { start, offset, remainder, .. } = self;
        for ((start, offset), remainder) in start.iter_mut().zip(offset).zip(remainder) {
            let numbers = eights_mut(start).iter_mut().zip(eights_mut(offset)).zip(eights_mut(remainder));
            for ((start, offset), remainder) in numbers {
                let [at, rest, back] = settled([L::read(start), L::read(offset), L::read(remainder)]);
                at.write(start);
                rest.write(offset);
                back.write(remainder);
            }
        }
    }

    /// What rounding left of where a particle is when a substep ends, in m.
    pub(super) fn rest(&self, place: usize) -> Vec3 {
        get(&self.offset, place)
    }

    /// Has a particle moved by `motion` (m) in this small step, to where it is.
    pub(super) fn set_motion(&mut self, place: usize, motion: Vec3) {
        let offset = get(&self.offset, place);
        set(&mut self.remainder, place, offset - motion);
    }

    /// Begins a small step (paper, Eq 1): gravity is added, and all moves on, each particle by `limit` (m) at most. Returns how
    /// far the fastest goes, in m.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn integrate<L: Lanes>(&mut self, places: std::ops::Range<usize>, step: SmallStep) -> f32 {
        let fall = Vec3x8::<L>::splat(step.fall);
        let (keep, limit, tiny) = (L::splat(step.keep), L::splat(step.limit), L::splat(1e-30));
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let Self { start, offset, remainder, kick, inverse_mass, .. } = self;
        let (mut starts, mut offsets, mut remainders) =
            (Eights::of(start), Eights::of(offset), Eights::of(remainder));
        let kicks = Eights::of(kick);
        let (masses, is_kicked) = (eights(inverse_mass), !kicks.0[0].is_empty());
        let (share, per_lively) = (L::splat(step.calming.share), L::splat(1.0 / step.calming.lively));
        let most = if step.calming.share > 0.0 { zero } else { limit * limit };
        let (mut fastest, mut fastest_squared) = (zero, zero);
        let masses = &masses[..places.end / LANES];
        for (eight, mass) in masses.iter().enumerate().skip(places.start / LANES) {
            let is_free = L::read(mass).greater(zero);
            let moved = offsets.read::<L>(eight);
            let mut motion = (moved - remainders.read(eight)) * keep + fall;
            if is_kicked {
                motion = motion + kicks.read(eight);
            }
            let squared = motion.length_squared();
            if squared.greater(most).bits() == 0 {
                // Neither too fast nor to be calmed: nearly always.
                motion = Vec3x8::new(is_free.and(motion.x), is_free.and(motion.y), is_free.and(motion.z));
                fastest_squared = fastest_squared.max(is_free.and(squared));
            } else {
                let length = squared.max(tiny).sqrt();
                let mut kept = one - share * (one - length * per_lively).max(zero);
                if length.greater(limit).bits() != 0 {
                    kept = kept.min(limit / length);
                }
                motion = motion * is_free.and(kept);
                fastest = fastest.max(is_free.and(length.min(limit)));
            }
            let (begin, rest) = sum(starts.read(eight), moved);
            starts.write(eight, begin);
            remainders.write(eight, rest);
            offsets.write(eight, rest + motion);
        }
        fastest.max(fastest_squared.sqrt()).largest()
    }
}

impl<R: Deref<Target = [f32]>, W: DerefMut<Target = [f32]>> Points<R, W> {
    #[inline(always)]
    pub(super) fn at(&self, place: usize) -> Vec3 {
        get(&self.start, place) + get(&self.offset, place)
    }

    /// Where a particle was when this small step began, in m: what pushes it there turns it about anything by that arm.
    #[inline(always)]
    pub(super) fn begun_at(&self, place: usize) -> Vec3 {
        get(&self.start, place) + get(&self.remainder, place)
    }

    /// As [`Points::begun_at`], of the eight particles from `place` on.
    #[inline(always)]
    pub(super) fn eight_begun_at<L: Lanes>(&self, place: usize) -> Vec3x8<L> {
        Vec3x8::read(&self.start, place) + Vec3x8::read(&self.remainder, place)
    }

    /// Where the eight particles from `place` on are, in m.
    #[inline(always)]
    pub(super) fn eight_at<L: Lanes>(&self, place: usize) -> Vec3x8<L> {
        Vec3x8::read(&self.start, place) + Vec3x8::read(&self.offset, place)
    }

    /// Moves a particle by `shift` (m), which becomes velocity.
    #[inline(always)]
    pub(super) fn shift(&mut self, place: usize, shift: Vec3) {
        add(&mut self.offset, place, shift);
    }

    /// Moves a particle by `shift` (m) without giving it velocity.
    #[inline(always)]
    pub(super) fn carry(&mut self, place: usize, shift: Vec3) {
        add(&mut self.offset, place, shift);
        add(&mut self.remainder, place, shift);
    }

    /// How far a particle has moved in this small step, in m.
    #[inline(always)]
    pub(super) fn motion(&self, place: usize) -> Vec3 {
        get(&self.offset, place) - get(&self.remainder, place)
    }

    /// How far the eight particles from `place` on have moved in this small step, in m.
    #[inline(always)]
    pub(super) fn motion_of_eight<L: Lanes>(&self, place: usize) -> Vec3x8<L> {
        Vec3x8::read(&self.offset, place) - Vec3x8::read(&self.remainder, place)
    }

    /// Moves the eight particles from `place` on, which becomes velocity.
    #[inline(always)]
    pub(super) fn shift_eight<L: Lanes>(&mut self, place: usize, shift: Vec3x8<L>) {
        (Vec3x8::read(&self.offset, place) + shift).write(&mut self.offset, place);
    }

    /// Whether there are eight places from this one on.
    #[inline(always)]
    pub(super) fn has_eight_at(&self, place: usize) -> bool {
        has_eight(&self.inverse_mass, place)
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

/// a + b, rounded, and what that leaves (Knuth, The Art of Computer Programming 2, 4.2.2, theorem B).
#[inline(always)]
fn sum<L: Lanes>(a: Vec3x8<L>, b: Vec3x8<L>) -> (Vec3x8<L>, Vec3x8<L>) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// A coordinate's start, offset and remainder, with the offset in the start, such that the offset is what rounding leaves,
/// and the offset less the remainder the motion, exactly: the smaller of the two loses what the larger has no digits for.
#[inline(always)]
fn settled<L: Lanes>([start, offset, remainder]: [L; 3]) -> [L; 3] {
    let motion = offset - remainder;
    let at = start + offset;
    let of_offset = at - start;
    let rest = (start - (at - of_offset)) + (offset - of_offset);
    let back = rest - motion;
    let is_slow = rest.max(-rest).greater(motion.max(-motion));
    let rest = is_slow.select(rest, back + motion);
    let is_rest = (at + rest).equal(at);
    [at, is_rest.and(rest), is_rest.select(back, -motion)]
}

/// Particles that a kernel moves: where their small step began, and how far they are from there.
pub(super) struct Moving<'a> {
    pub(super) start: &'a Coordinates,
    pub(super) offset: &'a mut Coordinates,
}

impl Moving<'_> {
    /// In groups of eight from the first place on.
    #[inline(always)]
    pub(super) fn eights(&mut self) -> MovingEights<'_> {
        MovingEights { start: of(self.start), offset: Eights::of(self.offset) }
    }
}

/// Moving particles in groups of eight places.
pub(super) struct MovingEights<'a> {
    start: [&'a [[f32; LANES]]; 3],
    offset: Eights<'a>,
}

impl MovingEights<'_> {
    /// Where the small step of the eight of this number began, and how far they are from there.
    #[inline(always)]
    pub(super) fn read<L: Lanes>(&self, eight: usize) -> [Vec3x8<L>; 2] {
        let [x, y, z] = self.start;
        let start = Vec3x8::new(L::read(&x[eight]), L::read(&y[eight]), L::read(&z[eight]));
        [start, self.offset.read(eight)]
    }

    /// Puts them so far from where their small step began.
    #[inline(always)]
    pub(super) fn write<L: Lanes>(&mut self, eight: usize, offset: Vec3x8<L>) {
        self.offset.write(eight, offset);
    }
}

#[inline(always)]
fn of(numbers: &Coordinates) -> [&[[f32; LANES]]; 3] {
    let [x, y, z] = numbers.each_ref().map(|numbers| eights(numbers));
    let count = x.len().min(y.len()).min(z.len());
    [&x[..count], &y[..count], &z[..count]]
}

/// Moving particles, eight from any place on, and their inverse masses: as many of all, so that one comparison tells whether
/// there are eight.
pub(super) struct Knots<'a> {
    start: [&'a [f32]; 3],
    offset: [&'a mut [f32]; 3],
    inverse_mass: &'a [f32],
}

impl<'a> Knots<'a> {
    #[inline(always)]
    pub(super) fn of<'b: 'a>(moving: &'a mut Moving<'b>, masses: &'a [f32]) -> Self {
        let Moving { start, offset } = moving;
        let lengths = start.iter().chain(offset.iter()).map(|numbers| numbers.len());
        let count = lengths.fold(masses.len(), usize::min);
        Self { start: cut(start, count), offset: cut_mut(offset, count), inverse_mass: &masses[..count] }
    }

    #[inline(always)]
    pub(super) fn has_eight_at(&self, place: usize) -> bool {
        has_eight(self.inverse_mass, place)
    }

    /// Where the small step of the eight from `place` on began, and how far they are from there.
    #[inline(always)]
    pub(super) fn read<L: Lanes>(&self, place: usize) -> [Vec3x8<L>; 2] {
        [Vec3x8::read(&self.start, place), Vec3x8::read(&self.offset, place)]
    }

    #[inline(always)]
    pub(super) fn inverse_masses<L: Lanes>(&self, place: usize) -> L {
        read(self.inverse_mass, place)
    }

    /// Puts them so far from where their small step began.
    #[inline(always)]
    pub(super) fn write<L: Lanes>(&mut self, place: usize, offset: Vec3x8<L>) {
        offset.write(&mut self.offset, place);
    }
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
fn eights_mut(numbers: &mut [f32]) -> &mut [[f32; LANES]] {
    numbers.as_chunks_mut().0
}

/// The first numbers of each coordinate.
#[inline(always)]
fn cut([x, y, z]: &Coordinates, count: usize) -> [&[f32]; 3] {
    [&x[..count], &y[..count], &z[..count]]
}

/// As [`cut`].
#[inline(always)]
fn cut_mut([x, y, z]: &mut Coordinates, count: usize) -> [&mut [f32]; 3] {
    [&mut x[..count], &mut y[..count], &mut z[..count]]
}

#[inline(always)]
fn has_eight(numbers: &[f32], place: usize) -> bool {
    numbers.len().checked_sub(LANES).is_some_and(|last| place <= last)
}

#[inline(always)]
pub(super) fn get(numbers: &[impl Deref<Target = [f32]>; 3], place: usize) -> Vec3 {
    Vec3::new(numbers[0][place], numbers[1][place], numbers[2][place])
}

#[inline(always)]
fn add(numbers: &mut [impl DerefMut<Target = [f32]>; 3], place: usize, by: Vec3) {
    for (numbers, by) in numbers.iter_mut().zip(by.to_array()) {
        numbers[place] += by;
    }
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
