//! Judges joints.

use std::collections::BTreeMap;

use crate::document::check::{
    ANGLE, COORDINATE, Checker, FACTOR, FREQUENCY, HALF_TURN, POSITIVE, RATE, THICKNESS, UP_TO_HUGE,
};
use crate::document::{Body, BodyRef, Joint, JointKind, Motion, Motor, Rigid, Scene, limits};

const NOT_FOR_TRUSSES: &str = "bodies of sticks have no joints: set settings.solver to \"default\"";

pub(super) fn check_joints(c: &mut Checker, scene: &Scene) {
    let joints = &scene.joints;
    if joints.len() > limits::JOINTS {
        c.problem("joints", format!("{} joints are more than {}", joints.len(), limits::JOINTS));
        return;
    }
    c.require(joints.is_empty() || !scene.has_trusses(), "joints", || NOT_FOR_TRUSSES.to_owned());
    let sides = Sides::new(&scene.bodies);
    for (i, joint) in joints.iter().enumerate() {
        c.within(format_args!("joints[{i}]"), |c| check_joint(c, joint, &sides));
    }
}

fn check_joint(c: &mut Checker, joint: &Joint, sides: &Sides) {
    check_sides(c, joint, sides);
    c.within(format_args!("kind.{}", joint.kind.name()), |c| check_kind(c, &joint.kind));
    for (field, anchor) in [("anchor", &joint.anchor), ("base_anchor", &joint.base_anchor)] {
        if let Some(anchor) = anchor {
            c.vector(field, anchor, COORDINATE);
        }
    }
    c.number("compliance", joint.compliance, UP_TO_HUGE);
    c.optional("angular_compliance", joint.angular_compliance, UP_TO_HUGE);
    c.optional("break_force", joint.break_force, POSITIVE);
    c.optional("break_torque", joint.break_torque, POSITIVE);
    let is_distance = matches!(joint.kind, JointKind::Distance { .. });
    let angular = [
        ("angular_compliance", joint.angular_compliance.is_some()),
        ("break_torque", joint.break_torque.is_some()),
    ];
    for (field, is_given) in angular {
        c.require(!(is_distance && is_given), field, || {
            "a distance joint holds no rotation: leave it out".to_owned()
        });
    }
}

/// What can be held.
pub(super) struct Sides<'a> {
    bodies: &'a [Body],
    by_name: BTreeMap<&'a str, usize>,
}

impl<'a> Sides<'a> {
    pub(super) fn new(bodies: &'a [Body]) -> Self {
        let mut by_name = BTreeMap::new();
        for (i, body) in bodies.iter().enumerate() {
            if let Some(name) = body.name() {
                by_name.insert(name, i);
            }
        }
        Self { bodies, by_name }
    }

    /// A body and its index, or what is wrong.
    pub(super) fn body(&self, body: &BodyRef) -> Result<(usize, &'a Body), String> {
        let index = match body {
            BodyRef::Index(index) if (*index as usize) < self.bodies.len() => *index as usize,
            BodyRef::Index(index) => {
                return Err(format!("{index} is the index of no body: there are {}", self.bodies.len()));
            }
            BodyRef::Name(name) => match self.by_name.get(name.as_str()) {
                Some(&index) => index,
                None => return Err(format!("no body has the name {name:?}")),
            },
        };
        Ok((index, &self.bodies[index]))
    }

    /// The rigid body and its index, or what is wrong; `hint` says what else is meant.
    pub(super) fn find(&self, body: &BodyRef, hint: &str) -> Result<(usize, &'a Rigid), String> {
        let (index, body) = self.body(body)?;
        match body {
            Body::Rigid(rigid) => Ok((index, rigid)),
            other => Err(format!("bodies[{index}] is a {}: {hint}", other.kind())),
        }
    }
}

fn check_sides(c: &mut Checker, joint: &Joint, sides: &Sides) {
    let hint = "joints hold rigid bodies, and a joint without a base is held by the world";
    let mut found = |field: &str, body: &BodyRef| match sides.find(body, hint) {
        Ok(side) => Some(side),
        Err(message) => {
            c.problem(field, message);
            None
        }
    };
    let Some((body, rigid)) = found("body", &joint.body) else { return };
    let base = match &joint.base {
        None => None,
        Some(base) => match found("base", base) {
            None => return,
            base => base,
        },
    };
    let is_other = base.is_none_or(|(base, _)| base != body);
    c.require(is_other, "base", || "it is the body itself: a joint holds two".to_owned());
    let can_move = |rigid: &Rigid| rigid.motion() == Motion::Dynamic;
    c.require(can_move(rigid) || base.is_some_and(|(_, base)| can_move(base)), "body", || {
        "neither it nor its base is dynamic: there is nothing to hold".to_owned()
    });
}

fn check_kind(c: &mut Checker, kind: &JointKind) {
    match kind {
        JointKind::Ball { axis, cone_degrees, twist_degrees } => {
            c.direction("axis", axis);
            c.optional("cone_degrees", *cone_degrees, ANGLE);
            c.optional_range("twist_degrees", *twist_degrees, HALF_TURN);
        }
        JointKind::Hinge { axis, limits_degrees, motor } => {
            c.direction("axis", axis);
            c.optional_range("limits_degrees", *limits_degrees, FACTOR);
            check_motor(c, *motor);
        }
        JointKind::Fixed {} => {}
        JointKind::Slider { axis, limits, motor } => {
            c.direction("axis", axis);
            c.optional_range("limits", *limits, COORDINATE);
            check_motor(c, *motor);
        }
        JointKind::Distance { length, range, spring } => {
            c.optional("length", *length, THICKNESS);
            c.optional_range("range", *range, THICKNESS);
            if let Some(spring) = spring {
                c.number("spring.frequency", spring.frequency, FREQUENCY);
                c.number("spring.damping_ratio", spring.damping_ratio, RATE);
            }
        }
    }
}

fn check_motor(c: &mut Checker, motor: Option<Motor>) {
    if let Some(Motor { speed, strength }) = motor {
        c.number("motor.speed", speed, FACTOR);
        c.number("motor.strength", strength, UP_TO_HUGE);
    }
}
