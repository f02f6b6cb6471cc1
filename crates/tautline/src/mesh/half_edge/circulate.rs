//! Circulators: walks around a vertex, a face, an edge and along the boundary.

use super::HalfEdgeMesh;

impl HalfEdgeMesh {
    /// The three half-edges of a face, counter-clockwise; the k-th starts at the k-th corner.
    pub fn face_half_edges(&self, face: u32) -> [u32; 3] {
        [3 * face, 3 * face + 1, 3 * face + 2]
    }

    /// The faces across the three sides of a face; side k starts at corner k. `None` across the boundary.
    pub fn face_neighbors(&self, face: u32) -> [Option<u32>; 3] {
        self.face_half_edges(face).map(|half_edge| self.face(self.twin(half_edge)))
    }

    /// The half-edges that start at a vertex, counter-clockwise seen from outside, each once. At the boundary
    /// the last one has no face; elsewhere it is followed by the first again.
    pub fn outgoing(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.outgoing[vertex as usize];
        std::iter::successors(Some(first), move |&half_edge| {
            let turned = !self.is_boundary(half_edge);
            turned.then(|| self.twin(self.previous(half_edge))).filter(|&half_edge| half_edge != first)
        })
    }

    /// The neighbours of a vertex, counter-clockwise seen from outside; at the boundary from one boundary edge
    /// to the other.
    pub fn one_ring(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.outgoing(vertex).map(|half_edge| self.target(half_edge))
    }

    /// The faces around a vertex, in the order of [`one_ring`](Self::one_ring).
    pub fn vertex_faces(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.outgoing(vertex).filter_map(|half_edge| self.face(half_edge))
    }

    /// Every edge once, its lower end first, in ascending order.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = [u32; 2]> + '_ {
        self.edges.iter().map(|&half_edge| self.ends(half_edge))
    }

    /// The ends of an edge, the lower first.
    pub fn edge(&self, edge: u32) -> [u32; 2] {
        self.ends(self.edges[edge as usize])
    }

    /// The two half-edges of an edge. The first is the lower one and always has a face.
    pub fn edge_half_edges(&self, edge: u32) -> [u32; 2] {
        let half_edge = self.edges[edge as usize];
        [half_edge, self.twin(half_edge)]
    }

    /// The edge that a half-edge runs along; found by bisection.
    pub fn edge_of(&self, half_edge: u32) -> Option<u32> {
        let [a, b] = self.ends(half_edge);
        self.edge_between(a, b)
    }

    /// The edge between two vertices, in either order, if there is one; found by bisection.
    pub fn edge_between(&self, a: u32, b: u32) -> Option<u32> {
        let wanted = [a.min(b), a.max(b)];
        self.edges
            .binary_search_by_key(&wanted, |&half_edge| self.ends(half_edge))
            .ok()
            .map(|edge| edge as u32)
    }

    /// The face of an edge's first half-edge and that of its second, `None` at the boundary.
    pub fn edge_faces(&self, edge: u32) -> (u32, Option<u32>) {
        let [half_edge, twin] = self.edge_half_edges(edge);
        (half_edge / 3, self.face(twin))
    }

    /// The corners across an edge in its two triangles, in the order of [`edge_faces`](Self::edge_faces).
    pub fn opposite_vertices(&self, edge: u32) -> (u32, Option<u32>) {
        let [half_edge, twin] = self.edge_half_edges(edge);
        let across = |side: u32| self.origin(self.previous(side));
        (across(half_edge), self.face(twin).map(|_| across(twin)))
    }

    /// Every edge between two triangles, as \[a, b, c, d\] with the triangles (a, b, c) and (b, a, d), both
    /// counter-clockwise seen from outside: what bending acts on. In the order of [`edges`](Self::edges).
    pub fn hinges(&self) -> impl Iterator<Item = [u32; 4]> + '_ {
        (0..self.edge_count() as u32).filter_map(|edge| {
            let half_edge = self.edges[edge as usize];
            let (c, d) = self.opposite_vertices(edge);
            d.map(|d| [self.origin(half_edge), self.target(half_edge), c, d])
        })
    }

    /// The vertices along every boundary loop, the surface on the right (clockwise around it seen from outside,
    /// counter-clockwise around a hole). A loop starts at its lowest half-edge, loops are in that order.
    pub fn boundary_loops(&self) -> Vec<Vec<u32>> {
        let first = self.first_boundary();
        let mut seen = vec![false; self.boundary_next.len()];
        let mut loops = Vec::new();
        for start in first..self.half_edge_count() as u32 {
            let mut vertices = Vec::new();
            let mut half_edge = start;
            while !seen[(half_edge - first) as usize] {
                seen[(half_edge - first) as usize] = true;
                vertices.push(self.origin(half_edge));
                half_edge = self.next(half_edge);
            }
            if !vertices.is_empty() {
                loops.push(vertices);
            }
        }
        loops
    }
}
