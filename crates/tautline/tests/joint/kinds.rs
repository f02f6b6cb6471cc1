//! What each kind of joint holds, drives and lets go, against closed forms.

use std::f64::consts::TAU;

use tautline::{
    BallJoint, BodyHandle, DistanceJoint, FixedJoint, HingeJoint, JointEvent, Motor, Quat, RigidBody,
    Settings, SliderJoint, Vec3, World,
};

use crate::{DT, add, center, cuboid, run, sleepless, weightless};

/// f = √(k/m)/2π; without damping the amplitude stays, with ζ it falls as exp(−ζ ω t).
#[test]
fn a_spring_swings_at_its_frequency() {
    for (frequency, ratio) in [(1.0f32, 0.0f32), (5.0, 0.0), (2.0, 0.05), (20.0, 0.0)] {
        let mut world = World::new(weightless()).unwrap();
        let body = add(&mut world, Vec3::splat(0.1), Vec3::X * 1.2, 3.0);
        let spring = DistanceJoint::new(body, None).anchors(Vec3::X * 1.2, Vec3::ZERO).length(1.0);
        world.add_joint(spring.spring(frequency, ratio)).unwrap();
        let omega = TAU * f64::from(frequency);
        let damped = omega * (1.0 - f64::from(ratio).powi(2)).sqrt();
        let mut worst = 0.0f64;
        for _ in 0..180 {
            world.step(DT).unwrap();
            // A spring begins with the push of a whole substep, not of half of one.
            let t = world.time() + f64::from(DT) / 16.0;
            let decay = (-f64::from(ratio) * omega * t).exp();
            let expected =
                0.2 * decay * ((damped * t).cos() + f64::from(ratio) * omega / damped * (damped * t).sin());
            let error = f64::from(center(&world, body).x) - 1.0 - expected;
            worst = worst.max(error.abs());
        }
        let phase = worst / (0.2 * damped * world.time());
        println!("spring of {frequency} Hz, damping {ratio}: off by {worst:.1e} m, frequency by {phase:.1e}");
        // Newmark's period is long by (ω h)²/12.
        let tolerance = (omega * f64::from(DT) / 8.0).powi(2) / 10.0 + 2e-5 + 2e-3 * f64::from(ratio);
        assert!(phase < tolerance, "frequency off by {phase}, allowed {tolerance}");
    }
}

/// A weight of m hangs m g α lower from a joint with a compliance of α.
#[test]
fn compliance_is_how_far_a_load_moves() {
    let mut world = World::new(sleepless()).unwrap();
    let ball = add(&mut world, Vec3::splat(0.1), Vec3::ZERO, 2.0);
    world.add_joint(BallJoint::new(ball, None).compliance(1e-3)).unwrap();
    let rod = add(&mut world, Vec3::splat(0.1), Vec3::X * 3.0, 2.0);
    let rope = DistanceJoint::new(rod, None).anchors(Vec3::X * 3.0, Vec3::new(3.0, 1.0, 0.0));
    world.add_joint(rope.compliance(1e-3)).unwrap();
    // A beam of two halves that gives way to a torque of m g r.
    let arm = add(&mut world, Vec3::new(0.5, 0.1, 0.1), Vec3::X * 6.5, 2.0);
    let weld = FixedJoint::new(arm, None).anchor(Vec3::X * 6.0).angular_compliance(1e-3);
    let weld = world.add_joint(weld).unwrap();
    run(&mut world, 1800);
    for body in [ball, rod] {
        let sag = -center(&world, body).y;
        assert!((sag / (2.0 * 9.81e-3) - 1.0).abs() < 1e-3, "{sag}");
    }
    let angle = f64::from(-center(&world, arm).y / 0.5).asin();
    let torque = 2.0 * 9.81 * 0.5 * angle.cos();
    assert!((angle.sin() / (torque * 1e-3) - 1.0).abs() < 2e-3, "{angle}");
    let view = world.joint(weld).unwrap();
    assert!((f64::from(view.torque().z) / torque - 1.0).abs() < 1e-3, "{}", view.torque());
}

/// ω = τ t / I until the motor's speed is reached, and not beyond.
#[test]
fn a_motor_accelerates_by_its_torque_and_stops_at_its_speed() {
    let mut world = World::new(weightless()).unwrap();
    let rod = add(&mut world, Vec3::new(0.5, 0.1, 0.1), Vec3::X * 0.5, 6.0);
    let joint = HingeJoint::new(rod, None).anchor(Vec3::ZERO).axis(Vec3::Z).motor(3.0, 2.0);
    let joint = world.add_joint(joint).unwrap();
    let inertia = 6.0 * (0.26 / 3.0 + 0.25);
    let h = f64::from(DT) / 8.0;
    for step in 1..240 {
        run(&mut world, 1);
        let speed = f64::from(world.body(rod).unwrap().angular_velocity().z);
        // The velocity is that of the middle of the last substep; the first substep already has all of its push.
        let expected = (2.0 / inertia * f64::from(DT) * f64::from(step)).min(3.0);
        assert!((speed - expected).abs() < 2e-3 * expected + 2.0 * h * 0.2, "{speed} {expected}");
    }
    assert!((world.body(rod).unwrap().angular_velocity().z - 3.0).abs() < 1e-4);
    world.set_motor(joint, Some(Motor { speed: 0.0, strength: 2.0 })).unwrap();
    run(&mut world, 300);
    assert!(world.body(rod).unwrap().angular_velocity().length() < 1e-4, "the brake holds");
    world.set_motor(joint, None).unwrap();
    let push = Vec3::Z.cross(center(&world, rod));
    world.apply_force(rod, push).unwrap();
    run(&mut world, 1);
    assert!(world.body(rod).unwrap().angular_velocity().z > 1e-3, "it is free");
}

/// v = F t / m until the limit, where it stops without going over.
#[test]
fn a_sliders_motor_pushes_it_to_its_limit() {
    let mut world = World::new(weightless()).unwrap();
    let body = add(&mut world, Vec3::splat(0.1), Vec3::ZERO, 2.0);
    let joint = SliderJoint::new(body, None).axis(Vec3::X).limits(-0.5, 1.0).motor(10.0, 4.0);
    let joint = world.add_joint(joint).unwrap();
    run(&mut world, 30);
    let x = world.joint(joint).unwrap().translation().unwrap();
    assert!((x - 0.25).abs() < 0.005, "half of 2 m/s² over 0.5 s squared: {x}");
    for _ in 0..120 {
        run(&mut world, 1);
        assert!(world.joint(joint).unwrap().translation().unwrap() < 1.0 + 1e-5);
    }
    assert!((center(&world, body).x - 1.0).abs() < 1e-5);
    let force = world.joint(joint).unwrap().force();
    assert!(force.length() < 0.05, "motor and limit are in balance: {force}");
    world.set_motor(joint, Some(Motor { speed: -1.0, strength: 40.0 })).unwrap();
    run(&mut world, 60);
    // It takes 0.05 s to reach its speed.
    assert!((center(&world, body).x - 0.025).abs() < 0.005, "{}", center(&world, body));
    run(&mut world, 60);
    assert!((center(&world, body).x + 0.5).abs() < 1e-5);
    world.set_limits(joint, Some([-2.0, 2.0])).unwrap();
    run(&mut world, 30);
    assert!((center(&world, body).x + 1.0).abs() < 0.03, "{}", center(&world, body));
}

/// Limits hold a pendulum, a rope its weight, a strut what leans on it, a cone an arm.
#[test]
fn limits_hold() {
    let mut world = World::new(sleepless()).unwrap();
    let rod = add(&mut world, Vec3::new(0.5, 0.05, 0.05), Vec3::X * 0.5, 1.0);
    let hinge = HingeJoint::new(rod, None).anchor(Vec3::ZERO).axis(Vec3::Z).limits(-0.5, 0.5);
    let hinge = world.add_joint(hinge).unwrap();
    let arm = add(&mut world, Vec3::new(0.5, 0.05, 0.05), Vec3::new(0.5, 0.0, 5.0), 1.0);
    let shoulder = BallJoint::new(arm, None).anchor(Vec3::Z * 5.0).axis(Vec3::X).cone(0.4).twist(-0.3, 0.3);
    let shoulder = world.add_joint(shoulder).unwrap();
    let weight = add(&mut world, Vec3::splat(0.1), Vec3::X * 3.0, 1.0);
    let rope =
        DistanceJoint::new(weight, None).anchors(Vec3::X * 3.0, Vec3::new(3.0, 0.5, 0.0)).range(0.0, 1.0);
    let rope = world.add_joint(rope).unwrap();
    let spin = RigidBody::new(&cuboid(0.3, 0.1, 0.2)).position(Vec3::X * 9.0).angular_velocity(Vec3::Y * 7.0);
    let spin = world.add(spin).unwrap();
    let turns = HingeJoint::new(spin, None).axis(Vec3::Y).limits(-20.0, 20.0);
    let turns = world.add_joint(turns).unwrap();
    for step in 0..300 {
        run(&mut world, 1);
        let angle = world.joint(hinge).unwrap().angle().unwrap();
        assert!(angle > -0.5 - 1e-5, "step {step}: {angle}");
        let [swing, twist] = world.joint(shoulder).unwrap().swing_and_twist().unwrap();
        assert!(swing < 0.4 + 1e-4 && twist.abs() < 0.3 + 1e-4, "step {step}: {swing} {twist}");
        assert!(world.joint(rope).unwrap().translation().unwrap() < 1.0 + 1e-5);
    }
    assert!((world.joint(hinge).unwrap().angle().unwrap() + 0.5).abs() < 1e-4);
    // The limit bears the torque of the weight about the hinge.
    let torque = world.joint(hinge).unwrap().torque().z;
    assert!((torque / (9.81 * 0.5 * 0.5f32.cos()) - 1.0).abs() < 1e-3, "{torque}");
    assert!((world.joint(rope).unwrap().force().y - 9.81).abs() < 0.01);
    println!("turned {:?}", world.joint(turns).unwrap().angle());
    assert!((world.joint(turns).unwrap().angle().unwrap() - 20.0).abs() < 2e-3, "it counted its turns");
}

/// The axes that are free are: a spin about a hinge and a motion along a slider go on for ever.
#[test]
fn free_axes_are_free() {
    let mut world = World::new(weightless()).unwrap();
    let axis = Vec3::new(1.0, 2.0, -0.5).normalize();
    let shape = cuboid(0.3, 0.2, 0.1);
    let spun = world.add(RigidBody::new(&shape).angular_velocity(axis * 4.0)).unwrap();
    let hinge = world.add_joint(HingeJoint::new(spun, None).axis(axis)).unwrap();
    let free =
        world.add(RigidBody::new(&shape).position(Vec3::Z * 9.0).angular_velocity(Vec3::Z * 4.0)).unwrap();
    let start = Vec3::X * 5.0;
    let slid = world.add(RigidBody::new(&shape).position(start).velocity(axis * 2.0)).unwrap();
    let slider = world.add_joint(SliderJoint::new(slid, None).axis(axis)).unwrap();
    run(&mut world, 600);
    let time = world.time() as f32;
    let angle = world.joint(hinge).unwrap().angle().unwrap();
    println!("free {}", world.body(free).unwrap().angular_velocity());
    println!("{} rad/s", world.body(spun).unwrap().angular_velocity().length());
    println!("hinge turned {angle} of {}", 4.0 * time);
    assert!((angle / (4.0 * time) - 1.0).abs() < 1e-3);
    let [on_body, on_base] = world.joint(hinge).unwrap().axes();
    assert!(on_body.distance(on_base) < 1e-5);
    let moved = world.joint(slider).unwrap().translation().unwrap();
    println!("slider moved {moved} of {}", 2.0 * time);
    assert!((moved / (2.0 * time) - 1.0).abs() < 1e-4);
    assert!(center(&world, slid).distance(start + axis * moved) < 1e-4);
    let (_, rotation) = world.body(slid).unwrap().pose().unwrap();
    assert!(rotation.angle_between(Quat::IDENTITY) < 1e-3);
}

/// Two boxes welded together fall and spin as the one body that they make.
#[test]
fn welded_boxes_move_as_one() {
    let spin = Vec3::new(1.0, 2.0, 3.0);
    let mut world = World::new(sleepless()).unwrap();
    let whole =
        RigidBody::new(&cuboid(0.4, 0.1, 0.15)).mass(2.0).position(Vec3::Z * 5.0).angular_velocity(spin);
    let whole = world.add(whole).unwrap();
    let half = cuboid(0.2, 0.1, 0.15);
    let [left, right] = [-0.2f32, 0.2].map(|x| {
        let arm = Vec3::X * x;
        let body = RigidBody::new(&half).mass(1.0).position(arm).angular_velocity(spin);
        world.add(body.velocity(spin.cross(arm))).unwrap()
    });
    world.add_joint(FixedJoint::new(left, right)).unwrap();
    run(&mut world, 120);
    let middle = (center(&world, left) + center(&world, right)) * 0.5;
    let fallen = center(&world, whole) - Vec3::Z * 5.0;
    assert!(middle.distance(fallen) < 1e-4, "{middle} {fallen}");
    let pose = |body| world.body(body).unwrap().pose().unwrap().1;
    println!("welded: turned apart by {}", pose(left).angle_between(pose(whole)));
    assert!(pose(left).angle_between(pose(right)) < 1e-3);
    assert!(pose(left).angle_between(pose(whole)) < 0.01, "{}", pose(left).angle_between(pose(whole)));
}

/// It breaks at the force it is told, not before, and says so once.
#[test]
fn a_joint_breaks_at_its_force() {
    for (strength, breaks) in [(10.1f32, false), (9.7, true)] {
        let mut world = World::new(sleepless()).unwrap();
        let body = add(&mut world, Vec3::splat(0.1), Vec3::ZERO, 1.0);
        let joint = world.add_joint(BallJoint::new(body, None).break_force(strength)).unwrap();
        let mut broken = 0;
        for _ in 0..60 {
            run(&mut world, 1);
            broken += world.joint_events().len();
            assert!(world.joint_events().iter().all(|event| *event == JointEvent::Broke { joint }));
        }
        assert_eq!((broken, world.joint(joint).unwrap().is_broken()), (usize::from(breaks), breaks));
        assert_eq!(center(&world, body).y < -1.0, breaks);
    }
    let mut world = World::new(sleepless()).unwrap();
    let beam = add(&mut world, Vec3::new(0.5, 0.1, 0.1), Vec3::X * 0.5, 1.0);
    let weld = world.add_joint(FixedJoint::new(beam, None).anchor(Vec3::ZERO).break_torque(4.0)).unwrap();
    run(&mut world, 3);
    assert!(world.joint(weld).unwrap().is_broken(), "m g r is 4.9 N m");
}

/// Connected bodies overlap in peace, unless told to collide.
#[test]
fn connected_bodies_collide_only_if_told() {
    for collide in [false, true] {
        let mut world = World::new(weightless()).unwrap();
        let a = add(&mut world, Vec3::splat(0.5), Vec3::ZERO, 1.0);
        let b = add(&mut world, Vec3::splat(0.5), Vec3::X * 0.5, 1.0);
        let joint = SliderJoint::new(b, a).axis(Vec3::X);
        world.add_joint(if collide { joint.collide_connected() } else { joint }).unwrap();
        run(&mut world, 120);
        let apart = center(&world, a).distance(center(&world, b));
        assert_eq!(apart > 0.9, collide, "{apart}");
    }
}

/// p and L of what is jointed and left alone.
#[test]
fn joints_keep_momentum() {
    let mut world = World::new(weightless()).unwrap();
    let shape = cuboid(0.25, 0.1, 0.05);
    let mut bodies: Vec<BodyHandle> = Vec::new();
    for k in 0..5 {
        let position = Vec3::X * (0.6 * k as f32);
        let velocity = Vec3::new(0.3, (k as f32 - 2.0) * 0.7, 0.5 * (k % 2) as f32);
        let body = RigidBody::new(&shape).mass(1.0 + k as f32).position(position).velocity(velocity);
        let body = world.add(body.angular_velocity(Vec3::new(1.0, -2.0, 0.5 * k as f32))).unwrap();
        let (base, point) = (bodies.last().copied(), position - Vec3::X * 0.3);
        match (k, base) {
            (1, Some(base)) => world.add_joint(BallJoint::new(body, base).anchor(point)).map(|_| ()).unwrap(),
            (2, Some(base)) => {
                world.add_joint(HingeJoint::new(body, base).anchor(point)).map(|_| ()).unwrap()
            }
            (3, Some(base)) => {
                world.add_joint(SliderJoint::new(body, base).anchor(point)).map(|_| ()).unwrap()
            }
            (4, Some(base)) => {
                world.add_joint(FixedJoint::new(body, base).anchor(point)).map(|_| ()).unwrap()
            }
            _ => {}
        }
        bodies.push(body);
    }
    let momentum = |world: &World| {
        let mut sums = [tautline::DVec3::ZERO; 2];
        for &body in &bodies {
            let view = world.body(body).unwrap();
            for (i, x) in view.positions().iter().enumerate() {
                let p = view.particle_velocity(i as u32).as_dvec3() * f64::from(view.mass()) / 4.0;
                sums[0] += p;
                sums[1] += x.as_dvec3().cross(p);
            }
        }
        sums
    };
    run(&mut world, 1);
    let [linear, angular] = momentum(&world);
    run(&mut world, 300);
    let [linear_now, angular_now] = momentum(&world);
    let errors = [
        (linear_now - linear).length() / linear.length(),
        (angular_now - angular).length() / angular.length(),
    ];
    println!("momentum off by {:.1e}, angular by {:.1e}", errors[0], errors[1]);
    assert!(errors[0] < 1e-6 && errors[1] < 1e-5, "{errors:?}");
}

/// Removing a body removes its joints and lets go of what hung from it.
#[test]
fn joints_go_with_their_bodies() {
    let mut world = World::new(Settings::default()).unwrap();
    let a = add(&mut world, Vec3::splat(0.1), Vec3::ZERO, 1.0);
    let b = add(&mut world, Vec3::splat(0.1), Vec3::X, 1.0);
    let c = add(&mut world, Vec3::splat(0.1), Vec3::X * 2.0, 1.0);
    let first = world.add_joint(BallJoint::new(b, a)).unwrap();
    let second = world.add_joint(BallJoint::new(c, b)).unwrap();
    let third = world.add_joint(BallJoint::new(c, None)).unwrap();
    world.remove(a).unwrap();
    assert_eq!(world.joint(first).map(|_| ()), Err(tautline::Error::StaleHandle));
    assert_eq!(world.joints().collect::<Vec<_>>(), [second, third]);
    assert_eq!((world.joint(second).unwrap().body(), world.joint(second).unwrap().base()), (c, Some(b)));
    run(&mut world, 30);
    world.remove_joint(third).unwrap();
    assert_eq!(world.remove_joint(third), Err(tautline::Error::StaleHandle));
    run(&mut world, 30);
    assert!(center(&world, c).y < -0.5);
}
