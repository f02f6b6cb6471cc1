//! A pile of icosahedra, as the comparison with other engines has it: thrown about in a room that they fill, they fall
//! and come to rest.

use std::sync::Arc;

use tautline::mesh::primitives::icosahedron;
use tautline::{HalfSpace, Quat, RigidBody, Settings, Shape, Vec3, World};

/// In s.
pub(crate) const STEP: f32 = 1.0 / 60.0;
/// Until then bodies fly about.
pub(crate) const FLYING_STEPS: usize = 120;
/// The room's side for one body, in m.
const SPACING: f32 = 1.25;

/// Where the bodies are when they are thrown.
pub(crate) fn thrown(count: usize) -> World {
    let side = SPACING * (count as f32).cbrt();
    let mut world =
        World::new(Settings { sleep: None, ..Settings::default() }).expect("the settings are sound");
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        world.add(HalfSpace::new(axis, 0.0)).expect("a wall");
        world.add(HalfSpace::new(-axis, -side)).expect("a wall");
    }
    let corners = icosahedron(0.5).expect("a radius").positions;
    let shape = Arc::new(Shape::convex_hull(&corners).expect("a hull"));
    let per_side = (1..).find(|n| n * n * n >= count).unwrap_or(1);
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / 8_388_608.0 - 1.0
    };
    for cell in 0..count {
        let corner = [cell % per_side, cell / per_side % per_side, cell / per_side / per_side];
        let cell_side = side / per_side as f32;
        let mut vector = || Vec3::new(noise(), noise(), noise());
        let position = (Vec3::from(corner.map(|c| c as f32 + 0.5)) + vector() * 0.08) * cell_side;
        let rotation = Quat::from_scaled_axis(vector() * 3.0);
        let body = RigidBody::new(&shape).mass(1.0).position(position).rotation(rotation);
        world.add(body.velocity(vector() * 4.0).angular_velocity(vector() * 4.0)).expect("a body");
    }
    world
}
