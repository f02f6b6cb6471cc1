//! What cloth and rope are made of.

use glam::{DVec3, Vec3, dvec3};

use super::{at_least_two, length, quad, surface};
use crate::Error;
use crate::mesh::TriMesh;

/// Most points of a [`polyline`].
const MAX_POINTS: u32 = 1 << 20;

/// Rectangle in the XZ plane, facing up, of `columns` × `rows` (2 – 1024 each) vertices: columns along X over
/// `width`, rows along Z over `depth`, vertex `row · columns + column`. Every cell is cut along the same diagonal,
/// from its corner of lowest x and z to the opposite one.
///
/// # Errors
/// [`Error::OutOfRange`] names the parameter.
pub fn grid(columns: u32, rows: u32, width: f32, depth: f32) -> Result<TriMesh, Error> {
    let (columns, rows) = (at_least_two("columns", columns)?, at_least_two("rows", rows)?);
    let (width, depth) = (length("width", width)?, length("depth", depth)?);
    let along = |place: u32, count: u32, size: f64| {
        size * (2.0 * f64::from(place) / f64::from(count - 1) - 1.0) * 0.5
    };
    let mut positions = Vec::with_capacity((columns * rows) as usize);
    let mut triangles = Vec::with_capacity(2 * ((columns - 1) * (rows - 1)) as usize);
    for row in 0..rows {
        for column in 0..columns {
            positions.push(dvec3(along(column, columns, width), 0.0, along(row, rows, depth)));
            if row + 1 < rows && column + 1 < columns {
                let corner = row * columns + column;
                triangles.extend(quad(corner, corner + columns, corner + columns + 1, corner + 1));
            }
        }
    }
    surface(&positions, triangles)
}

/// `points` (2 – 1 048 576) evenly spaced from `a` to `b`, both included: the particles of a rope.
///
/// # Errors
/// [`Error::OutOfRange`] names a coordinate or count; [`Error::Invalid`] if the ends are too close for that many
/// distinct points.
pub fn polyline(a: Vec3, b: Vec3, points: u32) -> Result<Vec<Vec3>, Error> {
    for (name, end) in [("a", a), ("b", b)] {
        if let Some(axis) = (0..3).find(|&axis| !end[axis].is_finite()) {
            let field = format!("{name}.{}", ["x", "y", "z"][axis]);
            return Err(Error::OutOfRange { field, value: end[axis].into(), expected: "a finite number" });
        }
    }
    if !(2..=MAX_POINTS).contains(&points) {
        let expected = "a count from 2 to 1048576";
        return Err(Error::OutOfRange { field: "points".into(), value: points.into(), expected });
    }
    let (start, end): (DVec3, DVec3) = (a.as_dvec3(), b.as_dvec3());
    let line: Vec<Vec3> = (0..points)
        .map(|point| start.lerp(end, f64::from(point) / f64::from(points - 1)).as_vec3())
        .collect();
    if line.windows(2).any(|pair| pair[0] == pair[1]) {
        let problem = format!("the ends are too close for {points} distinct points between them");
        return Err(Error::Invalid { field: "b".into(), problem });
    }
    Ok(line)
}
