//! Scenes around worlds that are made by calls instead of from a document.

use std::sync::Arc;

use tautline::mesh::TriMesh;
use tautline::{BodyHandle, BodyKind, BodyView, Error, World};

use super::body::GREY;
use super::wall::draw_walls;
use super::{BuiltScene, Look, Part};
use crate::document::Scene;
use crate::render::palette;

/// Radius of ropes whose own is not known, in m: that of a rope that was told none.
const ROPE_RADIUS: f32 = 0.02;

impl BuiltScene {
    /// A scene around a world, with a part for each of its bodies; otherwise as a document without fields.
    ///
    /// # Errors
    /// None while the world's handles are those of its bodies.
    pub fn around(world: World) -> Result<Self, Error> {
        let document = Scene::default();
        let mut scene = Self {
            name: document.name,
            world,
            parts: Vec::new(),
            camera: None,
            cues: Vec::new(),
            bounds: None,
            seconds: document.seconds,
            dt: document.dt,
            record_every: document.record_every,
        };
        scene.sort_parts()?;
        Ok(scene)
    }

    /// Names a body that has been added to the world, and says how it is drawn; what is `None` is made up.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn add_part(
        &mut self,
        body: BodyHandle,
        name: Option<String>,
        color: Option<[u8; 3]>,
        look: Option<Look>,
    ) -> Result<(), Error> {
        let view = self.world.body(body)?;
        let color = color.unwrap_or_else(|| {
            let colored = self.parts.iter().filter(|part| part.color != GREY).count();
            if view.is_fixed() { GREY } else { palette(colored) }
        });
        let look = look.unwrap_or_else(|| look_of(&view));
        let mut name = name.unwrap_or_else(|| format!("{} {}", kind_name(view.kind()), self.parts.len()));
        while self.parts.iter().any(|part| part.name == name) {
            name.push('\'');
        }
        self.parts.push(Part { name, color, body, look });
        Ok(())
    }

    /// Drops the parts of bodies that are in the world no more, and adds one for each that has none: after a world has
    /// been restored.
    ///
    /// # Errors
    /// As [`BuiltScene::around`].
    pub fn sort_parts(&mut self) -> Result<(), Error> {
        let world = &self.world;
        self.parts.retain(|part| world.body(part.body).is_ok());
        let bodies: Vec<BodyHandle> = self.world.bodies().collect();
        for body in bodies {
            if !self.parts.iter().any(|part| part.body == body) {
                self.add_part(body, None, None, None)?;
            }
        }
        Ok(())
    }

    /// Gives half-spaces that have no surface yet one that is drawn.
    pub fn draw_walls(&mut self) {
        draw_walls(&self.world, &mut self.parts);
    }
}

fn look_of(view: &BodyView<'_>) -> Look {
    match view.kind() {
        BodyKind::HalfSpace => Look::Wall(TriMesh::default()),
        BodyKind::Rope => Look::Tube { radius: ROPE_RADIUS },
        BodyKind::Cloth | BodyKind::SoftSolid => Look::Sheet,
        BodyKind::Rigid | BodyKind::Truss => {
            let shape = view.shape().map_or(&[][..], |shape| shape.positions());
            let at_rest = view.truss().map_or(shape, |truss| truss.rest_positions());
            let mesh = TriMesh { positions: at_rest.to_vec(), triangles: view.triangles().to_vec() };
            Look::Solid(Arc::new(mesh))
        }
    }
}

fn kind_name(kind: BodyKind) -> &'static str {
    match kind {
        BodyKind::HalfSpace => "half_space",
        BodyKind::Rope => "rope",
        BodyKind::Cloth => "cloth",
        BodyKind::SoftSolid => "soft_solid",
        BodyKind::Rigid | BodyKind::Truss => "rigid",
    }
}
