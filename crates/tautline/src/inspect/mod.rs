//! How it works, for pictures: what a step has left of its search and its order, to be looked at. Nothing here changes a
//! world, and no step depends on it.

mod color;
mod contact;
mod gjk;
mod spheres;

pub use contact::{ContactPoint, FeatureOfBody};
pub use gjk::{GjkTrace, HitFeatures};
