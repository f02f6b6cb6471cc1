//! The world: bodies, their particles, and what is remembered from step to step.

mod bodies;
mod forces;
mod grab;
mod motion;
mod particles;
mod rigid;
mod winding;

use std::sync::OnceLock;

use glam::Vec3;

use crate::attachment::Attachments;
use crate::body::{Body, BodyKind, Deformable, Motion};
use crate::collision::{Candidate, Contact, NarrowPhase, PairCache};
use crate::error::Error;
use crate::events::Contacts;
use crate::joint::Joints;
use crate::particles::Particles;
use crate::query::Index;
use crate::rest::wake_around;
use crate::settings::{ClothSolver, Settings};
use crate::slots::Slots;
use crate::solver::paper::Moved;
use crate::solver::soft::SoftSolver;
use crate::solver::substep::RigidSolver;

pub use crate::slots::BodyHandle;
pub use grab::{GrabHandle, Grip};

pub(crate) use grab::Grabs;

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
    pub(crate) attachments: Attachments,
    pub(crate) rigid: RigidSolver,
    pub(crate) soft: SoftSolver,
    pub(crate) contacts: Contacts,
    pub(crate) grabs: Grabs,
    /// What queries search, made when one is asked and forgotten when something moves.
    pub(crate) index: OnceLock<Index>,
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
            attachments: Attachments::default(),
            rigid: RigidSolver::default(),
            soft: SoftSolver::default(),
            contacts: Contacts::default(),
            grabs: Grabs::default(),
            index: OnceLock::new(),
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
    /// [`Error::OutOfRange`] with the path of the first setting that is wrong; [`Error::Invalid`] if cloth is to be the
    /// paper's solver's while there are attachments, or cloth, rope or soft solids that it cannot move. The old ones stay.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), Error> {
        settings.validate()?;
        if settings.cloth == ClothSolver::Paper {
            self.check_for_paper()?;
            // No other solver searches their trees, or fits them.
            self.bodies.iter_mut().for_each(|body| body.refit_tree(&self.particles.position));
        }
        self.settings = settings;
        self.rigid.invalidate();
        self.soft.invalidate();
        self.bodies.iter_mut().for_each(Body::wake);
        Ok(())
    }

    /// Refuses the paper's solver where it would not move what there is.
    fn check_for_paper(&self) -> Result<(), Error> {
        if self.attachments().len() > 0 {
            let problem = "is the paper's solver, which knows no attachments: detach them first".into();
            return Err(Error::Invalid { field: "cloth".into(), problem });
        }
        if self.bodies.iter().any(|body| body.kind() == BodyKind::SoftSolid) {
            bodies::refuse_under(ClothSolver::Paper)?;
        }
        self.bodies.iter().filter_map(Body::deformable).try_for_each(Deformable::check_for_paper)
    }

    /// The simulated time, in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Wakes a body and, if it slept, the sleepers that may rest on it.
    pub(crate) fn wake_body(&mut self, index: usize) {
        if self.bodies[index].rest.asleep {
            self.wake_neighbours(index);
        }
        self.bodies[index].wake();
    }

    /// Wakes the sleepers that may rest on a body.
    fn wake_neighbours(&mut self, index: usize) {
        let woken = wake_around(&mut self.bodies, &self.particles.position, index);
        self.rigid.wake_islands(&mut self.bodies, &self.joints, &woken);
        self.rigid.invalidate();
    }

    /// Wakes the sleepers about a fixed or kinematic body that comes or goes. A body that moves wakes what it touches.
    fn wake_around_fixed(&mut self, index: usize) {
        let body = &self.bodies[index];
        if body.fixed || body.rigid().is_some_and(|rigid| rigid.traits.motion != Motion::Dynamic) {
            self.wake_neighbours(index);
        }
    }

    /// The handles of all bodies, in the order they were added.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = BodyHandle> + '_ {
        (0..self.bodies.len()).map(|index| self.slots.handle(index))
    }

    /// Positions of all particles, in m, body after body. They stay at one address until a body is added or removed: a
    /// step changes them in place.
    pub fn positions(&self) -> &[Vec3] {
        &self.particles.position
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
}
