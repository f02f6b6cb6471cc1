//! Soft solids.

use tautline::mesh::{Tetrahedra, primitives};
use tautline::{
    BodyHandle, Cloth, ClothSolver, HalfSpace, Instructions, Quat, Rope, Settings, Shape, SoftSolid, Vec3,
    World,
};

use super::{DT, center, positions, run, solid, weightless};

/// The volume of a soft solid, in m³, in f64.
fn volume(world: &World, body: BodyHandle) -> f64 {
    let view = world.body(body).unwrap();
    let at = |corner: u32| view.positions()[corner as usize].as_dvec3();
    let six = |&[a, b, c, d]: &[u32; 4]| (at(b) - at(a)).cross(at(c) - at(a)).dot(at(d) - at(a));
    view.tetrahedra().iter().map(six).sum::<f64>() / 6.0
}

/// A bar along y from −1 m to 1 m, hung up by its upper end, so that nothing but Young's modulus counts: by how much it is
/// longer at its lower end once it is at rest, as a share of what ρ g L²/(2 E) says.
fn hanging_bar([x, y, z]: [u32; 3], young_modulus: f32, poisson_ratio: f32) -> f32 {
    let settings = Settings { damping: 4.0, sleep: None, ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let mut bar = SoftSolid::cuboid(Vec3::new(0.15, 1.0, 0.15), [x, y, z])
        .young_modulus(young_modulus)
        .poisson_ratio(poisson_ratio);
    let number = |i: u32, j: u32, k: u32| (k * (y + 1) + j) * (x + 1) + i;
    for (i, k) in (0..=x).flat_map(|i| (0..=z).map(move |k| (i, k))) {
        bar = bar.pin(number(i, y, k));
    }
    let bar = world.add(bar).unwrap();
    run(&mut world, 5.0);
    let low: Vec<f32> = (0..=x)
        .flat_map(|i| (0..=z).map(move |k| (i, k)))
        .map(|(i, k)| positions(&world, bar)[number(i, 0, k) as usize].y)
        .collect();
    let mean = low.iter().sum::<f32>() / low.len() as f32;
    (-1.0 - mean) / (1000.0 * 9.81 * 2.0 * 2.0 / (2.0 * young_modulus))
}

#[test]
fn a_hanging_bar_is_longer_by_what_youngs_modulus_says() {
    for cells in [[2, 13, 2], [4, 26, 4]] {
        for (young_modulus, poisson_ratio) in [(1e6, 0.3), (3e6, 0.45)] {
            let ratio = hanging_bar(cells, young_modulus, poisson_ratio);
            assert!((ratio - 1.0).abs() < 0.1, "{cells:?}: {ratio} times as much");
        }
    }
}

#[test]
fn a_jelly_cube_keeps_its_volume_comes_to_rest_and_sleeps() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let jelly = world.add(SoftSolid::cuboid(Vec3::splat(0.25), [5, 5, 5]).position(Vec3::Y * 0.5)).unwrap();
    run(&mut world, 6.0);
    let share = volume(&world, jelly) / 0.125;
    assert!((share - 1.0).abs() < 0.01, "its volume is {share} times what it was");
    assert!(world.body(jelly).unwrap().is_asleep());
    let at = center(&world, jelly);
    assert!(at.x.hypot(at.z) < 0.05 && at.y > 0.24 && at.y < 0.3, "it is at {at}");
    let asleep = positions(&world, jelly);
    run(&mut world, 1.0);
    assert_eq!(positions(&world, jelly), asleep);
}

fn torus() -> SoftSolid {
    SoftSolid::from_mesh(primitives::torus(0.3, 0.12, 18, 8).unwrap()).young_modulus(5e4)
}

#[test]
fn a_soft_torus_falls_over_a_post_and_keeps_its_volume() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    world.add(solid(Shape::cylinder(0.1, 0.4).unwrap()).position(Vec3::Y * 0.4).fixed()).unwrap();
    let torus = world.add(torus().position(Vec3::new(0.05, 1.2, 0.0))).unwrap();
    let before = volume(&world, torus);
    run(&mut world, 4.0);
    let (at, share) = (center(&world, torus), volume(&world, torus) / before);
    assert!(at.y < 0.3 && at.x.hypot(at.z) < 0.2, "it is not around the post: {at}");
    assert!((share - 1.0).abs() < 0.02, "its volume is {share} times what it was");
}

#[test]
fn a_jelly_and_a_ball_that_collide_keep_momentum_and_gain_no_energy() {
    let mut world = World::new(weightless()).unwrap();
    let jelly = world.add(SoftSolid::cuboid(Vec3::splat(0.25), [4, 4, 4]).mass(2.0)).unwrap();
    let ball = solid(Shape::sphere(0.15).unwrap()).mass(1.0).position(Vec3::new(0.1, 0.7, 0.05));
    world.add(ball.velocity(Vec3::Y * -4.0)).unwrap();
    let (momentum, energy) = (world.momentum(), world.kinetic_energy());
    for _ in 0..180 {
        world.step(DT).unwrap();
        let off = (world.momentum() - momentum).length() / momentum.length();
        assert!(off < 1e-5, "momentum is off by {off}");
        assert!(world.kinetic_energy() < energy * 1.00001, "{} J of {energy} J", world.kinetic_energy());
    }
    let speed = world.body(jelly).unwrap().velocity().length();
    assert!(speed > 1.0, "they hardly met: {speed} m/s");
}

#[test]
fn a_free_jelly_that_swings_and_spins_keeps_momentum_and_gains_no_energy() {
    let mut world = World::new(weightless()).unwrap();
    let jelly = SoftSolid::cuboid(Vec3::new(0.2, 0.3, 0.1), [4, 6, 2]).young_modulus(2e4);
    let jelly = world.add(jelly.angular_velocity(Vec3::new(1.0, 2.0, 3.0))).unwrap();
    let corner = positions(&world, jelly).len() as u32 - 1;
    world.apply_force_at(jelly, corner, Vec3::new(300.0, 0.0, 100.0)).unwrap();
    world.step(DT).unwrap();
    let (momentum, turn, energy) = (world.momentum(), world.angular_momentum(), world.kinetic_energy());
    run(&mut world, 10.0);
    assert!((world.momentum() - momentum).length() < 1e-5 * momentum.length());
    let off = (world.angular_momentum() - turn).length() / turn.length();
    assert!(off < 2e-3, "angular momentum is off by {off}");
    assert!(world.kinetic_energy() < energy * 1.2, "{} J of {energy} J", world.kinetic_energy());
}

#[test]
fn what_is_turned_inside_out_comes_right_again() {
    let mut world = World::new(weightless()).unwrap();
    let jelly = SoftSolid::cuboid(Vec3::splat(0.2), [4, 4, 4]).young_modulus(2e4);
    // Layers have to pass through each other.
    let jelly = world.add(jelly.self_collision(false)).unwrap();
    let before = volume(&world, jelly);
    for (particle, at) in (0..).zip(positions(&world, jelly)) {
        let squashed = Vec3::new(at.x, -0.3 * at.y, at.z);
        world.set_particle_position(jelly, particle, squashed).unwrap();
    }
    assert!(volume(&world, jelly) < 0.0);
    run(&mut world, 4.0);
    let share = volume(&world, jelly) / before;
    assert!((share - 1.0).abs() < 0.05, "its volume is {share} times what it was");
}

#[test]
fn cloth_and_rope_and_another_jelly_lie_on_a_jelly() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let cube = || SoftSolid::cuboid(Vec3::splat(0.25), [4, 4, 4]);
    world.add(cube().position(Vec3::Y * 0.35)).unwrap();
    let upper = world.add(cube().density(300.0).position(Vec3::new(0.05, 1.0, 0.0))).unwrap();
    let cloth = world.add(Cloth::grid(20, 20, 1.0, 1.0).position(Vec3::Y * 1.5)).unwrap();
    let rope = Rope::straight(Vec3::new(-0.5, 1.8, 0.0), Vec3::new(0.5, 1.8, 0.05), 30);
    let rope = world.add(rope.mass(0.2)).unwrap();
    run(&mut world, 3.0);
    assert!(center(&world, upper).y > 0.65, "it is not carried: {}", center(&world, upper));
    assert!(center(&world, cloth).y > 0.6, "the cloth is at {}", center(&world, cloth));
    let middle = positions(&world, rope)[15];
    assert!(middle.y > 1.0, "the rope is at {middle}");
}

fn crowd(settings: Settings) -> World {
    let mut world = World::new(settings).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let turn = Quat::from_rotation_z(0.4);
    world.add(SoftSolid::cuboid(Vec3::splat(0.2), [3, 3, 3]).position(Vec3::Y * 0.4).rotation(turn)).unwrap();
    world.add(torus().position(Vec3::new(0.1, 0.9, 0.1))).unwrap();
    world.add(solid(Shape::sphere(0.1).unwrap()).position(Vec3::Y * 1.4).velocity(Vec3::Y * -3.0)).unwrap();
    world
}

fn hashes(world: &mut World, steps: usize) -> Vec<u64> {
    let mut hash_of_step = || {
        world.step(DT).unwrap();
        world.state_hash()
    };
    (0..steps).map(|_| hash_of_step()).collect()
}

#[test]
fn instructions_and_threads_and_snapshots_give_the_same_bits() {
    let expected = hashes(&mut crowd(Settings::default()), 60);
    for instructions in [Instructions::Scalar, Instructions::Baseline] {
        let found = hashes(&mut crowd(Settings { instructions, ..Settings::default() }), 60);
        assert_eq!(found, expected);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    assert_eq!(pool.install(|| hashes(&mut crowd(Settings::default()), 60)), expected);
    let mut world = crowd(Settings::default());
    hashes(&mut world, 25);
    let bytes = world.snapshot();
    assert_eq!(hashes(&mut World::restore(&bytes).unwrap(), 35), expected[25..]);
}

#[test]
fn bad_numbers_and_the_papers_solver_are_refused() {
    let cube = || SoftSolid::cuboid(Vec3::ONE, [2; 3]);
    let open = primitives::grid(3, 3, 1.0, 1.0).unwrap();
    let lone = Tetrahedra { points: vec![Vec3::ZERO; 4], tetrahedra: vec![[0, 1, 2, 4]], interior_points: 0 };
    for (bad, field) in [
        (cube().young_modulus(0.0), "young_modulus: "),
        (cube().young_modulus(f32::NAN), "young_modulus: "),
        (cube().poisson_ratio(0.5), "poisson_ratio: "),
        (cube().density(-1.0), "density: "),
        (cube().mass(f32::INFINITY), "mass: "),
        (cube().friction(-0.1), "friction: "),
        (cube().thickness(f32::NAN), "thickness: "),
        (cube().position(Vec3::NAN), "position.x: "),
        (cube().velocity(Vec3::INFINITY), "velocity.x: "),
        (cube().angular_velocity(Vec3::NAN), "angular_velocity.x: "),
        (cube().rotation(Quat::from_xyzw(0.0, 0.0, 0.0, 0.0)), "rotation: "),
        (cube().pin(27), "pins: "),
        (SoftSolid::cuboid(Vec3::ONE, [2, 0, 2]), "cells.y: "),
        (SoftSolid::cuboid(Vec3::new(1.0, 1.0, -1.0), [2; 3]), "half_extents.z: "),
        (SoftSolid::from_mesh(open), "mesh: "),
        (SoftSolid::from_tetrahedra(lone), "tetrahedra[0]: "),
    ] {
        let mut world = World::new(Settings::default()).unwrap();
        let refusal = world.add(bad).unwrap_err().to_string();
        assert!(refusal.starts_with(field), "{refusal}");
        assert_eq!(world.bodies().len(), 0);
    }
    let paper = Settings { cloth: ClothSolver::Paper, ..Settings::default() };
    let refusal = World::new(paper.clone()).unwrap().add(cube()).unwrap_err().to_string();
    assert!(refusal.starts_with("settings.cloth: "), "{refusal}");
    let mut world = World::new(Settings::default()).unwrap();
    world.add(cube()).unwrap();
    assert!(world.set_settings(paper).is_err());
}
