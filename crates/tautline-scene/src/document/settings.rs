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
    /// Relaxation sweeps over all sticks of a body in a substep.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweeps: Option<u32>,
    /// Relative deviation of a stick from its length up to which it is left alone; 0.01 is 1 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f32>,
    /// The order in which the sticks of a body that collided are relaxed.
    pub ordering: Ordering,
    /// How the length of a stick is computed.
    pub square_root: SquareRoot,
    /// Share of its velocity that a particle loses in a second, from 0 to below 1.
    pub damping: f32,
    /// How pairs of bodies that may touch are found.
    pub broad_phase: BroadPhase,
    /// When bodies at rest stop being moved.
    pub sleep: Sleep,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            solver: Solver::default(),
            gravity: [0.0, -9.81, 0.0],
            substeps: None,
            sweeps: None,
            tolerance: None,
            ordering: Ordering::default(),
            square_root: SquareRoot::default(),
            damping: 0.0,
            broad_phase: BroadPhase::default(),
            sleep: Sleep::default(),
        }
    }
}

/// A solver.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// The reference: bodies of sticks, hit faces, ordered relaxation.
    Paper,
    /// Substeps and soft contacts.
    #[default]
    Default,
}

/// An order of relaxation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Ordering {
    /// By graph distance from the particle that the collision moved furthest.
    #[default]
    ByDistance,
    /// In the order in which the body was built.
    AsBuilt,
}

/// A way to compute the length of a stick.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SquareRoot {
    /// The square root.
    #[default]
    Exact,
    /// Its first-order expansion around the rest length.
    FirstOrder,
}

/// A way to find pairs of bodies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BroadPhase {
    /// A uniform grid.
    #[default]
    Grid,
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

impl Default for Sleep {
    fn default() -> Self {
        Self::After { speed: 0.02, seconds: 0.5 }
    }
}
