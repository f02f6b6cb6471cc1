//! The simplex of the f32 walk: up to four vertices of B ⊖ A, and the point of their hull closest to the origin.

use glam::Vec3;

/// A vertex of B ⊖ A, and the corners that it is the difference of.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Vertex {
    /// Indices of the corners of A and of B.
    pub(super) pair: [u16; 2],
    /// Corner of B minus corner of A, shifted, in m.
    pub(super) point: Vec3,
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Simplex {
    pub(super) vertices: [Vertex; 4],
    /// Barycentric, of the closest point, once reduced.
    pub(super) weights: [f32; 4],
    pub(super) count: usize,
}

impl Simplex {
    /// Adds a vertex to at most three.
    #[inline(always)]
    pub(super) fn push(&mut self, vertex: Vertex) {
        self.vertices[self.count] = vertex;
        self.count += 1;
    }

    #[inline(always)]
    pub(super) fn contains(&self, pair: [u16; 2]) -> bool {
        self.vertices[..self.count].iter().any(|vertex| vertex.pair == pair)
    }

    /// Drops the vertices that the closest point to the origin does not need, and returns that point; `None` if
    /// the origin is enclosed.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn reduce(&mut self) -> Option<Vec3> {
        let [p, q, r, _] = self.vertices.map(|vertex| vertex.point);
        let (closest, weights) = match self.count {
            1 => (p, [1.0, 0.0, 0.0, 0.0]),
            2 => {
                let (closest, [s, t]) = closest_on_segment(p, q);
                (closest, [s, t, 0.0, 0.0])
            }
            3 => {
                let (closest, [s, t, u]) = closest_on_triangle(p, q, r);
                (closest, [s, t, u, 0.0])
            }
            _ => self.closest_on_tetrahedron()?,
        };
        let mut kept = 0;
        for (i, &weight) in weights.iter().enumerate().take(self.count) {
            if weight > 0.0 {
                self.vertices[kept] = self.vertices[i];
                self.weights[kept] = weight;
                kept += 1;
            }
        }
        self.count = kept;
        Some(closest)
    }

    /// Of the faces at the newest vertex that have the origin on their outer side (the face of the other three was
    /// where the walk came from). A flat tetrahedron has both sides outside.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn closest_on_tetrahedron(&self) -> Option<(Vec3, [f32; 4])> {
        let points = self.vertices.map(|vertex| vertex.point);
        let mut best = None;
        let mut least_squared = f32::INFINITY;
        for [i, j, opposite] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            let (a, b, c) = (points[i], points[j], points[3]);
            let normal = (b - a).cross(c - a);
            if -normal.dot(a) * normal.dot(points[opposite] - a) > 0.0 {
                continue;
            }
            let (closest, [s, t, u]) = closest_on_triangle(a, b, c);
            if closest.length_squared() < least_squared {
                least_squared = closest.length_squared();
                let mut weights = [0.0; 4];
                (weights[i], weights[j], weights[3]) = (s, t, u);
                best = Some((closest, weights));
            }
        }
        best
    }
}

/// The point closest to the origin, and its weights.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn closest_on_segment(a: Vec3, b: Vec3) -> (Vec3, [f32; 2]) {
    let along = b - a;
    let (part, length_squared) = (-a.dot(along), along.length_squared());
    if part <= 0.0 {
        (a, [1.0, 0.0])
    } else if part >= length_squared {
        (b, [0.0, 1.0])
    } else {
        let t = part / length_squared;
        (a + along * t, [1.0 - t, t])
    }
}

/// The point closest to the origin, and its weights (Ericson, Real-Time Collision Detection, 5.1.5).
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn closest_on_triangle(a: Vec3, b: Vec3, c: Vec3) -> (Vec3, [f32; 3]) {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (-ab.dot(a), -ac.dot(a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, [1.0, 0.0, 0.0]);
    }
    let (d3, d4) = (-ab.dot(b), -ac.dot(b));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, [0.0, 1.0, 0.0]);
    }
    let (d5, d6) = (-ab.dot(c), -ac.dot(c));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, [0.0, 0.0, 1.0]);
    }
    let weight_c = d1 * d4 - d3 * d2;
    if weight_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return (a + ab * t, [1.0 - t, t, 0.0]);
    }
    let weight_b = d5 * d2 - d1 * d6;
    if weight_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return (a + ac * t, [1.0 - t, 0.0, t]);
    }
    let weight_a = d3 * d6 - d5 * d4;
    if weight_a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (b + (c - b) * t, [0.0, 1.0 - t, t]);
    }
    // The foot on the plane is the weighted sum, but at right angles to the triangle also where it is near.
    let normal = ab.cross(ac);
    let foot = normal * (normal.dot(a) / normal.length_squared());
    let total = weight_a + weight_b + weight_c;
    (foot, [weight_a / total, weight_b / total, weight_c / total])
}
