//! Ready shapes, centred on the origin: solids with their axis along Y, the cloth grid, the rope's polyline.
//!
//! Every surface is put through the same door as a mesh from a file, [`HalfEdgeMesh::from_mesh`], so that
//! sizes at which coordinates overflow or triangles collapse in f32 are refused. Sizes are in m.
//! Nothing here calls the platform's mathematics: the same bits everywhere.

mod polyhedra;
mod round;
mod sheet;

pub use polyhedra::{cube, cuboid, dodecahedron, icosahedron, octahedron, tetrahedron};
pub use round::{capsule, cylinder, icosphere, torus, uv_sphere};
pub use sheet::{grid, polyline};

use glam::DVec3;

use super::{HalfEdgeMesh, TriMesh};
use crate::Error;

/// Most segments, rings, columns or rows: with two such counts, about a million vertices.
pub const MAX_COUNT: u32 = 1024;

/// Rounds to f32 and checks.
fn surface(positions: &[DVec3], triangles: Vec<[u32; 3]>) -> Result<TriMesh, Error> {
    let mesh =
        TriMesh { positions: positions.iter().map(|position| position.as_vec3()).collect(), triangles };
    HalfEdgeMesh::from_mesh(&mesh)?;
    Ok(mesh)
}

fn length(field: &str, value: f32) -> Result<f64, Error> {
    if value.is_finite() && value > 0.0 {
        return Ok(f64::from(value));
    }
    Err(Error::OutOfRange { field: field.into(), value: value.into(), expected: "a finite number above 0" })
}

/// A number of columns or rows.
fn at_least_two(field: &str, value: u32) -> Result<u32, Error> {
    if (2..=MAX_COUNT).contains(&value) {
        return Ok(value);
    }
    Err(Error::OutOfRange { field: field.into(), value: value.into(), expected: "a count from 2 to 1024" })
}

/// A number of parts of a circle.
fn at_least_three(field: &str, value: u32) -> Result<u32, Error> {
    if (3..=MAX_COUNT).contains(&value) {
        return Ok(value);
    }
    Err(Error::OutOfRange { field: field.into(), value: value.into(), expected: "a count from 3 to 1024" })
}

/// Both triangles of a quadrilateral given counter-clockwise.
fn quad(a: u32, b: u32, c: u32, d: u32) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}
