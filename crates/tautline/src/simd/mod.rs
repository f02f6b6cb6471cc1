//! Eight numbers at a time.
//!
//! A kernel is written once, over [`Lanes`], and compiled for each instruction set that implements it; [`run`]
//! picks one when the program runs. All of them round every operation alike (no fused multiply-add, no
//! approximate reciprocal), so that results are the same bits whichever runs.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod numbers;
mod portable;
#[cfg(not(target_arch = "wasm32"))]
mod scalar;
mod vector;

use std::ops::{Add, Div, Mul, Neg, Sub};

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

pub(crate) use numbers::Numbers;
pub(crate) use vector::{Matrix3x8, Vec3x8, column, read};

/// How many numbers a group has.
pub(crate) const LANES: usize = 8;

/// Eight numbers in memory.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, Pod, Zeroable)]
#[repr(C, align(32))]
pub(crate) struct Row(pub(crate) [f32; LANES]);

impl Row {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);
}

/// Which instructions kernels use. The results are the same bits.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Instructions {
    /// The widest that this processor has.
    #[default]
    Widest,
    /// Those that every processor of its kind has: SSE2, NEON or WASM's SIMD128.
    Baseline,
    /// One number at a time; in WebAssembly as `Baseline`.
    Scalar,
}

/// Eight numbers in registers, or eight masks: all bits set, or none.
pub(crate) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    fn splat(value: f32) -> Self;
    fn load(row: &Row) -> Self;
    fn store(self, row: &mut Row);
    /// Eight numbers that follow each other anywhere in memory.
    fn read(numbers: &[f32; LANES]) -> Self;
    fn write(self, numbers: &mut [f32; LANES]);
    fn sqrt(self) -> Self;
    /// A mask of the lanes in which `self` is greater.
    fn greater(self, other: Self) -> Self;
    /// A mask of the lanes in which both are the same number.
    fn equal(self, other: Self) -> Self;
    /// Where this mask is set `a`, elsewhere `b`.
    fn select(self, a: Self, b: Self) -> Self;
    /// The bits that both have: a mask and a number give the number or 0.
    fn and(self, other: Self) -> Self;
    /// One bit for each lane of this mask, lane 0 lowest.
    fn bits(self) -> u32;
    /// Row `i` of the result is column `i`.
    fn transpose(rows: [Self; LANES]) -> [Self; LANES];

    /// `self` where it is greater, else `other`.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.greater(other).select(self, other)
    }

    /// `self` where it is less, else `other`.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        other.greater(self).select(self, other)
    }

    /// Rows as columns: lane `i` of the result's entry `k` is number `k` of row `i`.
    #[inline(always)]
    fn gather(rows: [&Row; LANES]) -> [Self; LANES] {
        let [a, b, c, d, e, f, g, h] = rows;
        let (a, b, c, d) = (Self::load(a), Self::load(b), Self::load(c), Self::load(d));
        Self::transpose([a, b, c, d, Self::load(e), Self::load(f), Self::load(g), Self::load(h)])
    }

    /// The reverse: the rows numbered `index` out of columns. Of equal indices the last lane's row stays.
    #[inline(always)]
    fn scatter(columns: [Self; LANES], rows: &mut [Row], index: &[u32; LANES]) {
        let lanes = Self::transpose(columns);
        for i in 0..LANES {
            lanes[i].store(&mut rows[index[i] as usize]);
        }
    }

    /// The largest of the eight.
    #[inline(always)]
    fn largest(self) -> f32 {
        let mut row = Row::ZERO;
        self.store(&mut row);
        let [a, b, c, d, e, f, g, h] = row.0;
        let max = |a: f32, b: f32| if a > b { a } else { b };
        max(max(max(a, e), max(b, f)), max(max(c, g), max(d, h)))
    }
}

/// The rows of a slice with these numbers.
#[inline(always)]
pub(crate) fn rows_at<'a>(rows: &'a [Row], index: &[u32; LANES]) -> [&'a Row; LANES] {
    let [a, b, c, d, e, f, g, h] = *index;
    let (a, b, c, d) = (&rows[a as usize], &rows[b as usize], &rows[c as usize], &rows[d as usize]);
    [a, b, c, d, &rows[e as usize], &rows[f as usize], &rows[g as usize], &rows[h as usize]]
}

/// Work to be done with some instruction set.
pub(crate) trait Kernel {
    type Output;
    /// Has to be `#[inline(always)]`, as all that it calls in its hot loops: else it is compiled without the
    /// instructions it was dispatched to. A closure cannot be: hot loops have none that works on lanes, and no
    /// `array::map`. WebAssembly has one instruction set, and what is longer than a few lines is inlined there only where
    /// it pays: browsers compile functions of tens of kilobytes badly.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Does the work with these instructions.
pub(crate) fn run<K: Kernel>(instructions: Instructions, kernel: K) -> K::Output {
    match instructions {
        #[cfg(target_arch = "x86_64")]
        Instructions::Widest if avx2::is_available() => avx2::run(kernel),
        Instructions::Widest | Instructions::Baseline => run_with::<portable::Portable, K>(kernel),
        #[cfg(not(target_arch = "wasm32"))]
        Instructions::Scalar => run_with::<scalar::Scalar, K>(kernel),
        // What is downloaded has each kernel once.
        #[cfg(target_arch = "wasm32")]
        Instructions::Scalar => run_with::<portable::Portable, K>(kernel),
    }
}

/// Not inlined: without optimisation a kernel's frame takes half a megabyte of stack, and only that of the instructions in
/// use is to be there.
#[inline(never)]
fn run_with<L: Lanes, K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<L>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation on numbers that do not round away.
    struct Everything([Row; LANES]);

    impl Kernel for Everything {
        type Output = Vec<[u32; LANES]>;

        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let rows = self.0;
            let (a, b) = (L::load(&rows[0]), L::load(&rows[1]));
            let mut out = vec![a + b, a - b, a * b, a / b, -a, (a * a).sqrt(), a.max(b), a.min(b)];
            out.extend([a.greater(b).and(b), a.equal(b).select(a, b), L::splat(a.largest())]);
            out.push(L::splat(a.greater(b).bits() as f32));
            let index = [3_u32, 1, 4, 0, 5, 2, 7, 6];
            let columns = L::gather(index.map(|i| &rows[i as usize]));
            out.extend(columns);
            let mut scattered = [Row::ZERO; LANES];
            L::scatter(columns, &mut scattered, &index);
            out.extend(scattered.iter().map(L::load));
            let bits = |lanes: L| {
                let mut row = Row::ZERO;
                lanes.store(&mut row);
                row.0.map(bits_of)
            };
            out.into_iter().map(bits).collect()
        }
    }

    /// What is not a number has no defined sign or payload: it only has to be none everywhere.
    fn bits_of(number: f32) -> u32 {
        if number.is_nan() { f32::NAN.to_bits() } else { number.to_bits() }
    }

    #[test]
    fn all_instruction_sets_give_the_same_bits() {
        let number = |k: usize| ((k * 7919 % 1013) as f32 - 500.0) / 37.0;
        let mut rows: [Row; LANES] =
            std::array::from_fn(|i| Row(std::array::from_fn(|j| number(i * LANES + j))));
        rows[1].0[3] = rows[0].0[3];
        rows[0].0[5] = 0.0;
        rows[1].0[5] = -0.0;
        let expected = run(Instructions::Scalar, Everything(rows));
        assert_eq!(run(Instructions::Baseline, Everything(rows)), expected);
        assert_eq!(run(Instructions::Widest, Everything(rows)), expected);
        assert_eq!(expected[0], std::array::from_fn(|i| (rows[0].0[i] + rows[1].0[i]).to_bits()));
        assert_eq!(expected[6][5], (-0.0_f32).to_bits(), "of equal numbers max takes the second");
        let gathered = |k: usize, lane: usize| rows[[3, 1, 4, 0, 5, 2, 7, 6][lane]].0[k].to_bits();
        for k in 0..LANES {
            assert_eq!(expected[12 + k], std::array::from_fn(|lane| gathered(k, lane)));
            assert_eq!(expected[20 + k], rows[k].0.map(f32::to_bits));
        }
    }
}
