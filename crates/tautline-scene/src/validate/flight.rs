//! Bodies that fly.

use std::sync::Arc;

use tautline::{DVec3, Error, RigidBody, Shape, Vec3};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{G, ball, center, cube, cuboid, run};

const SECONDS: f64 = 2.0;

pub(super) fn cases() -> Vec<Case> {
    vec![free_fall(), projectile()]
}

fn free_fall() -> Case {
    let fall = |name: &'static str, start: Vec3, velocity: Vec3, spin: Vec3, demand: f64| {
        Trial::one(move |conditions| {
            let [measured, expected] = fly(conditions, &cube(1.0)?, [start, velocity, spin])?;
            let mut part = Part::absolute(name, [measured.y, expected.y], demand, "m");
            part.figures.error = (measured - expected).length();
            part.pass = part.figures.error <= demand;
            Ok(part)
        })
    };
    let (up, spin) = (Vec3::Y * 7.0, Vec3::new(2.0, 5.0, -1.0));
    Case {
        id: 1,
        group: "Flight",
        name: "free fall for 2 s",
        formula: "y₀ + v₀t − ½gt²",
        note: "Off is the distance of the centre from where it should be. 1 km from the origin f32 is as coarse as 0.06 mm.",
        trials: vec![
            fall("from rest", Vec3::Y * 10.0, Vec3::ZERO, Vec3::ZERO, 1e-4),
            fall("thrown up, tumbling", Vec3::Y, up, spin, 1e-4),
            fall("fast tumbling", Vec3::ZERO, Vec3::ZERO, spin * 8.0, 1e-4),
            fall("from 1 km above", Vec3::Y * 1000.0, Vec3::ZERO, Vec3::ZERO, 5e-3),
            fall("1 km to the side", Vec3::new(1000.0, 3.0, -1000.0), up, spin, 5e-3),
        ],
    }
}

fn projectile() -> Case {
    let shot = |name: &'static str, shape: fn() -> Result<Arc<Shape>, Error>, velocity: Vec3, spin: Vec3| {
        Trial::one(move |conditions| {
            let [measured, expected] = fly(conditions, &shape()?, [Vec3::Y, velocity, spin])?;
            Ok(Part::absolute(name, [measured.x, expected.x], 2e-5, "m"))
        })
    };
    let plank = || cuboid(Vec3::new(0.5, 0.05, 0.2));
    Case {
        id: 2,
        group: "Flight",
        name: "projectile, x after 2 s",
        formula: "v t",
        note: "",
        trials: vec![
            shot("ball, 5 m/s", || ball(0.1), Vec3::new(5.0, 10.0, 0.0), Vec3::ZERO),
            shot("cube, 3.3 m/s", || cube(1.0), Vec3::new(3.3, 5.0, 1.0), Vec3::ZERO),
            shot("tumbling plank, 7.7 m/s", plank, Vec3::new(7.7, 5.0, 1.0), Vec3::new(1.0, -4.0, 3.0)),
            shot("ball, 20 m/s", || ball(0.1), Vec3::new(20.0, 15.0, 0.0), Vec3::ZERO),
        ],
    }
}

/// Where a body is after [`SECONDS`] and where it should be, from its start, velocity and angular velocity.
fn fly(
    conditions: &Conditions,
    shape: &Arc<Shape>,
    [start, velocity, spin]: [Vec3; 3],
) -> Result<[DVec3; 2], Error> {
    let mut world = conditions.world()?;
    let body = RigidBody::new(shape).mass(1.0).position(start).velocity(velocity).angular_velocity(spin);
    let body = world.add(body)?;
    run(&mut world, SECONDS)?;
    let t = world.time();
    let expected = start.as_dvec3() + velocity.as_dvec3() * t - DVec3::Y * (0.5 * G * t * t);
    Ok([center(&world, body)?, expected])
}
