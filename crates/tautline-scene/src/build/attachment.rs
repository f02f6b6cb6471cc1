//! Attachments of a document to attachments of the engine.

use tautline::{Anchor, BodyHandle, Error, Vec3, World};

use super::body::{rope_particle, sheet_particles};
use crate::document::{AnchorPlace, Attachment, Body, Pin};

/// How firmly it holds.
pub(super) fn strength(document: &Attachment) -> tautline::Attachment {
    let strength = tautline::Attachment::default().compliance(document.compliance);
    document.break_force.map_or(strength, |force| strength.break_force(force))
}

/// A place of a body that has been added, or of the world.
pub(super) fn anchor(
    world: &World,
    place: &AnchorPlace,
    body: Option<(BodyHandle, &Body)>,
) -> Result<Anchor, Error> {
    let Some((handle, body)) = body else { return in_world(place) };
    match (place, body) {
        (AnchorPlace::Point(point), _) => {
            let point = Vec3::from(*point);
            let local =
                |(position, rotation): (Vec3, tautline::Quat)| rotation.conjugate() * (point - position);
            Ok(Anchor::point(handle, world.body(handle)?.pose().map_or(point, local)))
        }
        (AnchorPlace::Particle(particle), _) => Ok(Anchor::particle(handle, *particle)),
        (AnchorPlace::Corner(corner), Body::Cloth(cloth)) => {
            let corner = sheet_particles(Pin::Place(*corner), &cloth.surface);
            corner.first().map(|&particle| Anchor::particle(handle, particle)).ok_or_else(no_place)
        }
        (AnchorPlace::End(end), Body::Rope(rope)) => {
            Ok(Anchor::particle(handle, rope_particle(Pin::Place(*end), &rope.path)))
        }
        (AnchorPlace::Triangle { number, weights }, _) => Ok(Anchor::triangle(handle, *number, *weights)),
        (AnchorPlace::Segment { number, fraction }, _) => Ok(Anchor::segment(handle, *number, *fraction)),
        (AnchorPlace::Corner(_) | AnchorPlace::End(_), _) => Err(no_place()),
    }
}

fn in_world(place: &AnchorPlace) -> Result<Anchor, Error> {
    match place {
        AnchorPlace::Point(point) => Ok(Anchor::world((*point).into())),
        _ => Err(no_place()),
    }
}

fn no_place() -> Error {
    Error::Invalid { field: "at".to_owned(), problem: "the body has no such place".to_owned() }
}
