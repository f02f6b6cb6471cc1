//! Surfaces and solids: half-edge meshes, primitives, hulls, tetrahedra and mass properties. Knows no
//! world.

mod tetrahedra;
mod tri_mesh;

pub use tetrahedra::{Tetrahedra, tetrahedralise};
pub use tri_mesh::TriMesh;
