//! Surfaces and solids: half-edge meshes, primitives, hulls, tetrahedra, mass properties and repair. Knows no
//! world.

pub mod doctor;
mod exact;
mod half_edge;
mod hull;
mod mass_properties;
pub mod primitives;
mod tetrahedra;
mod tri_mesh;

pub use half_edge::HalfEdgeMesh;
pub use hull::{ConvexHull, convex_hull};
pub use mass_properties::MassProperties;
pub(crate) use mass_properties::{diagonalize, outer};
pub use tetrahedra::{Tetrahedra, lattice, tetrahedralise};
pub use tri_mesh::TriMesh;
