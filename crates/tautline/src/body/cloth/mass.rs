//! How heavy a cloth is.

use crate::error::{Error, positive, within};
use crate::mesh::TriMesh;
use crate::norm::Norm;

/// The mass of a cloth, as it was given.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Mass {
    /// In kg, in equal shares.
    Whole(f32),
    /// Of every particle, in kg.
    Each(Vec<f32>),
    /// In kg/m².
    PerArea(f32),
}

impl Mass {
    pub(super) fn validate(&self) -> Result<(), Error> {
        match self {
            Self::Whole(mass) => positive("mass", *mass).map(|_| ()),
            Self::PerArea(density) => positive("density", *density).map(|_| ()),
            Self::Each(_) => Ok(()),
        }
    }

    /// Those of the particles, unless they are equal shares.
    pub(super) fn of_particles(&self, mesh: &TriMesh) -> Result<Option<Vec<f32>>, Error> {
        let masses = match self {
            Self::Whole(_) => return Ok(None),
            Self::Each(masses) => masses.clone(),
            Self::PerArea(density) => shares(mesh, *density),
        };
        let field = if let Self::Each(_) = self { "masses" } else { "density" };
        if masses.len() != mesh.positions.len() {
            let problem = format!("are {}, and there are {} particles", masses.len(), mesh.positions.len());
            return Err(Error::Invalid { field: field.into(), problem });
        }
        for (number, &mass) in masses.iter().enumerate() {
            let field = format!("{field}[{number}]");
            within(&field, mass, 1e-30, 1e30, "a mass of 1e-30 to 1e30 kg for each particle")?;
        }
        Ok(Some(masses))
    }
}

/// A third of every triangle for each of its corners.
fn shares(mesh: &TriMesh, density: f32) -> Vec<f32> {
    let mut masses = vec![0.0; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
        let share = (b - a).cross(c - a).norm() / 6.0 * density;
        triangle.iter().for_each(|&corner| masses[corner as usize] += share);
    }
    masses
}
