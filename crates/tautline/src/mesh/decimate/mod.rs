//! Fewer triangles for nearly the same surface: edges are drawn together to points, the one first that does the least harm
//! (Garland & Heckbert 1997, Surface simplification using quadric error metrics).

mod deviation;
mod patch;
mod quadric;

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::{DVec3, Vec3};

use super::{HalfEdgeMesh, TriMesh};
use crate::error::{Error, all_coordinates};
use crate::norm::Norm;
pub use deviation::surface_deviation;
use patch::Patch;
use quadric::Quadric;

/// A surface of fewer triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Decimated {
    /// As closed as the one it was made of, and connected alike.
    pub mesh: TriMesh,
    /// How far the two are apart, in m: their [`surface_deviation`].
    pub error: f32,
}

/// Draws edges of a surface together until at most `max_triangles` are left, or no edge can go without folding the surface.
/// Vertices on an open edge stay. The same mesh gives the same bits.
///
/// Nothing keeps surfaces apart that pass close by each other: of thin walls ask for enough triangles.
///
/// # Errors
///
/// [`Error::Mesh`] with the first defect that keeps it from being a surface; [`Error::OutOfRange`] names a coordinate that is
/// not from −1e9 to 1e9.
pub fn decimate(mesh: &TriMesh, max_triangles: usize) -> Result<Decimated, Error> {
    all_coordinates("positions", &mesh.positions)?;
    HalfEdgeMesh::from_mesh(mesh)?;
    let mut collapse = Collapse::new(mesh);
    while collapse.patch.triangle_count() > max_triangles {
        let Some(candidate) = collapse.queue.pop() else { break };
        collapse.attempt(&candidate);
    }
    let coarse = collapse.patch.into_mesh();
    let error = surface_deviation(mesh, &coarse);
    Ok(Decimated { mesh: coarse, error })
}

/// An edge that may be drawn together, and where to.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Candidate {
    cost: f64,
    ends: [u32; 2],
    to: Vec3,
    /// How often each end had changed when this was worked out.
    versions: [u32; 2],
}

impl Eq for Candidate {}

impl Ord for Candidate {
    /// The cheapest is the greatest; of equal ones that of the lowest ends.
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then_with(|| other.ends.cmp(&self.ends))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

struct Collapse {
    patch: Patch,
    quadrics: Vec<Quadric>,
    versions: Vec<u32>,
    queue: BinaryHeap<Candidate>,
}

impl Collapse {
    fn new(mesh: &TriMesh) -> Self {
        let mut quadrics = vec![Quadric::default(); mesh.positions.len()];
        for triangle in &mesh.triangles {
            let corners = triangle.map(|v| mesh.positions[v as usize].as_dvec3());
            let quadric = Quadric::of_triangle(corners);
            triangle.iter().for_each(|&v| quadrics[v as usize] += quadric);
        }
        let patch = Patch::new(mesh);
        let versions = vec![0; mesh.positions.len()];
        let mut collapse = Self { patch, quadrics, versions, queue: BinaryHeap::new() };
        for &[a, b, c] in &mesh.triangles {
            // Every edge once, in the direction in which it ascends; open edges do not move.
            for [p, q] in [[a, b], [b, c], [c, a]] {
                if p < q {
                    collapse.propose([p, q]);
                }
            }
        }
        collapse
    }

    fn propose(&mut self, ends: [u32; 2]) {
        if ends.iter().any(|&end| self.patch.is_open(end)) {
            return;
        }
        let quadric = self.quadrics[ends[0] as usize] + self.quadrics[ends[1] as usize];
        let [p, q] = ends.map(|end| self.patch.position(end).as_dvec3());
        let (to, cost) = best_place(&quadric, p, q);
        self.queue.push(Candidate { cost, ends, to, versions: ends.map(|end| self.versions[end as usize]) });
    }

    fn attempt(&mut self, candidate: &Candidate) {
        let [kept, gone] = candidate.ends;
        let is_old = candidate.versions != candidate.ends.map(|end| self.versions[end as usize]);
        if is_old || !self.patch.can_join(candidate.ends, candidate.to) {
            return;
        }
        self.patch.join(candidate.ends, candidate.to);
        let taken = self.quadrics[gone as usize];
        self.quadrics[kept as usize] += taken;
        self.versions[gone as usize] += 1;
        self.versions[kept as usize] += 1;
        for neighbor in self.patch.neighbors(kept) {
            self.propose([kept.min(neighbor), kept.max(neighbor)]);
        }
    }
}

/// Where the squared distances from all planes are least: of the whole space, or else of the ends and the middle.
fn best_place(quadric: &Quadric, p: DVec3, q: DVec3) -> (Vec3, f64) {
    let length = p.distance_to(q);
    let middle = (p + q) / 2.0;
    // In a plane or along a straight edge there are many such places, and rounding would choose one far away.
    let near = |place: &DVec3| place.distance_to(middle) <= 2.0 * length;
    let free = quadric.lowest(middle).filter(near);
    let places = free.map_or([p, q, middle], |place| [place; 3]);
    let costs = places.map(|place| (place.as_vec3(), quadric.at(place.as_vec3().as_dvec3())));
    costs.into_iter().fold(costs[2], |best, other| if other.1 < best.1 { other } else { best })
}
