//! What the tetrahedra are used and judged by: their edges, volume, shape and validity.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Tetrahedra;
use super::predicates::{Face, canonical, face_of, faces_of, orient, reversed};
use crate::mesh::TriMesh;
use crate::norm::Norm;
use crate::order::PutInOrder;

/// Figures of how well shaped tetrahedra are: what is thin is badly conditioned, and stiffer or softer than it should be.
/// Without any tetrahedra the means and the worst are not finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TetrahedraQuality {
    /// The smallest angle between two faces, in radians: about 1.23 in a regular tetrahedron, 0 in a flat one.
    pub min_dihedral_angle: f64,
    /// The largest, in radians: about 1.23 in a regular tetrahedron, π in a flat one.
    pub max_dihedral_angle: f64,
    /// 12 (3 V)^⅔ / Σ l² over the six edges (Liu & Joe 1994, Relationship between tetrahedron shape measures: the mean
    /// ratio): 1 of a regular tetrahedron, 0 of a flat one. The smallest of all.
    pub worst_roundness: f64,
    /// Its mean.
    pub mean_roundness: f64,
}

impl Tetrahedra {
    /// Every edge once, lower index first, in increasing order.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        let ends = |tet: &[u32; 4]| PAIRS.map(|[i, j]| [tet[i].min(tet[j]), tet[i].max(tet[j])]);
        let mut edges: Vec<[u32; 2]> = self.tetrahedra.iter().flat_map(ends).collect();
        edges.put_in_order();
        edges.dedup();
        edges
    }

    /// The volume of all tetrahedra, in m³.
    pub fn volume(&self) -> f64 {
        let corners = self.tetrahedra.iter().map(|tet| self.corners(tet));
        corners.map(|[a, b, c, d]| (b - a).cross(c - a).dot(d - a) / 6.0).sum()
    }

    /// The smallest angle between two faces of any tetrahedron, in radians: about 1.23 in a regular one,
    /// 0 in a flat one.
    pub fn min_dihedral_angle(&self) -> f64 {
        self.quality().min_dihedral_angle
    }

    /// How well shaped the tetrahedra are.
    pub fn quality(&self) -> TetrahedraQuality {
        let (mut cosines, mut worst, mut sum) = ([1.0_f64, -1.0_f64], f64::INFINITY, 0.0);
        for tet in &self.tetrahedra {
            for cosine in self.dihedral_cosines(tet) {
                cosines = [cosines[0].min(cosine), cosines[1].max(cosine)];
            }
            let roundness = roundness(self.corners(tet));
            worst = worst.min(roundness);
            sum += roundness;
        }
        TetrahedraQuality {
            min_dihedral_angle: libm::acos(cosines[1].clamp(-1.0, 1.0)),
            max_dihedral_angle: libm::acos(cosines[0].clamp(-1.0, 1.0)),
            worst_roundness: worst,
            mean_roundness: sum / self.tetrahedra.len() as f64,
        }
    }

    /// Of the angles between any two faces.
    fn dihedral_cosines(&self, tet: &[u32; 4]) -> impl Iterator<Item = f64> {
        let normals = [0, 1, 2, 3].map(|i| {
            let [a, b, c] = face_of(tet, i).map(|v| self.points[v as usize].as_dvec3());
            (b - a).cross(c - a).unit_or_zero()
        });
        // Outward normals: the dihedral angle is what they lack to a half turn.
        (0..4)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(move |(i, j): (usize, usize)| -normals[i].dot(normals[j]))
    }

    /// Whether this divides the inside of `mesh`: all tetrahedra positive, faces shared by at most two,
    /// the unshared ones exactly the mesh's triangles, and the volumes adding up. Says what is wrong.
    ///
    /// # Errors
    ///
    /// The first fault, in words.
    pub fn validate(&self, mesh: &TriMesh) -> Result<(), String> {
        if self.points.len() != mesh.positions.len() + self.interior_points
            || self.points[..mesh.positions.len()] != mesh.positions[..]
        {
            return Err("the points do not start with the mesh's vertices".into());
        }
        let points: Vec<DVec3> = self.points.iter().map(|p| p.as_dvec3()).collect();
        let mut owners: BTreeMap<Face, usize> = BTreeMap::new();
        for (t, tet) in self.tetrahedra.iter().enumerate() {
            if orient(&points, [tet[0], tet[1], tet[2]], tet[3]) <= 0.0 {
                return Err(format!("tetrahedron {t} is flat or inverted"));
            }
            for face in faces_of(tet) {
                if let Some(other) = owners.insert(face, t) {
                    return Err(format!("tetrahedra {other} and {t} overlap at face {face:?}"));
                }
            }
        }
        let mut boundary: Vec<Face> =
            owners.keys().copied().filter(|f| !owners.contains_key(&reversed(*f))).collect();
        let mut surface: Vec<Face> = mesh.triangles.iter().map(|&t| canonical(t)).collect();
        boundary.put_in_order();
        surface.put_in_order();
        if boundary != surface {
            let stray = boundary.iter().find(|f| surface.binary_search(f).is_err());
            let lost = surface.iter().find(|f| boundary.binary_search(f).is_err());
            return Err(format!(
                "the boundary is not the mesh: stray face {stray:?}, missing triangle {lost:?}"
            ));
        }
        self.check_volume(mesh)
    }

    fn check_volume(&self, mesh: &TriMesh) -> Result<(), String> {
        let origin = mesh.positions.first().map(|p| p.as_dvec3()).unwrap_or_default();
        let corners =
            mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize].as_dvec3() - origin));
        let expected: f64 = corners.map(|[a, b, c]| a.cross(b).dot(c) / 6.0).sum();
        let volume = self.volume();
        if (volume - expected).abs() <= 1e-9 * expected.abs() {
            Ok(())
        } else {
            Err(format!("the tetrahedra's volume is {volume} m³, the mesh's {expected} m³"))
        }
    }

    fn corners(&self, tet: &[u32; 4]) -> [DVec3; 4] {
        tet.map(|v| self.points[v as usize].as_dvec3())
    }
}

fn roundness([a, b, c, d]: [DVec3; 4]) -> f64 {
    let volume = (b - a).cross(c - a).dot(d - a) / 6.0;
    let edges = [b - a, c - a, d - a, c - b, d - b, d - c];
    let squares: f64 = edges.iter().map(|edge| edge.length_squared()).sum();
    let root = libm::cbrt(3.0 * volume.max(0.0));
    12.0 * root * root / squares
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn a_regular_tetrahedron_is_as_round_as_can_be_and_a_corner_of_a_cube_less() {
        let solid = |points: [Vec3; 4]| Tetrahedra {
            points: points.to_vec(),
            tetrahedra: vec![[0, 1, 2, 3]],
            interior_points: 0,
        };
        let alternate = [[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]];
        let regular = solid(alternate.map(Vec3::from)).quality();
        assert!(
            (regular.worst_roundness - 1.0).abs() < 1e-12
                && regular.mean_roundness == regular.worst_roundness
        );
        let angle = libm::acos(1.0 / 3.0);
        assert!((regular.min_dihedral_angle - angle).abs() < 1e-12);
        assert!((regular.max_dihedral_angle - angle).abs() < 1e-12);
        let corner = solid([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z]).quality();
        // V = 1/6, Σ l² = 3 + 6.
        assert!((corner.worst_roundness - 12.0 * 0.25_f64.cbrt() / 9.0).abs() < 1e-12);
        assert!((corner.max_dihedral_angle - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
}
