//! The edges of a triangle soup, each with the triangles that have it.

use crate::order::PutInOrder;

/// A side of a triangle, `a` being the lower end.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    pub(super) a: u32,
    pub(super) b: u32,
    /// Three times the triangle, and the corner that the side begins at.
    pub(super) half_edge: u32,
}

impl Side {
    pub(super) fn triangle(&self) -> u32 {
        self.half_edge / 3
    }

    /// Whether the triangle runs from `a` to `b`.
    pub(super) fn is_forward(&self, triangles: &[[u32; 3]]) -> bool {
        triangles.as_flattened()[self.half_edge as usize] == self.a
    }
}

/// The sides of the triangles that are asked for, sorted, so that those of one edge stand together.
pub(super) fn sides(triangles: &[[u32; 3]], included: &[bool]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (triangle, [a, b, c]) in triangles.iter().enumerate().filter(|&(triangle, _)| included[triangle]) {
        for (k, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            sides.push(Side { a: *from.min(to), b: *from.max(to), half_edge: (3 * triangle + k) as u32 });
        }
    }
    sides.put_in_order();
    sides
}

/// The sides of every edge in turn.
pub(super) fn by_edge(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|x, y| (x.a, x.b) == (y.a, y.b))
}

/// The half-edge of the other triangle at each edge that has exactly two; `u32::MAX` elsewhere.
pub(super) fn partners(triangles: &[[u32; 3]], sides: &[Side]) -> Vec<u32> {
    let mut partners = vec![u32::MAX; 3 * triangles.len()];
    for sharing in by_edge(sides) {
        if let [x, y] = sharing {
            partners[x.half_edge as usize] = y.half_edge;
            partners[y.half_edge as usize] = x.half_edge;
        }
    }
    partners
}

/// The half-edges of a triangle that begin and end at a vertex: corners before and after it.
pub(super) fn corners_at(triangles: &[[u32; 3]], half_edge: u32, vertex: u32) -> u32 {
    // A side has its two ends at two corners of its triangle: the one it begins at, and the next.
    if triangles.as_flattened()[half_edge as usize] == vertex {
        half_edge
    } else {
        half_edge - half_edge % 3 + (half_edge + 1) % 3
    }
}

/// The sides of an edge, in any order of its ends; none if there is no such edge.
pub(super) fn of_edge(sides: &[Side], [a, b]: [u32; 2]) -> &[Side] {
    let ends = (a.min(b), a.max(b));
    let start = sides.partition_point(|side| (side.a, side.b) < ends);
    let count = sides[start..].partition_point(|side| (side.a, side.b) == ends);
    &sides[start..start + count]
}
