//! Surfaces and solids: half-edge meshes, primitives, hulls, tetrahedra and mass properties. Knows no
//! world.
