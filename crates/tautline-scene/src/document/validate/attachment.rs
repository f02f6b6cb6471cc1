//! Judges attachments.

use super::joint::Sides;
use crate::document::check::{COORDINATE, Checker, POSITIVE, SHARE, UP_TO_HUGE};
use crate::document::{Anchor, AnchorPlace, Attachment, Body, Scene, SheetPlace, Surface, limits};

const NOT_FOR_THE_PAPER: &str = "the solver \"paper\" knows none: set settings.solver to \"default\"";

pub(super) fn check_attachments(c: &mut Checker, scene: &Scene) {
    let attachments = &scene.attachments;
    if attachments.len() > limits::ATTACHMENTS {
        let problem = format!("{} attachments are more than {}", attachments.len(), limits::ATTACHMENTS);
        c.problem("attachments", problem);
        return;
    }
    let is_known = attachments.is_empty() || !scene.has_trusses();
    c.require(is_known, "attachments", || NOT_FOR_THE_PAPER.to_owned());
    let sides = Sides::new(&scene.bodies);
    for (i, attachment) in attachments.iter().enumerate() {
        c.within(format_args!("attachments[{i}]"), |c| check_attachment(c, attachment, &sides));
    }
}

fn check_attachment(c: &mut Checker, attachment: &Attachment, sides: &Sides) {
    let Attachment { a, b, compliance, break_force } = attachment;
    let mut is_soft = [false; 2];
    for ((end, anchor), is_soft) in [("a", a), ("b", b)].into_iter().zip(&mut is_soft) {
        c.within(end, |c| *is_soft = check_anchor(c, anchor, sides));
    }
    c.require(is_soft[0] || is_soft[1], "b", || {
        "neither end is on cloth or rope: rigid bodies are held by joints".to_owned()
    });
    c.number("compliance", *compliance, UP_TO_HUGE);
    c.optional("break_force", *break_force, POSITIVE);
}

/// Tells whether it is meant to be on cloth or rope.
fn check_anchor(c: &mut Checker, anchor: &Anchor, sides: &Sides) -> bool {
    let field = format!("at.{}", anchor.at.name());
    let body = match anchor.body.as_ref().map(|body| sides.body(body)).transpose() {
        Ok(body) => body.map(|(_, body)| body),
        Err(message) => {
            c.problem("body", message);
            return true;
        }
    };
    let is_soft = matches!(body, Some(Body::Cloth(_) | Body::Rope(_)));
    let suits = match (&anchor.at, body) {
        (AnchorPlace::Point(_), body) => !is_soft && !matches!(body, Some(Body::Room(_))),
        (AnchorPlace::Particle(_), _) => is_soft,
        (AnchorPlace::Corner(_) | AnchorPlace::Triangle { .. }, body) => matches!(body, Some(Body::Cloth(_))),
        (AnchorPlace::End(_) | AnchorPlace::Segment { .. }, body) => matches!(body, Some(Body::Rope(_))),
    };
    let kind = body.map_or("world", Body::kind);
    c.require(suits, &field, || format!("a {kind} has no such place: {}", places_of(kind)));
    check_place(c, &field, &anchor.at, body);
    is_soft
}

fn places_of(kind: &str) -> &'static str {
    match kind {
        "cloth" => "use particle, corner or triangle",
        "rope" => "use particle, end or segment",
        "room" => "leave the body out and use point",
        _ => "use point",
    }
}

fn check_place(c: &mut Checker, field: &str, place: &AnchorPlace, body: Option<&Body>) {
    let is_grid = matches!(body, Some(Body::Cloth(cloth)) if matches!(cloth.surface, Surface::Grid { .. }));
    match place {
        AnchorPlace::Point(point) => c.vector(field, point, COORDINATE),
        AnchorPlace::Particle(particle) => {
            let count = body.map_or(0, |body| body.particle_count(false));
            // Of a mesh file that is not loaded the number is not known.
            c.require(count == 0 || u64::from(*particle) < count, field, || {
                format!("{particle} is the index of no particle: there are {count}")
            });
        }
        AnchorPlace::Corner(corner) => {
            use SheetPlace::{BackLeft, BackRight, FrontLeft, FrontRight};
            let is_one = matches!(corner, BackLeft | BackRight | FrontLeft | FrontRight);
            c.require(is_one, field, || "it is more than one particle".to_owned());
            c.require(is_grid, field, || "this surface is no grid: use particle".to_owned());
        }
        AnchorPlace::End(_) => {}
        AnchorPlace::Triangle { weights, .. } => {
            for (k, weight) in weights.iter().enumerate() {
                c.number(format_args!("{field}.weights[{k}]"), *weight, SHARE);
            }
        }
        AnchorPlace::Segment { fraction, .. } => c.number(format_args!("{field}.fraction"), *fraction, SHARE),
    }
}
