//! Names of contact points: the features that made them, the same from call to call.

/// One of the two bodies of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Body {
    A,
    B,
}

/// Two bits for the kind, fifteen for each of two corners; bodies with more corners have their keys wrapped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Key(pub(super) u32);

const CORNER_BITS: u32 = 15;
const CORNER_MASK: u32 = (1 << CORNER_BITS) - 1;
const CORNER_OF_A: u32 = 0;
const CORNER_OF_B: u32 = 1;
const CROSSING: u32 = 2;
const NEAREST: u32 = 3;

impl Key {
    fn new(kind: u32, a: u16, b: u16) -> Self {
        let a = u32::from(a) & CORNER_MASK;
        let b = u32::from(b) & CORNER_MASK;
        Self(kind << (2 * CORNER_BITS) | a << CORNER_BITS | b)
    }

    /// A corner of `body` on the other one.
    pub(super) fn corner(body: Body, corner: u16) -> Self {
        match body {
            Body::A => Self::new(CORNER_OF_A, corner, 0),
            Body::B => Self::new(CORNER_OF_B, 0, corner),
        }
    }

    /// The edge of a face of `body` that starts from `own`, and that of the other body's from `other`.
    pub(super) fn crossing(body: Body, own: u16, other: u16) -> Self {
        match body {
            Body::A => Self::new(CROSSING, own, other),
            Body::B => Self::new(CROSSING, other, own),
        }
    }

    /// The nearest features that no clipping names, each by its lowest corner.
    pub(super) fn nearest(a: u16, b: u16) -> Self {
        Self::new(NEAREST, a, b)
    }
}
