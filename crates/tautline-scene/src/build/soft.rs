//! Soft solids of a document to soft solids of the engine.

use tautline::{Error, Vec3};

use super::body::quaternion;
use super::shape::mesh_of;
use crate::document::{Shape, SoftSolid};

pub(super) fn soft_solid(document: &SoftSolid) -> Result<tautline::SoftSolid, Error> {
    let solid = match document.shape {
        Shape::Box { size } => {
            let cells = document.cells.unwrap_or(SoftSolid::CELLS);
            tautline::SoftSolid::cuboid(Vec3::from(size) / 2.0, cells)
        }
        ref shape => tautline::SoftSolid::from_mesh(mesh_of(shape)?),
    };
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
    Ok(document.pins.iter().copied().fold(solid, tautline::SoftSolid::pin))
}
