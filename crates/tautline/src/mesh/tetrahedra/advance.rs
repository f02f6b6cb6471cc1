//! Filling a cavity from its faces inwards: an advancing front that prefers Delaunay tetrahedra. What it
//! cannot fill it leaves as a smaller cavity.

use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};

use glam::DVec3;

use super::boxes::Aabb;
use super::predicates::{Face, Tet, faces_of, in_sphere, orient, reach, reversed, tet_crosses_face, tet_on};

/// Apexes tried for a face, in Delaunay order, before the face is left to the search.
const TRIES: usize = 24;

/// Counts a loose vertex as used, for good.
const LOOSE: usize = 1;

/// Faces around what is empty, with their boxes side by side for a fast scan.
struct Front<'a> {
    points: &'a [DVec3],
    faces: Vec<Face>,
    boxes: Vec<Aabb>,
    slots: HashMap<Face, usize>,
    /// How many faces of the front use a vertex.
    uses: BTreeMap<u32, usize>,
}

impl<'a> Front<'a> {
    fn new(points: &'a [DVec3], faces: &BTreeSet<Face>) -> Front<'a> {
        let (slots, uses) = (HashMap::new(), BTreeMap::new());
        let mut front = Front { points, faces: Vec::new(), boxes: Vec::new(), slots, uses };
        faces.iter().for_each(|&f| front.insert(f));
        front
    }

    fn insert(&mut self, face: Face) {
        self.slots.insert(face, self.faces.len());
        self.faces.push(face);
        self.boxes.push(Aabb::around(self.points, &face));
        face.iter().for_each(|&v| *self.uses.entry(v).or_default() += 1);
    }

    fn remove(&mut self, face: Face) -> bool {
        let Some(slot) = self.slots.remove(&face) else { return false };
        self.faces.swap_remove(slot);
        self.boxes.swap_remove(slot);
        if let Some(moved) = self.faces.get(slot) {
            self.slots.insert(*moved, slot);
        }
        for v in face {
            if let Some(count) = self.uses.get_mut(&v) {
                *count -= 1;
            }
        }
        true
    }

    fn fits(&self, tet: &Tet) -> bool {
        let around = Aabb::around(self.points, tet);
        let near = self.faces.iter().zip(&self.boxes).filter(|(_, b)| b.overlaps(&around));
        !near.into_iter().any(|(&f, _)| tet_crosses_face(self.points, tet, f))
    }

    /// The apex whose sphere through the face is the emptiest among those that fit.
    fn apex(&self, face: Face) -> Option<u32> {
        let is_inward = |v: u32| !face.contains(&v) && orient(self.points, face, v) < 0.0;
        let used = self.uses.iter().filter(|(_, uses)| **uses > 0).map(|(v, _)| *v);
        let mut ranked: Vec<(f64, u32)> =
            used.filter(|&v| is_inward(v)).map(|v| (reach(self.points, face, v), v)).collect();
        if ranked.len() > 2 * TRIES {
            ranked.select_nth_unstable_by(2 * TRIES, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            ranked.truncate(2 * TRIES);
        }
        let mut inward: Vec<u32> = ranked.into_iter().map(|(_, v)| v).collect();
        for _ in 0..TRIES {
            let closer = |a: u32, b: u32| if in_sphere(self.points, &tet_on(face, a), b) { b } else { a };
            let best = inward.iter().copied().reduce(closer)?;
            if self.fits(&tet_on(face, best)) {
                return Some(best);
            }
            inward.retain(|&v| v != best);
        }
        None
    }
}

/// Tetrahedra that fill the cavity within `faces`, or part of it. They may use the `loose` vertices inside.
pub(super) fn advance(points: &[DVec3], faces: &BTreeSet<Face>, loose: &[u32]) -> Vec<Tet> {
    let mut front = Front::new(points, faces);
    front.uses.extend(loose.iter().map(|&v| (v, LOOSE)));
    let mut queue: VecDeque<Face> = faces.iter().copied().collect();
    let mut placed = Vec::new();
    while let Some(face) = queue.pop_front() {
        if !front.slots.contains_key(&face) {
            continue;
        }
        let Some(apex) = front.apex(face) else { continue };
        let tet = tet_on(face, apex);
        for side in faces_of(&tet) {
            if !front.remove(side) {
                front.insert(reversed(side));
                queue.push_back(reversed(side));
            }
        }
        placed.push(tet);
    }
    placed
}
