//! The examination: first every triangle and vertex by itself, then the surface that the sound ones make.

use std::collections::BTreeMap;

use super::crossing::crossings;
use super::surface::Surface;
use super::{Defect, Report};
use crate::mesh::{TriMesh, exact};

/// Names everything that is wrong with a mesh, in O(n log n). Any numbers will do: nothing about the mesh is taken for
/// granted. Where triangles are heaped on each other by the hundred, not all that cross are named, nor all components that
/// are inside out.
pub fn diagnose(mesh: &TriMesh) -> Report {
    let mut defects = Vec::new();
    if mesh.triangles.is_empty() {
        defects.push(Defect::Empty);
    }
    let mut is_sound = triangles_with_corners(mesh, &mut defects);
    let has_area = triangles_with_area(mesh, &is_sound, &mut defects);
    leave_out_duplicates(mesh, &mut is_sound, &mut defects);
    defects.extend(isolated(mesh));

    let surface = Surface::new(mesh, is_sound);
    defects.extend(surface.unwelded());
    defects.extend(surface.non_manifold_edges());
    defects.extend(surface.turned_wrong());
    defects.extend(surface.bow_ties());
    defects.extend(surface.open_edges());

    let can_cross: Vec<bool> =
        has_area.iter().zip(surface.included()).map(|(&area, &sound)| area && sound).collect();
    let crossings = crossings(surface.points(), &surface.welded_triangles(), &can_cross, 0);
    defects.extend(crossings.pairs.into_iter().map(|triangles| Defect::Crossing { triangles }));
    let (components, inside_out) = surface.components();
    defects.extend(inside_out);
    Report {
        vertices: mesh.positions.len(),
        triangles: mesh.triangles.len(),
        defects,
        has_all_crossings: crossings.is_complete,
        components,
    }
}

/// Which triangles have three different corners that are there and finite.
fn triangles_with_corners(mesh: &TriMesh, defects: &mut Vec<Defect>) -> Vec<bool> {
    let not_finite = mesh.positions.iter().zip(0..).filter(|(position, _)| !position.is_finite());
    defects.extend(not_finite.map(|(_, vertex)| Defect::NotFinite { vertex }));
    let missing = mesh.triangles.iter().zip(0..).filter_map(|(corners, triangle)| {
        let vertex = corners.iter().copied().find(|&vertex| vertex as usize >= mesh.positions.len())?;
        Some(Defect::MissingVertex { triangle, vertex })
    });
    defects.extend(missing);
    mesh.triangles.iter().map(|&[a, b, c]| a != b && b != c && c != a && is_known(mesh, [a, b, c])).collect()
}

/// Whether a triangle's corners are there and finite.
pub(super) fn is_known(mesh: &TriMesh, triangle: [u32; 3]) -> bool {
    triangle
        .iter()
        .all(|&vertex| mesh.positions.get(vertex as usize).is_some_and(|position| position.is_finite()))
}

/// Which of the sound triangles have an area; the others are named, and those whose corners are not three.
fn triangles_with_area(mesh: &TriMesh, is_sound: &[bool], defects: &mut Vec<Defect>) -> Vec<bool> {
    let has_area: Vec<bool> = mesh
        .triangles
        .iter()
        .zip(is_sound)
        .map(|(&triangle, &sound)| sound && has_area(mesh, triangle))
        .collect();
    let flat = has_area
        .iter()
        .zip(&mesh.triangles)
        .zip(0..)
        .filter(|&((&area, &triangle), _)| !area && is_known(mesh, triangle));
    defects.extend(flat.map(|(_, triangle)| Defect::Degenerate { triangle }));
    has_area
}

/// Whether the corners of a triangle, which are there and finite, do not lie on one line.
pub(super) fn has_area(mesh: &TriMesh, triangle: [u32; 3]) -> bool {
    let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
    exact::twice_area_squared(a, b, c) != 0.0
}

/// Only the first of triangles with the same corners takes part in the surface.
fn leave_out_duplicates(mesh: &TriMesh, is_sound: &mut [bool], defects: &mut Vec<Defect>) {
    let mut seen: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    for (triangle, &corners) in mesh.triangles.iter().enumerate().filter(|&(triangle, _)| is_sound[triangle])
    {
        let mut sorted = corners;
        sorted.sort_unstable();
        let first = *seen.entry(sorted).or_insert(triangle as u32);
        if first != triangle as u32 {
            defects.push(Defect::Duplicate { triangle: triangle as u32, first });
        }
    }
    for defect in defects.iter() {
        if let Defect::Duplicate { triangle, .. } = defect {
            is_sound[*triangle as usize] = false;
        }
    }
}

fn isolated(mesh: &TriMesh) -> Vec<Defect> {
    let mut is_named = vec![false; mesh.positions.len()];
    for &vertex in mesh.triangles.as_flattened() {
        if let Some(named) = is_named.get_mut(vertex as usize) {
            *named = true;
        }
    }
    let isolated = is_named.iter().zip(0..).filter(|&(named, _)| !named);
    isolated.map(|(_, vertex)| Defect::Isolated { vertex }).collect()
}
