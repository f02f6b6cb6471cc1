//! Cloth in rapier3d: its soft bodies, as stiff as they stay stable, with thickness as its own examples choose it.

use glam::Vec3;
use rapier3d::prelude::*;

use super::engine::{Engine, State};
use super::scene::{AIR_DAMPING, CUBE_HALF, FRICTION, ROPE_RADIUS, ROPE_SEGMENTS, SIDE, Start, Support};
use crate::Failure;
use crate::rapier::{from_rapier, to_rapier};
use crate::scene::{GRAVITY, STEP};

/// Natural frequency of the edges, in Hz, critically damped: so far above the substeps' that they are as stiff as rapier
/// can make them. At its default of 30 Hz the mean stretch is five times as large, and nothing is faster.
const EDGE_FREQUENCY: f32 = 1e4;

/// Most that a particle's radius is, in m: half an edge, which is rapier's default, would be 5 cm at 20 × 20.
const MOST_RADIUS: f32 = 0.02;

/// A scene in rapier.
pub(super) struct Rapier {
    world: PhysicsWorld,
    cloth: SoftBodyHandle,
    rope: Option<SoftBodyHandle>,
    n: usize,
}

impl Rapier {
    pub(super) fn new(start: &Start, self_collision: bool) -> Result<Self, Failure> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::Y * GRAVITY;
        world.integration_parameters.dt = STEP;
        let floor = ColliderBuilder::cuboid(20.0, 1.0, 20.0).friction(FRICTION);
        world.insert(RigidBodyBuilder::fixed().translation(Vector::NEG_Y), floor);
        let rope = match start.support {
            Support::Cube => {
                let cube = ColliderBuilder::cuboid(CUBE_HALF, CUBE_HALF, CUBE_HALF).friction(FRICTION);
                world.insert(RigidBodyBuilder::fixed().translation(Vector::Y * CUBE_HALF), cube);
                None
            }
            Support::Rope => Some(world.insert_soft_body(rope(start, self_collision))),
        };
        let cloth = world.insert_soft_body(cloth(start, self_collision));
        let n = start.n as usize;
        // Afterwards: the noise is not in the lengths at rest.
        let body = world.soft_bodies.get_mut(cloth).ok_or("rapier has no cloth")?;
        for (i, position) in start.positions().into_iter().enumerate() {
            body.set_particle_position(transposed(i, n), to_rapier(position));
        }
        Ok(Self { world, cloth, rope, n })
    }
}

fn cloth(start: &Start, self_collision: bool) -> SoftBodyBuilder {
    let edge = SIDE / (start.n - 1) as f32;
    let corner = Vector::new(-0.5 * SIDE, start.height(), -0.5 * SIDE);
    let n = start.n as usize;
    let surface = ColliderBuilder::ball(0.1).friction(FRICTION);
    let cloth = SoftBodyBuilder::cloth(corner, Vector::X * edge, Vector::Z * edge, n, n).mass(1.0);
    let cloth = cloth.linear_damping(AIR_DAMPING).surface_collider(surface);
    stiff(cloth.particle_radius(MOST_RADIUS.min(0.5 * edge)), self_collision)
}

fn rope(start: &Start, self_collision: bool) -> SoftBodyBuilder {
    let points: Vec<Vector> = start.rope().into_iter().map(to_rapier).collect();
    let count = points.len();
    let rope = SoftBodyBuilder::rope(points[0], points[count - 1], count).positions(points);
    let rope = rope.pinned_particles([0, ROPE_SEGMENTS]).mass(1.0).particle_radius(ROPE_RADIUS);
    stiff(rope, self_collision)
}

fn stiff(mut body: SoftBodyBuilder, self_collision: bool) -> SoftBodyBuilder {
    body.material.edge_softness = SpringCoefficients::new(EDGE_FREQUENCY, 1.0);
    body.can_sleep(false).self_contacts(self_collision)
}

/// rapier counts column after column, we row after row; each is the other's transpose.
fn transposed(index: usize, n: usize) -> usize {
    index % n * n + index / n
}

impl Engine for Rapier {
    fn step(&mut self) -> Result<(), Failure> {
        self.world.step();
        Ok(())
    }

    fn state(&self) -> Result<State, Failure> {
        let cloth = &self.world.soft_bodies[self.cloth];
        let rope = self.rope.map(|rope| &self.world.soft_bodies[rope]);
        let in_rows = |of: &dyn Fn(usize) -> Vector| -> Vec<Vec3> {
            (0..self.n * self.n).map(|i| from_rapier(of(transposed(i, self.n)))).collect()
        };
        let index = |index: u32| transposed(index as usize, self.n) as u32;
        Ok(State {
            positions: in_rows(&|i| cloth.particle_position(i)),
            velocities: in_rows(&|i| cloth.particle_velocity(i)),
            triangles: cloth.boundary().iter().map(|triangle| triangle.map(index)).collect(),
            rope: rope.map_or(Vec::new(), |rope| rope.particle_positions().map(from_rapier).collect()),
        })
    }
}
