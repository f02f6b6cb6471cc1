//! From triangle soup to a half-edge mesh, or to the first defect that prevents one.

use serde::{Deserialize, Serialize};

use super::{HalfEdgeMesh, next_in_face};
use crate::mesh::{TriMesh, exact};
use crate::order::PutInOrder;
use crate::{Error, MeshDefect};

/// More triangles could need more half-edges, boundary included, than a u32 counts.
const MAX_TRIANGLES: usize = (u32::MAX / 6) as usize;

/// What a mesh is stored as: all else follows from it.
#[derive(Serialize, Deserialize)]
pub(super) struct Triangles {
    vertex_count: u32,
    triangles: Vec<[u32; 3]>,
}

impl From<HalfEdgeMesh> for Triangles {
    fn from(mesh: HalfEdgeMesh) -> Self {
        Self { vertex_count: mesh.vertex_count() as u32, triangles: mesh.to_triangles() }
    }
}

impl TryFrom<Triangles> for HalfEdgeMesh {
    type Error = Error;

    fn try_from(stored: Triangles) -> Result<Self, Error> {
        Self::from_triangles(stored.vertex_count as usize, &stored.triangles)
    }
}

impl HalfEdgeMesh {
    /// Builds the topology in O(n log n). Every edge has one triangle or two that run along it in opposite
    /// directions, and the triangles around every vertex form one fan, whole or open.
    ///
    /// # Errors
    /// [`Error::Mesh`] names the first [`MeshDefect`] in this order: no triangles, an index out of range, a
    /// repeated corner, a vertex without triangle, a duplicate, an edge with a third or a flipped triangle, a
    /// bow-tie. [`Error::OutOfRange`] if there are more than 715 827 882 triangles.
    pub fn from_triangles(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<Self, Error> {
        check_corners(vertex_count, triangles)?;
        check_every_vertex_used(vertex_count, triangles)?;
        check_duplicates(triangles)?;
        let (twin, edges) = pair_half_edges(triangles)?;
        let mut mesh = Self {
            origin: triangles.as_flattened().to_vec(),
            twin,
            boundary_next: Vec::new(),
            outgoing: vec![u32::MAX; vertex_count],
            edges,
        };
        mesh.add_boundary();
        mesh.choose_outgoing();
        mesh.check_single_fans()?;
        mesh.link_boundary();
        Ok(mesh)
    }

    /// Builds the topology of a mesh and checks its positions as well.
    ///
    /// # Errors
    /// As [`from_triangles`](Self::from_triangles), after a coordinate that is not finite; last a triangle
    /// whose corners lie on one line (found exactly: however thin, any other triangle passes).
    pub fn from_mesh(mesh: &TriMesh) -> Result<Self, Error> {
        if let Some(vertex) = mesh.positions.iter().position(|position| !position.is_finite()) {
            return Err(MeshDefect::NotFinite { vertex }.into());
        }
        let topology = Self::from_triangles(mesh.positions.len(), &mesh.triangles)?;
        let flat = mesh.triangles.iter().position(|corners| {
            let [a, b, c] = corners.map(|vertex| mesh.positions[vertex as usize]);
            exact::twice_area_squared(a, b, c) == 0.0
        });
        match flat {
            Some(triangle) => Err(MeshDefect::DegenerateTriangle { triangle }.into()),
            None => Ok(topology),
        }
    }

    /// Gives every half-edge that met no partner a twin without a face.
    fn add_boundary(&mut self) {
        let face_half_edges = self.origin.len() as u32;
        for edge in 0..self.edges.len() {
            let half_edge = self.edges[edge];
            if self.twin[half_edge as usize] == u32::MAX {
                self.twin[half_edge as usize] = self.origin.len() as u32;
                self.twin.push(half_edge);
                self.origin.push(self.origin[next_in_face(half_edge) as usize]);
            }
        }
        // Linked once the fans are known to be whole; the length tells the boundary's half-edges apart.
        self.boundary_next = vec![u32::MAX; self.origin.len() - face_half_edges as usize];
    }

    /// The lowest half-edge out of every vertex, or at the boundary the one whose twin has no face.
    fn choose_outgoing(&mut self) {
        for half_edge in (0..self.first_boundary()).rev() {
            let vertex = self.origin(half_edge);
            self.outgoing[vertex as usize] = half_edge;
        }
        for half_edge in self.first_boundary()..self.half_edge_count() as u32 {
            let vertex = self.target(half_edge);
            self.outgoing[vertex as usize] = self.twin(half_edge);
        }
    }

    /// A walk around a vertex must meet every half-edge that starts there.
    fn check_single_fans(&self) -> Result<(), Error> {
        let mut degree = vec![0_usize; self.vertex_count()];
        for &vertex in &self.origin {
            degree[vertex as usize] += 1;
        }
        match self.vertices().find(|&vertex| self.outgoing(vertex).count() != degree[vertex as usize]) {
            Some(vertex) => Err(MeshDefect::BowTieVertex { vertex }.into()),
            None => Ok(()),
        }
    }

    /// With single fans, one boundary half-edge enters a boundary vertex and one leaves it: the last of its fan.
    fn link_boundary(&mut self) {
        let first = self.first_boundary();
        for half_edge in first..self.half_edge_count() as u32 {
            let entering = self.twin(self.outgoing[self.origin(half_edge) as usize]);
            self.boundary_next[(entering - first) as usize] = half_edge;
        }
    }
}

fn check_corners(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<(), Error> {
    if triangles.is_empty() {
        return Err(MeshDefect::Empty.into());
    }
    if triangles.len() > MAX_TRIANGLES {
        let value = triangles.len() as f64;
        let expected = "a count of at most 715827882";
        return Err(Error::OutOfRange { field: "triangles".into(), value, expected });
    }
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        if let Some(vertex) = [a, b, c].into_iter().find(|&vertex| vertex as usize >= vertex_count) {
            return Err(MeshDefect::IndexOutOfRange { triangle, vertex, count: vertex_count }.into());
        }
        if a == b || b == c || c == a {
            return Err(MeshDefect::DegenerateTriangle { triangle }.into());
        }
    }
    Ok(())
}

/// Allocates by the number of triangles only: a vertex count from untrusted bytes may be anything.
fn check_every_vertex_used(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<(), Error> {
    let mut used = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    if used.len() == vertex_count {
        return Ok(());
    }
    let gap = used.iter().zip(0..).find(|&(&vertex, rank)| vertex != rank).map(|(_, rank)| rank);
    Err(MeshDefect::IsolatedVertex { vertex: gap.unwrap_or(used.len() as u32) }.into())
}

/// Names the pair whose later triangle comes first.
fn check_duplicates(triangles: &[[u32; 3]]) -> Result<(), Error> {
    let mut sorted: Vec<([u32; 3], usize)> = triangles.iter().copied().zip(0..).collect();
    for (corners, _) in &mut sorted {
        corners.sort_unstable();
    }
    sorted.put_in_order();
    let same =
        sorted.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| (pair[1].1, pair[0].1)).min();
    match same {
        Some((second, first)) => Err(MeshDefect::DuplicateTriangle { first, second }.into()),
        None => Ok(()),
    }
}

/// Sorts the half-edges by edge: those that share one become twins. Returns the twins (`u32::MAX` where there is
/// none) and the lower half-edge of every edge.
fn pair_half_edges(triangles: &[[u32; 3]]) -> Result<(Vec<u32>, Vec<u32>), Error> {
    let origin = triangles.as_flattened();
    let mut by_edge: Vec<(u32, u32, u32)> = (0..origin.len() as u32)
        .map(|half_edge| {
            let (a, b) = (origin[half_edge as usize], origin[next_in_face(half_edge) as usize]);
            (a.min(b), a.max(b), half_edge)
        })
        .collect();
    by_edge.put_in_order();
    let mut twin = vec![u32::MAX; origin.len()];
    let mut edges = Vec::with_capacity(origin.len() / 2);
    for sharing in by_edge.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        let (a, b, first) = sharing[0];
        edges.push(first);
        match *sharing {
            [_] => {}
            [_, (_, _, second)] if origin[first as usize] != origin[second as usize] => {
                twin[first as usize] = second;
                twin[second as usize] = first;
            }
            [_, (_, _, second)] => {
                let (triangle, a) = (second as usize / 3, origin[second as usize]);
                let b = origin[next_in_face(second) as usize];
                return Err(MeshDefect::FlippedTriangle { triangle, a, b }.into());
            }
            [_, _, (_, _, third), ..] => {
                return Err(MeshDefect::NonManifoldEdge { a, b, triangle: third as usize / 3 }.into());
            }
            [] => {}
        }
    }
    Ok((twin, edges))
}
