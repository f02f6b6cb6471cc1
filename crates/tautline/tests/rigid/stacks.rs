//! What stands stays, and sticks where friction says.

use tautline::{RigidBody, Vec3, World};

use super::{add, awake, center, cube, floor, run};

#[test]
fn towers_stand() {
    for count in [1, 5, 10, 20] {
        let mut world = World::new(awake()).unwrap();
        floor(&mut world);
        let bodies: Vec<_> = (0..count)
            .map(|i| {
                add(&mut world, RigidBody::new(&cube(1.0)).mass(1.0).position(Vec3::Y * (i as f32 + 0.5)))
            })
            .collect();
        run(&mut world, 10.0);
        for (i, &body) in bodies.iter().enumerate() {
            let moved = center(&world, body) - Vec3::Y * (i as f32 + 0.5);
            assert!(moved.length() < 0.015, "cube {i} of {count} has moved by {moved}");
        }
    }
}

#[test]
fn a_cube_stands_on_one_a_hundred_times_lighter() {
    let mut world = World::new(awake()).unwrap();
    floor(&mut world);
    add(&mut world, RigidBody::new(&cube(1.0)).mass(1.0).position(Vec3::Y * 0.5));
    let top = add(&mut world, RigidBody::new(&cube(1.0)).mass(100.0).position(Vec3::Y * 1.5));
    run(&mut world, 10.0);
    assert!((center(&world, top).y - 1.5).abs() < 0.02, "{}", center(&world, top));
}
