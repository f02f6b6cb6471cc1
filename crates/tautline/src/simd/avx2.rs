//! Eight at once, on x86 processors that have AVX2: found out when the program runs.
//!
//! # Why this is sound
//!
//! All `unsafe` here is of one kind: calling AVX instructions, which is undefined where the processor lacks them.
//! [`Avx2`] is private to this module and values of it are made only by its `Lanes` methods; those are reached
//! only from [`run`], which is the one place that names the type, after [`is_available`]. Loads and stores are of
//! a [`Row`], which is 32 bytes long
//! and so aligned, or of eight numbers, with the instructions that ask for no alignment.
#![allow(unsafe_code)]

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Kernel, LANES, Lanes, Row};

#[derive(Clone, Copy)]
struct Avx2(__m256);

pub(super) fn is_available() -> bool {
    std::arch::is_x86_feature_detected!("avx2")
}

/// Does the work with AVX2, or, should the processor not have it, as all others do.
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    if !is_available() {
        return super::run_with::<super::portable::Portable, K>(kernel);
    }
    // SAFETY: the processor has AVX2.
    unsafe { run_with_avx2(kernel) }
}

#[target_feature(enable = "avx2")]
fn run_with_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Avx2>()
}

macro_rules! operator {
    ($($trait:ident $method:ident $intrinsic:ident),*) => {$(
        impl $trait for Avx2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the module's documentation.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )*};
}
operator!(Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps, Div div _mm256_div_ps);

impl Neg for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: see the module's documentation.
        Self(unsafe { _mm256_xor_ps(self.0, _mm256_set1_ps(-0.0)) })
    }
}

// SAFETY, of every block below: see the module's documentation.
impl Lanes for Avx2 {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self(unsafe { _mm256_set1_ps(value) })
    }
    #[inline(always)]
    fn load(row: &Row) -> Self {
        Self(unsafe { _mm256_load_ps(row.0.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, row: &mut Row) {
        unsafe { _mm256_store_ps(row.0.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn read(numbers: &[f32; LANES]) -> Self {
        Self(unsafe { _mm256_loadu_ps(numbers.as_ptr()) })
    }
    #[inline(always)]
    fn write(self, numbers: &mut [f32; LANES]) {
        unsafe { _mm256_storeu_ps(numbers.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(unsafe { _mm256_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Self(unsafe { _mm256_cmp_ps::<_CMP_GT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn equal(self, other: Self) -> Self {
        Self(unsafe { _mm256_cmp_ps::<_CMP_EQ_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(self, a: Self, b: Self) -> Self {
        Self(unsafe { _mm256_blendv_ps(b.0, a.0, self.0) })
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(unsafe { _mm256_and_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        (unsafe { _mm256_movemask_ps(self.0) }) as u32
    }
    #[inline(always)]
    fn transpose(rows: [Self; LANES]) -> [Self; LANES] {
        // Swap the off-diagonal 4 × 4 quarters, then transpose each.
        let [a, b, c, d, e, f, g, h] = rows;
        let [p, q, r, s] = transpose_quarters([low(a, e), low(b, f), low(c, g), low(d, h)]);
        let [t, u, v, w] = transpose_quarters([high(a, e), high(b, f), high(c, g), high(d, h)]);
        [Self(p), Self(q), Self(r), Self(s), Self(t), Self(u), Self(v), Self(w)]
    }
    // `maxps` does exactly what the trait asks for: of equal numbers the second.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn gather(rows: [&Row; LANES]) -> [Self; LANES] {
        // Halves of two rows side by side, which saves half the shuffles of a whole transposition.
        let [a, b, c, d, e, f, g, h] = rows;
        let [p, q, r, s] = transpose_quarters([
            half_rows::<0>(a, e),
            half_rows::<0>(b, f),
            half_rows::<0>(c, g),
            half_rows::<0>(d, h),
        ]);
        let [t, u, v, w] = transpose_quarters([
            half_rows::<4>(a, e),
            half_rows::<4>(b, f),
            half_rows::<4>(c, g),
            half_rows::<4>(d, h),
        ]);
        [Self(p), Self(q), Self(r), Self(s), Self(t), Self(u), Self(v), Self(w)]
    }
    #[inline(always)]
    fn scatter([a, b, c, d, e, f, g, h]: [Self; LANES], rows: &mut [Row], index: &[u32; LANES]) {
        // As in `gather`, each half of a row by itself.
        let first = transpose_quarters([a.0, b.0, c.0, d.0]);
        let last = transpose_quarters([e.0, f.0, g.0, h.0]);
        for i in 0..LANES / 2 {
            store_halves(low_half(first[i]), low_half(last[i]), &mut rows[index[i] as usize]);
        }
        for i in 0..LANES / 2 {
            let row = &mut rows[index[LANES / 2 + i] as usize];
            store_halves(high_half(first[i]), high_half(last[i]), row);
        }
    }
}

/// The first four of eight numbers.
#[inline(always)]
fn low_half(numbers: __m256) -> __m128 {
    // SAFETY: see the module's documentation.
    unsafe { _mm256_castps256_ps128(numbers) }
}

/// The last four of eight numbers.
#[inline(always)]
fn high_half(numbers: __m256) -> __m128 {
    // SAFETY: see the module's documentation.
    unsafe { _mm256_extractf128_ps::<1>(numbers) }
}

#[inline(always)]
fn store_halves(first: __m128, last: __m128, row: &mut Row) {
    let (head, tail) = row.0.split_at_mut(LANES / 2);
    // SAFETY: see the module's documentation; a row is aligned to 32 bytes, its half to 16.
    unsafe {
        _mm_store_ps(head.as_mut_ptr(), first);
        _mm_store_ps(tail.as_mut_ptr(), last);
    }
}

/// The lower halves of two.
#[inline(always)]
fn low(x: Avx2, y: Avx2) -> __m256 {
    // SAFETY: see the module's documentation.
    unsafe { _mm256_permute2f128_ps::<0x20>(x.0, y.0) }
}

/// The upper halves of two.
#[inline(always)]
fn high(x: Avx2, y: Avx2) -> __m256 {
    // SAFETY: see the module's documentation.
    unsafe { _mm256_permute2f128_ps::<0x31>(x.0, y.0) }
}

/// Four numbers of two rows each, the first or the last four.
#[inline(always)]
fn half_rows<const AT: usize>(x: &Row, y: &Row) -> __m256 {
    let (x, y): (&[f32], &[f32]) = (&x.0[AT..AT + 4], &y.0[AT..AT + 4]);
    // SAFETY: see the module's documentation; a row is aligned to 32 bytes, its half to 16.
    unsafe {
        let low = _mm256_castps128_ps256(_mm_load_ps(x.as_ptr()));
        _mm256_insertf128_ps::<1>(low, _mm_load_ps(y.as_ptr()))
    }
}

/// Transposes the lower and the upper 4 × 4 numbers, each by themselves.
#[inline(always)]
fn transpose_quarters([a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
    // SAFETY: see the module's documentation.
    unsafe {
        let (ab_low, ab_high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (cd_low, cd_high) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0x44>(ab_low, cd_low),
            _mm256_shuffle_ps::<0xEE>(ab_low, cd_low),
            _mm256_shuffle_ps::<0x44>(ab_high, cd_high),
            _mm256_shuffle_ps::<0xEE>(ab_high, cd_high),
        ]
    }
}
