//! Platonic solids and the cuboid. Opposite corners are each other's negatives, bit for bit.

use glam::{DVec3, Vec3, dvec3};

use super::{length, surface};
use crate::Error;
use crate::mesh::TriMesh;
use crate::norm::Norm;

/// (1 + √5) / 2.
const GOLDEN_RATIO: f64 = 1.618_033_988_749_895;

const P: f64 = GOLDEN_RATIO;
const Q: f64 = 1.0 / GOLDEN_RATIO;

const TETRAHEDRON: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
const TETRAHEDRON_FACES: [[u32; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];

const OCTAHEDRON: [[f64; 3]; 6] =
    [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
#[rustfmt::skip]
const OCTAHEDRON_FACES: [[u32; 3]; 8] =
    [[0, 4, 2], [0, 2, 5], [0, 3, 4], [0, 5, 3], [1, 2, 4], [1, 5, 2], [1, 4, 3], [1, 3, 5]];

const CUBE: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, 1.0, 1.0],
    [1.0, -1.0, -1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, 1.0, 1.0],
];
#[rustfmt::skip]
const CUBE_FACES: [[u32; 4]; 6] =
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

#[rustfmt::skip]
const ICOSAHEDRON: [[f64; 3]; 12] = [
    [0.0, -1.0, -P], [0.0, -1.0, P], [0.0, 1.0, -P], [0.0, 1.0, P],
    [-1.0, -P, 0.0], [-1.0, P, 0.0], [1.0, -P, 0.0], [1.0, P, 0.0],
    [-P, 0.0, -1.0], [-P, 0.0, 1.0], [P, 0.0, -1.0], [P, 0.0, 1.0],
];
#[rustfmt::skip]
pub(super) const ICOSAHEDRON_FACES: [[u32; 3]; 20] = [
    [0, 8, 2], [0, 2, 10], [0, 6, 4], [0, 4, 8], [0, 10, 6], [1, 3, 9], [1, 11, 3],
    [1, 4, 6], [1, 9, 4], [1, 6, 11], [2, 5, 7], [2, 8, 5], [2, 7, 10], [3, 7, 5],
    [3, 5, 9], [3, 11, 7], [4, 9, 8], [5, 8, 9], [6, 10, 11], [7, 11, 10],
];

#[rustfmt::skip]
const DODECAHEDRON: [[f64; 3]; 20] = [
    [-1.0, -1.0, -1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [-1.0, 1.0, 1.0],
    [1.0, -1.0, -1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0],
    [0.0, -Q, -P], [0.0, -Q, P], [0.0, Q, -P], [0.0, Q, P],
    [-Q, -P, 0.0], [-Q, P, 0.0], [Q, -P, 0.0], [Q, P, 0.0],
    [-P, 0.0, -Q], [-P, 0.0, Q], [P, 0.0, -Q], [P, 0.0, Q],
];
#[rustfmt::skip]
const DODECAHEDRON_FACES: [[u32; 5]; 12] = [
    [0, 8, 4, 14, 12], [0, 12, 1, 17, 16], [0, 16, 2, 10, 8], [1, 9, 11, 3, 17],
    [1, 12, 14, 5, 9], [2, 13, 15, 6, 10], [2, 16, 17, 3, 13], [3, 11, 7, 15, 13],
    [4, 8, 10, 6, 18], [4, 18, 19, 5, 14], [5, 19, 7, 11, 9], [6, 15, 7, 19, 18],
];

/// Regular tetrahedron in a sphere of this radius; its edge is √(8/3) radius.
///
/// # Errors
/// [`Error::OutOfRange`] if the radius is not finite or not above 0.
pub fn tetrahedron(radius: f32) -> Result<TriMesh, Error> {
    let radius = length("radius", radius)?;
    surface(&on_sphere(&TETRAHEDRON, radius), fans(&TETRAHEDRON_FACES))
}

/// Box from −`half_extents` to `half_extents`: 8 vertices, 12 triangles, 18 edges. Vertices count up with z
/// changing fastest, so that i and 7 − i are opposite.
///
/// # Errors
/// [`Error::OutOfRange`] if a half extent is not finite or not above 0.
pub fn cuboid(half_extents: Vec3) -> Result<TriMesh, Error> {
    let x = length("half_extents.x", half_extents.x)?;
    let y = length("half_extents.y", half_extents.y)?;
    let z = length("half_extents.z", half_extents.z)?;
    let corners = CUBE.map(|corner| DVec3::from(corner) * dvec3(x, y, z));
    surface(&corners, fans(&CUBE_FACES))
}

/// Cube with this side: the [`cuboid`] with half of it in each direction.
///
/// # Errors
/// [`Error::OutOfRange`] if the side is not finite or not above 0.
pub fn cube(side: f32) -> Result<TriMesh, Error> {
    length("side", side)?;
    cuboid(Vec3::splat(0.5 * side))
}

/// Regular octahedron with its corners on the axes at this radius; its edge is √2 radius.
///
/// # Errors
/// [`Error::OutOfRange`] if the radius is not finite or not above 0.
pub fn octahedron(radius: f32) -> Result<TriMesh, Error> {
    let radius = length("radius", radius)?;
    surface(&on_sphere(&OCTAHEDRON, radius), fans(&OCTAHEDRON_FACES))
}

/// Regular icosahedron in a sphere of this radius: 12 vertices, 20 triangles, 30 edges of length
/// radius / sin 72°. The body of the paper's first experiment.
///
/// # Errors
/// [`Error::OutOfRange`] if the radius is not finite or not above 0.
pub fn icosahedron(radius: f32) -> Result<TriMesh, Error> {
    let radius = length("radius", radius)?;
    surface(&icosahedron_corners(radius), fans(&ICOSAHEDRON_FACES))
}

/// Regular dodecahedron in a sphere of this radius, each pentagon a fan of three triangles: 20 vertices, 36
/// triangles; its edge is 2 radius / (√3 φ).
///
/// # Errors
/// [`Error::OutOfRange`] if the radius is not finite or not above 0.
pub fn dodecahedron(radius: f32) -> Result<TriMesh, Error> {
    let radius = length("radius", radius)?;
    surface(&on_sphere(&DODECAHEDRON, radius), fans(&DODECAHEDRON_FACES))
}

pub(super) fn icosahedron_corners(radius: f64) -> Vec<DVec3> {
    on_sphere(&ICOSAHEDRON, radius)
}

/// Corners of a regular solid, which are equally far from the origin, brought to this radius.
fn on_sphere(corners: &[[f64; 3]], radius: f64) -> Vec<DVec3> {
    let scale = radius / DVec3::from(corners[0]).norm();
    corners.iter().map(|&corner| DVec3::from(corner) * scale).collect()
}

/// Cuts convex polygons into triangles that share their first corner.
fn fans<const N: usize>(polygons: &[[u32; N]]) -> Vec<[u32; 3]> {
    let fan = |polygon: &[u32; N]| {
        let first = polygon[0];
        polygon[1..].windows(2).map(move |side| [first, side[0], side[1]]).collect::<Vec<_>>()
    };
    polygons.iter().flat_map(fan).collect()
}
