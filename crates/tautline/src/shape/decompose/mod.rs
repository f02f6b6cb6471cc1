//! Approximate convex decomposition: a concave solid as few convex parts.
//!
//! The solid is filled with tetrahedra and cut by planes, the most concave piece first, where that leaves the least
//! concavity (Lien & Amato 2007, Approximate convex decomposition of polyhedra; concavity is measured as in Mamou's
//! V-HACD, by the volume that a piece's hull adds). Planes are taken along the solid's concave edges. At last,
//! pieces are joined again where that costs little.

mod carve;
mod join;
mod piece;

use glam::Vec3;

use crate::error::{Error, within};
use crate::mesh::{TriMesh, convex_hull};
use carve::Carving;
use join::join;
use piece::{excess, inside};

/// The least tolerance, as a share of the volume: less is rounding.
const LEAST_TOLERANCE: f64 = 1e-5;

/// How closely convex parts have to follow a concave solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decomposition {
    max_parts: u32,
    tolerance: f32,
    max_corners: Option<u32>,
}

impl Default for Decomposition {
    /// At most 32 parts, that together fill at most 2 % more than the solid, with all corners that their hulls have.
    fn default() -> Self {
        Self { max_parts: 32, tolerance: 0.02, max_corners: None }
    }
}

impl Decomposition {
    /// Most parts (1 – 1024), even if they then stick out by more than the tolerance.
    pub fn max_parts(self, max_parts: u32) -> Self {
        Self { max_parts, ..self }
    }

    /// The volume by which the parts may exceed the solid, as a share of its volume (0 – 1). Less takes more parts.
    pub fn tolerance(self, tolerance: f32) -> Self {
        Self { tolerance, ..self }
    }

    /// Most corners of a part (4 – 65 535), for contacts that cost less. Each part becomes the hull of so many of its
    /// corners, the farthest first, and [`Shape::hull_shortfall`](super::Shape::hull_shortfall) says how much is lost.
    pub fn max_corners(self, max_corners: u32) -> Self {
        Self { max_corners: Some(max_corners), ..self }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        let refusal = |field: &str, value: u32, expected| {
            Err(Error::OutOfRange { field: field.into(), value: value.into(), expected })
        };
        if !(1..=1024).contains(&self.max_parts) {
            return refusal("max_parts", self.max_parts, "a count from 1 to 1024");
        }
        if let Some(corners) = self.max_corners.filter(|corners| !(4..=65_535).contains(corners)) {
            return refusal("max_corners", corners, "a count from 4 to 65 535");
        }
        within("tolerance", self.tolerance, 0.0, 1.0, "a number from 0 to 1").map(|_| ())
    }

    /// Convex parts for the inside of a closed mesh.
    pub(super) fn apply(&self, mesh: &TriMesh, hull: &TriMesh) -> Result<Parts, Error> {
        let mut parts = self.cover(mesh, hull)?;
        if let Some(max_corners) = self.max_corners {
            for corners in parts.corners.iter_mut().filter(|corners| corners.len() > max_corners as usize) {
                let coarse = convex_hull(corners)?.coarsened(max_corners as usize, 0.0)?;
                *corners = coarse.hull.mesh.positions;
                parts.shortfall = parts.shortfall.max(coarse.error);
            }
        }
        Ok(parts)
    }

    /// Parts that together cover all of the inside.
    fn cover(&self, mesh: &TriMesh, hull: &TriMesh) -> Result<Parts, Error> {
        let volume = inside(mesh);
        let allowed = f64::from(self.tolerance).max(LEAST_TOLERANCE) * volume;
        let concavity = inside(hull) - volume;
        if concavity <= allowed || self.max_parts == 1 {
            let corners = vec![hull.positions.clone()];
            return Ok(Parts { corners, excess: concavity.max(0.0) / volume, shortfall: 0.0 });
        }
        let max_parts = self.max_parts as usize;
        let pieces = Carving::new(mesh)?.divide(max_parts, allowed)?;
        let pieces = join(pieces, max_parts, allowed)?;
        let excess = excess(&pieces) / volume;
        let corners = pieces.into_iter().map(|piece| piece.corners).collect();
        Ok(Parts { corners, excess, shortfall: 0.0 })
    }
}

/// Convex parts of a solid.
pub(super) struct Parts {
    /// Of each part, in m.
    pub(super) corners: Vec<Vec<Vec3>>,
    /// The volume by which the parts, with all their corners, exceed the solid, as a share of it.
    pub(super) excess: f64,
    /// How far the solid may stick out of them, since corners were left out, in m.
    pub(super) shortfall: f32,
}

#[cfg(test)]
mod tests {
    use super::piece::bounds;
    use super::*;
    use crate::mesh::primitives;

    /// A prism from y = 0 to 1 over a polygon of the XZ plane, counter-clockwise seen from above, and its triangles.
    fn prism(outline: &[[f32; 2]], ears: &[[u32; 3]]) -> TriMesh {
        let count = outline.len() as u32;
        let at = |y: f32| outline.iter().map(move |&[x, z]| Vec3::new(x, y, z));
        let ends = ears.iter().flat_map(|&[a, b, c]| [[a, c, b], [a + count, b + count, c + count]]);
        let side = |a: u32| {
            let b = (a + 1) % count;
            [[a, b, b + count], [a, b + count, a + count]]
        };
        let triangles = ends.chain((0..count).flat_map(side)).collect();
        TriMesh { positions: at(0.0).chain(at(1.0)).collect(), triangles }
    }

    fn l_shape() -> TriMesh {
        let outline = [[1.0, 1.0], [3.0, 1.0], [3.0, 0.0], [0.0, 0.0], [0.0, 3.0], [1.0, 3.0]];
        prism(&outline, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
    }

    fn u_shape() -> TriMesh {
        let outline =
            [[0.0, 0.0], [0.0, 3.0], [1.0, 3.0], [1.0, 1.0], [2.0, 1.0], [2.0, 3.0], [3.0, 3.0], [3.0, 0.0]];
        prism(&outline, &[[0, 1, 3], [1, 2, 3], [0, 3, 7], [3, 4, 7], [4, 6, 7], [4, 5, 6]])
    }

    fn star(tips: u32) -> TriMesh {
        let corner = |k: u32| {
            let angle = std::f64::consts::PI * f64::from(k) / f64::from(tips);
            let radius = if k.is_multiple_of(2) { 1.0 } else { 0.4 };
            [(radius * angle.sin()) as f32, (radius * angle.cos()) as f32]
        };
        let outline: Vec<[f32; 2]> = (0..2 * tips).map(corner).collect();
        let tip = |k: u32| [(2 * k + 2 * tips - 1) % (2 * tips), 2 * k, 2 * k + 1];
        let middle = (1..tips - 1).map(|k| [1, 2 * k + 1, 2 * k + 3]);
        let ears: Vec<[u32; 3]> = (0..tips).map(tip).chain(middle).collect();
        prism(&outline, &ears)
    }

    /// A sphere whose top is pushed in.
    fn bowl() -> TriMesh {
        let mut mesh = primitives::icosphere(1.0, 2).unwrap();
        for point in &mut mesh.positions {
            point.y = point.y.min(0.5 - point.y);
        }
        mesh
    }

    /// A cylinder with a round hole from above: the capsule's mesh, the upper half ball of which goes inside.
    fn cup() -> TriMesh {
        let mut mesh = primitives::cylinder(1.0, 1.0, 24).unwrap();
        let (rim, axis) = (25, 49);
        // Two circles more: down the inside.
        mesh.triangles.retain(|triangle| !triangle.contains(&axis));
        mesh.positions[axis as usize].y = -0.8;
        for k in 0..24 {
            let outer = mesh.positions[rim + k];
            mesh.positions.push(Vec3::new(outer.x * 0.8, 1.0, outer.z * 0.8));
        }
        for k in 0..24 {
            let outer = mesh.positions[rim + k];
            mesh.positions.push(Vec3::new(outer.x * 0.7, -0.8, outer.z * 0.7));
        }
        let rings = [rim as u32, 50, 74];
        for k in 0..24 {
            let next = (k + 1) % 24;
            for pair in rings.windows(2) {
                let [a, b, c, d] = [pair[0] + k, pair[0] + next, pair[1] + next, pair[1] + k];
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
            mesh.triangles.push([74 + k, 74 + next, axis]);
        }
        mesh
    }

    /// Solid angle of the surface as seen from a point (Van Oosterom & Strackee 1983), in f64.
    fn is_inside(point: Vec3, mesh: &TriMesh) -> bool {
        let angle = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|v| (mesh.positions[v as usize] - point).as_dvec3());
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * a.dot(b.cross(c)).atan2(below)
        };
        mesh.triangles.iter().map(angle).sum::<f64>() > std::f64::consts::TAU
    }

    fn is_within(point: Vec3, hull: &TriMesh, margin: f64) -> bool {
        hull.triangles.iter().all(|triangle| {
            let [a, b, c] = triangle.map(|v| hull.positions[v as usize].as_dvec3());
            (b - a).cross(c - a).normalize().dot(point.as_dvec3() - a) <= margin
        })
    }

    /// Decomposes, checks against samples all over its box, and returns the number of parts and the excess.
    fn check(mesh: &TriMesh, decomposition: Decomposition) -> (usize, f64) {
        let hull = convex_hull(&mesh.positions).unwrap().mesh;
        let Parts { corners, excess, .. } = decomposition.apply(mesh, &hull).unwrap();
        let parts: Vec<TriMesh> = corners.iter().map(|corners| convex_hull(corners).unwrap().mesh).collect();
        let total: f64 = parts.iter().map(inside).sum();
        assert!((total / inside(mesh) - 1.0 - excess).abs() < 1e-5, "{total} {excess}");
        let (low, high) = bounds(&mesh.positions);
        let (mut solid, mut outside) = (0, 0);
        for k in 0..16_u32.pow(3) {
            let place = [k % 16, k / 16 % 16, k / 256].map(|c| (c as f32 + 0.437) / 16.0);
            let point = low + (high - low) * Vec3::from(place);
            let covered = parts.iter().any(|part| is_within(point, part, 1e-5));
            if is_inside(point, mesh) {
                solid += 1;
                assert!(covered, "{point}");
            } else if covered {
                outside += 1;
            }
        }
        assert!(
            f64::from(outside) <= (1.15 * excess + 0.03) * f64::from(solid),
            "{outside} of {solid}, {excess}"
        );
        (parts.len(), excess)
    }

    #[test]
    fn blocks_come_apart_at_their_inner_corners() {
        for (mesh, count) in [(l_shape(), 2), (u_shape(), 3)] {
            let (parts, excess) = check(&mesh, Decomposition::default().tolerance(0.0));
            assert_eq!(parts, count);
            assert!(excess < 1e-6);
        }
    }

    #[test]
    fn concave_solids_are_followed_within_the_tolerance() {
        let torus = primitives::torus(1.0, 0.3, 32, 16).unwrap();
        for (mesh, most) in [(star(5), 6), (star(9), 10), (torus, 20), (cup(), 24)] {
            let (parts, excess) = check(&mesh, Decomposition::default());
            assert!(parts <= most && excess <= 0.02, "{parts} parts, {excess}");
        }
        let (parts, excess) = check(&bowl(), Decomposition::default());
        assert!(parts == 32 && excess < 0.1, "{parts} parts, {excess}: no more are allowed");
    }

    #[test]
    fn few_parts_are_kept_few() {
        let mut last = f64::INFINITY;
        for most in [1, 2, 5, 12] {
            let (parts, excess) = check(&star(7), Decomposition::default().max_parts(most).tolerance(0.001));
            assert!(parts <= most as usize && excess < last);
            last = excess;
        }
    }

    #[test]
    fn what_is_convex_stays_whole() {
        let cube = primitives::cube(1.0).unwrap();
        assert_eq!(check(&cube, Decomposition::default().tolerance(0.0)), (1, 0.0));
    }
}
