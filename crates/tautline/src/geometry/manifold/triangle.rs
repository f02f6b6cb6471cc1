//! A convex part and one triangle of a static mesh.

use glam::Vec3;

use super::clip::{ALIGNED, Reference};
use super::core::{Pair, Placement};
use super::touch::{Search, Touch, find};
use super::{Manifold, Memory, Scratch};
use crate::shape::Convex;
use crate::simd::Lanes;

/// How near to an edge, in barycentric coordinates, a point lies on it.
const ON_EDGE: f32 = 1e-3;

/// A triangle of a mesh, counter-clockwise seen from its front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Triangle {
    /// In the mesh's frame, in m.
    pub(crate) corners: [Vec3; 3],
    /// Unit, to the front.
    pub(crate) normal: Vec3,
    /// Bit k: the edge from corner k to the next stands out (it is convex, or open), so that bodies can touch it from
    /// the side. Other edges are inside a surface.
    pub(crate) active_edges: u8,
}

/// Where A touches the front of a triangle, or will within `margin` m.
///
/// The triangle is one-sided: what is in front of it is pushed to the front, however deep; what is behind it is not
/// touched. A normal that is not the face's is kept only where the touched edge, or an edge at the touched corner, is
/// active; else the face's takes its place, so that nothing stumbles over edges within a surface (as in
/// Jolt Physics, `ActiveEdges`).
#[inline(always)]
pub(crate) fn collide_triangle<L: Lanes>(
    a: &Convex,
    triangle: &Triangle,
    triangle_in_a: &Placement,
    (memory, scratch): (&mut Memory, &mut Scratch),
    margin: f32,
) -> Manifold {
    let pair = Pair { a, b: triangle, b_in_a: triangle_in_a };
    let inward = -(triangle_in_a.rotation * triangle.normal);
    let Some(mut touch) = find::<L, _>(&pair, (memory, scratch), inward, margin, Search::Local) else {
        return Manifold::default();
    };
    let along = touch.normal.dot(inward);
    if along <= 0.0 {
        return Manifold::default();
    }
    let limit = margin + pair.radii();
    let is_round = a.vertices.len() == 1;
    if along < ALIGNED && !triangle.is_active_at(triangle_in_a.point_inside(touch.on_b)) {
        touch.normal = inward;
        touch.on_b = touch.on_a + inward * touch.separation;
    } else if along < ALIGNED || is_round {
        return match Reference::choose::<L, _>(&pair, &touch) {
            Some(reference) if !is_round => {
                Manifold::of_faces::<L, _>(&pair, &touch, &reference, limit, scratch)
            }
            _ => Manifold::single(&pair, &touch),
        };
    }
    if is_round {
        return Manifold::single(&pair, &touch);
    }
    let front = Reference::of_b(&pair, 0);
    Manifold::of_faces::<L, _>(&pair, &touch, &front, limit, scratch)
}

impl Triangle {
    /// Whether a point of the triangle lies on an edge that is active, or in a corner that has one, or inside.
    fn is_active_at(&self, point: Vec3) -> bool {
        let [p, q, r] = self.corners;
        let twice_area = self.normal.dot((q - p).cross(r - p));
        let on_edge = |k: usize| {
            let (start, end) = (self.corners[k], self.corners[(k + 1) % 3]);
            self.normal.dot((end - start).cross(point - start)) <= ON_EDGE * twice_area
        };
        let edges = [0, 1, 2].map(on_edge);
        let is_inside = !edges.contains(&true);
        is_inside || (0..3).any(|k| edges[k] && self.active_edges >> k & 1 == 1)
    }
}
