//! What swings from joints, against closed forms.

use std::f64::consts::{PI, TAU};

use tautline::{
    BallJoint, BodyHandle, DistanceJoint, Error, HingeJoint, JointDescription, Quat, RigidBody, Vec3, World,
};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{Crossings, DT, G, ball, center, cuboid, steps};

pub(super) fn cases() -> Vec<Case> {
    vec![rod_pendulum(), double_pendulum(), conical_pendulum()]
}

/// What a rod hangs from.
#[derive(Clone, Copy)]
enum Hanger {
    Hinge,
    Ball,
}

impl Hanger {
    fn name(self) -> &'static str {
        match self {
            Self::Hinge => "hinge",
            Self::Ball => "ball joint",
        }
    }

    /// Holds a rod at a point, so that it swings in the plane z = 0.
    fn hold(self, rod: BodyHandle, base: Option<BodyHandle>, point: Vec3) -> JointDescription {
        match self {
            Self::Hinge => HingeJoint::new(rod, base).anchor(point).axis(Vec3::Z).into(),
            Self::Ball => BallJoint::new(rod, base).anchor(point).into(),
        }
    }
}

/// The complete elliptic integral of the first kind, by Gauss's arithmetic-geometric mean.
fn elliptic_k(modulus: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - modulus * modulus).sqrt());
    for _ in 0..30 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    PI / (2.0 * a)
}

/// Of the rod, in m: half its width and half its length.
const ROD: [f32; 2] = [0.05, 0.5];

/// The mean of 20 periods of a rod that hangs by its end, and how far it still swings, in rad.
fn swing(conditions: &Conditions, hanger: Hanger, angle: f64) -> Result<[f64; 2], Error> {
    let mut world = conditions.world()?;
    let rotation = Quat::from_rotation_z(angle as f32);
    let [width, length] = ROD;
    let rod = RigidBody::new(&cuboid(Vec3::new(width, length, width))?);
    let rod = world.add(rod.position(rotation * (Vec3::NEG_Y * length)).rotation(rotation))?;
    world.add_joint(hanger.hold(rod, None, Vec3::ZERO))?;
    let (mut crossings, mut last) = (Crossings::default(), [angle; 2]);
    let mut furthest = 0.0;
    // The longest of these periods is below 3 s.
    for _ in 0..steps(70.0) {
        world.step(DT)?;
        let place = center(&world, rod)?;
        let now = place.x.atan2(-place.y);
        crossings.add(world.time(), now);
        let [before, middle] = last;
        match crossings.times().len() {
            0..38 => {}
            // The top of the parabola through three angles.
            38..41 if before.abs() < middle.abs() && middle.abs() >= now.abs() => {
                let top = middle + (now - before).powi(2) / (8.0 * (2.0 * middle - before - now));
                furthest = f64::max(furthest, top.abs());
            }
            38..41 => {}
            _ => break,
        }
        last = [middle, now];
    }
    Ok([crossings.period(), furthest])
}

fn rod_pendulum() -> Case {
    let trial = |(degrees, hanger): (f64, Hanger)| {
        Trial::new(move |conditions| {
            let angle = f64::from((degrees as f32).to_radians());
            let [measured, kept] = swing(conditions, hanger, angle)?;
            // About its end I/m = (w² + l²)/3 + l², and ω₀² = g l m/I.
            let [width, length] = ROD.map(f64::from);
            let inertia = (width * width + length * length) / 3.0 + length * length;
            let expected = 4.0 * (inertia / (G * length)).sqrt() * elliptic_k((0.5 * angle).sin());
            let name = |what: &str| format!("{degrees}° on a {}: {what}", hanger.name());
            Ok(vec![
                Part::relative(name("period"), [measured, expected], 1e-3, "s"),
                Part::at_least(name("amplitude kept"), [kept.to_degrees(), degrees], 0.01, "°"),
            ])
        })
    };
    let angles = [5.0, 60.0, 90.0, 150.0];
    Case {
        id: 16,
        group: "Joints",
        name: "rod pendulum, mean of 20 periods",
        formula: "T = (4/ω₀) K(sin θ₀/2)",
        note: "A rod of 1 m, 0.1 m thick, by its end. The amplitude is that of the last period.",
        trials: [Hanger::Hinge, Hanger::Ball]
            .iter()
            .flat_map(|h| angles.map(|a| (a, *h)))
            .map(trial)
            .collect(),
    }
}

fn double_pendulum() -> Case {
    let trial = |hanger: Hanger| {
        Trial::one(move |conditions| {
            let mut world = conditions.world()?;
            let shape = cuboid(Vec3::new(0.5, 0.05, 0.05))?;
            let mut base = None;
            for k in 0..2 {
                let at = Vec3::X * k as f32;
                let rod = world.add(RigidBody::new(&shape).mass(1.0).position(at + Vec3::X * 0.5))?;
                world.add_joint(hanger.hold(rod, base, at))?;
                base = Some(rod);
            }
            // From level to straight down the two centres go 0.5 and 1.5 m.
            let scale = G * 2.0;
            let mut drift = 0.0f64;
            for _ in 0..60 {
                drift = drift.max(mean_energy(&mut world)?.abs() / scale);
            }
            Ok(Part::at_most(format!("on {}s", hanger.name()), drift, 0.01, ""))
        })
    };
    Case {
        id: 17,
        group: "Joints",
        name: "double pendulum: energy for 60 s",
        formula: "E stays",
        note: "Two rods of 1 m let go level. The mean of any second, over what there is to fall.",
        trials: [Hanger::Hinge, Hanger::Ball].map(trial).into(),
    }
}

/// The mean energy of a second, in J: velocities are those of half a substep before.
fn mean_energy(world: &mut World) -> Result<f64, Error> {
    let mut sum = 0.0;
    for _ in 0..steps(1.0) {
        world.step(DT)?;
        sum += world.kinetic_energy() + world.potential_energy();
    }
    Ok(sum / steps(1.0) as f64)
}

fn conical_pendulum() -> Case {
    let trial = |degrees: f64| {
        Trial::new(move |conditions| {
            let angle = degrees.to_radians();
            let expected = TAU * (angle.cos() / G).sqrt();
            let place = Vec3::new(angle.sin() as f32, -angle.cos() as f32, 0.0);
            let speed = (TAU / expected) as f32 * place.x;
            let mut world = conditions.world()?;
            let body = RigidBody::new(&ball(0.01)?).position(place).velocity(Vec3::NEG_Z * speed);
            let body = world.add(body)?;
            world.add_joint(DistanceJoint::new(body, None).anchors(place, Vec3::ZERO))?;
            let (mut crossings, mut highest) = (Crossings::default(), 0.0f64);
            for _ in 0..steps(60.0) {
                world.step(DT)?;
                let place = center(&world, body)?;
                crossings.add(world.time(), place.z);
                highest = highest.max((place.y + angle.cos()).abs());
            }
            Ok(vec![
                Part::relative(format!("{degrees}°: period"), [crossings.period(), expected], 1e-3, "s"),
                Part::at_most(format!("{degrees}°: change of height"), highest, 1e-3, "m"),
            ])
        })
    };
    Case {
        id: 27,
        group: "Joints",
        name: "conical pendulum for 60 s",
        formula: "T = 2π √(L cos θ/g)",
        note: "A small ball on a distance joint of 1 m.",
        trials: [20.0, 45.0, 70.0].map(trial).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_elliptic_integral_is_that_of_the_tables() {
        // Abramowitz & Stegun, table 17.1: m = k² = 0.5, 0.9.
        for (m, expected) in [(0.0f64, 0.5 * PI), (0.5, 1.854_074_677_301_372), (0.9, 2.578_092_113_348_17)] {
            assert!((elliptic_k(m.sqrt()) - expected).abs() < 1e-12, "{m}");
        }
    }
}
