//! From a solid to pieces by plane after plane.

use glam::{DVec3, Vec3};

use super::piece::{Piece, Plane, bounds, excess};
use crate::error::Error;
use crate::mesh::{HalfEdgeMesh, TriMesh, tetrahedralise};
use crate::norm::Norm;

/// Along how many concave edges a piece is tried to be cut.
const EDGES_TRIED: usize = 8;
/// What the volume of the largest piece counts beside excess: of cuts that are equally good the even one is taken, and
/// a ring, of which no single cut helps, is halved.
const BALANCE: f64 = 0.02;
/// How far a vertex may be from a plane and count as on it, as part of the solid's extent.
const ON_PLANE: f64 = 1e-6;

/// A solid on its way to convex parts.
pub(super) struct Carving {
    points: Vec<Vec3>,
    edges: Vec<ConcaveEdge>,
    pieces: Vec<Piece>,
    /// In m.
    tolerance: f64,
}

impl Carving {
    pub(super) fn new(mesh: &TriMesh) -> Result<Self, Error> {
        let tetrahedra = tetrahedralise(mesh)?;
        let (low, high) = bounds(&tetrahedra.points);
        let pieces = Piece::connected(&tetrahedra.points, tetrahedra.tetrahedra)?;
        let tolerance = ON_PLANE * f64::from((high - low).max_element());
        Ok(Self { points: tetrahedra.points, edges: concave_edges(mesh)?, pieces, tolerance })
    }

    /// Cuts the piece of most excess, again and again, until all together have no more than allowed. Where a piece
    /// falls apart there may be more than `max_parts`.
    pub(super) fn divide(mut self, max_parts: usize, allowed: f64) -> Result<Vec<Piece>, Error> {
        while self.pieces.len() < max_parts && excess(&self.pieces) > allowed {
            let worst = (0..self.pieces.len()).fold(0, |worst, place| {
                if self.pieces[place].excess > self.pieces[worst].excess { place } else { worst }
            });
            let Some(pieces) = self.best_cut(worst)? else { break };
            self.pieces.swap_remove(worst);
            self.pieces.extend(pieces);
        }
        Ok(self.pieces)
    }

    /// What the plane makes of a piece that saves most excess for each piece more; `None` if no plane divides it. None
    /// adds any: the hull on either side of a plane contains the hull of what is there.
    fn best_cut(&mut self, place: usize) -> Result<Option<Vec<Piece>>, Error> {
        let mut best: Option<(f64, Plane)> = None;
        let known = self.points.len();
        for plane in self.candidates(&self.pieces[place]) {
            let pieces = self.pieces[place].cut(plane, self.tolerance, &mut self.points)?;
            self.points.truncate(known);
            let largest = pieces.iter().map(|piece| piece.volume).fold(0.0, f64::max);
            let more = pieces.len() as f64 - 1.0;
            let cost = BALANCE * largest - (self.pieces[place].excess - excess(&pieces)) / more;
            if pieces.len() > 1 && best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, plane));
            }
        }
        let Some((_, plane)) = best else { return Ok(None) };
        self.pieces[place].cut(plane, self.tolerance, &mut self.points).map(Some)
    }

    /// Planes along concave edges of a piece, of which each is as far from those before and as concave as possible;
    /// and the planes of the axes through its middle.
    fn candidates(&self, piece: &Piece) -> Vec<Plane> {
        let (low, high) = bounds(&piece.corners);
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let within = |edge: &&ConcaveEdge| edge.middle.cmpge(low).all() && edge.middle.cmple(high).all();
        let mut edges: Vec<(f64, &ConcaveEdge)> =
            self.edges.iter().filter(within).map(|edge| (f64::INFINITY, edge)).collect();
        let middle = (low + high) * 0.5;
        let mut planes: Vec<Plane> = DVec3::AXES.map(|axis| Plane::through(middle, axis)).to_vec();
        for _ in 0..EDGES_TRIED.min(edges.len()) {
            let score =
                |&(distance, edge): &(f64, &ConcaveEdge)| edge.weight * distance.min((high - low).norm());
            let next = edges
                .iter()
                .fold(edges[0], |best, edge| if score(edge) > score(&best) { *edge } else { best });
            planes.extend(next.1.normals.map(|normal| Plane::through(next.1.middle, normal)));
            for (distance, edge) in &mut edges {
                *distance = distance.min(edge.middle.distance_to(next.1.middle));
            }
        }
        planes
    }
}

/// An edge at which the solid is concave.
struct ConcaveEdge {
    middle: DVec3,
    /// Of the planes worth cutting along: those of its two faces and the one between them.
    normals: [DVec3; 3],
    /// Its length times 1 − cos of its bend.
    weight: f64,
}

fn concave_edges(mesh: &TriMesh) -> Result<Vec<ConcaveEdge>, Error> {
    let mut edges = Vec::new();
    for hinge in HalfEdgeMesh::from_mesh(mesh)?.hinges() {
        let [a, b, c, d] = hinge.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
        let left = (b - a).cross(c - a).unit_or_zero();
        let right = (a - b).cross(d - b).unit_or_zero();
        let bend = 1.0 - left.dot(right);
        // Less than a tenth of a degree is a matter of rounding.
        if bend < 1e-6 || left.dot(d - a) <= 0.0 {
            continue;
        }
        // The plane between the faces contains the edge and the mean of the normals.
        let between = (b - a).cross(left + right).unit_or_zero();
        let normals = [left, right, between];
        edges.push(ConcaveEdge { middle: (a + b) * 0.5, normals, weight: bend * a.distance_to(b) });
    }
    Ok(edges)
}
