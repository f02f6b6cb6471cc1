//! All particles at hand for what pushes them here and there: contacts.

use glam::Vec3;

use super::points::Points;
use crate::simd::{LANES, Lanes, Vec3x8, read, write};

/// The numbers of [`Points`] in slices of one length: one comparison tells that a particle is there, or eight.
pub(super) struct PointSlices<'a> {
    start: [&'a [f32]; 3],
    offset: [&'a mut [f32]; 3],
    remainder: [&'a mut [f32]; 3],
    /// 1/m, in 1/kg; 0 = held.
    pub(super) inverse_mass: &'a [f32],
}

impl<'a> PointSlices<'a> {
    #[inline(always)]
    pub(super) fn of(points: &'a mut Points) -> Self {
        let Points { start, offset, remainder, inverse_mass, .. } = points;
        let count = inverse_mass.len();
        let [x, y, z] = start;
        Self {
            start: [&x[..count], &y[..count], &z[..count]],
            offset: cut(offset, count),
            remainder: cut(remainder, count),
            inverse_mass: &inverse_mass[..count],
        }
    }

    /// As [`Points::at`].
    #[inline(always)]
    pub(super) fn at(&self, place: usize) -> Vec3 {
        self.start(place) + get(&self.offset, place)
    }

    /// As [`Points::begun_at`].
    #[inline(always)]
    pub(super) fn begun_at(&self, place: usize) -> Vec3 {
        self.start(place) + get(&self.remainder, place)
    }

    /// As [`Points::motion`].
    #[inline(always)]
    pub(super) fn motion(&self, place: usize) -> Vec3 {
        get(&self.offset, place) - get(&self.remainder, place)
    }

    /// As [`Points::shift`].
    #[inline(always)]
    pub(super) fn shift(&mut self, place: usize, shift: Vec3) {
        add(&mut self.offset, place, shift);
    }

    /// As [`Points::carry`].
    #[inline(always)]
    pub(super) fn carry(&mut self, place: usize, shift: Vec3) {
        add(&mut self.offset, place, shift);
        add(&mut self.remainder, place, shift);
    }

    /// Whether there are eight places from this one on.
    #[inline(always)]
    pub(super) fn has_eight_at(&self, place: usize) -> bool {
        self.inverse_mass.len().checked_sub(LANES).is_some_and(|last| place <= last)
    }

    /// As [`Points::eight_at`].
    #[inline(always)]
    pub(super) fn eight_at<L: Lanes>(&self, place: usize) -> Vec3x8<L> {
        let [x, y, z] = self.start;
        Vec3x8::new(read(x, place), read(y, place), read(z, place)) + eight(&self.offset, place)
    }

    /// As [`Points::motion_of_eight`].
    #[inline(always)]
    pub(super) fn motion_of_eight<L: Lanes>(&self, place: usize) -> Vec3x8<L> {
        eight(&self.offset, place) - eight(&self.remainder, place)
    }

    /// Moves the eight particles from `place` on, which becomes velocity.
    #[inline(always)]
    pub(super) fn shift_eight<L: Lanes>(&mut self, place: usize, shift: Vec3x8<L>) {
        let moved = eight(&self.offset, place) + shift;
        let [x, y, z] = &mut self.offset;
        write(moved.x, x, place);
        write(moved.y, y, place);
        write(moved.z, z, place);
    }

    #[inline(always)]
    fn start(&self, place: usize) -> Vec3 {
        let [x, y, z] = self.start;
        Vec3::new(x[place], y[place], z[place])
    }
}

#[inline(always)]
fn cut([x, y, z]: &mut [Vec<f32>; 3], count: usize) -> [&mut [f32]; 3] {
    [&mut x[..count], &mut y[..count], &mut z[..count]]
}

#[inline(always)]
fn get([x, y, z]: &[&mut [f32]; 3], place: usize) -> Vec3 {
    Vec3::new(x[place], y[place], z[place])
}

#[inline(always)]
fn eight<L: Lanes>([x, y, z]: &[&mut [f32]; 3], place: usize) -> Vec3x8<L> {
    Vec3x8::new(read(x, place), read(y, place), read(z, place))
}

#[inline(always)]
fn add([x, y, z]: &mut [&mut [f32]; 3], place: usize, by: Vec3) {
    x[place] += by.x;
    y[place] += by.y;
    z[place] += by.z;
}
