//! Cloth of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::shape::Surface;
use super::value::{Color, Pin, Rotation, SheetPlace, Weight};

/// A sheet. A grid lies in the plane y = 0 of its own frame, around the origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Cloth {
    /// A name of its own, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its rest shape, in its own frame.
    pub surface: Surface,
    /// Where its frame is, in m.
    pub position: [f32; 3],
    /// How its frame is turned.
    pub rotation: Rotation,
    /// How far the middle of a grid hangs below its corners where it is laid out, at rest, in m; half as far at the
    /// middle of its sides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sag: Option<f32>,
    /// Velocity, in m/s.
    pub velocity: [f32; 3],
    /// Mass of the whole sheet, in kg, unless a density or masses are given.
    pub mass: f32,
    /// Mass per area, in kg/m².
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f32>,
    /// The mass of every particle, in kg; none or all of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub masses: Vec<f32>,
    /// Particles that never move: vertex indices, or places of a grid.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pins: Vec<Pin<SheetPlace>>,
    /// Particles with a mass of their own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub weights: Vec<Weight<SheetPlace>>,
    /// Coefficient of friction, 0 being none.
    pub friction: f32,
    /// Whether it collides with itself.
    pub self_collision: bool,
    /// How far from solids it is kept, in m; chosen by the distance of its particles if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f32>,
    /// Compliance of its resistance to bending, in rad²/J, 0 being rigid; none if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending: Option<f32>,
    /// Flexural rigidity, in N·m: a strip of width b resists bending with the moment of b times this times the
    /// curvature. Cotton has some 1e-5, paper 1e-3; none if absent. Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_stiffness: Option<f32>,
    /// How far it gives when it is pulled, in m/N: strain per tension, tension being force per width. A knitted sheet has
    /// about 1e-3, canvas 1e-5; not at all if absent. Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compliance: Option<f32>,
    /// How far a grid that has a compliance gives when it is sheared, in m/N: angle per force along a width. Only for the
    /// solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_compliance: Option<f32>,
    /// The share of its length at rest that it stretches by and no further: 0.05 is 5 %. Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_limit: Option<f32>,
    /// The share of its length beyond which an edge tears, with the triangles beside it: 0.2 is 20 %. It needs a
    /// compliance, over which it is the strength in N/m; never if absent. Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tear_at: Option<f32>,
    /// How it gets longer for good where it is stretched. It needs a compliance; not at all if absent. Only for the
    /// solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub creep: Option<Creep>,
    /// Coefficient of the force with which the air drags at it, about 1.2 for a plate; no air if absent. Only for the
    /// solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag: Option<f32>,
    /// Coefficient of the force with which the air lifts it across the wind; none if absent. Only for the solver
    /// `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lift: Option<f32>,
    /// Pressure of the gas in a closed mesh over the surroundings, in Pa, at the volume it begins with; no gas if absent.
    /// Only for the solver `default`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure: Option<f32>,
    /// Pairs of particles that are drawn together and stay so. Only for the solver `default`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub seams: Vec<[u32; 2]>,
    /// Colour; chosen by its place in the scene if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

impl Default for Cloth {
    /// 20 × 20 particles over 1 m × 1 m, 1 kg.
    fn default() -> Self {
        Self {
            name: None,
            surface: Surface::default(),
            position: [0.0; 3],
            rotation: Rotation::default(),
            sag: None,
            velocity: [0.0; 3],
            mass: 1.0,
            density: None,
            masses: Vec::new(),
            pins: Vec::new(),
            weights: Vec::new(),
            friction: 0.5,
            self_collision: true,
            thickness: None,
            bending: None,
            bending_stiffness: None,
            compliance: None,
            shear_compliance: None,
            strain_limit: None,
            tear_at: None,
            creep: None,
            drag: None,
            lift: None,
            pressure: None,
            seams: Vec::new(),
            color: None,
        }
    }
}

/// How a sheet gets longer for good.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Creep {
    /// The strain that it bears without, as a share of its length.
    pub yield_strain: f32,
    /// Rate, in 1/s: of what an edge is too long by, e^(−rate t) is left after the time t.
    pub rate: f32,
}
