//! What distinguishes bodies, changed while they are in a world.

use super::World;
use crate::body::{CollisionGroups, Motion, Surface, Traits};
use crate::error::Error;
use crate::slots::BodyHandle;

impl World {
    /// Makes a rigid body dynamic, kinematic or fixed. It keeps its mass, its pose and, unless it becomes fixed, its
    /// velocities.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid, or if it is to be dynamic and its shape
    /// has no inside.
    pub fn set_motion(&mut self, handle: BodyHandle, motion: Motion) -> Result<(), Error> {
        let (index, rigid) = self.rigid_body(handle)?;
        if motion == Motion::Dynamic && !rigid.shape.is_solid() {
            let problem = "a mesh or height field has no inside and can only be fixed or kinematic".into();
            return Err(Error::Invalid { field: "motion".into(), problem });
        }
        let particle_mass = rigid.mass / 4.0;
        let state = self.rigid_state(index);
        self.rigid_body(handle)?.1.traits.motion = motion;
        let body = &mut self.bodies[index];
        body.fixed = motion == Motion::Fixed;
        let inverse_mass = if motion == Motion::Dynamic { 1.0 / particle_mass } else { 0.0 };
        self.particles.inverse_mass[body.particles.clone()].fill(inverse_mass);
        // Where the particles are depends on what the body is for.
        self.set_rigid_state(index, &state);
        self.rigid.invalidate();
        self.wake_body(index);
        self.wake_neighbours(index);
        Ok(())
    }

    /// Sets how many times the world's gravity acts on a rigid body.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid; [`Error::OutOfRange`].
    pub fn set_gravity_scale(&mut self, handle: BodyHandle, gravity_scale: f32) -> Result<(), Error> {
        self.change_traits(handle, |traits| traits.gravity_scale = gravity_scale).map(|_| ())
    }

    /// Sets the rates at which the motion and the rotation of a rigid body die out, in 1/s.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid; [`Error::OutOfRange`].
    pub fn set_damping(&mut self, handle: BodyHandle, linear: f32, angular: f32) -> Result<(), Error> {
        let change = |traits: &mut Traits| {
            traits.linear_damping = linear;
            traits.angular_damping = angular;
        };
        self.change_traits(handle, change).map(|_| ())
    }

    /// Sets which bodies a rigid body collides with. What rested on it and no longer touches it falls.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid.
    pub fn set_groups(&mut self, handle: BodyHandle, groups: CollisionGroups) -> Result<(), Error> {
        let index = self.change_traits(handle, |traits| traits.groups = groups)?;
        self.wake_neighbours(index);
        Ok(())
    }

    /// Sets the surface of a body: friction, restitution and how they combine. Trusses, cloth and rope have friction
    /// only.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] with the field that is wrong.
    pub fn set_surface(&mut self, handle: BodyHandle, surface: Surface) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        surface.validate()?;
        self.bodies[index].surface = surface;
        self.wake_body(index);
        self.wake_neighbours(index);
        self.rigid.forget_contacts(index);
        Ok(())
    }

    /// Changes traits if what comes out is valid. Returns the index of the body.
    pub(crate) fn change_traits(
        &mut self,
        handle: BodyHandle,
        change: impl FnOnce(&mut Traits),
    ) -> Result<usize, Error> {
        let (index, rigid) = self.rigid_body(handle)?;
        let mut traits = rigid.traits;
        change(&mut traits);
        traits.validate()?;
        rigid.traits = traits;
        self.rigid.invalidate();
        self.wake_body(index);
        Ok(index)
    }
}
