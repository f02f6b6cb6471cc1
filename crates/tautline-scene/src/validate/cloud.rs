//! A cloud of bodies that nothing holds, and what it has to keep.

use std::sync::Arc;

use tautline::{DVec3, Error, RigidBody, Shape, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{DT, steps};
use crate::random::Random;

pub(super) fn cases() -> Vec<Case> {
    let trial = |(restitution, friction): (f32, f32)| {
        Trial::new(move |conditions| collapse(conditions, restitution, friction))
    };
    vec![Case {
        id: 24,
        group: "Conservation",
        name: "closed cloud without gravity, 5 s",
        formula: "Σp and ΣL stay, energy never grows",
        note: "64 balls, boxes and capsules thrown at each other. Σp is relative to Σm|v|, ΣL to Σm|x||v|, \
               both at the start. The arms of a contact are those of the step's beginning, and bodies slide past each other \
               in a step: ΣL is off a thirtieth of this in steps of 1/480 s with one substep, and no less with more \
               substeps to a step.",
        trials: [(0.0, 0.5), (0.5, 0.5), (0.0, 0.0), (1.0, 0.0)].map(trial).into(),
    }]
}

fn collapse(conditions: &Conditions, restitution: f32, friction: f32) -> Result<Vec<Part>, Error> {
    let mut world = conditions.weightless()?;
    let [linear_scale, angular_scale] = throw(&mut world, restitution, friction)?;
    let (momentum, angular_momentum) = (world.momentum(), world.angular_momentum());
    let start = world.kinetic_energy();
    let (mut linear, mut angular, mut grown): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let mut energy = start;
    for _ in 0..steps(5.0) {
        world.step(DT)?;
        linear = linear.max((world.momentum() - momentum).length() / linear_scale);
        angular = angular.max((world.angular_momentum() - angular_momentum).length() / angular_scale);
        let now = world.kinetic_energy();
        grown = grown.max((now - energy) / start);
        energy = now;
    }
    let name = |what: &str| format!("e = {restitution}, μ = {friction}: {what}");
    Ok(vec![
        Part::at_most(name("momentum"), linear, 1e-6, ""),
        Part::at_most(name("angular momentum"), angular, 1e-6, ""),
        Part::at_most(name("energy gained in a step"), grown, 1e-6, ""),
    ])
}

/// Fills a world; gives Σ m|v| and Σ m|x||v| in return.
fn throw(world: &mut World, restitution: f32, friction: f32) -> Result<[f64; 2], Error> {
    let mut random = Random::new(5);
    let shapes = [
        Shape::sphere(0.4)?,
        Shape::cuboid(Vec3::new(0.3, 0.4, 0.5))?,
        Shape::capsule(0.2, 0.3)?,
        Shape::cuboid(Vec3::splat(0.35))?,
    ]
    .map(Arc::new);
    let mut scales = [0.0; 2];
    for i in 0..64 {
        let grid = DVec3::new((i % 4) as f64, (i / 4 % 4) as f64, (i / 16) as f64) - DVec3::splat(1.5);
        let position = (grid * 1.6).as_vec3() + random.in_cube(0.1);
        let velocity = position * -1.5 + random.vector(0.5);
        let mass = random.between(0.5, 2.0);
        let body = RigidBody::new(&shapes[random.below(shapes.len())]).mass(mass);
        let body = body.restitution(restitution).friction(friction).position(position).velocity(velocity);
        world.add(body.rotation(random.rotation()).angular_velocity(random.vector(2.0)))?;
        let momentum = f64::from(mass * velocity.length());
        scales[0] += momentum;
        scales[1] += momentum * f64::from(position.length());
    }
    Ok(scales)
}
