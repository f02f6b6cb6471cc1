//! How a scene is solved.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The solver and its parameters. What is absent is the solver's own choice.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Which solver moves the bodies.
    pub solver: Solver,
    /// Gravity, in m/s².
    pub gravity: [f32; 3],
    /// Parts that a step is divided into.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub substeps: Option<u32>,
    /// How many features two rigid bodies that touch are separated at in a substep, one after another.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub features_per_pair: Option<u32>,
    /// Greatest speed at which bodies that have overlapped for longer than a substep are moved apart, in m/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub separation_speed: Option<f32>,
    /// Relaxation sweeps over all sticks of a body in a substep.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweeps: Option<u32>,
    /// Relative deviation of a stick from its length up to which it is left alone; 0.01 is 1 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f32>,
    /// The order in which the sticks of a body that collided are relaxed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ordering: Option<Ordering>,
    /// How the length of a stick is computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub square_root: Option<SquareRoot>,
    /// Rate at which free motion dies out, in 1/s, 0 being none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<f32>,
    /// Velocity of the air, in m/s, which acts on cloth with drag or lift; still if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wind: Option<[f32; 3]>,
    /// Density of the air, in kg/m³, 0 being none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub air_density: Option<f32>,
    /// How pairs of bodies that may touch are found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub broad_phase: Option<BroadPhase>,
    /// When bodies at rest stop being moved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sleep: Option<Sleep>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            solver: Solver::default(),
            gravity: [0.0, -9.81, 0.0],
            substeps: None,
            features_per_pair: None,
            separation_speed: None,
            sweeps: None,
            tolerance: None,
            ordering: None,
            square_root: None,
            damping: None,
            wind: None,
            air_density: None,
            broad_phase: None,
            sleep: None,
        }
    }
}

impl Settings {
    /// Changes to another solver with that solver's own substeps, features, sweeps and tolerance: those of the
    /// document were chosen for the one before.
    pub fn use_solver(&mut self, solver: Solver) {
        if self.solver != solver {
            let Self {
                gravity, ordering, square_root, damping, wind, air_density, broad_phase, sleep, ..
            } = *self;
            let kept = Self {
                gravity,
                ordering,
                square_root,
                damping,
                wind,
                air_density,
                broad_phase,
                sleep,
                ..Self::default()
            };
            *self = Self { solver, ..kept };
        }
    }
}

/// A solver.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// The reference: bodies of sticks, hit faces, ordered relaxation.
    Paper,
    /// Substeps: rigid bodies of four particles with soft contacts; small steps for cloth and rope.
    #[default]
    Default,
}

/// An order of relaxation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Ordering {
    /// By graph distance from the particle that the collision moved furthest.
    ByDistance,
    /// In the order in which the body was built.
    AsBuilt,
}

/// A way to compute the length of a stick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SquareRoot {
    /// The square root.
    Exact,
    /// Its first-order expansion around the rest length.
    FirstOrder,
}

/// A way to find pairs of bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BroadPhase {
    /// Boxes sorted along one axis, and swept.
    SortAndSweep,
    /// Every pair is tested.
    AllPairs,
}

/// When bodies at rest stop being moved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Sleep {
    /// Never.
    Never,
    /// Once slow for long enough.
    After {
        /// Speed below which a body is slow, in m/s.
        speed: f32,
        /// How long it must have been slow, in s.
        seconds: f32,
    },
}
