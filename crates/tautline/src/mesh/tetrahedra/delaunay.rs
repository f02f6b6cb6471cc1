//! Delaunay tetrahedralisation of points: Bowyer and Watson's insertion, with a ghost vertex beyond the
//! hull (Shewchuk, "Lecture notes on Delaunay mesh generation", 2012).

use std::collections::HashMap;

use glam::DVec3;

use super::predicates::{Tet, face_of, in_sphere, orient, tet_on, widest_axis};
use crate::order::PutInOrder;

/// The vertex at infinity that closes every hull face to a ghost tetrahedron.
const GHOST: u32 = u32::MAX;

/// Tetrahedra with their neighbours; neighbour i lies across the face opposite corner i.
struct Delaunay<'a> {
    points: &'a [DVec3],
    tets: Vec<Tet>,
    neighbours: Vec<[usize; 4]>,
    /// The last insertion that reached this tetrahedron, and whether it was in conflict.
    visited: Vec<(usize, bool)>,
    removed: Vec<bool>,
    newest: usize,
}

/// The finite tetrahedra of the Delaunay triangulation; `None` if all points lie in one plane. Points
/// must be pairwise distinct.
pub(super) fn delaunay(points: &[DVec3]) -> Option<Vec<Tet>> {
    let mut order = spatial_order(points);
    let first = first_tet(points, &order)?;
    order.retain(|v| !first.contains(v));
    let mut mesh = Delaunay::around(points, first);
    for (round, &p) in order.iter().enumerate() {
        mesh.insert(p, round + 1);
    }
    let kept = mesh.tets.iter().zip(&mesh.removed).filter(|(t, removed)| !**removed && !t.contains(&GHOST));
    Some(kept.map(|(t, _)| *t).collect())
}

/// The points along a Morton curve, so that each is inserted next to the one before.
fn spatial_order(points: &[DVec3]) -> Vec<u32> {
    let min = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let max = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let scale = 1023.0 / (max - min).max_element().max(f64::MIN_POSITIVE);
    let key = |&i: &u32| {
        let cell = ((points[i as usize] - min) * scale).to_array().map(|x| x as u32);
        (0..10)
            .fold(0u32, |key, bit| (0..3).fold(key, |key, k| key | ((cell[k] >> bit) & 1) << (3 * bit + k)))
    };
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.put_in_order_by_cached_key(key);
    order
}

fn first_tet(points: &[DVec3], order: &[u32]) -> Option<Tet> {
    let (&a, rest) = order.split_first()?;
    let (&b, rest) = rest.split_first()?;
    let c = *rest.iter().find(|&&c| widest_axis(points, [a, b, c]).is_some())?;
    let d = *rest.iter().find(|&&d| orient(points, [a, b, c], d) != 0.0)?;
    Some(if orient(points, [a, b, c], d) > 0.0 { [a, b, c, d] } else { [a, c, b, d] })
}

impl<'a> Delaunay<'a> {
    fn around(points: &'a [DVec3], first: Tet) -> Delaunay<'a> {
        let mut tets = vec![first];
        for i in 0..4 {
            let [x, y, z] = face_of(&first, i);
            tets.push([x, y, z, GHOST]);
        }
        let mut mesh = Delaunay {
            points,
            neighbours: vec![[0; 4]; tets.len()],
            visited: vec![(0, false); tets.len()],
            removed: vec![false; tets.len()],
            tets,
            newest: 0,
        };
        mesh.neighbours[0] = [1, 2, 3, 4];
        mesh.link_around(&[1, 2, 3, 4]);
        mesh
    }

    /// Joins tetrahedra that share their last corner, across the faces that hold it.
    fn link_around(&mut self, fan: &[usize]) {
        let mut open: HashMap<[u32; 2], (usize, usize)> = HashMap::new();
        for &t in fan {
            for i in 0..3 {
                let (a, b) = (self.tets[t][(i + 1) % 3], self.tets[t][(i + 2) % 3]);
                if let Some((other, j)) = open.insert([a.min(b), a.max(b)], (t, i)) {
                    self.neighbours[t][i] = other;
                    self.neighbours[other][j] = t;
                }
            }
        }
    }

    fn conflicts(&self, t: usize, p: u32) -> bool {
        let tet = &self.tets[t];
        let Some(ghost) = tet.iter().position(|&v| v == GHOST) else { return in_sphere(self.points, tet, p) };
        // The hull face as the ghost sees it; a point in its plane is in conflict if it is within the
        // face's circle, which is where the neighbour's sphere cuts that plane.
        let side = orient(self.points, face_of(tet, ghost), p);
        side < 0.0 || (side == 0.0 && in_sphere(self.points, &self.tets[self.neighbours[t][ghost]], p))
    }

    /// A tetrahedron in conflict with `p`: a walk from the newest one towards it.
    fn locate(&self, p: u32) -> Option<usize> {
        let mut t = self.newest;
        if let Some(ghost) = self.tets[t].iter().position(|&v| v == GHOST) {
            t = self.neighbours[t][ghost];
        }
        for _ in 0..self.tets.len() {
            if self.tets[t].contains(&GHOST) {
                return Some(t);
            }
            let Some(i) = (0..4).find(|&i| orient(self.points, face_of(&self.tets[t], i), p) > 0.0) else {
                return Some(t);
            };
            t = self.neighbours[t][i];
        }
        (0..self.tets.len()).find(|&t| !self.removed[t] && self.conflicts(t, p))
    }

    fn insert(&mut self, p: u32, round: usize) {
        let Some(start) = self.locate(p) else { return };
        self.visited[start] = (round, true);
        let (mut stack, mut fan) = (vec![start], Vec::new());
        while let Some(t) = stack.pop() {
            self.removed[t] = true;
            for i in 0..4 {
                let n = self.neighbours[t][i];
                if self.visited[n].0 != round {
                    self.visited[n] = (round, self.conflicts(n, p));
                    if self.visited[n].1 {
                        stack.push(n);
                    }
                }
                if !self.visited[n].1 {
                    fan.push(self.cone(t, i, p));
                }
            }
        }
        self.link_around(&fan);
        self.newest = self.tets.len() - 1;
    }

    /// Joins face `i` of the removed tetrahedron `t` to `p`.
    fn cone(&mut self, t: usize, i: usize, p: u32) -> usize {
        let (new, outer) = (self.tets.len(), self.neighbours[t][i]);
        self.tets.push(tet_on(face_of(&self.tets[t], i), p));
        self.neighbours.push([outer; 4]);
        self.visited.push((0, false));
        self.removed.push(false);
        if let Some(back) = self.neighbours[outer].iter().position(|&n| n == t) {
            self.neighbours[outer][back] = new;
        }
        new
    }
}
