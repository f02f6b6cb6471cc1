//! Judges a document: every value that is wrong, with its path.

mod attachment;
mod cloth;
mod cue;
mod joint;
mod rigid;
mod shape;
mod soft;

use std::collections::BTreeMap;
use std::fmt::Display;

use super::check::{
    ANGLE, COEFFICIENT, COORDINATE, Checker, FINITE, LENGTH, MASS, NOT_NEGATIVE, OPENING, POSITIVE, RATE,
    SHARE, STEP, STIFFNESS, THICKNESS, TOLERANCE, UP_TO_LARGE,
};
use super::{
    AxisAngle, Body, Bounds, Camera, HalfSpace, Pin, Room, Rope, Rotation, Scene, Settings, Sleep, Thread,
    VERSION, limits,
};
use crate::error::{Error, Problem};
use attachment::check_attachments;
use cloth::check_cloth;
use cue::check_cues;
use joint::check_joints;
use rigid::check_rigid;
use soft::check_soft_solid;

/// What is said of a field that a truss does not know.
const NOT_OF_TRUSSES: &str = "only the solver \"default\" knows it";

impl Scene {
    /// Refuses a document whose values a world could not be made of.
    ///
    /// # Errors
    /// [`Error::Invalid`] with [`Scene::problems`].
    pub fn check(&self) -> Result<(), Error> {
        let problems = self.problems();
        if problems.is_empty() { Ok(()) } else { Err(Error::Invalid(problems)) }
    }

    /// Every problem with the document's values, up to [`limits::PROBLEMS`], in its order; none if it is
    /// right. Takes no memory for what is too large. A mesh file is not opened.
    pub fn problems(&self) -> Vec<Problem> {
        let mut c = Checker::default();
        c.require(self.tautline == VERSION, "tautline", || format!("{} is not {VERSION}", self.tautline));
        check_name(&mut c, &self.name);
        c.number("seconds", self.seconds, POSITIVE);
        c.number("dt", self.dt, STEP);
        let too_many = self.seconds / self.dt > limits::STEPS && self.seconds.is_finite() && self.dt > 0.0;
        c.require(!too_many, "seconds", || {
            format!("{} s are more than {} steps of {} s", self.seconds, limits::STEPS, self.dt)
        });
        c.count("record_every", self.record_every, 1, 1_000_000);
        c.within("settings", |c| check_settings(c, &self.settings));
        check_bodies(&mut c, &self.bodies, self.has_trusses());
        check_joints(&mut c, self);
        check_attachments(&mut c, self);
        check_cues(&mut c, self);
        if let Some(Camera { eye, target, fov }) = &self.camera {
            c.within("camera", |c| {
                c.vector("eye", eye, COORDINATE);
                c.vector("target", target, COORDINATE);
                c.number("fov", *fov, OPENING);
                c.require(eye != target, "target", || "it is where the eye is".to_owned());
            });
        }
        if let Some(Bounds { min, max }) = &self.bounds {
            c.within("bounds", |c| check_box(c, min, max));
        }
        c.into_problems()
    }
}

/// The name becomes part of file names.
fn check_name(c: &mut Checker, name: &str) {
    let fits = !name.is_empty() && name.len() <= 100 && !name.starts_with('.');
    let plain = name.chars().all(|ch| ch.is_alphanumeric() || "-_. ".contains(ch));
    c.require(fits && plain, "name", || {
        format!("{name:?} is not a name of letters, digits, spaces and -_. that files can have")
    });
}

fn check_settings(c: &mut Checker, settings: &Settings) {
    c.vector("gravity", &settings.gravity, COORDINATE);
    if let Some(substeps) = settings.substeps {
        c.count("substeps", substeps, 1, 1000);
    }
    if let Some(features) = settings.features_per_pair {
        c.count("features_per_pair", features, 1, 16);
    }
    if let Some(sweeps) = settings.sweeps {
        c.count("sweeps", sweeps, 1, 10_000);
    }
    c.optional("separation_speed", settings.separation_speed, POSITIVE);
    c.optional("tolerance", settings.tolerance, TOLERANCE);
    c.optional("damping", settings.damping, RATE);
    c.vector("wind", settings.wind.as_ref().map_or(&[], |wind| wind.as_slice()), COORDINATE);
    c.optional("air_density", settings.air_density, COEFFICIENT);
    if let Some(Sleep::After { speed, seconds }) = settings.sleep {
        c.within("sleep.after", |c| {
            c.number("speed", speed, POSITIVE);
            c.number("seconds", seconds, POSITIVE);
        });
    }
}

fn check_bodies(c: &mut Checker, bodies: &[Body], has_trusses: bool) {
    if bodies.len() > limits::BODIES {
        c.problem("bodies", format!("{} bodies are more than {}", bodies.len(), limits::BODIES));
        return;
    }
    let mut names = BTreeMap::new();
    for (i, body) in bodies.iter().enumerate() {
        c.within(format_args!("bodies[{i}].{}", body.kind()), |c| {
            if let Some(name) = body.name() {
                let first = *names.entry(name).or_insert(i);
                c.require(first == i, "name", || format!("{name:?} is the name of bodies[{first}] too"));
            }
            check_body(c, body, has_trusses);
        });
    }
    let particles = bodies.iter().map(|body| body.particle_count(has_trusses));
    check_total(c, "particles", particles, limits::PARTICLES);
    check_total(c, "triangles", bodies.iter().map(Body::triangle_count), limits::TRIANGLES);
}

fn check_total(c: &mut Checker, what: &str, counts: impl Iterator<Item = u64>, most: u64) {
    let total = counts.fold(0, u64::saturating_add);
    c.require(total <= most, "bodies", || format!("they have {total} {what}, more than {most}"));
}

fn check_body(c: &mut Checker, body: &Body, has_trusses: bool) {
    match body {
        Body::Rigid(rigid) => check_rigid(c, rigid, has_trusses),
        Body::Cloth(cloth) => check_cloth(c, cloth, has_trusses),
        Body::Rope(rope) => check_rope(c, rope, has_trusses),
        Body::SoftSolid(solid) => check_soft_solid(c, solid, has_trusses),
        Body::HalfSpace(HalfSpace { normal, offset, friction, restitution, rolling_friction, .. }) => {
            c.direction("normal", normal);
            c.number("offset", *offset, COORDINATE);
            c.number("friction", *friction, NOT_NEGATIVE);
            check_surface_of_rigid(c, *restitution, *rolling_friction, has_trusses);
        }
        Body::Room(Room { min, max, friction, restitution, rolling_friction, .. }) => {
            check_box(c, min, max);
            c.number("friction", *friction, NOT_NEGATIVE);
            check_surface_of_rigid(c, *restitution, *rolling_friction, has_trusses);
        }
    }
}

/// What rigid bodies and walls have, but trusses have not.
fn check_surface_of_rigid(c: &mut Checker, restitution: Option<f32>, rolling: Option<f32>, is_truss: bool) {
    c.optional("restitution", restitution, SHARE);
    c.optional("rolling_friction", rolling, THICKNESS);
    for (field, is_given) in [("restitution", restitution.is_some()), ("rolling_friction", rolling.is_some())]
    {
        c.require(!(is_truss && is_given), field, || NOT_OF_TRUSSES.to_owned());
    }
}

fn check_rope(c: &mut Checker, rope: &Rope, has_trusses: bool) {
    match &rope.path {
        Thread::Line { from, to, segments } => c.within("path.line", |c| {
            c.vector("from", from, COORDINATE);
            c.vector("to", to, COORDINATE);
            c.require(from != to, "to", || "it is where the rope begins".to_owned());
            c.count("segments", *segments, 1, limits::PARTICLES as u32 - 1);
        }),
        Thread::Points(points) => {
            c.points("path.points", points);
            c.require(points.len() >= 2, "path.points", || {
                format!("{} points make no rope: at least 2", points.len())
            });
            for (k, pair) in points.windows(2).enumerate() {
                c.require(pair[0] != pair[1], format_args!("path.points[{}]", k + 1), || {
                    "it is where the point before it is".to_owned()
                });
            }
        }
        Thread::Network { points, segments } => check_network(c, points, segments),
    }
    c.optional("length", rope.length, LENGTH);
    c.number("radius", rope.radius, LENGTH);
    c.vector("velocity", &rope.velocity, COORDINATE);
    c.number("mass", rope.mass, MASS);
    let count = rope.path.point_count();
    for (k, pin) in rope.pins.iter().enumerate() {
        check_pin(c, format_args!("pins[{k}]"), pin, count);
    }
    for (k, weight) in rope.weights.iter().enumerate() {
        check_pin(c, format_args!("weights[{k}].at"), &weight.at, count);
        c.number(format_args!("weights[{k}].mass"), weight.mass, MASS);
    }
    c.number("friction", rope.friction, NOT_NEGATIVE);
    c.optional("bending", rope.bending, NOT_NEGATIVE);
    check_bending_stiffness(c, rope.bending_stiffness, rope.bending);
    c.optional("compliance", rope.compliance, UP_TO_LARGE);
    let fields =
        [("bending_stiffness", rope.bending_stiffness.is_some()), ("compliance", rope.compliance.is_some())];
    check_beyond_paper(c, &fields, has_trusses);
    c.optional("least_angle_degrees", rope.least_angle_degrees, ANGLE);
}

fn check_bending_stiffness(c: &mut Checker, stiffness: Option<f32>, compliance: Option<f32>) {
    c.optional("bending_stiffness", stiffness, STIFFNESS);
    c.require(stiffness.is_none() || compliance.is_none(), "bending_stiffness", || {
        "there is bending already: give one of the two".to_owned()
    });
}

/// Refuses fields that are given and that the solver of trusses does not know.
fn check_beyond_paper(c: &mut Checker, fields: &[(&str, bool)], has_trusses: bool) {
    for (field, is_given) in fields {
        c.require(!(has_trusses && *is_given), field, || NOT_OF_TRUSSES.to_owned());
    }
}

fn check_network(c: &mut Checker, points: &[[f32; 3]], segments: &[[u32; 2]]) {
    c.points("path.network.points", points);
    c.require(!segments.is_empty(), "path.network.segments", || "there are none".to_owned());
    for (k, ends) in segments.iter().enumerate() {
        for (side, &end) in ends.iter().enumerate() {
            c.require(
                (end as usize) < points.len(),
                format_args!("path.network.segments[{k}][{side}]"),
                || format!("{end} is the index of no point: there are {}", points.len()),
            );
        }
    }
}

fn check_pin<Place>(c: &mut Checker, field: impl Display, pin: &Pin<Place>, count: u64) {
    if let Pin::Index(index) = *pin {
        c.require(u64::from(index) < count, field, || {
            format!("{index} is the index of no particle: there are {count}")
        });
    }
}

fn check_mass_or_density(c: &mut Checker, mass: Option<f32>, density: Option<f32>) {
    c.optional("mass", mass, MASS);
    c.optional("density", density, MASS);
    c.require(mass.is_none() || density.is_none(), "density", || {
        "there is a mass already: give one of the two".to_owned()
    });
}

fn check_rotation(c: &mut Checker, rotation: &Rotation) {
    match rotation {
        Rotation::Quaternion(quaternion) => c.direction("rotation", quaternion),
        Rotation::AxisAngle(AxisAngle { axis, degrees }) => c.within("rotation", |c| {
            c.direction("axis", axis);
            c.number("degrees", *degrees, FINITE);
        }),
    }
}

fn check_box(c: &mut Checker, min: &[f32; 3], max: &[f32; 3]) {
    c.vector("min", min, COORDINATE);
    c.vector("max", max, COORDINATE);
    for k in 0..3 {
        c.require(
            min[k] < max[k] || !min[k].is_finite() || !max[k].is_finite(),
            format_args!("max[{k}]"),
            || format!("{} is not above min[{k}], {}", max[k], min[k]),
        );
    }
}
