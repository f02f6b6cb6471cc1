//! Judges rigid bodies.

use super::shape::check_shape;
use super::{NOT_OF_TRUSSES, check_mass_or_density, check_rotation, check_surface_of_rigid};
use crate::document::check::{COORDINATE, Checker, FACTOR, NOT_NEGATIVE, RATE};
use crate::document::{Groups, Motion, Rigid};

/// Groups are bits of a 32-bit number.
const GROUPS: u32 = 32;

pub(super) fn check_rigid(c: &mut Checker, rigid: &Rigid, is_truss: bool) {
    c.within("shape", |c| check_shape(c, &rigid.shape, is_truss));
    c.vector("position", &rigid.position, COORDINATE);
    check_rotation(c, &rigid.rotation);
    c.vector("velocity", &rigid.velocity, COORDINATE);
    c.vector("angular_velocity", &rigid.angular_velocity, COORDINATE);
    check_mass_or_density(c, rigid.mass, rigid.density);
    c.number("friction", rigid.friction, NOT_NEGATIVE);
    check_surface_of_rigid(c, rigid.restitution, rigid.rolling_friction, is_truss);
    c.optional("gravity_scale", rigid.gravity_scale, FACTOR);
    if let Some(damping) = rigid.damping {
        c.number("damping.linear", damping.linear, RATE);
        c.number("damping.angular", damping.angular, RATE);
    }
    if let Some(Groups { memberships, filter }) = &rigid.groups {
        check_groups(c, "groups.memberships", memberships.as_deref());
        check_groups(c, "groups.filter", filter.as_deref());
    }
    check_motion(c, rigid);
    if is_truss {
        refuse_what_no_truss_has(c, rigid);
    }
}

fn check_groups(c: &mut Checker, field: &str, groups: Option<&[u32]>) {
    for (k, &group) in groups.unwrap_or_default().iter().enumerate() {
        c.count(format_args!("{field}[{k}]"), group, 0, GROUPS - 1);
    }
}

fn check_motion(c: &mut Checker, rigid: &Rigid) {
    let agrees = !rigid.fixed || rigid.motion.is_none_or(|motion| motion == Motion::Fixed);
    c.require(agrees, "motion", || "the body is fixed already: give one of the two".to_owned());
    c.require(rigid.shape.is_solid() || rigid.motion() != Motion::Dynamic, "shape", || {
        "it has no inside, and so no mass: the body must be fixed or kinematic".to_owned()
    });
}

fn refuse_what_no_truss_has(c: &mut Checker, rigid: &Rigid) {
    let fields = [
        ("gravity_scale", rigid.gravity_scale.is_some()),
        ("damping", rigid.damping.is_some()),
        ("groups", rigid.groups.is_some()),
        ("motion", rigid.motion() == Motion::Kinematic),
    ];
    for (field, is_given) in fields {
        c.require(!is_given, field, || NOT_OF_TRUSSES.to_owned());
    }
}
