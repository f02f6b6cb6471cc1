//! Ropes that are wound in and out.

use tautline::{Attachment, Cloth, ClothSolver, Error, Rope, Settings, Vec3, World};

use super::attach::load_on_a_rope;
use super::{DT, center, run, stretch};

#[test]
fn a_winch_lifts_a_load_and_lowers_it() {
    let mut world = World::new(Settings { damping: 0.5, ..Settings::default() }).unwrap();
    let (rope, load, hook) = load_on_a_rope(&mut world, 20.0, Attachment::default());
    run(&mut world, 1.0);
    let start = center(&world, load).y;
    for (from, to) in [(2.0, 1.4), (1.4, 2.2)] {
        let mut fastest = 0.0_f32;
        for step in 1..=120 {
            // From rest to rest.
            let share = step as f32 / 120.0;
            let share = share * share * (3.0 - 2.0 * share);
            world.set_rope_length(rope, from + (to - from) * share).unwrap();
            world.step(DT).unwrap();
            fastest = fastest.max(world.attachment(hook).unwrap().force().length());
        }
        assert!((world.rope_length(rope).unwrap() - to).abs() < 1e-5);
        assert!(fastest < 1.5 * 20.0 * 9.81, "{fastest} N at most");
        run(&mut world, 3.0);
        let (lifted, expected) = (center(&world, load).y - start, 2.0 - to);
        assert!((lifted - expected).abs() < 2e-3, "lifted by {lifted} m, not {expected}");
        assert!(stretch(&world, rope) < 1e-3, "{}", stretch(&world, rope));
    }
}

#[test]
fn what_is_far_is_reached_little_by_little() {
    let mut world = World::new(Settings { gravity: Vec3::ZERO, ..Settings::default() }).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 10).pin(0)).unwrap();
    world.set_rope_length(rope, 3.0).unwrap();
    world.step(DT).unwrap();
    assert!((world.rope_length(rope).unwrap() - 1.1).abs() < 1e-5);
    run(&mut world, 0.5);
    assert!((world.rope_length(rope).unwrap() - 3.0).abs() < 1e-4);
}

#[test]
fn a_rope_of_the_papers_solver_has_its_new_length_at_once() {
    let settings = Settings { cloth: ClothSolver::Paper, ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 10).pin(0)).unwrap();
    world.set_rope_length(rope, 0.5).unwrap();
    assert!((world.rope_length(rope).unwrap() - 0.5).abs() < 1e-6);
}

#[test]
fn wrong_lengths_are_refused() {
    let mut world = World::new(Settings::default()).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 10)).unwrap();
    let cloth = world.add(Cloth::grid(3, 3, 1.0, 1.0)).unwrap();
    for length in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-6] {
        let refused = world.set_rope_length(rope, length).unwrap_err();
        assert!(matches!(refused, Error::OutOfRange { field, .. } if field == "length"), "{length}");
    }
    for refused in [world.set_rope_length(cloth, 1.0), world.rope_length(cloth).map(|_| ())] {
        assert!(matches!(refused, Err(Error::Invalid { field, .. }) if field == "rope"));
    }
    world.remove(rope).unwrap();
    assert_eq!(world.set_rope_length(rope, 1.0), Err(Error::StaleHandle));
}
