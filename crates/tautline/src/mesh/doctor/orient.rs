//! Which triangles run the wrong way round.

use crate::order::PutInOrder;

/// How the triangles of every patch, joined by edges of exactly two triangles, must turn to agree.
pub(super) struct Orientation {
    /// Whether a triangle runs against most of its patch.
    pub(super) is_flipped: Vec<bool>,
    /// Half-edges, the lower of two, where the sides disagree however the patch is turned: a Möbius strip.
    pub(super) conflicts: Vec<u32>,
}

/// Walks over every patch from its lowest triangle. Half of a patch against the other half: the lowest is right.
pub(super) fn orientation(triangles: &[[u32; 3]], partners: &[u32]) -> Orientation {
    let mut is_flipped = vec![false; triangles.len()];
    let mut is_known = vec![false; triangles.len()];
    let mut conflicts = Vec::new();
    let origin = triangles.as_flattened();
    for first in 0..triangles.len() {
        if std::mem::replace(&mut is_known[first], true) {
            continue;
        }
        let mut patch = vec![first];
        let mut next = 0;
        while let Some(&triangle) = patch.get(next) {
            next += 1;
            for half_edge in 3 * triangle..3 * triangle + 3 {
                let partner = partners[half_edge];
                if partner == u32::MAX {
                    continue;
                }
                let other = partner as usize / 3;
                // Two that run along their edge the same way must not both stay as they are.
                let differs = origin[half_edge] == origin[partner as usize];
                let wanted = is_flipped[triangle] != differs;
                if !std::mem::replace(&mut is_known[other], true) {
                    is_flipped[other] = wanted;
                    patch.push(other);
                } else if is_flipped[other] != wanted && (half_edge as u32) < partner {
                    conflicts.push(half_edge as u32);
                }
            }
        }
        let flipped = patch.iter().filter(|&&triangle| is_flipped[triangle]).count();
        if 2 * flipped > patch.len() {
            patch.iter().for_each(|&triangle| is_flipped[triangle] = !is_flipped[triangle]);
        }
    }
    conflicts.put_in_order();
    Orientation { is_flipped, conflicts }
}
