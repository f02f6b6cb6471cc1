//! Cloth and rope in small steps, seen from outside: what they lie on, what they carry, what they keep.

mod air;
mod attach;
mod attach_handles;
mod bits;
mod closed;
mod fabric;
mod gas;
mod jelly;
mod motion;
mod nets;
mod rest;
mod ropes;
mod solids;
mod together;
mod wear;
mod winding;

use std::sync::Arc;

use tautline::{BodyHandle, DVec3, RigidBody, Settings, Shape, Vec3, World};

const DT: f32 = 1.0 / 60.0;

fn run(world: &mut World, seconds: f32) {
    for _ in 0..(seconds / DT).round() as usize {
        let report = world.step(DT).unwrap();
        assert!(report.faults.is_empty(), "{:?}", report.faults);
    }
}

fn weightless() -> Settings {
    Settings { gravity: Vec3::ZERO, sleep: None, ..Settings::default() }
}

fn solid(shape: Shape) -> RigidBody {
    RigidBody::new(&Arc::new(shape))
}

fn positions(world: &World, body: BodyHandle) -> Vec<Vec3> {
    world.body(body).unwrap().positions().to_vec()
}

fn center(world: &World, body: BodyHandle) -> Vec3 {
    world.body(body).unwrap().center_of_mass()
}

/// By how much the longest stick of a body is too long, as a share of its length.
fn stretch(world: &World, body: BodyHandle) -> f32 {
    let view = world.body(body).unwrap();
    let at = view.positions();
    let strain = |stick: &tautline::constraint::Stick| {
        at[stick.a as usize].distance(at[stick.b as usize]) / stick.rest_length - 1.0
    };
    view.sticks().iter().map(strain).fold(f32::NEG_INFINITY, f32::max)
}

/// Whether a segment goes through a triangle, in f64 (signs of volumes).
fn pierces([p, q]: [Vec3; 2], corners: [Vec3; 3]) -> bool {
    let [p, q]: [DVec3; 2] = [p, q].map(Vec3::as_dvec3);
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let volume = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (b - a).cross(c - a).dot(d - a);
    if volume(a, b, c, p) * volume(a, b, c, q) >= 0.0 {
        return false;
    }
    let around = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
    around.iter().all(|&v| v > 0.0) || around.iter().all(|&v| v < 0.0)
}

/// How many sticks of one body go through triangles of another.
fn pierced(world: &World, sticks_of: BodyHandle, triangles_of: BodyHandle) -> usize {
    let [sharp, flat] = [sticks_of, triangles_of].map(|body| world.body(body).unwrap());
    let corners = |t: &[u32; 3]| t.map(|corner| flat.positions()[corner as usize]);
    let ends =
        |stick: &tautline::constraint::Stick| [stick.a, stick.b].map(|end| sharp.positions()[end as usize]);
    let through = |ends: [Vec3; 2]| flat.triangles().iter().filter(|t| pierces(ends, corners(t))).count();
    sharp.sticks().iter().map(|stick| through(ends(stick))).sum()
}
