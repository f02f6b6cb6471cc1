//! Surfaces that meet in an edge or a point are parted (Guéziec, Taubin, Lazarus and Horn 2001, Cutting and stitching:
//! converting sets of polygons to manifold surfaces): every vertex is as many vertices as fans of triangles hang
//! together there.

use super::super::edges::{Side, by_edge, corners_at, partners, sides};
use super::super::groups::Groups;
use super::Action;
use super::patient::Patient;

/// Doubles vertices until every edge has at most two triangles and every vertex one fan, where that is possible.
pub(super) fn part(patient: &mut Patient) {
    let triangles = &patient.mesh.triangles;
    let sides = sides(triangles, &vec![true; triangles.len()]);
    let mut patches = Groups::new(triangles.len());
    for (half_edge, &partner) in partners(triangles, &sides).iter().enumerate() {
        if partner != u32::MAX {
            patches.join(half_edge as u32 / 3, partner / 3);
        }
    }
    let mut corners = Groups::new(3 * triangles.len());
    for sharing in by_edge(&sides) {
        for [forward, backward] in couples(triangles, sharing, &mut patches) {
            for end in [sharing[0].a, sharing[0].b] {
                let corner = |side: &Side| corners_at(triangles, side.half_edge, end);
                corners.join(corner(&forward), corner(&backward));
            }
        }
    }
    give_each_fan_a_vertex(patient, &mut corners);
}

/// The sides of an edge that go on in each other: one forward and one backward each, first those of one patch.
fn couples(triangles: &[[u32; 3]], sharing: &[Side], patches: &mut Groups) -> Vec<[Side; 2]> {
    let (forward, mut backward): (Vec<Side>, Vec<Side>) =
        sharing.iter().partition(|side| side.is_forward(triangles));
    let mut couples = Vec::new();
    let mut alone = Vec::new();
    for side in forward {
        let patch = patches.find(side.triangle());
        match backward.iter().position(|other| patches.find(other.triangle()) == patch) {
            Some(place) => couples.push([side, backward.remove(place)]),
            None => alone.push(side),
        }
    }
    couples.extend(alone.into_iter().zip(backward).map(|(a, b)| [a, b]));
    couples
}

/// The lowest fan of a vertex keeps it.
fn give_each_fan_a_vertex(patient: &mut Patient, corners: &mut Groups) {
    let count = 3 * patient.mesh.triangles.len();
    let mut is_taken = vec![false; patient.mesh.positions.len()];
    let mut vertex_of = vec![u32::MAX; count];
    let mut parted = Vec::new();
    for corner in 0..count {
        let fan = corners.find(corner as u32) as usize;
        let vertex = patient.mesh.triangles.as_flattened()[corner];
        // The lowest corner of a fan stands for it, so it comes first.
        if fan == corner {
            let is_second = std::mem::replace(&mut is_taken[vertex as usize], true);
            vertex_of[fan] = if is_second { patient.double(vertex) } else { vertex };
            if is_second {
                parted.push(patient.was(vertex));
            }
        }
        vertex_of[corner] = vertex_of[fan];
    }
    patient.mesh.triangles.as_flattened_mut().copy_from_slice(&vertex_of);
    if !parted.is_empty() {
        patient.act(Action::Parted { vertices: parted });
    }
}
