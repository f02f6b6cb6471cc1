//! Points that are carried along by tetrahedra: a coarse mesh that is simulated moves a fine one that is seen.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3, Vec3};

use super::Tetrahedra;
use crate::error::{Error, MeshDefect, all_coordinates};
use crate::geometry::closest::closest_on_triangle;
use crate::norm::Norm;

/// Tetrahedra with less than this share of their longest edge's cube, six times over, say nothing of the points around them.
const FLAT: f64 = 1e-6;

/// Where points lie in tetrahedra, as shares of their corners.
///
/// A point outside all of them goes with the nearest, as if that went on: its shares are then not all above 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Embedding {
    anchors: Vec<Anchor>,
    farthest_outside: f32,
}

/// One point: Σ wᵢ xᵢ over four corners, with Σ wᵢ = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Anchor {
    corners: [u32; 4],
    weights: [f32; 4],
}

impl Embedding {
    /// Finds the tetrahedron of each point (m), or the nearest one.
    ///
    /// # Errors
    ///
    /// [`Error::OutOfRange`] names a coordinate of `points` or `solid.points` that is not from −1e9 to 1e9, or a corner that is
    /// no point; [`MeshDefect::Flat`] if no tetrahedron has a volume.
    pub fn new(solid: &Tetrahedra, points: &[Vec3]) -> Result<Self, Error> {
        all_coordinates("points", points)?;
        all_coordinates("solid.points", &solid.points)?;
        let cells = Cells::new(solid)?;
        let (mut anchors, mut farthest_outside) = (Vec::with_capacity(points.len()), 0.0_f64);
        for point in points {
            let (cell, outside) = cells.nearest(point.as_dvec3());
            farthest_outside = farthest_outside.max(outside);
            let weights = cell.weights(point.as_dvec3()).map(|weight| weight as f32);
            anchors.push(Anchor { corners: cell.numbers, weights });
        }
        Ok(Self { anchors, farthest_outside: farthest_outside as f32 })
    }

    /// Where the points are (m), with the corners of the tetrahedra at `corners` (m): those of a
    /// [soft solid](crate::BodyView::positions) by and by. A corner that is not there counts as the origin.
    pub fn positions(&self, corners: &[Vec3]) -> Vec<Vec3> {
        let corner = |index: u32| corners.get(index as usize).copied().unwrap_or_default();
        let at = |anchor: &Anchor| {
            // From the first corner, so that nothing is lost far from the origin.
            let [first, others @ ..] = anchor.corners.map(corner);
            let shares = anchor.weights[1..].iter().zip(others);
            shares.fold(first, |sum, (&weight, other)| sum + (other - first) * weight)
        };
        self.anchors.iter().map(at).collect()
    }

    /// How far outside the tetrahedra the outermost point lay, in m.
    pub fn farthest_outside(&self) -> f32 {
        self.farthest_outside
    }
}

/// A tetrahedron.
struct Cell {
    numbers: [u32; 4],
    corners: [DVec3; 4],
    /// Of the edges from the first corner.
    inverse: DMat3,
}

/// All tetrahedra, and which of them are in each cube of a grid.
struct Cells {
    cells: Vec<Cell>,
    side: f64,
    grid: BTreeMap<[i64; 3], Vec<usize>>,
}

impl Cells {
    fn new(solid: &Tetrahedra) -> Result<Self, Error> {
        let mut cells = Vec::new();
        for (index, &numbers) in solid.tetrahedra.iter().enumerate() {
            if let Some(bad) = numbers.into_iter().find(|&n| n as usize >= solid.points.len()) {
                let (field, expected) = (format!("solid.tetrahedra[{index}]"), "an index into solid.points");
                return Err(Error::OutOfRange { field, value: bad.into(), expected });
            }
            cells.extend(Cell::new(numbers, numbers.map(|n| solid.points[n as usize].as_dvec3())));
        }
        if cells.is_empty() {
            return Err(MeshDefect::Flat { count: solid.points.len() }.into());
        }
        // Of the largest, so that none is in more than eight cubes.
        let side = cells.iter().map(Cell::extent).fold(0.0, f64::max);
        let mut grid: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (index, cell) in cells.iter().enumerate() {
            let [low, high] = cell.bounds().map(|corner| cube(corner, side));
            for place in cubes(low, high) {
                grid.entry(place).or_default().push(index);
            }
        }
        Ok(Self { cells, side, grid })
    }

    /// The first cell that holds the point, or else the first of the nearest, and how far that is, in m.
    fn nearest(&self, point: DVec3) -> (&Cell, f64) {
        let here = self.grid.get(&cube(point, self.side)).map_or(&[][..], Vec::as_slice);
        let holding = here.iter().map(|&index| &self.cells[index]).find(|cell| cell.holds(point));
        holding.map_or_else(|| self.nearest_outside(point), |cell| (cell, 0.0))
    }

    fn nearest_outside(&self, point: DVec3) -> (&Cell, f64) {
        let mut best = (&self.cells[0], f64::INFINITY);
        for cell in &self.cells {
            // The distance from the box around it is less, and quickly found.
            let [low, high] = cell.bounds();
            if point.distance_to(point.clamp(low, high)) < best.1 {
                let distance = cell.distance(point);
                if distance < best.1 {
                    best = (cell, distance);
                }
            }
        }
        best
    }
}

impl Cell {
    /// `None` if it is flat.
    fn new(numbers: [u32; 4], corners: [DVec3; 4]) -> Option<Self> {
        let [a, b, c, d] = corners;
        let edges = DMat3::from_cols(b - a, c - a, d - a);
        let longest =
            (0..4).flat_map(|i| (0..i).map(move |j| corners[i].distance_to(corners[j]))).fold(0.0, f64::max);
        let is_flat = edges.determinant().abs() <= FLAT * longest * longest * longest;
        (!is_flat).then(|| Self { numbers, corners, inverse: edges.inverse() })
    }

    fn weights(&self, point: DVec3) -> [f64; 4] {
        let DVec3 { x, y, z } = self.inverse * (point - self.corners[0]);
        [1.0 - x - y - z, x, y, z]
    }

    fn holds(&self, point: DVec3) -> bool {
        self.weights(point).iter().all(|&weight| weight >= 0.0)
    }

    /// Of a point outside.
    fn distance(&self, point: DVec3) -> f64 {
        let faces =
            [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]].map(|face| face.map(|i: usize| self.corners[i]));
        let distance = |corners: [DVec3; 3]| {
            let [s, t, u] = closest_on_triangle(point, corners);
            point.distance_to(corners[0] * s + corners[1] * t + corners[2] * u)
        };
        faces.map(distance).into_iter().fold(f64::INFINITY, f64::min)
    }

    fn bounds(&self) -> [DVec3; 2] {
        let [a, b, c, d] = self.corners;
        [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
    }

    fn extent(&self) -> f64 {
        let [low, high] = self.bounds();
        (high - low).max_element()
    }
}

fn cube(point: DVec3, side: f64) -> [i64; 3] {
    (point / side).floor().to_array().map(|x| x as i64)
}

fn cubes(low: [i64; 3], high: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (low[0]..=high[0])
        .flat_map(move |i| (low[1]..=high[1]).flat_map(move |j| (low[2]..=high[2]).map(move |k| [i, j, k])))
}
