//! Looking at a body.

use glam::{Quat, Vec3};

use crate::body::{Body, BodyKind, Frame, Substance, Truss, rigid_motion};
use crate::constraint::Stick;
use crate::error::Error;
use crate::particles::Particles;
use crate::world::{BodyHandle, World};

impl World {
    /// A body, to be looked at.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn body(&self, handle: BodyHandle) -> Result<BodyView<'_>, Error> {
        let index = self.slots.index(handle)?;
        Ok(BodyView { body: &self.bodies[index], particles: &self.particles })
    }
}

/// A body as it is now.
#[derive(Debug, Clone, Copy)]
pub struct BodyView<'a> {
    body: &'a Body,
    particles: &'a Particles,
}

impl<'a> BodyView<'a> {
    /// What it is.
    pub fn kind(&self) -> BodyKind {
        self.body.kind()
    }

    /// Positions of its particles, in m; empty for a half-space.
    pub fn positions(&self) -> &'a [Vec3] {
        &self.particles.position[self.body.particles.clone()]
    }

    /// Inverse masses of its particles, in 1/kg; 0 = pinned.
    pub fn inverse_masses(&self) -> &'a [f32] {
        &self.particles.inverse_mass[self.body.particles.clone()]
    }

    /// Velocity of a particle, in m/s: its mean over the last substep. Zero for one that is not there.
    pub fn particle_velocity(&self, particle: u32) -> Vec3 {
        let displacements = &self.particles.displacement[self.body.particles.clone()];
        displacements.get(particle as usize).map_or(Vec3::ZERO, |&d| d / self.body.displacement_time())
    }

    /// The triangles of its surface over its particles; empty for ropes and half-spaces.
    pub fn triangles(&self) -> &'a [[u32; 3]] {
        match &self.body.substance {
            Substance::Rigid(rigid) => rigid.shape.triangles(),
            Substance::Truss { truss } => truss.triangles(),
            Substance::Deformable(deformable) => &deformable.triangles,
            Substance::Rigid(_) | Substance::HalfSpace(_) => &[],
        }
    }

    /// Its sticks, over its particles.
    pub fn sticks(&self) -> &'a [Stick] {
        match &self.body.substance {
            Substance::Truss { truss } => truss.sticks(),
            Substance::Deformable(deformable) => &deformable.sticks,
            Substance::Rigid(_) | Substance::HalfSpace(_) => &[],
        }
    }

    /// Its shape, if it is rigid.
    pub fn truss(&self) -> Option<&'a Truss> {
        match &self.body.substance {
            Substance::Truss { truss } => Some(truss),
            Substance::Rigid(_) | Substance::Deformable(_) | Substance::HalfSpace(_) => None,
        }
    }

    /// Unit normal out of the solid and offset (m) along it, if it is a half-space.
    pub fn plane(&self) -> Option<(Vec3, f32)> {
        match &self.body.substance {
            Substance::HalfSpace(wall) => Some((wall.normal, wall.offset)),
            Substance::Rigid(_) | Substance::Truss { .. } | Substance::Deformable(_) => None,
        }
    }

    /// Of a rigid body, the mean of its particles (m) and the rotation that best carries its shape's rest
    /// positions into its particles.
    pub fn pose(&self) -> Option<(Vec3, Quat)> {
        match &self.body.substance {
            Substance::Rigid(rigid) => Some(Frame::of_particles(self.positions()).pose(&rigid.shape)),
            Substance::Truss { truss } => Some(truss.pose(self.positions())),
            Substance::Deformable(_) | Substance::HalfSpace(_) => None,
        }
    }

    /// Angular velocity in the world's frame, in rad/s, of a rigid body of four particles: its mean over the last
    /// substep. Zero for any other.
    pub fn angular_velocity(&self) -> Vec3 {
        let Substance::Rigid(rigid) = &self.body.substance else { return Vec3::ZERO };
        let (x, range) = (self.positions(), self.body.particles.clone());
        let frame = Frame::of_particles(x);
        let displacements = &self.particles.displacement[range];
        let (_, angular) = rigid_motion(&frame, x, displacements, rigid.inertia_per_mass());
        angular / self.body.displacement_time()
    }

    /// Σ m x / Σ m, in m; the origin for a half-space.
    pub fn center_of_mass(&self) -> Vec3 {
        self.mean(|i| self.particles.position[i])
    }

    /// Σ m v / Σ m, in m/s.
    pub fn velocity(&self) -> Vec3 {
        self.mean(|i| self.particles.displacement[i]) / self.body.displacement_time()
    }

    /// Σ m, in kg; 0 for a half-space.
    pub fn mass(&self) -> f32 {
        self.particles.mass[self.body.particles.clone()].iter().sum()
    }

    /// Coulomb's coefficient of friction.
    pub fn friction(&self) -> f32 {
        self.body.surface.friction
    }

    /// Whether it never moves.
    pub fn is_fixed(&self) -> bool {
        self.body.fixed
    }

    /// Whether it has been put to sleep.
    pub fn is_asleep(&self) -> bool {
        self.body.rest.asleep
    }

    fn mean(&self, of: impl Fn(usize) -> Vec3) -> Vec3 {
        let total = self.mass();
        if total == 0.0 {
            return Vec3::ZERO;
        }
        self.body.particles.clone().map(|i| of(i) * (self.particles.mass[i] / total)).sum()
    }
}
