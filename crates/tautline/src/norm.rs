//! Lengths and directions of vectors, with the processor's own square root.
//!
//! glam's own go through `libm`, as its sines have to for the same bits everywhere. But a root is the same everywhere
//! anyway, and that of `libm` is an instruction that makes AVX code wait for a hundred cycles, and in WebAssembly a loop.

use glam::{DVec3, Vec3};

/// A vector that has a length.
pub(crate) trait Norm: Sized {
    type Number;
    const ZERO: Self;

    /// Its length.
    fn norm(self) -> Self::Number;

    /// How far it is from another point.
    fn distance_to(self, other: Self) -> Self::Number;

    /// Its direction, of unit length; not finite if it has none.
    fn unit(self) -> Self;

    /// Its direction, if it has one.
    fn try_unit(self) -> Option<Self>;

    /// Its direction, or if it has none the fallback.
    #[inline(always)]
    fn unit_or(self, fallback: Self) -> Self {
        self.try_unit().unwrap_or(fallback)
    }

    /// Its direction, or if it has none the zero vector.
    #[inline(always)]
    fn unit_or_zero(self) -> Self {
        self.unit_or(Self::ZERO)
    }
}

macro_rules! norm {
    ($vector:ty, $number:ty) => {
        impl Norm for $vector {
            type Number = $number;
            const ZERO: Self = <$vector>::ZERO;

            #[inline(always)]
            fn norm(self) -> $number {
                self.length_squared().sqrt()
            }

            #[inline(always)]
            fn distance_to(self, other: Self) -> $number {
                (self - other).norm()
            }

            #[inline(always)]
            fn unit(self) -> Self {
                self * (1.0 / self.norm())
            }

            #[inline(always)]
            fn try_unit(self) -> Option<Self> {
                let inverse = 1.0 / self.norm();
                (inverse.is_finite() && inverse > 0.0).then(|| self * inverse)
            }
        }
    };
}

norm!(Vec3, f32);
norm!(DVec3, f64);

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn is_what_glam_finds(x in any::<[f32; 3]>()) {
            let v = Vec3::from(x);
            prop_assert_eq!(v.norm().to_bits(), v.length().to_bits());
            prop_assert_eq!(v.try_unit(), v.try_normalize());
            let d = v.as_dvec3();
            prop_assert_eq!(d.norm().to_bits(), d.length().to_bits());
            prop_assert_eq!(d.unit_or(DVec3::X), d.normalize_or(DVec3::X));
        }
    }
}
