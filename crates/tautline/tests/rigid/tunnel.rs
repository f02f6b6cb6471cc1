//! Nothing goes through anything, however fast it is, thin it is, or spins.

use std::sync::Arc;

use glam::DQuat;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use tautline::mesh::TriMesh;
use tautline::{BodyHandle, DVec3, Quat, RigidBody, Settings, Shape, Vec3, World};

use super::{DT, add, awake, center, weightless};

/// Half of the width and the height of a wall, in m.
const HALF: f32 = 1.5;
/// At so many places a way is looked at.
const WAY_POINTS: u32 = 64;

#[derive(Debug, Clone, Copy)]
enum Wall {
    /// Of this thickness (m), fixed or of this mass (kg).
    Board(f32, Option<f32>),
    /// Triangles of this size (m).
    Mesh(f32),
    HeightField(f32),
}

fn wall(kind: Wall) -> RigidBody {
    // Its front is at x < 0, for heights too.
    let count = |size: f32| (2.0 * HALF / size) as u32 + 1;
    match kind {
        Wall::Board(thickness, mass) => {
            let board = Arc::new(Shape::cuboid(Vec3::new(thickness / 2.0, HALF, HALF)).unwrap());
            match mass {
                Some(mass) => RigidBody::new(&board).mass(mass),
                None => RigidBody::new(&board).fixed(),
            }
        }
        Wall::Mesh(size) => {
            let n = count(size);
            let at = |i: u32| (i as f32 / (n - 1) as f32 * 2.0 - 1.0) * HALF;
            let positions = (0..n * n).map(|i| Vec3::new(0.0, at(i / n), at(i % n))).collect();
            let cell = |i: u32| {
                let [a, b, c, d] = [i, i + 1, i + n + 1, i + n];
                [[a, b, c], [a, c, d]]
            };
            let corners = (0..n * (n - 1)).filter(|i| i % n + 1 < n);
            let triangles = corners.flat_map(cell).collect();
            RigidBody::new(&Arc::new(Shape::triangle_mesh(&TriMesh { positions, triangles }).unwrap()))
                .fixed()
        }
        Wall::HeightField(size) => {
            let n = count(size);
            let flat = vec![0.0; (n * n) as usize];
            let field = Shape::height_field(n, n, size, &flat).unwrap();
            RigidBody::new(&Arc::new(field))
                .rotation(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2))
                .fixed()
        }
    }
}

/// What is shot; all in m.
#[derive(Debug, Clone)]
enum Bullet {
    Ball(f32),
    Rod(f32, f32),
    Disc(f32, f32),
    Plate(Vec3),
    Hull(Vec<Vec3>),
}

impl Bullet {
    fn shape(&self) -> Arc<Shape> {
        let shape = match self {
            Self::Ball(radius) => Shape::sphere(*radius),
            Self::Rod(radius, half) => Shape::capsule(*radius, *half),
            Self::Disc(radius, half) => Shape::cylinder(*radius, *half),
            Self::Plate(half) => Shape::cuboid(*half),
            Self::Hull(points) => Shape::convex_hull(points),
        };
        Arc::new(shape.unwrap())
    }
}

/// Balls, rods, discs, plates and hulls, down to a millimetre.
fn bullets() -> impl Strategy<Value = Bullet> {
    let small = || prop_oneof![Just(0.0005_f32), 0.002_f32..0.02, 0.02_f32..0.1];
    let long = || 0.005_f32..0.3;
    let points = prop::collection::vec(prop::array::uniform3(-0.1_f32..0.1).prop_map(Vec3::from), 8..20);
    prop_oneof![
        small().prop_map(Bullet::Ball),
        (small(), long()).prop_map(|(radius, half)| Bullet::Rod(radius, half)),
        (long(), small()).prop_map(|(radius, half)| Bullet::Disc(radius, half)),
        (small(), long(), long()).prop_map(|(x, y, z)| Bullet::Plate(Vec3::new(x, y, z))),
        points.prop_map(Bullet::Hull),
    ]
}

fn walls() -> impl Strategy<Value = Wall> {
    let mass = prop_oneof![Just(None), (0.3_f32..30.0).prop_map(Some)];
    prop_oneof![
        2 => (prop_oneof![Just(0.001_f32), 0.002_f32..0.02], mass).prop_map(|(t, mass)| Wall::Board(t, mass)),
        1 => prop_oneof![Just(0.3_f32), Just(3.0)].prop_map(Wall::Mesh),
        1 => prop_oneof![Just(0.3_f32), Just(1.0)].prop_map(Wall::HeightField),
    ]
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-size..size).prop_map(Vec3::from)
}

/// Where a body's centre is in the frame of another.
fn place_in(world: &World, body: BodyHandle, frame: BodyHandle) -> Vec3 {
    let (position, rotation) = world.body(frame).unwrap().pose().unwrap();
    rotation.inverse() * (world.body(body).unwrap().center_of_mass() - position)
}

/// Where a bullet's centre and a wall are, in f64.
#[derive(Debug, Clone, Copy)]
struct Scene {
    bullet: DVec3,
    wall: DVec3,
    rotation: DQuat,
}

impl Scene {
    fn of(world: &World, bullet: BodyHandle, wall: BodyHandle) -> Self {
        let (position, rotation) = world.body(wall).unwrap().pose().unwrap();
        let bullet = world.body(bullet).unwrap().center_of_mass().as_dvec3();
        Self { bullet, wall: position.as_dvec3(), rotation: rotation.as_dquat().normalize() }
    }

    /// On a straight way with a steady rotation to another.
    fn toward(&self, end: &Self, time: f64) -> Self {
        Self {
            bullet: self.bullet.lerp(end.bullet, time),
            wall: self.wall.lerp(end.wall, time),
            rotation: self.rotation.slerp(end.rotation, time),
        }
    }

    /// The bullet's centre in a frame in which the wall's front is at x < 0.
    fn seen_from(&self, kind: Wall) -> DVec3 {
        let p = self.rotation.inverse() * (self.bullet - self.wall);
        if let Wall::HeightField(_) = kind { DVec3::new(-p.y, p.x, p.z) } else { p }
    }
}

/// Whether the bullet's centre goes through the middle of the wall, within its outline, on its way between two steps
/// of one substep, in which bodies move straight and turn steadily.
fn goes_through(before: &Scene, now: &Scene, kind: Wall) -> bool {
    let way = (0..=WAY_POINTS).map(|i| before.toward(now, f64::from(i) / f64::from(WAY_POINTS)));
    let way: Vec<DVec3> = way.map(|scene| scene.seen_from(kind)).collect();
    way.windows(2).any(|ends| crosses(ends[0], ends[1]))
}

/// Whether the straight way from a place to another, both in the wall's frame, goes to its back within its outline.
fn crosses(from: DVec3, to: DVec3) -> bool {
    from.x < 0.0 && to.x >= 0.0 && is_within(from.lerp(to, from.x / (from.x - to.x)))
}

/// Whether a place in the wall's frame is in front of it or behind it, not beside it.
fn is_within(place: DVec3) -> bool {
    place.y.abs().max(place.z.abs()) < f64::from(HALF) - 1e-3
}

/// A bullet in front of a wall.
#[derive(Debug, Clone)]
struct Shot {
    bullet: Bullet,
    wall: Wall,
    speed: f32,
    turn: Vec3,
    spin: Vec3,
    aim: Vec3,
    slant: Vec3,
    phase: f32,
}

fn shots() -> impl Strategy<Value = Shot> {
    let speed = prop_oneof![5.0_f32..50.0, 50.0_f32..1000.0];
    let spin = prop_oneof![Just(Vec3::ZERO), vector(30.0), vector(300.0)];
    let all = (bullets(), walls(), speed, vector(3.0), spin, vector(1.0), vector(4.0), 0.0_f32..1.0);
    all.prop_map(|(bullet, wall, speed, turn, spin, aim, slant, phase)| Shot {
        bullet,
        wall,
        speed,
        turn,
        spin,
        aim,
        slant,
        phase,
    })
}

impl Shot {
    /// The world, the bullet and the wall.
    fn world(&self, settings: Settings) -> (World, BodyHandle, BodyHandle) {
        let mut world = World::new(settings).unwrap();
        let wall = add(&mut world, wall(self.wall));
        let way = (Vec3::X + self.slant.with_x(0.0)).normalize() * self.speed;
        let start = self.aim.with_x(0.0) - way * (0.4 / way.x + self.phase * DT);
        let bullet = RigidBody::new(&self.bullet.shape()).mass(0.1).position(start).velocity(way);
        let bullet = bullet.rotation(Quat::from_scaled_axis(self.turn)).angular_velocity(self.spin);
        let bullet = add(&mut world, bullet);
        (world, bullet, wall)
    }
}

/// Where a shot's way leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Stopped,
    /// Past the outline of the wall to its other side, as what strikes its edge may.
    Round,
    Through,
}

/// The way of a shot in steps of one substep: as many as in whole steps, and each can be looked at.
fn way(shot: &Shot) -> Way {
    let (mut world, bullet, wall) = shot.world(Settings { substeps: 1, ..weightless() });
    let mut before = Scene::of(&world, bullet, wall);
    for _ in 0..160 {
        let report = world.step(DT / 8.0).unwrap();
        assert!(report.faults.is_empty(), "{:?}", report.faults);
        let now = Scene::of(&world, bullet, wall);
        if goes_through(&before, &now, shot.wall) {
            return Way::Through;
        }
        before = now;
    }
    if before.seen_from(shot.wall).x < 0.0 { Way::Stopped } else { Way::Round }
}

/// Whether one step of the usual substeps takes a shot from before the wall to behind its middle. Who strikes the edge
/// in that step and goes round it ends behind the wall too: the way between has to lead through the wall.
fn leaps(shot: &Shot) -> bool {
    let (mut world, bullet, wall) = shot.world(weightless());
    let mut before = Scene::of(&world, bullet, wall).seen_from(shot.wall);
    (0..20).any(|_| {
        assert!(world.step(DT).unwrap().faults.is_empty());
        let now = Scene::of(&world, bullet, wall).seen_from(shot.wall);
        crosses(std::mem::replace(&mut before, now), now) && is_within(now)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn nothing_goes_through_a_wall(shot in shots()) {
        let way = way(&shot);
        prop_assert!(way != Way::Through && (way == Way::Round || !leaps(&shot)));
    }
}

/// It strikes a triangle, rolls on by 58 rad in a substep, and foresees that it will touch the next one.
#[test]
fn a_rolling_ball_foresees_the_ground_under_it() {
    let shot = Shot {
        bullet: Bullet::Ball(0.0005),
        wall: Wall::HeightField(0.3),
        speed: 27.192_589,
        turn: Vec3::new(1.199_185_5, 0.560_150_15, -1.655_243_9),
        spin: Vec3::ZERO,
        aim: Vec3::new(0.960_910_7, -0.086_278_096, 0.743_944_35),
        slant: Vec3::new(0.702_755_4, -0.604_843_26, 0.853_467_3),
        phase: 0.219_600_53,
    };
    assert_eq!(way(&shot), Way::Stopped);
}

/// It strikes the field's edge, is bent forward half a millimetre outside of the outline, and is behind the wall's middle
/// at the end of the same step.
#[test]
fn a_spinning_wire_goes_round_the_edge_of_a_height_field() {
    let shot = Shot {
        bullet: Bullet::Rod(0.0005, 0.292_222_95),
        wall: Wall::HeightField(0.3),
        speed: 275.2697,
        turn: Vec3::new(-0.605_846, 1.203_475, 1.336_141),
        spin: Vec3::new(46.820_892, 224.0893, -217.230_06),
        aim: Vec3::new(0.0, -0.790_871_86, 0.925_901),
        slant: Vec3::new(0.0, 3.229_005_8, 0.0),
        phase: 0.773_532_75,
    };
    assert_ne!(way(&shot), Way::Through);
    assert!(!leaps(&shot));
}

#[test]
fn two_bullets_meet_head_on() {
    let shapes =
        [Bullet::Ball(0.005), Bullet::Plate(Vec3::new(0.0005, 0.02, 0.02)), Bullet::Rod(0.003, 0.03)];
    for (i, phase) in (0..60).map(|i| (i, i as f32 / 60.0)) {
        for speed in [30.0, 300.0, 1000.0] {
            let mut world = World::new(weightless()).unwrap();
            let shape = |k: usize| shapes[k % shapes.len()].shape();
            let start = 0.3 + phase * speed * DT;
            let bullet = |k: usize, sign: f32| {
                let turn = Quat::from_rotation_z(0.02 * sign);
                RigidBody::new(&shape(k)).mass(0.01).position(Vec3::X * start * sign).rotation(turn)
            };
            let first = add(&mut world, bullet(i, -1.0).velocity(Vec3::X * speed));
            let second = add(&mut world, bullet(i / 3, 1.0).velocity(Vec3::X * -speed));
            let between = |world: &World| center(world, second) - center(world, first);
            let mut before = between(&world);
            for _ in 0..20 {
                assert!(world.step(DT).unwrap().faults.is_empty());
                let momentum = [first, second].map(|body| world.body(body).unwrap().velocity());
                assert!((momentum[0] + momentum[1]).length() < 1e-3 * speed, "{momentum:?}");
                // They may slide off each other and pass, but not through each other.
                let now = between(&world);
                let crossing = before + (now - before) * (before.x / (before.x - now.x));
                assert!(before.x * now.x > 0.0 || crossing.length() > 0.003, "{i} at {speed} m/s");
                before = now;
            }
        }
    }
}

#[test]
fn what_passes_a_corner_by_a_millimetre_flies_on() {
    for (i, phase) in (0..40).map(|i| (i, i as f32 / 40.0)) {
        for spin in [0.0, 50.0] {
            for bullet in [Bullet::Ball(0.01), Bullet::Disc(0.01, 0.01), Bullet::Plate(Vec3::splat(0.01))] {
                let mut world = World::new(weightless()).unwrap();
                let block = Arc::new(Shape::cuboid(Vec3::splat(0.5)).unwrap());
                add(&mut world, RigidBody::new(&block).position(Vec3::new(0.0, -0.5, 0.0)).fixed());
                let shape = bullet.shape();
                let start = Vec3::new(-0.8 - phase * 100.0 * DT, shape.reach() + 1e-3, 0.02 * (i % 5) as f32);
                let body = RigidBody::new(&shape).mass(0.1).position(start).velocity(Vec3::X * 100.0);
                let body = add(&mut world, body.angular_velocity(Vec3::Z * spin));
                for _ in 0..6 {
                    world.step(DT).unwrap();
                }
                let (x, v) = (center(&world, body), world.body(body).unwrap().velocity());
                assert!(v.distance(Vec3::X * 100.0) < 1e-3, "{bullet:?} {phase}: {v}");
                assert!(x.distance(start + Vec3::X * 10.0) < 1e-3, "{bullet:?} {phase}: {x}");
            }
        }
    }
}

#[test]
fn what_slides_fast_over_a_mesh_does_not_stumble() {
    for speed in [10.0, 100.0, 300.0] {
        let mut world = World::new(awake()).unwrap();
        let (n, m) = (400, 4);
        let positions =
            (0..n * m).map(|i| Vec3::new((i / m) as f32 * 0.7, 0.0, (i % m) as f32 - 1.5)).collect();
        let cell = |i: u32| [[i, i + 1, i + m + 1], [i, i + m + 1, i + m]];
        let corners = (0..m * (n - 1)).filter(|i| i % m + 1 < m);
        let mesh = TriMesh { positions, triangles: corners.flat_map(cell).collect() };
        let ground = Arc::new(Shape::triangle_mesh(&mesh).unwrap());
        add(&mut world, RigidBody::new(&ground).friction(0.0).fixed());
        let sledge = RigidBody::new(&Bullet::Plate(Vec3::new(0.2, 0.05, 0.1)).shape()).friction(0.0);
        let sledge = sledge.position(Vec3::new(5.0, 0.05, 0.03)).velocity(Vec3::X * speed);
        let sledge = add(&mut world, sledge);
        let steps = (200.0 / speed / DT) as usize;
        for _ in 0..steps {
            world.step(DT).unwrap();
        }
        let (x, v) = (center(&world, sledge), world.body(sledge).unwrap().velocity());
        assert!(v.distance(Vec3::X * speed) < 1e-3 * speed, "{speed}: {v}");
        assert!((x - Vec3::new(5.0 + steps as f32 * DT * speed, 0.05, 0.03)).length() < 0.01, "{speed}: {x}");
    }
}

#[test]
fn a_sweeping_plate_takes_along_what_it_meets() {
    for speed in [20.0, 100.0, 400.0] {
        for (i, phase) in (0..20).map(|i| (i, i as f32 / 20.0)) {
            let mut world = World::new(weightless()).unwrap();
            let ball = RigidBody::new(&Bullet::Ball(0.01 + 0.002 * (i % 3) as f32).shape()).mass(0.1);
            let ball = add(&mut world, ball.position(Vec3::X * (0.1 + phase * speed * DT)));
            let plate = RigidBody::new(&Bullet::Plate(Vec3::new(0.0005, 1.0, 1.0)).shape()).kinematic();
            let plate = add(&mut world, plate.velocity(Vec3::X * speed));
            for _ in 0..20 {
                world.step(DT).unwrap();
                assert!(place_in(&world, ball, plate).x > 0.0, "{speed} {phase}");
            }
        }
    }
}

#[test]
fn a_fast_ball_comes_back_as_fast_as_its_restitution_says() {
    for (speed, phase) in
        [50.0, 200.0, 900.0].into_iter().flat_map(|s| (0..20).map(move |i| (s, i as f32 / 20.0)))
    {
        let mut world = World::new(weightless()).unwrap();
        add(&mut world, wall(Wall::Board(0.001, None)).restitution(0.7));
        let start = Vec3::X * (-0.2 - phase * speed * DT);
        let ball = RigidBody::new(&Bullet::Ball(0.01).shape()).mass(0.1).position(start);
        let ball = add(&mut world, ball.velocity(Vec3::X * speed));
        for _ in 0..5 {
            world.step(DT).unwrap();
        }
        let v = world.body(ball).unwrap().velocity();
        assert!(v.distance(Vec3::X * (-0.7 * speed)) < 1e-3 * speed, "{speed} {phase}: {v}");
    }
}

#[test]
fn what_spins_when_it_strikes_gains_no_energy_to_speak_of() {
    let mut runner = TestRunner::deterministic();
    // Rods four hundred times as long as thick too.
    let extreme = Shot {
        bullet: Bullet::Rod(0.0005, 0.2058),
        wall: Wall::Board(0.00437, None),
        speed: 900.8,
        turn: Vec3::new(-0.1717, -0.82895, -2.93986),
        spin: Vec3::new(108.13, 193.05, -299.88),
        aim: Vec3::new(0.2588, 0.14615, 0.86956),
        slant: Vec3::new(0.4848, 3.882, 2.2851),
        phase: 0.24668,
    };
    let shots = (0..600).map(|_| shots().new_tree(&mut runner).unwrap().current());
    for shot in shots.chain([extreme]) {
        let (mut world, ..) = shot.world(weightless());
        let before = world.kinetic_energy();
        for _ in 0..20 {
            world.step(DT).unwrap();
        }
        assert!(world.kinetic_energy() < 1.05 * before, "{shot:?}");
    }
}
