//! How the mass of a shape is spread, and the frame in which that is simplest. In f64: it is rounded once, by who
//! asks for it.

use glam::{DMat3, DQuat, DVec3, Vec3};
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::mesh::{MassProperties, TriMesh, diagonalize, outer};

/// A solid of density 1, in a frame of its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mass {
    /// In m³.
    pub(super) volume: f64,
    /// In m.
    pub(super) center: DVec3,
    /// ∫ x xᵀ dV about the centre, in m⁵.
    pub(super) second_moments: DMat3,
}

/// A frame within another: where its origin is, in m, and its axes as the columns of a rotation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Frame {
    pub(super) center: DVec3,
    pub(super) axes: DMat3,
}

/// Second moments that differ by less than this part count as equal, and then products of inertia of this size as
/// rounding of the corners. So the axes of regular solids are those they were made with.
const EQUAL: f64 = 1e-6;

impl Mass {
    /// A solid around the origin that is its own mirror image in the planes of the axes; of `second_moments` per
    /// volume, in m².
    pub(super) fn symmetric(volume: f64, second_moments: DVec3) -> Self {
        Self { volume, center: DVec3::ZERO, second_moments: DMat3::from_diagonal(second_moments * volume) }
    }

    pub(super) fn of_mesh(mesh: &TriMesh) -> Result<Self, Error> {
        let MassProperties { volume, center_of_mass: center, second_moments, .. } =
            MassProperties::of(mesh, 1.0)?;
        Ok(Self { volume, center, second_moments })
    }

    /// As seen from a frame in which this one is rotated, then translated.
    pub(super) fn moved(self, rotation: DMat3, translation: DVec3) -> Self {
        Self {
            volume: self.volume,
            center: rotation * self.center + translation,
            second_moments: rotation * self.second_moments * rotation.transpose(),
        }
    }

    /// All together, about their common centre (parallel axes).
    pub(super) fn sum(masses: &[Self]) -> Self {
        let volume: f64 = masses.iter().map(|mass| mass.volume).sum();
        let center = masses.iter().map(|mass| mass.center * mass.volume).sum::<DVec3>() / volume;
        let about_center = |mass: &Self| {
            let offset = mass.center - center;
            mass.second_moments + outer(offset, offset) * mass.volume
        };
        let second_moments = masses.iter().map(about_center).fold(DMat3::ZERO, |sum, part| sum + part);
        Self { volume, center, second_moments }
    }

    /// The principal frame, and the second moments per volume along its axes, in m²: descending, unless equal. Axes
    /// stay as they are, as far as that allows.
    pub(super) fn principal(&self) -> (Frame, DVec3) {
        let mut matrix = self.second_moments;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (pp, qq, pq) = (matrix.col(p)[p], matrix.col(q)[q], matrix.col(q)[p]);
            if (pp - qq).abs() <= EQUAL * pp && pq.abs() <= EQUAL * pp {
                matrix.col_mut(q)[p] = 0.0;
                matrix.col_mut(p)[q] = 0.0;
            }
        }
        let (moments, axes) = diagonalize(matrix);
        let mut order = [0, 1, 2];
        for k in [0, 1, 0] {
            if moments[order[k + 1]] > moments[order[k]] * (1.0 + EQUAL) {
                order.swap(k, k + 1);
            }
        }
        let [x, y, z] = order.map(|k| axes.col(k));
        // An odd permutation would mirror.
        let z = if x.cross(y).dot(z) < 0.0 { -z } else { z };
        let frame = Frame { center: self.center, axes: DMat3::from_cols(x, y, z) };
        (frame, DVec3::from_array(order.map(|k| moments[k])) / self.volume)
    }
}

impl Frame {
    pub(super) const IDENTITY: Self = Self { center: DVec3::ZERO, axes: DMat3::IDENTITY };

    /// From the outer frame to this one, rounded.
    pub(super) fn enter(&self, point: DVec3) -> Vec3 {
        (self.axes.transpose() * (point - self.center)).as_vec3()
    }

    /// From this frame to the outer one.
    pub(super) fn leave(&self, point: Vec3) -> DVec3 {
        self.axes * point.as_dvec3() + self.center
    }

    pub(super) fn rotation(&self) -> DQuat {
        DQuat::from_mat3(&self.axes).normalize()
    }
}
