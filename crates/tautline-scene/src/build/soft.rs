//! Soft solids of a document to soft solids of the engine.

use std::sync::Arc;

use tautline::mesh::{Embedding, TriMesh, decimate, tetrahedralise};
use tautline::{Error, Vec3};

use super::body::quaternion;
use super::shape::mesh_of;
use crate::document::{Shape, SoftSolid};

/// A fine surface that is drawn, and moves with a coarse one.
#[derive(Debug, Clone, PartialEq)]
pub struct Skin {
    /// Three vertices each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Of its vertices, over the body's particles.
    pub embedding: Embedding,
}

/// What the world is to have of it, and its skin if that is another.
pub(super) fn soft_solid(document: &SoftSolid) -> Result<(tautline::SoftSolid, Option<Arc<Skin>>), Error> {
    let (solid, skin) = match (&document.shape, document.coarse_triangles) {
        (&Shape::Box { size }, _) => {
            let cells = document.cells.unwrap_or(SoftSolid::CELLS);
            (tautline::SoftSolid::cuboid(Vec3::from(size) / 2.0, cells), None)
        }
        (shape, None) => (tautline::SoftSolid::from_mesh(mesh_of(shape)?), None),
        (shape, Some(triangles)) => {
            let (solid, skin) = coarse(&mesh_of(shape)?, triangles)?;
            (solid, Some(Arc::new(skin)))
        }
    };
    Ok((with_traits(solid, document), skin))
}

fn coarse(fine: &TriMesh, triangles: u32) -> Result<(tautline::SoftSolid, Skin), Error> {
    let solid = tetrahedralise(&decimate(fine, triangles as usize)?.mesh)?;
    let embedding = Embedding::new(&solid, &fine.positions)?;
    let skin = Skin { triangles: fine.triangles.clone(), embedding };
    Ok((tautline::SoftSolid::from_tetrahedra(solid), skin))
}

fn with_traits(solid: tautline::SoftSolid, document: &SoftSolid) -> tautline::SoftSolid {
    let mut solid = solid
        .position(document.position.into())
        .rotation(quaternion(document.rotation))
        .velocity(document.velocity.into())
        .angular_velocity(document.angular_velocity.into())
        .young_modulus(document.young_modulus)
        .poisson_ratio(document.poisson_ratio)
        .friction(document.friction)
        .self_collision(document.self_collision);
    if let Some(mass) = document.mass {
        solid = solid.mass(mass);
    }
    if let Some(density) = document.density {
        solid = solid.density(density);
    }
    if let Some(thickness) = document.thickness {
        solid = solid.thickness(thickness);
    }
    document.pins.iter().copied().fold(solid, tautline::SoftSolid::pin)
}
