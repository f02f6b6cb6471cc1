//! How large a pair is where it touches: what tolerances and shifts are parts of.

use super::core::{Core, Pair};
use crate::norm::Norm;

/// Cores closer than this part of the smaller one's size are shifted apart …
const NEAR: f32 = 1e-3;
/// … to this part.
const APART: f32 = 1e-2;
/// The least shift as part of the larger coordinates: what f32 needs to tell directions.
const TELLABLE: f32 = 2e-4;

/// Sizes near the place of contact, in m: of the smaller body, and of coordinates.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    pub(super) size: f32,
    pub(super) coordinates: f32,
}

impl Scale {
    #[inline(always)]
    pub(super) fn at<B: Core>(pair: &Pair<B>, [a, b]: [u16; 2]) -> Self {
        let (size_a, size_b) = (pair.a.size, pair.b.size());
        let reach = pair.a.vertices[usize::from(a)].norm() + pair.b.vertices()[usize::from(b)].norm();
        Self { size: if size_a < size_b { size_a } else { size_b }, coordinates: reach + size_a + size_b }
    }

    /// By how much a pair at this separation has to be shifted, in m.
    #[inline(always)]
    pub(super) fn shift(self, separation: f32) -> f32 {
        if separation > NEAR * self.size && separation > TELLABLE * self.coordinates {
            return 0.0;
        }
        (APART * self.size).max(TELLABLE * self.coordinates) - separation
    }
}
