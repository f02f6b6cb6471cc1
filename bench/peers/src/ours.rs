//! tautline, as its defaults are: the walls are half-spaces.

use std::sync::Arc;

use glam::Vec3;
use tautline::mesh::primitives;
use tautline::{BodyHandle, BodyView, HalfSpace, RigidBody, Settings, Shape, World};

use crate::Failure;
use crate::engine::Engine;
use crate::icosahedron;
use crate::scene::{FRICTION, GRAVITY, STEP, Scene, State};

/// A scene in tautline.
pub(crate) struct Ours {
    world: World,
    bodies: Vec<BodyHandle>,
}

impl Ours {
    pub(crate) fn new(scene: &Scene, substeps: u32) -> Result<Self, Failure> {
        let gravity = Vec3::Y * GRAVITY;
        let mut world = World::new(Settings { gravity, substeps, sleep: None, ..Settings::default() })?;
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            world.add(HalfSpace::new(axis, 0.0).friction(FRICTION))?;
            world.add(HalfSpace::new(-axis, -scene.side).friction(FRICTION))?;
        }
        let corners = primitives::icosahedron(icosahedron::RADIUS as f32)?.positions;
        let shape = Arc::new(Shape::convex_hull(&corners)?);
        let bodies = scene.bodies.iter().map(|body| world.add(description(&shape, body)));
        let bodies = bodies.collect::<Result<_, _>>()?;
        Ok(Self { world, bodies })
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

    fn states(&self) -> Result<Vec<State>, Failure> {
        self.bodies.iter().map(|&handle| state(self.world.body(handle)?)).collect()
    }
}

fn description(shape: &Arc<Shape>, body: &State) -> RigidBody {
    RigidBody::new(shape)
        .position(body.position)
        .rotation(body.rotation)
        .velocity(body.velocity)
        .angular_velocity(body.angular_velocity)
        .mass(1.0)
        .friction(FRICTION)
}

fn state(body: BodyView<'_>) -> Result<State, Failure> {
    let (position, rotation) = body.pose().ok_or("tautline gives a body no pose")?;
    let (velocity, angular_velocity) = (body.velocity(), body.angular_velocity());
    Ok(State { position, rotation, velocity, angular_velocity })
}
