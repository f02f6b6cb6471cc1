//! Rigid bodies of a document to bodies of the engine.

use std::sync::Arc;

use tautline::{CollisionGroups, RigidBody, Shape, Surface, Truss, TrussBody, Vec3};

use super::body::quaternion;
use crate::document::{Damping, Groups, Motion, Rigid};

/// The density of water, in kg/m³, where a document gives neither mass nor density.
const DENSITY: f32 = 1000.0;

/// A body of four particles.
pub(super) fn rigid_body(rigid: &Rigid, shape: &Arc<Shape>) -> RigidBody {
    let Damping { linear, angular } = rigid.damping.unwrap_or_default();
    let body = RigidBody::new(shape)
        .position(rigid.position.into())
        .rotation(quaternion(rigid.rotation))
        .velocity(rigid.velocity.into())
        .angular_velocity(rigid.angular_velocity.into())
        .surface(surface(rigid.friction, rigid.restitution, rigid.rolling_friction))
        .gravity_scale(rigid.gravity_scale.unwrap_or(1.0))
        .damping(linear, angular)
        .groups(rigid.groups.as_ref().map_or_else(CollisionGroups::default, collision_groups));
    let body = match rigid.mass {
        Some(mass) => body.mass(mass),
        None => body.density(rigid.density.unwrap_or(DENSITY)),
    };
    match rigid.motion() {
        Motion::Dynamic => body,
        Motion::Kinematic => body.kinematic(),
        Motion::Fixed => body.fixed(),
    }
}

/// A body of sticks; its truss's frame is at `origin` (m) in that of the document, and encloses `volume` (m³).
pub(super) fn truss_body(rigid: &Rigid, truss: &Arc<Truss>, origin: Vec3, volume: f64) -> TrussBody {
    let rotation = quaternion(rigid.rotation);
    let mass = rigid.mass.unwrap_or_else(|| (f64::from(rigid.density.unwrap_or(DENSITY)) * volume) as f32);
    let body = TrussBody::new(truss)
        .position(Vec3::from(rigid.position) + rotation * origin)
        .rotation(rotation)
        .velocity(rigid.velocity.into())
        .angular_velocity(rigid.angular_velocity.into())
        .mass(mass)
        .friction(rigid.friction);
    if rigid.motion() == Motion::Fixed { body.fixed() } else { body }
}

/// What is absent is none.
pub(super) fn surface(friction: f32, restitution: Option<f32>, rolling_friction: Option<f32>) -> Surface {
    Surface {
        restitution: restitution.unwrap_or(0.0),
        rolling_friction: rolling_friction.unwrap_or(0.0),
        ..Surface::with_friction(friction)
    }
}

fn collision_groups(groups: &Groups) -> CollisionGroups {
    let bits = |numbers: &Option<Vec<u32>>| match numbers {
        Some(numbers) => numbers.iter().fold(0, |bits, number| bits | 1 << number),
        None => u32::MAX,
    };
    CollisionGroups { memberships: bits(&groups.memberships), filter: bits(&groups.filter) }
}
