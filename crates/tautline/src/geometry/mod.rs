//! Geometric queries on values: spheres and their trees, support mappings, GJK and EPA, features. Knows no
//! world.

pub mod box_tree;
pub mod closest;
pub mod distance;
pub mod epa;
pub mod feature;
pub mod gjk;
pub(crate) mod manifold;
pub(crate) mod query;
mod rows;
pub mod simplex;
mod sphere;
pub mod sphere_tree;
pub mod support;
pub mod swept;

pub use sphere::{EnclosingSphere, Sphere, SupportPoints, circumsphere, smallest_enclosing_sphere};
