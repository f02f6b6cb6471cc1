//! Vertices that are one place become one vertex, where the surface is torn.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use super::Action;
use super::patient::Patient;
use crate::norm::Norm;
use crate::order::PutInOrder;

/// The distance of vertices that become one, as a share of the mesh's diagonal.
const SHARE: f64 = 1e-6;

/// Welds vertices on open edges that are near enough, and the ends of edges without length. Vertices inside closed
/// surfaces stay apart, so that solids that touch do not become one.
pub(super) fn weld(patient: &mut Patient, distance: Option<f32>) {
    let distance = distance.map_or_else(|| SHARE * diagonal(&patient.mesh.positions), f64::from).max(0.0);
    let candidates = candidates(patient);
    let positions = &patient.mesh.positions;
    let mut onto: Vec<u32> = (0..positions.len() as u32).collect();
    let mut kept: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    for vertex in candidates {
        let position = positions[vertex as usize].as_dvec3();
        let near = |&other: &u32| positions[other as usize].as_dvec3().distance_to(position) <= distance;
        let around = cells_around(position, distance);
        match around.iter().filter_map(|cell| kept.get(cell)).flatten().copied().filter(near).min() {
            Some(other) => onto[vertex as usize] = other,
            None => kept.entry(cell(position, distance)).or_default().push(vertex),
        }
    }
    let moved = (0..onto.len() as u32).filter(|&vertex| onto[vertex as usize] != vertex);
    let pairs: Vec<[u32; 2]> =
        moved.map(|vertex| [patient.was(vertex), patient.was(onto[vertex as usize])]).collect();
    if pairs.is_empty() {
        return;
    }
    patient.act(Action::Welded { pairs });
    patient.mesh.triangles.as_flattened_mut().iter_mut().for_each(|vertex| *vertex = onto[*vertex as usize]);
    patient.drop_without_three_corners();
}

/// Vertices on open edges, and those of edges without length, in order.
fn candidates(patient: &Patient) -> Vec<u32> {
    let mut candidates = patient.surface().open().into_flattened();
    let positions = &patient.mesh.positions;
    for &[a, b, c] in &patient.mesh.triangles {
        let ends = [[a, b], [b, c], [c, a]].into_iter();
        let short = ends.filter(|&[a, b]| positions[a as usize] == positions[b as usize]);
        candidates.extend(short.flatten());
    }
    candidates.sort_unstable();
    candidates.dedup();
    candidates
}

/// From corner to corner of the box around the vertices that are finite.
fn diagonal(positions: &[Vec3]) -> f64 {
    let finite = positions.iter().filter(|position| position.is_finite()).map(|position| position.as_dvec3());
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = finite.fold(nothing, |(low, high), p| (low.min(p), high.max(p)));
    if low.x <= high.x { low.distance_to(high) } else { 0.0 }
}

/// The cell of a grid as wide as the distance. Out of range, many places share a cell: that costs time only.
fn cell(position: DVec3, distance: f64) -> [i64; 3] {
    position.to_array().map(|coordinate| (coordinate / distance).floor() as i64)
}

/// Every cell in which something may be that near. With no distance only what is equal, −0 being 0.
fn cells_around(position: DVec3, distance: f64) -> Vec<[i64; 3]> {
    let middle = cell(position, distance);
    let mut cells = Vec::with_capacity(27);
    for offset in 0..27 {
        let step = [offset % 3 - 1, offset / 3 % 3 - 1, offset / 9 - 1];
        cells.push([0, 1, 2].map(|axis: usize| middle[axis].saturating_add(step[axis])));
    }
    cells.put_in_order();
    cells.dedup();
    cells
}
