//! GJK in f32 for two cores that are known to be apart, if need be because B was shifted (Gilbert, Johnson &
//! Keerthi 1988; van den Bergen 1999). From the simplex of the last call it takes one or two iterations.

use glam::Vec3;

use super::core::{Core, Pair};
use super::simplex::{Simplex, Vertex};
use crate::simd::Lanes;

/// More than any pair needs in exact arithmetic; beyond it, rounding is at work.
const MAX_ITERATIONS: u32 = 24;
/// The closest point is accepted when the true one is nearer by at most this part of the coordinates: a few
/// roundings of f32.
const GAP: f32 = 1e-6;
/// What is accepted when rounding ends the walk.
const ACCEPTED_GAP: f32 = 1e-5;

/// How the walk ended.
pub(super) enum Walk {
    /// The cores are further apart than asked.
    Beyond {
        /// Unit, from A to B.
        axis: Vec3,
    },
    /// The point of the shifted B ⊖ A closest to the origin, in m, and the simplex that holds it.
    Closest { point: Vec3, simplex: Simplex },
    /// Rounding stopped it: neither apart nor touching is proved.
    Failed,
}

/// Walks from a simplex of one to three vertices of B ⊖ A (their points are filled in here) to the point closest
/// to the origin. `limit`: the distance from which on it does not matter; `scale`: how large coordinates get, in m.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn walk<L: Lanes, B: Core>(
    pair: &Pair<B>,
    shift: Vec3,
    mut simplex: Simplex,
    limit: f32,
    scale: f32,
) -> Walk {
    let difference = |[a, b]: [u16; 2]| pair.point_of_b(b) + shift - pair.point_of_a(a);
    for vertex in &mut simplex.vertices[..simplex.count] {
        vertex.point = difference(vertex.pair);
    }
    let mut best: Option<(Vec3, Simplex)> = None;
    let mut least_squared = f32::INFINITY;
    let mut gap = f32::INFINITY;
    for _ in 0..MAX_ITERATIONS {
        let Some(point) = simplex.reduce() else { break };
        let squared = point.length_squared();
        if squared >= least_squared || squared <= 0.0 {
            break;
        }
        let length = squared.sqrt();
        let (vertex, height) = pair.support::<L>(point);
        let lower_bound = height / length + shift.dot(point) / length;
        if lower_bound > limit {
            return Walk::Beyond { axis: point / length };
        }
        gap = length - lower_bound;
        if gap <= GAP * scale {
            return Walk::Closest { point, simplex };
        }
        (best, least_squared) = (Some((point, simplex)), squared);
        if simplex.contains(vertex) {
            break;
        }
        simplex.push(Vertex { pair: vertex, point: difference(vertex) });
    }
    match best {
        Some((point, simplex)) if gap <= ACCEPTED_GAP * scale => Walk::Closest { point, simplex },
        _ => Walk::Failed,
    }
}
