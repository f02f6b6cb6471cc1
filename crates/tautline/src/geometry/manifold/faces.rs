//! Contacts in which a face takes part.
//!
//! A pair that touched by a face mostly still does. Then the face's normal is the axis, and it need not be searched:
//! if the deepest corner along it, or a point about as deep, lies over the face, then the face's plane with that point
//! is where the cores are nearest along any axis near it.

use super::clip::Reference;
use super::core::{Core, Pair};
use super::touch::{Search, Start, Touch, is_deep};
use super::{Manifold, Memory, Scratch};
use crate::simd::Lanes;

/// How much higher than the deepest corner, as part of the size, the deepest clipped point may be: more, and the face
/// is not what touches.
const MISSED: f32 = 5e-4;
/// How much deeper than the nearest points it may be: more, and the face is not what separates best.
const MISLED: f32 = 1e-2;

/// The contact by the face that the remembered axis belongs to, or `None` if that does not describe it. No points if
/// the surfaces are further apart than `margin`.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn remembered<L: Lanes, B: Core>(
    pair: &Pair<B>,
    (memory, scratch): (&mut Memory, &mut Scratch),
    reference: &Reference,
    start: &Start,
    margin: f32,
    search: Search,
) -> Option<Manifold> {
    let normal = reference.normal();
    let (_, separation) = pair.support::<L>(normal);
    let size = start.scale.size;
    let apart = separation - pair.radii();
    let mut manifold = Manifold::default();
    if apart <= margin {
        if search == Search::Global && is_deep::<L, B>(pair, normal, separation, size, false) {
            return None;
        }
        scratch.polygon.clip::<L, B>(pair, reference, margin + pair.radii());
        // Also if there is none.
        if scratch.polygon.deepest() > separation + MISSED * size {
            return None;
        }
        manifold = Manifold::of_candidates(pair, normal, scratch, size);
    }
    memory.axis = normal;
    Some(manifold)
}

/// The contact by a face near the touching normal; where that does not describe it, the nearest points. `limit`: how
/// far apart the cores may be, in m.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn touching<L: Lanes, B: Core>(
    pair: &Pair<B>,
    touch: &Touch,
    reference: &Reference,
    limit: f32,
    scratch: &mut Scratch,
) -> Manifold {
    let polygon = &mut scratch.polygon;
    polygon.clip::<L, B>(pair, reference, limit);
    let deepest = polygon.deepest();
    if polygon.candidates.is_empty() || deepest < touch.separation - MISLED * touch.size {
        return Manifold::single(pair, touch);
    }
    if deepest > touch.separation + MISSED * touch.size {
        polygon.candidates.push(touch.candidate());
    }
    Manifold::of_candidates(pair, reference.normal(), scratch, touch.size)
}
