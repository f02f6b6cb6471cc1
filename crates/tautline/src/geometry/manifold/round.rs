//! Two balls, and two capsules: segments side by side touch along a stretch, whose ends are the contact.

use glam::Vec3;

use super::clip::ALIGNED;
use super::core::{Core, Pair};
use super::key::{Body, Key};
use super::reduce::Candidate;
use super::touch::Touch;
use super::{Manifold, Memory, Scratch};
use crate::norm::Norm;

/// The contact of two balls, or no points if they are further apart than `margin`. Where both centres are the same,
/// the remembered axis is kept, or `axis` taken.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn balls<B: Core>(pair: &Pair<B>, memory: &mut Memory, axis: Vec3, margin: f32) -> Manifold {
    let on_a = pair.point_of_a(0);
    let on_b = pair.point_of_b(0);
    let distance = (on_b - on_a).norm();
    let normal = if distance > 0.0 {
        (on_b - on_a) / distance
    } else if memory.is_usable(pair) {
        memory.axis
    } else {
        axis
    };
    let size = pair.a.size.min(pair.b.size());
    let touch = Touch { normal, separation: distance, on_a, on_b, pairs: [[0; 2]; 3], count: 1, size };
    memory.keep(&touch);
    if distance - pair.radii() <= margin { Manifold::single(pair, &touch) } else { Manifold::default() }
}

/// The contact of two segments whose cores are less than `limit` m apart.
pub(super) fn capsules<B: Core>(
    pair: &Pair<B>,
    touch: &Touch,
    limit: f32,
    scratch: &mut Scratch,
) -> Manifold {
    let candidates = &mut scratch.polygon.candidates;
    candidates.clear();
    stretch(pair, touch, limit, candidates);
    if candidates.is_empty() {
        return Manifold::single(pair, touch);
    }
    Manifold::of_candidates(pair, touch.normal, scratch, touch.size)
}

/// The ends of the stretch along which the segments run side by side; none if they are not parallel.
fn stretch<B: Core>(pair: &Pair<B>, touch: &Touch, limit: f32, out: &mut Vec<Candidate>) {
    let [start_a, end_a] = [0, 1].map(|i| pair.point_of_a(i));
    let [start_b, end_b] = [0, 1].map(|i| pair.point_of_b(i));
    let (along_a, along_b) = (end_a - start_a, end_b - start_b);
    let (squared_a, squared_b) = (along_a.length_squared(), along_b.length_squared());
    let product = along_a.dot(along_b);
    if product * product < ALIGNED * ALIGNED * squared_a * squared_b {
        return;
    }
    // Where the ends of B lie along A, in its lengths.
    let places = [start_b, end_b].map(|end| (end - start_a).dot(along_a) / squared_a);
    let (low, high) = if places[0] < places[1] { (0, 1) } else { (1, 0) };
    let ends = [
        if places[low] > 0.0 { (places[low], Body::B, low) } else { (0.0, Body::A, 0) },
        if places[high] < 1.0 { (places[high], Body::B, high) } else { (1.0, Body::A, 1) },
    ];
    if ends[0].0 >= ends[1].0 {
        return;
    }
    for (place, body, corner) in ends {
        let on_a = start_a + along_a * place;
        let on_b = start_b + along_b * ((place - places[0]) / (places[1] - places[0]));
        let separation = touch.normal.dot(on_b - on_a);
        if separation < limit {
            out.push(Candidate { on_a, separation, key: Key::corner(body, corner as u16) });
        }
    }
}
