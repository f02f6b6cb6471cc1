//! Triangles that cross or touch elsewhere than in common corners and edges.

use glam::DVec3;

use crate::geometry::box_tree::{Bounds, BoxTree};
use crate::mesh::tetrahedra::predicates::faces_cross;
use crate::order::PutInOrder;

/// Pairs that are named one by one; a soup has more than anybody reads.
const MOST_FOUND: usize = 1000;
/// Boxes over that of a triangle that are looked at, for every triangle: triangles heaped on each other have the square of
/// their number, and good meshes have about forty.
const MOST_LOOKS: usize = 1000;

/// Pairs of triangles that cross.
pub(super) struct Crossings {
    /// The lower triangle first, sorted.
    pub(super) pairs: Vec<[u32; 2]>,
    /// Whether there are no others.
    pub(super) is_complete: bool,
}

/// Looks at every pair of the included triangles, which must have areas, of which one is not below `from`. Vertices at
/// one place must have one number: surfaces that were parted there do not cross.
pub(super) fn crossings(points: &[DVec3], triangles: &[[u32; 3]], included: &[bool], from: u32) -> Crossings {
    let items: Vec<u32> =
        (0..triangles.len() as u32).filter(|&triangle| included[triangle as usize]).collect();
    let corners = |item: u32| triangles[items[item as usize] as usize];
    let boxes: Vec<Bounds> = (0..items.len() as u32)
        .map(|item| Bounds::around(corners(item).map(|vertex| points[vertex as usize])))
        .collect();
    let tree = BoxTree::new(&boxes);
    let mut pairs = Vec::new();
    let mut looks_left = items.len().saturating_mul(MOST_LOOKS);
    for (a, bounds) in (0..).zip(&boxes).filter(|&(a, _)| items[a as usize] >= from) {
        tree.overlapping(bounds, |b| {
            looks_left = looks_left.saturating_sub(1);
            if b < a && cross(points, corners(a), corners(b)) {
                pairs.push([items[b as usize], items[a as usize]]);
            }
            looks_left > 0 && pairs.len() < MOST_FOUND
        });
        if looks_left == 0 || pairs.len() == MOST_FOUND {
            break;
        }
    }
    pairs.put_in_order();
    Crossings { is_complete: looks_left > 0 && pairs.len() < MOST_FOUND, pairs }
}

/// Whether two triangles share more than a common corner or edge; two on the same corners do.
fn cross(points: &[DVec3], a: [u32; 3], b: [u32; 3]) -> bool {
    a.iter().all(|vertex| b.contains(vertex)) || faces_cross(points, a, b)
}
