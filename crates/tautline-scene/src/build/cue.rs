//! Cues of a document to cues of a built scene.

use tautline::{BodyHandle, Vec3, World};

use super::BuiltScene;
use crate::error::Error;

/// At a time, a body of the world gets other velocities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cue {
    /// When, in s.
    pub at: f32,
    /// The body.
    pub body: BodyHandle,
    /// Its velocity from then on, in m/s.
    pub velocity: Vec3,
    /// Its angular velocity from then on, in rad/s.
    pub angular_velocity: Vec3,
}

impl BuiltScene {
    /// Frames a second of a recording of it.
    pub fn frame_rate(&self) -> f32 {
        1.0 / (self.dt * self.record_every as f32)
    }

    /// Follows the cues of the step that comes next, in the order of the document. Whoever steps the world without a
    /// [`Run`](crate::run::Run) calls it before every step.
    ///
    /// # Errors
    /// [`Error::Engine`] if their bodies have been removed.
    pub fn follow_cues(&mut self) -> Result<(), Error> {
        follow(&self.cues, &mut self.world, self.dt)
    }
}

/// Follows the cues of the step of `dt` seconds that comes next.
pub(crate) fn follow(cues: &[Cue], world: &mut World, dt: f32) -> Result<(), Error> {
    let dt = f64::from(dt);
    let next = (world.time() / dt).round();
    for cue in cues.iter().filter(|cue| (f64::from(cue.at) / dt).round() == next) {
        world.set_velocity(cue.body, cue.velocity)?;
        world.set_angular_velocity(cue.body, cue.angular_velocity)?;
    }
    Ok(())
}
