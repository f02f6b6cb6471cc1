//! Cloth in ways of falling and folding in which it could get tangled, each from as many starts as there are seeds:
//! does it ever pass through itself, and is it free at the end? [`crate::judge`] tells.

use std::sync::Arc;

use tautline::body::Corner;
use tautline::{BodyHandle, Cloth, Error, HalfSpace, Quat, RigidBody, Settings, Shape, Vec3, World};

use crate::judge::{Sheet, Stretch, grid_edges, intersections, stretch};
use crate::random::Random;

/// What happens to the cloth: 2 m square, 1 kg, with the engine's defaults.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trial {
    /// It falls on a fixed cube of 1 m, a little askew.
    Cube,
    /// It falls on the floor upright, and folds up on itself.
    Heap,
    /// It lies on the floor, and two of its corners are carried over to the other two and let go.
    Fold,
    /// It falls on the floor on a corner or an edge, crumples, and is left there until it rests.
    Settle,
    /// Two of them fall, one upon the other, on the cube.
    Pair,
}

/// What was found in one trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Pairs of triangles that intersect at the end.
    pub at_end: usize,
    /// The most at any tenth step.
    pub worst: usize,
    /// The first step that they were counted after.
    pub worst_step: usize,
    /// Of the edges in rows and columns, at the end, of the first cloth.
    pub stretch: Stretch,
    /// Mean over the particles at the end, in m/s.
    pub mean_speed: f64,
}

const SIDE: f32 = 2.0;
const DT: f32 = 1.0 / 60.0;
/// Steps from one count to the next.
const COUNTED_EVERY: usize = 10;
/// Until corners that are carried are let go.
const CARRIED_STEPS: usize = 120;

impl Trial {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Cube, Self::Heap, Self::Fold, Self::Settle, Self::Pair];

    /// A word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::Heap => "heap",
            Self::Fold => "fold",
            Self::Settle => "settle",
            Self::Pair => "pair",
        }
    }

    /// Of 1/60 s each.
    pub fn steps(self) -> usize {
        match self {
            Self::Cube | Self::Heap => 300,
            Self::Fold | Self::Pair => 360,
            Self::Settle => 600,
        }
    }

    /// Runs it with n × n particles. The same arguments give the same result.
    ///
    /// # Errors
    /// What the engine refuses, such as settings or an `n` out of range.
    pub fn run(self, n: u32, seed: u64, settings: Settings) -> Result<Found, Error> {
        let mut scene = Scene::new(self, n, seed, settings)?;
        let (mut worst, mut worst_step, mut at_end) = (0, 0, 0);
        for step in 1..=self.steps() {
            scene.step(step)?;
            if step % COUNTED_EVERY == 0 {
                at_end = scene.intersections()?;
                if at_end > worst {
                    (worst, worst_step) = (at_end, step);
                }
            }
        }
        let edges = grid_edges(n, n, SIDE.into(), SIDE.into());
        let first = scene.world.body(scene.cloths[0])?;
        let count = first.positions().len() as u32;
        let speed = |particle: u32| first.particle_velocity(particle).as_dvec3().length();
        Ok(Found {
            at_end,
            worst,
            worst_step,
            stretch: stretch(first.positions(), &edges),
            mean_speed: (0..count).map(speed).sum::<f64>() / f64::from(count.max(1)),
        })
    }
}

struct Scene {
    world: World,
    cloths: Vec<BodyHandle>,
    /// Corners that are carried, and from where.
    carried: Vec<(u32, Vec3)>,
}

impl Scene {
    fn new(trial: Trial, n: u32, seed: u64, settings: Settings) -> Result<Self, Error> {
        let mut random = Random::new(seed);
        let mut scene = Self { world: World::new(settings)?, cloths: Vec::new(), carried: Vec::new() };
        scene.world.add(HalfSpace::floor(0.0))?;
        if matches!(trial, Trial::Cube | Trial::Pair) {
            let cube = Arc::new(Shape::cuboid(Vec3::splat(0.5))?);
            scene.world.add(RigidBody::new(&cube).position(Vec3::Y * 0.5).fixed())?;
        }
        let flat = Cloth::grid(n, n, SIDE, SIDE);
        match trial {
            Trial::Cube => scene.add_askew(flat, 1.5, &mut random)?,
            Trial::Heap => {
                let lean = Quat::from_rotation_x(random.between(1.48, 1.66));
                scene.add(flat.position(Vec3::Y * 1.1).rotation(yaw(&mut random) * lean), &mut random)?;
            }
            Trial::Fold => {
                let height = SIDE / (n.max(2) - 1) as f32;
                let flat =
                    flat.position(Vec3::Y * height).pin_corner(Corner::First).pin_corner(Corner::RowEnd);
                scene.add(flat, &mut random)?;
                let positions = scene.world.body(scene.cloths[0])?.positions();
                scene.carried = [0, n - 1].map(|corner| (corner, positions[corner as usize])).to_vec();
            }
            Trial::Settle => {
                scene.add(flat.position(Vec3::Y * 1.6).rotation(random.rotation()), &mut random)?
            }
            Trial::Pair => {
                scene.add_askew(flat.clone(), 1.3, &mut random)?;
                scene.add_askew(flat, 1.8, &mut random)?;
            }
        }
        Ok(scene)
    }

    /// Nearly level, turned by any angle, not quite in the middle.
    fn add_askew(&mut self, cloth: Cloth, height: f32, random: &mut Random) -> Result<(), Error> {
        let tilt = Quat::from_rotation_x(random.between(-0.05, 0.05));
        let rotation = yaw(random) * tilt;
        let position = random.in_cube(0.1) * Vec3::new(1.0, 0.0, 1.0) + Vec3::Y * height;
        self.add(cloth.position(position).rotation(rotation), random)
    }

    /// With noise that is too small to stretch it.
    fn add(&mut self, cloth: Cloth, random: &mut Random) -> Result<(), Error> {
        let handle = self.world.add(cloth)?;
        for particle in 0..self.world.body(handle)?.positions().len() as u32 {
            let position = self.world.body(handle)?.positions()[particle as usize];
            self.world.set_particle_position(handle, particle, position + random.in_cube(1e-4))?;
        }
        self.cloths.push(handle);
        Ok(())
    }

    fn step(&mut self, number: usize) -> Result<(), Error> {
        let angle = std::f32::consts::PI * (number as f32 / CARRIED_STEPS as f32).min(1.0);
        for &(corner, from) in &self.carried {
            // Half a circle about the cloth's middle line, a little flattened and ending a little above the floor.
            let to = Vec3::new(from.x, from.y + 0.02 + 0.9 * libm::sinf(angle), from.z * libm::cosf(angle));
            self.world.set_particle_position(self.cloths[0], corner, to)?;
            if number == CARRIED_STEPS {
                self.world.unpin(self.cloths[0], corner)?;
            }
        }
        if number == CARRIED_STEPS {
            self.carried.clear();
        }
        self.world.step(DT).map(|_| ())
    }

    fn intersections(&self) -> Result<usize, Error> {
        let mut sheets = Vec::new();
        for &cloth in &self.cloths {
            let body = self.world.body(cloth)?;
            sheets.push(Sheet { positions: body.positions(), triangles: body.triangles() });
        }
        Ok(intersections(&sheets).len())
    }
}

fn yaw(random: &mut Random) -> Quat {
    Quat::from_rotation_y(random.between(0.0, std::f32::consts::TAU))
}
