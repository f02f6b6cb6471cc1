//! Two groups of four, in the instructions that every processor of the target has.

use std::ops::{Add, Div, Mul, Neg, Sub};

use wide::f32x4;

use super::{LANES, Lanes, Row};

#[derive(Clone, Copy)]
pub(super) struct Portable(f32x4, f32x4);

macro_rules! operator {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl $trait for Portable {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0, self.1 $operator other.1)
            }
        }
    )*};
}
operator!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // Not 0 − x, which would make +0 of +0.
        let sign = f32x4::splat(-0.0);
        Self(self.0 ^ sign, self.1 ^ sign)
    }
}

impl Lanes for Portable {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self(f32x4::splat(value), f32x4::splat(value))
    }
    #[inline(always)]
    fn load(row: &Row) -> Self {
        Self::read(&row.0)
    }
    #[inline(always)]
    fn store(self, row: &mut Row) {
        self.write(&mut row.0);
    }
    #[inline(always)]
    fn read(&[a, b, c, d, e, f, g, h]: &[f32; LANES]) -> Self {
        Self(f32x4::new([a, b, c, d]), f32x4::new([e, f, g, h]))
    }
    #[inline(always)]
    fn write(self, numbers: &mut [f32; LANES]) {
        numbers[..4].copy_from_slice(&self.0.to_array());
        numbers[4..].copy_from_slice(&self.1.to_array());
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Self(self.0.simd_gt(other.0), self.1.simd_gt(other.1))
    }
    #[inline(always)]
    fn equal(self, other: Self) -> Self {
        Self(self.0.simd_eq(other.0), self.1.simd_eq(other.1))
    }
    #[inline(always)]
    fn select(self, a: Self, b: Self) -> Self {
        Self(self.0.bitselect(a.0, b.0), self.1.bitselect(a.1, b.1))
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0 & other.0, self.1 & other.1)
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.to_bitmask() | self.1.to_bitmask() << 4
    }
    #[inline(always)]
    fn transpose(rows: [Self; LANES]) -> [Self; LANES] {
        let [a, b, c, d, e, f, g, h] = rows;
        let top_left = f32x4::transpose([a.0, b.0, c.0, d.0]);
        let top_right = f32x4::transpose([a.1, b.1, c.1, d.1]);
        let bottom_left = f32x4::transpose([e.0, f.0, g.0, h.0]);
        let bottom_right = f32x4::transpose([e.1, f.1, g.1, h.1]);
        let mut columns = [Self(top_left[0], bottom_left[0]); LANES];
        for k in 0..4 {
            columns[k] = Self(top_left[k], bottom_left[k]);
            columns[k + 4] = Self(top_right[k], bottom_right[k]);
        }
        columns
    }
    // On x86 exactly what the trait asks for (of equal numbers the second) in one instruction.
    #[cfg(target_feature = "sse")]
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.fast_max(other.0), self.1.fast_max(other.1))
    }
    #[cfg(target_feature = "sse")]
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.fast_min(other.0), self.1.fast_min(other.1))
    }
    // In WebAssembly the second of the instruction's operands is what the trait calls the first.
    #[cfg(target_feature = "simd128")]
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(other.0.fast_max(self.0), other.1.fast_max(self.1))
    }
    #[cfg(target_feature = "simd128")]
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(other.0.fast_min(self.0), other.1.fast_min(self.1))
    }
}
