//! Attachments as things of a world: refused, removed, asleep, and in a snapshot.

use tautline::{
    Anchor, Attachment, Cloth, ClothSolver, Error, HalfSpace, Rope, Settings, Shape, Truss, TrussBody, Vec3,
    World, mesh::primitives,
};

use super::attach::load_on_a_rope;
use super::{DT, positions, run, solid};

fn field(refused: Result<impl std::fmt::Debug, Error>) -> String {
    match refused.unwrap_err() {
        Error::Invalid { field, .. } | Error::OutOfRange { field, .. } => field,
        other => panic!("{other}"),
    }
}

#[test]
fn what_cannot_be_held_is_refused() {
    let mut world = World::new(Settings::default()).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 4)).unwrap();
    let cloth = world.add(Cloth::grid(3, 3, 1.0, 1.0).position(Vec3::Y)).unwrap();
    let ball = world.add(solid(Shape::sphere(0.1).unwrap()).position(Vec3::Z)).unwrap();
    let floor = world.add(HalfSpace::floor(-5.0)).unwrap();
    let tetrahedron = Truss::from_mesh(&primitives::tetrahedron(0.5).unwrap()).unwrap();
    let truss = world.add(TrussBody::new(&std::sync::Arc::new(tetrahedron)).position(Vec3::Z * 9.0)).unwrap();
    let (end, firm) = (Anchor::particle(rope, 0), Attachment::default());
    let refusals = [
        (Anchor::particle(rope, 5), "a.particle"),
        (Anchor::segment(rope, 4, 0.5), "a.segment"),
        (Anchor::segment(rope, 0, 1.5), "a.fraction"),
        (Anchor::segment(cloth, 0, 0.5), "a.segment"),
        (Anchor::triangle(rope, 0, [1.0, 0.0, 0.0]), "a.triangle"),
        (Anchor::triangle(cloth, 8, [1.0, 0.0, 0.0]), "a.triangle"),
        (Anchor::triangle(cloth, 0, [1.5, -0.5, 0.0]), "a.weights[0]"),
        (Anchor::triangle(cloth, 0, [0.5, 0.1, 0.1]), "a.weights"),
        (Anchor::point(cloth, Vec3::ZERO), "a"),
        (Anchor::point(ball, Vec3::NAN), "a.point.x"),
        (Anchor::particle(ball, 0), "a"),
        (Anchor::particle(truss, 0), "a"),
        (Anchor::world(Vec3::splat(2e9)), "a.point.x"),
        (Anchor::segment(rope, 0, 0.5), "b"),
    ];
    for (anchor, expected) in refusals {
        assert_eq!(field(world.attach(anchor, end, firm)), expected, "{anchor:?}");
    }
    for other in [Anchor::point(ball, Vec3::X), Anchor::point(floor, Vec3::X), Anchor::world(Vec3::X)] {
        let refused = world.attach(Anchor::point(ball, Vec3::ZERO), other, firm).unwrap_err();
        assert!(refused.to_string().contains("ball joint"), "{refused}");
    }
    assert_eq!(field(world.attach(Anchor::world(Vec3::ZERO), end, firm.compliance(-1.0))), "compliance");
    assert_eq!(field(world.attach(Anchor::world(Vec3::ZERO), end, firm.break_force(0.0))), "break_force");
    assert_eq!(world.attachments().len(), 0);
    world.attach(Anchor::point(floor, Vec3::ZERO), end, firm).unwrap();
    let paper = Settings { cloth: ClothSolver::Paper, ..Settings::default() };
    assert_eq!(field(world.set_settings(paper.clone())), "cloth");
    let mut world = World::new(paper).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 4)).unwrap();
    let refused = world.attach(Anchor::particle(rope, 0), Anchor::world(Vec3::ZERO), firm);
    assert_eq!(field(refused), "settings.cloth");
}

#[test]
fn no_handle_is_left_of_what_is_removed() {
    let mut world = World::new(Settings::default()).unwrap();
    let early = world.add(Rope::straight(Vec3::X * 9.0, Vec3::X * 8.0, 4)).unwrap();
    let (rope, load, hook) = load_on_a_rope(&mut world, 2.0, Attachment::default());
    run(&mut world, 0.1);
    world.remove(early).unwrap();
    run(&mut world, 0.5);
    assert_eq!(world.attachment(hook).unwrap().bodies(), [Some(rope), Some(load)]);
    let [a, b] = world.attachment(hook).unwrap().ends();
    assert!(a.distance(b) < 1e-3, "bodies that move up are still the ones that are held");
    world.remove(load).unwrap();
    assert_eq!(world.attachment(hook).err(), Some(Error::StaleHandle));
    assert_eq!(world.detach(hook), Err(Error::StaleHandle));
    assert_eq!(world.attachments().count(), 0);
    run(&mut world, 0.1);
    let again =
        world.attach(Anchor::particle(rope, 20), Anchor::world(Vec3::Y), Attachment::default()).unwrap();
    assert_ne!(again, hook);
    world.detach(again).unwrap();
    assert_eq!(world.detach(again), Err(Error::StaleHandle));
    run(&mut world, 0.1);
}

#[test]
fn a_rope_and_its_load_sleep_and_wake_together() {
    let mut world = World::new(Settings { damping: 3.0, ..Settings::default() }).unwrap();
    let (rope, load, hook) = load_on_a_rope(&mut world, 3.0, Attachment::default());
    let asleep = |world: &World| [rope, load].map(|body| world.body(body).unwrap().is_asleep());
    let steps = (0..1200).take_while(|_| {
        world.step(DT).unwrap();
        let [a, b] = asleep(&world);
        assert_eq!(a, b, "one of them sleeps alone");
        !a
    });
    let steps = steps.count();
    assert!(steps < 1200, "they never fall asleep");
    let before = positions(&world, load);
    run(&mut world, 1.0);
    assert_eq!((asleep(&world), positions(&world, load)), ([true; 2], before));
    world.apply_impulse(load, Vec3::X).unwrap();
    world.step(DT).unwrap();
    assert_eq!(asleep(&world), [false; 2]);
    for _ in 0..1200 {
        world.step(DT).unwrap();
    }
    assert_eq!(asleep(&world), [true; 2]);
    world.detach(hook).unwrap();
    assert_eq!(asleep(&world), [false; 2]);
}

#[test]
fn a_world_restored_from_a_snapshot_goes_on_alike() {
    let mut world = World::new(Settings::default()).unwrap();
    let (rope, _, hook) = load_on_a_rope(&mut world, 7.0, Attachment::default().break_force(500.0));
    run(&mut world, 0.3);
    world.set_rope_length(rope, 1.9).unwrap();
    let mut restored = World::restore(&world.snapshot()).unwrap();
    for _ in 0..40 {
        world.step(DT).unwrap();
        restored.step(DT).unwrap();
        assert_eq!(world.state_hash(), restored.state_hash());
    }
    let [a, b] = [&world, &restored].map(|world| world.attachment(hook).unwrap().force());
    assert_eq!(a, b);
    assert_eq!(restored.rope_length(rope), world.rope_length(rope));
}
