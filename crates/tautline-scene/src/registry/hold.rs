//! What holds cloth and rope in several scenes.

use crate::document::{Anchor, AnchorPlace, Attachment, BodyRef};

/// Holds a particle of cloth or rope at a point of a rigid body, where that is at the start.
pub(super) fn on_body(soft: &str, particle: u32, body: &str, point: [f32; 3]) -> Attachment {
    let body = Some(BodyRef::Name(body.to_owned()));
    Attachment {
        a: particle_of(soft, particle),
        b: Anchor { body, at: AnchorPlace::Point(point) },
        compliance: 0.0,
        break_force: None,
    }
}

/// Draws a particle of cloth or rope to a point of the world, by 1 m for so many newtons: `compliance` in m/N.
pub(super) fn in_world(soft: &str, particle: u32, point: [f32; 3], compliance: f32) -> Attachment {
    let b = Anchor { body: None, at: AnchorPlace::Point(point) };
    Attachment { a: particle_of(soft, particle), b, compliance, break_force: None }
}

fn particle_of(soft: &str, particle: u32) -> Anchor {
    Anchor { body: Some(BodyRef::Name(soft.to_owned())), at: AnchorPlace::Particle(particle) }
}
