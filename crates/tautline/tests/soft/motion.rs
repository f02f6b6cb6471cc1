//! How cloth and rope move under forces, pins and grabs.

use tautline::{Cloth, Grip, HalfSpace, Quat, Rope, Settings, Vec3, World};

use super::{DT, center, positions, run, weightless};

#[test]
fn pinned_particles_stay_to_the_bit() {
    let mut world = World::new(Settings::default()).unwrap();
    let cloth = Cloth::grid(14, 10, 1.3, 0.9).position(Vec3::new(0.1, 0.7, -0.3));
    let cloth = world.add(cloth.pin(3).pin(60).pin(139)).unwrap();
    let rope =
        world.add(Rope::straight(Vec3::new(3.0, 0.1, 0.7), Vec3::new(4.0, 0.3, 0.1), 10).pin(4)).unwrap();
    let starts = [positions(&world, cloth), positions(&world, rope)];
    run(&mut world, 2.0);
    for pin in [3, 60, 139] {
        assert_eq!(positions(&world, cloth)[pin], starts[0][pin]);
    }
    assert_eq!(positions(&world, rope)[4], starts[1][4]);
    assert!(positions(&world, rope)[0].distance(starts[1][0]) > 0.1, "the others swing");
}

#[test]
fn a_pin_that_is_taken_out_lets_a_particle_fall() {
    let mut world = World::new(Settings::default()).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::NEG_Y, 10).pin(0)).unwrap();
    run(&mut world, 1.0);
    let before = center(&world, rope).y;
    world.unpin(rope, 0).unwrap();
    run(&mut world, 0.5);
    let fallen = before - center(&world, rope).y;
    assert!((fallen - 0.5 * 9.81 * 0.25).abs() < 0.02, "it has fallen {fallen} m");
}

#[test]
fn a_grabbed_corner_follows_and_the_cloth_hangs_from_it() {
    let mut world = World::new(Settings::default()).unwrap();
    let cloth = world.add(Cloth::grid(12, 12, 1.0, 1.0)).unwrap();
    let grab = world.grab(cloth, Vec3::new(-0.5, 0.0, -0.5), Grip::default()).unwrap();
    let target = Vec3::new(0.3, 0.8, 0.1);
    world.move_grab(grab, target).unwrap();
    run(&mut world, 3.0);
    let held = positions(&world, cloth)[0];
    assert!(held.distance(target) < 0.02, "{held} instead of {target}");
    let below = target - center(&world, cloth);
    assert!(below.y > 0.4, "its centre is {below} below");
    world.release(grab).unwrap();
    run(&mut world, 0.5);
    assert!(positions(&world, cloth)[0].y < target.y - 1.0, "it falls when it is let go");
}

/// The integrator is exact for constant acceleration, whatever the steps.
#[test]
fn free_fall_is_a_parabola_also_when_steps_change() {
    let mut world = World::new(Settings { sleep: None, ..Settings::default() }).unwrap();
    let velocity = Vec3::new(1.0, 2.0, -0.5);
    let cloth = world.add(Cloth::grid(9, 9, 1.0, 1.0).velocity(velocity)).unwrap();
    let rope = Rope::straight(Vec3::new(3.0, 0.0, 0.0), Vec3::new(4.0, 0.0, 0.0), 10);
    let rope = world.add(rope.velocity(velocity)).unwrap();
    let starts = [positions(&world, cloth), positions(&world, rope)];
    for k in 0..80 {
        world.step([DT, DT / 2.0, DT / 7.0, DT * 1.3][k * k % 7 % 4]).unwrap();
    }
    let time = world.time() as f32;
    let moved = velocity * time + Vec3::Y * (-4.905 * time * time);
    for (body, starts) in [cloth, rope].into_iter().zip(starts) {
        for (at, start) in positions(&world, body).into_iter().zip(starts) {
            assert!(at.distance(start + moved) < 2e-5, "{} instead of {moved}", at - start);
        }
    }
}

/// The momentum of the whole is that of the force on one of its particles.
#[test]
fn a_force_on_one_particle_moves_all() {
    let mut world = World::new(weightless()).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 20).mass(0.5)).unwrap();
    for _ in 0..60 {
        world.apply_force_at(rope, 20, Vec3::new(0.3, 0.1, 0.0)).unwrap();
        world.step(DT).unwrap();
    }
    let expected = Vec3::new(0.3, 0.1, 0.0) * world.time() as f32;
    let momentum = world.momentum().as_vec3();
    assert!(momentum.distance(expected) < 2e-3 * expected.length(), "{momentum} instead of {expected}");
}

#[test]
fn all_particles_are_put_somewhere_as_one_by_one() {
    let mut world = World::new(Settings::default()).unwrap();
    let cloth = world.add(Cloth::grid(6, 5, 1.0, 0.8)).unwrap();
    run(&mut world, 0.2);
    let mut other = world.clone();
    let places: Vec<Vec3> = positions(&world, cloth).iter().map(|place| *place * 1.01 + Vec3::Y).collect();
    world.set_particle_positions(cloth, &places).unwrap();
    for (particle, &place) in (0..).zip(&places) {
        other.set_particle_position(cloth, particle, place).unwrap();
    }
    assert_eq!(positions(&world, cloth), places);
    run(&mut world, 0.2);
    run(&mut other, 0.2);
    assert_eq!(world.state_hash(), other.state_hash());

    let before = world.state_hash();
    let mut wrong = places.clone();
    wrong[7].y = f32::NAN;
    let error = world.set_particle_positions(cloth, &wrong).unwrap_err();
    assert!(error.to_string().starts_with("positions[7].y: NaN"), "{error}");
    assert!(world.set_particle_positions(cloth, &places[1..]).is_err());
    assert_eq!(world.state_hash(), before);
}

/// What is set is what is read, before the first step and in the midst of motion; the others keep theirs.
#[test]
fn a_particle_is_given_a_velocity() {
    let mut world = World::new(weightless()).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 10).pin(0)).unwrap();
    let velocities = |world: &World| -> Vec<Vec3> {
        let rope = world.body(rope).unwrap();
        (0..11).map(|i| rope.particle_velocity(i)).collect()
    };
    for _ in 0..2 {
        let before = velocities(&world);
        let velocity = Vec3::new(0.5, -2.0, 0.25);
        world.set_particle_velocity(rope, 10, velocity).unwrap();
        world.set_particle_velocity(rope, 0, velocity).unwrap();
        let after = velocities(&world);
        assert!(after[10].distance(velocity) < 1e-6, "{}", after[10]);
        assert_eq!(after[..10], before[..10]);
        run(&mut world, 0.1);
        assert!(velocities(&world)[9].length() > 0.05, "it takes its neighbour along");
    }
}

/// Cloth that touched a floor was moved as if it were heavier, and drove itself along: this one was 28 m away in the end.
#[test]
fn the_center_of_a_cloth_that_folds_up_on_ice_moves_straight_down() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0).friction(0.0)).unwrap();
    let lean = Quat::from_rotation_y(0.7) * Quat::from_rotation_x(1.5);
    let sheet = Cloth::grid(20, 20, 2.0, 2.0).friction(0.0).position(Vec3::Y * 1.1).rotation(lean);
    let cloth = world.add(sheet).unwrap();
    let start = center(&world, cloth);
    for _ in 0..300 {
        world.step(DT).unwrap();
        let moved = center(&world, cloth) - start;
        assert!(moved.with_y(0.0).length() < 1e-3, "{moved}");
    }
    assert!(center(&world, cloth).y < 0.5);
}
