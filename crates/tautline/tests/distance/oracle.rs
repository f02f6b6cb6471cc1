//! Brute force: the signed distance of two hulls is the largest separation along any axis, and the axes that can
//! attain it are finitely many.

use tautline::{DVec3, Vec3};

/// The signed distance, in f64.
pub fn signed_distance(a: &[Vec3], b: &[Vec3]) -> f64 {
    let (a, b) = (
        a.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>(),
        b.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>(),
    );
    let mut best = f64::NEG_INFINITY;
    let mut attempt = |axis: DVec3| {
        let length = axis.length();
        if length > 0.0 {
            let axis = axis / length;
            best = best.max(separation(&a, &b, axis)).max(separation(&a, &b, -axis));
        }
    };
    let (edges_a, edges_b) = (edges(&a), edges(&b));
    for &p in &edges_a {
        edges_b.iter().for_each(|&q| attempt(p.cross(q)));
    }
    for (edges, own, other) in [(&edges_a, &a, &b), (&edges_b, &b, &a)] {
        face_normals(own, &mut attempt);
        for &edge in edges {
            // Sets on one line have no normals of their own: any axis across will do.
            DVec3::AXES.into_iter().for_each(|axis| attempt(edge.cross(axis)));
        }
        // The vertex of one against an edge of the other.
        for i in 0..own.len() {
            for j in 0..i {
                let edge = own[j] - own[i];
                other.iter().for_each(|&vertex| attempt(edge.cross(vertex - own[i]).cross(edge)));
            }
        }
    }
    for &p in &a {
        b.iter().for_each(|&q| attempt(q - p));
    }
    DVec3::AXES.into_iter().for_each(&mut attempt);
    best
}

/// How far B lies beyond A along a unit axis.
pub fn separation(a: &[DVec3], b: &[DVec3], axis: DVec3) -> f64 {
    let highest = a.iter().map(|p| p.dot(axis)).fold(f64::NEG_INFINITY, f64::max);
    let lowest = b.iter().map(|p| p.dot(axis)).fold(f64::INFINITY, f64::min);
    lowest - highest
}

fn edges(points: &[DVec3]) -> Vec<DVec3> {
    let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| points[j] - points[i]).collect()
}

fn face_normals(points: &[DVec3], attempt: &mut impl FnMut(DVec3)) {
    for i in 0..points.len() {
        for j in 0..i {
            for k in 0..j {
                attempt((points[j] - points[i]).cross(points[k] - points[i]));
            }
        }
    }
}
