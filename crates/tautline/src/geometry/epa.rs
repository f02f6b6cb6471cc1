//! The expanding polytope algorithm (van den Bergen 2001; paper 5.1): grows GJK's last simplex inside A ⊖ B until
//! its face nearest to the origin is a face of A ⊖ B: the *hit face*.
//!
//! The penetration depth is the smallest ‖x‖ over the *boundary* of A ⊖ B. (The paper's Eq 5 says over A ⊖ B
//! itself, which is always 0 here.)

use glam::{DVec3, Vec3};

use super::closest::closest_on_triangle;
use super::gjk::MAX_ITERATIONS;
use super::simplex::{CsoVertex, Simplex};
use super::support::Support;
use crate::norm::Norm;

/// A support point this little beyond a face, as part of A ⊖ B's reach, lies on it.
const ON_FACE: f64 = 1e-11;
/// What beyond counts as seeing a face, as part of the reach: above rounding, below [`ON_FACE`].
const VISIBLE: f64 = 1e-14;
/// Thinner than this part of its reach, A ⊖ B has no volume.
const FLAT: f64 = 1e-12;
/// How far outside a face (in barycentric coordinates) the origin's projection may fall.
const OUTSIDE: f64 = -1e-6;

/// The face of A ⊖ B nearest to the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HitFace {
    /// Its corners. Where A ⊖ B is a segment or a point, corners repeat.
    pub vertices: [CsoVertex; 3],
    /// Barycentric coordinates of the face's point closest to the origin.
    pub barycentric: [f64; 3],
    /// Unit normal from A to B: moving B by `depth` along it separates the sets.
    pub normal: DVec3,
    /// Distance from the origin to the face, in m. 0 where A ⊖ B is flat: flat sets touch, they do not penetrate.
    pub depth: f64,
    /// Faces tried, each with a pair of support points.
    pub iterations: u32,
    /// Whether no other face is nearer, within rounding. If not, `normal` and `depth` still separate the sets,
    /// but a shorter way may exist.
    pub converged: bool,
}

/// The polytope: scratch memory, to be kept and reused so that a query allocates nothing.
#[derive(Debug, Clone, Default)]
pub struct Epa {
    vertices: Vec<CsoVertex>,
    faces: Vec<Face>,
    horizon: Vec<[u32; 2]>,
}

#[derive(Debug, Clone, Copy)]
struct Face {
    corners: [u32; 3],
    /// Unit, outwards; zero for a face without area.
    normal: DVec3,
    /// Height of the face's plane along the normal.
    offset: f64,
    /// Whether it may still be the nearest one.
    is_candidate: bool,
}

impl Epa {
    /// With room for what most queries need, so that it does not grow step by step.
    pub(crate) fn with_room() -> Self {
        Self {
            vertices: Vec::with_capacity(32),
            faces: Vec::with_capacity(96),
            horizon: Vec::with_capacity(32),
        }
    }

    /// Expands `simplex`, in which GJK left the origin, to the hit face. `axis` (from A to B, zero if
    /// unknown) only settles which way the normal of flat sets points. `budget` is the number of faces that may
    /// be tried, at most [`MAX_ITERATIONS`].
    pub fn hit_face(
        &mut self,
        a: &impl Support,
        b: &impl Support,
        simplex: &Simplex,
        axis: Vec3,
        budget: u32,
    ) -> HitFace {
        self.vertices.clear();
        self.faces.clear();
        self.vertices.extend_from_slice(simplex.vertices());
        while self.vertices.len() < 4 {
            let grown = match self.vertices.as_slice() {
                [] => Some(CsoVertex::support(a, b, DVec3::X)),
                vertices => farthest(a, b, vertices, axis.as_dvec3()),
            };
            match grown {
                Some(vertex) => self.vertices.push(vertex),
                None => return flat_hit(&self.vertices, axis.as_dvec3(), 0),
            }
        }
        self.close_tetrahedron();
        self.expand(a, b, budget.min(MAX_ITERATIONS))
    }

    fn close_tetrahedron(&mut self) {
        let [p, q, r, s] = [0, 1, 2, 3].map(|i| self.vertices[i].point);
        let is_inside_out = (q - p).cross(r - p).dot(s - p) > 0.0;
        for [i, j, k] in [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]] {
            let face = self.face(if is_inside_out { [i, k, j] } else { [i, j, k] });
            self.faces.push(face);
        }
    }

    fn face(&self, corners: [u32; 3]) -> Face {
        let [p, q, r] = corners.map(|i| self.vertices[i as usize].point);
        let area = (q - p).cross(r - p);
        let length = area.norm();
        if length == 0.0 {
            return Face { corners, normal: DVec3::ZERO, offset: f64::INFINITY, is_candidate: false };
        }
        let normal = area / length;
        Face { corners, normal, offset: normal.dot(p), is_candidate: true }
    }

    /// Whether the origin's projection falls on the face. On a convex hull that holds the origin it does so on the
    /// nearest face, so this keeps slivers, whose normals are noise, out of the choice.
    fn is_under_origin(&self, face: &Face) -> bool {
        let [p, q, r] = face.corners.map(|i| self.vertices[i as usize].point);
        let limit = OUTSIDE * (q - p).cross(r - p).dot(face.normal);
        [q.cross(r), r.cross(p), p.cross(q)].iter().all(|part| part.dot(face.normal) >= limit)
    }

    fn expand(&mut self, a: &impl Support, b: &impl Support, budget: u32) -> HitFace {
        let mut reach_squared = self.vertices.iter().map(|v| v.point.length_squared()).fold(0.0, f64::max);
        let mut best: Option<(Face, f64)> = None;
        let mut iterations = 0;
        while iterations < budget {
            let Some(nearest) = self.nearest() else { break };
            let face = self.faces[nearest];
            if !self.is_under_origin(&face) {
                self.faces[nearest].is_candidate = false;
                continue;
            }
            iterations += 1;
            let vertex = CsoVertex::support(a, b, face.normal);
            let height = face.normal.dot(vertex.point);
            reach_squared = reach_squared.max(vertex.point.length_squared());
            if best.is_none_or(|(_, least)| height < least) {
                best = Some((face, height));
            }
            if height - face.offset <= ON_FACE * reach_squared.sqrt() {
                return self.hit(&face, face.offset, iterations, true);
            }
            if self.vertices.iter().any(|v| v.is_same_pair(&vertex)) {
                // Rounding has dented the polytope here; the other faces may still hold the answer.
                self.faces[nearest].is_candidate = false;
                continue;
            }
            self.add(vertex, VISIBLE * reach_squared.sqrt());
        }
        match best.or_else(|| self.least_reaching(a, b)) {
            Some((face, height)) => self.hit(&face, height, iterations, false),
            None => HitFace { converged: false, ..flat_hit(&self.vertices[..3], DVec3::ZERO, iterations) },
        }
    }

    /// The face beyond which A ⊖ B reaches least, and how far: what is left to say where the origin lies so near an edge
    /// that rounding puts it under no face at all.
    fn least_reaching(&self, a: &impl Support, b: &impl Support) -> Option<(Face, f64)> {
        let mut least: Option<(Face, f64)> = None;
        for face in self.faces.iter().filter(|face| face.normal != DVec3::ZERO) {
            let height = face.normal.dot(CsoVertex::support(a, b, face.normal).point);
            if least.is_none_or(|(_, lowest)| height < lowest) {
                least = Some((*face, height));
            }
        }
        least
    }

    /// The candidate with the least offset; of equal ones the first.
    fn nearest(&self) -> Option<usize> {
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for (i, face) in self.faces.iter().enumerate() {
            if face.is_candidate && face.offset < least {
                least = face.offset;
                nearest = Some(i);
            }
        }
        nearest
    }

    /// Replaces the faces that the new vertex sees by a fan from their outline, the horizon. Every edge keeps
    /// two faces whatever rounding decides about single ones, so the polytope stays closed.
    fn add(&mut self, vertex: CsoVertex, visible: f64) {
        self.horizon.clear();
        let mut i = 0;
        while i < self.faces.len() {
            let face = self.faces[i];
            if face.normal.dot(vertex.point) - face.offset <= visible {
                i += 1;
                continue;
            }
            self.faces.swap_remove(i);
            let [p, q, r] = face.corners;
            for edge in [[p, q], [q, r], [r, p]] {
                self.toggle(edge);
            }
        }
        let apex = self.vertices.len() as u32;
        self.vertices.push(vertex);
        for i in 0..self.horizon.len() {
            let [p, q] = self.horizon[i];
            let face = self.face([p, q, apex]);
            self.faces.push(face);
        }
    }

    /// An edge between two removed faces comes by twice, once each way: it is not on the horizon.
    fn toggle(&mut self, [p, q]: [u32; 2]) {
        match self.horizon.iter().position(|&edge| edge == [q, p]) {
            Some(twin) => {
                self.horizon.swap_remove(twin);
            }
            None => self.horizon.push([p, q]),
        }
    }

    fn hit(&self, face: &Face, depth: f64, iterations: u32, converged: bool) -> HitFace {
        let vertices = face.corners.map(|i| self.vertices[i as usize]);
        let barycentric = closest_on_triangle(DVec3::ZERO, vertices.map(|v| v.point));
        HitFace { vertices, barycentric, normal: face.normal, depth, iterations, converged }
    }
}

/// The vertex of A ⊖ B farthest from the point, line or plane through one, two or three known ones; `None` if
/// there is none off it. Directions that span what is missing are tried in a fixed order.
fn farthest(a: &impl Support, b: &impl Support, known: &[CsoVertex], axis: DVec3) -> Option<CsoVertex> {
    let base = known.first()?.point;
    let directions = match *known {
        [_] => [DVec3::X, DVec3::Y, DVec3::Z],
        [_, q] => {
            let line = (q.point - base).unit_or(DVec3::X);
            let across = line.any_orthonormal_vector();
            [across, line.cross(across), DVec3::ZERO]
        }
        _ => [flat_normal(known, axis), DVec3::ZERO, DVec3::ZERO],
    };
    let mut best = None;
    let mut farthest = 0.0;
    let mut reach = base.norm();
    for direction in directions.into_iter().flat_map(|d| [d, -d]) {
        let vertex = CsoVertex::support(a, b, direction);
        let height = direction.dot(vertex.point - base);
        reach = reach.max(vertex.point.norm());
        if height > farthest {
            farthest = height;
            best = Some(vertex);
        }
    }
    best.filter(|_| farthest > FLAT * reach)
}

/// Unit vector at right angles to the hull of up to three vertices: of a triangle its normal, of a segment or a
/// point the one nearest to `axis`. On the side of `axis` either way.
fn flat_normal(vertices: &[CsoVertex], axis: DVec3) -> DVec3 {
    let axis = axis.unit_or(DVec3::Y);
    match *vertices {
        [p, q, r] => {
            let normal = (q.point - p.point).cross(r.point - p.point).unit_or(axis);
            if normal.dot(axis) < 0.0 { -normal } else { normal }
        }
        [p, q] => {
            let line = (q.point - p.point).unit_or(DVec3::X);
            let across = axis - line * axis.dot(line);
            if across.length_squared() > 1e-12 { across.unit() } else { line.any_orthonormal_vector() }
        }
        _ => axis,
    }
}

/// The hit face of an A ⊖ B without volume. The origin lies in it, so the depth is 0.
fn flat_hit(vertices: &[CsoVertex], axis: DVec3, iterations: u32) -> HitFace {
    let corner = |i: usize| vertices.get(i).or(vertices.last()).copied().unwrap_or_default();
    let corners = [0, 1, 2].map(corner);
    let barycentric = closest_on_triangle(DVec3::ZERO, corners.map(|v| v.point));
    let normal = flat_normal(vertices, axis);
    HitFace { vertices: corners, barycentric, normal, depth: 0.0, iterations, converged: true }
}
