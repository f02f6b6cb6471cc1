//! Surfaces and solids: half-edge meshes, primitives, hulls, tetrahedra and mass properties. Knows no
//! world.

mod tri_mesh;

pub use tri_mesh::TriMesh;
