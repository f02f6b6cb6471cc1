//! Floors and walls.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::surface::Surface;
use crate::error::{Error, coordinates, within};
use crate::norm::Norm;

/// Everything behind a plane is solid: the points x with n·x < offset. It never moves, and nothing can tunnel
/// through it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HalfSpace {
    pub(crate) normal: Vec3,
    pub(crate) offset: f32,
    pub(crate) surface: Surface,
}

impl HalfSpace {
    /// The half-space behind the plane n·x = offset (m), friction 0.5. `normal` points out of the solid, into
    /// the open, and need not be unit: it is normalised when added, `offset` counts along the unit normal.
    pub fn new(normal: Vec3, offset: f32) -> Self {
        Self { normal, offset, surface: Surface::default() }
    }

    /// The level floor at height `y`, in m.
    pub fn floor(y: f32) -> Self {
        Self::new(Vec3::Y, y)
    }

    /// Coulomb's coefficient of friction; a contact uses the geometric mean of both bodies' own.
    pub fn friction(mut self, friction: f32) -> Self {
        self.surface.friction = friction;
        self
    }

    /// Speed apart over speed together of a collision, 0 to 1; for rigid bodies.
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.surface.restitution = restitution;
        self
    }

    /// The whole surface at once.
    pub fn surface(self, surface: Surface) -> Self {
        Self { surface, ..self }
    }

    pub(crate) fn validated(self) -> Result<Self, Error> {
        coordinates("normal", self.normal)?;
        within("offset", self.offset, -1e9, 1e9, "a number from -1e9 to 1e9 (m)")?;
        self.surface.validate()?;
        // Scaled first, so that no length rounds to 0.
        let scaled = self.normal / self.normal.abs().max_element();
        let Some(normal) = scaled.try_unit() else {
            let problem = "is zero; it must point out of the solid".into();
            return Err(Error::Invalid { field: "normal".into(), problem });
        };
        Ok(Self { normal, ..self })
    }
}
