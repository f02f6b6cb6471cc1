//! Single particles of trusses, cloth and rope.

use std::ops::Range;

use glam::Vec3;

use super::World;
use super::bodies::check_particle_mass;
use crate::error::{Error, all_coordinates, coordinates};
use crate::settings::ClothSolver;
use crate::slots::BodyHandle;

impl World {
    /// Applies a force (N) to one particle of a body during the next step.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate or `particle` is; [`Error::Invalid`] if the body is
    /// rigid.
    pub fn apply_force_at(&mut self, handle: BodyHandle, particle: u32, force: Vec3) -> Result<(), Error> {
        coordinates("force", force)?;
        let (index, i) = self.particle(handle, particle)?;
        self.particles.add_force(i, force);
        self.wake_body(index);
        Ok(())
    }

    /// Pins a particle where it is.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if `particle` is; [`Error::Invalid`] if the body is rigid.
    pub fn pin(&mut self, handle: BodyHandle, particle: u32) -> Result<(), Error> {
        let (index, i) = self.particle(handle, particle)?;
        self.particles.inverse_mass[i] = 0.0;
        self.particles.displacement[i] = Vec3::ZERO;
        self.wake_body(index);
        Ok(())
    }

    /// Lets a pinned particle go, from rest. The particles of a fixed body stay.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if `particle` is; [`Error::Invalid`] if the body is rigid.
    pub fn unpin(&mut self, handle: BodyHandle, particle: u32) -> Result<(), Error> {
        let (index, i) = self.particle(handle, particle)?;
        if !self.bodies[index].fixed {
            self.particles.inverse_mass[i] = 1.0 / self.particles.mass[i];
            self.wake_body(index);
        }
        Ok(())
    }

    /// Puts a particle somewhere (m) without giving it a velocity; for pinned ones, this is how they are moved.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate or `particle` is; [`Error::Invalid`] if the body is
    /// rigid.
    pub fn set_particle_position(
        &mut self,
        handle: BodyHandle,
        particle: u32,
        position: Vec3,
    ) -> Result<(), Error> {
        coordinates("position", position)?;
        let (index, i) = self.particle(handle, particle)?;
        self.wake_body(index);
        self.wake_around_fixed(index);
        self.index.take();
        self.particles.position[i] = position;
        self.fit_tree(index);
        self.wake_around_fixed(index);
        Ok(())
    }

    /// Puts all particles of a body somewhere (m), in their order; otherwise as [`World::set_particle_position`].
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is; [`Error::Invalid`] if the body is rigid or has
    /// another number of particles.
    pub fn set_particle_positions(&mut self, handle: BodyHandle, positions: &[Vec3]) -> Result<(), Error> {
        let (index, range) = self.all_particles(handle, "positions", positions)?;
        self.wake_body(index);
        self.wake_around_fixed(index);
        self.index.take();
        self.particles.position[range].copy_from_slice(positions);
        self.fit_tree(index);
        self.wake_around_fixed(index);
        Ok(())
    }

    /// Has the sphere tree of a cloth or rope follow its particles, where it is searched.
    fn fit_tree(&mut self, index: usize) {
        if self.settings.cloth == ClothSolver::Paper {
            self.bodies[index].refit_tree(&self.particles.position);
        }
    }

    /// Sets the velocity of a particle, in m/s. Nothing happens to a pinned one.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate or `particle` is; [`Error::Invalid`] if the body is
    /// rigid.
    pub fn set_particle_velocity(
        &mut self,
        handle: BodyHandle,
        particle: u32,
        velocity: Vec3,
    ) -> Result<(), Error> {
        coordinates("velocity", velocity)?;
        let (index, i) = self.particle(handle, particle)?;
        if self.particles.inverse_mass[i] > 0.0 {
            self.particles.displacement[i] = velocity * self.bodies[index].displacement_time();
            self.wake_body(index);
        }
        Ok(())
    }

    /// Sets the velocities of all particles of a body (m/s), in their order; otherwise as
    /// [`World::set_particle_velocity`].
    ///
    /// # Errors
    /// As [`World::set_particle_positions`].
    pub fn set_particle_velocities(&mut self, handle: BodyHandle, velocities: &[Vec3]) -> Result<(), Error> {
        let (index, range) = self.all_particles(handle, "velocities", velocities)?;
        let time = self.bodies[index].displacement_time();
        for (i, velocity) in range.zip(velocities) {
            if self.particles.inverse_mass[i] > 0.0 {
                self.particles.displacement[i] = *velocity * time;
            }
        }
        self.wake_body(index);
        Ok(())
    }

    /// The index of a body and the range of its particles, if a vector is given for each of them.
    fn all_particles(
        &self,
        handle: BodyHandle,
        field: &'static str,
        given: &[Vec3],
    ) -> Result<(usize, Range<usize>), Error> {
        let index = self.slots.index(handle)?;
        let range = self.bodies[index].particles.clone();
        if self.bodies[index].is_rigid() {
            return Err(no_particles());
        }
        if given.len() != range.len() {
            let problem = format!("has {} vectors for {} particles", given.len(), range.len());
            return Err(Error::Invalid { field: field.into(), problem });
        }
        all_coordinates(field, given)?;
        Ok((index, range))
    }

    /// Sets the mass of one particle, in kg.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if `mass` or `particle` is; [`Error::Invalid`] if the body is rigid.
    pub fn set_particle_mass(&mut self, handle: BodyHandle, particle: u32, mass: f32) -> Result<(), Error> {
        let mass = check_particle_mass(mass, 1)?;
        let (index, i) = self.particle(handle, particle)?;
        self.particles.mass[i] = mass;
        if self.particles.inverse_mass[i] > 0.0 {
            self.particles.inverse_mass[i] = 1.0 / mass;
        }
        self.wake_body(index);
        Ok(())
    }

    /// The index of a body, and that of one of its particles in the store.
    fn particle(&self, handle: BodyHandle, particle: u32) -> Result<(usize, usize), Error> {
        let index = self.slots.index(handle)?;
        if self.bodies[index].is_rigid() {
            return Err(no_particles());
        }
        let range = &self.bodies[index].particles;
        if (particle as usize) < range.len() {
            return Ok((index, range.start + particle as usize));
        }
        let (field, value) = ("particle".into(), f64::from(particle));
        Err(Error::OutOfRange { field, value, expected: "the number of one of the body's particles" })
    }
}

fn no_particles() -> Error {
    let problem = "is rigid: its particles move as one and are not to be reached one by one".into();
    Error::Invalid { field: "body".into(), problem }
}
