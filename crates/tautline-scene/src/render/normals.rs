//! Normals of flat and of smooth surfaces.

use tautline::Vec3;

/// Unit normal of a triangle counter-clockwise seen from outside; zero where it has no area.
pub(crate) fn face_normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// Unit normals at the vertices: the mean of the adjoining faces' normals, weighted by area. Up where a vertex
/// has no face or its faces cancel, because files need unit normals everywhere.
pub(crate) fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; positions.len()];
    for &triangle in triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let doubled_area = (b - a).cross(c - a);
        for vertex in triangle {
            normals[vertex as usize] += doubled_area;
        }
    }
    normals.iter().map(|n| n.normalize_or(Vec3::Y)).collect()
}
