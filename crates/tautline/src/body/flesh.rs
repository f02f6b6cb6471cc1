//! What a soft solid is made of: tetrahedra of an elastic material.

use glam::{DMat3, Mat3};
use serde::{Deserialize, Serialize};

use crate::constraint::Stick;
use crate::error::{Error, MeshDefect};
use crate::mesh::Tetrahedra;

/// A tetrahedron whose volume is less than this share of its longest edge's cube is as good as flat: its neighbours hold
/// its corners.
const FLAT: f64 = 1e-4;

/// The elastic tetrahedra of a body, over its particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Flesh {
    pub(crate) corners: Vec<[u32; 4]>,
    pub(crate) rests: Vec<RestShape>,
    pub(crate) material: Material,
    /// Between corners, once each.
    pub(crate) edges: Vec<Stick>,
}

/// A tetrahedron at rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct RestShape {
    /// The inverse of [X₁ − X₀, X₂ − X₀, X₃ − X₀], in 1/m: row i − 1 is the gradient of the weight of corner i.
    pub(crate) inverse: Mat3,
    /// In m³.
    pub(crate) volume: f32,
}

/// A stable neo-Hookean material (Smith, de Goes and Kim 2018, Stable neo-Hookean flesh simulation), in Pa.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Material {
    /// μ.
    pub(crate) shear: f32,
    /// λ.
    pub(crate) bulk: f32,
}

impl Material {
    /// Which is Hooke's of Young's modulus E (Pa) and Poisson's ratio ν where strains are small: with Lamé's μ' and λ',
    /// μ = 4/3 μ' and λ = λ' + 5/6 μ' (there, section 3.4).
    pub(crate) fn new(young_modulus: f32, poisson_ratio: f32) -> Self {
        let (e, nu) = (young_modulus, poisson_ratio);
        let shear = e / (2.0 * (1.0 + nu));
        let bulk = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        Self { shear: 4.0 / 3.0 * shear, bulk: bulk + 5.0 / 6.0 * shear }
    }

    /// α = 1 + μ/λ − μ/(4λ): of so many times its volume a tetrahedron is at rest if nothing but volume counts.
    pub(crate) fn swelling(&self) -> f32 {
        1.0 + 0.75 * self.shear / self.bulk
    }
}

impl Flesh {
    /// # Errors
    /// [`Error::Mesh`] if a tetrahedron is inside out, or too small or large for its numbers to be normal.
    pub(crate) fn new(solid: &Tetrahedra, material: Material) -> Result<Self, Error> {
        let (mut corners, mut rests) = (Vec::new(), Vec::new());
        for tetrahedron in &solid.tetrahedra {
            let points = tetrahedron.map(|corner| solid.points[corner as usize].as_dvec3());
            let edges = DMat3::from_cols(points[1] - points[0], points[2] - points[0], points[3] - points[0]);
            let volume = edges.determinant() / 6.0;
            let longest = (0..4)
                .flat_map(|i| (0..i).map(move |j| (i, j)))
                .map(|(i, j)| points[i].distance_squared(points[j]))
                .fold(0.0, f64::max);
            if volume < -FLAT * longest * longest.sqrt() {
                return Err(MeshDefect::NotPositiveVolume { volume }.into());
            }
            if volume > FLAT * longest * longest.sqrt() {
                corners.push(*tetrahedron);
                rests.push(RestShape { inverse: edges.inverse().as_mat3(), volume: volume as f32 });
            }
        }
        if rests.is_empty() || !rests.iter().all(RestShape::is_sound) {
            return Err(MeshDefect::Flat { count: solid.points.len() }.into());
        }
        let edges = solid.edges().iter().map(|&[a, b]| Stick::at_rest(a, b, &solid.points)).collect();
        Ok(Self { corners, rests, material, edges })
    }

    /// The volume that belongs to each particle, in m³: a quarter of every tetrahedron around it.
    ///
    /// # Errors
    /// [`Error::Mesh`] if a particle is a corner of none.
    pub(crate) fn shares(&self, count: usize) -> Result<Vec<f32>, Error> {
        let mut shares = vec![0.0; count];
        for (corners, rest) in self.corners.iter().zip(&self.rests) {
            corners.iter().for_each(|&corner| shares[corner as usize] += rest.volume / 4.0);
        }
        match shares.iter().position(|share| *share <= 0.0) {
            Some(particle) => {
                let problem = format!("vertex {particle} is held by flat tetrahedra only, or by none");
                Err(MeshDefect::Tetrahedralisation(problem).into())
            }
            None => Ok(shares),
        }
    }

    pub(crate) fn is_sound(&self, particle_count: usize) -> bool {
        let is_there = |corner: &u32| (*corner as usize) < particle_count;
        let is_apart = |corners: &[u32; 4]| (0..4).all(|i| !corners[..i].contains(&corners[i]));
        let Material { shear, bulk } = self.material;
        self.corners.len() == self.rests.len()
            && self.corners.iter().all(|corners| corners.iter().all(is_there) && is_apart(corners))
            && self.rests.iter().all(RestShape::is_sound)
            && [shear, bulk].iter().all(|modulus| (f32::MIN_POSITIVE..f32::INFINITY).contains(modulus))
            && self.edges.iter().all(|edge| is_there(&edge.a) && is_there(&edge.b) && edge.is_sound())
    }
}

impl RestShape {
    fn is_sound(&self) -> bool {
        self.inverse.is_finite() && self.volume.is_normal() && self.volume > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::lattice;
    use glam::Vec3;

    #[test]
    fn every_particle_of_a_box_gets_its_share_of_the_volume() {
        let solid = lattice(Vec3::new(0.5, 1.0, 1.5), [2, 3, 4]).unwrap();
        let flesh = Flesh::new(&solid, Material::new(1e5, 0.3)).unwrap();
        let shares = flesh.shares(solid.points.len()).unwrap();
        assert!((shares.iter().sum::<f32>() - 6.0).abs() < 1e-5);
        // An inner particle has as much as a cell.
        let center = Vec3::new(0.0, -1.0 / 3.0, 0.0);
        let inner = solid.points.iter().position(|point| point.distance(center) < 1e-6).unwrap();
        assert!((shares[inner] - 0.25).abs() < 1e-6, "{}", shares[inner]);
    }

    #[test]
    fn what_is_inside_out_or_flat_is_refused() {
        let points = vec![Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::Y];
        let solid = |points: &[Vec3], tetrahedron| Tetrahedra {
            points: points.to_vec(),
            tetrahedra: vec![tetrahedron],
            interior_points: 0,
        };
        let made = |solid: &Tetrahedra| Flesh::new(solid, Material::new(1e5, 0.3)).map(|_| ());
        assert!(made(&solid(&points, [0, 2, 1, 3])).is_ok());
        let refusal = made(&solid(&points, [0, 1, 2, 3])).unwrap_err();
        assert!(matches!(refusal, Error::Mesh(MeshDefect::NotPositiveVolume { .. })), "{refusal}");
        let flat = [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::X + Vec3::Z];
        let refusal = made(&solid(&flat, [0, 2, 1, 3])).unwrap_err();
        assert!(matches!(refusal, Error::Mesh(MeshDefect::Flat { .. })), "{refusal}");
    }
}
