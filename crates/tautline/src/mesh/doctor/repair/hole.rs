//! Small holes are filled by the triangles of least area in all (Barequet and Sharir 1995, Filling gaps in the boundary
//! of a polyhedron).

use glam::DVec3;

use super::super::crossing::crossings;
use super::super::edges::{Side, of_edge, sides};
use super::super::loops::chains;
use super::patient::Patient;
use super::{Action, RepairOptions};
use crate::mesh::TriMesh;
use crate::mesh::exact;

/// A rim and the triangles over it.
struct Filling {
    rim: Vec<u32>,
    triangles: Vec<[u32; 3]>,
}

/// Fills every loop of open edges whose filling is small enough and crosses nothing.
pub(super) fn fill(patient: &mut Patient, options: &RepairOptions) {
    let surface = patient.surface();
    let rims = chains(&surface.open(), patient.mesh.positions.len());
    let areas = areas(&patient.mesh, &surface.first_of_component());
    let sides = sides(&patient.mesh.triangles, &vec![true; patient.mesh.triangles.len()]);
    let mut fillings = Vec::new();
    for rim in rims.into_iter().filter(|rim| rim.is_loop && rim.vertices.len() <= options.hole_edges) {
        let component = of_edge(&sides, [rim.vertices[0], rim.vertices[1]])
            .first()
            .map_or(0.0, |side| areas[side.triangle() as usize]);
        if let Some((area, triangles)) = least_area(&patient.mesh, &rim.vertices, &sides)
            && area <= options.hole_share * component
        {
            fillings.push(Filling { rim: rim.vertices, triangles });
        }
    }
    if !fillings.is_empty() {
        add_what_crosses_nothing(patient, fillings);
    }
}

/// The area of each triangle's component, in m².
fn areas(mesh: &TriMesh, first_of_component: &[u32]) -> Vec<f64> {
    let mut sums = vec![0.0; mesh.triangles.len()];
    for (&triangle, &first) in mesh.triangles.iter().zip(first_of_component) {
        sums[first as usize] += area(mesh, triangle);
    }
    first_of_component.iter().map(|&first| sums[first as usize]).collect()
}

fn area(mesh: &TriMesh, triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
    exact::twice_area_squared(a, b, c).sqrt() / 2.0
}

/// The least area that triangles over a loop can have, and those triangles, against the direction of the loop. None of
/// them is without area, and no new edge is one that the mesh has.
fn least_area(mesh: &TriMesh, rim: &[u32], sides: &[Side]) -> Option<(f64, Vec<[u32; 3]>)> {
    let n = rim.len();
    // Of the part from i to j: the least area, and the corner over the side (i, j) that gives it.
    let mut best = vec![(0.0, 0_usize); n * n];
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            let is_rim = length == n - 1;
            best[i * n + j] = (f64::INFINITY, i);
            if !is_rim && !of_edge(sides, [rim[i], rim[j]]).is_empty() {
                continue;
            }
            for k in i + 1..j {
                let parts = best[i * n + k].0 + best[k * n + j].0;
                if parts < best[i * n + j].0 {
                    let own = area(mesh, [rim[j], rim[k], rim[i]]);
                    if own > 0.0 && parts + own < best[i * n + j].0 {
                        best[i * n + j] = (parts + own, k);
                    }
                }
            }
        }
    }
    let (area, _) = best[n - 1];
    let mut triangles = Vec::with_capacity(n - 2);
    let mut waiting = vec![(0, n - 1)];
    while let Some((i, j)) = waiting.pop().filter(|_| area.is_finite()) {
        if j - i > 1 {
            let k = best[i * n + j].1;
            triangles.push([rim[j], rim[k], rim[i]]);
            waiting.extend([(k, j), (i, k)]);
        }
    }
    (area.is_finite() && n > 2).then_some((area, triangles))
}

/// Adds all fillings, looks for crossings, and takes away those that cross something before them.
fn add_what_crosses_nothing(patient: &mut Patient, mut fillings: Vec<Filling>) {
    let before = patient.mesh.triangles.len();
    let mut belongs = Vec::new();
    for (number, filling) in fillings.iter().enumerate() {
        filling.triangles.iter().for_each(|&triangle| patient.add(triangle));
        belongs.resize(belongs.len() + filling.triangles.len(), number);
    }
    let surface = patient.surface();
    let has_area: Vec<bool> =
        patient.mesh.triangles.iter().map(|&triangle| area(&patient.mesh, triangle) > 0.0).collect();
    let points: &[DVec3] = surface.points();
    let found = crossings(points, &surface.welded_triangles(), &has_area, before as u32);
    let mut is_crossed = vec![false; fillings.len()];
    for [_, later] in found.pairs {
        is_crossed[belongs[later as usize - before]] = true;
    }
    patient.truncate(before);
    let mut crossed = is_crossed.iter();
    fillings.retain(|_| crossed.next() == Some(&false));
    for filling in fillings {
        filling.triangles.iter().for_each(|&triangle| patient.add(triangle));
        let vertices = filling.rim.iter().map(|&vertex| patient.was(vertex)).collect();
        patient.act(Action::Filled { vertices, triangles: filling.triangles.len() });
    }
}
