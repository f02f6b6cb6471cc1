//! Adding and removing bodies.

use std::sync::Arc;

use glam::Vec3;

use super::World;
use crate::body::{
    Body, BodyDescription, BuiltDeformable, HalfSpace, Motion, RigidBody, Substance, Surface, TrussBody,
};
use crate::error::{Error, positive, within};
use crate::settings::ClothSolver;
use crate::slots::BodyHandle;

impl World {
    /// Adds a body: a [`RigidBody`], [`TrussBody`], [`Cloth`](crate::body::Cloth), [`Rope`](crate::body::Rope),
    /// [`SoftSolid`](crate::body::SoftSolid) or [`HalfSpace`].
    ///
    /// # Errors
    /// What is wrong with the description, by field; [`Error::Invalid`] for a soft solid where the paper's solver moves
    /// cloth and rope. The world is as before.
    pub fn add(&mut self, body: impl Into<BodyDescription>) -> Result<BodyHandle, Error> {
        match body.into() {
            BodyDescription::Rigid(body) => self.add_rigid(&body),
            BodyDescription::Truss(body) => self.add_truss(body),
            BodyDescription::HalfSpace(wall) => self.add_half_space(wall),
            BodyDescription::Cloth(cloth) => {
                let built = cloth.build()?;
                self.add_deformable(built)
            }
            BodyDescription::Rope(rope) => {
                let built = rope.build()?;
                self.add_deformable(built)
            }
            BodyDescription::SoftSolid(solid) => {
                refuse_under(self.settings.cloth)?;
                let built = solid.build()?;
                self.add_deformable(built)
            }
        }
    }

    fn add_rigid(&mut self, body: &RigidBody) -> Result<BodyHandle, Error> {
        let rigid = body.build()?;
        let frame = body.frame();
        let positions = frame.particles(rigid.spread());
        let is_dynamic = rigid.traits.motion == Motion::Dynamic;
        let is_fixed = rigid.traits.motion == Motion::Fixed;
        let range = self.particles.extend(&positions, rigid.mass / 4.0, !is_dynamic);
        if !is_fixed {
            for i in range.clone() {
                let arm = self.particles.position[i] - frame.center;
                self.particles.displacement[i] = body.velocity + body.angular_velocity.cross(arm);
            }
        }
        Ok(self.push(Body::new(range, Substance::Rigid(Box::new(rigid)), body.surface, is_fixed)))
    }

    fn add_truss(&mut self, body: TrussBody) -> Result<BodyHandle, Error> {
        body.validate()?;
        let positions = body.positions();
        let particle_mass = check_particle_mass(body.mass, positions.len())?;
        let range = self.particles.extend(&positions, particle_mass, body.fixed);
        if !body.fixed {
            for i in range.clone() {
                let arm = self.particles.position[i] - body.position;
                self.particles.displacement[i] = body.velocity + body.angular_velocity.cross(arm);
            }
        }
        let shape = Substance::Truss { truss: Arc::clone(&body.truss) };
        Ok(self.push(Body::new(range, shape, Surface::with_friction(body.friction), body.fixed)))
    }

    fn add_half_space(&mut self, wall: HalfSpace) -> Result<BodyHandle, Error> {
        let wall = wall.validated()?;
        let range = self.particles.len()..self.particles.len();
        Ok(self.push(Body::new(range, Substance::HalfSpace(Box::new(wall)), wall.surface, true)))
    }

    fn add_deformable(&mut self, built: BuiltDeformable) -> Result<BodyHandle, Error> {
        if self.settings.cloth == ClothSolver::Paper {
            built.body.check_for_paper()?;
        }
        for &mass in &built.masses {
            check_particle_mass(mass, 1)?;
        }
        let range = self.particles.extend(&built.positions, 1.0, false);
        self.particles.weigh(range.start, &built.masses);
        self.particles.displacement[range.clone()].copy_from_slice(&built.velocities);
        for pin in built.pins {
            let particle = range.start + pin as usize;
            self.particles.inverse_mass[particle] = 0.0;
            self.particles.displacement[particle] = Vec3::ZERO;
        }
        Ok(self.push(Body::new(
            range,
            Substance::Deformable(Box::new(built.body)),
            Surface::with_friction(built.friction),
            false,
        )))
    }

    fn push(&mut self, body: Body) -> BodyHandle {
        self.index.take();
        // Whatever it is: a snapshot is refused whose lineup knows fewer bodies than there are.
        self.rigid.invalidate();
        self.bodies.push(body);
        self.wake_around_fixed(self.bodies.len() - 1);
        self.slots.push()
    }

    /// Removes a body with its particles, joints and attachments, and wakes what may have rested on it or hung from it.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn remove(&mut self, handle: BodyHandle) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        self.index.take();
        self.grabs.remove_body(handle);
        self.wake_neighbours(index);
        let range = self.bodies[index].particles.clone();
        self.particles.remove(range.clone());
        self.contacts.remove_body(index, &self.slots);
        self.bodies.remove(index);
        self.slots.remove(index);
        self.pairs.remove_body(index as u32);
        self.rigid.remove_body(index);
        self.soft.invalidate();
        let mut let_go = self.joints.remove_body(index as u32);
        let_go.extend(self.attachments.remove_body(index as u32));
        for body in &mut self.bodies[index..] {
            body.particles = body.particles.start - range.len()..body.particles.end - range.len();
        }
        let_go.into_iter().for_each(|body| self.wake_body(body as usize));
        Ok(())
    }
}

/// Refuses soft solids where they would have no inside.
pub(super) fn refuse_under(cloth: ClothSolver) -> Result<(), Error> {
    match cloth {
        ClothSolver::SmallSteps => Ok(()),
        ClothSolver::Paper => {
            let problem = "the paper's solver knows no soft solids: SmallSteps moves them".into();
            Err(Error::Invalid { field: "settings.cloth".into(), problem })
        }
    }
}

/// The mass of each of `count` particles that share `mass`, such that it and its inverse are normal numbers.
pub(super) fn check_particle_mass(mass: f32, count: usize) -> Result<f32, Error> {
    positive("mass", mass)?;
    within("mass", mass / count as f32, 1e-30, 1e30, "a mass of 1e-30 to 1e30 kg for each particle")
}
