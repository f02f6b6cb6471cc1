//! Ropes over round things.

use std::f64::consts::PI;
use std::sync::Arc;

use tautline::{BodyHandle, Error, HingeJoint, Quat, RigidBody, Rope, Shape, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{DT, G, run, steps, threshold};

pub(super) fn cases() -> Vec<Case> {
    vec![atwood(), capstan()]
}

/// Of the cylinder, in m.
const RADIUS: f64 = 0.3;
/// Of the rope, in m.
const THICKNESS: f64 = 0.005;
/// How far the rope hangs down on either side at first, in m.
const HANGING: f64 = 1.0;
/// Of the rope, in kg/m.
const HEAVINESS: f64 = 0.02;

/// A rope over a cylinder whose axis is z, with a mass (kg) at either end.
struct Over {
    world: World,
    rope: BodyHandle,
    last: u32,
}

impl Over {
    /// `hold` makes what carries the cylinder.
    fn new(
        conditions: &Conditions,
        [left, right]: [f64; 2],
        links: u32,
        friction: f64,
        hold: impl Fn(&mut World, RigidBody) -> Result<(), Error>,
    ) -> Result<Self, Error> {
        let mut world = conditions.world()?;
        let shape = Arc::new(Shape::cylinder(RADIUS as f32, 0.1)?);
        let roll = RigidBody::new(&shape).rotation(Quat::from_rotation_x(std::f32::consts::FRAC_PI_2));
        hold(&mut world, roll.friction(friction as f32))?;
        let arm = RADIUS + THICKNESS;
        let length = 2.0 * HANGING + PI * arm;
        let point = |i: u32| {
            let along = length * f64::from(i) / f64::from(links) - HANGING;
            if along < 0.0 {
                Vec3::new(-arm as f32, along as f32, 0.0)
            } else if along > PI * arm {
                Vec3::new(arm as f32, (PI * arm - along) as f32, 0.0)
            } else {
                let angle = along / arm;
                Vec3::new((-arm * libm::cos(angle)) as f32, (arm * libm::sin(angle)) as f32, 0.0)
            }
        };
        let rope = Rope::through((0..=links).map(point).collect()).radius(THICKNESS as f32);
        let rope = world.add(rope.mass((HEAVINESS * length) as f32).friction(friction as f32))?;
        world.set_particle_mass(rope, 0, left as f32)?;
        world.set_particle_mass(rope, links, right as f32)?;
        Ok(Self { world, rope, last: links })
    }

    /// Height of the right end, in m.
    fn height(&self) -> Result<f64, Error> {
        Ok(f64::from(self.world.body(self.rope)?.positions()[self.last as usize].y))
    }
}

fn atwood() -> Case {
    let trial = |(left, right, roll, links): (f64, f64, f64, u32)| {
        Trial::one(move |conditions| {
            let hinge = |world: &mut World, body: RigidBody| {
                let body = world.add(body.mass(roll as f32))?;
                world.add_joint(HingeJoint::new(body, None).anchor(Vec3::ZERO).axis(Vec3::Z))?;
                Ok(())
            };
            let mut over = Over::new(conditions, [left, right], links, 1.0, hinge)?;
            let start = over.height()?;
            for _ in 0..steps(0.75) {
                over.world.step(DT)?;
            }
            let (time, fallen) = (over.world.time(), start - over.height()?);
            // The rope that has gone over adds to the heavier side: a = (g/M)(Δ + 2 λ s).
            let rope = HEAVINESS * (2.0 * HANGING + PI * (RADIUS + THICKNESS));
            let total = left + right + rope + 0.5 * roll;
            let rate = (2.0 * HEAVINESS * G / total).sqrt();
            let expected = (right - left) / (2.0 * HEAVINESS) * (libm::cosh(rate * time) - 1.0);
            let name = format!("{left} kg and {right} kg over {roll} kg, {links} links");
            Ok(Part::relative(name, [fallen, expected], 0.02, "m"))
        })
    };
    let variants = [(1.0, 1.5, 0.5, 100), (1.0, 1.5, 2.0, 100), (1.0, 1.2, 0.5, 60), (0.5, 1.0, 1.0, 100)];
    Case {
        id: 28,
        group: "Cloth and rope",
        name: "Atwood's machine",
        formula: "a = g (m₂ − m₁)/(m₁ + m₂ + I/r²)",
        note: "A rope of 20 g/m, which counts, over a cylinder on a hinge; how far it has fallen after 0.75 s.",
        trials: variants.map(trial).into(),
    }
}

/// On the side that holds, in kg.
const HOLDING: f64 = 0.2;

/// The mass on the other side (kg) at which the rope begins to slip: dT/dφ = μ T + λ g r (μ sin φ + cos φ) along half the
/// circumference, from T₁ to T₂, both of which carry the rope that hangs down.
fn slipping(friction: f64) -> f64 {
    let factor = libm::exp(friction * PI);
    let hanging = HEAVINESS * HANGING;
    let wrapped = HEAVINESS * (RADIUS + THICKNESS) * 2.0 * friction / (1.0 + friction * friction);
    factor * (HOLDING + hanging) + wrapped * (factor + 1.0) - hanging
}

fn capstan() -> Case {
    const SLID: f64 = 0.02;
    let trial = |(friction, links): (f64, u32)| {
        Trial::one(move |conditions| {
            let fix = |world: &mut World, body: RigidBody| world.add(body.fixed()).map(|_| ());
            let slips = |mass: f64| {
                let mut over = Over::new(conditions, [HOLDING, mass], links, friction, fix)?;
                run(&mut over.world, 0.75)?;
                // What it gives while it takes up its load is none.
                let start = over.height()?;
                run(&mut over.world, 0.75)?;
                Ok(start - over.height()? > SLID)
            };
            let expected = slipping(friction);
            let measured = threshold([0.94 * expected, 1.06 * expected], 0.016, slips)?;
            Ok(Part::relative(format!("μ = {friction}, {links} links"), [measured, expected], 0.03, "kg"))
        })
    };
    Case {
        id: 29,
        group: "Cloth and rope",
        name: "capstan: a rope over a fixed cylinder begins to slip",
        formula: "T₂/T₁ = e^{μθ}",
        note: "Half around, 0.2 kg on one side, and the rope's own weight counted in. To slip is to move more than 2 cm in \
               0.75 s. The load at which it does is enclosed to 1.5 %.",
        trials: [(0.2, 100), (0.4, 100), (0.6, 100), (0.6, 60)].map(trial).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equation_of_the_capstan_is_integrated_rightly() {
        let friction = 0.4;
        let (mut tension, steps) = (HOLDING + HEAVINESS * HANGING, 100_000);
        for k in 0..steps {
            let angle = PI * (f64::from(k) + 0.5) / f64::from(steps);
            let weight = HEAVINESS * (RADIUS + THICKNESS);
            let slope = friction * tension + weight * (friction * libm::sin(angle) + libm::cos(angle));
            tension += slope * PI / f64::from(steps);
        }
        assert!((tension - HEAVINESS * HANGING - slipping(friction)).abs() < 1e-4, "{tension}");
    }
}
