//! rapier3d, as its defaults are: the walls are cuboids, with which it is faster than with half-spaces.

use glam::{Quat, Vec3};
use rapier3d::prelude::*;

use crate::Failure;
use crate::engine::Engine;
use crate::icosahedron;
use crate::scene::{FRICTION, GRAVITY, STEP, Scene, State};

/// A scene in rapier.
pub(crate) struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

impl Rapier {
    pub(crate) fn new(scene: &Scene) -> Result<Self, Failure> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::Y * GRAVITY;
        world.integration_parameters.dt = STEP;
        for wall in scene.walls() {
            let [x, y, z] = wall.half_extents.to_array();
            let shape = ColliderBuilder::cuboid(x, y, z).friction(FRICTION).restitution(0.0);
            world.insert(RigidBodyBuilder::fixed().translation(to_rapier(wall.center)), shape);
        }
        let points: Vec<Vector> = icosahedron::vertices().iter().map(|v| to_rapier(v.as_vec3())).collect();
        let hull = ColliderBuilder::convex_hull(&points).ok_or("rapier finds no hull of the icosahedron")?;
        let hull = hull.friction(FRICTION).restitution(0.0).mass(1.0);
        let bodies =
            scene.bodies.iter().map(|body| world.insert(description(body), hull.clone()).0).collect();
        Ok(Self { world, bodies })
    }
}

impl Engine for Rapier {
    fn step(&mut self) -> Result<(), Failure> {
        self.world.step();
        Ok(())
    }

    fn states(&self) -> Result<Vec<State>, Failure> {
        let state = |&handle: &RigidBodyHandle| {
            let body = &self.world.bodies[handle];
            State {
                position: from_rapier(body.translation()),
                rotation: Quat::from_array(body.rotation().to_array()),
                velocity: from_rapier(body.linvel()),
                angular_velocity: from_rapier(body.angvel()),
            }
        };
        Ok(self.bodies.iter().map(state).collect())
    }
}

fn description(body: &State) -> RigidBodyBuilder {
    let [x, y, z, w] = body.rotation.to_array();
    RigidBodyBuilder::dynamic()
        .pose(Pose::from_parts(to_rapier(body.position), Rotation::from_xyzw(x, y, z, w)))
        .linvel(to_rapier(body.velocity))
        .angvel(to_rapier(body.angular_velocity))
        .can_sleep(false)
}

/// Both are vectors of glam, but of different versions.
pub(crate) fn to_rapier(vector: Vec3) -> Vector {
    Vector::from_array(vector.to_array())
}

pub(crate) fn from_rapier(vector: Vector) -> Vec3 {
    Vec3::from_array(vector.to_array())
}
