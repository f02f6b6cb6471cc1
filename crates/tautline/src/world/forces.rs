//! Forces, torques and impulses.

use glam::Vec3;

use super::World;
use crate::body::{Body, Frame, Motion};
use crate::error::{Error, coordinates};
use crate::slots::BodyHandle;

impl World {
    /// Applies a force (N) to a body during the next step, at its centre of mass: spread over its particles by
    /// their mass.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is.
    pub fn apply_force(&mut self, handle: BodyHandle, force: Vec3) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        coordinates("force", force)?;
        let range = self.bodies[index].particles.clone();
        let total: f32 = self.particles.mass[range.clone()].iter().sum();
        for i in range {
            self.particles.add_force(i, force * (self.particles.mass[i] / total));
        }
        self.wake_body(index);
        Ok(())
    }

    /// Applies a force (N) to a rigid body during the next step, at a point of it (in the world, m).
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid; [`Error::OutOfRange`] if a coordinate is.
    pub fn apply_force_at_point(
        &mut self,
        handle: BodyHandle,
        force: Vec3,
        point: Vec3,
    ) -> Result<(), Error> {
        let (index, rigid) = self.rigid_body(handle)?;
        let spread = rigid.spread();
        coordinates("force", force)?;
        coordinates("point", point)?;
        // The point is Σ wᵢ xᵢ with Σ wᵢ = 1, so that wᵢ F have the same sum and the same moment as F there.
        let weights = self.rigid_frame(index).weights(point, spread);
        self.add_forces(index, weights.map(|weight| force * weight));
        Ok(())
    }

    /// Applies a torque (N m, in the world's frame) to a rigid body during the next step.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid; [`Error::OutOfRange`] if a coordinate is.
    pub fn apply_torque(&mut self, handle: BodyHandle, torque: Vec3) -> Result<(), Error> {
        let (index, rigid) = self.rigid_body(handle)?;
        let (spread, inertia_per_mass) = (rigid.spread(), rigid.inertia_per_mass());
        coordinates("torque", torque)?;
        // What turns four quarters of the mass alike: Σ rᵢ × (α × rᵢ)/4 = I α/m = τ, and their sum is 0.
        let frame = self.rigid_frame(index);
        let turn = frame.axes * (frame.axes.transpose() * torque / inertia_per_mass);
        self.add_forces(index, frame.particles(spread).map(|x| turn.cross(x - frame.center) * 0.25));
        Ok(())
    }

    /// Changes [`Settings::wind`](crate::Settings::wind) (m/s) from the next step on, as gusts do, and wakes the cloth that
    /// it acts on. Where all else stays this takes less than [`World::set_settings`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a coordinate is.
    pub fn set_wind(&mut self, wind: Vec3) -> Result<(), Error> {
        coordinates("wind", wind)?;
        if wind != self.settings.wind {
            let is_in_air = |body: &Body| body.deformable().is_some_and(|soft| soft.fabric.air.is_some());
            let moved: Vec<usize> =
                (0..self.bodies.len()).filter(|&index| is_in_air(&self.bodies[index])).collect();
            moved.into_iter().for_each(|index| self.wake_body(index));
        }
        self.settings.wind = wind;
        Ok(())
    }

    /// Changes a body's momentum (N s) at once, at its centre of mass: every particle that can move gets the same
    /// change of velocity, impulse over mass.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is; [`Error::Invalid`] if it would move the body
    /// at more than 1e9 m/s.
    pub fn apply_impulse(&mut self, handle: BodyHandle, impulse: Vec3) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        coordinates("impulse", impulse)?;
        let range = self.bodies[index].particles.clone();
        let total: f32 = self.particles.mass[range].iter().sum();
        let change = if total > 0.0 { impulse / total } else { Vec3::ZERO };
        self.change_velocity("impulse", index, (change, Vec3::ZERO))
    }

    /// Changes the momentum of a rigid body at once by an impulse (N s) at a point of it (in the world, m).
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is; [`Error::Invalid`] if the body is not rigid,
    /// or if it would move at more than 1e9 m/s or rad/s.
    pub fn apply_impulse_at_point(
        &mut self,
        handle: BodyHandle,
        impulse: Vec3,
        point: Vec3,
    ) -> Result<(), Error> {
        let (index, rigid) = self.rigid_body(handle)?;
        let mass = rigid.mass;
        coordinates("impulse", impulse)?;
        coordinates("point", point)?;
        let arm = point - self.rigid_frame(index).center;
        let turn = self.turn_of(index, arm.cross(impulse / mass));
        self.change_velocity("impulse", index, (impulse / mass, turn))
    }

    /// Changes the angular momentum of a rigid body at once (N m s, in the world's frame).
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is; [`Error::Invalid`] if the body is not rigid,
    /// or if it would turn at more than 1e9 rad/s.
    pub fn apply_angular_impulse(&mut self, handle: BodyHandle, impulse: Vec3) -> Result<(), Error> {
        let (index, rigid) = self.rigid_body(handle)?;
        let mass = rigid.mass;
        coordinates("impulse", impulse)?;
        let turn = self.turn_of(index, impulse / mass);
        self.change_velocity("impulse", index, (Vec3::ZERO, turn))
    }

    pub(super) fn rigid_frame(&self, index: usize) -> Frame {
        Frame::of_particles(&self.particles.position[self.bodies[index].particles.clone()])
    }

    fn add_forces(&mut self, index: usize, forces: [Vec3; 4]) {
        for (i, force) in self.bodies[index].particles.clone().zip(forces) {
            self.particles.add_force(i, force);
        }
        self.wake_body(index);
    }

    /// What an angular impulse per mass (m²/s) adds to the angular velocity of a rigid body.
    fn turn_of(&mut self, index: usize, impulse_per_mass: Vec3) -> Vec3 {
        let frame = self.rigid_frame(index);
        let inertia = self.bodies[index].rigid().map_or(Vec3::ONE, |rigid| rigid.inertia_per_mass());
        frame.axes * (frame.axes.transpose() * impulse_per_mass / inertia)
    }

    /// Adds a linear (m/s) and, for a rigid body, an angular velocity (rad/s) to what can move.
    fn change_velocity(
        &mut self,
        field: &str,
        index: usize,
        (linear, angular): (Vec3, Vec3),
    ) -> Result<(), Error> {
        let body = &self.bodies[index];
        let is_driven = body.rigid().is_some_and(|rigid| rigid.traits.motion != Motion::Dynamic);
        if body.fixed || is_driven {
            return Ok(());
        }
        let in_range = |v: Vec3| v.abs().cmple(Vec3::splat(1e9)).all();
        if !(in_range(linear) && in_range(angular)) {
            let problem = "would give the body a speed of more than 1e9 m/s or rad/s".into();
            return Err(Error::Invalid { field: field.into(), problem });
        }
        let (range, time) = (body.particles.clone(), body.displacement_time());
        let center = if angular == Vec3::ZERO { Vec3::ZERO } else { self.rigid_frame(index).center };
        for i in range.filter(|&i| self.particles.inverse_mass[i] > 0.0) {
            let arm = self.particles.position[i] - center;
            self.particles.displacement[i] += (linear + angular.cross(arm)) * time;
        }
        self.wake_body(index);
        Ok(())
    }
}
