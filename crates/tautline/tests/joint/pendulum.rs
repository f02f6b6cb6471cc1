//! What swings: period, amplitude and energy, against closed forms.

use std::f64::consts::PI;

use tautline::{
    BallJoint, BodyHandle, DistanceJoint, HingeJoint, JointDescription, Quat, RigidBody, Shape, Vec3, World,
};

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
fn swing(joint: impl Fn(BodyHandle) -> JointDescription, degrees: f32) -> (f64, f64) {
    let mut world = World::new(sleepless()).unwrap();
    let angle = degrees.to_radians();
    let rotation = Quat::from_rotation_z(angle);
    let rod =
        RigidBody::new(&cuboid(0.05, 0.5, 0.05)).position(rotation * (Vec3::NEG_Y * 0.5)).rotation(rotation);
    let rod = world.add(rod).unwrap();
    world.add_joint(joint(rod)).unwrap();
    let (mut crossings, mut peak) = (Vec::new(), 0.0f64);
    let [mut last, mut now] = [f64::from(angle); 2];
    while crossings.len() < 21 {
        world.step(DT).unwrap();
        let c = center(&world, rod).as_dvec3();
        let before = last;
        (last, now) = (now, c.x.atan2(-c.y));
        if last < 0.0 && now >= 0.0 {
            crossings.push(world.time() - f64::from(DT) * now / (now - last));
        }
        if crossings.len() >= 19 && before < last && last >= now {
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
            assert!(error.abs() < 5e-5 && (kept - 1.0).abs() < 1e-4);
        }
    }
}

/// Kinetic and potential energy of rods, in J, half a substep ago for the velocities.
fn energy(world: &World, rods: &[BodyHandle], inertia_per_mass: Vec3) -> f64 {
    let of = |rod: &BodyHandle| {
        let view = world.body(*rod).unwrap();
        let (_, rotation) = view.pose().unwrap();
        let spin = rotation.conjugate() * view.angular_velocity();
        let speed_squared = f64::from(view.velocity().length_squared());
        let spin_energy = f64::from((spin * spin).dot(inertia_per_mass));
        f64::from(view.mass())
            * (0.5 * speed_squared + 0.5 * spin_energy + G * f64::from(view.center_of_mass().y))
    };
    rods.iter().map(of).sum()
}

/// Σ over n links of a chain that starts level: it whips about chaotically, and keeps its energy.
#[test]
fn a_double_pendulum_keeps_its_energy() {
    for (name, is_hinge) in [("hinges", true), ("balls", false)] {
        let mut world = World::new(sleepless()).unwrap();
        let shape = cuboid(0.5, 0.05, 0.05);
        let mut rods = Vec::new();
        for k in 0..2 {
            let rod = world.add(RigidBody::new(&shape).position(Vec3::X * (k as f32 + 0.5))).unwrap();
            let (base, point) = (rods.last().copied(), Vec3::X * k as f32);
            if is_hinge {
                world.add_joint(HingeJoint::new(rod, base).anchor(point).axis(Vec3::Z)).unwrap();
            } else {
                world.add_joint(BallJoint::new(rod, base).anchor(point)).unwrap();
            }
            rods.push(rod);
        }
        let c = Vec3::new(0.25, 0.0025, 0.0025) / 3.0;
        let inertia = Vec3::new(c.y + c.z, c.z + c.x, c.x + c.y);
        // Over the deepest point both can reach, in units of which the drift is told.
        let mass = f64::from(world.body(rods[0]).unwrap().mass());
        let scale = mass * G * (0.5 + 1.5);
        let mut means = Vec::new();
        for _second in 0..60 {
            let mut mean = 0.0;
            for _ in 0..60 {
                world.step(DT).unwrap();
                mean += energy(&world, &rods, inertia) / 60.0;
            }
            means.push(mean / scale);
        }
        let worst = means.iter().fold(0.0f64, |worst, mean| worst.max(mean.abs()));
        println!("double pendulum on {name}: energy off by {worst:.2e}, at last {:.2e}", means[59]);
        assert!(worst < 2e-3);
        for joint in world.joints() {
            let [on_body, on_base] = world.joint(joint).unwrap().anchors();
            println!("  anchors apart by {:.1e} m", on_body.distance(on_base));
            assert!(on_body.distance(on_base) < 1e-5);
        }
    }
}

/// T = 2π √(L cos θ/g) of a small ball that circles on a rod.
#[test]
fn a_conical_pendulum_keeps_its_period() {
    for degrees in [20.0f32, 45.0, 70.0] {
        let (angle, length) = (degrees.to_radians(), 1.0f32);
        let place = Vec3::new(angle.sin(), -angle.cos(), 0.0) * length;
        let omega = (G / f64::from(length * angle.cos())).sqrt();
        let mut world = World::new(sleepless()).unwrap();
        let shape = std::sync::Arc::new(Shape::sphere(0.01).unwrap());
        let ball = RigidBody::new(&shape).position(place).velocity(Vec3::NEG_Z * (omega as f32 * place.x));
        let ball = world.add(ball).unwrap();
        world.add_joint(DistanceJoint::new(ball, None).anchors(place, Vec3::ZERO)).unwrap();
        let (mut turned, mut last) = (0.0, 0.0f64);
        for _ in 0..3600 {
            world.step(DT).unwrap();
            let c = center(&world, ball).as_dvec3();
            let now = (-c.z).atan2(c.x);
            turned += (now - last) - ((now - last) / (2.0 * PI)).round() * 2.0 * PI;
            last = now;
        }
        let error = omega * world.time() / turned - 1.0;
        let height = f64::from(center(&world, ball).y) + f64::from(length * angle.cos());
        println!("conical pendulum at {degrees}°: period off by {error:.2e}, height by {height:.1e} m");
        assert!(error.abs() < 5e-5);
    }
}

/// A chain with a weight of 1000 links at its end: it stretches by nothing to speak of, at rest and swinging.
#[test]
fn a_chain_holds_a_thousand_times_the_mass_of_a_link() {
    for tilt in [0.0f32, 1.0] {
        let mut world = World::new(sleepless()).unwrap();
        let along = Quat::from_rotation_z(tilt) * Vec3::NEG_Y;
        let link = cuboid(0.02, 0.05, 0.02);
        let mut base = None;
        for k in 0..30 {
            let rod = RigidBody::new(&link).rotation(Quat::from_rotation_z(tilt)).mass(0.1);
            let rod = world.add(rod.position(along * (0.1 * k as f32 + 0.05))).unwrap();
            world.add_joint(BallJoint::new(rod, base).anchor(along * (0.1 * k as f32))).unwrap();
            base = Some(rod);
        }
        let weight = RigidBody::new(&cuboid(0.2, 0.2, 0.2))
            .mass(100.0)
            .rotation(Quat::from_rotation_z(tilt))
            .position(along * 3.25);
        let weight = world.add(weight).unwrap();
        world.add_joint(BallJoint::new(weight, base).anchor(along * 3.0)).unwrap();
        let (mut worst, mut force) = (0.0f32, Vec3::ZERO);
        for _ in 0..600 {
            world.step(DT).unwrap();
            for joint in world.joints() {
                let [on_body, on_base] = world.joint(joint).unwrap().anchors();
                worst = worst.max(on_body.distance(on_base));
            }
            let first = world.joints().next().unwrap();
            force = world.joint(first).unwrap().force();
        }
        let hangs = center(&world, weight).length();
        println!("chain tilted by {tilt}: apart by {worst:.1e} m, {hangs} m long, held by {force} N");
        assert!(worst < 1e-4);
        if tilt == 0.0 {
            let expected = 103.0 * G as f32;
            assert!((force.y / expected - 1.0).abs() < 1e-3 && force.with_y(0.0).length() < 1.0, "{force}");
        }
    }
}
