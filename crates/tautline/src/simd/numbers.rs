//! Numbers in whole rows.

use std::ops::{Deref, DerefMut};

use super::{LANES, Row};

/// Numbers, as many as make whole rows, of which no row is in two lines of the cache, as half of those of a `Vec<f32>` may
/// be: to read and write such a row takes twice as long.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Numbers(Vec<Row>);

impl Numbers {
    pub(crate) fn zeros(count: usize) -> Self {
        let mut numbers = Self::default();
        numbers.resize(count, 0.0);
        numbers
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// As of a `Vec`; the last row is filled up. Not inlined: what is downloaded has it once.
    #[inline(never)]
    pub(crate) fn resize(&mut self, count: usize, number: f32) {
        self.0.resize(count.div_ceil(LANES), Row([number; LANES]));
    }
}

impl Deref for Numbers {
    type Target = [f32];

    #[inline(always)]
    fn deref(&self) -> &[f32] {
        bytemuck::cast_slice(&self.0)
    }
}

impl DerefMut for Numbers {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f32] {
        bytemuck::cast_slice_mut(&mut self.0)
    }
}

#[cfg(test)]
impl<'a> IntoIterator for &'a Numbers {
    type Item = &'a f32;
    type IntoIter = std::slice::Iter<'a, f32>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// The last row is filled up with zeros.
#[cfg(test)]
impl FromIterator<f32> for Numbers {
    fn from_iter<T: IntoIterator<Item = f32>>(numbers: T) -> Self {
        let mut own = Self::default();
        for (count, number) in numbers.into_iter().enumerate() {
            if count % LANES == 0 {
                own.0.push(Row::ZERO);
            }
            own[count] = number;
        }
        own
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_whole_and_within_lines_of_the_cache() {
        for count in [0, 1, 7, 16, 100, 5000] {
            let mut numbers: Numbers = (0..3).map(|k| k as f32).collect();
            assert_eq!(*numbers, [0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            numbers.resize(count, 3.0);
            assert!(numbers.len() >= count && numbers.len() < count + LANES);
            assert!(numbers.iter().skip(LANES).all(|&number| number == 3.0));
            assert_eq!(numbers.as_ptr().addr() % size_of::<Row>(), 0);
        }
    }
}
