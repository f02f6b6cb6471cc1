//! What cloth and rope are made of beyond sticks of one length. All of it is off unless it is asked for, and all of it is
//! of small steps only.

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use crate::constraint::Stick;

/// What a builder asked for.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Fabric {
    pub(crate) air: Option<AirGrip>,
    pub(crate) gas: Option<Gas>,
    pub(crate) stretch: Option<Stretch>,
    /// Whether its hinges were given as stiffness, and not as compliances.
    pub(crate) bends_by_stiffness: bool,
    pub(crate) wear: Wear,
    /// Particles that are drawn together, and how far apart they may be now (m).
    pub(crate) seams: Vec<Stick>,
}

/// How sticks give.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Stretch {
    /// Of every stick, in m/N; `None` = nothing but the limit holds them.
    pub(crate) compliances: Option<Vec<f32>>,
    /// By what share of their length they may be too long; `None` = any.
    pub(crate) limit: Option<f32>,
}

impl Stretch {
    /// The longest a stick can be, over its length at rest.
    pub(crate) fn longest(&self) -> f32 {
        self.limit.map_or(f32::INFINITY, |limit| 1.0 + limit)
    }

    fn is_sound(&self, sticks: usize) -> bool {
        let sound = |number: &f32| (0.0..f32::INFINITY).contains(number);
        let is_complete = |numbers: &Vec<f32>| numbers.len() == sticks && numbers.iter().all(sound);
        self.compliances.as_ref().is_none_or(is_complete) && self.limit.as_ref().is_none_or(sound)
    }
}

/// What being stretched does to its sticks for good.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Wear {
    /// The strain at which they tear.
    pub(crate) tear_at: Option<f32>,
    pub(crate) creep: Option<Creep>,
}

/// How sticks get longer that are strained too much.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Creep {
    /// The strain that they bear without.
    pub(crate) yield_strain: f32,
    /// In 1/s.
    pub(crate) rate: f32,
}

impl Wear {
    pub(crate) fn is_none(&self) -> bool {
        *self == Self::default()
    }

    fn is_sound(&self) -> bool {
        let sound = |number: f32| (0.0..f32::INFINITY).contains(&number);
        self.tear_at.is_none_or(sound)
            && self.creep.is_none_or(|creep| sound(creep.yield_strain) && sound(creep.rate))
    }
}

/// How the air takes hold of the triangles of a cloth: coefficients, both from 0 on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct AirGrip {
    pub(crate) drag: f32,
    pub(crate) lift: f32,
}

/// Gas in a closed cloth: p V stays as it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Gas {
    /// Its pressure over the surroundings, in Pa, …
    pub(crate) pressure: f32,
    /// … at this volume, in m³.
    pub(crate) volume: f64,
}

/// The share of its volume from which on gas that is pressed together gives way: what is turned inside out has none.
const LEAST_SHARE: f64 = 0.01;

impl Gas {
    /// p V, in J.
    pub(crate) fn content(self) -> f64 {
        f64::from(self.pressure) * self.volume
    }

    /// The volume (m³) that it acts as at one of a cloth.
    pub(crate) fn bounded(self, volume: f64) -> f64 {
        volume.max(LEAST_SHARE * self.volume)
    }

    /// Its pressure over the surroundings at a volume (m³), in Pa.
    pub(crate) fn pressure_at(self, volume: f64) -> f64 {
        self.content() / self.bounded(volume)
    }
}

impl Fabric {
    /// The first of its features that only small steps know, by the name of its field.
    pub(crate) fn beyond_paper(&self) -> Option<&'static str> {
        let stretch = self.stretch.as_ref();
        let features = [
            ("drag", self.air.is_some()),
            ("pressure", self.gas.is_some()),
            ("compliance", stretch.is_some_and(|stretch| stretch.compliances.is_some())),
            ("strain_limit", stretch.is_some()),
            ("seams", !self.seams.is_empty()),
            ("tear_at", self.wear.tear_at.is_some()),
            ("creep", self.wear.creep.is_some()),
        ];
        features.into_iter().find(|(_, is_there)| *is_there).map(|(name, _)| name)
    }

    /// Checks one from untrusted bytes, of a body with so many particles and sticks.
    pub(crate) fn is_sound(&self, particles: usize, sticks: usize) -> bool {
        let sound = |number: f32| (0.0..f32::INFINITY).contains(&number);
        self.air.is_none_or(|air| sound(air.drag) && sound(air.lift))
            && self.gas.is_none_or(|gas| sound(gas.pressure) && gas.volume > 0.0 && gas.volume.is_finite())
            && self.stretch.as_ref().is_none_or(|stretch| stretch.is_sound(sticks))
            && self.wear.is_sound()
            && self.seams.iter().all(|seam| {
                sound(seam.rest_length) && [seam.a, seam.b].iter().all(|&end| (end as usize) < particles)
            })
    }
}

/// The volume that a closed surface holds, in m³: a sum of signed tetrahedra over its triangles with the first corner.
pub(crate) fn volume_of(triangles: &[[u32; 3]], positions: &[Vec3]) -> f64 {
    let at = |corner: u32| positions[corner as usize].as_dvec3();
    let Some(origin) = triangles.first().map(|triangle| at(triangle[0])) else { return 0.0 };
    let six_fold = |triangle: &[u32; 3]| {
        let [a, b, c]: [DVec3; 3] = triangle.map(|corner| at(corner) - origin);
        a.dot(b.cross(c))
    };
    triangles.iter().map(six_fold).sum::<f64>() / 6.0
}
