//! Bodies. Each builder turns a description into particles, constraints and geometry; vertex `i` of the
//! geometry is particle `i` of the body.

mod cloth;
mod deformable;
mod fabric;
mod flesh;
mod half_space;
mod pose;
mod rigid;
mod rope;
mod soft_solid;
mod surface;
mod truss;
mod wear;

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::settings::ClothSolver;

pub use cloth::{Cloth, Corner};
pub use half_space::HalfSpace;
pub use rigid::{CollisionGroups, Motion, RigidBody};
pub use rope::Rope;
pub use soft_solid::SoftSolid;
pub use surface::{Combine, Surface};
pub use truss::{Truss, TrussBody};

pub(crate) use deformable::{BuiltDeformable, Deformable};
pub(crate) use fabric::{AirGrip, Gas, Stretch, volume_of};
pub(crate) use flesh::{Flesh, Material, RestShape};
pub(crate) use rigid::{CORNERS, Frame, Rigid, Traits, exact_inertia, exact_rotation, rigid_motion};
pub(crate) use surface::Touch;

/// What a body is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyKind {
    /// A rigid body of four particles.
    Rigid,
    /// A rigid body held together by sticks.
    Truss,
    /// A sheet.
    Cloth,
    /// A rope.
    Rope,
    /// A soft solid.
    SoftSolid,
    /// Everything behind a plane.
    HalfSpace,
}

/// A body to be added to a world: any of the builders turns into one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum BodyDescription {
    /// A rigid body of four particles.
    Rigid(RigidBody),
    /// A rigid body held together by sticks.
    Truss(TrussBody),
    /// A sheet.
    Cloth(Cloth),
    /// A rope.
    Rope(Rope),
    /// A soft solid.
    SoftSolid(Box<SoftSolid>),
    /// Everything behind a plane.
    HalfSpace(HalfSpace),
}

macro_rules! describe {
    ($($builder:ident => $variant:ident),*) => {
        $(impl From<$builder> for BodyDescription {
            fn from(builder: $builder) -> Self {
                Self::$variant(builder)
            }
        })*
    };
}
describe!(RigidBody => Rigid, TrussBody => Truss, Cloth => Cloth, Rope => Rope, HalfSpace => HalfSpace);

impl From<SoftSolid> for BodyDescription {
    fn from(builder: SoftSolid) -> Self {
        Self::SoftSolid(Box::new(builder))
    }
}

/// A body in a world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Body {
    pub(crate) particles: Range<usize>,
    pub(crate) substance: Substance,
    pub(crate) surface: Surface,
    /// Whether it can move at all; pins hold single particles.
    pub(crate) fixed: bool,
    /// h⁻, in s: the substep its displacements belong to; 0 = newly placed, they are velocities in m/s.
    pub(crate) previous_step: f32,
    pub(crate) rest: Rest,
}

/// What a body is made of besides particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Substance {
    Rigid(Box<Rigid>),
    Truss {
        /// Shared between bodies; a snapshot stores each once, beside the bodies.
        #[serde(skip)]
        truss: Arc<Truss>,
    },
    Deformable(Box<Deformable>),
    HalfSpace(Box<HalfSpace>),
}

/// How long a body has been still.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rest {
    pub(crate) asleep: bool,
    /// For how long its particles have been near `reference`, in s.
    pub(crate) still_for: f32,
    /// For how long it has been slow while it leant on something, in s: of cloth and rope.
    pub(crate) calm_for: f32,
    /// Where its particles were when it was last found moving; empty until the first step.
    pub(crate) reference: Box<[Vec3]>,
}

impl Body {
    pub(crate) fn new(particles: Range<usize>, substance: Substance, surface: Surface, fixed: bool) -> Self {
        let rest = Rest { asleep: false, still_for: 0.0, calm_for: 0.0, reference: Box::default() };
        Self { particles, substance, surface, fixed, previous_step: 0.0, rest }
    }

    pub(crate) fn kind(&self) -> BodyKind {
        match &self.substance {
            Substance::Rigid(_) => BodyKind::Rigid,
            Substance::Truss { .. } => BodyKind::Truss,
            Substance::Deformable(deformable) if deformable.is_rope() => BodyKind::Rope,
            Substance::Deformable(deformable) if deformable.flesh.is_some() => BodyKind::SoftSolid,
            Substance::Deformable(_) => BodyKind::Cloth,
            Substance::HalfSpace(_) => BodyKind::HalfSpace,
        }
    }

    /// Whether it is a rigid body of four particles, which the substep solver moves.
    pub(crate) fn is_rigid(&self) -> bool {
        matches!(self.substance, Substance::Rigid(_))
    }

    /// What it is besides particles if it is a rigid body.
    pub(crate) fn rigid(&self) -> Option<&Rigid> {
        match &self.substance {
            Substance::Rigid(rigid) => Some(rigid),
            Substance::Truss { .. } | Substance::Deformable(_) | Substance::HalfSpace(_) => None,
        }
    }

    /// What it is besides particles if it is cloth or rope.
    pub(crate) fn deformable(&self) -> Option<&Deformable> {
        match &self.substance {
            Substance::Deformable(deformable) => Some(deformable),
            Substance::Rigid(_) | Substance::Truss { .. } | Substance::HalfSpace(_) => None,
        }
    }

    /// Whether it reports its contacts.
    pub(crate) fn reports_contacts(&self) -> bool {
        self.rigid().is_some_and(|rigid| rigid.traits.reports_contacts)
    }

    /// Holds it where it is for good.
    pub(crate) fn freeze(&mut self) {
        self.fixed = true;
        if let Substance::Rigid(rigid) = &mut self.substance {
            rigid.traits.motion = Motion::Fixed;
        }
    }

    /// Whether it is awake and made of particles that move by themselves.
    pub(crate) fn is_awake_matter(&self) -> bool {
        self.is_awake() && !self.is_rigid()
    }

    /// Whether it is cloth, rope or a soft solid.
    pub(crate) fn is_soft(&self) -> bool {
        matches!(self.substance, Substance::Deformable(_))
    }

    /// Whether it is awake and moved by the paper's solver, given which one moves cloth and rope.
    pub(crate) fn is_relaxed(&self, cloth: ClothSolver) -> bool {
        self.is_awake_matter() && (cloth == ClothSolver::Paper || !self.is_soft())
    }

    /// Whether a step moves it.
    pub(crate) fn is_awake(&self) -> bool {
        !self.fixed && !self.rest.asleep
    }

    /// Fits the sphere tree of a deformable body to its particles, out of those of the world; those of rigid
    /// bodies follow lazily.
    pub(crate) fn refit_tree(&mut self, positions: &[Vec3]) {
        if let Substance::Deformable(deformable) = &mut self.substance {
            // It fails only for a range that is too short, which a body's own never is.
            let _ = deformable.tree.refit(&positions[self.particles.clone()]);
        }
    }

    /// How far beyond its particles it may touch, in m.
    pub(crate) fn reach(&self) -> f32 {
        match &self.substance {
            Substance::Deformable(deformable) => deformable.reach(),
            Substance::Rigid(_) | Substance::Truss { .. } | Substance::HalfSpace(_) => 0.0,
        }
    }

    /// The time its displacements took, in s: d divided by it is the velocity.
    pub(crate) fn displacement_time(&self) -> f32 {
        if self.previous_step > 0.0 { self.previous_step } else { 1.0 }
    }

    /// Checks a body from untrusted bytes, whose particles should begin at `start`.
    pub(crate) fn validate(&self, start: usize) -> Result<(), Error> {
        let count = self.particles.len();
        match &self.substance {
            Substance::Rigid(rigid) => rigid.validate()?,
            Substance::Truss { .. } => {}
            Substance::Deformable(deformable) => deformable.validate(count)?,
            Substance::HalfSpace(wall) => wall.validated().map(|_| ())?,
        }
        let size_fits = match &self.substance {
            Substance::Rigid(_) => count == 4,
            Substance::Truss { truss } => truss.rest_positions().len() == count && count > 0,
            Substance::Deformable(_) => count > 0,
            Substance::HalfSpace(_) => count == 0 && self.fixed,
        };
        self.surface.validate()?;
        let numbers = [self.previous_step, self.rest.still_for, self.rest.calm_for];
        let sound = size_fits
            && self.particles.start == start
            && self.particles.end >= start
            && numbers.iter().all(|number| (0.0..=f32::MAX).contains(number))
            && self.rest.reference.iter().all(|point| point.is_finite());
        if sound { Ok(()) } else { Err(Error::Snapshot("a body is inconsistent".into())) }
    }

    pub(crate) fn wake(&mut self) {
        self.rest.asleep = false;
        self.rest.still_for = 0.0;
    }
}
