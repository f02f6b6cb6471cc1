//! Which Delaunay tetrahedra can stay: those inside the surface that no triangle cuts.

use std::collections::HashMap;

use glam::DVec3;

use super::boxes::{Aabb, overlapping_pairs};
use super::predicates::{Face, Tet, faces_of, reversed, tet_crosses_face};

/// The tetrahedra that lie inside the surface and meet each of its triangles in a common corner, edge or
/// face, if at all.
pub(super) fn conforming(points: &[DVec3], surface: &[Face], tets: &[Tet]) -> Vec<Tet> {
    let owner: HashMap<Face, usize> =
        tets.iter().enumerate().flat_map(|(t, tet)| faces_of(tet).map(|f| (f, t))).collect();
    let is_present = |f: Face| owner.contains_key(&f) || owner.contains_key(&reversed(f));
    let missing: Vec<Face> = surface.iter().copied().filter(|&f| !is_present(f)).collect();
    let cut = cut_by(points, &missing, tets);

    // From every present triangle inwards, as far as the surface and the cut tetrahedra let us.
    let wall: HashMap<Face, ()> = surface.iter().map(|&f| (f, ())).collect();
    let mut inside = vec![false; tets.len()];
    let mut stack: Vec<usize> = surface.iter().filter_map(|f| owner.get(f).copied()).collect();
    while let Some(t) = stack.pop() {
        if cut[t] || inside[t] {
            continue;
        }
        inside[t] = true;
        let passable = faces_of(&tets[t]).into_iter().filter(|f| !wall.contains_key(f));
        stack.extend(passable.filter_map(|f| owner.get(&reversed(f))));
    }
    tets.iter().zip(&inside).filter(|(_, inside)| **inside).map(|(tet, _)| *tet).collect()
}

fn cut_by(points: &[DVec3], faces: &[Face], tets: &[Tet]) -> Vec<bool> {
    let face_boxes: Vec<Aabb> = faces.iter().map(|f| Aabb::around(points, f)).collect();
    let tet_boxes: Vec<Aabb> = tets.iter().map(|t| Aabb::around(points, t)).collect();
    let mut cut = vec![false; tets.len()];
    overlapping_pairs(&face_boxes, &tet_boxes, |f, t| {
        cut[t] = cut[t] || tet_crosses_face(points, &tets[t], faces[f]);
    });
    cut
}
