//! Motion turned round: Verlet's integrator goes back the way it came.

use std::sync::Arc;

use tautline::{BodyHandle, Error, Quat, RigidBody, Shape, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{DT, ball, cuboid, pose, turned};

pub(super) fn cases() -> Vec<Case> {
    let trial = |(name, flight, count): (&'static str, Flight, usize)| {
        Trial::new(move |conditions| there_and_back(conditions, name, flight, count))
    };
    let still =
        Flight { shape: || ball(0.1), velocity: Vec3::new(0.3, 5.0, -0.2), spin: Vec3::ZERO, falls: true };
    let plank = || cuboid(Vec3::new(0.5, 0.1, 0.25));
    let tumbling =
        Flight { shape: plank, velocity: Vec3::ZERO, spin: Vec3::new(2.0, 3.0, 1.0), falls: false };
    let thrown = Flight { velocity: Vec3::new(0.5, 4.0, -0.3), falls: true, ..tumbling };
    let top = Flight { spin: Vec3::new(0.1, 0.2, 9.0), ..tumbling };
    let variants = [
        ("particle", still, 60),
        ("tumbling plank", tumbling, 600),
        ("thrown tumbling plank", thrown, 60),
        ("fast spinning plank", top, 300),
    ];
    vec![Case {
        id: 25,
        group: "Conservation",
        name: "motion reversed in time",
        formula: "returns to its start",
        note: "The furthest corner of the body from where it was, after so many steps and as many back. \
               What flies is kept in f64; what is off is rounded where the motion is turned round, since the way back starts \
               from what is shown of it: some 1e-7 of the angular velocity, over 45 rad.",
        trials: variants.map(trial).into(),
    }]
}

#[derive(Clone, Copy)]
struct Flight {
    shape: fn() -> Result<Arc<Shape>, Error>,
    velocity: Vec3,
    spin: Vec3,
    falls: bool,
}

fn there_and_back(
    conditions: &Conditions,
    name: &str,
    flight: Flight,
    count: usize,
) -> Result<Vec<Part>, Error> {
    let shape = (flight.shape)()?;
    let place =
        |position: Vec3, rotation: Quat, velocity: Vec3, spin: Vec3| -> Result<(World, BodyHandle), Error> {
            let mut world = if flight.falls { conditions.world()? } else { conditions.weightless()? };
            let body = RigidBody::new(&shape).mass(1.0).position(position).rotation(rotation);
            let body = world.add(body.velocity(velocity).angular_velocity(spin))?;
            Ok((world, body))
        };
    let (mut world, body) = place(Vec3::ZERO, Quat::IDENTITY, flight.velocity, flight.spin)?;
    let start = corners(&world, body, &shape)?;
    for _ in 0..count {
        world.step(DT)?;
    }
    let view = world.body(body)?;
    let (position, rotation) = view.pose().unwrap_or_default();
    // What is shown is the velocity of half a substep ago.
    let gravity = world.settings().gravity * (0.5 * DT / world.settings().substeps as f32);
    let (mut world, body) =
        place(position, rotation, -(view.velocity() + gravity), -view.angular_velocity())?;
    for _ in 0..count {
        world.step(DT)?;
    }
    let end = corners(&world, body, &shape)?;
    let off = start.iter().zip(&end).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
    Ok(vec![Part::at_most(format!("{name}, {count} steps"), off, 1e-5, "m")])
}

/// The corners of its surface, in the world.
fn corners(world: &World, body: BodyHandle, shape: &Shape) -> Result<Vec<tautline::DVec3>, Error> {
    let (position, rotation) = pose(world, body)?;
    Ok(shape.positions().iter().map(|p| position + turned(rotation, p.as_dvec3())).collect())
}
