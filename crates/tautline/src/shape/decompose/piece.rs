//! A piece of a solid, and how a plane cuts it.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use crate::error::{Error, MeshDefect};
use crate::mesh::{TriMesh, convex_hull};

/// Tetrahedra that fill a part of the solid. Cuts move no surface and need no caps: each divides convex cells.
pub(super) struct Piece {
    tetrahedra: Vec<[u32; 4]>,
    /// In m³.
    pub(super) volume: f64,
    /// The corners of its convex hull.
    pub(super) corners: Vec<Vec3>,
    /// By how much its convex hull is larger, in m³.
    pub(super) excess: f64,
}

/// All points with normal · x = offset.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    /// Unit.
    pub(super) normal: DVec3,
    /// In m.
    pub(super) offset: f64,
}

impl Plane {
    pub(super) fn through(point: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: normal.dot(point) }
    }

    fn height(&self, point: Vec3) -> f64 {
        self.normal.dot(point.as_dvec3()) - self.offset
    }
}

impl Piece {
    /// Of tetrahedra that hang together one; those without volume are left out.
    pub(super) fn connected(points: &[Vec3], tetrahedra: Vec<[u32; 4]>) -> Result<Vec<Self>, Error> {
        let mut pieces = Vec::new();
        for component in components(tetrahedra) {
            pieces.extend(Self::new(points, component)?);
        }
        Ok(pieces)
    }

    fn new(points: &[Vec3], tetrahedra: Vec<[u32; 4]>) -> Result<Option<Self>, Error> {
        let volume = tetrahedra.iter().map(|tetrahedron| volume(points, tetrahedron)).sum::<f64>();
        let mut used = tetrahedra.as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        let used: Vec<Vec3> = used.into_iter().map(|vertex| points[vertex as usize]).collect();
        let hull = match convex_hull(&used) {
            Err(Error::Mesh(MeshDefect::Flat { .. })) => return Ok(None),
            other => other?.mesh,
        };
        let excess = (inside(&hull) - volume).max(0.0);
        Ok(Some(Self { tetrahedra, volume, corners: hull.positions, excess }))
    }

    /// Both in one.
    pub(super) fn joined(mut self, other: Self) -> Result<Self, Error> {
        let (corners, excess) = self.joint_hull(&other)?;
        self.tetrahedra.extend(other.tetrahedra);
        Ok(Self { tetrahedra: self.tetrahedra, volume: self.volume + other.volume, corners, excess })
    }

    /// The corners of the hull around both, and by how much it is larger than they are, in m³.
    pub(super) fn joint_hull(&self, other: &Self) -> Result<(Vec<Vec3>, f64), Error> {
        let hull = convex_hull(&[&self.corners[..], &other.corners].concat())?.mesh;
        let excess = (inside(&hull) - self.volume - other.volume).max(0.0);
        Ok((hull.positions, excess))
    }

    /// The connected pieces on both sides of a plane. Vertices within `tolerance` (m) count as on it. New vertices are
    /// added to `points`.
    pub(super) fn cut(
        &self,
        plane: Plane,
        tolerance: f64,
        points: &mut Vec<Vec3>,
    ) -> Result<Vec<Self>, Error> {
        let height = |&point: &Vec3| {
            let height = plane.height(point);
            if height.abs() <= tolerance { 0.0 } else { height }
        };
        let heights = points.iter().map(height).collect();
        let mut cut = Cut { points, heights, crossings: BTreeMap::new() };
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let mut open = self.tetrahedra.clone();
        while let Some(tetrahedron) = open.pop() {
            match cut.side(&tetrahedron) {
                Side::Above => above.push(tetrahedron),
                Side::Below => below.push(tetrahedron),
                Side::Across(halves) => open.extend(halves),
            }
        }
        let mut pieces = Self::connected(points, above)?;
        pieces.extend(Self::connected(points, below)?);
        Ok(pieces)
    }
}

enum Side {
    Above,
    Below,
    /// It has an edge across the plane; divided there.
    Across([[u32; 4]; 2]),
}

struct Cut<'a> {
    points: &'a mut Vec<Vec3>,
    /// By vertex, over the plane in m; 0 if within the tolerance.
    heights: Vec<f64>,
    /// The vertex at which an edge, lower end first, crosses the plane.
    crossings: BTreeMap<[u32; 2], u32>,
}

impl Cut<'_> {
    fn side(&mut self, tetrahedron: &[u32; 4]) -> Side {
        let heights = tetrahedron.map(|vertex| self.heights[vertex as usize]);
        let Some(low) = heights.iter().position(|&height| height < 0.0) else { return Side::Above };
        let Some(high) = heights.iter().position(|&height| height > 0.0) else { return Side::Below };
        let middle = self.crossing(tetrahedron[low], tetrahedron[high]);
        let with_middle = |place: usize| {
            let mut half = *tetrahedron;
            half[place] = middle;
            half
        };
        Side::Across([with_middle(low), with_middle(high)])
    }

    fn crossing(&mut self, a: u32, b: u32) -> u32 {
        let edge = [a.min(b), a.max(b)];
        if let Some(&vertex) = self.crossings.get(&edge) {
            return vertex;
        }
        let [start, end] = edge.map(|vertex| self.heights[vertex as usize]);
        let [from, to] = edge.map(|vertex| self.points[vertex as usize].as_dvec3());
        let vertex = self.points.len() as u32;
        self.points.push(from.lerp(to, start / (start - end)).as_vec3());
        self.heights.push(0.0);
        self.crossings.insert(edge, vertex);
        vertex
    }
}

/// Tetrahedra that hang together by vertices; the component of the first tetrahedron first.
fn components(tetrahedra: Vec<[u32; 4]>) -> Vec<Vec<[u32; 4]>> {
    let mut vertices = tetrahedra.as_flattened().to_vec();
    vertices.sort_unstable();
    vertices.dedup();
    let rank = |vertex: u32| vertices.partition_point(|&other| other < vertex);
    let mut parent: Vec<usize> = (0..vertices.len()).collect();
    for tetrahedron in &tetrahedra {
        let roots = tetrahedron.map(|vertex| root(&mut parent, rank(vertex)));
        for other in &roots[1..] {
            // An earlier union may have moved it.
            let (a, b) = (root(&mut parent, roots[0]), root(&mut parent, *other));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut groups: Vec<(usize, Vec<[u32; 4]>)> = Vec::new();
    for tetrahedron in tetrahedra {
        let root = root(&mut parent, rank(tetrahedron[0]));
        match groups.iter_mut().find(|(other, _)| *other == root) {
            Some((_, group)) => group.push(tetrahedron),
            None => groups.push((root, vec![tetrahedron])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Of a union-find forest, whose paths are halved on the way.
fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}

/// In m³. The first three corners run counter-clockwise seen from the fourth.
fn volume(points: &[Vec3], tetrahedron: &[u32; 4]) -> f64 {
    let [a, b, c, d] = tetrahedron.map(|vertex| points[vertex as usize].as_dvec3());
    (b - a).cross(c - a).dot(d - a) / 6.0
}

/// The volume inside a closed mesh, in m³; measured from its first vertex, for accuracy far from the origin.
pub(super) fn inside(mesh: &TriMesh) -> f64 {
    let start = mesh.positions.first().map_or(DVec3::ZERO, |p| p.as_dvec3());
    let six = |&corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|vertex| mesh.positions[vertex as usize].as_dvec3() - start);
        a.dot(b.cross(c))
    };
    mesh.triangles.iter().map(six).sum::<f64>() / 6.0
}

/// By how much the hulls of all together are larger than they are, in m³.
pub(super) fn excess<'a>(pieces: impl IntoIterator<Item = &'a Piece>) -> f64 {
    pieces.into_iter().map(|piece| piece.excess).sum()
}

/// The lower and the upper corner of the box around some points.
pub(super) fn bounds(points: &[Vec3]) -> (Vec3, Vec3) {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    points.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)))
}
