//! Kernels of constraints: values in, corrections out. Storage, loops and order live with the solver.

mod angle;
mod bending;
mod order;
mod stick;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::norm::Norm;

pub use angle::Angle;
pub use bending::Bending;
pub use stick::Stick;

pub(crate) use angle::gradient as angle_gradient;
pub(crate) use bending::gradient as bending_gradient;
pub(crate) use order::OrderedLists;
pub(crate) use stick::scale as stick_scale;

/// What an angle is held to, in rad.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum AngleLimit {
    /// Held at a value.
    Target(f32),
    /// Free between two values.
    Range(f32, f32),
}

impl AngleLimit {
    /// C, in rad: how far `angle` is from what it is held to; 0 inside a range.
    #[inline]
    pub fn violation(self, angle: f32) -> f32 {
        match self {
            Self::Target(target) => angle - target,
            Self::Range(low, high) => angle - angle.max(low).min(high),
        }
    }

    pub(crate) fn is_finite(self) -> bool {
        match self {
            Self::Target(target) => target.is_finite(),
            Self::Range(low, high) => low.is_finite() && high.is_finite() && low <= high,
        }
    }
}

/// The multiplier step of extended position-based dynamics: Δλ = (−C − α̃λ)/(Σ w|∇C|² + α̃) (Macklin, Müller and
/// Chentanez 2016, Eq 18), with α̃ = α/h². 0 where nothing can move.
#[inline]
pub(crate) fn multiplier_step(violation: f32, compliance: f32, multiplier: f32, mobility: f32) -> f32 {
    let denominator = mobility + compliance;
    if denominator > 0.0 { (-violation - compliance * multiplier) / denominator } else { 0.0 }
}

/// A unit vector perpendicular to `v`, always the same for the same `v`; `v` is not zero.
pub(crate) fn any_perpendicular(v: Vec3) -> Vec3 {
    let size = v.abs();
    let axis = if size.x <= size.y && size.x <= size.z {
        Vec3::X
    } else if size.y <= size.z {
        Vec3::Y
    } else {
        Vec3::Z
    };
    v.cross(axis).unit_or_zero()
}
