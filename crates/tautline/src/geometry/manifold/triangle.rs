//! A convex part and one triangle of a static mesh.

use glam::Vec3;

use super::clip::{ALIGNED, Reference};
use super::core::{Pair, Placement};
use super::touch::{Search, Start, Touch, find};
use super::{Manifold, Memory, Scratch, faces};
use crate::shape::Convex;
use crate::simd::Lanes;

/// Cosine of the tilt from which on a normal is not the face's: 0.08°.
const STRAIGHT: f32 = 0.999_999;
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
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(crate) fn collide_triangle<L: Lanes>(
    a: &Convex,
    triangle: &Triangle,
    triangle_in_a: &Placement,
    (memory, scratch): (&mut Memory, &mut Scratch),
    margin: f32,
) -> Manifold {
    let pair = Pair { a, b: triangle, b_in_a: triangle_in_a };
    let front = Reference::of_b(&pair, 0);
    let inward = front.normal();
    let start = Start::new::<L, _>(&pair, memory, inward, margin);
    let Some(start) = start.and_then(|start| start.or_along::<L, _>(&pair, memory, inward, margin)) else {
        return Manifold::default();
    };
    let is_behind = pair.support::<L>(-inward).1 > pair.radii();
    if is_behind {
        return Manifold::default();
    }
    let is_round = a.vertices.len() == 1;
    if !is_round
        && memory.axis.dot(inward) > ALIGNED
        && let Some(manifold) =
            faces::remembered::<L, _>(&pair, (memory, scratch), &front, &start, margin, Search::Local)
    {
        return manifold;
    }
    let Some(mut touch) = find::<L, _>(&pair, (memory, scratch), &start, margin, Search::Local) else {
        return Manifold::default();
    };
    let along = touch.normal.dot(inward);
    if along <= 0.0 {
        return Manifold::default();
    }
    let is_tilted = along < STRAIGHT;
    let stands_out = is_tilted && triangle.is_active_at(triangle_in_a.point_inside(touch.on_b));
    if is_tilted && !stands_out {
        // What is apart stays as far apart, or the plane would reach beyond the triangle.
        let separation = touch.separation.max(pair.support::<L>(inward).1);
        touch = Touch { normal: inward, separation, on_b: touch.on_a + inward * separation, ..touch };
    }
    let reference = if stands_out { Reference::choose::<L, _>(&pair, touch.normal) } else { Some(front) };
    match reference {
        Some(reference) if !is_round => {
            faces::touching::<L, _>(&pair, &touch, &reference, margin + pair.radii(), scratch)
        }
        _ => Manifold::single(&pair, &touch),
    }
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
