//! Ropes as tubes, for drawing: a ring of corners around each particle, in frames carried along the rope by
//! parallel transport.

use tautline::Vec3;
use tautline::mesh::TriMesh;

/// Corners of a ring.
const SIDES: u32 = 8;
/// √½, the sine and cosine of an eighth of a turn.
const DIAGONAL: f32 = std::f32::consts::FRAC_1_SQRT_2;
/// Corners of a ring of radius 1.
const CIRCLE: [[f32; 2]; SIDES as usize] = [
    [1.0, 0.0],
    [DIAGONAL, DIAGONAL],
    [0.0, 1.0],
    [-DIAGONAL, DIAGONAL],
    [-1.0, 0.0],
    [-DIAGONAL, -DIAGONAL],
    [0.0, -1.0],
    [DIAGONAL, -DIAGONAL],
];

/// A tube along a moving line.
#[derive(Debug, Clone)]
pub(super) struct Tube {
    radius: f32,
    /// Across the line at its start, in the last frame: the next one begins from it, so that corners do not
    /// turn around the line from frame to frame.
    across: Vec3,
}

impl Tube {
    pub(super) fn new(radius: f32) -> Self {
        Self { radius, across: Vec3::ZERO }
    }

    /// The tube along at least two points, closed at both ends.
    pub(super) fn mesh(&mut self, points: &[Vec3]) -> TriMesh {
        let positions = self.positions(points);
        let rings = points.len() as u32;
        let corner = |ring: u32, side: u32| ring * SIDES + side % SIDES;
        let (start, end) = (rings * SIDES, rings * SIDES + 1);
        let mut triangles = Vec::with_capacity((2 * SIDES * rings) as usize);
        for side in 0..SIDES {
            for ring in 0..rings - 1 {
                let [a, b] = [corner(ring, side), corner(ring, side + 1)];
                let [c, d] = [corner(ring + 1, side + 1), corner(ring + 1, side)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
            triangles.push([start, corner(0, side + 1), corner(0, side)]);
            triangles.push([end, corner(rings - 1, side), corner(rings - 1, side + 1)]);
        }
        TriMesh { positions, triangles }
    }

    /// The corners of the tube, ring by ring, then the middles of both ends.
    pub(super) fn positions(&mut self, points: &[Vec3]) -> Vec<Vec3> {
        let mut positions = Vec::with_capacity(points.len() * CIRCLE.len() + 2);
        let mut across = self.across;
        for (i, &point) in points.iter().enumerate() {
            let along = tangent(points, i);
            across = across.reject_from_normalized(along).normalize_or(along.any_orthonormal_vector());
            if i == 0 {
                self.across = across;
            }
            let up = along.cross(across);
            let ring = CIRCLE.iter().map(|[x, y]| point + (across * *x + up * *y) * self.radius);
            positions.extend(ring);
        }
        positions.extend([points[0], points[points.len() - 1]]);
        positions
    }
}

/// Unit direction of the line at a point: that of the chord between its neighbours.
fn tangent(points: &[Vec3], i: usize) -> Vec3 {
    let (before, after) = (i.saturating_sub(1), (i + 1).min(points.len() - 1));
    (points[after] - points[before]).normalize_or(Vec3::X)
}
