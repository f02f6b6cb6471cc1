//! Cloth of a document to cloth of the engine.

use super::body::{Refusal, quaternion, sheet_particles};
use super::shape::{triangles, unread};
use crate::document::{Cloth, Creep, Surface};

pub(super) fn sheet(cloth: &Cloth) -> Result<tautline::Cloth, Refusal> {
    let builder = match cloth.surface {
        Surface::Grid { columns, rows, width, depth } => tautline::Cloth::grid(columns, rows, width, depth),
        Surface::Mesh(ref mesh) => tautline::Cloth::from_mesh(triangles(mesh)),
        Surface::File(_) => return Err(Refusal { field: ".surface", error: unread() }),
    };
    let mut builder = weighed(builder, cloth)
        .position(cloth.position.into())
        .rotation(quaternion(cloth.rotation))
        .velocity(cloth.velocity.into())
        .friction(cloth.friction)
        .self_collision(cloth.self_collision);
    for (value, set) in choices(cloth) {
        if let Some(value) = value {
            builder = set(builder, value);
        }
    }
    if let Some(Creep { yield_strain, rate }) = cloth.creep {
        builder = builder.creep(yield_strain, rate);
    }
    for pin in &cloth.pins {
        builder = sheet_particles(*pin, &cloth.surface).into_iter().fold(builder, tautline::Cloth::pin);
    }
    Ok(cloth.seams.iter().fold(builder, |builder, &[a, b]| builder.seam(a, b)))
}

fn weighed(builder: tautline::Cloth, cloth: &Cloth) -> tautline::Cloth {
    match cloth.density {
        Some(density) => builder.density(density),
        None if cloth.masses.is_empty() => builder.mass(cloth.mass),
        None => builder.masses(cloth.masses.clone()),
    }
}

/// A value that a document may give, and what takes it.
type Choice = (Option<f32>, fn(tautline::Cloth, f32) -> tautline::Cloth);

fn choices(cloth: &Cloth) -> [Choice; 11] {
    [
        (cloth.sag, tautline::Cloth::sag),
        (cloth.thickness, tautline::Cloth::thickness),
        (cloth.bending, tautline::Cloth::bending),
        (cloth.bending_stiffness, tautline::Cloth::bending_stiffness),
        (cloth.compliance, tautline::Cloth::compliance),
        (cloth.shear_compliance, tautline::Cloth::shear_compliance),
        (cloth.strain_limit, tautline::Cloth::strain_limit),
        (cloth.tear_at, tautline::Cloth::tear_at),
        (cloth.drag, tautline::Cloth::drag),
        (cloth.lift, tautline::Cloth::lift),
        (cloth.pressure, tautline::Cloth::pressure),
    ]
}
