//! Where rigid bodies are and how they move, set from outside.

use glam::{Quat, Vec3};

use super::World;
use crate::body::{Frame, Motion, Rigid, Substance, rigid_motion};
use crate::error::{Error, coordinates, within};
use crate::slots::BodyHandle;

/// Where a rigid body is and how it moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct RigidState {
    pub(super) frame: Frame,
    /// Of the centre of mass, in m/s.
    pub(super) velocity: Vec3,
    /// In the world's frame, in rad/s.
    pub(super) angular_velocity: Vec3,
}

impl World {
    /// Puts a rigid body somewhere: the origin of its shape's frame (m) and the rotation from there to the world,
    /// which is normalised. It goes on moving as it did, from there. What lies between is not touched.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid; [`Error::OutOfRange`] if a coordinate is
    /// or the rotation is no quaternion with a length near 1.
    pub fn set_pose(&mut self, handle: BodyHandle, position: Vec3, rotation: Quat) -> Result<(), Error> {
        let (index, rigid) = self.rigid_body(handle)?;
        coordinates("position", position)?;
        within("rotation", rotation.length_squared(), 1e-6, 1e6, "a quaternion with a length near 1")?;
        let frame = Frame::of_shape(&rigid.shape, position, rotation.normalize());
        let state = self.rigid_state(index);
        self.wake_body(index);
        self.wake_around_fixed(index);
        self.set_rigid_state(index, &RigidState { frame, ..state });
        self.wake_around_fixed(index);
        self.rigid.forget_contacts(index);
        Ok(())
    }

    /// Sets a body's velocity (m/s). A rigid body's is that of its centre of mass, and its rotation goes on; of any
    /// other body all particles get it, which stops its rotation. Nothing happens to what never moves.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is.
    pub fn set_velocity(&mut self, handle: BodyHandle, velocity: Vec3) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        coordinates("velocity", velocity)?;
        if self.bodies[index].is_rigid() {
            let state = self.rigid_state(index);
            self.bodies[index].previous_step = 0.0;
            self.set_rigid_state(index, &RigidState { velocity, ..state });
        } else {
            let range = self.bodies[index].particles.clone();
            for i in range.filter(|&i| self.particles.inverse_mass[i] > 0.0) {
                self.particles.displacement[i] = velocity;
            }
            self.bodies[index].previous_step = 0.0;
        }
        self.wake_body(index);
        Ok(())
    }

    /// Sets a rigid body's angular velocity, in the world's frame (rad/s). Nothing happens to what never moves.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid; [`Error::OutOfRange`] if a coordinate is.
    pub fn set_angular_velocity(&mut self, handle: BodyHandle, angular_velocity: Vec3) -> Result<(), Error> {
        let (index, _) = self.rigid_body(handle)?;
        coordinates("angular_velocity", angular_velocity)?;
        let state = self.rigid_state(index);
        self.set_rigid_state(index, &RigidState { angular_velocity, ..state });
        self.wake_body(index);
        Ok(())
    }

    /// The index of a rigid body, and what there is of it besides particles.
    pub(super) fn rigid_body(&mut self, handle: BodyHandle) -> Result<(usize, &mut Rigid), Error> {
        let index = self.slots.index(handle)?;
        match &mut self.bodies[index].substance {
            Substance::Rigid(rigid) => Ok((index, rigid)),
            _ => {
                let problem = "is not rigid: it has particles, but no pose and no inertia of its own".into();
                Err(Error::Invalid { field: "body".into(), problem })
            }
        }
    }

    /// Of a rigid body.
    pub(super) fn rigid_state(&self, index: usize) -> RigidState {
        let body = &self.bodies[index];
        let x = &self.particles.position[body.particles.clone()];
        let d = &self.particles.displacement[body.particles.clone()];
        let frame = Frame::of_particles(x);
        let inertia = match &body.substance {
            Substance::Rigid(rigid) => rigid.inertia_per_mass(),
            _ => Vec3::ONE,
        };
        let (linear, angular) = rigid_motion(&frame, x, d, inertia);
        let time = body.displacement_time();
        RigidState { frame, velocity: linear / time, angular_velocity: angular / time }
    }

    /// Writes the four particles of a rigid body; one that never moves gets the pose only.
    pub(super) fn set_rigid_state(&mut self, index: usize, state: &RigidState) {
        let body = &self.bodies[index];
        let Substance::Rigid(rigid) = &body.substance else { return };
        let moves = rigid.traits.motion != Motion::Fixed;
        let time = body.displacement_time();
        for (i, x) in body.particles.clone().zip(state.frame.particles(rigid.spread())) {
            let velocity = state.velocity + state.angular_velocity.cross(x - state.frame.center);
            self.particles.position[i] = x;
            self.particles.displacement[i] = if moves { velocity * time } else { Vec3::ZERO };
        }
        self.index.take();
    }
}
