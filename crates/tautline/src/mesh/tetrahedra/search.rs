//! Filling a small cavity without new points, by exhaustive search: the face with the fewest choices
//! first (after Liu, Chen and Sun, "Small polyhedron reconnection", 2007).

use std::collections::BTreeSet;

use glam::DVec3;

use super::boxes::Aabb;
use super::filling::vertices;
use super::predicates::{Face, Tet, faces_of, orient, reach, reversed, tet_crosses_face, tet_on};
use crate::order::PutInOrder;

/// Cavities with more faces are not searched.
pub(super) const MAX_FACES: usize = 72;
/// Tetrahedra tried before a search is given up.
const BUDGET: usize = 400;

/// A face of the front with the apexes that still fit.
#[derive(Clone)]
struct Open {
    face: Face,
    apexes: Vec<u32>,
}

struct Search<'a> {
    points: &'a [DVec3],
    budget: usize,
    placed: Vec<Tet>,
}

/// Tetrahedra that fill the cavity within `faces` without a new point; `None` where there are none or
/// the search became too long.
pub(super) fn search(points: &[DVec3], faces: &BTreeSet<Face>) -> Option<Vec<Tet>> {
    if faces.len() > MAX_FACES {
        return None;
    }
    let mut search = Search { points, budget: BUDGET, placed: Vec::new() };
    let (corners, all) = (vertices(faces), Vec::from_iter(faces.iter().copied()));
    let front = all.iter().map(|&face| Open { face, apexes: search.choices(face, &corners, &all) }).collect();
    search.fill(front).then_some(search.placed)
}

impl Search<'_> {
    fn fits(&self, tet: &Tet, faces: &[Face]) -> bool {
        let around = Aabb::around(self.points, tet);
        let near = |f: &Face| Aabb::around(self.points, f).overlaps(&around);
        !faces.iter().any(|f| near(f) && tet_crosses_face(self.points, tet, *f))
    }

    /// Apexes for `face` that fit, those that make the roundest tetrahedra first.
    fn choices(&self, face: Face, corners: &[u32], faces: &[Face]) -> Vec<u32> {
        let is_choice = |v: u32| {
            !face.contains(&v) && orient(self.points, face, v) < 0.0 && self.fits(&tet_on(face, v), faces)
        };
        let mut apexes: Vec<u32> = corners.iter().copied().filter(|&v| is_choice(v)).collect();
        apexes.put_in_order_by(|&a, &b| reach(self.points, face, a).total_cmp(&reach(self.points, face, b)));
        apexes
    }

    fn fill(&mut self, front: Vec<Open>) -> bool {
        let Some(tightest) = front.iter().min_by_key(|open| open.apexes.len()) else { return true };
        for &apex in &tightest.apexes {
            if self.budget == 0 {
                return false;
            }
            self.budget -= 1;
            let tet = tet_on(tightest.face, apex);
            self.placed.push(tet);
            if let Some(rest) = self.after(&front, &tet)
                && self.fill(rest)
            {
                return true;
            }
            self.placed.pop();
        }
        false
    }

    /// The front with `tet` placed; `None` if some face is left without an apex.
    fn after(&self, front: &[Open], tet: &Tet) -> Option<Vec<Open>> {
        let sides = faces_of(tet);
        let mut rest: Vec<Open> = front.iter().filter(|open| !sides.contains(&open.face)).cloned().collect();
        let is_old = |side: &Face| front.iter().any(|open| open.face == *side);
        let new: Vec<Face> = sides.iter().filter(|side| !is_old(side)).map(|&side| reversed(side)).collect();
        for open in &mut rest {
            open.apexes.retain(|&v| self.fits(&tet_on(open.face, v), &new));
            if open.apexes.is_empty() {
                return None;
            }
        }
        let faces: Vec<Face> = rest.iter().map(|open| open.face).chain(new.iter().copied()).collect();
        let mut corners: Vec<u32> = faces.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        for face in new {
            let apexes = self.choices(face, &corners, &faces);
            if apexes.is_empty() {
                return None;
            }
            rest.push(Open { face, apexes });
        }
        Some(rest)
    }
}
