//! The world: bodies, their particles, and what is remembered from step to step.

use std::sync::Arc;

use glam::Vec3;

use crate::body::{Body, BodyDescription, BuiltDeformable, HalfSpace, Motion, RigidBody, Substance, Surface, TrussBody};
use crate::collision::{Candidate, Contact, NarrowPhase, PairCache};
use crate::error::{Error, coordinates, positive, within};
use crate::joint::Joints;
use crate::particles::Particles;
use crate::rest::wake_around;
use crate::settings::Settings;
use crate::slots::Slots;
use crate::solver::paper::Moved;
use crate::solver::substep::RigidSolver;

pub use crate::slots::BodyHandle;

/// Everything that is simulated together.
///
/// ```
/// use std::sync::Arc;
/// use tautline::body::{HalfSpace, Truss, TrussBody};
/// use tautline::{Settings, Vec3, World, mesh::primitives};
///
/// let mut world = World::new(Settings::default())?;
/// world.add(HalfSpace::floor(0.0))?;
/// let shape = Arc::new(Truss::from_mesh(&primitives::icosahedron(0.5)?)?);
/// let body = world.add(TrussBody::new(&shape).position(Vec3::Y * 2.0))?;
/// for _ in 0..120 {
///     world.step(1.0 / 60.0)?;
/// }
/// assert!(world.body(body)?.center_of_mass().y < 0.5);
/// # Ok::<(), tautline::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct World {
    pub(crate) settings: Settings,
    pub(crate) particles: Particles,
    pub(crate) bodies: Vec<Body>,
    pub(crate) slots: Slots,
    pub(crate) pairs: PairCache,
    pub(crate) joints: Joints,
    pub(crate) rigid: RigidSolver,
    /// In s.
    pub(crate) time: f64,
    pub(crate) scratch: Scratch,
}

/// Memory that a step fills anew.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    pub(crate) candidates: Vec<Candidate>,
    pub(crate) found: Vec<(u32, u32)>,
    pub(crate) narrow_phase: NarrowPhase,
    pub(crate) contacts: Vec<Contact>,
    /// Of touching rigid bodies, beyond their first.
    pub(crate) more_contacts: Vec<Contact>,
    pub(crate) moved: Vec<Option<Moved>>,
    /// Where all particles were when the substep began.
    pub(crate) start: Vec<Vec3>,
}

impl World {
    /// An empty world.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the path of the first setting that is wrong.
    pub fn new(settings: Settings) -> Result<Self, Error> {
        settings.validate()?;
        Ok(Self {
            settings,
            particles: Particles::default(),
            bodies: Vec::new(),
            slots: Slots::default(),
            pairs: PairCache::default(),
            joints: Joints::default(),
            rigid: RigidSolver::default(),
            time: 0.0,
            scratch: Scratch::default(),
        })
    }

    /// How it is simulated.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes how it is simulated, from the next step on.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the path of the first setting that is wrong; the old ones stay.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), Error> {
        settings.validate()?;
        self.settings = settings;
        self.bodies.iter_mut().for_each(Body::wake);
        Ok(())
    }

    /// The simulated time, in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Adds a body: a [`TrussBody`], [`Cloth`](crate::body::Cloth), [`Rope`](crate::body::Rope) or
    /// [`HalfSpace`].
    ///
    /// # Errors
    /// What is wrong with the description, by field; the world is as before.
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
        self.rigid.invalidate();
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
        Ok(self.push(Body::new(range, Substance::HalfSpace(wall), wall.surface, true)))
    }

    fn add_deformable(&mut self, built: BuiltDeformable) -> Result<BodyHandle, Error> {
        let particle_mass = check_particle_mass(built.mass, built.positions.len())?;
        let range = self.particles.extend(&built.positions, particle_mass, false);
        self.particles.displacement[range.clone()].fill(built.velocity);
        for pin in built.pins {
            let particle = range.start + pin as usize;
            self.particles.inverse_mass[particle] = 0.0;
            self.particles.displacement[particle] = Vec3::ZERO;
        }
        Ok(self.push(Body::new(range, Substance::Deformable(Box::new(built.body)), Surface::with_friction(built.friction), false)))
    }

    fn push(&mut self, body: Body) -> BodyHandle {
        self.bodies.push(body);
        self.wake_around_fixed(self.bodies.len() - 1);
        self.slots.push()
    }

    /// Removes a body with its particles and its joints, and wakes what may have rested on it or hung from it.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn remove(&mut self, handle: BodyHandle) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        wake_around(&mut self.bodies, &self.particles.position, index);
        let range = self.bodies[index].particles.clone();
        self.particles.remove(range.clone());
        self.bodies.remove(index);
        self.slots.remove(index);
        self.pairs.remove_body(index as u32);
        self.rigid.remove_body(index);
        let let_go = self.joints.remove_body(index as u32);
        for body in &mut self.bodies[index..] {
            body.particles = body.particles.start - range.len()..body.particles.end - range.len();
        }
        let_go.into_iter().for_each(|body| self.wake_body(body as usize));
        Ok(())
    }

    /// Wakes a body and, if it slept, the sleepers that may rest on it.
    pub(crate) fn wake_body(&mut self, index: usize) {
        if self.bodies[index].rest.asleep {
            wake_around(&mut self.bodies, &self.particles.position, index);
        }
        self.bodies[index].wake();
    }

    /// Wakes the sleepers about a fixed body that comes or goes. A body that moves wakes what it touches.
    fn wake_around_fixed(&mut self, index: usize) {
        if self.bodies[index].fixed {
            wake_around(&mut self.bodies, &self.particles.position, index);
        }
    }

    /// The handles of all bodies, in the order they were added.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = BodyHandle> + '_ {
        (0..self.bodies.len()).map(|index| self.slots.handle(index))
    }

    /// Positions of all particles, in m, body after body.
    pub fn positions(&self) -> &[Vec3] {
        &self.particles.position
    }

    /// Sets a body's velocity (m/s) and stops its rotation.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is.
    pub fn set_velocity(&mut self, handle: BodyHandle, velocity: Vec3) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        coordinates("velocity", velocity)?;
        let body = &mut self.bodies[index];
        for i in body.particles.clone().filter(|&i| self.particles.inverse_mass[i] > 0.0) {
            self.particles.displacement[i] = velocity;
        }
        body.previous_step = 0.0;
        self.wake_body(index);
        Ok(())
    }

    /// Applies a force (N) to a body during the next step, spread over its particles by their mass.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate is.
    pub fn apply_force(&mut self, handle: BodyHandle, force: Vec3) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        coordinates("force", force)?;
        let range = self.bodies[index].particles.clone();
        let total: f32 = self.particles.mass[range.clone()].iter().sum();
        for i in range {
            self.particles.force[i] += force * (self.particles.mass[i] / total);
        }
        self.particles.is_forced = true;
        self.wake_body(index);
        Ok(())
    }

    /// Applies a force (N) to one particle of a body during the next step.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate or `particle` is.
    pub fn apply_force_at(&mut self, handle: BodyHandle, particle: u32, force: Vec3) -> Result<(), Error> {
        coordinates("force", force)?;
        let (index, i) = self.particle(handle, particle)?;
        self.particles.force[i] += force;
        self.particles.is_forced = true;
        self.wake_body(index);
        Ok(())
    }

    /// Pins a particle where it is.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if `particle` is.
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
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if `particle` is.
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
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate or `particle` is.
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
        self.particles.position[i] = position;
        self.bodies[index].refit_tree(&self.particles.position);
        self.wake_around_fixed(index);
        Ok(())
    }

    /// Sets the mass of one particle, in kg.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if `mass` or `particle` is.
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

    /// Wakes a body.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn wake(&mut self, handle: BodyHandle) -> Result<(), Error> {
        let index = self.slots.index(handle)?;
        self.wake_body(index);
        Ok(())
    }

    /// The index of a body, and that of one of its particles in the store.
    fn particle(&self, handle: BodyHandle, particle: u32) -> Result<(usize, usize), Error> {
        let index = self.slots.index(handle)?;
        let range = &self.bodies[index].particles;
        if (particle as usize) < range.len() {
            return Ok((index, range.start + particle as usize));
        }
        let (field, value) = ("particle".into(), f64::from(particle));
        Err(Error::OutOfRange { field, value, expected: "the number of one of the body's particles" })
    }
}

/// The mass of each of `count` particles that share `mass`, such that it and its inverse are normal numbers.
fn check_particle_mass(mass: f32, count: usize) -> Result<f32, Error> {
    positive("mass", mass)?;
    within("mass", mass / count as f32, 1e-30, 1e30, "a mass of 1e-30 to 1e30 kg for each particle")
}
