//! Bodies on triangle meshes and height fields.

use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{RigidBody, Shape, Vec3, World};

use super::{add, awake, center, cube, run};

fn ground(world: &mut World, shape: Shape) {
    add(world, RigidBody::new(&Arc::new(shape)).fixed());
}

#[test]
fn a_ball_rolls_over_the_seams_of_a_flat_mesh_as_over_a_plane() {
    let mut world = World::new(awake()).unwrap();
    ground(&mut world, Shape::triangle_mesh(&primitives::grid(41, 41, 10.0, 10.0).unwrap()).unwrap());
    let (radius, speed) = (0.2, 2.0);
    let ball = Arc::new(Shape::sphere(radius).unwrap());
    let body = RigidBody::new(&ball).position(Vec3::new(-3.0, radius, 0.03)).velocity(Vec3::X * speed);
    let ball = add(&mut world, body.angular_velocity(Vec3::Z * (-speed / radius)));
    run(&mut world, 3.0);
    let at = center(&world, ball);
    assert!((at.x - 3.0).abs() < 5e-3 && (at.y - radius).abs() < 5e-4, "{at}");
    assert!((world.body(ball).unwrap().velocity().x / speed - 1.0).abs() < 1e-3);
}

#[test]
fn a_box_lies_on_a_height_field() {
    let mut world = World::new(awake()).unwrap();
    let heights = vec![0.5; 30 * 20];
    ground(&mut world, Shape::height_field(30, 20, 0.4, &heights).unwrap());
    let cube = add(&mut world, RigidBody::new(&cube(1.0)).position(Vec3::new(0.3, 1.3, -0.2)));
    run(&mut world, 4.0);
    assert!((center(&world, cube).y - 1.0).abs() < 2e-3, "{}", center(&world, cube));
    assert!(world.kinetic_energy() < 1e-6);
}
