//! Looking at an attachment.

use glam::Vec3;

use super::{Attached, AttachmentHandle, End};
use crate::body::Frame;
use crate::error::Error;
use crate::world::{BodyHandle, World};

impl World {
    /// An attachment, to be looked at.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn attachment(&self, handle: AttachmentHandle) -> Result<AttachmentView<'_>, Error> {
        let index = self.attachments.slots.index(handle)?;
        Ok(AttachmentView { attached: &self.attachments.items[index], world: self })
    }
}

/// An attachment as it is now.
#[derive(Debug, Clone, Copy)]
pub struct AttachmentView<'a> {
    attached: &'a Attached,
    world: &'a World,
}

impl AttachmentView<'_> {
    /// What it holds; `None` for the world, and for half-spaces.
    pub fn bodies(&self) -> [Option<BodyHandle>; 2] {
        self.attached.ends.map(|end| end.body().map(|body| self.world.slots.handle(body as usize)))
    }

    /// Where its ends are, in the world, in m.
    pub fn ends(&self) -> [Vec3; 2] {
        self.attached.ends.map(|end| self.place(end))
    }

    /// The mean force on the first end in the last step, in N; the second felt the opposite.
    pub fn force(&self) -> Vec3 {
        self.attached.force
    }

    /// Whether it has broken: it holds nothing any more.
    pub fn is_broken(&self) -> bool {
        self.attached.is_broken
    }

    fn place(&self, end: End) -> Vec3 {
        let of =
            |body: u32| &self.world.particles.position[self.world.bodies[body as usize].particles.clone()];
        match end {
            End::Particles { body, particles, weights } => {
                let at = of(body);
                let share = |(particle, weight): (u32, f32)| at[particle as usize] * weight;
                particles.into_iter().zip(weights).map(share).sum()
            }
            End::Point { body, point } => {
                let frame = Frame::of_particles(of(body));
                frame.center + frame.axes * point
            }
            End::World(point) => point,
        }
    }
}
