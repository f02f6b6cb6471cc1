//! A solid partly filled with tetrahedra: what is placed, and the faces around what is still empty.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::boxes::Aabb;
use super::predicates::{Face, Tet, faces_of, reversed};
use crate::norm::Norm;

/// Tetrahedra placed so far, and the closed surface around the rest.
pub(super) struct Filling {
    tets: Vec<Option<Tet>>,
    /// Which tetrahedron has this outward face.
    owner: BTreeMap<Face, usize>,
    /// Outward faces of the empty part, canonical.
    front: BTreeSet<Face>,
}

/// An empty part of the solid, or one that is emptied to be filled differently.
#[derive(Clone)]
pub(super) struct Cavity {
    /// Outward faces, canonical.
    pub(super) faces: BTreeSet<Face>,
    /// Tetrahedra in it that must give way.
    pub(super) tets: BTreeSet<usize>,
}

/// Adds a tetrahedron's faces to those around an empty part that it leaves.
fn open(faces: &mut BTreeSet<Face>, tet: &Tet) {
    for face in faces_of(tet) {
        if !faces.remove(&reversed(face)) {
            faces.insert(face);
        }
    }
}

/// Takes a tetrahedron's faces from those around an empty part that it enters.
pub(super) fn close(faces: &mut BTreeSet<Face>, tet: &Tet) {
    for face in faces_of(tet) {
        if !faces.remove(&face) {
            faces.insert(reversed(face));
        }
    }
}

impl Filling {
    /// Nothing inside a surface.
    pub(super) fn new(surface: BTreeSet<Face>) -> Filling {
        Filling { tets: Vec::new(), owner: BTreeMap::new(), front: surface }
    }

    pub(super) fn front(&self) -> &BTreeSet<Face> {
        &self.front
    }

    pub(super) fn place(&mut self, tet: Tet) {
        close(&mut self.front, &tet);
        self.owner.extend(faces_of(&tet).map(|f| (f, self.tets.len())));
        self.tets.push(Some(tet));
    }

    /// Puts other tetrahedra in place of those in the cavity.
    pub(super) fn replace(&mut self, cavity: &Cavity, with: Vec<Tet>) {
        for &t in &cavity.tets {
            if let Some(tet) = self.tets[t].take() {
                open(&mut self.front, &tet);
                faces_of(&tet).iter().for_each(|f| {
                    self.owner.remove(f);
                });
            }
        }
        with.into_iter().for_each(|tet| self.place(tet));
    }

    /// The tetrahedra in the order of their placing.
    pub(super) fn tetrahedra(&self) -> Vec<Tet> {
        self.tets.iter().flatten().copied().collect()
    }

    /// The cavity that all tetrahedra around a vertex leave.
    pub(super) fn star(&self, vertex: u32) -> Cavity {
        let mut cavity = Cavity { faces: BTreeSet::new(), tets: BTreeSet::new() };
        for (t, tet) in self.tets.iter().enumerate() {
            if let Some(tet) = tet.filter(|tet| tet.contains(&vertex)) {
                open(&mut cavity.faces, &tet);
                cavity.tets.insert(t);
            }
        }
        cavity
    }

    /// The cavity with the tetrahedra beyond its faces added to it, as far as there are any. Those that
    /// also border on another empty part stay.
    pub(super) fn widened(&self, cavity: &Cavity) -> Cavity {
        let mut wide = cavity.clone();
        for &face in &cavity.faces {
            if wide.faces.contains(&face) {
                self.widen_across(&mut wide, face);
            }
        }
        wide
    }

    /// Adds the tetrahedron beyond one face; `false` if there is none, or it borders on another empty
    /// part.
    pub(super) fn widen_across(&self, cavity: &mut Cavity, face: Face) -> bool {
        let Some((t, tet)) = self.owner.get(&reversed(face)).and_then(|&t| Some((t, self.tets[t]?))) else {
            return false;
        };
        let borders_other = |f: Face| self.front.contains(&f) && !cavity.faces.contains(&f);
        let free = !faces_of(&tet).iter().any(|&f| borders_other(reversed(f)));
        if free && cavity.tets.insert(t) {
            open(&mut cavity.faces, &tet);
        }
        free
    }

    /// Corners of the cavity's tetrahedra that none of its faces has.
    pub(super) fn loose_vertices(&self, cavity: &Cavity) -> Vec<u32> {
        let bound = vertices(&cavity.faces);
        let mut corners = distinct(cavity.tets.iter().filter_map(|&t| self.tets[t]).flatten());
        corners.retain(|v| bound.binary_search(v).is_err());
        corners
    }

    /// The separate empty parts. Parts that lie within another's box without enclosing a volume of their
    /// own are voids in it and stay together with it.
    pub(super) fn cavities(&self, points: &[DVec3]) -> Vec<Cavity> {
        let mut parts = components(&self.front);
        let volume = |faces: &BTreeSet<Face>| -> f64 {
            let corners = faces.iter().map(|f| f.map(|v| points[v as usize]));
            corners.map(|[a, b, c]| a.cross(b).dot(c)).sum()
        };
        let bounds = |faces: &BTreeSet<Face>| Aabb::around(points, &vertices(faces));
        let (mut solid, voids): (Vec<_>, Vec<_>) = parts.drain(..).partition(|faces| volume(faces) > 0.0);
        for void in voids {
            let around = bounds(&void);
            let size = |faces: &BTreeSet<Face>| (bounds(faces).max - bounds(faces).min).norm();
            let containing = solid.iter_mut().filter(|faces| bounds(faces).contains(&around));
            if let Some(faces) = containing.min_by(|a, b| size(a).total_cmp(&size(b))) {
                faces.extend(void);
            }
        }
        solid.into_iter().map(|faces| Cavity { faces, tets: BTreeSet::new() }).collect()
    }
}

/// The corners of some faces, sorted.
pub(super) fn vertices(faces: &BTreeSet<Face>) -> Vec<u32> {
    distinct(faces.iter().flatten().copied())
}

/// Each number once, sorted.
pub(super) fn distinct(numbers: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut distinct: Vec<u32> = numbers.collect();
    distinct.sort_unstable();
    distinct.dedup();
    distinct
}

/// Faces that hang together by edges.
fn components(faces: &BTreeSet<Face>) -> Vec<BTreeSet<Face>> {
    let edges = |[a, b, c]: Face| [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]);
    let mut around: BTreeMap<[u32; 2], Vec<Face>> = BTreeMap::new();
    for &face in faces {
        edges(face).into_iter().for_each(|e| around.entry(e).or_default().push(face));
    }
    let mut parts = Vec::new();
    while let Some((_, seed)) = around.pop_first() {
        let (mut part, mut stack) = (BTreeSet::new(), seed);
        while let Some(face) = stack.pop() {
            if part.insert(face) {
                stack.extend(edges(face).iter().filter_map(|e| around.remove(e)).flatten());
            }
        }
        parts.push(part);
    }
    parts
}
