//! Wrong numbers, kinds and handles: each is refused by the name of its field, and nothing changes.

use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{
    BodyHandle, Cloth, Error, Grip, HalfSpace, Motion, Quat, QueryFilter, RigidBody, Rope, Shape, Surface,
    Truss, TrussBody, Vec3, World,
};

use super::{add, awake, cube, run};

const NOT_NUMBERS: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

fn field(error: &Error) -> &str {
    match error {
        Error::OutOfRange { field, .. } | Error::Invalid { field, .. } => field,
        Error::StaleHandle => "handle",
        _ => "",
    }
}

fn with(bad: &[f32]) -> Vec<f32> {
    [&NOT_NUMBERS, bad].concat()
}

/// Calls `act` with every value and checks that it is refused by `name` and the world is as it was.
fn refused<T: Copy + std::fmt::Debug, R>(
    world: &mut World,
    name: &str,
    values: &[T],
    act: impl Fn(&mut World, T) -> Result<R, Error>,
) {
    let before = world.snapshot();
    for &value in values {
        match act(world, value) {
            Err(error) => assert_eq!(field(&error), name, "{value:?}: {error}"),
            Ok(_) => panic!("{name} = {value:?} was not refused"),
        }
        assert!(world.snapshot() == before, "{name} = {value:?} changed the world");
    }
}

/// `name`.x, .y and .z in turn.
fn vector_refused<R>(world: &mut World, name: &str, act: impl Fn(&mut World, Vec3) -> Result<R, Error>) {
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        for value in with(&[1.1e9, -f32::MAX]) {
            let mut vector = Vec3::ONE;
            vector[axis] = value;
            refused(world, &format!("{name}.{letter}"), &[vector], &act);
        }
    }
}

fn turns() -> Vec<Quat> {
    with(&[0.0, 1e-4, 1e4]).into_iter().map(|x| Quat::from_xyzw(0.0, x, 0.0, 0.0)).collect()
}

/// A floor, a rigid body, and one of each other kind.
fn scene() -> (World, [BodyHandle; 5]) {
    let mut world = World::new(awake()).unwrap();
    let floor = world.add(HalfSpace::floor(0.0)).unwrap();
    let body = add(&mut world, RigidBody::new(&cube(1.0)).position(Vec3::Y * 3.0));
    let truss = Arc::new(Truss::from_mesh(&primitives::cube(0.5).unwrap()).unwrap());
    let truss = world.add(TrussBody::new(&truss).position(Vec3::new(3.0, 3.0, 0.0))).unwrap();
    let cloth = world.add(Cloth::grid(4, 4, 1.0, 1.0).position(Vec3::new(6.0, 3.0, 0.0))).unwrap();
    let rope = world.add(Rope::straight(Vec3::new(9.0, 3.0, 0.0), Vec3::new(9.0, 4.0, 0.0), 5)).unwrap();
    run(&mut world, 0.05);
    (world, [floor, body, truss, cloth, rope])
}

#[test]
fn wrong_builder_fields_are_refused() {
    let (mut world, _) = scene();
    let w = &mut world;
    let shape = cube(0.5);
    let body = || RigidBody::new(&shape);
    vector_refused(w, "position", |w, x| w.add(body().position(x)));
    vector_refused(w, "velocity", |w, x| w.add(body().velocity(x)));
    vector_refused(w, "angular_velocity", |w, x| w.add(body().angular_velocity(x)));
    refused(w, "rotation", &turns(), |w, q| w.add(body().rotation(q)));
    refused(w, "mass", &with(&[0.0, -0.0, -1.0, 1e-30, 1e21]), |w, m| w.add(body().mass(m)));
    refused(w, "density", &with(&[0.0, -1.0, 1e-30, 1e30]), |w, d| w.add(body().density(d)));
    refused(w, "friction", &with(&[-0.1, 1e7]), |w, f| w.add(body().friction(f)));
    refused(w, "restitution", &with(&[-0.1, 1.1]), |w, e| w.add(body().restitution(e)));
    refused(w, "rolling_friction", &with(&[-0.1, 1e7]), |w, r| w.add(body().rolling_friction(r)));
    refused(w, "gravity_scale", &with(&[1e7]), |w, g| w.add(body().gravity_scale(g)));
    refused(w, "damping.linear", &with(&[-1.0, 1e7]), |w, d| w.add(body().damping(d, 0.0)));
    refused(w, "damping.angular", &with(&[-1.0, 1e7]), |w, d| w.add(body().damping(0.0, d)));
    run(w, 0.05);
}

#[test]
fn wrong_calls_are_refused() {
    let (mut world, [floor, body, ..]) = scene();
    let w = &mut world;
    vector_refused(w, "position", |w, x| w.set_pose(body, x, Quat::IDENTITY));
    refused(w, "rotation", &turns(), |w, q| w.set_pose(body, Vec3::ZERO, q));
    vector_refused(w, "velocity", |w, x| w.set_velocity(body, x));
    vector_refused(w, "angular_velocity", |w, x| w.set_angular_velocity(body, x));
    vector_refused(w, "force", |w, x| w.apply_force(body, x));
    vector_refused(w, "force", |w, x| w.apply_force_at_point(body, x, Vec3::ZERO));
    vector_refused(w, "point", |w, x| w.apply_force_at_point(body, Vec3::X, x));
    vector_refused(w, "torque", |w, x| w.apply_torque(body, x));
    vector_refused(w, "impulse", |w, x| w.apply_impulse(body, x));
    vector_refused(w, "impulse", |w, x| w.apply_impulse_at_point(body, x, Vec3::ZERO));
    vector_refused(w, "point", |w, x| w.apply_impulse_at_point(body, Vec3::X, x));
    vector_refused(w, "impulse", |w, x| w.apply_angular_impulse(body, x));
    refused(w, "gravity_scale", &with(&[1e7]), |w, g| w.set_gravity_scale(body, g));
    refused(w, "damping.linear", &with(&[-1.0]), |w, d| w.set_damping(body, d, 0.0));
    refused(w, "damping.angular", &with(&[-1.0]), |w, d| w.set_damping(body, 0.0, d));
    let surface = Surface::default();
    for body in [floor, body] {
        refused(w, "friction", &with(&[-1.0]), |w, f| {
            w.set_surface(body, Surface { friction: f, ..surface })
        });
        refused(w, "restitution", &with(&[-1.0, 2.0]), |w, e| {
            w.set_surface(body, Surface { restitution: e, ..surface })
        });
    }
    let dust = add(w, RigidBody::new(&cube(0.001)).mass(1e-15).position(Vec3::Z * 9.0));
    refused(w, "impulse", &[1.0, 1e9], |w, x| w.apply_impulse(dust, Vec3::X * x));
    refused(w, "impulse", &[1.0, 1e9], |w, x| w.apply_angular_impulse(dust, Vec3::X * x));
    refused(w, "impulse", &[1.0], |w, x| w.apply_impulse_at_point(dust, Vec3::X * x, Vec3::splat(1e9)));
    refused(w, "dt", &with(&[0.0, -0.1, 1e9]), |w, dt| w.step(dt));
    run(w, 0.05);
}

#[test]
fn wrong_queries_and_grabs_are_refused() {
    let (mut world, [_, body, ..]) = scene();
    let w = &mut world;
    let (all, ball) = (QueryFilter::default(), Shape::sphere(0.5).unwrap());
    let mesh = Shape::triangle_mesh(&primitives::grid(3, 3, 1.0, 1.0).unwrap()).unwrap();
    let q = Quat::IDENTITY;
    vector_refused(w, "origin", |w, x| w.ray_cast(x, Vec3::X, 1.0, all));
    vector_refused(w, "direction", |w, x| w.ray_cast_all(Vec3::X, x, 1.0, all));
    refused(w, "direction", &[Vec3::ZERO, Vec3::X * 1e-7], |w, x| w.ray_cast(Vec3::X, x, 1.0, all));
    refused(w, "max", &with(&[-1.0, 1e11]), |w, max| w.ray_cast(Vec3::X, Vec3::X, max, all));
    refused(w, "max", &with(&[-1.0, 1e11]), |w, max| w.closest_point(Vec3::X, max, all));
    vector_refused(w, "point", |w, x| w.closest_point(x, 1.0, all));
    vector_refused(w, "position", |w, x| w.overlap(&ball, x, q, all));
    vector_refused(w, "position", |w, x| w.shape_cast(&ball, x, q, Vec3::X, all));
    vector_refused(w, "translation", |w, x| w.shape_cast(&ball, Vec3::X, q, x, all));
    refused(w, "rotation", &turns(), |w, q| w.overlap(&ball, Vec3::X, q, all));
    refused(w, "shape", &[()], |w, ()| w.overlap(&mesh, Vec3::X, q, all));
    vector_refused(w, "point", |w, x| w.grab(body, x, Grip::default()));
    refused(w, "grip.frequency", &with(&[0.0, -1.0, 1e5]), |w, frequency| {
        w.grab(body, Vec3::X, Grip { frequency, ..Grip::default() })
    });
    refused(w, "grip.max_acceleration", &with(&[0.0, -1.0, 1e10]), |w, max_acceleration| {
        w.grab(body, Vec3::X, Grip { max_acceleration, ..Grip::default() })
    });
    let grab = w.grab(body, Vec3::X, Grip::default()).unwrap();
    vector_refused(w, "target", |w, x| w.move_grab(grab, x));
}

#[test]
fn particles_of_rigid_bodies_and_poses_of_others_are_not_to_be_set() {
    let (mut world, [floor, body, truss, cloth, rope]) = scene();
    let w = &mut world;
    refused(w, "body", &[0, 3, 4], |w, i| w.pin(body, i));
    refused(w, "body", &[0], |w, i| w.unpin(body, i));
    refused(w, "body", &[0], |w, i| w.set_particle_position(body, i, Vec3::ZERO));
    refused(w, "body", &[0], |w, i| w.set_particle_mass(body, i, 1.0));
    refused(w, "body", &[0], |w, i| w.apply_force_at(body, i, Vec3::X));
    let others = [floor, truss, cloth, rope];
    refused(w, "body", &others, |w, b| w.set_pose(b, Vec3::ZERO, Quat::IDENTITY));
    refused(w, "body", &others, |w, b| w.set_angular_velocity(b, Vec3::ZERO));
    refused(w, "body", &others, |w, b| w.set_motion(b, Motion::Fixed));
    refused(w, "body", &others, |w, b| w.set_gravity_scale(b, 1.0));
    refused(w, "body", &others, |w, b| w.set_damping(b, 0.0, 0.0));
    refused(w, "body", &others, |w, b| w.set_groups(b, QueryFilter::default().groups));
    refused(w, "body", &others, |w, b| w.apply_force_at_point(b, Vec3::X, Vec3::X));
    refused(w, "body", &others, |w, b| w.apply_torque(b, Vec3::X));
    refused(w, "body", &others, |w, b| w.apply_impulse_at_point(b, Vec3::X, Vec3::X));
    refused(w, "body", &others, |w, b| w.apply_angular_impulse(b, Vec3::X));
    let mesh = Arc::new(Shape::triangle_mesh(&primitives::grid(3, 3, 1.0, 1.0).unwrap()).unwrap());
    let mesh = add(w, RigidBody::new(&mesh).position(Vec3::Z * 9.0).fixed());
    refused(w, "motion", &[mesh], |w, b| w.set_motion(b, Motion::Dynamic));
    w.set_motion(mesh, Motion::Kinematic).unwrap();
}

#[test]
fn stale_handles_are_refused_by_every_call() {
    let (mut world, [_, stale, ..]) = scene();
    world.remove(stale).unwrap();
    let w = &mut world;
    let (x, q, s) = (Vec3::X, Quat::IDENTITY, [stale]);
    refused(w, "handle", &s, |w, b| w.set_pose(b, x, q));
    refused(w, "handle", &s, |w, b| w.set_angular_velocity(b, x));
    refused(w, "handle", &s, |w, b| w.set_motion(b, Motion::Fixed));
    refused(w, "handle", &s, |w, b| w.set_gravity_scale(b, 1.0));
    refused(w, "handle", &s, |w, b| w.set_damping(b, 0.0, 0.0));
    refused(w, "handle", &s, |w, b| w.set_surface(b, Surface::default()));
    refused(w, "handle", &s, |w, b| w.set_groups(b, QueryFilter::default().groups));
    refused(w, "handle", &s, |w, b| w.apply_force_at_point(b, x, x));
    refused(w, "handle", &s, |w, b| w.apply_torque(b, x));
    refused(w, "handle", &s, |w, b| w.apply_impulse(b, x));
    refused(w, "handle", &s, |w, b| w.apply_impulse_at_point(b, x, x));
    refused(w, "handle", &s, |w, b| w.apply_angular_impulse(b, x));
    refused(w, "handle", &s, |w, b| w.grab(b, x, Grip::default()));
}
