//! What the kinds of joints have in common: rows that are locked, and rows with bounds that may be driven.

use serde::{Deserialize, Serialize};

use super::MOST_STOPS;
use crate::error::{Error, within};

/// What drives a hinge or a slider.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Motor {
    /// The speed it wants, in rad/s or m/s.
    pub speed: f32,
    /// The most it gives for that, in N m or N.
    pub strength: f32,
}

/// A damped spring, by what it does to the bodies it holds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Spring {
    /// Undamped, in Hz.
    pub(crate) frequency: f32,
    /// Over critical damping.
    pub(crate) damping_ratio: f32,
}

/// What may happen along a free axis: lowest and highest value, and what drives it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Drive {
    pub(crate) limits: Option<[f32; 2]>,
    pub(crate) motor: Option<Motor>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Kind {
    /// How far its axis may lean, and how far the body may turn about it, in rad.
    Ball {
        cone: Option<f32>,
        twist: Option<[f32; 2]>,
    },
    Hinge(Drive),
    Fixed,
    Slider(Drive),
    /// Lengths, in m.
    Distance {
        length: f32,
        limits: Option<[f32; 2]>,
        spring: Option<Spring>,
    },
}

/// What a row with bounds is about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stop {
    pub(crate) low: f32,
    pub(crate) high: f32,
    pub(crate) push: Option<Push>,
}

/// What acts within the bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Push {
    Motor(Motor),
    /// About a length, in m.
    Spring(Spring, f32),
}

impl Kind {
    /// How many rows are locked: along the base's axes, and about them.
    pub(crate) fn locks(&self) -> [usize; 2] {
        match self {
            Self::Ball { .. } => [3, 0],
            Self::Hinge(_) => [3, 2],
            Self::Fixed => [3, 3],
            Self::Slider(_) => [2, 3],
            Self::Distance { .. } => [0, 0],
        }
    }

    /// What its rows with bounds are about; they follow the locked ones.
    pub(crate) fn stops(&self) -> [Option<Stop>; MOST_STOPS] {
        let along = |drive: &Drive| {
            let [low, high] = drive.limits.unwrap_or(UNLIMITED);
            let is_free = drive.limits.is_none() && drive.motor.is_none();
            (!is_free).then(|| Stop { low, high, push: drive.motor.map(Push::Motor) })
        };
        let between = |[low, high]: [f32; 2]| Stop { low, high, push: None };
        match *self {
            Self::Ball { cone, twist } => {
                [cone.map(|most| between([-f32::INFINITY, most])), twist.map(between)]
            }
            Self::Hinge(drive) | Self::Slider(drive) => [along(&drive), None],
            Self::Fixed => [None; MOST_STOPS],
            Self::Distance { length, limits, spring } => {
                let [low, high] = limits.unwrap_or(UNLIMITED);
                [Some(Stop { low, high, push: spring.map(|spring| Push::Spring(spring, length)) }), None]
            }
        }
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        match self {
            Self::Ball { cone, twist } => {
                if let Some(cone) = cone {
                    within("cone", *cone, 0.0, std::f32::consts::PI, "an angle from 0 to π (rad)")?;
                }
                twist.map_or(Ok(()), |twist| ordered("twist", twist, std::f32::consts::PI))
            }
            Self::Hinge(drive) | Self::Slider(drive) => drive.validate(),
            Self::Fixed => Ok(()),
            Self::Distance { length, limits, spring } => {
                within("length", *length, 0.0, 1e9, "a length from 0 to 1e9 (m)")?;
                if let Some(limits) = limits {
                    within("range.low", limits[0], 0.0, 1e9, "a length from 0 to 1e9 (m)")?;
                    ordered("range", *limits, 1e9)?;
                }
                spring.map_or(Ok(()), |spring| spring.validate())
            }
        }
    }
}

const UNLIMITED: [f32; 2] = [f32::NEG_INFINITY, f32::INFINITY];

impl Drive {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        self.limits.map_or(Ok(()), |limits| ordered("limits", limits, 1e9))?;
        self.motor.map_or(Ok(()), |motor| motor.validate())
    }
}

impl Motor {
    fn validate(&self) -> Result<(), Error> {
        within("motor.speed", self.speed, -1e6, 1e6, "a speed from -1e6 to 1e6")?;
        within("motor.strength", self.strength, 0.0, 1e20, "a force or torque from 0 to 1e20").map(|_| ())
    }
}

impl Spring {
    fn validate(&self) -> Result<(), Error> {
        within("spring.frequency", self.frequency, 1e-6, 1e6, "a frequency from 1e-6 to 1e6 (Hz)")?;
        within("spring.damping_ratio", self.damping_ratio, 0.0, 1e6, "a ratio from 0 to 1e6").map(|_| ())
    }
}

/// Refuses bounds that are NaN, beyond ±`most`, or in the wrong order.
pub(crate) fn ordered(field: &str, [low, high]: [f32; 2], most: f32) -> Result<(), Error> {
    within(&format!("{field}.low"), low, -most, most, "a number within the joint's reach")?;
    within(&format!("{field}.high"), high, low, most, "a number from the lower bound to the joint's reach")?;
    Ok(())
}
