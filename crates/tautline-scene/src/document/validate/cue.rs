//! Judges cues.

use super::joint::Sides;
use crate::document::check::{COORDINATE, Checker, NOT_NEGATIVE};
use crate::document::{Cue, Motion, Scene, limits};

const NOT_FOR_THE_PAPER: &str = "the solver \"paper\" knows none: set settings.solver to \"default\"";

pub(super) fn check_cues(c: &mut Checker, scene: &Scene) {
    let cues = &scene.cues;
    if cues.len() > limits::CUES {
        c.problem("cues", format!("{} cues are more than {}", cues.len(), limits::CUES));
        return;
    }
    c.require(cues.is_empty() || !scene.has_trusses(), "cues", || NOT_FOR_THE_PAPER.to_owned());
    let sides = Sides::new(&scene.bodies);
    for (i, cue) in cues.iter().enumerate() {
        c.within(format_args!("cues[{i}]"), |c| check_cue(c, cue, &sides));
    }
}

fn check_cue(c: &mut Checker, cue: &Cue, sides: &Sides) {
    c.number("at", cue.at, NOT_NEGATIVE);
    match sides.find(&cue.body, "a cue is for a rigid body") {
        Ok((_, rigid)) => c.require(rigid.motion() != Motion::Fixed, "body", || {
            "it is fixed: give it the motion \"kinematic\"".to_owned()
        }),
        Err(message) => c.problem("body", message),
    }
    c.vector("velocity", &cue.velocity, COORDINATE);
    c.vector("angular_velocity", &cue.angular_velocity, COORDINATE);
}
