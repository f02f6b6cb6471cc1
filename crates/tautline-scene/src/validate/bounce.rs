//! Bodies that bounce.

use std::sync::Arc;

use tautline::{Error, HalfSpace, RigidBody, Shape, Vec3};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{DT, G, center};

pub(super) fn cases() -> Vec<Case> {
    vec![elastic(), inelastic()]
}

/// A body that is dropped.
#[derive(Clone, Copy)]
struct Drop {
    name: &'static str,
    shape: fn() -> Result<Shape, Error>,
    /// Of its centre when it lies on the floor, in m.
    rest: f32,
    /// Of its lowest point at the start, in m.
    height: f32,
}

const DROPS: [Drop; 4] = [
    Drop { name: "ball of 1 m from 1 m", shape: || Shape::sphere(0.5), rest: 0.5, height: 1.0 },
    Drop { name: "ball of 10 cm from 5 m", shape: || Shape::sphere(0.05), rest: 0.05, height: 5.0 },
    Drop { name: "ball of 1 m from 2.37 m", shape: || Shape::sphere(0.5), rest: 0.5, height: 2.37 },
    Drop {
        name: "cube on its face from 1 m",
        shape: || Shape::cuboid(Vec3::splat(0.5)),
        rest: 0.5,
        height: 1.0,
    },
];

fn elastic() -> Case {
    let trial = |drop: Drop| {
        Trial::new(move |conditions| {
            let apexes = apexes(conditions, drop, 1.0, 10)?;
            let h0 = f64::from(drop.height);
            let (first, tenth) = (apexes[0], apexes[9]);
            let highest = apexes.iter().copied().fold(0.0, f64::max);
            let excess = (highest / h0 - 1.0).max(0.0);
            let name = |what: &str| format!("{}: {what}", drop.name);
            Ok(vec![
                Part::at_least(name("first apex"), [first, h0], 1e-3, "m"),
                Part::at_least(name("tenth apex"), [tenth, h0], 1e-2, "m"),
                Part::at_most(name("gained in any"), excess, 1e-4, ""),
            ])
        })
    };
    Case {
        id: 3,
        group: "Impact",
        name: "bounces with restitution 1",
        formula: "apex = h₀",
        note: "",
        trials: DROPS.map(trial).into(),
    }
}

fn inelastic() -> Case {
    let trial = |(drop, restitution): (Drop, f32)| {
        Trial::one(move |conditions| {
            let apex = apexes(conditions, drop, restitution, 1)?[0];
            let e = f64::from(restitution);
            let name = format!("{}, e = {restitution}", drop.name);
            Ok(Part::relative(name, [apex, e * e * f64::from(drop.height)], 5e-3, "m"))
        })
    };
    let all = DROPS.into_iter().flat_map(|drop| [0.5, 0.8, 0.3].map(|e| (drop, e)));
    Case {
        id: 4,
        group: "Impact",
        name: "bounce with restitution e",
        formula: "apex = e²h₀",
        note: "",
        trials: all.map(trial).collect(),
    }
}

/// How high the lowest point of a dropped body gets after each of `count` bounces, in m; 0 for bounces that do not
/// come within a minute. From a sample next to the apex and the velocity there, v = (y₊ − y₋)/2Δt: y + v²/2g.
fn apexes(conditions: &Conditions, drop: Drop, restitution: f32, count: usize) -> Result<Vec<f64>, Error> {
    let mut world = conditions.world()?;
    world.add(HalfSpace::floor(0.0).restitution(restitution))?;
    let shape = Arc::new((drop.shape)()?);
    let body = RigidBody::new(&shape).mass(1.0).restitution(restitution);
    let body = world.add(body.position(Vec3::Y * (drop.rest + drop.height)))?;
    let mut apexes = Vec::new();
    let (mut before, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
    for _ in 0..3600 {
        if apexes.len() == count {
            break;
        }
        world.step(DT)?;
        let y = center(&world, body)?.y - f64::from(drop.rest);
        // The start is no apex of a bounce.
        if before <= last && last > y && before.is_finite() {
            let velocity = (y - before) / (2.0 * f64::from(DT));
            apexes.push(last + velocity * velocity / (2.0 * G));
        }
        (before, last) = (last, y);
    }
    apexes.resize(count, 0.0);
    Ok(apexes)
}
