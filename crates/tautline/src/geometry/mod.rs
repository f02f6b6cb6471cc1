//! Geometric queries on values: spheres and their trees, support mappings, GJK and EPA, features. Knows no
//! world.
