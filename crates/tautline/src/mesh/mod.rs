//! Surfaces and solids: half-edge meshes, primitives, hulls, tetrahedra, mass properties and repair; coarser ones for the
//! same, and what carries a fine one along with a coarse one. Knows no world.

mod coarse_hull;
mod decimate;
pub mod doctor;
mod embedding;
mod exact;
mod half_edge;
mod hull;
mod mass_properties;
pub mod primitives;
mod tetrahedra;
mod tri_mesh;

pub use coarse_hull::CoarseHull;
pub use decimate::{Decimated, decimate, surface_deviation};
pub use embedding::Embedding;
pub use half_edge::HalfEdgeMesh;
pub use hull::{ConvexHull, convex_hull};
pub use mass_properties::MassProperties;
pub(crate) use mass_properties::{diagonalize, outer};
pub use tetrahedra::{Tetrahedra, lattice, tetrahedralise};
pub use tri_mesh::TriMesh;
