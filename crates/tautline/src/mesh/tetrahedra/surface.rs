//! What a surface must be before its inside can be divided: proper triangles that meet only in common
//! corners and edges.

use glam::DVec3;

use super::boxes::{Aabb, overlapping_pairs};
use super::predicates::{Face, canonical, faces_cross, widest_axis};
use crate::mesh::TriMesh;
use crate::order::PutInOrder;
use crate::{Error, MeshDefect};

/// The mesh in the form the algorithms use: exact points and canonical faces.
///
/// # Errors
///
/// The first defect that would make "inside" meaningless. Manifoldness is left to the half-edge mesh,
/// except that every edge must be run along as often in one direction as in the other.
pub(super) fn checked(mesh: &TriMesh) -> Result<(Vec<DVec3>, Vec<Face>), Error> {
    if mesh.triangles.is_empty() {
        return Err(MeshDefect::Empty.into());
    }
    if let Some(vertex) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return Err(MeshDefect::NotFinite { vertex }.into());
    }
    let points: Vec<DVec3> = mesh.positions.iter().map(|p| p.as_dvec3()).collect();
    check_triangles(&points, &mesh.triangles)?;
    check_closed(&mesh.triangles)?;
    check_distinct(&points)?;
    let faces: Vec<Face> = mesh.triangles.iter().map(|&t| canonical(t)).collect();
    check_crossings(&points, &faces)?;
    let volume =
        faces.iter().map(|f| f.map(|v| points[v as usize])).map(|[a, b, c]| a.cross(b).dot(c) / 6.0).sum();
    if volume > 0.0 { Ok((points, faces)) } else { Err(MeshDefect::NotPositiveVolume { volume }.into()) }
}

fn check_triangles(points: &[DVec3], triangles: &[Face]) -> Result<(), MeshDefect> {
    let mut used = vec![false; points.len()];
    for (triangle, t) in triangles.iter().enumerate() {
        for &vertex in t {
            let slot = used.get_mut(vertex as usize);
            *slot.ok_or(MeshDefect::IndexOutOfRange { triangle, vertex, count: points.len() })? = true;
        }
        if widest_axis(points, *t).is_none() {
            return Err(MeshDefect::DegenerateTriangle { triangle });
        }
    }
    match used.iter().position(|&u| !u) {
        Some(vertex) => Err(MeshDefect::IsolatedVertex { vertex: vertex as u32 }),
        None => Ok(()),
    }
}

/// Every directed edge once, and once the other way round.
fn check_closed(triangles: &[Face]) -> Result<(), MeshDefect> {
    let mut edges: Vec<([u32; 2], usize)> = Vec::with_capacity(3 * triangles.len());
    for (i, &[a, b, c]) in triangles.iter().enumerate() {
        edges.extend([[a, b], [b, c], [c, a]].map(|e| (e, i)));
    }
    edges.put_in_order();
    if let Some(pair) = edges.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        let ([a, b], triangle) = pair[1];
        return Err(MeshDefect::FlippedTriangle { triangle, a, b });
    }
    let opposite = |[a, b]: [u32; 2]| edges.binary_search_by_key(&[b, a], |e| e.0).is_ok();
    match edges.iter().find(|(edge, _)| !opposite(*edge)) {
        Some(&([a, b], _)) => Err(MeshDefect::OpenEdge { a, b }),
        None => Ok(()),
    }
}

fn check_distinct(points: &[DVec3]) -> Result<(), MeshDefect> {
    let place = |&i: &usize| (points[i] + DVec3::ZERO).to_array().map(f64::to_bits); // −0 becomes 0
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.put_in_order_by_key(place);
    match order.windows(2).find(|pair| place(&pair[0]) == place(&pair[1])) {
        Some(pair) => Err(MeshDefect::Tetrahedralisation(format!(
            "vertices {} and {} are in the same place; merge them if the surface continues there, else part them",
            pair[0], pair[1]
        ))),
        None => Ok(()),
    }
}

fn check_crossings(points: &[DVec3], faces: &[Face]) -> Result<(), MeshDefect> {
    let boxes: Vec<Aabb> = faces.iter().map(|f| Aabb::around(points, f)).collect();
    let mut first: Option<(usize, usize)> = None;
    overlapping_pairs(&boxes, &boxes, |i, j| {
        if i < j && first.is_none_or(|found| (i, j) < found) && faces_cross(points, faces[i], faces[j]) {
            first = Some((i, j));
        }
    });
    match first {
        Some((i, j)) => Err(MeshDefect::Tetrahedralisation(format!(
            "triangles {i} and {j} cross or touch; part them, or join them along common edges"
        ))),
        None => Ok(()),
    }
}
