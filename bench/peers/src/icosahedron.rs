//! The one shape of all scenes: a regular icosahedron in a sphere of radius 0.5 m.

use glam::DVec3;

/// Of the sphere through the vertices, in m.
pub(crate) const RADIUS: f64 = 0.5;

/// 4 φ² / (10 (1 + φ²)) · R², with the edge a = 2R / √(1 + φ²) and I = m φ² a² / 10, in m².
pub(crate) const INERTIA_PER_MASS: f64 = 0.4 * PHI * PHI / (1.0 + PHI * PHI) * RADIUS * RADIUS;

const PHI: f64 = 1.618_033_988_749_895;

/// One of each pair of opposite vertices, in m from the centre.
pub(crate) fn half_vertices() -> [DVec3; 6] {
    let rectangle = [(1.0, PHI), (-1.0, PHI)];
    let axes = rectangle.map(|(a, b)| [DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)]);
    let scale = RADIUS / (1.0 + PHI * PHI).sqrt();
    let [[a, b, c], [d, e, f]] = axes;
    [a, b, c, d, e, f].map(|axis| axis * scale)
}

/// All twelve vertices, in m from the centre.
pub(crate) fn vertices() -> Vec<DVec3> {
    half_vertices().into_iter().flat_map(|vertex| [vertex, -vertex]).collect()
}

/// 5 (3 + √5) a³ / 12, in m³.
pub(crate) fn volume() -> f64 {
    let edge = edge_length();
    5.0 * (3.0 + 5f64.sqrt()) / 12.0 * edge * edge * edge
}

/// Unit normals of the faces, one of each pair of opposite ones: 10.
pub(crate) fn face_normals() -> Vec<DVec3> {
    let vertices = vertices();
    let mut sums = Vec::new();
    for (i, &a) in vertices.iter().enumerate() {
        for (j, &b) in vertices.iter().enumerate().skip(i + 1).filter(|&(_, &b)| is_edge(a, b)) {
            let thirds = vertices[j + 1..].iter().filter(|&&c| is_edge(a, c) && is_edge(b, c));
            sums.extend(thirds.map(|&c| a + b + c));
        }
    }
    one_of_opposites(sums)
}

/// Unit vectors along the edges, one of each pair of parallel ones: 15.
pub(crate) fn edge_directions() -> Vec<DVec3> {
    let vertices = vertices();
    let edges = vertices.iter().enumerate().flat_map(|(i, &a)| {
        let others = vertices[i + 1..].iter().filter(move |&&b| is_edge(a, b));
        others.map(move |&b| b - a)
    });
    one_of_opposites(edges.collect())
}

fn edge_length() -> f64 {
    2.0 * RADIUS / (1.0 + PHI * PHI).sqrt()
}

fn is_edge(a: DVec3, b: DVec3) -> bool {
    (a.distance(b) - edge_length()).abs() < 1e-9
}

fn one_of_opposites(vectors: Vec<DVec3>) -> Vec<DVec3> {
    let mut found: Vec<DVec3> = Vec::new();
    for unit in vectors.into_iter().map(DVec3::normalize) {
        if found.iter().all(|other| other.dot(unit).abs() < 1.0 - 1e-9) {
            found.push(unit);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_an_icosahedron() {
        assert_eq!(vertices().len(), 12);
        assert_eq!(face_normals().len(), 10);
        assert_eq!(edge_directions().len(), 15);
        assert!(vertices().iter().all(|vertex| (vertex.length() - RADIUS).abs() < 1e-12));
    }

    #[test]
    fn volume_and_inertia_are_those_of_its_twenty_tetrahedra() {
        let vertices = vertices();
        let normal = face_normals()[0];
        let inner = vertices.iter().map(|v| v.dot(normal)).fold(0.0, f64::max);
        let edge = edge_length();
        let tetrahedron = 3f64.sqrt() / 4.0 * edge * edge * inner / 3.0;
        assert!((20.0 * tetrahedron - volume()).abs() < 1e-12);
        // Of a tetrahedron with one vertex at the origin, ∫|x|² dV = V/20 (Σ|v|² + |Σv|²); I = 2/3 of it.
        let square_of_sum = (3.0 * inner) * (3.0 * inner);
        let mean_square = (3.0 * RADIUS * RADIUS + square_of_sum) / 20.0;
        assert!((INERTIA_PER_MASS - 2.0 / 3.0 * mean_square).abs() < 1e-12);
    }
}
