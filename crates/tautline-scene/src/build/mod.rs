//! Documents to worlds.

mod attachment;
mod body;
mod by_hand;
mod cloth;
pub(crate) mod cue;
mod joint;
mod rigid;
pub(crate) mod settings;
mod shape;
mod soft;
mod wall;

use std::sync::Arc;

use tautline::mesh::TriMesh;
use tautline::{BodyHandle, World};

use crate::document::{self, Bounds, Scene, limits};
use crate::error::{Error, Problem};
use crate::render::Camera;
pub(crate) use body::Builder;

pub use cue::Cue;
pub use soft::Skin;

/// A scene ready to run: its world, and what is needed to draw and judge it.
#[derive(Debug, Clone)]
pub struct BuiltScene {
    /// The scene's name.
    pub name: String,
    /// Its bodies, and how they are simulated.
    pub world: World,
    /// One per body of the world, in its order; a room is six half-spaces.
    pub parts: Vec<Part>,
    /// Where it is seen from; `None` leaves that to who draws it.
    pub camera: Option<Camera>,
    /// What happens at a time.
    pub cues: Vec<Cue>,
    /// The box that bodies belong in, if any.
    pub bounds: Option<Bounds>,
    /// How long it runs, in s.
    pub seconds: f32,
    /// Time step, in s.
    pub dt: f32,
    /// A recording keeps one step in so many.
    pub record_every: u32,
}

/// A body of the scene, as it is named and drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// A name unique in the scene.
    pub name: String,
    /// Colour, sRGB.
    pub color: [u8; 3],
    /// The body in the world.
    pub body: BodyHandle,
    /// How it is drawn.
    pub look: Look,
}

/// How a body is drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Look {
    /// A solid with this surface, in the frame of its pose; bodies of one shape share it.
    Solid(Arc<TriMesh>),
    /// The same for a solid without edges.
    Round(Arc<TriMesh>),
    /// A sheet: the triangles are those of the body's view.
    Sheet,
    /// A surface that is finer than what is simulated, and moves with it.
    Skin(Arc<Skin>),
    /// A tube along the body's particles, or one for each segment of a net.
    Tube {
        /// Radius, in m.
        radius: f32,
    },
    /// A rectangle of a plane, in world coordinates, facing out of the solid.
    Wall(TriMesh),
}

impl Scene {
    /// Makes the world that the document describes. Bodies of equal shape share it.
    ///
    /// # Errors
    /// [`Error::Invalid`] with every problem of the document's values or, if these are right, every body,
    /// joint or attachment that the engine refuses, such as `bodies[3].rigid.shape: mesh: edge (0, 1) is open: …`. Mesh files must have
    /// been read, which [`load`](crate::load) does.
    pub fn build(&self) -> Result<BuiltScene, Error> {
        let (builder, cues) = self.start()?;
        let Builder { world, parts, .. } = builder;
        Ok(BuiltScene {
            name: self.name.clone(),
            world,
            parts,
            camera: self.camera.as_ref().map(camera),
            cues,
            bounds: self.bounds.clone(),
            seconds: self.seconds,
            dt: self.dt,
            record_every: self.record_every,
        })
    }

    /// The world and what is known of it besides, and what happens in it at a time.
    pub(crate) fn start(&self) -> Result<(Builder, Vec<Cue>), Error> {
        self.check()?;
        let mut builder = Builder::new(World::new(settings::of(&self.settings))?, self.has_trusses());
        let mut problems = Vec::new();
        for (i, body) in self.bodies.iter().enumerate() {
            if let Err(refusal) = builder.add(i, i as u32, body) {
                problems.push(refusal.of(body).within(&format!("bodies[{i}].")));
            }
            if problems.len() == limits::PROBLEMS {
                break;
            }
        }
        // Joints hold bodies: they can be added where all of those could.
        let joints = if problems.is_empty() { self.joints.as_slice() } else { &[] };
        for (i, joint) in joints.iter().enumerate() {
            if let Err(error) = builder.join(joint) {
                problems.push(Problem { path: format!("joints[{i}]"), message: error.to_string() });
            }
        }
        let attachments = if problems.is_empty() { self.attachments.as_slice() } else { &[] };
        for (i, attachment) in attachments.iter().enumerate() {
            if let Err(error) = builder.attach(attachment, &self.bodies) {
                problems.push(Problem { path: format!("attachments[{i}]"), message: error.to_string() });
            }
        }
        if !problems.is_empty() {
            return Err(Error::Invalid(problems));
        }
        builder.draw_walls();
        let cues = self.cues.iter().map(|cue| builder.cue(cue)).collect::<Result<_, _>>()?;
        Ok((builder, cues))
    }
}

fn camera(document: &document::Camera) -> Camera {
    Camera {
        eye: document.eye.into(),
        target: document.target.into(),
        vertical_fov: document.fov.to_radians(),
    }
}
