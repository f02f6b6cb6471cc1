//! Spheres, capsule, cylinder and torus: inscribed, so that vertices lie on the round surface.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};

use super::polyhedra::{ICOSAHEDRON_FACES, icosahedron_corners};
use super::{at_least_three, at_least_two, length, quad, surface};
use crate::Error;
use crate::mesh::{HalfEdgeMesh, TriMesh};
use crate::norm::Norm;

/// Most subdivisions of an [`icosphere`]: 163 842 vertices.
const MAX_SUBDIVISIONS: u32 = 7;

/// A point of the half plane that is turned around the Y axis.
#[derive(Clone, Copy)]
struct ProfilePoint {
    radius: f64,
    y: f64,
}

/// Sphere of `segments` (3 – 1024) meridians and `rings` (2 – 1024) bands from pole to pole. Vertices: the south
/// pole, the circles upwards, the north pole.
///
/// # Errors
/// [`Error::OutOfRange`] names the parameter.
pub fn uv_sphere(radius: f32, segments: u32, rings: u32) -> Result<TriMesh, Error> {
    let radius = length("radius", radius)?;
    let (segments, rings) = (at_least_three("segments", segments)?, at_least_two("rings", rings)?);
    let profile: Vec<ProfilePoint> =
        (0..=rings).map(|ring| from_south_pole(radius, ring, 2 * rings)).collect();
    revolve(&profile, segments)
}

/// Sphere of nearly equal triangles: an icosahedron whose triangles are divided in four, `subdivisions` (0 – 7)
/// times; 10 · 4ⁿ + 2 vertices. Opposite vertices are each other's negatives, bit for bit.
///
/// # Errors
/// [`Error::OutOfRange`] names the parameter.
pub fn icosphere(radius: f32, subdivisions: u32) -> Result<TriMesh, Error> {
    let radius = length("radius", radius)?;
    if subdivisions > MAX_SUBDIVISIONS {
        let value = f64::from(subdivisions);
        return Err(Error::OutOfRange {
            field: "subdivisions".into(),
            value,
            expected: "a count from 0 to 7",
        });
    }
    let mut positions = icosahedron_corners(radius);
    let mut triangles = ICOSAHEDRON_FACES.to_vec();
    for _ in 0..subdivisions {
        triangles = subdivide(&mut positions, &triangles, radius)?;
    }
    surface(&positions, triangles)
}

/// Cylinder from y = −`half_height` to `half_height` with a hemisphere at either end, each of `rings` (2 – 1024)
/// bands; `segments` (3 – 1024) around.
///
/// # Errors
/// [`Error::OutOfRange`] names the parameter.
pub fn capsule(radius: f32, half_height: f32, segments: u32, rings: u32) -> Result<TriMesh, Error> {
    let (radius, half_height) = (length("radius", radius)?, length("half_height", half_height)?);
    let (segments, rings) = (at_least_three("segments", segments)?, at_least_two("rings", rings)?);
    let cap = |from: u32, center: f64| {
        (from..=from + rings).map(move |ring| {
            let point = from_south_pole(radius, ring, 4 * rings);
            ProfilePoint { y: center + point.y, ..point }
        })
    };
    let profile: Vec<ProfilePoint> = cap(0, -half_height).chain(cap(rings, half_height)).collect();
    revolve(&profile, segments)
}

/// Cylinder from y = −`half_height` to `half_height`, `segments` (3 – 1024) around. Either end is a fan around a
/// vertex at its centre.
///
/// # Errors
/// [`Error::OutOfRange`] names the parameter.
pub fn cylinder(radius: f32, half_height: f32, segments: u32) -> Result<TriMesh, Error> {
    let (radius, half_height) = (length("radius", radius)?, length("half_height", half_height)?);
    let segments = at_least_three("segments", segments)?;
    let profile = [(0.0, -half_height), (radius, -half_height), (radius, half_height), (0.0, half_height)];
    revolve(&profile.map(|(radius, y)| ProfilePoint { radius, y }), segments)
}

/// Ring around the Y axis: a tube of `minor_radius` and `sides` (3 – 1024) around a circle of `major_radius` and
/// `segments` (3 – 1024).
///
/// # Errors
/// [`Error::OutOfRange`] names the parameter; the minor radius must be below the major one.
pub fn torus(major_radius: f32, minor_radius: f32, segments: u32, sides: u32) -> Result<TriMesh, Error> {
    let (major, minor) = (length("major_radius", major_radius)?, length("minor_radius", minor_radius)?);
    let (segments, sides) = (at_least_three("segments", segments)?, at_least_three("sides", sides)?);
    if minor >= major {
        let expected = "below the major radius";
        return Err(Error::OutOfRange { field: "minor_radius".into(), value: minor, expected });
    }
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for side in 0..sides {
        let (cos, sin) = cos_sin_of_turn(side, sides);
        positions.extend(circle(ProfilePoint { radius: major + minor * cos, y: minor * sin }, segments));
        push_band(&mut triangles, side * segments, (side + 1) % sides * segments, segments);
    }
    surface(&positions, triangles)
}

/// Turns a profile around the Y axis. It runs from the axis, upwards on the outside, to the axis; its ends become
/// single vertices.
fn revolve(profile: &[ProfilePoint], segments: u32) -> Result<TriMesh, Error> {
    let circles = profile.len() as u32 - 2;
    let top = 1 + circles * segments;
    let (first, last) = (profile[0], profile[profile.len() - 1]);
    let mut positions = vec![dvec3(0.0, first.y, 0.0)];
    for &point in &profile[1..profile.len() - 1] {
        positions.extend(circle(point, segments));
    }
    positions.push(dvec3(0.0, last.y, 0.0));

    let mut triangles = Vec::new();
    for segment in 0..segments {
        triangles.push([0, 1 + (segment + 1) % segments, 1 + segment]);
    }
    for band in 1..circles {
        push_band(&mut triangles, 1 + (band - 1) * segments, 1 + band * segments, segments);
    }
    for segment in 0..segments {
        let lower = top - segments;
        triangles.push([lower + segment, lower + (segment + 1) % segments, top]);
    }
    surface(&positions, triangles)
}

/// The quadrilaterals between two circles, given by their first vertices, the lower one first.
fn push_band(triangles: &mut Vec<[u32; 3]>, lower: u32, upper: u32, segments: u32) {
    for left in 0..segments {
        let right = (left + 1) % segments;
        triangles.extend(quad(lower + left, lower + right, upper + right, upper + left));
    }
}

/// Counter-clockwise seen from above, from the X axis on.
fn circle(point: ProfilePoint, segments: u32) -> impl Iterator<Item = DVec3> {
    (0..segments).map(move |segment| {
        let (cos, sin) = cos_sin_of_turn(segment, segments);
        dvec3(point.radius * cos, point.y, -point.radius * sin)
    })
}

/// The point `part / parts` of a turn from the south pole of a circle around the origin.
fn from_south_pole(radius: f64, part: u32, parts: u32) -> ProfilePoint {
    let (cos, sin) = cos_sin_of_turn(part, parts);
    ProfilePoint { radius: radius * sin, y: -radius * cos }
}

/// Cosine and sine of `part / parts` of a turn. The angle is brought to the first quadrant in whole numbers, so
/// that quarter turns are exact and the circle is as symmetric as its division.
fn cos_sin_of_turn(part: u32, parts: u32) -> (f64, f64) {
    let angle = FRAC_PI_2 * f64::from(4 * part % parts) / f64::from(parts);
    let (sin, cos) = libm::sincos(angle);
    match 4 * part / parts {
        0 => (cos, sin),
        1 => (-sin, cos),
        2 => (-cos, -sin),
        _ => (sin, -cos),
    }
}

/// Divides every triangle in four at its edges' midpoints, which are pushed out to the sphere. The midpoint of
/// edge e becomes vertex n + e.
fn subdivide(
    positions: &mut Vec<DVec3>,
    triangles: &[[u32; 3]],
    radius: f64,
) -> Result<Vec<[u32; 3]>, Error> {
    let count = positions.len() as u32;
    let mesh = HalfEdgeMesh::from_triangles(positions.len(), triangles)?;
    for [a, b] in mesh.edges() {
        let sum = positions[a as usize] + positions[b as usize];
        positions.push(sum * (radius / sum.norm()));
    }
    let mut quarters = Vec::with_capacity(4 * triangles.len());
    for &[a, b, c] in triangles {
        let midpoint = |a, b| mesh.edge_between(a, b).map_or(a, |edge| count + edge);
        let (ab, bc, ca) = (midpoint(a, b), midpoint(b, c), midpoint(c, a));
        quarters.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    Ok(quarters)
}
