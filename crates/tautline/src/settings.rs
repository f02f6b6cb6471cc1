//! How a world is simulated. Every number is checked when a world is made or its settings are replaced.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::error::{Error, coordinates, positive, within};
use crate::simd::Instructions;

/// How a world is simulated.
///
/// Substeps serve three solvers. Rigid bodies of four particles ([`RigidBody`](crate::RigidBody)) are moved by one of
/// their own, which finds contacts once a step and solves them in every substep. Cloth and rope are moved in small steps,
/// several to a substep, in which they meet rigid bodies. Trusses are moved by the paper's method, all of it in every
/// substep, and cloth and rope too if [`Settings::cloth`] says so.
///
/// [`Settings::default`] has eight substeps, and for trusses two sweeps without tolerance and four features per pair: it
/// holds a tower of ten trusses still. [`Settings::paper`] is the reference for particles held by sticks: one substep, ten
/// sweeps, a tolerance of 1 %, one feature per pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Acceleration of everything that is free to move, in m/s²; a rigid body's
    /// [`gravity_scale`](crate::RigidBody::gravity_scale) is a factor to it.
    pub gravity: Vec3,
    /// Substeps in a step, 1 to 1000: each moves rigid bodies and solves their joints and contacts; and it integrates,
    /// detects, separates and relaxes particles held by sticks.
    pub substeps: u32,
    /// How many features a pair of touching trusses is separated at in a substep, one after another, each the deepest
    /// then, 1 to 16. The paper's method is 1; a cube rests on a cube at 4.
    pub features_per_pair: u32,
    /// The greatest speed at which bodies that have overlapped for longer than a substep are moved apart along the
    /// normal of a contact, and joints draw together what is apart, in m/s. What is pushed by several others at once,
    /// or squeezed out between them, can get faster: a hundred boxes at one point fly apart at 70 m/s.
    /// `None` = at once, which Verlet's integrator turns into a velocity of depth over substep, and for rigid bodies of
    /// four particles as fast as their soft contacts do.
    pub separation_speed: Option<f32>,
    /// How the sticks are relaxed.
    pub relaxation: Relaxation,
    /// Rate at which free motion dies out, in 1/s: v' = v/(1 + damping·h). 0 = none. To it is added
    /// what a rigid body of four particles has of its own, [`RigidBody::damping`](crate::RigidBody::damping).
    pub damping: f32,
    /// Velocity of the air, in m/s: it acts on cloth with [`drag`](crate::Cloth::drag). For gusts, see
    /// [`World::set_wind`](crate::World::set_wind).
    pub wind: Vec3,
    /// Density of the air, in kg/m³; 0 = vacuum.
    pub air_density: f32,
    /// How pairs of trusses, cloth and rope that may touch are found.
    pub broad_phase: BroadPhase,
    /// When resting bodies are put to sleep; `None` = never. Rigid bodies that touch or are joined sleep and wake
    /// together.
    pub sleep: Option<Sleep>,
    /// Which solver moves cloth and rope.
    pub cloth: ClothSolver,
    /// Which instructions the solver of rigid bodies of four particles uses. The result is the same.
    pub instructions: Instructions,
}

/// Which solver moves cloth and rope.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ClothSolver {
    /// The paper's: sphere trees, separation, relaxation in sweeps, once in every substep.
    Paper,
    /// Small steps: 1920 to 3840 in a second, the more the finer the finest cloth is, whatever the substep; each with one
    /// pass over all sticks and contacts. Cloth and rope meet rigid bodies and half-spaces, each other and themselves, but
    /// not trusses.
    #[default]
    SmallSteps,
}

/// How the sticks of a body are relaxed (paper, 6.2).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Relaxation {
    /// The most sweeps over a body's sticks in a substep, 1 to 10 000; fewer if all are within tolerance.
    pub sweeps: u32,
    /// A stick is relaxed only if its length is off by more than this share of its rest length, 0 to 0.5.
    pub tolerance: f32,
    /// In which order a collided truss's sticks are relaxed.
    pub ordering: Ordering,
    /// How a stick's length is found.
    pub square_root: SquareRoot,
}

/// In which order the sticks of a collided truss are relaxed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Ordering {
    /// By graph distance from the particle that separation moved furthest, near ones repeated (paper, 6.2).
    ByDistance,
    /// As the body was built (Jakobsen).
    AsBuilt,
}

/// How a stick's length is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SquareRoot {
    /// √ as the processor rounds it.
    Exact,
    /// Jakobsen's first-order expansion of √ about the rest length: one Newton step, no root.
    FirstOrder,
}

/// How pairs of trusses, cloth and rope that may touch are found. The result is the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BroadPhase {
    /// Boxes sorted along the axis they spread most on, and swept.
    SortAndSweep,
    /// Every pair is tested, as the paper does: O(n²).
    AllPairs,
}

/// When a body counts as resting.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sleep {
    /// A body whose particles drift slower than this, in m/s, …
    pub speed: f32,
    /// … for this long, in s, falls asleep.
    pub seconds: f32,
}

impl Settings {
    /// The paper's own: one substep a step, ten sweeps, 1 % tolerance, ordered lists. It is meant for trusses, cloth
    /// and rope; one substep is too few for stacks of rigid bodies of four particles.
    pub fn paper() -> Self {
        Self {
            gravity: Vec3::new(0.0, -9.81, 0.0),
            substeps: 1,
            features_per_pair: 1,
            separation_speed: None,
            relaxation: Relaxation {
                sweeps: 10,
                tolerance: 0.01,
                ordering: Ordering::ByDistance,
                square_root: SquareRoot::Exact,
            },
            damping: 0.0,
            wind: Vec3::ZERO,
            air_density: 1.2,
            broad_phase: BroadPhase::SortAndSweep,
            sleep: Some(Sleep { speed: 0.03, seconds: 0.5 }),
            cloth: ClothSolver::Paper,
            instructions: Instructions::Widest,
        }
    }

    /// Checks every field; the error names the first that is wrong.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the path of the field.
    pub fn validate(&self) -> Result<(), Error> {
        for (axis, value) in ["x", "y", "z"].into_iter().zip(self.gravity.to_array()) {
            within(
                &format!("settings.gravity.{axis}"),
                value,
                -1e6,
                1e6,
                "a number from -1e6 to 1e6 (m/s²)",
            )?;
        }
        count("settings.substeps", self.substeps, 1000, "a whole number from 1 to 1000")?;
        count("settings.features_per_pair", self.features_per_pair, 16, "a whole number from 1 to 16")?;
        count(
            "settings.relaxation.sweeps",
            self.relaxation.sweeps,
            10_000,
            "a whole number from 1 to 10000",
        )?;
        within(
            "settings.relaxation.tolerance",
            self.relaxation.tolerance,
            0.0,
            0.5,
            "a share from 0 to 0.5",
        )?;
        if let Some(speed) = self.separation_speed {
            positive("settings.separation_speed", speed)?;
        }
        within("settings.damping", self.damping, 0.0, 1e6, "a rate from 0 to 1e6 (1/s)")?;
        coordinates("settings.wind", self.wind)?;
        within("settings.air_density", self.air_density, 0.0, 1e6, "a density from 0 to 1e6 (kg/m³)")?;
        if let Some(sleep) = self.sleep {
            positive("settings.sleep.speed", sleep.speed)?;
            positive("settings.sleep.seconds", sleep.seconds)?;
        }
        Ok(())
    }
}

impl Default for Settings {
    fn default() -> Self {
        let paper = Self::paper();
        let relaxation = Relaxation { sweeps: 2, tolerance: 0.0, ..paper.relaxation };
        Self {
            substeps: 8,
            features_per_pair: 4,
            separation_speed: Some(3.0),
            relaxation,
            cloth: ClothSolver::SmallSteps,
            ..paper
        }
    }
}

fn count(field: &str, value: u32, most: u32, expected: &'static str) -> Result<(), Error> {
    if (1..=most).contains(&value) {
        return Ok(());
    }
    Err(Error::OutOfRange { field: field.into(), value: f64::from(value), expected })
}
