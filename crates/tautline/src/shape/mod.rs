//! Shapes of rigid bodies: what they collide with and how their mass is spread.

mod convex;

pub(crate) use convex::{Convex, Face};
