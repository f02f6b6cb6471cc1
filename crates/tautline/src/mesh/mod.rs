//! Surfaces and solids: half-edge meshes, primitives, hulls, tetrahedra and mass properties. Knows no
//! world.

mod exact;
mod half_edge;
pub mod primitives;
mod tri_mesh;

pub use half_edge::HalfEdgeMesh;
pub use tri_mesh::TriMesh;
