//! Gas in closed cloth.

use tautline::mesh::{TriMesh, primitives};
use tautline::{BodyHandle, Cloth, Error, HalfSpace, Settings, Shape, Vec3, World};

use super::{center, run, solid, stretch, weightless};

fn ball(radius: f32) -> TriMesh {
    primitives::icosphere(radius, 2).unwrap()
}

fn state(world: &World, body: BodyHandle) -> [f32; 2] {
    let view = world.body(body).unwrap();
    [view.volume().unwrap(), view.pressure().unwrap()]
}

/// What cannot stretch keeps its volume, and the gas in it its pressure.
#[test]
fn a_balloon_of_stiff_cloth_keeps_its_volume_and_pressure() {
    let mut world = World::new(weightless()).unwrap();
    let balloon = world.add(Cloth::from_mesh(ball(0.5)).mass(0.3).pressure(400.0)).unwrap();
    let [volume, pressure] = state(&world, balloon);
    let sphere = 4.0 / 3.0 * std::f32::consts::PI * 0.125;
    assert!(volume < sphere && volume > 0.9 * sphere, "an icosphere's: {volume}");
    assert!((pressure - 400.0).abs() < 0.1);
    run(&mut world, 3.0);
    let [swollen, low] = state(&world, balloon);
    assert!(swollen > volume * 0.9999 && swollen < 1.005 * volume, "{swollen} instead of {volume} m³");
    let expected = 400.0 * volume / swollen;
    assert!((low - expected).abs() < 0.2, "p V has changed: {low} instead of {expected} Pa");
    assert!(stretch(&world, balloon) < 0.01, "{}", stretch(&world, balloon));
}

#[test]
fn gas_moves_no_free_balloon() {
    let mut world = World::new(weightless()).unwrap();
    let mut mesh = ball(0.4);
    // Of no symmetry.
    for at in &mut mesh.positions {
        *at += Vec3::new(0.3 * at.y * at.x, 0.2 * at.x * at.x + 0.3 * at.y, 0.5 * at.z * at.y);
    }
    let velocity = Vec3::new(0.9, -0.4, 0.2);
    let balloon = world
        .add(Cloth::from_mesh(mesh).mass(0.2).velocity(velocity).pressure(200.0).self_collision(false))
        .unwrap();
    let (momentum, start) = (world.momentum(), center(&world, balloon));
    run(&mut world, 3.0);
    let scale = 0.2;
    assert!((world.momentum() - momentum).length() < 1e-5 * scale, "{}", world.momentum() - momentum);
    assert!(center(&world, balloon).distance(start + velocity * 3.0) < 1e-3);
}

/// Gas pushes from where the particles were when the small step began: from where they are at its end it would turn what
/// spins ever faster.
#[test]
fn a_balloon_that_spins_keeps_angular_momentum_and_energy() {
    let mut world = World::new(weightless()).unwrap();
    let balloon = world.add(Cloth::from_mesh(ball(0.3)).pressure(400.0)).unwrap();
    run(&mut world, 2.0);
    for (particle, at) in (0..).zip(world.body(balloon).unwrap().positions().to_vec()) {
        world.set_particle_velocity(balloon, particle, Vec3::new(1.0, 3.0, 0.5).cross(at)).unwrap();
    }
    let (turn, energy) = (world.angular_momentum(), world.kinetic_energy());
    run(&mut world, 5.0);
    let off = (world.angular_momentum() - turn).length() / turn.length();
    assert!(off < 2e-5, "angular momentum is off by {off}");
    let gain = world.kinetic_energy() / energy - 1.0;
    assert!(gain.abs() < 1e-3, "energy has changed by {gain}");
}

/// A box on a ball: without gas it would lie on the floor.
#[test]
fn a_balloon_carries_a_box() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let balloon = Cloth::from_mesh(ball(0.3)).position(Vec3::Y * 0.32).mass(0.2).pressure(1500.0);
    let balloon = world.add(balloon).unwrap();
    let load = solid(Shape::cuboid(Vec3::new(0.4, 0.05, 0.4)).unwrap()).mass(2.0);
    let load = world.add(load.position(Vec3::Y * 0.75)).unwrap();
    let [volume, _] = state(&world, balloon);
    run(&mut world, 2.0);
    let [pressed, pressure] = state(&world, balloon);
    assert!(pressed > 0.97 * volume, "{pressed} of {volume} m³");
    assert!(pressure > 1400.0, "{pressure}");
    assert!(center(&world, load).y > 0.45, "the box is at {}", center(&world, load));
}

#[test]
fn gas_needs_what_is_closed_and_the_right_way_round() {
    let mut world = World::new(Settings::default()).unwrap();
    let mut refused = |cloth: Cloth| match world.add(cloth).unwrap_err() {
        Error::OutOfRange { field, .. } | Error::Invalid { field, .. } => assert_eq!(field, "pressure"),
        other => panic!("{other}"),
    };
    refused(Cloth::grid(4, 4, 1.0, 1.0).pressure(10.0));
    let mut inside_out = ball(0.5);
    inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    refused(Cloth::from_mesh(inside_out).pressure(10.0));
    for wrong in [f32::NAN, f32::INFINITY, -1.0] {
        refused(Cloth::from_mesh(ball(0.5)).pressure(wrong));
    }
}
