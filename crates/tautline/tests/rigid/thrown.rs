//! What joints hold together, thrown at a thin wall.

use std::sync::Arc;

use tautline::{BallJoint, BodyHandle, FixedJoint, Quat, RigidBody, Shape, Vec3, World};

use super::{DT, add, center, weightless};

/// Half of the width and the height of the wall, in m.
const HALF: f32 = 1.5;

/// Where and how something is thrown, along X.
#[derive(Clone, Copy)]
struct Throw {
    place: Vec3,
    turn: Quat,
    speed: f32,
}

impl Throw {
    fn point(&self, place: Vec3) -> Vec3 {
        self.place + self.turn * place
    }

    fn body(&self, world: &mut World, shape: Shape, place: Vec3) -> BodyHandle {
        let body = RigidBody::new(&Arc::new(shape)).mass(1.0).position(self.point(place));
        add(world, body.rotation(self.turn).velocity(Vec3::X * self.speed))
    }

    /// A body with four limbs.
    fn figure(&self, world: &mut World) -> Vec<BodyHandle> {
        let torso = self.body(world, Shape::cuboid(Vec3::new(0.15, 0.25, 0.1)).unwrap(), Vec3::ZERO);
        let mut bodies = vec![torso];
        for (x, y) in [(-0.15, 0.25), (0.15, 0.25), (-0.1, -0.25), (0.1, -0.25)] {
            let limb = Shape::capsule(0.05, 0.15).unwrap();
            let limb = self.body(world, limb, Vec3::new(1.5 * x, 1.9 * y, 0.0));
            world.add_joint(BallJoint::new(limb, torso).anchor(self.point(Vec3::new(x, y, 0.0)))).unwrap();
            bodies.push(limb);
        }
        bodies
    }

    fn chain(&self, world: &mut World) -> Vec<BodyHandle> {
        let link = |world: &mut World, i: u32| {
            self.body(world, Shape::capsule(0.01, 0.04).unwrap(), Vec3::Y * 0.1 * i as f32)
        };
        let links: Vec<BodyHandle> = (0..8).map(|i| link(world, i)).collect();
        for (i, pair) in links.windows(2).enumerate() {
            let between = self.point(Vec3::Y * 0.1 * (i as f32 + 0.5));
            world.add_joint(BallJoint::new(pair[1], pair[0]).anchor(between)).unwrap();
        }
        links
    }

    fn dumbbell(&self, world: &mut World) -> Vec<BodyHandle> {
        let balls = [0.0, 0.2].map(|y| self.body(world, Shape::sphere(0.02).unwrap(), Vec3::Y * y));
        world.add_joint(FixedJoint::new(balls[0], balls[1])).unwrap();
        balls.into()
    }
}

#[test]
fn nothing_of_it_goes_through() {
    let kinds = [Throw::figure, Throw::chain, Throw::dumbbell];
    for (speed, thickness) in [(30.0, 0.01), (100.0, 0.01), (100.0, 0.001), (1000.0, 0.001)] {
        for (phase, kind) in (0..10).flat_map(|i| kinds.map(|kind| (i as f32 / 10.0, kind))) {
            let mut world = World::new(weightless()).unwrap();
            let wall = Arc::new(Shape::cuboid(Vec3::new(thickness / 2.0, HALF, HALF)).unwrap());
            add(&mut world, RigidBody::new(&wall).fixed());
            let place = Vec3::X * (-1.0 - phase * speed * DT);
            let turn = Quat::from_scaled_axis(Vec3::new(3.0 * phase, 1.0, 7.0 * phase));
            let bodies = kind(&Throw { place, turn, speed }, &mut world);
            let before = world.kinetic_energy();
            for _ in 0..(2.0 / speed / DT) as usize + 10 {
                assert!(world.step(DT).unwrap().faults.is_empty());
                assert!(world.kinetic_energy() < 1.001 * before);
                for &body in &bodies {
                    let x = center(&world, body);
                    let is_behind = x.x > 0.0 && x.y.abs().max(x.z.abs()) < HALF;
                    assert!(!is_behind, "{speed} m/s, {thickness} m, {phase}: {x}");
                }
            }
        }
    }
}

/// Nothing holds up what lies still: a chain that was thrown at a wall falls down and hangs from nothing.
#[test]
fn what_has_struck_falls() {
    let mut world = World::new(super::awake()).unwrap();
    let wall = Arc::new(Shape::cuboid(Vec3::new(0.005, 20.0, 20.0)).unwrap());
    add(&mut world, RigidBody::new(&wall).friction(0.0).fixed());
    let throw = Throw { place: Vec3::X * -1.0, turn: Quat::from_rotation_z(0.4), speed: 60.0 };
    let links = throw.chain(&mut world);
    for _ in 0..60 {
        world.step(DT).unwrap();
    }
    let mean = links.iter().map(|&link| center(&world, link)).sum::<Vec3>() / links.len() as f32;
    // From 0.35 m, in a second; the blow turns some of the speed upwards or downwards.
    assert!(mean.y < -2.0 && mean.x < 0.0, "{mean}");
}
