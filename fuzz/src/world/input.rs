//! Bytes as numbers, vectors and choices. Where they end, zeros follow.

use tautline::{Quat, Vec3};

pub(super) struct Input<'a>(pub(super) &'a [u8]);

impl Input<'_> {
    pub(super) fn is_over(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn byte(&mut self) -> u8 {
        let (&first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        first
    }

    pub(super) fn flag(&mut self) -> bool {
        self.byte() % 2 == 1
    }

    /// The index of one particle, of a triangle …: mostly of one that is there.
    pub(super) fn index(&mut self) -> u32 {
        u32::from(self.byte()) % 20
    }

    /// Mostly something usual, now and then something strange.
    pub(super) fn number(&mut self) -> f32 {
        let byte = self.byte();
        match byte {
            0..=199 => (f32::from(byte) - 100.0) * 0.02,
            200..=239 => (f32::from(byte) - 220.0) * 5.0,
            240 => f32::NAN,
            241 => f32::INFINITY,
            242 => f32::NEG_INFINITY,
            243 => f32::MAX,
            244 => f32::MIN_POSITIVE,
            245 => -0.0,
            246 => 1e9,
            247 => -1e9,
            248 => 1e-6,
            249 => 1e4,
            250 => 1e-3,
            _ => 1.0,
        }
    }

    pub(super) fn numbers<const N: usize>(&mut self) -> [f32; N] {
        std::array::from_fn(|_| self.number())
    }

    pub(super) fn vector(&mut self) -> Vec3 {
        Vec3::from_array(self.numbers())
    }

    pub(super) fn vectors<const N: usize>(&mut self) -> [Vec3; N] {
        std::array::from_fn(|_| self.vector())
    }

    pub(super) fn rotation(&mut self) -> Quat {
        let [x, y, z] = self.numbers();
        Quat::from_xyzw(x, y, z, 1.0)
    }

    /// One of these.
    pub(super) fn one_of<T: Copy, const N: usize>(&mut self, choices: [T; N]) -> T {
        choices[usize::from(self.byte()) % N]
    }
}
