//! Anchors as they are given become ends of attachments.

use glam::Vec3;

use super::{Anchor, Attached, Attachment, End, Place};
use crate::body::{Body, Deformable, Rigid, Substance};
use crate::error::{Error, coordinates, within};
use crate::settings::ClothSolver;
use crate::world::World;

/// How far the weights of an anchor may be from 1 together.
const ROUNDING: f32 = 1e-3;

impl Attachment {
    /// Checks everything.
    pub(super) fn build(self, world: &World, anchors: [Anchor; 2]) -> Result<Attached, Error> {
        if world.settings.cloth == ClothSolver::Paper {
            return Err(refuse("settings.cloth", "is the paper's solver, which knows no attachments"));
        }
        self.validate()?;
        let [a, b] = anchors;
        let ends = [a.end("a", world)?, b.end("b", world)?];
        let is_soft = |end: &End| matches!(end, End::Particles { .. });
        if !ends.iter().any(is_soft) {
            let problem =
                "is no cloth or rope, as the other end: a ball joint or a distance joint holds rigid bodies";
            return Err(refuse("b", problem));
        }
        if share_a_particle(&ends) {
            return Err(refuse("b", "holds a particle that the other end holds"));
        }
        Ok(Attached { ends, strength: self, force: Vec3::ZERO, is_broken: false })
    }
}

impl Anchor {
    fn end(self, field: &str, world: &World) -> Result<End, Error> {
        let Some(handle) = self.body else { return in_world(field, self.place) };
        let index = world.slots.index(handle)?;
        let body = &world.bodies[index];
        match &body.substance {
            Substance::Rigid(rigid) => on_rigid(field, index as u32, rigid, self.place),
            Substance::HalfSpace(_) => in_world(field, self.place),
            Substance::Deformable(deformable) => on_soft(field, index as u32, (body, deformable), self.place),
            Substance::Truss { .. } => Err(refuse(field, "is a truss: these have no attachments")),
        }
    }
}

fn in_world(field: &str, place: Place) -> Result<End, Error> {
    match place {
        Place::Point(point) => Ok(End::World(coordinates(&format!("{field}.point"), point)?)),
        Place::Particle(_) | Place::Triangle(..) | Place::Segment(..) => Err(no_particles(field)),
    }
}

fn on_rigid(field: &str, body: u32, rigid: &Rigid, place: Place) -> Result<End, Error> {
    match place {
        Place::Point(point) => {
            let point = coordinates(&format!("{field}.point"), point)?;
            let turned = rigid.shape.principal_rotation().conjugate();
            Ok(End::Point { body, point: turned * (point - rigid.shape.center_of_mass()) })
        }
        Place::Particle(_) | Place::Triangle(..) | Place::Segment(..) => Err(no_particles(field)),
    }
}

fn on_soft(field: &str, index: u32, body: (&Body, &Deformable), place: Place) -> Result<End, Error> {
    let (body, deformable) = body;
    let number = |what: &str, number: u32, count: usize, expected| {
        let is_there = (number as usize) < count;
        let out = || Error::OutOfRange { field: format!("{field}.{what}"), value: number.into(), expected };
        is_there.then_some(number as usize).ok_or_else(out)
    };
    let end = |particles, weights| End::Particles { body: index, particles, weights };
    match place {
        Place::Particle(particle) => {
            number("particle", particle, body.particles.len(), "the number of one of its particles")?;
            Ok(end([particle; 3], [1.0, 0.0, 0.0]))
        }
        Place::Triangle(triangle, weights) => {
            let count = deformable.triangles.len();
            let triangle = number("triangle", triangle, count, "the number of one of its triangles")?;
            Ok(end(deformable.triangles[triangle], shares(field, weights)?))
        }
        Place::Segment(segment, fraction) => {
            let count = if deformable.is_rope() { deformable.sticks.len() } else { 0 };
            let segment = number("segment", segment, count, "the number of a segment of a rope")?;
            let fraction =
                within(&format!("{field}.fraction"), fraction, 0.0, 1.0, "a fraction from 0 to 1")?;
            let stick = deformable.sticks[segment];
            Ok(end([stick.a, stick.b, stick.a], [1.0 - fraction, fraction, 0.0]))
        }
        Place::Point(_) => {
            Err(refuse(field, "is a cloth or rope: name a particle, a triangle or a segment of it"))
        }
    }
}

/// Weights that are 1 together.
fn shares(field: &str, weights: [f32; 3]) -> Result<[f32; 3], Error> {
    for (number, weight) in weights.into_iter().enumerate() {
        within(&format!("{field}.weights[{number}]"), weight, 0.0, 1.0, "a share from 0 to 1")?;
    }
    let sum: f32 = weights.iter().sum();
    let expected = "three shares that are 1 together";
    within(&format!("{field}.weights"), sum, 1.0 - ROUNDING, 1.0 + ROUNDING, expected)?;
    Ok(weights.map(|weight| weight / sum))
}

fn share_a_particle([a, b]: &[End; 2]) -> bool {
    let (
        &End::Particles { body, particles, weights },
        &End::Particles { body: other_body, particles: others, weights: other_weights },
    ) = (a, b)
    else {
        return false;
    };
    let held = |particles: [u32; 3], weights: [f32; 3]| {
        particles.into_iter().zip(weights).filter(|&(_, weight)| weight > 0.0).map(|(particle, _)| particle)
    };
    body == other_body
        && held(particles, weights).any(|one| held(others, other_weights).any(|other| one == other))
}

fn no_particles(field: &str) -> Error {
    refuse(field, "is no cloth or rope: it is held at a point")
}

fn refuse(field: &str, problem: &str) -> Error {
    Error::Invalid { field: field.into(), problem: problem.into() }
}
