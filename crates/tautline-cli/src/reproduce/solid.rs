//! The bodies of the study: how many sticks they have, and in which order.

use tautline::mesh::{TriMesh, primitives};
use tautline_scene::document::{MeshSource, Shape};
use tautline_scene::random::Random;

use crate::failure::Failure;

/// A kind of body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Solid {
    /// The paper's: edges and main diagonals.
    Icosahedron,
    /// Edges, divided faces and main diagonals.
    Dodecahedron,
    /// An icosahedron divided so often: edges and main diagonals.
    Icosphere(u32),
    /// The same with its vertices moved in and out: not symmetric, so divided into tetrahedra.
    Irregular(u32),
}

impl Solid {
    /// Its name in tables.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Icosahedron => "icosahedron",
            Self::Dodecahedron => "dodecahedron",
            Self::Icosphere(0 | 1) => "icosphere of 42",
            Self::Icosphere(_) => "icosphere of 162",
            Self::Irregular(0) => "irregular 12",
            Self::Irregular(1) => "irregular 42",
            Self::Irregular(_) => "irregular 162",
        }
    }

    /// Its shape in a sphere of `radius` (m). With a seed its vertices are numbered at random, and so the order
    /// in which its sticks were built is random.
    pub(super) fn shape(self, radius: f32, shuffle: Option<u64>) -> Result<Shape, Failure> {
        let mesh = match self {
            Self::Icosahedron => primitives::icosahedron(radius)?,
            Self::Dodecahedron => primitives::dodecahedron(radius)?,
            Self::Icosphere(subdivisions) => primitives::icosphere(radius, subdivisions)?,
            Self::Irregular(subdivisions) => dented(primitives::icosphere(radius, subdivisions)?),
        };
        let mesh = match shuffle {
            Some(seed) => renumbered(&mesh, &mut Random::new(seed)),
            None => mesh,
        };
        let positions = mesh.positions.iter().map(|position| position.to_array()).collect();
        Ok(Shape::Mesh(MeshSource { positions, triangles: mesh.triangles }))
    }
}

/// Every vertex up to 8 % nearer to the middle.
fn dented(mut mesh: TriMesh) -> TriMesh {
    let mut random = Random::new(1);
    for position in &mut mesh.positions {
        *position *= 1.0 - 0.01 * random.below(9) as f32;
    }
    mesh
}

/// The same surface with its vertices in another order (Fisher and Yates 1938).
fn renumbered(mesh: &TriMesh, random: &mut Random) -> TriMesh {
    let mut old_of_new: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for last in (1..old_of_new.len()).rev() {
        old_of_new.swap(last, random.below(last + 1));
    }
    let mut new_of_old = vec![0; old_of_new.len()];
    for (new, &old) in old_of_new.iter().enumerate() {
        new_of_old[old as usize] = new as u32;
    }
    TriMesh {
        positions: old_of_new.iter().map(|&old| mesh.positions[old as usize]).collect(),
        triangles: mesh.triangles.iter().map(|t| t.map(|old| new_of_old[old as usize])).collect(),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use tautline::Truss;

    use super::*;

    fn truss(solid: Solid, shuffle: Option<u64>) -> Arc<Truss> {
        let Shape::Mesh(mesh) = solid.shape(0.5, shuffle).unwrap() else { panic!("not a mesh") };
        let positions = mesh.positions.into_iter().map(Into::into).collect();
        Arc::new(Truss::from_mesh(&TriMesh { positions, triangles: mesh.triangles }).unwrap())
    }

    #[test]
    fn renumbering_changes_the_order_of_the_sticks_and_nothing_else() {
        let lengths = |truss: &Truss| {
            let mut lengths: Vec<f32> = truss.sticks().iter().map(|stick| stick.rest_length).collect();
            lengths.sort_by(f32::total_cmp);
            lengths
        };
        let (built, shuffled) = (truss(Solid::Icosphere(1), None), truss(Solid::Icosphere(1), Some(7)));
        assert_ne!(built.sticks(), shuffled.sticks());
        for (a, b) in lengths(&built).into_iter().zip(lengths(&shuffled)) {
            assert!((a - b).abs() < 1e-6, "{a} {b}");
        }
        assert_eq!(truss(Solid::Icosahedron, None).sticks().len(), 36);
    }

    #[test]
    fn irregular_bodies_have_more_sticks_than_edges_and_diagonals() {
        let (regular, irregular) = (truss(Solid::Icosphere(1), None), truss(Solid::Irregular(1), None));
        assert_eq!(regular.sticks().len(), 120 + 21);
        assert!(irregular.sticks().len() > regular.sticks().len());
    }
}
