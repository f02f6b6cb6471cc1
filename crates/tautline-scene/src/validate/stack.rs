//! Stacks that stand.

use std::sync::Arc;

use tautline::{BodyHandle, DVec3, Error, HalfSpace, RigidBody, Shape, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::depth::{Placed, Polytope};
use super::lab::{cube, cuboid, run, steps};

pub(super) fn cases() -> Vec<Case> {
    vec![tower_of_ten(), high_towers(), heavy_on_light()]
}

/// Boxes on top of each other, on a floor.
struct Stack {
    world: World,
    bodies: Vec<BodyHandle>,
    solid: Polytope,
    start: Vec<Placed>,
}

impl Stack {
    fn new(conditions: &Conditions, shape: &Arc<Shape>, height: f32, masses: &[f32]) -> Result<Self, Error> {
        let mut world = conditions.world()?;
        world.add(HalfSpace::floor(0.0))?;
        let mut bodies = Vec::new();
        for (i, &mass) in masses.iter().enumerate() {
            let position = Vec3::Y * (height * (i as f32 + 0.5));
            bodies.push(world.add(RigidBody::new(shape).mass(mass).position(position))?);
        }
        let mut stack = Self { world, bodies, solid: Polytope::new(shape), start: Vec::new() };
        stack.start = stack.placed()?;
        Ok(stack)
    }

    fn placed(&self) -> Result<Vec<Placed>, Error> {
        self.bodies.iter().map(|&body| self.solid.placed(&self.world, body)).collect()
    }

    /// How deep the deepest is in its neighbour or the floor now, in mm.
    fn penetration(&self) -> Result<f64, Error> {
        let placed = self.placed()?;
        let mut deepest = placed[0].depth_below(DVec3::Y, 0.0).max(0.0);
        for pair in placed.windows(2) {
            deepest = deepest.max(pair[0].depth_in(&pair[1]));
        }
        Ok(deepest * 1e3)
    }

    /// The furthest that a centre has moved to the side since the start, in mm.
    fn drift(&self) -> Result<f64, Error> {
        let aside = |(now, start): (&Placed, &Placed)| (now.position - start.position).with_y(0.0).length();
        Ok(self.placed()?.iter().zip(&self.start).map(aside).fold(0.0, f64::max) * 1e3)
    }

    /// The greatest drift and penetration in so long, looked at ten times a second.
    fn watch(&mut self, seconds: f64) -> Result<[f64; 2], Error> {
        let (mut drift, mut penetration): (f64, f64) = (0.0, 0.0);
        for _ in 0..steps(seconds) / 6 {
            run(&mut self.world, 0.1)?;
            drift = drift.max(self.drift()?);
            penetration = penetration.max(self.penetration()?);
        }
        Ok([drift, penetration])
    }
}

/// A tower of equal cubes that stands for 30 s; `demands` on drift and penetration, in mm.
fn tower(count: usize, side: f32, mass: f32, demands: [f64; 2]) -> Trial {
    Trial::new(move |conditions| {
        let mut stack = Stack::new(conditions, &cube(side)?, side, &vec![mass; count])?;
        let [drift, penetration] = stack.watch(30.0)?;
        let name = |what: &str| format!("{count} cubes of {side} m, {mass} kg: {what}");
        Ok(vec![
            Part::at_most(name("drift"), drift, demands[0], "mm"),
            Part::at_most(name("penetration"), penetration, demands[1], "mm"),
        ])
    })
}

fn tower_of_ten() -> Case {
    let demands = [0.1, 0.25];
    Case {
        id: 13,
        group: "Stacks",
        name: "tower of 10 cubes for 30 s",
        formula: "drift 0, penetration 0",
        note: "The greatest at any time, looked at ten times a second from the start.",
        trials: vec![
            tower(10, 1.0, 1.0, demands),
            tower(10, 0.5, 125.0, demands),
            tower(5, 0.1, 0.01, demands),
        ],
    }
}

fn high_towers() -> Case {
    Case {
        id: 14,
        group: "Stacks",
        name: "towers of 20 and 40 cubes for 30 s",
        formula: "drift 0, penetration 0",
        note: "As the tower of 10.",
        trials: vec![
            tower(20, 1.0, 1.0, [0.5, 0.5]),
            tower(20, 0.5, 1000.0, [0.5, 0.5]),
            tower(40, 1.0, 1.0, [5.0, 5.0]),
        ],
    }
}

fn heavy_on_light() -> Case {
    let trial = |(ratio, side, demand): (f32, f32, f64)| {
        Trial::new(move |conditions| {
            let mut stack = Stack::new(conditions, &cube(side)?, side, &[1.0, ratio])?;
            let [drift, penetration] = stack.watch(10.0)?;
            let name = |what: &str| format!("1 : {ratio}, cubes of {side} m: {what}");
            Ok(vec![
                Part::at_most(name("penetration"), penetration, demand, "mm"),
                Part::at_most(name("drift"), drift, demand, "mm"),
            ])
        })
    };
    // To stand is to be within a hundredth of its size of where it was.
    let variants = [(10.0, 1.0, 1.0), (100.0, 1.0, 1.0), (100.0, 0.3, 1.0), (1000.0, 1.0, 10.0)];
    let slabs = Trial::one(|conditions| {
        let shape = cuboid(Vec3::new(0.5, 0.1, 0.5))?;
        let mut stack = Stack::new(conditions, &shape, 0.2, &[1.0, 10.0, 100.0])?;
        let [_, penetration] = stack.watch(10.0)?;
        Ok(Part::at_most("slabs 1 : 10 : 100: penetration", penetration, 1.0, "mm"))
    });
    Case {
        id: 15,
        group: "Stacks",
        name: "a heavy cube on a light one for 10 s",
        formula: "penetration 0",
        note: "At 1 : 1000 it has to stand: 1 cm.",
        trials: variants.into_iter().map(trial).chain([slabs]).collect(),
    }
}
