//! Signs of areas and volumes without rounding.
//!
//! Coordinates are f32 and the predicates work in f64 (Shewchuk 1997, Adaptive precision floating-point
//! arithmetic and fast robust geometric predicates): no product of f32 differences over- or underflows there,
//! so every sign, and every zero, is exact.

use glam::Vec3;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Six times the signed volume of the tetrahedron (a, b, c, p), in m³: positive where p lies on the side from
/// which a, b, c run counter-clockwise. The sign is exact, the value is rounded.
pub(crate) fn height_above(a: Vec3, b: Vec3, c: Vec3, p: Vec3) -> f64 {
    -orient3d(coord(a), coord(b), coord(c), coord(p))
}

/// Four times the squared area of a triangle, in m⁴: zero exactly if its corners lie on one line, otherwise
/// rounded. The area vector's components are the areas of the three axis-aligned projections.
pub(crate) fn twice_area_squared(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let project = |i: usize, j: usize| {
        let at = |p: Vec3| Coord { x: f64::from(p[i]), y: f64::from(p[j]) };
        orient2d(at(a), at(b), at(c))
    };
    let (x, y, z) = (project(1, 2), project(2, 0), project(0, 1));
    x * x + y * y + z * z
}

fn coord(p: Vec3) -> Coord3D<f64> {
    Coord3D { x: f64::from(p.x), y: f64::from(p.y), z: f64::from(p.z) }
}
