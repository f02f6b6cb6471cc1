//! How bodies are drawn that came with a snapshot and not from a document.

use std::sync::Arc;

use tautline::mesh::TriMesh;
use tautline::{BodyHandle, BodyKind, BodyView};

use super::LiveScene;
use crate::build::{Look, Part};
use crate::error::Error;
use crate::render::palette;

/// Radius at which ropes are drawn of which nothing but their particles is known, in m.
const RADIUS: f32 = 0.01;

impl LiveScene {
    /// Makes sure that a body has a part that fits what it is.
    pub(super) fn find_part(&mut self, body: BodyHandle) -> Result<(), Error> {
        let view = self.builder.world.body(body)?;
        if self.part(body).is_some_and(|part| fits(part, &view)) {
            return Ok(());
        }
        let index = self.builder.parts.len();
        let part = Part { name: format!("restored {index}"), color: palette(index), body, look: look(&view) };
        self.builder.parts.push(part);
        self.part_of.insert(body, index);
        Ok(())
    }
}

fn fits(part: &Part, body: &BodyView<'_>) -> bool {
    match (&part.look, body.kind()) {
        (Look::Solid(mesh) | Look::Round(mesh), BodyKind::Rigid) => {
            body.shape().is_some_and(|shape| shape.triangles() == mesh.triangles)
        }
        (Look::Solid(_) | Look::Round(_), BodyKind::Truss) => true,
        (Look::Sheet, BodyKind::Cloth | BodyKind::SoftSolid) => true,
        (Look::Tube { .. }, BodyKind::Rope) => true,
        (Look::Wall(_), BodyKind::HalfSpace) => true,
        _ => false,
    }
}

fn look(body: &BodyView<'_>) -> Look {
    let solid = |positions: &[tautline::Vec3], triangles: &[[u32; 3]]| {
        Look::Solid(Arc::new(TriMesh { positions: positions.to_vec(), triangles: triangles.to_vec() }))
    };
    match (body.shape(), body.truss(), body.kind()) {
        (Some(shape), ..) => solid(shape.positions(), shape.triangles()),
        (None, Some(truss), _) => {
            let vertices = truss.surface().vertex_count();
            solid(&truss.rest_positions()[..vertices], truss.triangles())
        }
        (None, None, BodyKind::Rope) => Look::Tube { radius: RADIUS },
        (None, None, BodyKind::HalfSpace) => Look::Wall(TriMesh::default()),
        _ => Look::Sheet,
    }
}
