//! Bodies that collide in free space.

use std::sync::Arc;

use tautline::{BodyHandle, Error, RigidBody, Shape, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{DT, ball, cube, run, velocity};

pub(super) fn cases() -> Vec<Case> {
    vec![head_on(), cradle()]
}

/// A body that hits another one, which is at rest.
#[derive(Clone, Copy)]
struct Hit {
    shape: fn() -> Result<Arc<Shape>, Error>,
    name: &'static str,
    /// In kg, of both.
    masses: [f32; 2],
    restitution: f32,
    /// In m/s.
    speed: f32,
}

fn head_on() -> Case {
    let balls = |masses: [f32; 2], restitution: f32, speed: f32| Hit {
        shape: || ball(0.5),
        name: "balls",
        masses,
        restitution,
        speed,
    };
    let mut hits = Vec::new();
    for masses in [[1.0, 1.0], [3.0, 1.0], [1.0, 3.0], [100.0, 1.0], [1.0, 100.0]] {
        hits.push(balls(masses, 1.0, 2.0));
    }
    hits.push(balls([1.0, 2.0], 0.5, 3.1));
    hits.push(balls([1.0, 2.0], 0.0, 3.1));
    hits.push(balls([2.0, 1.0], 1.0, 20.0));
    hits.push(Hit { shape: || cube(1.0), name: "cubes, face to face", ..balls([1.0, 3.0], 1.0, 2.0) });
    Case {
        id: 5,
        group: "Impact",
        name: "central collision of two bodies",
        formula: "v₁' = v(m₁ − e m₂)/(m₁ + m₂), v₂' = v(1 + e)m₁/(m₁ + m₂)",
        note: "",
        trials: hits.into_iter().map(|hit| Trial::new(move |conditions| collide(conditions, hit))).collect(),
    }
}

fn collide(conditions: &Conditions, hit: Hit) -> Result<Vec<Part>, Error> {
    let mut world = conditions.weightless()?;
    let shape = (hit.shape)()?;
    let body = |mass: f32, x: f32, speed: f32| {
        let body = RigidBody::new(&shape).mass(mass).restitution(hit.restitution);
        body.position(Vec3::X * x).velocity(Vec3::X * speed)
    };
    let first = world.add(body(hit.masses[0], -0.5 - hit.speed * 0.513, hit.speed))?;
    let second = world.add(body(hit.masses[1], 0.5, 0.0))?;
    run(&mut world, 1.0)?;
    let [m1, m2] = hit.masses.map(f64::from);
    let (v, e) = (f64::from(hit.speed), f64::from(hit.restitution));
    let momentum = world.momentum();
    let name = |what: &str| {
        let Hit { name, masses: [a, b], restitution, speed, .. } = hit;
        format!("{name}, {a} : {b}, e = {restitution}, {speed} m/s: {what}")
    };
    let speed = |body: BodyHandle, expected: f64, what: &str| -> Result<Part, Error> {
        let measured = velocity(&world, body)?.x;
        Ok(Part::absolute(name(what), [measured / v, expected / v], 1e-5, ""))
    };
    Ok(vec![
        speed(first, (m1 - e * m2) / (m1 + m2) * v, "first body's share of the speed")?,
        speed(second, (1.0 + e) * m1 / (m1 + m2) * v, "second body's share of the speed")?,
        Part::relative(name("momentum"), [momentum.x, m1 * v], 1e-6, "kg m/s"),
    ])
}

fn cradle() -> Case {
    let trial = |(gap, speed): (f32, f32)| {
        Trial::new(move |conditions| {
            let (balls, mut world) = row_of_balls(conditions, 5, gap, speed)?;
            let mut highest: f64 = 0.0;
            let start = world.kinetic_energy();
            for _ in 0..60 {
                world.step(DT)?;
                highest = highest.max(world.kinetic_energy() / start - 1.0);
            }
            let last = velocity(&world, balls[4])?.x;
            let name = |what: &str| format!("gaps of {} mm, {speed} m/s: {what}", gap * 1e3);
            Ok(vec![
                Part::relative(name("speed of the last"), [last, f64::from(speed)], 1e-2, "m/s"),
                Part::at_most(name("energy gained"), highest, 1e-6, ""),
            ])
        })
    };
    let variants = [(1e-3, 1.0), (1e-3, 3.0), (1e-3, 0.3), (5e-3, 1.0)];
    Case {
        id: 6,
        group: "Impact",
        name: "cradle of five balls",
        formula: "the last ball takes the speed of the first",
        note: "Balls of 20 cm without gravity, with gaps between them.",
        trials: variants.map(trial).into(),
    }
}

fn row_of_balls(
    conditions: &Conditions,
    count: usize,
    gap: f32,
    speed: f32,
) -> Result<(Vec<BodyHandle>, World), Error> {
    const RADIUS: f32 = 0.1;
    let mut world = conditions.weightless()?;
    let shape = ball(RADIUS)?;
    let mut balls = Vec::new();
    for i in 0..count {
        let x = i as f32 * (2.0 * RADIUS + gap);
        let body = RigidBody::new(&shape).mass(1.0).restitution(1.0);
        let body = match i {
            0 => body.position(Vec3::X * -0.25 * speed).velocity(Vec3::X * speed),
            _ => body.position(Vec3::X * x),
        };
        balls.push(world.add(body)?);
    }
    Ok((balls, world))
}
