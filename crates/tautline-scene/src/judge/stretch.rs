//! How much longer than at rest edges are.

use tautline::{DVec3, Vec3};

use super::Sheet;

/// An edge of a cloth or a segment of a rope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Indices of its ends.
    pub ends: [u32; 2],
    /// In m.
    pub rest_length: f64,
}

/// Length over rest length − 1, over some edges: above 0 for those that are too long.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Stretch {
    /// Of the edge that is stretched most.
    pub max: f64,
    /// Over all edges; those that are too short count as negative.
    pub mean: f64,
}

/// How far edges between these positions (m) are stretched; 0 without edges, and not a number if a length is not or an
/// end is missing.
pub fn stretch(positions: &[Vec3], edges: &[Edge]) -> Stretch {
    let place = |end: u32| positions.get(end as usize).map_or(DVec3::NAN, |p| p.as_dvec3());
    let (mut max, mut sum) = (f64::NEG_INFINITY, 0.0);
    for Edge { ends: [a, b], rest_length } in edges {
        let stretch = place(*a).distance(place(*b)) / rest_length - 1.0;
        // `max` would take a NaN for nothing.
        max = if stretch <= max { max } else { stretch };
        sum += stretch;
    }
    if edges.is_empty() {
        return Stretch::default();
    }
    let mean = sum / edges.len() as f64;
    Stretch { max: if mean.is_nan() { mean } else { max }, mean }
}

/// The edges along the rows and columns of a rectangular grid, without diagonals: `columns` × `rows` particles over
/// `width` × `depth` m, particle `row·columns + column`.
pub fn grid_edges(columns: u32, rows: u32, width: f64, depth: f64) -> Vec<Edge> {
    let across = width / f64::from(columns.saturating_sub(1).max(1));
    let along = depth / f64::from(rows.saturating_sub(1).max(1));
    let mut edges = Vec::new();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let here = row * columns + column;
        if column + 1 < columns {
            edges.push(Edge { ends: [here, here + 1], rest_length: across });
        }
        if row + 1 < rows {
            edges.push(Edge { ends: [here, here + columns], rest_length: along });
        }
    }
    edges
}

/// The segments of a rope of this length (m), all alike.
pub fn rope_edges(segments: u32, length: f64) -> Vec<Edge> {
    let rest_length = length / f64::from(segments.max(1));
    (0..segments).map(|i| Edge { ends: [i, i + 1], rest_length }).collect()
}

/// All edges of a sheet, each once, at rest as it lies; without those of triangles with a corner that is missing or not
/// finite.
pub fn sheet_edges(at_rest: Sheet<'_>) -> Vec<Edge> {
    let mut edges: Vec<Edge> = Vec::new();
    for &triangle in at_rest.triangles {
        let Some([a, b, c]) = at_rest.corners(triangle) else { continue };
        let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
        let [i, j, k] = triangle;
        let sides = [([i, j], a.distance(b)), ([j, k], b.distance(c)), ([k, i], c.distance(a))];
        edges.extend(sides.map(|([i, j], rest_length)| Edge { ends: [i.min(j), i.max(j)], rest_length }));
    }
    edges.sort_by_key(|edge| edge.ends);
    edges.dedup_by_key(|edge| edge.ends);
    edges
}

#[cfg(test)]
mod tests {
    use tautline::mesh::primitives;

    use super::*;

    #[test]
    fn a_grid_pulled_along_x_is_stretched_in_its_rows() {
        let grid = primitives::grid(5, 4, 2.0, 1.5).unwrap();
        let edges = grid_edges(5, 4, 2.0, 1.5);
        assert_eq!(edges.len(), 4 * 4 + 5 * 3);
        let pulled: Vec<Vec3> = grid.positions.iter().map(|p| *p * Vec3::new(1.25, 1.0, 1.0)).collect();
        let found = stretch(&pulled, &edges);
        assert!((found.max - 0.25).abs() < 1e-6, "{found:?}");
        assert!((found.mean - 0.25 * 16.0 / 31.0).abs() < 1e-6, "{found:?}");
        let shrunk: Vec<Vec3> = grid.positions.iter().map(|p| *p * 0.5).collect();
        let found = stretch(&shrunk, &edges);
        assert!((found.max + 0.5).abs() < 1e-6 && (found.mean + 0.5).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn a_sheet_has_each_edge_once_and_with_its_own_length() {
        let grid = primitives::grid(5, 4, 2.0, 1.5).unwrap();
        let sheet = Sheet { positions: &grid.positions, triangles: &grid.triangles };
        let edges = sheet_edges(sheet);
        assert_eq!(edges.len(), 4 * 4 + 5 * 3 + 4 * 3, "and the diagonals");
        let found = stretch(&grid.positions, &edges);
        assert!(found.max.abs() < 1e-12 && found.mean.abs() < 1e-12);
    }

    #[test]
    fn a_rope_drawn_out_to_a_third_more() {
        let rope = primitives::polyline(Vec3::ZERO, Vec3::Y * 4.0, 11).unwrap();
        let found = stretch(&rope, &rope_edges(10, 3.0));
        assert!((found.max - 1.0 / 3.0).abs() < 1e-6 && (found.mean - found.max).abs() < 1e-6);
    }

    #[test]
    fn what_is_no_number_or_missing_is_no_number_and_nothing_is_0() {
        let edges = rope_edges(2, 2.0);
        for positions in [vec![Vec3::NAN, Vec3::X, Vec3::X * 9.0], vec![Vec3::ZERO, Vec3::X]] {
            let found = stretch(&positions, &edges);
            assert!(found.max.is_nan() && found.mean.is_nan(), "{found:?}");
        }
        assert_eq!(stretch(&[], &[]), Stretch::default());
    }
}
