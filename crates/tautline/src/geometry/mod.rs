//! Geometric queries on values: spheres and their trees, support mappings, GJK and EPA, features. Knows no
//! world.

mod sphere;
pub mod sphere_tree;

pub use sphere::{EnclosingSphere, Sphere, Support, circumsphere, smallest_enclosing_sphere};
