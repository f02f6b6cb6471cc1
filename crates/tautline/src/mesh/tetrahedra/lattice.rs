//! A box as a lattice of cells of six tetrahedra each.

use std::collections::BTreeSet;

use glam::Vec3;

use super::Tetrahedra;
use super::predicates::{faces_of, reversed};
use crate::Error;
use crate::mesh::primitives::cuboid;

/// Most cells along an axis.
const MOST_CELLS: u32 = 256;
const MOST_CELLS_IN_ALL: u64 = 1_000_000;

/// A box from −`half_extents` to `half_extents` (m) of so many cells along each axis. Every cell is divided into the six
/// tetrahedra around the diagonal from its lowest to its highest corner (Kuhn 1960), so that neighbours agree on their
/// common face. Point (i, j, k) has the number (k (n_y + 1) + j)(n_x + 1) + i; interior points are not the last ones.
///
/// # Errors
/// [`Error::OutOfRange`] if an extent is not a finite number above 0 or a count is not from 1 to 256; [`Error::Invalid`]
/// for more than a million cells.
pub fn lattice(half_extents: Vec3, cells: [u32; 3]) -> Result<Tetrahedra, Error> {
    // Its errors are those of these extents.
    cuboid(half_extents)?;
    for (axis, count) in ["x", "y", "z"].into_iter().zip(cells) {
        if !(1..=MOST_CELLS).contains(&count) {
            let (field, value) = (format!("cells.{axis}"), f64::from(count));
            return Err(Error::OutOfRange { field, value, expected: "a count from 1 to 256" });
        }
    }
    let total: u64 = cells.iter().map(|&count| u64::from(count)).product();
    if total > MOST_CELLS_IN_ALL {
        let problem = format!("{total} cells are more than {MOST_CELLS_IN_ALL}");
        return Err(Error::Invalid { field: "cells".into(), problem });
    }
    let number = |[x, y, z]: [u32; 3]| (z * (cells[1] + 1) + y) * (cells[0] + 1) + x;
    let size = half_extents * 2.0 / float(cells);
    let points = places(cells.map(|count| count + 1)).map(|at| float(at) * size - half_extents).collect();
    let cube = |low: [u32; 3]| {
        ORDERS.into_iter().map(move |[first, second]| {
            let (mut next, mut last) = (low, low);
            next[first] += 1;
            (last[first], last[second]) = (next[first], last[second] + 1);
            let corners = [low, next, last, low.map(|k| k + 1)].map(number);
            // Of the two ways round, that of a volume above 0.
            if (second + 3 - first) % 3 == 1 {
                corners
            } else {
                [corners[0], corners[2], corners[1], corners[3]]
            }
        })
    };
    let tetrahedra = places(cells).flat_map(cube).collect();
    let interior_points = cells.iter().map(|&count| count as usize - 1).product();
    Ok(Tetrahedra { points, tetrahedra, interior_points })
}

/// The axes along which one goes from the lowest corner of a cell to its highest: first and second.
const ORDERS: [[usize; 2]; 6] = [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]];

fn places([x, y, z]: [u32; 3]) -> impl Iterator<Item = [u32; 3]> {
    (0..z).flat_map(move |k| (0..y).flat_map(move |j| (0..x).map(move |i| [i, j, k])))
}

fn float(numbers: [u32; 3]) -> Vec3 {
    Vec3::from(numbers.map(|number| number as f32))
}

impl Tetrahedra {
    /// The faces that only one tetrahedron has, counter-clockwise seen from outside, in the order of their corners.
    pub fn surface(&self) -> Vec<[u32; 3]> {
        let mut faces = BTreeSet::new();
        for face in self.tetrahedra.iter().flat_map(faces_of) {
            if !faces.remove(&reversed(face)) {
                faces.insert(face);
            }
        }
        faces.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{HalfEdgeMesh, TriMesh};

    #[test]
    fn a_lattice_fills_its_box_and_its_surface_is_closed() {
        let half = Vec3::new(1.0, 0.5, 0.25);
        for cells in [[1, 1, 1], [2, 3, 1], [3, 4, 5]] {
            let solid = lattice(half, cells).unwrap();
            let [x, y, z] = cells.map(|count| count as usize);
            assert_eq!(solid.tetrahedra.len(), 6 * x * y * z);
            assert_eq!(solid.points.len(), (x + 1) * (y + 1) * (z + 1));
            assert_eq!(solid.interior_points, (x - 1) * (y - 1) * (z - 1));
            assert!((solid.volume() - 1.0).abs() < 1e-6, "{}", solid.volume());
            let triangles = solid.surface();
            assert_eq!(triangles.len(), 4 * (x * y + y * z + z * x));
            // All corners that are not inside, numbered anew.
            let mut outer: Vec<u32> = triangles.iter().flatten().copied().collect();
            outer.sort_unstable();
            outer.dedup();
            assert_eq!(outer.len() + solid.interior_points, solid.points.len());
            let renumbered = |corner: u32| outer.binary_search(&corner).unwrap() as u32;
            let mesh = TriMesh {
                positions: outer.iter().map(|&corner| solid.points[corner as usize]).collect(),
                triangles: triangles.iter().map(|triangle| triangle.map(renumbered)).collect(),
            };
            HalfEdgeMesh::from_mesh(&mesh).unwrap().require_closed().unwrap();
            let volume = crate::mesh::MassProperties::of(&mesh, 1.0).unwrap().volume;
            assert!((volume - 1.0).abs() < 1e-6, "its surface holds {volume} m³");
        }
    }

    #[test]
    fn no_angle_of_a_cube_is_below_45_degrees() {
        let solid = lattice(Vec3::new(1.0, 1.5, 0.5), [2, 3, 1]).unwrap();
        let least = solid.min_dihedral_angle();
        assert!((least - std::f64::consts::FRAC_PI_4).abs() < 1e-5, "{least} rad");
    }

    #[test]
    fn bad_numbers_are_refused() {
        for (half, cells, field) in [
            (Vec3::new(1.0, -1.0, 1.0), [1; 3], "half_extents.y"),
            (Vec3::ONE, [1, 0, 1], "cells.y"),
            (Vec3::ONE, [1, 1, 257], "cells.z"),
            (Vec3::ONE, [256, 256, 256], "cells"),
        ] {
            let refusal = lattice(half, cells).unwrap_err().to_string();
            assert!(refusal.starts_with(&format!("{field}: ")), "{refusal}");
        }
    }
}
