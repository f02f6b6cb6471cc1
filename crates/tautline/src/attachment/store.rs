//! The attachments of a world.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{Anchor, Attached, Attachment, End};
use crate::body::{Body, Substance};
use crate::error::Error;
use crate::norm::Norm;
use crate::slots::Slots;
use crate::world::World;

pub use crate::slots::AttachmentHandle;

/// All attachments, with their handles, in the order they were added.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Attachments {
    pub(crate) slots: Slots,
    pub(crate) items: Vec<Attached>,
}

impl Attachments {
    /// The attachments that hold, with their indices.
    pub(crate) fn holding(&self) -> impl Iterator<Item = (usize, &Attached)> {
        self.items.iter().enumerate().filter(|(_, attached)| !attached.is_broken)
    }

    fn remove(&mut self, index: usize) {
        self.slots.remove(index);
        self.items.remove(index);
    }

    /// Removes the attachments of a body that is removed, and returns which bodies they held as well. The bodies behind
    /// it move down.
    pub(crate) fn remove_body(&mut self, body: u32) -> Vec<u32> {
        let mut let_go = Vec::new();
        for index in (0..self.items.len()).rev() {
            if self.items[index].bodies().any(|held| held == body) {
                let_go.extend(self.items[index].bodies().filter(|&other| other != body));
                self.remove(index);
            }
        }
        let moved = |other: u32| other - u32::from(other > body);
        for held in self.items.iter_mut().flat_map(|item| &mut item.ends).filter_map(End::body_mut) {
            *held = moved(*held);
        }
        let_go.into_iter().map(moved).collect()
    }

    /// Checks attachments from untrusted bytes.
    pub(crate) fn is_valid(&self, bodies: &[Body]) -> bool {
        let is_sound = |attached: &Attached| {
            let is_soft = |end: &End| matches!(end, End::Particles { .. });
            attached.ends.iter().all(|end| end.is_sound(bodies))
                && attached.ends.iter().any(is_soft)
                && attached.strength.validate().is_ok()
                && attached.force.is_finite()
        };
        self.slots.is_valid(self.items.len()) && self.items.iter().all(is_sound)
    }
}

impl End {
    fn is_sound(&self, bodies: &[Body]) -> bool {
        match self {
            Self::Particles { body, particles, weights } => {
                let Some(body) = bodies.get(*body as usize) else { return false };
                matches!(body.substance, Substance::Deformable(_))
                    && particles.iter().all(|&particle| (particle as usize) < body.particles.len())
                    && weights.iter().all(|weight| (0.0..=1.0).contains(weight))
            }
            Self::Point { body, point } => {
                bodies.get(*body as usize).is_some_and(Body::is_rigid) && point.is_finite()
            }
            Self::World(point) => point.is_finite(),
        }
    }
}

impl World {
    /// Keeps two points together, of which one at least is on cloth or rope. It wakes the bodies it holds. Points that
    /// are apart are drawn together, no faster than [`Settings::separation_speed`](crate::Settings) unless the
    /// attachment gives way; particles that it holds do not collide with what they are held to.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use tautline::{Anchor, Attachment, RigidBody, Rope, Settings, Shape, Vec3, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let rope = world.add(Rope::straight(Vec3::Y * 2.0, Vec3::Y, 10).pin(0))?;
    /// let cube = Arc::new(Shape::cuboid(Vec3::splat(0.2))?);
    /// let load = world.add(RigidBody::new(&cube).mass(5.0).position(Vec3::Y * 0.8))?;
    /// let top = Anchor::point(load, Vec3::Y * 0.2);
    /// let hook = world.attach(Anchor::particle(rope, 10), top, Attachment::default())?;
    /// for _ in 0..60 {
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// let view = world.attachment(hook)?;
    /// assert!((view.force().y + 5.0 * 9.81).abs() < 0.5, "the load hangs on the rope");
    /// # Ok::<(), tautline::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::StaleHandle`] for a body that is not there; [`Error::Invalid`] for an anchor that its body does not have,
    /// for two that are not on cloth or rope, and where [`Settings::cloth`](crate::Settings) is the paper's solver;
    /// [`Error::OutOfRange`] for a wrong number, by field. The world is as before.
    pub fn attach(
        &mut self,
        a: Anchor,
        b: Anchor,
        attachment: Attachment,
    ) -> Result<AttachmentHandle, Error> {
        let attached = attachment.build(self, [a, b])?;
        self.attachments.items.push(attached);
        let handle = self.attachments.slots.push();
        self.disturb_attachment(self.attachments.items.len() - 1);
        Ok(handle)
    }

    /// Removes an attachment, and wakes the bodies it held.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn detach(&mut self, handle: AttachmentHandle) -> Result<(), Error> {
        let index = self.attachments.slots.index(handle)?;
        self.disturb_attachment(index);
        self.attachments.remove(index);
        Ok(())
    }

    /// The handles of all attachments, also broken ones, in the order they were added.
    pub fn attachments(&self) -> impl ExactSizeIterator<Item = AttachmentHandle> + '_ {
        (0..self.attachments.items.len()).map(|index| self.attachments.slots.handle(index))
    }

    fn disturb_attachment(&mut self, index: usize) {
        for body in self.attachments.items[index].ends.into_iter().filter_map(End::body) {
            self.wake_body(body as usize);
        }
        self.soft.invalidate();
    }

    /// Ends a step of substeps of `h` (s): notes with what force attachments held, and breaks those that held too much.
    pub(crate) fn note_attachments(&mut self, h: f32) {
        for (index, force) in self.soft.attachment_forces(h) {
            let attached = &mut self.attachments.items[index];
            // More than numbers can say is more than anything bears, and no figure to be told.
            let is_finite = force.is_finite();
            attached.force = if is_finite { force } else { Vec3::ZERO };
            let exceeds = |most: f32| !is_finite || force.norm() > most;
            if attached.strength.break_force.is_some_and(exceeds) {
                attached.is_broken = true;
                self.soft.invalidate();
            }
        }
    }
}
