//! Which bodies touch, and where. Moves nothing.

mod broad_phase;
pub(crate) mod bvh;
mod contact;
mod narrow_phase;
mod pair;
mod solid;
mod winding;

pub(crate) use broad_phase::{Aabb, Candidate, find_pairs};
pub(crate) use contact::{Contact, Patch};
pub(crate) use narrow_phase::{NarrowPhase, Scene};
pub(crate) use pair::PairCache;
