//! How far two surfaces are apart.

use glam::{DVec3, Vec3};

use crate::geometry::closest::closest_on_triangle;
use crate::mesh::TriMesh;

/// The largest distance from a place on either surface to the other surface, in m: the Hausdorff distance as seen from the
/// vertices, the middles of edges and the middles of triangles of both. 0 if one has no triangles. Indices must be in range.
pub fn surface_deviation(a: &TriMesh, b: &TriMesh) -> f32 {
    if a.triangles.is_empty() || b.triangles.is_empty() {
        return 0.0;
    }
    one_way(a, b).max(one_way(b, a)).sqrt() as f32
}

/// Squared.
fn one_way(from: &TriMesh, to: &TriMesh) -> f64 {
    let triangles: Vec<Target> = to.triangles.iter().map(|t| Target::new(t.map(|v| corner(to, v)))).collect();
    let mut farthest = 0.0_f64;
    // The next place is near the last, and so is what is closest to it.
    let mut last = 0;
    for triangle in &from.triangles {
        for place in places(triangle.map(|v| corner(from, v))) {
            let mut best = triangles[last].distance_squared(place);
            for (i, target) in triangles.iter().enumerate() {
                if target.box_distance_squared(place) < best {
                    let distance = target.distance_squared(place);
                    if distance < best {
                        (best, last) = (distance, i);
                    }
                }
            }
            farthest = farthest.max(best);
        }
    }
    farthest
}

fn corner(mesh: &TriMesh, vertex: u32) -> Vec3 {
    mesh.positions.get(vertex as usize).copied().unwrap_or_default()
}

fn places(corners: [Vec3; 3]) -> [DVec3; 7] {
    let [p, q, r] = corners.map(|corner| corner.as_dvec3());
    [p, q, r, (p + q) / 2.0, (q + r) / 2.0, (r + p) / 2.0, (p + q + r) / 3.0]
}

struct Target {
    corners: [DVec3; 3],
    low: DVec3,
    high: DVec3,
}

impl Target {
    fn new(corners: [Vec3; 3]) -> Self {
        let corners = corners.map(|corner| corner.as_dvec3());
        let [p, q, r] = corners;
        Self { corners, low: p.min(q).min(r), high: p.max(q).max(r) }
    }

    fn box_distance_squared(&self, place: DVec3) -> f64 {
        place.distance_squared(place.clamp(self.low, self.high))
    }

    fn distance_squared(&self, place: DVec3) -> f64 {
        let [s, t, u] = closest_on_triangle(place, self.corners);
        place.distance_squared(self.corners[0] * s + self.corners[1] * t + self.corners[2] * u)
    }
}
