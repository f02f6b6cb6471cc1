//! A surface whose edges are drawn together.

use glam::Vec3;

use crate::mesh::TriMesh;
use crate::norm::Norm;

/// The least cosine between the normals of a triangle before and after.
const LEAST_TURN: f64 = 0.3;
/// The least area of a triangle, as a share of its longest side squared: of one with equal sides it is 0.43.
const THINNEST: f64 = 0.02;

/// Triangles, and which are around each vertex.
pub(super) struct Patch {
    positions: Vec<Vec3>,
    /// `None` where one has gone.
    triangles: Vec<Option<[u32; 3]>>,
    around: Vec<Vec<u32>>,
    is_open: Vec<bool>,
    count: usize,
}

impl Patch {
    pub(super) fn new(mesh: &TriMesh) -> Self {
        let mut around = vec![Vec::new(); mesh.positions.len()];
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            triangle.iter().for_each(|&v| around[v as usize].push(t as u32));
        }
        let triangles = mesh.triangles.iter().copied().map(Some).collect();
        let count = mesh.triangles.len();
        let mut patch =
            Self { positions: mesh.positions.clone(), triangles, around, is_open: Vec::new(), count };
        // Around a vertex inside the surface there are as many neighbours as triangles, on its edge one more.
        let is_open = |v: u32| patch.neighbors(v).len() != patch.around[v as usize].len();
        patch.is_open = (0..mesh.positions.len() as u32).map(is_open).collect();
        patch
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.count
    }

    pub(super) fn position(&self, vertex: u32) -> Vec3 {
        self.positions[vertex as usize]
    }

    pub(super) fn is_open(&self, vertex: u32) -> bool {
        self.is_open[vertex as usize]
    }

    /// Ascending.
    pub(super) fn neighbors(&self, vertex: u32) -> Vec<u32> {
        let corners = self.around(vertex).flat_map(|(_, corners)| corners);
        let mut neighbors: Vec<u32> = corners.filter(|&corner| corner != vertex).collect();
        neighbors.sort_unstable();
        neighbors.dedup();
        neighbors
    }

    fn around(&self, vertex: u32) -> impl Iterator<Item = (u32, [u32; 3])> {
        self.around[vertex as usize].iter().filter_map(|&t| Some((t, self.triangles[t as usize]?)))
    }

    /// Whether the surface stays one if both ends become one vertex there: they share the neighbours across their two
    /// triangles and no others (the link condition), and no triangle turns over or becomes a needle.
    pub(super) fn can_join(&self, ends: [u32; 2], to: Vec3) -> bool {
        let [own, other] = ends.map(|end| self.neighbors(end));
        let shared = own.iter().filter(|&v| other.binary_search(v).is_ok()).count();
        shared == 2 && ends.iter().all(|&end| self.keeps_shape(end, ends, to))
    }

    fn keeps_shape(&self, end: u32, ends: [u32; 2], to: Vec3) -> bool {
        let staying = self.around(end).map(|(_, corners)| corners);
        let mut staying = staying.filter(|corners| !ends.iter().all(|end| corners.contains(end)));
        staying.all(|corners| {
            let before = corners.map(|v| self.position(v));
            let after = corners.map(|v| if v == end { to } else { self.position(v) });
            is_like(before, after)
        })
    }

    /// Both ends become the first one.
    pub(super) fn join(&mut self, [kept, gone]: [u32; 2], to: Vec3) {
        self.positions[kept as usize] = to;
        for t in std::mem::take(&mut self.around[gone as usize]) {
            let Some(corners) = &mut self.triangles[t as usize] else { continue };
            if corners.contains(&kept) {
                self.triangles[t as usize] = None;
                self.count -= 1;
            } else {
                corners.iter_mut().filter(|v| **v == gone).for_each(|v| *v = kept);
                self.around[kept as usize].push(t);
            }
        }
        self.around[kept as usize].retain(|&t| self.triangles[t as usize].is_some());
    }

    /// The vertices in use, in their order.
    pub(super) fn into_mesh(self) -> TriMesh {
        let mut numbers = vec![u32::MAX; self.positions.len()];
        let mut triangles: Vec<[u32; 3]> = self.triangles.into_iter().flatten().collect();
        triangles.iter().flatten().for_each(|&v| numbers[v as usize] = 0);
        let mut positions = Vec::new();
        for (number, &position) in numbers.iter_mut().zip(&self.positions).filter(|(number, _)| **number == 0)
        {
            *number = positions.len() as u32;
            positions.push(position);
        }
        triangles.iter_mut().flatten().for_each(|v| *v = numbers[*v as usize]);
        TriMesh { positions, triangles }
    }
}

fn is_like(before: [Vec3; 3], after: [Vec3; 3]) -> bool {
    let [old, new] = [before, after].map(|corners| {
        let [p, q, r] = corners.map(|corner| corner.as_dvec3());
        (q - p).cross(r - p)
    });
    let [p, q, r] = after;
    let longest_squared =
        f64::from(p.distance_squared(q).max(q.distance_squared(r)).max(r.distance_squared(p)));
    old.dot(new) > LEAST_TURN * old.norm() * new.norm() && new.norm() > 2.0 * THINNEST * longest_squared
}
