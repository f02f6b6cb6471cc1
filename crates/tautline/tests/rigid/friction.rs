//! Coulomb's friction against closed forms.

use std::sync::Arc;

use tautline::{HalfSpace, RigidBody, Shape, Vec3, World};

use crate::{add, awake, center, run};

const G: f32 = 9.81;

/// The way of a slab that slides over the floor at first, after so long.
fn slid(friction: f32, speed: f32, seconds: f32) -> f32 {
    let mut world = World::new(awake()).unwrap();
    world.add(HalfSpace::floor(0.0).friction(friction)).unwrap();
    let slab = Arc::new(Shape::cuboid(Vec3::new(0.5, 0.1, 0.5)).unwrap());
    let body = RigidBody::new(&slab).position(Vec3::Y * 0.1).friction(friction).velocity(Vec3::X * speed);
    let body = add(&mut world, body);
    run(&mut world, seconds);
    center(&world, body).x
}

/// v²/2μg: the contact takes up its load at once, and friction with it.
#[test]
fn a_slab_stops_where_coulomb_says() {
    for (friction, speed) in [(0.5, 2.0), (0.5, 10.0), (0.2, 5.0)] {
        let (way, expected) = (slid(friction, speed, 6.0), speed * speed / (2.0 * friction * G));
        assert!((way / expected - 1.0).abs() < 3e-4, "{way} m of {expected} m");
    }
}

/// The anchors that hold what sticks are where it stopped, not where it was a step before.
#[test]
fn what_has_stopped_is_not_pulled_back() {
    for speed in [0.3, 1.0, 2.0, 5.0] {
        let stops = speed / (0.5 * G);
        let (early, late) = (slid(0.5, speed, stops + 0.05), slid(0.5, speed, stops + 2.0));
        assert!((late - early).abs() < 5e-5, "{} m after it had stopped", late - early);
    }
}
