//! The half-edge mesh (paper section 4): the topology of a triangulated surface, closed or with boundary.
//!
//! Only triangles occur, so sides are numbered: half-edge `3 f + k` runs along side k of face f, and `next`,
//! `previous` and `face` are arithmetic (Campagna, Kobbelt & Seidel 1998, Directed edges). Half-edges from
//! `3 · face_count` on have no face and run along the boundary, with the surface on their right.

mod build;
mod circulate;
mod validate;

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::{Error, MeshDefect};

/// The topology of a surface of triangles: who touches whom. Positions live elsewhere: vertex i is the i-th
/// particle of a body, or the i-th position of a [`TriMesh`](super::TriMesh).
///
/// Vertices, faces, half-edges and edges are plain numbers counting from 0; faces are in the order given, edges
/// in ascending order of their ends. An accessor given a number outside its range panics as a slice does.
///
/// ```
/// use tautline::mesh::{HalfEdgeMesh, primitives};
///
/// let cube = HalfEdgeMesh::from_mesh(&primitives::cube(1.0)?)?;
/// assert_eq!((cube.vertex_count(), cube.edge_count(), cube.face_count()), (8, 18, 12));
/// for neighbor in cube.one_ring(0) {
///     assert!(cube.edge_between(0, neighbor).is_some());
/// }
/// # Ok::<(), tautline::Error>(())
/// ```
///
/// Serialised as its triangles and built anew from them, so that bytes from anywhere either give a mesh that
/// holds every invariant or an error.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "build::Triangles", into = "build::Triangles")]
pub struct HalfEdgeMesh {
    /// Start of every half-edge.
    origin: Vec<u32>,
    /// The half-edge along the same edge in the other direction.
    twin: Vec<u32>,
    /// Successor of every half-edge without a face, counted from `3 · face_count`.
    boundary_next: Vec<u32>,
    /// One half-edge out of every vertex; at the boundary the most clockwise one that has a face, so that
    /// turning counter-clockwise from it meets all others.
    outgoing: Vec<u32>,
    /// The lower half-edge of every edge (it always has a face), ascending by (lower end, higher end).
    edges: Vec<u32>,
}

impl HalfEdgeMesh {
    /// Number of vertices; each belongs to a face.
    pub fn vertex_count(&self) -> usize {
        self.outgoing.len()
    }

    /// Number of triangles.
    pub fn face_count(&self) -> usize {
        (self.origin.len() - self.boundary_next.len()) / 3
    }

    /// Number of edges, counting each once.
    pub fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// Number of half-edges: two per edge.
    pub fn half_edge_count(&self) -> usize {
        self.origin.len()
    }

    /// All vertices.
    pub fn vertices(&self) -> Range<u32> {
        0..self.vertex_count() as u32
    }

    /// All faces.
    pub fn faces(&self) -> Range<u32> {
        0..self.face_count() as u32
    }

    /// All half-edges: three per face, then those of the boundary.
    pub fn half_edges(&self) -> Range<u32> {
        0..self.half_edge_count() as u32
    }

    /// The vertex a half-edge starts at.
    pub fn origin(&self, half_edge: u32) -> u32 {
        self.origin[half_edge as usize]
    }

    /// The vertex a half-edge ends at.
    pub fn target(&self, half_edge: u32) -> u32 {
        self.origin(self.twin(half_edge))
    }

    /// The half-edge along the same edge in the other direction.
    pub fn twin(&self, half_edge: u32) -> u32 {
        self.twin[half_edge as usize]
    }

    /// The half-edge that follows around the same face, or along the same boundary loop.
    pub fn next(&self, half_edge: u32) -> u32 {
        match half_edge.checked_sub(self.first_boundary()) {
            Some(boundary) => self.boundary_next[boundary as usize],
            None => next_in_face(half_edge),
        }
    }

    /// The half-edge that precedes around the same face, or along the same boundary loop.
    pub fn previous(&self, half_edge: u32) -> u32 {
        if self.is_boundary(half_edge) {
            // The most clockwise half-edge out of a boundary vertex runs against the boundary into it.
            self.twin(self.outgoing[self.origin(half_edge) as usize])
        } else {
            previous_in_face(half_edge)
        }
    }

    /// The face to the left of a half-edge; `None` along the boundary.
    pub fn face(&self, half_edge: u32) -> Option<u32> {
        (!self.is_boundary(half_edge)).then_some(half_edge / 3)
    }

    /// Whether a half-edge has no face.
    pub fn is_boundary(&self, half_edge: u32) -> bool {
        half_edge >= self.first_boundary()
    }

    /// Whether a vertex lies on the boundary.
    pub fn is_boundary_vertex(&self, vertex: u32) -> bool {
        self.is_boundary(self.twin(self.outgoing[vertex as usize]))
    }

    /// Whether the surface has no boundary.
    pub fn closed(&self) -> bool {
        self.boundary_next.is_empty()
    }

    /// Refuses a surface with a boundary.
    ///
    /// # Errors
    /// [`MeshDefect::OpenEdge`] names the first open edge.
    pub fn require_closed(&self) -> Result<(), Error> {
        let open = self.edges.iter().find(|&&half_edge| self.is_boundary(self.twin(half_edge)));
        match open {
            None => Ok(()),
            Some(&half_edge) => {
                let [a, b] = self.ends(half_edge);
                Err(MeshDefect::OpenEdge { a, b }.into())
            }
        }
    }

    /// The corners of a face, in the order given.
    pub fn triangle(&self, face: u32) -> [u32; 3] {
        self.face_half_edges(face).map(|half_edge| self.origin(half_edge))
    }

    /// The corners of every face.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> + '_ {
        self.faces().map(|face| self.triangle(face))
    }

    /// The triangles it was built from, in the same order and with the same first corners.
    pub fn to_triangles(&self) -> Vec<[u32; 3]> {
        self.triangles().collect()
    }

    fn first_boundary(&self) -> u32 {
        (self.origin.len() - self.boundary_next.len()) as u32
    }

    /// Both ends of a half-edge, the lower first.
    fn ends(&self, half_edge: u32) -> [u32; 2] {
        let (a, b) = (self.origin(half_edge), self.target(half_edge));
        [a.min(b), a.max(b)]
    }
}

fn next_in_face(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 { half_edge - 2 } else { half_edge + 1 }
}

fn previous_in_face(half_edge: u32) -> u32 {
    if half_edge.is_multiple_of(3) { half_edge + 2 } else { half_edge - 1 }
}
