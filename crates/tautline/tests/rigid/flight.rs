//! What flies by itself turns exactly: what particles are too coarse for is kept from step to step, as long as nobody
//! interferes.

use std::sync::Arc;

use tautline::{BodyHandle, Grip, Instructions, Quat, RigidBody, Settings, Shape, Vec3, World};

use super::{DT, add, run, weightless};

fn plank() -> Arc<Shape> {
    Arc::new(Shape::cuboid(Vec3::new(0.5, 0.1, 0.25)).unwrap())
}

fn spinning(spin: Vec3) -> (World, BodyHandle) {
    let mut world = World::new(weightless()).unwrap();
    let body = add(&mut world, RigidBody::new(&plank()).mass(1.0).angular_velocity(spin));
    (world, body)
}

#[test]
fn momentum_and_energy_stay_to_rounding_for_minutes() {
    let (mut world, _) = spinning(Vec3::new(2.0, 3.0, 1.0));
    let (energy, momentum) = (world.kinetic_energy(), world.angular_momentum());
    for _ in 0..10 {
        run(&mut world, 20.0);
        assert!((world.kinetic_energy() / energy - 1.0).abs() < 2e-6);
        assert!((world.angular_momentum() - momentum).length() < 1e-6 * momentum.length());
    }
}

#[test]
fn a_snapshot_holds_what_particles_do_not() {
    let (mut world, _) = spinning(Vec3::new(2.0, 3.0, 1.0));
    run(&mut world, 1.0);
    let mut restored = World::restore(&world.snapshot()).unwrap();
    run(&mut world, 5.0);
    run(&mut restored, 5.0);
    assert_eq!(world.state_hash(), restored.state_hash());
    assert_eq!(world.snapshot(), restored.snapshot());
}

/// However a body has turned before, what it is given is all that counts.
#[test]
fn what_is_set_is_all_there_is() {
    let after = |spin: Vec3, seconds: f32| {
        let (mut world, body) = spinning(spin);
        run(&mut world, seconds);
        world.set_pose(body, Vec3::ZERO, Quat::from_xyzw(0.1, 0.7, -0.3, 0.6).normalize()).unwrap();
        world.set_angular_velocity(body, Vec3::ZERO).unwrap();
        world.set_velocity(body, Vec3::ZERO).unwrap();
        world.set_angular_velocity(body, Vec3::new(0.5, 4.0, 1.0)).unwrap();
        let at_once = world.state_hash();
        run(&mut world, 1.0);
        [at_once, world.state_hash()]
    };
    assert_eq!(after(Vec3::new(2.0, 3.0, 1.0), 1.0), after(Vec3::Z, 0.5));
}

#[test]
fn what_is_pulled_does_not_fly_by_itself() {
    let (mut world, body) = spinning(Vec3::new(0.0, 3.0, 0.0));
    run(&mut world, 0.5);
    let view = world.body(body).unwrap();
    let (position, rotation) = view.pose().unwrap();
    let tip = position + rotation * Vec3::new(0.5, 0.0, 0.0);
    world.grab(body, tip, Grip::default()).unwrap();
    run(&mut world, 0.5);
    let spin = world.body(body).unwrap().angular_velocity();
    assert!(spin.length() < 1.0, "its tip is held where it was, and it still turns by {spin}");
}

#[test]
fn many_fly_alike_on_any_thread_and_instructions() {
    let hash = |threads: usize, instructions: Instructions| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = World::new(Settings { instructions, ..weightless() }).unwrap();
            let shape = plank();
            for k in 0..150 {
                let at = Vec3::new((k % 15) as f32, (k / 15) as f32, 0.0) * 3.0;
                let spin = Vec3::new(0.5, 1.0, (k % 7) as f32);
                add(&mut world, RigidBody::new(&shape).position(at).angular_velocity(spin));
            }
            (0..30).for_each(|_| drop(world.step(DT).unwrap()));
            world.state_hash()
        })
    };
    let one = hash(1, Instructions::default());
    assert_eq!(one, hash(2, Instructions::default()));
    assert_eq!(one, hash(1, Instructions::Scalar));
}
