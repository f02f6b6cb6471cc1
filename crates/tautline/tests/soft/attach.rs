//! Attachments: what hangs on what, and how much it bears.

use tautline::{Anchor, Attachment, AttachmentHandle, BodyHandle, Cloth, Rope, Settings, Shape, Vec3, World};

use super::{DT, center, run, solid, stretch, weightless};

const STIFF: fn() -> Attachment = Attachment::default;

/// How far apart the ends of an attachment are, in m.
fn gap(world: &World, handle: AttachmentHandle) -> f32 {
    let [a, b] = world.attachment(handle).unwrap().ends();
    a.distance(b)
}

fn speed(world: &World, body: BodyHandle) -> f32 {
    world.body(body).unwrap().velocity().length()
}

/// A box of edge 0.4 m at the end of a rope of 1 kg and 2 m that is pinned.
pub(super) fn load_on_a_rope(
    world: &mut World,
    mass: f32,
    attachment: Attachment,
) -> (BodyHandle, BodyHandle, AttachmentHandle) {
    let rope = world.add(Rope::straight(Vec3::Y * 3.0, Vec3::Y, 20).pin(0)).unwrap();
    let load = solid(Shape::cuboid(Vec3::splat(0.2)).unwrap()).mass(mass).position(Vec3::Y * 0.8);
    let load = world.add(load).unwrap();
    let top = Anchor::point(load, Vec3::Y * 0.2);
    let hook = world.attach(Anchor::particle(rope, 20), top, attachment).unwrap();
    (rope, load, hook)
}

fn awake() -> Settings {
    Settings { sleep: None, ..Settings::default() }
}

#[test]
fn a_rope_carries_two_thousand_times_the_mass_of_a_particle() {
    let mut world = World::new(awake()).unwrap();
    let (rope, load, hook) = load_on_a_rope(&mut world, 100.0, STIFF());
    run(&mut world, 5.0);
    assert!(stretch(&world, rope) < 3e-4, "{}", stretch(&world, rope));
    assert!(gap(&world, hook) < 5e-5, "{}", gap(&world, hook));
    assert!(speed(&world, load) < 0.01, "{}", speed(&world, load));
    let force = world.attachment(hook).unwrap().force();
    assert!(force.distance(Vec3::NEG_Y * 981.0) < 2.0, "{force}");
}

#[test]
fn a_rope_that_hangs_on_attachments_carries_as_if_it_were_pinned() {
    let mut world = World::new(awake()).unwrap();
    let wall = solid(Shape::cuboid(Vec3::splat(0.1)).unwrap()).position(Vec3::Y * 3.1).fixed();
    let wall = world.add(wall).unwrap();
    let (rope, load, hook) = load_on_a_rope(&mut world, 50.0, STIFF());
    world.unpin(rope, 0).unwrap();
    let bottom = Anchor::point(wall, Vec3::NEG_Y * 0.1);
    let ring = world.attach(Anchor::particle(rope, 0), bottom, STIFF()).unwrap();
    run(&mut world, 4.0);
    assert!(stretch(&world, rope) < 1e-3, "{}", stretch(&world, rope));
    assert!(gap(&world, hook) < 1e-4 && gap(&world, ring) < 1e-4, "{}", gap(&world, ring));
    assert!(speed(&world, load) < 0.02, "{}", speed(&world, load));
    // The rope weighs 1 kg.
    let force = world.attachment(ring).unwrap().force();
    assert!(force.distance(Vec3::Y * 51.0 * 9.81) < 3.0, "{force}");
}

#[test]
fn four_points_of_a_cloth_carry_a_box() {
    for mass in [5.0, 100.0] {
        let mut world = World::new(awake()).unwrap();
        let n = 21;
        let mut cloth = Cloth::grid(n, n, 2.0, 2.0).position(Vec3::Y);
        for corner in [0, n - 1, n * (n - 1), n * n - 1] {
            cloth = cloth.pin(corner);
        }
        let cloth = world.add(cloth).unwrap();
        let load = solid(Shape::cuboid(Vec3::splat(0.2)).unwrap()).mass(mass).position(Vec3::Y * 0.7);
        let load = world.add(load).unwrap();
        let hooks = [(8, 8), (12, 8), (8, 12), (12, 12)].map(|(row, column)| {
            let at = Vec3::new((column as f32 - 10.0) * 0.1, 0.3, (row as f32 - 10.0) * 0.1);
            world.attach(Anchor::particle(cloth, row * n + column), Anchor::point(load, at), STIFF()).unwrap()
        });
        // Nothing but the cloth takes energy from what bounces on it.
        run(&mut world, 8.0);
        assert!(speed(&world, load) < 0.1, "{mass} kg still move at {} m/s", speed(&world, load));
        run(&mut world, 12.0);
        assert!(stretch(&world, cloth) < 0.03, "{}", stretch(&world, cloth));
        assert!(hooks.iter().all(|&hook| gap(&world, hook) < 1e-4));
        assert!(speed(&world, load) < 0.02, "{mass} kg move at {} m/s", speed(&world, load));
        let mut carried = Vec3::ZERO;
        for _ in 0..60 {
            run(&mut world, DT);
            carried += hooks.iter().map(|&hook| world.attachment(hook).unwrap().force() / 60.0).sum::<Vec3>();
        }
        assert!(carried.distance(Vec3::NEG_Y * mass * 9.81) < 0.02 * mass * 9.81, "{mass} kg: {carried}");
    }
}

#[test]
fn ropes_at_its_corners_hold_a_cloth_with_a_box_on_it() {
    let mut world = World::new(awake()).unwrap();
    let n = 20;
    let cloth = world.add(Cloth::grid(n, n, 2.0, 2.0).position(Vec3::Y)).unwrap();
    let corners = [(-1.0, -1.0, 0), (1.0, -1.0, n - 1), (-1.0, 1.0, n * (n - 1)), (1.0, 1.0, n * n - 1)];
    let mut ropes = Vec::new();
    for (x, z, particle) in corners {
        let corner = Vec3::new(x, 1.0, z);
        let up = corner + Vec3::new(x, 1.5, z);
        let rope = world.add(Rope::straight(corner, up, 12).mass(0.2)).unwrap();
        world.attach(Anchor::particle(cloth, particle), Anchor::particle(rope, 0), STIFF()).unwrap();
        world.attach(Anchor::particle(rope, 12), Anchor::world(up), STIFF()).unwrap();
        ropes.push(rope);
    }
    let load = solid(Shape::cuboid(Vec3::splat(0.2)).unwrap()).mass(3.0).position(Vec3::Y * 1.3);
    let load = world.add(load).unwrap();
    run(&mut world, 12.0);
    let at = center(&world, load);
    assert!(at.y > 0.2 && at.y < 1.3, "{at}");
    assert!(speed(&world, load) < 0.1, "{}", speed(&world, load));
    assert!(stretch(&world, cloth) < 0.05, "{}", stretch(&world, cloth));
    for rope in ropes {
        assert!(stretch(&world, rope) < 1e-2, "{}", stretch(&world, rope));
    }
}

#[test]
fn what_is_compliant_gives_way_by_its_force() {
    let mut world = World::new(Settings { damping: 2.0, ..awake() }).unwrap();
    let (_, _, hook) = load_on_a_rope(&mut world, 5.0, STIFF().compliance(1e-3));
    run(&mut world, 10.0);
    // α F.
    let expected = 1e-3 * 5.0 * 9.81;
    assert!((gap(&world, hook) - expected).abs() < 0.01 * expected, "{} of {expected}", gap(&world, hook));
}

#[test]
fn what_holds_too_much_breaks() {
    let mut world = World::new(awake()).unwrap();
    let (_, load, hook) = load_on_a_rope(&mut world, 5.0, STIFF().break_force(60.0));
    run(&mut world, 0.5);
    assert!(!world.attachment(hook).unwrap().is_broken());
    world.apply_impulse(load, Vec3::NEG_Y * 10.0).unwrap();
    run(&mut world, 1.0);
    let view = world.attachment(hook).unwrap();
    assert!(view.is_broken() && view.force().length() > 60.0);
    assert!(center(&world, load).y < -1.0, "{}", center(&world, load));
}

/// A ball that spins, a rope and a cloth, all in one chain, and no gravity. The cloth crumples, and which way is chance:
/// eight starts, a little different.
#[test]
fn a_closed_chain_keeps_momentum_and_gains_no_energy() {
    for start in 0..8_u8 {
        let mut world = closed_chain(1e-3 * f32::from(start));
        let (linear, angular) = (world.momentum(), world.angular_momentum());
        let first = world.kinetic_energy();
        let mut energy = first;
        for _ in 0..10 {
            run(&mut world, 1.0);
            let off = (world.momentum() - linear).length() / linear.length();
            assert!(off < 1e-5, "start {start}: momentum is off by {off}");
            assert!(
                world.kinetic_energy() < energy + 1e-2 * first,
                "start {start}: energy grew from {energy}"
            );
            energy = world.kinetic_energy();
            let off = (world.angular_momentum() - angular).length() / angular.length();
            assert!(off < 3e-5, "start {start}: angular momentum is off by {off}");
        }
    }
}

/// The ball is `more` m/s faster.
fn closed_chain(more: f32) -> World {
    let mut world = World::new(weightless()).unwrap();
    let ball = solid(Shape::sphere(0.2).unwrap()).mass(2.0).position(Vec3::X * 1.2);
    let ball = ball.velocity(Vec3::new(0.0, 1.5 + more, 0.5)).angular_velocity(Vec3::new(0.5, 1.0, 3.0));
    let ball = world.add(ball).unwrap();
    // A quarter along its first segment it is at the cloth's edge.
    let start = Vec3::X * -(1.0 + 0.25 / 20.0) / (1.0 - 0.25 / 20.0);
    let rope = world.add(Rope::straight(start, Vec3::X, 20).mass(0.5)).unwrap();
    let cloth = world.add(Cloth::grid(8, 8, 0.7, 0.7).mass(0.4).position(Vec3::X * -1.35)).unwrap();
    world.attach(Anchor::particle(rope, 20), Anchor::point(ball, Vec3::X * -0.2), STIFF()).unwrap();
    let edge = on_edge(&world, cloth);
    let seam = world.attach(edge, Anchor::segment(rope, 0, 0.25), STIFF()).unwrap();
    assert!(gap(&world, seam) < 1e-4, "{}", gap(&world, seam));
    world
}

/// The middle of an edge at the rim of a cloth where x is greatest and z is 0.
fn on_edge(world: &World, cloth: BodyHandle) -> Anchor {
    let view = world.body(cloth).unwrap();
    let at = view.positions();
    let rim = at.iter().map(|at| at.x).fold(f32::NEG_INFINITY, f32::max);
    let weight = |corner: u32| {
        let at = at[corner as usize];
        if at.x > rim - 1e-3 && at.z.abs() < 0.08 { 0.5 } else { 0.0 }
    };
    let weights = view.triangles().iter().map(|corners| corners.map(weight)).zip(0..);
    let (weights, number) =
        weights.into_iter().find(|(weights, _)| weights.iter().sum::<f32>() == 1.0).unwrap();
    Anchor::triangle(cloth, number, weights)
}
