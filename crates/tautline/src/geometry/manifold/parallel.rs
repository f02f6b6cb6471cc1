//! Two segments side by side touch along a stretch: its ends are the contact.

use super::clip::ALIGNED;
use super::core::{Core, Pair};
use super::key::{Body, Key};
use super::reduce::Candidate;
use super::touch::Touch;

/// The ends of the stretch along which the segments run side by side, where less than `limit` m apart; none if they
/// are not parallel.
pub(super) fn candidates<B: Core>(pair: &Pair<B>, touch: &Touch, limit: f32, out: &mut Vec<Candidate>) {
    out.clear();
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
