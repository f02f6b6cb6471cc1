//! Every invariant of the half-edge mesh, checked one by one and without trust in any.

use super::HalfEdgeMesh;
use crate::Error;

impl HalfEdgeMesh {
    /// Checks every invariant. A mesh that was built or deserialised holds them all; this is for tests and for
    /// whoever changes this module. Neither panics nor loops, whatever the arrays hold.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the array, the place in it and the invariant that is broken.
    pub fn validate(&self) -> Result<(), Error> {
        self.check_ranges()?;
        self.check_twins()?;
        self.check_boundary()?;
        self.check_fans()?;
        self.check_edges()
    }

    /// Lengths fit each other and every number names something.
    fn check_ranges(&self) -> Result<(), Error> {
        let (half_edges, boundary) = (self.origin.len(), self.boundary_next.len());
        if boundary > half_edges || !(half_edges - boundary).is_multiple_of(3) {
            return broken(
                "boundary_next",
                boundary,
                "three half-edges per face, then those of the boundary",
            );
        }
        if self.twin.len() != half_edges || half_edges != 2 * self.edges.len() {
            return broken(
                "twin",
                self.twin.len(),
                "a twin for every half-edge, two half-edges for every edge",
            );
        }
        let arrays = [
            ("origin", &self.origin, 0, self.outgoing.len()),
            ("twin", &self.twin, 0, half_edges),
            ("boundary_next", &self.boundary_next, half_edges - boundary, half_edges),
            ("outgoing", &self.outgoing, 0, half_edges - boundary),
            ("edges", &self.edges, 0, half_edges - boundary),
        ];
        for (name, array, from, to) in arrays {
            if let Some(place) = array.iter().position(|&value| !(from..to).contains(&(value as usize))) {
                return broken(name, place, "a number in range");
            }
        }
        Ok(())
    }

    /// Twins are mutual, run between the same two vertices in opposite directions, and one of them has a face.
    fn check_twins(&self) -> Result<(), Error> {
        for half_edge in self.half_edges() {
            let twin = self.twin(half_edge);
            if twin == half_edge || self.twin(twin) != half_edge {
                return broken("twin", half_edge as usize, "the twin of its twin, and not its own");
            }
            if self.is_boundary(half_edge) && self.is_boundary(twin) {
                return broken("twin", half_edge as usize, "a half-edge with a face if this one has none");
            }
            if self.origin(self.next(half_edge)) != self.origin(twin)
                || self.origin(half_edge) == self.origin(twin)
            {
                return broken(
                    "origin",
                    half_edge as usize,
                    "the start of a half-edge to where the next one starts",
                );
            }
        }
        Ok(())
    }

    /// Along the boundary `next` and `previous` undo each other.
    fn check_boundary(&self) -> Result<(), Error> {
        for (place, &next) in self.boundary_next.iter().enumerate() {
            let entering = self.twin(self.outgoing[self.origin(next) as usize]);
            if entering != self.first_boundary() + place as u32 {
                return broken("boundary_next", place, "the half-edge that leaves where this one ends");
            }
        }
        Ok(())
    }

    /// The walk around every vertex meets all half-edges that start there. It ends: twins are mutual, so a turn
    /// can be undone and the walk comes back to its start unless it meets the boundary.
    fn check_fans(&self) -> Result<(), Error> {
        let mut degree = vec![0_usize; self.vertex_count()];
        for &vertex in &self.origin {
            degree[vertex as usize] += 1;
        }
        for vertex in self.vertices() {
            let walk = self.outgoing(vertex);
            if self.origin(self.outgoing[vertex as usize]) != vertex
                || walk.count() != degree[vertex as usize]
            {
                return broken(
                    "outgoing",
                    vertex as usize,
                    "the start of a fan of all half-edges of this vertex",
                );
            }
        }
        Ok(())
    }

    /// Edges are listed once, by their lower half-edge, in ascending order; no two join the same vertices.
    fn check_edges(&self) -> Result<(), Error> {
        for (place, &half_edge) in self.edges.iter().enumerate() {
            let ascending = place == 0 || self.ends(self.edges[place - 1]) < self.ends(half_edge);
            if !ascending || self.twin(half_edge) < half_edge {
                return broken("edges", place, "the lower half-edge of an edge after all lower edges");
            }
        }
        Ok(())
    }
}

fn broken(array: &str, place: usize, expected: &str) -> Result<(), Error> {
    Err(Error::Invalid {
        field: format!("half_edge_mesh.{array}[{place}]"),
        problem: format!("expected {expected}"),
    })
}

#[cfg(test)]
mod tests {
    use super::HalfEdgeMesh;
    use proptest::prelude::*;

    fn arrays(mesh: &mut HalfEdgeMesh) -> [&mut Vec<u32>; 5] {
        let HalfEdgeMesh { origin, twin, boundary_next, outgoing, edges } = mesh;
        [origin, twin, boundary_next, outgoing, edges]
    }

    fn samples() -> Vec<HalfEdgeMesh> {
        let square = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let tetrahedron = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
        let pierced = [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4], [2, 0, 5], [0, 3, 5]];
        [(5, &square[..]), (4, &tetrahedron), (6, &pierced)]
            .map(|(count, triangles)| HalfEdgeMesh::from_triangles(count, triangles).unwrap())
            .into()
    }

    /// All but one number follow from the others, so any change is found. The exception: a vertex inside the
    /// surface may start its fan at any of its half-edges.
    #[test]
    fn every_single_change_is_found() {
        for mesh in samples() {
            mesh.validate().unwrap();
            for array in 0..5 {
                for place in 0..arrays(&mut mesh.clone())[array].len() {
                    for value in (0..mesh.half_edge_count() as u32 + 1).chain([u32::MAX]) {
                        let mut changed = mesh.clone();
                        arrays(&mut changed)[array][place] = value;
                        let vertex = place as u32;
                        let turned = array == 3
                            && !mesh.is_boundary_vertex(vertex)
                            && mesh.outgoing(vertex).any(|half_edge| half_edge == value);
                        assert_eq!(changed.validate().is_ok(), changed == mesh || turned, "{changed:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_missing_number_is_found() {
        for mesh in samples() {
            for array in 0..5 {
                let mut changed = mesh.clone();
                if arrays(&mut changed)[array].pop().is_some() {
                    assert!(changed.validate().is_err());
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        /// Ends without a panic on arrays that fit in length and range but are otherwise random.
        #[test]
        fn garbage_is_survived(which in 0_usize..3, changes in prop::collection::vec((0_usize..5, 0_usize..40, 0_u32..24), 1..9)) {
            let mut mesh = samples().swap_remove(which);
            for (array, place, value) in changes {
                if let Some(number) = arrays(&mut mesh)[array].get_mut(place) {
                    *number = value;
                }
            }
            if mesh.validate().is_ok() {
                let rebuilt = HalfEdgeMesh::from_triangles(mesh.vertex_count(), &mesh.to_triangles()).unwrap();
                prop_assert_eq!(rebuilt.edges, mesh.edges);
            }
        }
    }
}
