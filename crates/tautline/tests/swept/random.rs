//! The same numbers on every machine.

use crate::cases::Pair;
use crate::exact::Way;

/// SplitMix64.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn index(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// From −reach to reach.
    pub(crate) fn whole(&mut self, reach: i64) -> i64 {
        (self.bits() % (2 * reach as u64 + 1)) as i64 - reach
    }

    pub(crate) fn place(&mut self, reach: i64) -> [i64; 3] {
        [0; 3].map(|_| self.whole(reach))
    }

    pub(crate) fn way(&mut self, reach: i64) -> Way {
        [self.place(reach), self.place(reach)]
    }

    pub(crate) fn pair(&mut self, mut way: impl FnMut(&mut Self) -> Way) -> Pair {
        [0; 4].map(|_| way(self))
    }
}
