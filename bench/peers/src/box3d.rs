//! Box3D, as its defaults are: 4 substeps, walls of boxes.

use boxddd::{BodyDef, BodyId, BodyType, BoxHull, Foundation, Hull, ShapeDef, World};
use glam::{Quat, Vec3};

use crate::Failure;
use crate::engine::Engine;
use crate::icosahedron;
use crate::scene::{FRICTION, GRAVITY, STEP, Scene, State};

/// What Box3D's own samples and benchmarks use.
const SUBSTEPS: i32 = 4;

/// A scene in Box3D.
pub(crate) struct Box3d {
    world: World,
    bodies: Vec<BodyId>,
}

impl Box3d {
    pub(crate) fn new(scene: &Scene) -> Result<Self, Failure> {
        let foundation = match Foundation::get() {
            Ok(foundation) => foundation,
            Err(_) => Foundation::initialize_default()?,
        };
        let settings = foundation.world_def_builder().gravity([0.0, GRAVITY, 0.0]).enable_sleep(false);
        let mut world = foundation.create_world(settings.worker_count(1).build()?)?;
        let surface = foundation.shape_def_builder().friction(FRICTION).restitution(0.0);
        add_walls(&mut world, foundation, &surface.clone().build()?, scene)?;
        let points = icosahedron::vertices();
        let points: Vec<boxddd::Vec3> = points.iter().map(|v| v.as_vec3().to_array().into()).collect();
        let hull = Hull::from_points(&points, points.len() as i32)?;
        let shape = surface.density((1.0 / icosahedron::volume()) as f32).build()?;
        let mut bodies = Vec::with_capacity(scene.bodies.len());
        for body in &scene.bodies {
            let id = world.create_body(description(foundation, body)?)?;
            world.create_created_hull_shape(id, &shape, &hull)?;
            bodies.push(id);
        }
        Ok(Self { world, bodies })
    }

    fn state(&self, id: BodyId) -> boxddd::Result<State> {
        let place = self.world.body_transform(id)?;
        Ok(State {
            position: Vec3::new(place.p.x, place.p.y, place.p.z),
            rotation: Quat::from_xyzw(place.q.v.x, place.q.v.y, place.q.v.z, place.q.s),
            velocity: from_box3d(self.world.body_linear_velocity(id)?),
            angular_velocity: from_box3d(self.world.body_angular_velocity(id)?),
        })
    }
}

impl Engine for Box3d {
    fn step(&mut self) -> Result<(), Failure> {
        Ok(self.world.step(STEP, SUBSTEPS)?)
    }

    fn states(&self) -> Result<Vec<State>, Failure> {
        Ok(self.bodies.iter().map(|&id| self.state(id)).collect::<Result<_, _>>()?)
    }
}

fn add_walls(
    world: &mut World,
    foundation: &Foundation,
    shape: &ShapeDef,
    scene: &Scene,
) -> boxddd::Result<()> {
    for wall in scene.walls() {
        let body = foundation.body_def_builder().position(wall.center.to_array()).build()?;
        let id = world.create_body(body)?;
        let [x, y, z] = wall.half_extents.to_array();
        world.create_hull_shape(id, shape, &BoxHull::new(x, y, z)?)?;
    }
    Ok(())
}

fn description(foundation: &Foundation, body: &State) -> boxddd::Result<BodyDef> {
    let [x, y, z, s] = body.rotation.to_array();
    foundation
        .body_def_builder()
        .body_type(BodyType::Dynamic)
        .position(body.position.to_array())
        .rotation(boxddd::Quat { v: [x, y, z].into(), s })
        .linear_velocity(body.velocity.to_array())
        .angular_velocity(body.angular_velocity.to_array())
        .enable_sleep(false)
        .build()
}

fn from_box3d(vector: boxddd::Vec3) -> Vec3 {
    Vec3::new(vector.x, vector.y, vector.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_weigh_a_kilogram() {
        let scene = Scene::read(crate::scene::Room::Dense, 200).unwrap();
        let engine = Box3d::new(&scene).unwrap();
        assert!((engine.world.body_mass(engine.bodies[7]).unwrap() - 1.0).abs() < 1e-5);
    }
}
