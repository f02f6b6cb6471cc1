//! Brute force in f64: the separation along an axis, and the largest over all axes that can have it.

use glam::{DMat3, DVec3, Vec3};

use crate::geometry::distance::distance;
use crate::geometry::manifold::Placement;
use crate::shape::Convex;

/// Corners of B in A's frame.
fn corners_of_b(b: &Convex, b_in_a: &Placement) -> Vec<DVec3> {
    let rotation: DMat3 = b_in_a.rotation.as_dmat3();
    b.vertices.iter().map(|v| rotation * v.as_dvec3() + b_in_a.translation.as_dvec3()).collect()
}

fn corners(convex: &Convex) -> Vec<DVec3> {
    convex.vertices.iter().map(|v| v.as_dvec3()).collect()
}

/// How far the surface of B lies beyond that of A along an axis of A's frame.
pub(super) fn separation(a: &Convex, b: &Convex, b_in_a: &Placement, axis: Vec3) -> f64 {
    let axis = axis.as_dvec3().normalize();
    along(&corners(a), &corners_of_b(b, b_in_a), axis) - f64::from(a.radius + b.radius)
}

fn along(a: &[DVec3], b: &[DVec3], axis: DVec3) -> f64 {
    let highest = a.iter().map(|p| p.dot(axis)).fold(f64::NEG_INFINITY, f64::max);
    let lowest = b.iter().map(|p| p.dot(axis)).fold(f64::INFINITY, f64::min);
    lowest - highest
}

/// The signed distance of the surfaces: of cores apart by GJK in f64, of overlapping ones by all axes.
pub(super) fn signed_distance(a: &Convex, b: &Convex, b_in_a: &Placement) -> f64 {
    let (p, q) = (corners(a), corners_of_b(b, b_in_a));
    let radii = f64::from(a.radius + b.radius);
    let least = least_depth(a, b, (&p, &q), b_in_a);
    if least > 0.0 || !least.is_finite() {
        let placed: Vec<Vec3> = q.iter().map(|v| v.as_vec3()).collect();
        return f64::from(distance(&a.vertices, &placed).expect("finite").distance) - radii;
    }
    least - radii
}

/// The largest separation over normals of faces and products of edges; −∞ if there are none.
fn least_depth(a: &Convex, b: &Convex, (p, q): (&[DVec3], &[DVec3]), b_in_a: &Placement) -> f64 {
    let rotation = b_in_a.rotation.as_dmat3();
    let (edges_a, edges_b) = (edges(a, p), edges(b, q));
    let mut axes: Vec<DVec3> = a.faces.iter().map(|face| face.normal.as_dvec3()).collect();
    axes.extend(b.faces.iter().map(|face| rotation * face.normal.as_dvec3()));
    for &e in &edges_a {
        axes.extend(edges_b.iter().map(|&f| e.cross(f)).filter(|n| n.length() > 1e-6 * e.length()));
    }
    let both = axes.iter().map(|n| n.normalize()).flat_map(|n| [n, -n]);
    both.map(|n| along(p, q, n)).fold(f64::NEG_INFINITY, f64::max)
}

fn edges(convex: &Convex, points: &[DVec3]) -> Vec<DVec3> {
    if convex.vertices.len() == 2 {
        return vec![points[1] - points[0]];
    }
    let mut edges = Vec::new();
    for &face in &convex.faces {
        let ids: Vec<usize> = convex.corners(face).map(|(id, _)| usize::from(id)).collect();
        for k in 0..ids.len() {
            let (i, j) = (ids[k], ids[(k + 1) % ids.len()]);
            // Each edge has two faces, which go along it either way.
            if i < j {
                edges.push(points[j] - points[i]);
            }
        }
    }
    edges
}
