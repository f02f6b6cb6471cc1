//! Which triangles of cloths pass through each other, and where ropes pierce them.

use tautline::geometry::box_tree::{Bounds, BoxTree};
use tautline::{DVec3, Vec3};

use super::crossing::{passes_through, triangles_intersect};

/// A triangulated surface as it lies now.
#[derive(Debug, Clone, Copy)]
pub struct Sheet<'a> {
    /// Corners, in m.
    pub positions: &'a [Vec3],
    /// Three indices into `positions` per triangle.
    pub triangles: &'a [[u32; 3]],
}

/// A triangle of one of several sheets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TriangleId {
    /// The number of the sheet.
    pub sheet: usize,
    /// The number of the triangle in it.
    pub triangle: usize,
}

/// A place where a rope passes through a sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pierce {
    /// The number of the rope's segment.
    pub segment: usize,
    /// The triangle it passes through.
    pub triangle: TriangleId,
}

/// The pairs of triangles that intersect and share no corner, within and between sheets, ascending.
///
/// Two triangles intersect if an edge of one passes through the other: its ends are on opposite sides of the other's
/// plane, beyond doubt by rounding in `f64` (15 digits of the size of the triangles), and it meets the plane inside the
/// other or on its edge. So triangles that touch do not intersect, nor do two in one plane, even if they overlap: a
/// cloth folded flat on itself has no intersections. Triangles of different sheets share no corner, whatever their
/// indices. A triangle with a corner that is missing or not finite intersects nothing.
pub fn intersections(sheets: &[Sheet<'_>]) -> Vec<[TriangleId; 2]> {
    let soup = Soup::of(sheets);
    let mut found = Vec::new();
    for (a, bounds) in soup.triangles.iter().zip(&soup.boxes) {
        soup.tree.overlapping(bounds, |b| {
            let b = &soup.triangles[b as usize];
            // Every pair once.
            if b.id < a.id && !a.shares_corner(b) && triangles_intersect(a.places(), b.places()) {
                found.push([b.id, a.id]);
            }
            true
        });
    }
    found.sort_unstable();
    found
}

/// Where a rope through these points (m) passes through sheets, ascending: each segment with each triangle it passes
/// through, as of [`intersections`]. One that passes through the edge between two triangles passes through both.
pub fn rope_pierces(rope: &[Vec3], sheets: &[Sheet<'_>]) -> Vec<Pierce> {
    let soup = Soup::of(sheets);
    let mut found = Vec::new();
    for (segment, ends) in rope.windows(2).enumerate() {
        if ends.iter().all(|end| end.is_finite()) {
            let places = [ends[0].as_dvec3(), ends[1].as_dvec3()];
            soup.tree.overlapping(&Bounds::around(places), |item| {
                let triangle = &soup.triangles[item as usize];
                if passes_through(places, triangle.places()) {
                    found.push(Pierce { segment, triangle: triangle.id });
                }
                true
            });
        }
    }
    found.sort_unstable();
    found
}

/// All triangles of all sheets.
struct Soup {
    triangles: Vec<Triangle>,
    boxes: Vec<Bounds>,
    tree: BoxTree,
}

struct Triangle {
    id: TriangleId,
    indices: [u32; 3],
    corners: [Vec3; 3],
}

impl Soup {
    fn of(sheets: &[Sheet<'_>]) -> Self {
        let triangles: Vec<Triangle> = sheets
            .iter()
            .enumerate()
            .flat_map(|(number, sheet)| {
                let all = sheet.triangles.iter().enumerate();
                all.filter_map(move |(triangle, &indices)| {
                    let id = TriangleId { sheet: number, triangle };
                    Some(Triangle { id, indices, corners: sheet.corners(indices)? })
                })
            })
            .collect();
        let boxes: Vec<Bounds> = triangles.iter().map(|triangle| Bounds::around(triangle.places())).collect();
        Self { tree: BoxTree::new(&boxes), triangles, boxes }
    }
}

impl Sheet<'_> {
    /// The corners of a triangle, if they are all there and finite.
    pub(super) fn corners(&self, [a, b, c]: [u32; 3]) -> Option<[Vec3; 3]> {
        let corner = |index: u32| self.positions.get(index as usize).copied().filter(|p| p.is_finite());
        Some([corner(a)?, corner(b)?, corner(c)?])
    }
}

impl Triangle {
    fn places(&self) -> [DVec3; 3] {
        self.corners.map(Vec3::as_dvec3)
    }

    fn shares_corner(&self, other: &Self) -> bool {
        self.id.sheet == other.id.sheet && self.indices.iter().any(|index| other.indices.contains(index))
    }
}
