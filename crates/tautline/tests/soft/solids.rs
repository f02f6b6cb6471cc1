//! Cloth on what is solid.

use tautline::mesh::primitives;
use tautline::{BodyHandle, Cloth, HalfSpace, Quat, QueryFilter, RigidBody, Settings, Shape, Vec3, World};

use super::{center, positions, run, solid, stretch};

/// A cloth of 2 m by 2 m and 30 × 30 particles, kept 4 cm from solids, at a height.
fn sheet(height: f32) -> Cloth {
    Cloth::grid(30, 30, 2.0, 2.0).position(Vec3::Y * height)
}

fn fall_on(body: RigidBody, seconds: f32) -> (World, BodyHandle) {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(-1.0)).unwrap();
    world.add(body.clone().fixed()).unwrap();
    let cloth = world.add(sheet(0.8)).unwrap();
    run(&mut world, seconds);
    let depth = depth_in(body, &positions(&world, cloth));
    assert!(depth < 0.0, "a particle is {depth} m inside");
    assert!(center(&world, cloth).y > -0.6, "it is not carried: {}", center(&world, cloth));
    (world, cloth)
}

/// How deep the deepest particle is in a body that is alone in its world, in m.
fn depth_in(body: RigidBody, particles: &[Vec3]) -> f32 {
    let mut alone = World::new(Settings::default()).unwrap();
    alone.add(body.fixed()).unwrap();
    let depth = |&at: &Vec3| {
        let hit = alone.closest_point(at, 100.0, QueryFilter::default()).unwrap();
        -hit.map_or(100.0, |hit| hit.distance)
    };
    particles.iter().map(depth).fold(f32::NEG_INFINITY, f32::max)
}

#[test]
fn a_cloth_drapes_over_a_box_and_falls_asleep() {
    let cube = solid(Shape::cuboid(Vec3::splat(0.5)).unwrap());
    let (mut world, cloth) = fall_on(cube.clone(), 3.0);
    let awake = stretch(&world, cloth);
    assert!(awake < 0.03, "stretched by {awake}");
    run(&mut world, 5.0);
    assert!(world.body(cloth).unwrap().is_asleep());
    assert!(stretch(&world, cloth) < 0.03 && depth_in(cube, &positions(&world, cloth)) < 0.0);
    let asleep = positions(&world, cloth);
    run(&mut world, 1.0);
    assert_eq!(positions(&world, cloth), asleep);
}

#[test]
fn a_cloth_drapes_over_a_turned_box() {
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.6, 0.3, 0.7);
    let body = solid(Shape::cuboid(Vec3::new(0.5, 0.3, 0.4)).unwrap()).rotation(turn);
    let (world, cloth) = fall_on(body, 2.0);
    assert!(stretch(&world, cloth) < 0.05, "{}", stretch(&world, cloth));
}

#[test]
fn a_cloth_drapes_over_round_shapes() {
    let (ball, capsule) = (Shape::sphere(0.5).unwrap(), Shape::capsule(0.3, 0.5).unwrap());
    for body in [solid(ball), solid(capsule).rotation(Quat::from_rotation_z(1.570_796_4))] {
        let (world, cloth) = fall_on(body, 2.0);
        assert!(stretch(&world, cloth) < 0.03, "{}", stretch(&world, cloth));
    }
}

#[test]
fn a_cloth_drapes_over_a_hull() {
    let hull = Shape::from_mesh(&primitives::dodecahedron(0.6).unwrap()).unwrap();
    let (world, cloth) = fall_on(solid(hull), 2.0);
    assert!(stretch(&world, cloth) < 0.03, "{}", stretch(&world, cloth));
}

#[test]
fn a_cloth_drapes_over_a_triangle_mesh() {
    let radius = 0.5;
    let mesh = primitives::icosphere(radius, 3).unwrap();
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(-1.0)).unwrap();
    world.add(solid(Shape::triangle_mesh(&mesh).unwrap()).fixed()).unwrap();
    let cloth = world.add(sheet(0.8)).unwrap();
    run(&mut world, 2.0);
    let nearest = positions(&world, cloth).iter().map(|x| x.length()).fold(f32::INFINITY, f32::min);
    // The faces are at most 0.5 % inside the sphere.
    assert!(nearest > radius * 0.995, "a particle is {nearest} m from the middle");
    assert!(center(&world, cloth).y > -0.6 && stretch(&world, cloth) < 0.03);
}

#[test]
fn a_cloth_lies_on_a_height_field() {
    let (cells, size) = (24_u32, 0.2_f32);
    let ridge = |x: f32| 0.3 - 0.5 * x.abs();
    let x_of = |column: u32| (column as f32 - cells as f32 / 2.0) * size;
    let heights: Vec<f32> = (0..=cells).flat_map(|_| (0..=cells).map(|c| ridge(x_of(c)))).collect();
    let mut world = World::new(Settings::default()).unwrap();
    let field = Shape::height_field(cells + 1, cells + 1, size, &heights).unwrap();
    world.add(solid(field).friction(1.5).fixed()).unwrap();
    let cloth = world.add(sheet(0.8).friction(1.5)).unwrap();
    run(&mut world, 3.0);
    let above = |x: &Vec3| x.y - ridge(x.x);
    let lowest = positions(&world, cloth).iter().map(above).fold(f32::INFINITY, f32::min);
    let highest = positions(&world, cloth).iter().map(above).fold(0.0, f32::max);
    assert!(lowest > 0.0 && highest < 0.15, "from {lowest} to {highest} m above");
    assert!(stretch(&world, cloth) < 0.03);
}

#[test]
fn a_cloth_lies_on_a_floor_and_falls_asleep() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let cloth = world.add(sheet(0.5)).unwrap();
    run(&mut world, 4.0);
    let thickness = 0.6 * 2.0 / 29.0 * (2.0 + 2.0_f32.sqrt()) / 3.0;
    for at in positions(&world, cloth) {
        assert!((at.y - thickness).abs() < 2e-3, "{at} is not {thickness} m high");
    }
    assert!(world.body(cloth).unwrap().is_asleep() && stretch(&world, cloth) < 1e-3);
}

#[test]
fn a_cloth_held_at_its_corners_carries_a_box() {
    // A held sheet is a trampoline, and nothing but damping would end the swinging.
    let mut world = World::new(Settings { damping: 1.0, ..Settings::default() }).unwrap();
    let cloth = Cloth::grid(20, 20, 2.0, 2.0).mass(0.5).position(Vec3::Y);
    let cloth = world.add(cloth.pin(0).pin(19).pin(380).pin(399)).unwrap();
    let cube = solid(Shape::cuboid(Vec3::splat(0.15)).unwrap()).mass(2.0);
    let cube = world.add(cube.position(Vec3::Y * 1.5)).unwrap();
    run(&mut world, 6.0);
    let (at, speed) = (center(&world, cube), world.body(cube).unwrap().velocity().length());
    // It is tossed up first, and may come down beside the middle.
    assert!(at.y > 0.4 && at.y < 1.3 && at.x.hypot(at.z) < 0.6, "it is at {at}");
    assert!(speed < 0.05, "it moves at {speed} m/s");
    assert!(stretch(&world, cloth) < 0.03, "{}", stretch(&world, cloth));
}
