//! Triangles without area.

use super::super::diagnose::has_area;
use super::super::edges::{Side, of_edge, partners, sides};
use super::Why;
use super::patient::Patient;

/// Triangles without area may stand in each other's way: so often the rest is tried again.
const PASSES: usize = 16;

/// A triangle without area has its middle corner on its longest edge. Where the surface goes on beyond that edge, the
/// edge is swapped for the one between the middle corner and the corner across: the same surface, and both triangles
/// have an area. Where it does not, the triangle is dropped.
pub(super) fn give_area(patient: &mut Patient) {
    let mut swapped = Vec::new();
    let mut kept = vec![true; patient.mesh.triangles.len()];
    for _ in 0..PASSES {
        if !pass(patient, &mut kept, &mut swapped) {
            break;
        }
    }
    swapped.sort_unstable();
    swapped.dedup();
    swapped.retain(|&triangle| kept[triangle]);
    patient.note_swapped(&swapped);
    patient.keep(&kept, Why::NoArea);
}

/// Whether anything was done.
fn pass(patient: &mut Patient, kept: &mut [bool], swapped: &mut Vec<usize>) -> bool {
    let sides = sides(&patient.mesh.triangles, kept);
    let partners = partners(&patient.mesh.triangles, &sides);
    // What was changed in this pass has other sides than those above.
    let mut is_changed = vec![false; kept.len()];
    for triangle in 0..kept.len() {
        let corners = patient.mesh.triangles[triangle];
        if !kept[triangle] || is_changed[triangle] || has_area(&patient.mesh, corners) {
            continue;
        }
        let k = longest_side(patient, corners);
        let partner = partners[3 * triangle + k] as usize;
        if partner == u32::MAX as usize {
            if of_edge(&sides, [corners[k], corners[(k + 1) % 3]]).len() == 1 {
                kept[triangle] = false;
                is_changed[triangle] = true;
            }
        } else if !is_changed[partner / 3]
            && let Some([first, second]) = swap(patient, corners, k, partner, &sides)
        {
            patient.mesh.triangles[triangle] = first;
            patient.mesh.triangles[partner / 3] = second;
            is_changed[triangle] = true;
            is_changed[partner / 3] = true;
            swapped.push(triangle);
        }
    }
    is_changed.contains(&true)
}

/// The corner that the longest side begins at, of equals the first.
fn longest_side(patient: &Patient, corners: [u32; 3]) -> usize {
    let place = |k: usize| patient.mesh.positions[corners[k % 3] as usize].as_dvec3();
    let squared = [0, 1, 2].map(|k| place(k).distance_squared(place(k + 1)));
    (1..3).fold(0, |longest, k| if squared[k] > squared[longest] { k } else { longest })
}

/// The two triangles on the other diagonal; `None` if that is an edge already, or one of them would have no area.
fn swap(
    patient: &Patient,
    corners: [u32; 3],
    k: usize,
    partner: usize,
    sides: &[Side],
) -> Option<[[u32; 3]; 2]> {
    let [a, b, c] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
    let across = patient.mesh.triangles[partner / 3];
    // The two must agree: the other runs from b to a.
    let d = across[(partner + 2) % 3];
    if across[partner % 3] != b || d == c || !of_edge(sides, [c, d]).is_empty() {
        return None;
    }
    let swapped = [[c, a, d], [d, b, c]];
    swapped.iter().all(|&triangle| has_area(&patient.mesh, triangle)).then_some(swapped)
}
