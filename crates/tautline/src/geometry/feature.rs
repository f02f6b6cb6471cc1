//! Which features of two bodies touch, and where (paper 5.1, figure 1; 6.1). The vertices of the hit face are
//! pairs (aᵢ, bᵢ); how many of them are distinct on each side names the features.

use glam::{DVec3, Vec3};

use super::closest::{closest_between_segments, closest_on_segment, closest_on_triangle};
use super::epa::HitFace;
use super::support::Support;

/// A vertex, an edge or a face of a body, by the indices of its points, ascending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// One point.
    Vertex(u32),
    /// Two points.
    Edge([u32; 2]),
    /// Three points.
    Face([u32; 3]),
}

/// A point of a feature as a barycentric combination Σ λᵢ xᵢ of the feature's vertices: what feature separation
/// (paper Eq 8 and 9) needs to move it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FeaturePoint {
    /// The feature's vertices, ascending; the first `count` are in use, the others are 0.
    pub indices: [u32; 3],
    /// λᵢ of each vertex, none negative, with sum 1; 0 beyond `count`.
    pub weights: [f32; 3],
    /// 1 for a vertex, 2 for an edge, 3 for a face.
    pub count: u32,
}

impl FeaturePoint {
    /// The feature's name.
    pub fn feature(&self) -> Feature {
        let [p, q, r] = self.indices;
        match self.count {
            0 | 1 => Feature::Vertex(p),
            2 => Feature::Edge([p, q]),
            _ => Feature::Face([p, q, r]),
        }
    }

    /// The feature spanned by three points, some of which may be the same; their weights add up.
    pub(crate) fn new(indices: [u32; 3], weights: [f64; 3]) -> Self {
        let (distinct, count) = distinct(indices);
        let weight_of = |of: u32| -> f64 {
            indices.iter().zip(weights).filter(|&(&index, _)| index == of).map(|(_, weight)| weight).sum()
        };
        let mut sums = [0.0; 3];
        for (sum, &index) in sums.iter_mut().zip(&distinct[..count]) {
            *sum = weight_of(index) as f32;
        }
        Self { indices: distinct, weights: sums, count: count as u32 }
    }

    /// The vertices and their weights.
    pub fn iter(&self) -> impl Iterator<Item = (u32, f32)> {
        self.indices.into_iter().zip(self.weights).take(self.count as usize)
    }
}

/// The features of two intersecting bodies, and the point of each that feature separation moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactFeatures {
    /// A's feature and the weights of `point_a` over it.
    pub a: FeaturePoint,
    /// B's feature and the weights of `point_b` over it.
    pub b: FeaturePoint,
    /// p_A, in m: the point of A's feature deepest inside B.
    pub point_a: Vec3,
    /// p_B, in m; `point_a - point_b` is `depth * normal` within rounding.
    pub point_b: Vec3,
    /// Unit, from A to B.
    pub normal: Vec3,
    /// Penetration depth, in m; 0 when just touching.
    pub depth: f32,
}

impl ContactFeatures {
    /// Reads the features from the hit face.
    ///
    /// {1,3} is a vertex on a face, {3,1} a face on a vertex, {2,2} two edges. {1,1}, {1,2} and {2,1} (only sets
    /// without volume have them) are a vertex on a feature of fewer points than a face. For {2,3}, {3,2} and
    /// {3,3} two features lie flat on each other: then every vertex of A on B's feature, every vertex of B on A's
    /// and every pair of edges is compared, in this order, and the first that comes nearest to
    /// p_A − p_B = depth · normal is taken. Seen along the normal the two features overlap, so either one has a
    /// vertex in the other or their edges cross, and some pair meets that equation.
    pub fn new(a: &impl Support, b: &impl Support, face: &HitFace) -> Self {
        let side_a = Side::new(a, face.vertices.map(|v| v.a));
        let side_b = Side::new(b, face.vertices.map(|v| v.b));
        let touch = match (side_a.count, side_b.count) {
            (1, _) | (_, 1) | (2, 2) => Touch::new(side_a, side_b),
            _ => flat_touch(&side_a, &side_b, face.normal * face.depth),
        };
        Self {
            a: touch.a.at(touch.weights_a),
            b: touch.b.at(touch.weights_b),
            point_a: touch.a.point(touch.weights_a).as_vec3(),
            point_b: touch.b.point(touch.weights_b).as_vec3(),
            normal: face.normal.as_vec3(),
            depth: face.depth as f32,
        }
    }
}

/// The distinct points of one body among the vertices of a hit face, ascending.
#[derive(Debug, Clone, Copy)]
struct Side {
    indices: [u32; 3],
    points: [DVec3; 3],
    count: usize,
}

impl Side {
    fn new(set: &impl Support, indices: [u32; 3]) -> Self {
        let (indices, count) = distinct(indices);
        Self { indices, points: indices.map(|i| set.point(i)), count }
    }

    fn vertex(&self, i: usize) -> Self {
        Self { indices: [self.indices[i], 0, 0], points: [self.points[i]; 3], count: 1 }
    }

    fn edge(&self, [i, j]: [usize; 2]) -> Self {
        let (p, q) = (self.points[i], self.points[j]);
        Self { indices: [self.indices[i], self.indices[j], 0], points: [p, q, q], count: 2 }
    }

    fn edges(&self) -> impl Iterator<Item = Self> {
        let count = if self.count == 3 { 3 } else { 1 };
        [[0, 1], [0, 2], [1, 2]].into_iter().take(count).map(|ends| self.edge(ends))
    }

    fn closest(&self, point: DVec3) -> [f64; 3] {
        let [p, q, _] = self.points;
        match self.count {
            1 => [1.0, 0.0, 0.0],
            2 => with_zero(closest_on_segment(point, [p, q])),
            _ => closest_on_triangle(point, self.points),
        }
    }

    fn point(&self, weights: [f64; 3]) -> DVec3 {
        self.points[0] * weights[0] + self.points[1] * weights[1] + self.points[2] * weights[2]
    }

    fn at(&self, weights: [f64; 3]) -> FeaturePoint {
        FeaturePoint { indices: self.indices, weights: weights.map(|w| w as f32), count: self.count as u32 }
    }
}

/// Two features and the weights of their closest points.
#[derive(Debug, Clone, Copy)]
struct Touch {
    a: Side,
    b: Side,
    weights_a: [f64; 3],
    weights_b: [f64; 3],
}

impl Touch {
    /// For a vertex and any feature, or two edges.
    fn new(a: Side, b: Side) -> Self {
        let vertex = [1.0, 0.0, 0.0];
        let [weights_a, weights_b] = match (a.count, b.count) {
            (1, _) => [vertex, b.closest(a.points[0])],
            (_, 1) => [a.closest(b.points[0]), vertex],
            _ => closest_between_segments([a.points[0], a.points[1]], [b.points[0], b.points[1]])
                .map(with_zero),
        };
        Self { a, b, weights_a, weights_b }
    }

    fn error_squared(&self, translation: DVec3) -> f64 {
        (self.a.point(self.weights_a) - self.b.point(self.weights_b) - translation).length_squared()
    }
}

/// See [`ContactFeatures::new`].
fn flat_touch(a: &Side, b: &Side, translation: DVec3) -> Touch {
    let vertices_of_a = (0..a.count).map(|i| Touch::new(a.vertex(i), *b));
    let vertices_of_b = (0..b.count).map(|i| Touch::new(*a, b.vertex(i)));
    let edges = a.edges().flat_map(|edge| b.edges().map(move |other| Touch::new(edge, other)));
    // Errors under this are rounding: they must not choose.
    let noise_squared = 1e-18 * (a.points[1] - a.points[0]).length_squared();
    let mut best = Touch::new(a.vertex(0), *b);
    let mut least = f64::INFINITY;
    for touch in vertices_of_a.chain(vertices_of_b).chain(edges) {
        let error = touch.error_squared(translation).max(noise_squared);
        if error < least {
            least = error;
            best = touch;
        }
    }
    best
}

/// The distinct indices, ascending, then zeros; and how many there are.
fn distinct(mut indices: [u32; 3]) -> ([u32; 3], usize) {
    indices.sort_unstable();
    let [p, q, r] = indices;
    match (p == q, q == r) {
        (true, true) => ([p, 0, 0], 1),
        (true, false) => ([p, r, 0], 2),
        (false, true) => ([p, q, 0], 2),
        (false, false) => ([p, q, r], 3),
    }
}

fn with_zero([s, t]: [f64; 2]) -> [f64; 3] {
    [s, t, 0.0]
}
