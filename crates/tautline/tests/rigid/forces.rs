//! Forces, torques and impulses against closed forms.

use std::sync::Arc;

use tautline::{DVec3, Quat, RigidBody, Shape, Vec3, World};

use super::{DT, add, run, weightless};

/// A body of three different moments, out of line with everything.
fn thrown() -> RigidBody {
    let plank = Arc::new(Shape::cuboid(Vec3::new(0.1, 0.4, 1.0)).unwrap());
    let rotation = Quat::from_rotation_x(0.4) * Quat::from_rotation_y(1.0);
    RigidBody::new(&plank).mass(2.5).rotation(rotation).position(Vec3::new(1.0, -2.0, 0.5))
}

fn momenta(world: &World) -> (DVec3, DVec3) {
    (world.momentum(), world.angular_momentum())
}

/// What `act` changes the momentum and the angular momentum by, then and in the steps that follow.
fn changes(act: impl Fn(&mut World, tautline::BodyHandle), steps: usize) -> [(DVec3, DVec3); 2] {
    let mut world = World::new(weightless()).unwrap();
    let body = thrown().velocity(Vec3::new(0.3, 0.2, -1.0)).angular_velocity(Vec3::new(0.1, 0.5, -0.2));
    let body = add(&mut world, body);
    let before = momenta(&world);
    act(&mut world, body);
    let at_once = momenta(&world);
    (0..steps).for_each(|_| drop(world.step(DT).unwrap()));
    let after = momenta(&world);
    [at_once, after].map(|(p, l)| (p - before.0, l - before.1))
}

fn near(found: DVec3, expected: Vec3) {
    let expected = expected.as_dvec3();
    assert!((found - expected).length() < 2e-5 * (1.0 + expected.length()), "{found} {expected}");
}

const PUSH: Vec3 = Vec3::new(0.5, 2.0, -1.0);
const POINT: Vec3 = Vec3::new(1.3, -1.5, 0.2);
const CENTER: Vec3 = Vec3::new(1.0, -2.0, 0.5);

#[test]
fn an_impulse_changes_momentum_and_angular_momentum_by_itself_and_its_moment() {
    let [at_once, later] = changes(|w, b| w.apply_impulse_at_point(b, PUSH, POINT).unwrap(), 3);
    for (p, l) in [at_once, later] {
        near(p, PUSH);
        near(l, POINT.cross(PUSH));
    }
    let [at_once, later] = changes(|w, b| w.apply_impulse(b, PUSH).unwrap(), 3);
    for (p, l) in [at_once, later] {
        near(p, PUSH);
        near(l, CENTER.cross(PUSH));
    }
    let [at_once, later] = changes(|w, b| w.apply_angular_impulse(b, PUSH).unwrap(), 3);
    for (p, l) in [at_once, later] {
        near(p, Vec3::ZERO);
        near(l, PUSH);
    }
}

#[test]
fn a_force_for_a_step_is_an_impulse() {
    let force = PUSH / DT;
    // The first substep of a body newly placed takes half of it: its velocity is that of the start, the others' that
    // of the middles.
    let share = 1.0 - 1.0 / 16.0;
    let [at_once, later] = changes(|w, b| w.apply_force_at_point(b, force, POINT).unwrap(), 1);
    near(at_once.0, Vec3::ZERO);
    near(later.0, PUSH * share);
    // The step takes the moments of inertia from where the body was when it began; it turns by a hundredth.
    let off = |l: DVec3, expected: Vec3| (l - (expected * share).as_dvec3()).length();
    assert!(off(later.1, POINT.cross(PUSH)) < 0.03, "{}", later.1);
    let [_, later] = changes(|w, b| w.apply_torque(b, force).unwrap(), 1);
    near(later.0, Vec3::ZERO);
    assert!(off(later.1, PUSH) < 0.03, "{}", later.1);
    let [_, later] = changes(|w, b| w.apply_force(b, force).unwrap(), 1);
    near(later.0, PUSH * share);
}

#[test]
fn a_torque_spins_a_body_up_by_its_moment_of_inertia() {
    let mut world = World::new(weightless()).unwrap();
    let ball = Arc::new(Shape::sphere(0.5).unwrap());
    let body = add(&mut world, RigidBody::new(&ball).mass(4.0));
    for _ in 0..60 {
        world.apply_torque(body, Vec3::Y * 0.4).unwrap();
        run(&mut world, DT);
    }
    // α = τ/(2/5 m r²) = 1 rad/s².
    let spin = world.body(body).unwrap().angular_velocity();
    assert!(spin.distance(Vec3::Y) < 2e-3, "{spin}");
}

#[test]
fn an_impulse_leaves_a_fixed_or_kinematic_body_alone() {
    let mut world = World::new(weightless()).unwrap();
    for body in [thrown().fixed(), thrown().kinematic()] {
        let body = add(&mut world, body);
        world.apply_impulse_at_point(body, PUSH, POINT).unwrap();
        world.apply_angular_impulse(body, PUSH).unwrap();
        world.apply_force_at_point(body, PUSH, POINT).unwrap();
        world.apply_torque(body, PUSH).unwrap();
        run(&mut world, 0.1);
        assert!(world.body(body).unwrap().center_of_mass().distance(CENTER) < 1e-6);
    }
}
