//! A convex part and a half-space.

use glam::Vec3;

use super::key::{Body, Key};
use super::reduce::Candidate;
use super::{Manifold, ManifoldPoint, Scratch};
use crate::norm::Norm;
use crate::shape::Convex;
use crate::simd::Lanes;

/// Where A touches the half-space of the points x of A's frame with `normal · x <= offset` (normal unit, offset in m),
/// or will within `margin` m. The manifold's normal is `-normal`, and `on_b` is in A's frame, on the plane.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(crate) fn collide_plane<L: Lanes>(
    a: &Convex,
    normal: Vec3,
    offset: f32,
    scratch: &mut Scratch,
    margin: f32,
) -> Manifold {
    let mut manifold = Manifold { normal: -normal, ..Manifold::default() };
    // Of the core, over the plane.
    let limit = margin + a.radius;
    let (lowest, depth) = a.support::<L>(-normal);
    if -depth - offset > limit {
        return manifold;
    }
    let candidates = &mut scratch.polygon.candidates;
    candidates.clear();
    for (index, &on_a) in a.vertices.iter().enumerate() {
        let separation = normal.dot(on_a) - offset;
        if separation <= limit {
            candidates.push(Candidate { on_a, separation, key: Key::corner(Body::A, index as u16) });
        }
    }
    let size = a.vertices[lowest].norm() + a.radius;
    for (point, candidate) in manifold.points.iter_mut().zip(scratch.reduce(normal, size)) {
        *point = ManifoldPoint {
            on_a: candidate.on_a - normal * a.radius,
            on_b: candidate.on_a - normal * candidate.separation,
            separation: candidate.separation - a.radius,
            key: candidate.key.0,
        };
        manifold.count += 1;
    }
    manifold
}
