//! A pile of a thousand bodies.

use std::collections::BTreeMap;
use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{BodyHandle, DVec3, Error, HalfSpace, RigidBody, Shape, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::depth::{Placed, Polytope};
use super::lab::run;
use crate::random::Random;

/// Of the room's floor, in m.
const SIDE: f32 = 8.0;
const COUNT: usize = 1000;
/// Of an icosahedron's corners, in m.
const RADIUS: f32 = 0.5;

pub(super) fn cases() -> Vec<Case> {
    let trial = |seed: u64| Trial::new(move |conditions| pile(conditions, seed));
    vec![Case {
        id: 23,
        group: "Piles",
        name: "1000 icosahedra in a room, 15 s",
        formula: "penetration 0, speed 0, none outside",
        note: "Icosahedra of 1 m, dropped into 8 × 8 m between half-spaces; judged after 15 s by the separating axis theorem.",
        trials: vec![trial(1)],
    }]
}

fn walls() -> [HalfSpace; 5] {
    let half = 0.5 * SIDE;
    [
        HalfSpace::floor(0.0),
        HalfSpace::new(Vec3::X, -half),
        HalfSpace::new(Vec3::NEG_X, -half),
        HalfSpace::new(Vec3::Z, -half),
        HalfSpace::new(Vec3::NEG_Z, -half),
    ]
}

fn pile(conditions: &Conditions, seed: u64) -> Result<Vec<Part>, Error> {
    let shape = Arc::new(Shape::convex_hull(&primitives::icosahedron(RADIUS)?.positions)?);
    let mut world = conditions.world()?;
    for wall in walls() {
        world.add(wall)?;
    }
    let bodies = drop_layers(&mut world, &shape, &mut Random::new(seed))?;
    run(&mut world, 15.0)?;

    let solid = Polytope::new(&shape);
    let placed: Vec<Placed> =
        bodies.iter().map(|&body| solid.placed(&world, body)).collect::<Result<_, _>>()?;
    let depths = depths(&placed);
    let mean = depths.iter().sum::<f64>() / depths.len().max(1) as f64;
    let deepest = depths.iter().copied().fold(0.0, f64::max);
    let half = f64::from(0.5 * SIDE);
    let is_outside = |body: &&Placed| {
        let DVec3 { x, y, z } = body.position;
        !(x.abs() < half && z.abs() < half && y > 0.0)
    };
    let mut fastest: f64 = 0.0;
    for &body in &bodies {
        fastest = fastest.max(world.body(body)?.velocity().as_dvec3().length());
    }
    let mass_moved = COUNT as f64;
    let speed = (2.0 * world.kinetic_energy() / mass_moved).sqrt();
    Ok(vec![
        Part::at_most("deepest penetration", deepest * 1e3, 5.0, "mm"),
        Part::at_most("mean penetration", mean * 1e3, 0.5, "mm"),
        Part::at_most("bodies outside", placed.iter().filter(is_outside).count() as f64, 0.0, ""),
        Part::at_most("root mean square speed", speed, 1e-4, "m/s"),
        Part::at_most("fastest body's speed", fastest, 1e-4, "m/s"),
    ])
}

/// Layers of 7 × 7 bodies, a little out of place and turned at random, slowly moving and turning.
fn drop_layers(world: &mut World, shape: &Arc<Shape>, random: &mut Random) -> Result<Vec<BodyHandle>, Error> {
    const ACROSS: usize = 7;
    const SPACING: f32 = 1.08;
    let place = |i: usize| (i as f32 - 0.5 * (ACROSS - 1) as f32) * SPACING;
    (0..COUNT)
        .map(|i| {
            let (layer, row, column) = (i / (ACROSS * ACROSS), i / ACROSS % ACROSS, i % ACROSS);
            let home = Vec3::new(place(row), 0.6 + SPACING * layer as f32, place(column));
            let body = RigidBody::new(shape).mass(1.0).position(home + random.in_cube(0.03));
            let body = body.rotation(random.rotation()).velocity(random.vector(1.0));
            world.add(body.angular_velocity(random.vector(1.0)))
        })
        .collect()
}

/// How deep every pair, and every body and wall, that penetrate are in each other, in m.
fn depths(placed: &[Placed]) -> Vec<f64> {
    let walls = [
        (DVec3::Y, 0.0),
        (DVec3::X, f64::from(-0.5 * SIDE)),
        (DVec3::NEG_X, f64::from(-0.5 * SIDE)),
        (DVec3::Z, f64::from(-0.5 * SIDE)),
        (DVec3::NEG_Z, f64::from(-0.5 * SIDE)),
    ];
    let mut depths: Vec<f64> = Vec::new();
    for body in placed {
        depths.extend(walls.iter().map(|&(normal, offset)| body.depth_below(normal, offset)));
    }
    depths.extend(neighbours(placed).into_iter().map(|(a, b)| placed[a].depth_in(&placed[b])));
    depths.retain(|&depth| depth > 0.0);
    depths
}

/// Pairs whose centres may be nearer than two radii, by a grid of such cells.
fn neighbours(placed: &[Placed]) -> Vec<(usize, usize)> {
    let width = 2.0 * f64::from(RADIUS);
    // What is no number, or far off, has a place too.
    let cell = |body: &Placed| (body.position / width).to_array().map(|c| c.floor().clamp(-1e6, 1e6) as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (b, body) in placed.iter().enumerate() {
        let [x, y, z] = cell(body);
        for (i, j, k) in (0..27).map(|n| (n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)) {
            pairs.extend(cells.get(&[x + i, y + j, z + k]).into_iter().flatten().map(|&a| (a, b)));
        }
        cells.entry([x, y, z]).or_default().push(b);
    }
    pairs
}
