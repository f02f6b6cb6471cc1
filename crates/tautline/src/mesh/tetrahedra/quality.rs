//! What the tetrahedra are used and judged by: their edges, volume, shape and validity.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Tetrahedra;
use super::predicates::{Face, canonical, face_of, faces_of, orient, reversed};
use crate::mesh::TriMesh;

impl Tetrahedra {
    /// Every edge once, lower index first, in increasing order.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        let ends = |tet: &[u32; 4]| PAIRS.map(|[i, j]| [tet[i].min(tet[j]), tet[i].max(tet[j])]);
        let mut edges: Vec<[u32; 2]> = self.tetrahedra.iter().flat_map(ends).collect();
        edges.sort_unstable();
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
        let angle = |tet: &[u32; 4]| {
            let normals = [0, 1, 2, 3].map(|i| {
                let [a, b, c] = face_of(tet, i).map(|v| self.points[v as usize].as_dvec3());
                (b - a).cross(c - a).normalize_or_zero()
            });
            let pairs = (0..4).flat_map(|i| (0..i).map(move |j| (i, j)));
            // Outward normals: the dihedral angle is what they lack to a half turn.
            let cosine = pairs.map(|(i, j)| -normals[i].dot(normals[j])).fold(-1.0, f64::max);
            libm::acos(cosine.min(1.0))
        };
        self.tetrahedra.iter().map(angle).fold(f64::INFINITY, f64::min)
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
        boundary.sort_unstable();
        surface.sort_unstable();
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
