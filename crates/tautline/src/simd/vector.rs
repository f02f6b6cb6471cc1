//! Eight vectors, or eight matrices, side by side.

use std::ops::{Add, Deref, DerefMut, Mul, Neg, Sub};

use glam::Vec3;

use super::{LANES, Lanes, Row};

/// Eight vectors.
#[derive(Clone, Copy)]
pub(crate) struct Vec3x8<L> {
    pub(crate) x: L,
    pub(crate) y: L,
    pub(crate) z: L,
}

impl<L: Lanes> Vec3x8<L> {
    #[inline(always)]
    pub(crate) fn new(x: L, y: L, z: L) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self::new(L::splat(0.0), L::splat(0.0), L::splat(0.0))
    }

    #[inline(always)]
    pub(crate) fn splat(v: Vec3) -> Self {
        Self::new(L::splat(v.x), L::splat(v.y), L::splat(v.z))
    }

    /// From three rows: all x, all y, all z.
    #[inline(always)]
    pub(crate) fn load(rows: &[Row; 3]) -> Self {
        Self::new(L::load(&rows[0]), L::load(&rows[1]), L::load(&rows[2]))
    }

    #[inline(always)]
    pub(crate) fn store(self, rows: &mut [Row; 3]) {
        self.x.store(&mut rows[0]);
        self.y.store(&mut rows[1]);
        self.z.store(&mut rows[2]);
    }

    /// The eight vectors from number `at` on, out of all x, all y and all z.
    #[inline(always)]
    pub(crate) fn read(numbers: &[impl Deref<Target = [f32]>; 3], at: usize) -> Self {
        Self::new(read(&numbers[0], at), read(&numbers[1], at), read(&numbers[2], at))
    }

    #[inline(always)]
    pub(crate) fn write(self, numbers: &mut [impl DerefMut<Target = [f32]>; 3], at: usize) {
        write(self.x, &mut numbers[0], at);
        write(self.y, &mut numbers[1], at);
        write(self.z, &mut numbers[2], at);
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> L {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Coordinate by coordinate.
    #[inline(always)]
    pub(crate) fn scale(self, other: Self) -> Self {
        Self::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }

    #[inline(always)]
    pub(crate) fn length_squared(self) -> L {
        self.dot(self)
    }

    #[inline(always)]
    pub(crate) fn length(self) -> L {
        self.dot(self).sqrt()
    }

    #[inline(always)]
    pub(crate) fn select(mask: L, a: Self, b: Self) -> Self {
        Self::new(mask.select(a.x, b.x), mask.select(a.y, b.y), mask.select(a.z, b.z))
    }
}

impl<L: Lanes> Add for Vec3x8<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<L: Lanes> Sub for Vec3x8<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<L: Lanes> Mul<L> for Vec3x8<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: L) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<L: Lanes> Neg for Vec3x8<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

/// What three rows have in a lane: all x, all y, all z.
#[inline(always)]
pub(crate) fn column([x, y, z]: &[Row; 3], lane: usize) -> Vec3 {
    Vec3::new(x.0[lane], y.0[lane], z.0[lane])
}

/// The eight numbers from number `at` on; 0 where there are not as many.
#[inline(always)]
pub(crate) fn read<L: Lanes>(numbers: &[f32], at: usize) -> L {
    match numbers[at..].first_chunk::<LANES>() {
        Some(eight) => L::read(eight),
        None => L::splat(0.0),
    }
}

/// The reverse; nothing where there are not as many.
#[inline(always)]
fn write<L: Lanes>(lanes: L, numbers: &mut [f32], at: usize) {
    if let Some(eight) = numbers[at..].first_chunk_mut::<LANES>() {
        lanes.write(eight);
    }
}

/// Eight matrices, by columns.
#[derive(Clone, Copy)]
pub(crate) struct Matrix3x8<L>(pub(crate) [Vec3x8<L>; 3]);

impl<L: Lanes> Matrix3x8<L> {
    #[inline(always)]
    pub(crate) fn load(rows: &[[Row; 3]; 3]) -> Self {
        Self([Vec3x8::load(&rows[0]), Vec3x8::load(&rows[1]), Vec3x8::load(&rows[2])])
    }

    #[inline(always)]
    pub(crate) fn store(self, rows: &mut [[Row; 3]; 3]) {
        for (column, row) in self.0.into_iter().zip(rows) {
            column.store(row);
        }
    }

    /// M v.
    #[inline(always)]
    pub(crate) fn apply(&self, v: Vec3x8<L>) -> Vec3x8<L> {
        self.0[0] * v.x + self.0[1] * v.y + self.0[2] * v.z
    }

    /// Mᵀ v.
    #[inline(always)]
    pub(crate) fn apply_transposed(&self, v: Vec3x8<L>) -> Vec3x8<L> {
        Vec3x8::new(self.0[0].dot(v), self.0[1].dot(v), self.0[2].dot(v))
    }
}
