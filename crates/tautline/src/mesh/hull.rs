//! Convex hull of points: quickhull (Barber, Dobkin & Huhdanpaa 1996, The quickhull algorithm for convex hulls)
//! with exact predicates.
//!
//! A face is replaced only if the new point lies strictly above it. The faces so removed always form a disc,
//! bounded by one cycle of edges, and no edge of it is in line with the point; so coplanar facets, duplicates
//! and slivers need no tolerance and no special case, and every triangle made has area.

use glam::Vec3;

use super::{HalfEdgeMesh, TriMesh, exact};
use crate::order::PutInOrder;
use crate::{Error, MeshDefect};

/// The smallest convex solid around some points.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvexHull {
    /// Closed, facing outwards; facets with more than three corners are cut into coplanar triangles. Its vertices
    /// are the hull's corners only: no point within a facet or an edge is among them.
    pub mesh: TriMesh,
    /// The input point that each vertex is, ascending; of coinciding points the first.
    pub sources: Vec<u32>,
}

/// Computes the convex hull. Exact for any finite coordinates, however thin or far away; the same points in the
/// same order give the same bits. O(n log n) for points in usual arrangements, O(n²) at worst.
///
/// # Errors
/// [`MeshDefect::NotFinite`] names the first bad point, [`MeshDefect::Flat`] says that the points span no volume;
/// [`Error::OutOfRange`] if there are more than 2³¹.
pub fn convex_hull(points: &[Vec3]) -> Result<ConvexHull, Error> {
    if points.len() > 1 << 31 {
        let value = points.len() as f64;
        return Err(Error::OutOfRange {
            field: "points".into(), value, expected: "a count of at most 2³¹"
        });
    }
    if let Some(vertex) = points.iter().position(|point| !point.is_finite()) {
        return Err(MeshDefect::NotFinite { vertex }.into());
    }
    let all: Vec<u32> = (0..points.len() as u32).collect();
    let hull = quickhull(points, &all)?;
    let corners = hull.corners()?;
    // A hull of corners alone has all of them as vertices, so this happens once.
    if corners.len() == hull.sources.len() { Ok(hull) } else { quickhull(points, &corners) }
}

impl ConvexHull {
    /// The sources of the vertices at which at least three facets meet, that is three edges with an angle. Points
    /// that were added early may end up within a facet (no such edge) or within an edge (two).
    fn corners(&self) -> Result<Vec<u32>, Error> {
        let topology = HalfEdgeMesh::from_mesh(&self.mesh)?;
        let mut angled = vec![0_u32; self.sources.len()];
        for hinge in topology.hinges() {
            let [a, b, c, d] = hinge.map(|vertex| self.mesh.positions[vertex as usize]);
            if exact::height_above(a, b, c, d) != 0.0 {
                angled[hinge[0] as usize] += 1;
                angled[hinge[1] as usize] += 1;
            }
        }
        Ok(self
            .sources
            .iter()
            .zip(angled)
            .filter(|&(_, edges)| edges >= 3)
            .map(|(&source, _)| source)
            .collect())
    }
}

struct Face {
    corners: [u32; 3],
    /// The face across the side from corner k to corner k + 1.
    neighbors: [u32; 3],
    /// Points strictly above this face, each with its height; a point waits at one face only.
    above: Vec<(f64, u32)>,
    removed: bool,
}

/// A side of a face that stays, beyond which faces are removed.
struct HorizonEdge {
    /// Start and end, in the direction of the removed face.
    start: u32,
    end: u32,
    /// The face that stays.
    outer: u32,
}

struct Builder<'a> {
    points: &'a [Vec3],
    faces: Vec<Face>,
}

fn quickhull(points: &[Vec3], candidates: &[u32]) -> Result<ConvexHull, Error> {
    let Some(simplex) = first_simplex(points, candidates) else {
        return Err(MeshDefect::Flat { count: points.len() }.into());
    };
    let mut builder = Builder::new(points, simplex);
    builder.distribute(candidates.iter().copied(), 0);
    let mut pending: Vec<u32> = vec![3, 2, 1, 0];
    while let Some(face) = pending.pop() {
        if let Some(apex) = builder.highest_above(face) {
            let first_new = builder.faces.len() as u32;
            builder.add(apex, face);
            pending.extend(first_new..builder.faces.len() as u32);
        }
    }
    Ok(builder.finish())
}

/// Four points off one plane, far apart; the fourth below the other three counter-clockwise.
fn first_simplex(points: &[Vec3], candidates: &[u32]) -> Option<[u32; 4]> {
    let at = |index: u32| points[index as usize];
    let distance_squared = |a: u32, b: u32| at(a).as_dvec3().distance_squared(at(b).as_dvec3());
    let &start = candidates.first()?;
    let a = farthest(candidates, |p| distance_squared(start, p))?;
    let b = farthest(candidates, |p| distance_squared(a, p))?;
    let c = farthest(candidates, |p| exact::twice_area_squared(at(a), at(b), at(p)))?;
    let height = |p| exact::height_above(at(a), at(b), at(c), at(p));
    let d = farthest(candidates, |p| height(p).abs())?;
    Some(if height(d) < 0.0 { [a, b, c, d] } else { [b, a, c, d] })
}

/// The candidate of greatest measure, the first of equals; `None` if all measure 0.
fn farthest(candidates: &[u32], measure: impl Fn(u32) -> f64) -> Option<u32> {
    let mut best = (0.0, None);
    for &candidate in candidates {
        let value = measure(candidate);
        if value > best.0 {
            best = (value, Some(candidate));
        }
    }
    best.1
}

impl<'a> Builder<'a> {
    fn new(points: &'a [Vec3], [a, b, c, d]: [u32; 4]) -> Self {
        let face = |corners, neighbors| Face { corners, neighbors, above: Vec::new(), removed: false };
        let faces = vec![
            face([a, b, c], [1, 2, 3]),
            face([a, d, b], [3, 2, 0]),
            face([b, d, c], [1, 3, 0]),
            face([c, d, a], [2, 1, 0]),
        ];
        Self { points, faces }
    }

    fn height(&self, face: u32, point: u32) -> f64 {
        let [a, b, c] = self.faces[face as usize].corners.map(|corner| self.points[corner as usize]);
        exact::height_above(a, b, c, self.points[point as usize])
    }

    /// Lets every point wait at the first face, from `first` on, that it is above. A point above none is inside.
    fn distribute(&mut self, points: impl Iterator<Item = u32>, first: u32) {
        for point in points {
            for face in first..self.faces.len() as u32 {
                let height = self.height(face, point);
                if height > 0.0 {
                    self.faces[face as usize].above.push((height, point));
                    break;
                }
            }
        }
    }

    /// The highest of the points waiting at a face, the lowest index of equals.
    fn highest_above(&self, face: u32) -> Option<u32> {
        let above = self.faces[face as usize].above.iter();
        above.max_by(|x, y| x.0.total_cmp(&y.0).then(y.1.cmp(&x.1))).map(|&(_, point)| point)
    }

    /// Replaces the faces that `apex` is above, `seen` being one of them, by a cone from their rim to it.
    fn add(&mut self, apex: u32, seen: u32) {
        let (mut horizon, orphans) = self.remove_visible(apex, seen);
        // The rim is one cycle: by their starts its edges find each other.
        horizon.put_in_order_by_key(|edge| edge.start);
        let first = self.faces.len() as u32;
        let starting_at = |vertex: u32| first + horizon.partition_point(|edge| edge.start < vertex) as u32;
        for (edge, face) in horizon.iter().zip(first..) {
            let neighbors = [edge.outer, starting_at(edge.end), face];
            let corners = [edge.start, edge.end, apex];
            self.faces.push(Face { corners, neighbors, above: Vec::new(), removed: false });
            let outer = &mut self.faces[edge.outer as usize];
            for side in 0..3 {
                if outer.corners[side] == edge.end {
                    outer.neighbors[side] = face;
                }
            }
        }
        for face in first..self.faces.len() as u32 {
            let following = self.faces[face as usize].neighbors[1];
            self.faces[following as usize].neighbors[2] = face;
        }
        self.distribute(orphans.into_iter(), first);
    }

    /// Removes every face that `apex` is above, flooding from `seen`. Returns the rim and the points that waited.
    /// Those still outside are above one of the new faces: the proof for points in general position holds for
    /// coplanar ones too.
    fn remove_visible(&mut self, apex: u32, seen: u32) -> (Vec<HorizonEdge>, Vec<u32>) {
        let (mut horizon, mut orphans) = (Vec::new(), Vec::new());
        self.faces[seen as usize].removed = true;
        let mut open = vec![seen];
        while let Some(face) = open.pop() {
            let removed = &mut self.faces[face as usize];
            orphans.extend(std::mem::take(&mut removed.above).into_iter().map(|(_, point)| point));
            let (corners, neighbors) = (removed.corners, removed.neighbors);
            for side in 0..3 {
                let outer = neighbors[side];
                if self.faces[outer as usize].removed {
                    continue;
                }
                if self.height(outer, apex) > 0.0 {
                    self.faces[outer as usize].removed = true;
                    open.push(outer);
                } else {
                    horizon.push(HorizonEdge { start: corners[side], end: corners[(side + 1) % 3], outer });
                }
            }
        }
        (horizon, orphans)
    }

    fn finish(self) -> ConvexHull {
        let mut triangles: Vec<[u32; 3]> =
            self.faces.iter().filter(|face| !face.removed).map(|face| face.corners).collect();
        let mut sources: Vec<u32> = triangles.as_flattened().to_vec();
        sources.sort_unstable();
        sources.dedup();
        for vertex in triangles.as_flattened_mut() {
            *vertex = sources.partition_point(|source| source < vertex) as u32;
        }
        let positions = sources.iter().map(|&source| self.points[source as usize]).collect();
        ConvexHull { mesh: TriMesh { positions, triangles }, sources }
    }
}
