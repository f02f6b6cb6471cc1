//! A mesh under repair, and where its parts come from.

use super::super::Defect;
use super::super::diagnose::is_known;
use super::super::edges::{partners, sides};
use super::super::orient::orientation;
use super::super::surface::Surface;
use super::{Action, Why};
use crate::mesh::TriMesh;

/// Stands for what was not in the mesh that was brought.
const NEW: u32 = u32::MAX;

/// Triangles with three different corners that are there and finite.
pub(super) struct Patient {
    pub(super) mesh: TriMesh,
    /// What each vertex and triangle was.
    vertex_was: Vec<u32>,
    triangle_was: Vec<u32>,
    actions: Vec<Action>,
}

impl Patient {
    pub(super) fn admit(mesh: &TriMesh) -> Self {
        let mut patient = Self {
            vertex_was: (0..mesh.positions.len() as u32).collect(),
            triangle_was: (0..mesh.triangles.len() as u32).collect(),
            mesh: mesh.clone(),
            actions: Vec::new(),
        };
        let known: Vec<bool> = mesh.triangles.iter().map(|&triangle| is_known(mesh, triangle)).collect();
        patient.keep(&known, Why::NoPlace);
        patient.drop_without_three_corners();
        patient
    }

    pub(super) fn discharge(self) -> (TriMesh, Vec<Action>) {
        (self.mesh, self.actions)
    }

    pub(super) fn act(&mut self, action: Action) {
        self.actions.push(action);
    }

    /// What a vertex was.
    pub(super) fn was(&self, vertex: u32) -> u32 {
        self.vertex_was[vertex as usize]
    }

    /// How many of some triangles there are, and which of them were there before.
    fn named(&self, triangles: impl Iterator<Item = usize>) -> (usize, Vec<u32>) {
        let was: Vec<u32> = triangles.map(|triangle| self.triangle_was[triangle]).collect();
        (was.len(), was.into_iter().filter(|&was| was != NEW).collect())
    }

    /// Drops the triangles that are not to be kept.
    pub(super) fn keep(&mut self, kept: &[bool], why: Why) {
        let (count, triangles) = self.named((0..kept.len()).filter(|&triangle| !kept[triangle]));
        if count > 0 {
            self.act(Action::DroppedTriangles { why, count, triangles });
        }
        let mut keeps = kept.iter();
        self.mesh.triangles.retain(|_| keeps.next() == Some(&true));
        let mut keeps = kept.iter();
        self.triangle_was.retain(|_| keeps.next() == Some(&true));
    }

    pub(super) fn drop_without_three_corners(&mut self) {
        let kept: Vec<bool> =
            self.mesh.triangles.iter().map(|&[a, b, c]| a != b && b != c && c != a).collect();
        self.keep(&kept, Why::NoArea);
    }

    /// Adds a copy of a vertex.
    pub(super) fn double(&mut self, vertex: u32) -> u32 {
        self.mesh.positions.push(self.mesh.positions[vertex as usize]);
        self.vertex_was.push(self.was(vertex));
        self.mesh.positions.len() as u32 - 1
    }

    /// Adds a triangle.
    pub(super) fn add(&mut self, triangle: [u32; 3]) {
        self.mesh.triangles.push(triangle);
        self.triangle_was.push(NEW);
    }

    /// Takes the last triangles away again.
    pub(super) fn truncate(&mut self, count: usize) {
        self.mesh.triangles.truncate(count);
        self.triangle_was.truncate(count);
    }

    /// Notes that triangles have got an area.
    pub(super) fn note_swapped(&mut self, swapped: &[usize]) {
        let (count, triangles) = self.named(swapped.iter().copied());
        if count > 0 {
            self.act(Action::Swapped { count, triangles });
        }
    }

    pub(super) fn surface(&self) -> Surface<'_> {
        Surface::new(&self.mesh, vec![true; self.mesh.triangles.len()])
    }

    /// Turns the triangles that run against most of their patch.
    pub(super) fn turn_to_agree(&mut self) {
        let sides = sides(&self.mesh.triangles, &vec![true; self.mesh.triangles.len()]);
        let orientation = orientation(&self.mesh.triangles, &partners(&self.mesh.triangles, &sides));
        self.turn(&orientation.is_flipped);
    }

    /// Turns closed components that are inside out.
    pub(super) fn turn_outwards(&mut self) {
        let surface = self.surface();
        let first = surface.first_of_component();
        let mut is_wrong = vec![false; first.len()];
        for defect in surface.components().1 {
            if let Defect::InsideOut { triangle } = defect {
                is_wrong[triangle as usize] = true;
            }
        }
        let turned: Vec<bool> = first.iter().map(|&first| is_wrong[first as usize]).collect();
        self.turn(&turned);
    }

    fn turn(&mut self, turned: &[bool]) {
        let (count, triangles) = self.named((0..turned.len()).filter(|&triangle| turned[triangle]));
        if count > 0 {
            self.act(Action::Turned { count, triangles });
        }
        for (triangle, _) in self.mesh.triangles.iter_mut().zip(turned).filter(|&(_, &turned)| turned) {
            triangle.swap(1, 2);
        }
    }

    pub(super) fn drop_unused_vertices(&mut self) {
        let mut number = vec![NEW; self.mesh.positions.len()];
        for &vertex in self.mesh.triangles.as_flattened() {
            number[vertex as usize] = 0;
        }
        let is_used: Vec<bool> = number.iter().map(|&number| number != NEW).collect();
        let mut dropped: Vec<u32> =
            is_used.iter().zip(&self.vertex_was).filter(|&(used, _)| !used).map(|(_, &was)| was).collect();
        // Those that were welded are told of already.
        let mut welded: Vec<u32> = self.actions.iter().flat_map(Action::welded).collect();
        welded.sort_unstable();
        dropped.retain(|vertex| welded.binary_search(vertex).is_err());
        if !dropped.is_empty() {
            self.act(Action::DroppedVertices { vertices: dropped });
        }
        let used = (0..).zip(number.iter_mut().filter(|number| **number != NEW));
        used.for_each(|(next, number)| *number = next);
        self.mesh
            .triangles
            .as_flattened_mut()
            .iter_mut()
            .for_each(|vertex| *vertex = number[*vertex as usize]);
        let mut uses = is_used.iter();
        self.mesh.positions.retain(|_| uses.next() == Some(&true));
        let mut uses = is_used.iter();
        self.vertex_was.retain(|_| uses.next() == Some(&true));
    }
}

impl Action {
    /// The vertices that became others.
    fn welded(&self) -> impl Iterator<Item = u32> {
        let pairs = if let Self::Welded { pairs } = self { pairs.as_slice() } else { &[] };
        pairs.iter().map(|pair| pair[0])
    }
}
