//! Random calls of a world.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use tautline::{
    Anchor, Attachment, BallJoint, BodyHandle, Cloth, DistanceJoint, Error, FixedJoint, Grip, HalfSpace,
    HingeJoint, Motion, Quat, QueryFilter, RigidBody, Rope, Settings, Shape, SliderJoint, SoftSolid, Vec3,
    World,
};

/// Most bodies and steps of one input, and the substeps of a step: few, since runs are to be many.
const MOST_BODIES: usize = 6;
const MOST_STEPS: u32 = 8;
const SUBSTEPS: u32 = 2;
/// Most shapes that are kept for inputs to come.
const MOST_SHAPES: usize = 2_000;

/// Calls of every kind with numbers of every kind. What is refused leaves no trace, and nothing ever panics or is not finite.
pub(crate) fn run(bytes: &[u8]) {
    let mut calls = Calls {
        bytes,
        world: World::new(Settings { substeps: SUBSTEPS, ..Settings::default() }).expect("sound settings"),
        bodies: Vec::new(),
        steps: 0,
    };
    // Of the world as it is, if that is known: a snapshot takes as long as a small step.
    let mut snapshot = None;
    while !calls.bytes.is_empty() {
        let before = snapshot.take().unwrap_or_else(|| calls.world.snapshot());
        if calls.next().is_err() {
            assert!(calls.world.snapshot() == before, "refused, but not without a trace");
            snapshot = Some(before);
        }
    }
    let world = &calls.world;
    assert!(world.positions().iter().all(|position| position.is_finite()));
    let restored = World::restore(&world.snapshot()).expect("a snapshot is whole");
    assert_eq!(restored.state_hash(), world.state_hash());
}

/// A shape of one of four kinds. Those already built are kept, since that takes longer than a step.
fn shape(kind: u8, size: f32, length: f32) -> Result<Arc<Shape>, Error> {
    thread_local! {
        static BUILT: RefCell<BTreeMap<(u8, u32, u32), Arc<Shape>>> = const { RefCell::new(BTreeMap::new()) };
    }
    let key = (kind, size.to_bits(), length.to_bits());
    if let Some(shape) = BUILT.with_borrow(|built| built.get(&key).cloned()) {
        return Ok(shape);
    }
    let shape = Arc::new(match kind {
        0 => Shape::sphere(size)?,
        1 => Shape::capsule(size, length)?,
        2 => Shape::cylinder(size, length)?,
        _ => Shape::cuboid(Vec3::new(size, length, 0.3))?,
    });
    BUILT.with_borrow_mut(|built| {
        if built.len() == MOST_SHAPES {
            built.clear();
        }
        built.insert(key, Arc::clone(&shape));
    });
    Ok(shape)
}

struct Calls<'a> {
    bytes: &'a [u8],
    world: World,
    /// Also of those removed.
    bodies: Vec<BodyHandle>,
    steps: u32,
}

impl Calls<'_> {
    fn byte(&mut self) -> u8 {
        let (&first, rest) = self.bytes.split_first().unwrap_or((&0, &[]));
        self.bytes = rest;
        first
    }

    /// Mostly something usual, now and then something strange.
    fn number(&mut self) -> f32 {
        let byte = self.byte();
        match byte {
            0..=199 => (f32::from(byte) - 100.0) * 0.02,
            200..=239 => (f32::from(byte) - 220.0) * 5.0,
            240 => f32::NAN,
            241 => f32::INFINITY,
            242 => f32::NEG_INFINITY,
            243 => f32::MAX,
            244 => f32::MIN_POSITIVE,
            245 => -0.0,
            246 => 1e9,
            247 => -1e9,
            248 => 1e-6,
            249 => 1e4,
            250 => 1e-3,
            _ => 1.0,
        }
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    fn rotation(&mut self) -> Quat {
        Quat::from_xyzw(self.number(), self.number(), self.number(), 1.0)
    }

    fn body(&mut self) -> Option<BodyHandle> {
        let index = usize::from(self.byte());
        self.bodies.get(index % self.bodies.len().max(1)).copied()
    }

    fn next(&mut self) -> Result<(), Error> {
        match self.byte() % 24 {
            0..=4 => self.add(),
            5..=8 => self.step(),
            9 => self.join(),
            10 => self.attach(),
            11 => self.ask(),
            12 => {
                self.world = World::restore(&self.world.snapshot())?;
                Ok(())
            }
            13 => {
                let force = self.vector();
                self.world.set_wind(force)
            }
            _ => self.change(),
        }
    }

    fn add(&mut self) -> Result<(), Error> {
        if self.world.bodies().len() >= MOST_BODIES {
            return Ok(());
        }
        let (kind, position, size) = (self.byte() % 8, self.vector(), self.number());
        let added = match kind {
            0 => {
                let mass = self.number();
                self.world.add(Cloth::grid(4, 4, size, size).position(position).mass(mass))
            }
            1 => {
                let end = self.vector();
                self.world.add(Rope::straight(position, end, 4).radius(size))
            }
            2 => self.world.add(SoftSolid::cuboid(Vec3::splat(size), [1, 1, 1]).position(position)),
            3 => self.world.add(HalfSpace::new(position, size)),
            _ => self.add_rigid(position, size),
        };
        self.bodies.extend(added.as_ref().ok());
        added.map(|_| ())
    }

    fn add_rigid(&mut self, position: Vec3, size: f32) -> Result<BodyHandle, Error> {
        let kind = self.byte() % 4;
        let length = if kind == 0 { 0.0 } else { self.number() };
        let shape = shape(kind, size, length)?;
        let body = RigidBody::new(&shape).position(position).rotation(self.rotation());
        let body = body.velocity(self.vector()).angular_velocity(self.vector()).mass(self.number());
        let is_fixed = self.byte().is_multiple_of(8);
        self.world.add(if is_fixed { body.fixed() } else { body })
    }

    fn step(&mut self) -> Result<(), Error> {
        if self.steps == MOST_STEPS {
            return Ok(());
        }
        self.steps += 1;
        let dt = if self.byte().is_multiple_of(8) { self.number() } else { 1.0 / 60.0 };
        self.world.step(dt).map(|_| ())
    }

    fn join(&mut self) -> Result<(), Error> {
        let (Some(body), base) = (self.body(), self.body()) else { return Ok(()) };
        let base = if self.byte().is_multiple_of(2) { base } else { None };
        let (anchor, kind) = (self.vector(), self.byte() % 5);
        let (number, axis) = (self.number(), self.vector());
        match kind {
            0 => self.world.add_joint(BallJoint::new(body, base).anchor(anchor).cone(number)),
            1 => self.world.add_joint(HingeJoint::new(body, base).anchor(anchor).axis(axis)),
            2 => self.world.add_joint(SliderJoint::new(body, base).anchor(anchor).axis(axis)),
            3 => self.world.add_joint(FixedJoint::new(body, base).anchor(anchor).compliance(number)),
            _ => self.world.add_joint(DistanceJoint::new(body, base).anchor(anchor).length(number)),
        }
        .map(|_| ())
    }

    fn attach(&mut self) -> Result<(), Error> {
        let (Some(a), Some(b)) = (self.body(), self.body()) else { return Ok(()) };
        let (particle, point) = (u32::from(self.byte()) % 20, self.vector());
        let other = match self.byte() % 3 {
            0 => Anchor::world(point),
            1 => Anchor::point(b, point),
            _ => Anchor::particle(b, particle / 2),
        };
        let strength = Attachment::default().compliance(self.number()).break_force(self.number());
        self.world.attach(Anchor::particle(a, particle), other, strength).map(|_| ())
    }

    fn ask(&mut self) -> Result<(), Error> {
        let (from, to, max) = (self.vector(), self.vector(), self.number());
        let filter = QueryFilter::default();
        match self.byte() % 3 {
            0 => self.world.ray_cast(from, to, max, filter).map(|_| ()),
            1 => self.world.closest_point(from, max, filter).map(|_| ()),
            _ => {
                let shape = Shape::sphere(max)?;
                self.world.shape_cast(&shape, from, Quat::IDENTITY, to, filter).map(|_| ())
            }
        }
    }

    fn change(&mut self) -> Result<(), Error> {
        let Some(body) = self.body() else { return Ok(()) };
        let (vector, particle) = (self.vector(), u32::from(self.byte()) % 20);
        let (world, what) = (&mut self.world, particle % 13);
        match what {
            0 => world.remove(body),
            1 => world.apply_force(body, vector),
            2 => world.apply_impulse(body, vector),
            3 => world.apply_torque(body, vector),
            4 => world.set_velocity(body, vector),
            5 => world.set_angular_velocity(body, vector),
            6 => world.set_pose(body, vector, Quat::from_xyzw(vector.x, 0.3, vector.z, 0.8)),
            7 => world.pin(body, particle),
            8 => world.set_particle_position(body, particle, vector),
            9 => world.set_particle_mass(body, particle, vector.x),
            10 => world.set_motion(body, if vector.x > 0.0 { Motion::Kinematic } else { Motion::Dynamic }),
            11 => world.set_rope_length(body, vector.x),
            _ => world.grab(body, vector, Grip::default()).map(|_| ()),
        }
    }
}
