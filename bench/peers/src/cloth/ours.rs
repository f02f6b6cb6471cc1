//! Cloth in tautline, as its defaults are.

use std::sync::Arc;

use glam::Vec3;
use tautline::{BodyHandle, Cloth, HalfSpace, RigidBody, Rope, Settings, Shape, World};

use super::engine::{Engine, State};
use super::scene::{AIR_DAMPING, CUBE_HALF, FRICTION, ROPE_RADIUS, SIDE, Start, Support};
use crate::Failure;
use crate::scene::{GRAVITY, STEP};

/// A scene in tautline.
pub(super) struct Ours {
    world: World,
    cloth: BodyHandle,
    rope: Option<BodyHandle>,
}

impl Ours {
    pub(super) fn new(start: &Start, self_collision: bool) -> Result<Self, Failure> {
        let gravity = Vec3::Y * GRAVITY;
        let mut world =
            World::new(Settings { gravity, damping: AIR_DAMPING, sleep: None, ..Settings::default() })?;
        world.add(HalfSpace::floor(0.0).friction(FRICTION))?;
        let rope = match start.support {
            Support::Cube => {
                let cube = Arc::new(Shape::cuboid(Vec3::splat(CUBE_HALF))?);
                world.add(RigidBody::new(&cube).position(Vec3::Y * CUBE_HALF).friction(FRICTION).fixed())?;
                None
            }
            Support::Rope => {
                let rope = Rope::through(start.rope()).pin_ends().mass(1.0).radius(ROPE_RADIUS);
                Some(world.add(rope.friction(FRICTION).self_collision(self_collision))?)
            }
        };
        let cloth = Cloth::grid(start.n, start.n, SIDE, SIDE).position(Vec3::Y * start.height());
        let cloth = world.add(cloth.mass(1.0).friction(FRICTION).self_collision(self_collision))?;
        // Afterwards: the noise is not in the lengths at rest.
        for (particle, position) in (0..).zip(start.positions()) {
            world.set_particle_position(cloth, particle, position)?;
        }
        Ok(Self { world, cloth, rope })
    }
}

impl Engine for Ours {
    fn step(&mut self) -> Result<(), Failure> {
        let report = self.world.step(STEP)?;
        match report.faults.first() {
            None => Ok(()),
            Some(fault) => Err(format!("tautline froze a body: {fault:?}").into()),
        }
    }

    fn state(&self) -> Result<State, Failure> {
        let cloth = self.world.body(self.cloth)?;
        let rope = self.rope.map(|rope| self.world.body(rope)).transpose()?;
        let positions = cloth.positions().to_vec();
        let velocities = (0..positions.len() as u32).map(|particle| cloth.particle_velocity(particle));
        Ok(State {
            velocities: velocities.collect(),
            triangles: cloth.triangles().to_vec(),
            rope: rope.map_or(Vec::new(), |rope| rope.positions().to_vec()),
            positions,
        })
    }
}
