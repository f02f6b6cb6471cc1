//! Binary trees of spheres over the features of a body (paper 5.2), after Quinlan, "Efficient distance
//! computation between non-convex objects", 1994.
//!
//! A leaf holds one feature, 1 to 4 particles; [`Topology`] arranges the leaves once, in the rest pose.
//! [`LayeredTree`] is for bodies that deform and is refitted whole; [`WrappedTree`] is for bodies that
//! keep their shape, is shared by all bodies of that shape, and is posed lazily, node by node.
//! [`descend_pair`] and [`descend_self`] find the leaves whose spheres overlap, in either kind.
//!
//! Positions are always given as one slice, indexed by the particle indices of the features: m, any one frame.

mod build;
mod descend;
mod layered;
mod wrapped;

pub use build::{Feature, Topology};
pub use descend::{DescentStack, SphereHierarchy, descend_pair, descend_self};
pub use layered::LayeredTree;
pub use wrapped::{WrappedPose, WrappedSpheres, WrappedTree};
