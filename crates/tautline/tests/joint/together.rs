//! Joints with each other and with contacts.

use tautline::{BallJoint, BodyHandle, FixedJoint, HalfSpace, HingeJoint, Quat, RigidBody, Vec3, World};

use crate::{add, center, cuboid, run, sleepless};

/// A closed loop holds the same thing more than once: four hinges in a plane, and a bridge held at both ends.
#[test]
fn loops_hold() {
    let mut world = World::new(sleepless()).unwrap();
    let bar = cuboid(0.5, 0.05, 0.05);
    let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, -1.0, 0.0), Vec3::NEG_Y];
    let mut bars = Vec::new();
    for k in 0..4 {
        let (from, to) = (corners[k], corners[(k + 1) % 4]);
        let rotation = Quat::from_rotation_arc(Vec3::X, (to - from).normalize());
        bars.push(
            world.add(RigidBody::new(&bar).position((from + to) * 0.5).rotation(rotation).mass(1.0)).unwrap(),
        );
    }
    for k in 0..4 {
        let joint = HingeJoint::new(bars[k], bars[(k + 3) % 4]).anchor(corners[k]).axis(Vec3::Z);
        world.add_joint(joint).unwrap();
    }
    world.add_joint(BallJoint::new(bars[0], None).anchor(Vec3::ZERO)).unwrap();
    let plank = cuboid(0.25, 0.02, 0.2);
    let mut base = None;
    for k in 0..12 {
        let left = Vec3::new(0.5 * k as f32, 0.0, 3.0);
        let body = world.add(RigidBody::new(&plank).position(left + Vec3::X * 0.25).mass(1.0)).unwrap();
        world.add_joint(HingeJoint::new(body, base).anchor(left).axis(Vec3::Z)).unwrap();
        base = Some(body);
    }
    let last = base.unwrap();
    world.add_joint(HingeJoint::new(last, None).anchor(Vec3::new(6.0, 0.0, 3.0)).axis(Vec3::Z)).unwrap();
    run(&mut world, 300);
    let apart = |joint| {
        let [on_body, on_base] = world.joint(joint).unwrap().anchors();
        on_body.distance(on_base)
    };
    let worst = world.joints().map(apart).fold(0.0, f32::max);
    println!("loops: apart by {worst:.1e} m");
    assert!(worst < 1e-4);
}

/// A joint between what lies on the floor and what hangs over its edge neither shakes nor stretches.
#[test]
fn jointed_bodies_rest_on_the_floor() {
    let mut world = World::new(sleepless()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let shape = cuboid(0.2, 0.1, 0.1);
    let mut base: Option<BodyHandle> = None;
    let mut bodies = Vec::new();
    for k in 0..6 {
        let body = RigidBody::new(&shape).position(Vec3::new(0.45 * k as f32, 0.5 + 0.1 * k as f32, 0.0));
        let body = world.add(body).unwrap();
        if let Some(base) = base {
            let point = (center(&world, body) + center(&world, base)) * 0.5;
            world.add_joint(BallJoint::new(body, base).anchor(point)).unwrap();
        }
        base = Some(body);
        bodies.push(body);
    }
    run(&mut world, 600);
    let speed = bodies.iter().map(|&body| world.body(body).unwrap().velocity().length()).fold(0.0, f32::max);
    let apart = |joint| {
        let [on_body, on_base] = world.joint(joint).unwrap().anchors();
        on_body.distance(on_base)
    };
    let worst = world.joints().map(apart).fold(0.0, f32::max);
    println!("on the floor: {speed:.1e} m/s, apart by {worst:.1e} m");
    assert!(speed < 2e-3 && worst < 1e-4);
}

/// Two boxes welded into each other by way of a third, which no contact can part: they stay in bounds.
#[test]
fn contradictions_stay_in_bounds() {
    for overlap in [0.01f32, 0.05] {
        let mut world = World::new(sleepless()).unwrap();
        world.add(HalfSpace::floor(0.0)).unwrap();
        let left = add(&mut world, Vec3::splat(0.2), Vec3::Y * 0.5, 1.0);
        let right = add(&mut world, Vec3::splat(0.2), Vec3::new(0.4 - overlap, 0.5, 0.0), 1.0);
        let middle = add(&mut world, Vec3::splat(0.2), Vec3::new(0.2, 0.9, 0.0), 1.0);
        world.add_joint(FixedJoint::new(left, middle)).unwrap();
        world.add_joint(FixedJoint::new(right, middle)).unwrap();
        let mut worst = 0.0f32;
        for _ in 0..300 {
            run(&mut world, 1);
            worst = worst.max(world.body(middle).unwrap().velocity().length());
        }
        let apart = center(&world, left).distance(center(&world, right));
        println!("overlap {overlap}: {worst} m/s, {apart} m apart");
        assert!(worst < 3.0, "{worst} m/s");
    }
}

/// A body welded to two places that are metres apart: it stays between them, whole and at a speed that is bounded.
#[test]
fn places_that_are_metres_apart_do_not_tear_at_a_body() {
    for (apart, mass) in [(0.5, 1.0), (5.0, 1.0), (5.0, 1e3), (100.0, 1e-2)] {
        let mut world = World::new(sleepless()).unwrap();
        let body = add(&mut world, Vec3::new(0.2, 0.1, 0.3), Vec3::ZERO, mass);
        for side in [-apart, apart] {
            let point = Vec3::new(side, 0.3 * side, 0.0);
            world.add_joint(FixedJoint::new(body, None).anchors(Vec3::splat(0.1), point)).unwrap();
        }
        // One that would have it turned over.
        let turned = world.add(RigidBody::new(&cuboid(0.1, 0.1, 0.1)).mass(mass).position(Vec3::Z)).unwrap();
        world.add_joint(FixedJoint::new(turned, body)).unwrap();
        world.add_joint(HingeJoint::new(turned, None).anchors(Vec3::Z, Vec3::NEG_Z).axis(Vec3::X)).unwrap();
        let (mut fastest, mut furthest) = (0.0f32, 0.0f32);
        for _ in 0..300 {
            run(&mut world, 1);
            for body in [body, turned] {
                fastest = fastest.max(world.body(body).unwrap().velocity().length());
                furthest = furthest.max(center(&world, body).length());
            }
        }
        println!("{apart} m, {mass} kg: {fastest} m/s, {furthest} m away");
        // Settings::separation_speed is 3 m/s.
        assert!(
            fastest < 6.0 && furthest < apart + 2.0,
            "{apart} m, {mass} kg: {fastest} m/s, {furthest} m away"
        );
    }
}

/// A ball on a slack chain of light links that snaps it tight: the links lie folded, in a zigzag that is not quite
/// regular, and each is turned by what `turn` gives for it.
fn slack_chain(links: usize, ratio: f32, kink: f32, turn: impl Fn(usize) -> f32) -> World {
    let mut world = World::new(sleepless()).unwrap();
    let pitch = 4.0 / links as f32;
    let link = cuboid(pitch / 2.0, pitch / 4.0, pitch / 4.0);
    let (mut base, mut place) = (None, Vec3::ZERO);
    for k in 0..links {
        let angle = kink * if k % 2 == 0 { 1.0 } else { -1.0 } + 0.1 * (k % 5) as f32 + turn(k);
        let rotation = Quat::from_rotation_z(angle) * Quat::from_rotation_y(0.3 * (k % 3) as f32);
        let along = rotation * Vec3::X * pitch;
        let body = RigidBody::new(&link).mass(1.0).position(place + along * 0.5).rotation(rotation);
        let body = world.add(body).unwrap();
        world.add_joint(BallJoint::new(body, base).anchor(place)).unwrap();
        base = Some(body);
        place += along;
    }
    let ball = add(&mut world, Vec3::splat(0.3), place + Vec3::X * 0.35, ratio);
    world.add_joint(BallJoint::new(ball, base).anchor(place)).unwrap();
    world
}

/// In 600 steps, the most energy that the chain gains, as a share of what its ball has to fall, and how far (m) its
/// joints are drawn apart.
fn snap(mut world: World, ratio: f32) -> (f64, f32) {
    let energy = |world: &World| world.kinetic_energy() + world.potential_energy();
    let start = energy(&world);
    let scale = f64::from(ratio) * 9.81 * 4.0;
    let (mut most, mut widest) = (0.0f64, 0.0f32);
    for _ in 0..600 {
        run(&mut world, 1);
        most = most.max((energy(&world) - start) / scale);
        for joint in world.joints() {
            let [on_body, on_base] = world.joint(joint).unwrap().anchors();
            widest = widest.max(on_body.distance(on_base));
        }
    }
    (most, widest)
}

/// To snap tight takes energy and never gives any.
#[test]
fn a_chain_that_snaps_tight_gains_nothing() {
    for (links, ratio, kink) in [(24, 200.0, 0.3), (10, 1000.0, 0.6), (40, 100.0, 0.3)] {
        let (most, widest) = snap(slack_chain(links, ratio, kink, |_| 0.0), ratio);
        println!("{links} links, 1 : {ratio}: {most:.4} of the energy gained, apart by {widest:.1e} m");
        // What loads have drawn apart is drawn together again, which lifts them.
        assert!(most < 0.1 && widest < 0.05, "{links} links, 1 : {ratio}: {most}, {widest} m");
    }
}

/// Links that the blow threw about faster than substeps can tell let the ball fall metres in two of three starts.
#[test]
fn light_links_between_heavy_bodies_are_not_drawn_apart() {
    for (links, ratio) in [(10, 1000.0), (6, 3000.0)] {
        for start in 1..=12 {
            let turn = |k: usize| 0.1 * ((k * k + 7 * start * k + 3 * start) % 13) as f32 / 13.0;
            let (most, widest) = snap(slack_chain(links, ratio, 0.6, turn), ratio);
            println!("{links} links, start {start}: {most:.4} gained, apart by {widest:.1e} m");
            assert!(most < 0.1 && widest < 0.05, "{links} links, start {start}: {most}, {widest} m");
        }
    }
}

/// Limp chains with cones and hinges over a floor, and what they are made of.
fn limp_chains() -> (World, Vec<BodyHandle>) {
    let mut world = World::new(sleepless()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let shape = cuboid(0.08, 0.2, 0.08);
    let mut bodies = Vec::new();
    for chain in 0..8 {
        let mut base = None;
        for k in 0..5 {
            let at = Vec3::new(0.3 * (chain % 3) as f32, 0.8 + 0.45 * k as f32, 0.25 * (chain / 3) as f32);
            let body = world.add(RigidBody::new(&shape).position(at).mass(5.0)).unwrap();
            if let Some(base) = base {
                let point = at - Vec3::Y * 0.225;
                if k % 2 == 0 {
                    world
                        .add_joint(HingeJoint::new(body, base).anchor(point).axis(Vec3::X).limits(-1.5, 0.1))
                        .unwrap();
                } else {
                    world
                        .add_joint(BallJoint::new(body, base).anchor(point).cone(0.8).twist(-0.5, 0.5))
                        .unwrap();
                }
            }
            base = Some(body);
            bodies.push(body);
        }
    }
    (world, bodies)
}

/// Limp chains fall in a heap and come to rest.
#[test]
fn limp_bodies_fall_in_a_heap() {
    let (mut world, bodies) = limp_chains();
    let (mut fastest, mut widest) = (0.0f32, 0.0f32);
    for _ in 0..900 {
        run(&mut world, 1);
        for &body in &bodies {
            fastest = fastest.max(world.body(body).unwrap().velocity().length());
        }
        for joint in world.joints() {
            let [on_body, on_base] = world.joint(joint).unwrap().anchors();
            widest = widest.max(on_body.distance(on_base));
        }
    }
    let speed = bodies.iter().map(|&body| world.body(body).unwrap().velocity().length()).fold(0.0, f32::max);
    println!("heap: at most {fastest} m/s, apart by {widest:.1e} m, at last {speed:.1e} m/s");
    assert!(fastest < 12.0 && widest < 5e-3 && speed < 0.02);
}

/// The same bits on one thread and on two, and from a snapshot on.
#[test]
fn a_heap_of_limp_bodies_is_the_same_every_time() {
    let hash_on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut world, _) = limp_chains();
            run(&mut world, 90);
            let mut restored = World::restore(&world.snapshot()).unwrap();
            run(&mut world, 60);
            run(&mut restored, 60);
            assert_eq!(restored.state_hash(), world.state_hash());
            let forces = |world: &World| -> Vec<Vec3> {
                world.joints().map(|joint| world.joint(joint).unwrap().force()).collect()
            };
            assert_eq!(forces(&restored), forces(&world));
            world.state_hash()
        })
    };
    assert_eq!(hash_on(1), hash_on(2));
}
