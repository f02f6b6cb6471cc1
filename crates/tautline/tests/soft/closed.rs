//! What a closed scene keeps.

use tautline::{BodyHandle, Cloth, Rope, Shape, Vec3, World};

use super::{DT, solid, weightless};

/// How far momentum was off, as a share of the ball's, or angular momentum, as a share of all; and by what share energy has
/// grown, at most.
fn drift(world: &mut World, ball: BodyHandle, seconds: f32) -> (f64, f64) {
    let (momentum, mut energy) = (world.momentum(), world.kinetic_energy());
    let turn = world.angular_momentum();
    let scale = f64::from(world.body(ball).unwrap().mass() * world.body(ball).unwrap().velocity().length());
    let first = energy;
    let (mut off, mut growth) = (0.0_f64, 0.0_f64);
    for _ in 0..(seconds / DT).round() as usize {
        world.step(DT).unwrap();
        off = off.max((world.momentum() - momentum).length() / scale);
        growth = growth.max((world.kinetic_energy() - energy) / first);
        energy = energy.min(world.kinetic_energy());
    }
    let turned = (world.angular_momentum() - turn).length() / turn.length();
    assert!(turned < 5e-5, "angular momentum is off by {turned}");
    (off, growth)
}

fn ball(world: &mut World, from: Vec3, velocity: Vec3) -> BodyHandle {
    let ball = solid(Shape::sphere(0.15).unwrap()).mass(0.5);
    world.add(ball.position(from).velocity(velocity).angular_velocity(Vec3::new(0.0, 3.0, 1.0))).unwrap()
}

#[test]
fn a_cloth_and_a_ball_that_collide_keep_momentum() {
    let mut world = World::new(weightless()).unwrap();
    let cloth = world.add(Cloth::grid(16, 16, 1.0, 1.0)).unwrap();
    let ball = ball(&mut world, Vec3::new(0.1, 0.6, 0.05), Vec3::Y * -3.0);
    let (off, _) = drift(&mut world, ball, 3.0);
    let speed = world.body(cloth).unwrap().velocity().length();
    assert!(speed > 0.5, "they hardly met: the cloth moves at {speed} m/s");
    assert!(off < 1e-5, "momentum is off by {off}");
}

/// Its inertia is not the same about all axes, and turns with it.
#[test]
fn a_cloth_and_a_box_that_collide_keep_momentum() {
    let mut world = World::new(weightless()).unwrap();
    world.add(Cloth::grid(16, 16, 1.0, 1.0)).unwrap();
    let load = solid(Shape::cuboid(Vec3::new(0.1, 0.15, 0.2)).unwrap())
        .mass(0.5)
        .position(Vec3::new(0.2, 0.4, 0.05));
    let load = load.velocity(Vec3::Y * -3.0).angular_velocity(Vec3::new(0.0, 6.0, 3.0));
    let load = world.add(load).unwrap();
    let (off, _) = drift(&mut world, load, 3.0);
    assert!(off < 1e-5, "momentum is off by {off}");
}

#[test]
fn a_rope_and_a_ball_that_collide_keep_momentum_and_gain_no_energy() {
    let mut world = World::new(weightless()).unwrap();
    let rope = world.add(Rope::straight(Vec3::NEG_X, Vec3::X, 40)).unwrap();
    let ball = ball(&mut world, Vec3::new(0.1, 0.6, 0.05), Vec3::Y * -3.0);
    let (off, growth) = drift(&mut world, ball, 3.0);
    let speed = world.body(rope).unwrap().velocity().length();
    assert!(speed > 0.2, "they hardly met: the rope moves at {speed} m/s");
    assert!(off < 1e-5, "momentum is off by {off}");
    assert!(growth < 1e-3, "energy has grown by {growth}");
}

#[test]
fn cloth_and_rope_that_collide_keep_momentum() {
    let mut world = World::new(weightless()).unwrap();
    world.add(Cloth::grid(14, 14, 1.0, 1.0)).unwrap();
    world.add(Cloth::grid(12, 12, 0.8, 0.8).position(Vec3::Y * 0.3).velocity(Vec3::Y * -1.0)).unwrap();
    let rope = Rope::straight(Vec3::new(-0.6, -0.3, 0.0), Vec3::new(0.6, -0.3, 0.1), 24);
    let rope = world.add(rope.velocity(Vec3::Y * 2.0)).unwrap();
    let (off, _) = drift(&mut world, rope, 2.0);
    assert!(off < 1e-5, "momentum is off by {off}");
}

/// Impulses of sticks go along where they lay when the small step began: along where they lie at its end they would brake
/// what turns, and a rope would lose half of its energy in these ten seconds.
#[test]
fn rope_and_cloth_that_spin_keep_angular_momentum_and_energy() {
    let mut world = World::new(weightless()).unwrap();
    let rope = world.add(Rope::straight(Vec3::NEG_X, Vec3::X, 40)).unwrap();
    let cloth = world.add(Cloth::grid(12, 13, 0.8, 0.8).position(Vec3::Y * 2.0)).unwrap();
    for body in [rope, cloth] {
        let view = world.body(body).unwrap();
        let (places, mass) = (view.positions().to_vec(), view.mass());
        let per_particle = mass / places.len() as f32 / DT;
        for (particle, place) in (0..).zip(places) {
            let velocity = Vec3::new(0.0, 6.0, 0.5).cross(place - view_center(&world, body));
            world.apply_force_at(body, particle, velocity * per_particle).unwrap();
        }
    }
    world.step(DT).unwrap();
    let (turn, energy) = (world.angular_momentum(), world.kinetic_energy());
    for _ in 0..600 {
        world.step(DT).unwrap();
    }
    let off = (world.angular_momentum() - turn).length() / turn.length();
    let gain = world.kinetic_energy() / energy - 1.0;
    assert!(off < 1e-4, "angular momentum is off by {off}");
    assert!((-5e-3..1e-4).contains(&gain), "energy has changed by {gain}");
}

fn view_center(world: &World, body: BodyHandle) -> Vec3 {
    world.body(body).unwrap().center_of_mass()
}
