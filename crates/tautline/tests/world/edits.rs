//! Adding and removing bodies, and the handles that survive it.

use tautline::{Cloth, Error, HalfSpace, Settings, TrussBody, Vec3, World};

use crate::{cube, icosahedron, mixed_scene, run};

#[test]
fn removal_in_the_middle_leaves_the_others_as_they_are() {
    let mut world = mixed_scene(Settings::default());
    run(&mut world, 20);
    let handles: Vec<_> = world.bodies().collect();
    let state = |world: &World, k: usize| {
        let view = world.body(handles[k]).unwrap();
        let velocities: Vec<Vec3> =
            (0..view.positions().len()).map(|i| view.particle_velocity(i as u32)).collect();
        (view.kind(), view.positions().to_vec(), view.inverse_masses().to_vec(), velocities, view.friction())
    };
    let before: Vec<_> = (0..handles.len()).map(|k| state(&world, k)).collect();
    let removed = [2, 5, 0];
    for k in removed {
        world.remove(handles[k]).unwrap();
        assert_eq!(world.remove(handles[k]), Err(Error::StaleHandle));
    }
    for k in (0..handles.len()).filter(|k| !removed.contains(k)) {
        assert_eq!(state(&world, k), before[k], "body {k}");
    }
    let particles: usize = world.bodies().map(|body| world.body(body).unwrap().positions().len()).sum();
    assert_eq!(particles, world.positions().len());
}

/// A world from which a far body was removed goes on as one that never had it.
#[test]
fn a_removed_body_leaves_no_trace() {
    let build = |extra: bool| {
        let mut world = World::new(Settings::default()).unwrap();
        world.add(HalfSpace::floor(0.0)).unwrap();
        let first = TrussBody::new(&cube(0.5)).position(Vec3::Y).angular_velocity(Vec3::ONE);
        world.add(first).unwrap();
        let far = TrussBody::new(&icosahedron(0.4)).position(Vec3::new(50.0, 3.0, 0.0));
        let far = extra.then(|| world.add(far).unwrap());
        world.add(TrussBody::new(&cube(0.5)).position(Vec3::new(0.1, 1.7, 0.2))).unwrap();
        run(&mut world, 15);
        if let Some(far) = far {
            world.remove(far).unwrap();
        }
        run(&mut world, 60);
        world.state_hash()
    };
    assert_eq!(build(true), build(false));
}

#[test]
fn a_slot_used_again_does_not_revive_its_old_handle() {
    let mut world = World::new(Settings::default()).unwrap();
    let shape = cube(0.5);
    let mut stale = Vec::new();
    for k in 0..50 {
        let position = Vec3::X * k as f32;
        let body = world.add(TrussBody::new(&shape).position(position)).unwrap();
        assert!(world.body(body).unwrap().center_of_mass().distance(position) < 1e-5);
        assert!(stale.iter().all(|&old| world.body(old).is_err()));
        world.remove(body).unwrap();
        stale.push(body);
    }
    assert_eq!(world.bodies().len(), 0);
    run(&mut world, 2);
}

/// F = m a for every part: a force on a body gives all its particles one acceleration.
#[test]
fn a_force_on_a_body_is_spread_by_mass() {
    let mut world = World::new(crate::weightless()).unwrap();
    let body = world.add(TrussBody::new(&cube(0.5)).mass(8.0)).unwrap();
    world.set_particle_mass(body, 0, 5.0).unwrap();
    let before = world.positions().to_vec();
    for _ in 0..30 {
        world.apply_force(body, Vec3::X * 24.0).unwrap();
        run(&mut world, 1);
    }
    // 24 N on 12 kg for half a second: ½ a t² = 0.25 m, without turning.
    for (x, old) in world.positions().iter().zip(&before) {
        assert!(x.distance(*old + Vec3::X * 0.25) < 1e-4, "{x} from {old}");
    }
}

/// Trees of cloth are the paper's solver's alone: it finds cloth where others have left it.
#[test]
fn the_papers_solver_finds_cloth_that_was_moved_before() {
    let mut world = World::new(Settings::default()).unwrap();
    let cloth = world.add(Cloth::grid(9, 9, 2.0, 2.0)).unwrap();
    (0..81).for_each(|particle| world.pin(cloth, particle).unwrap());
    let raised: Vec<Vec3> =
        world.body(cloth).unwrap().positions().iter().map(|&at| at + Vec3::Y * 5.0).collect();
    world.set_particle_positions(cloth, &raised).unwrap();
    world.set_settings(Settings::paper()).unwrap();
    let ball = world.add(TrussBody::new(&icosahedron(0.3)).position(Vec3::Y * 6.0)).unwrap();
    run(&mut world, 120);
    let lowest = world.body(ball).unwrap().positions().iter().map(|at| at.y).fold(f32::MAX, f32::min);
    assert!(lowest > 4.9, "it lies at {lowest} m");
}
