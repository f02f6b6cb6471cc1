//! What swings: period, amplitude and energy, against closed forms.

use std::f64::consts::PI;

use tautline::{BallJoint, HingeJoint, JointDescription, Quat, RigidBody, Vec3, World};

use crate::{DT, center, cuboid, sleepless};

const G: f64 = 9.81;

/// The complete elliptic integral of the first kind, by Gauss's arithmetic-geometric mean.
fn elliptic_k(modulus: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - modulus * modulus).sqrt());
    for _ in 0..30 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    PI / (2.0 * a)
}

/// The mean of 20 periods of a rod of 1 m hung by its end, and how much of its amplitude is left.
fn swing(joint: impl Fn(tautline::BodyHandle) -> JointDescription, degrees: f32) -> (f64, f64) {
    let mut world = World::new(sleepless()).unwrap();
    let angle = degrees.to_radians();
    let rotation = Quat::from_rotation_z(angle);
    let rod = RigidBody::new(&cuboid(0.05, 0.5, 0.05)).position(rotation * (Vec3::NEG_Y * 0.5)).rotation(rotation);
    let rod = world.add(rod).unwrap();
    world.add_joint(joint(rod)).unwrap();
    let (mut crossings, mut last, mut now) = (Vec::new(), 0.0f64, 0.0f64);
    let mut before = 0.0f64;
    let (mut peak, mut unwrapped) = (0.0f64, f64::from(angle));
    while crossings.len() < 21 {
        world.step(DT).unwrap();
        let c = center(&world, rod).as_dvec3();
        let raw = c.x.atan2(-c.y);
        unwrapped += ((raw - unwrapped) / (2.0 * PI)).round() * -2.0 * PI + raw - unwrapped;
        unwrapped = raw;
        (before, last, now) = (last, now, unwrapped);
        if last < 0.0 && now >= 0.0 {
            crossings.push(world.time() - f64::from(DT) * now / (now - last));
        }
        if crossings.len() >= 19 && before <= last && last >= now {
            // The top of the parabola through three angles.
            peak = peak.max(last + (now - before).powi(2) / (8.0 * (2.0 * last - before - now)));
        }
    }
    ((crossings[20] - crossings[0]) / 20.0, peak / f64::from(angle))
}

#[test]
fn a_rod_swings_with_its_period_and_keeps_its_amplitude() {
    // About its end I/m = (0.05² + 0.5²)/3 + 0.5², and ω₀² = g r m/I.
    let inertia = (0.05f64.powi(2) + 0.25) / 3.0 + 0.25;
    let omega = (G * 0.5 / inertia).sqrt();
    for degrees in [5.0f32, 60.0, 90.0, 150.0] {
        let expected = 4.0 / omega * elliptic_k((f64::from(degrees).to_radians() / 2.0).sin());
        let hinge = swing(|rod| HingeJoint::new(rod, None).anchor(Vec3::ZERO).axis(Vec3::Z).into(), degrees);
        let ball = swing(|rod| BallJoint::new(rod, None).anchor(Vec3::ZERO).into(), degrees);
        for (name, (period, kept)) in [("hinge", hinge), ("ball", ball)] {
            let error = period / expected - 1.0;
            println!("{name} {degrees}°: period off by {error:.2e}, amplitude kept {kept:.6}");
            assert!(error.abs() < 1e-3 && (0.99..1.01).contains(&kept));
        }
    }
}
