//! The simplex that GJK carries: up to four vertices of the configuration space obstacle (CSO) A ⊖ B, and the
//! point of their hull closest to the origin.

use glam::DVec3;

use super::closest::{closest_on_segment, closest_on_triangle};
use super::support::Support;

/// A tetrahedron lower than this part of its size is flat: it cannot be said to enclose the origin.
const FLAT: f64 = 1e-14;

/// A vertex of A ⊖ B, and the two points that it is the difference of.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CsoVertex {
    /// Index of the point of A.
    pub a: u32,
    /// Index of the point of B.
    pub b: u32,
    /// Their difference, point of A minus point of B, in m.
    pub point: DVec3,
}

impl CsoVertex {
    /// The vertex of A ⊖ B farthest along `direction`.
    #[inline]
    pub fn support(a: &impl Support, b: &impl Support, direction: DVec3) -> Self {
        let (i, j) = (a.support(direction), b.support(-direction));
        Self { a: i, b: j, point: a.point(i) - b.point(j) }
    }

    #[inline]
    pub(crate) fn is_same_pair(&self, other: &Self) -> bool {
        self.a == other.a && self.b == other.b
    }
}

/// Up to four vertices of A ⊖ B. From GJK, the weights are the barycentric coordinates of the
/// point of their hull closest to the origin, all above zero.
#[derive(Debug, Clone, Copy, Default)]
pub struct Simplex {
    vertices: [CsoVertex; 4],
    weights: [f64; 4],
    count: usize,
}

impl Simplex {
    /// The vertices, oldest first.
    pub fn vertices(&self) -> &[CsoVertex] {
        &self.vertices[..self.count]
    }

    /// The barycentric weights, one for each vertex. They mean nothing where the origin is enclosed.
    pub fn weights(&self) -> &[f64] {
        &self.weights[..self.count]
    }

    /// The first three vertices and their weights; where there are fewer, the last is repeated with weight 0.
    pub(crate) fn triangle(&self) -> ([CsoVertex; 3], [f64; 3]) {
        let last = self.count.saturating_sub(1);
        let vertices = [0, 1, 2].map(|i| self.vertices[last.min(i)]);
        (vertices, [0, 1, 2].map(|i| if i < self.count { self.weights[i] } else { 0.0 }))
    }

    /// Adds a vertex. A simplex of four is full and stays as it is; GJK reduces it first.
    pub(crate) fn push(&mut self, vertex: CsoVertex) {
        if let Some(slot) = self.vertices.get_mut(self.count) {
            *slot = vertex;
            self.count += 1;
        }
    }

    pub(crate) fn contains(&self, vertex: &CsoVertex) -> bool {
        self.vertices().iter().any(|v| v.is_same_pair(vertex))
    }

    /// Drops the vertices that the closest point to the origin does not need, and returns that point, or `None`
    /// if four vertices enclose the origin (all four are kept then).
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(crate) fn reduce(&mut self) -> Option<DVec3> {
        let [p, q, r, _] = self.vertices.map(|v| v.point);
        let weights = match self.count {
            2 => {
                let [s, t] = closest_on_segment(DVec3::ZERO, [p, q]);
                [s, t, 0.0, 0.0]
            }
            3 => spread(closest_on_triangle(DVec3::ZERO, [p, q, r]), [0, 1, 2]),
            4 => self.closest_on_tetrahedron()?,
            _ => [1.0, 0.0, 0.0, 0.0],
        };
        self.keep(weights);
        Some(self.closest_point())
    }

    /// The closest of the faces that have the origin on their outer side; of a flat tetrahedron, of all faces.
    fn closest_on_tetrahedron(&self) -> Option<[f64; 4]> {
        const FACES: [([usize; 3], usize); 4] =
            [([0, 1, 3], 2), ([1, 2, 3], 0), ([2, 0, 3], 1), ([0, 2, 1], 3)];
        let points = self.vertices.map(|v| v.point);
        let mut best = None;
        let mut best_squared = f64::INFINITY;
        for (face, opposite) in FACES {
            let corners = face.map(|i| points[i]);
            if !is_beyond(corners, points[opposite]) {
                continue;
            }
            let weights = closest_on_triangle(DVec3::ZERO, corners);
            let point = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
            if point.length_squared() < best_squared {
                best_squared = point.length_squared();
                best = Some(spread(weights, face));
            }
        }
        best
    }

    fn keep(&mut self, weights: [f64; 4]) {
        let mut kept = 0;
        for (i, &weight) in weights.iter().enumerate().take(self.count) {
            if weight > 0.0 {
                self.vertices[kept] = self.vertices[i];
                self.weights[kept] = weight;
                kept += 1;
            }
        }
        self.count = kept;
    }

    /// The weighted sum of the vertices, in m: after `reduce`, the point closest to the origin.
    pub(crate) fn closest_point(&self) -> DVec3 {
        let [p, q, r, _] = self.vertices.map(|v| v.point);
        if self.count == 3 {
            // The same point as the weighted sum, but at right angles to the face where that is near zero.
            let normal = (q - p).cross(r - p);
            return normal * (normal.dot(p) / normal.length_squared());
        }
        self.vertices().iter().zip(self.weights()).map(|(v, &weight)| v.point * weight).sum()
    }
}

/// Whether the origin lies strictly on the other side of the face than the opposite corner, or the four corners
/// are so flat that there are no sides.
#[inline]
fn is_beyond(corners: [DVec3; 3], opposite: DVec3) -> bool {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let height = normal.dot(opposite - corners[0]);
    let origin = -normal.dot(corners[0]);
    let size_squared = (opposite - corners[0]).length_squared();
    let is_flat = height * height <= FLAT * FLAT * normal.length_squared() * size_squared;
    is_flat || (origin < 0.0) != (height < 0.0) && origin != 0.0
}

fn spread(weights: [f64; 3], places: [usize; 3]) -> [f64; 4] {
    let mut all = [0.0; 4];
    for (weight, place) in weights.into_iter().zip(places) {
        all[place] = weight;
    }
    all
}
