//! Measuring a world: energy, momentum, stretch, penetration, and a hash of its state.

use glam::DVec3;

use crate::body::{Body, Substance, Truss};
use crate::collision::{Aabb, Candidate, find_pairs};
use crate::geometry::distance;
use crate::geometry::epa::Epa;
use crate::geometry::support::Points;
use crate::settings::BroadPhase;
use crate::world::World;

/// How far off the sticks of a world are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Strain {
    /// Largest |length/rest length − 1|.
    pub max: f32,
    /// Mean |length/rest length − 1|.
    pub mean: f32,
}

/// How deep bodies are in each other: rigid bodies in rigid bodies, particles in half-spaces.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Penetration {
    /// Deepest, in m.
    pub max: f32,
    /// Mean over the penetrating pairs, in m; a body and a half-space count once, with the deepest particle.
    pub mean: f32,
    /// How many pairs penetrate.
    pub count: usize,
}

impl World {
    /// Σ ½ m v² over all particles that can move, in J, with the mean velocities of the last substep.
    pub fn kinetic_energy(&self) -> f64 {
        let store = &self.particles;
        self.bodies.iter().map(|b| store.kinetic_energy(b.particles.clone(), b.displacement_time())).sum()
    }

    /// −Σ m g·x over all particles that can move, in J: 0 at the origin.
    pub fn potential_energy(&self) -> f64 {
        let gravity = self.settings.gravity.as_dvec3();
        self.sum(|i, _| {
            -f64::from(self.particles.mass[i]) * gravity.dot(self.particles.position[i].as_dvec3())
        })
    }

    /// Σ m v over all particles that can move, in kg·m/s.
    pub fn momentum(&self) -> DVec3 {
        self.sum(|i, h| self.particles.displacement[i].as_dvec3() * f64::from(self.particles.mass[i]) / h)
    }

    /// Σ x × m v about the origin over all particles that can move, in kg·m²/s.
    pub fn angular_momentum(&self) -> DVec3 {
        self.sum(|i, h| {
            // In the middle of the last substep, where d/h is the velocity, x was x − d/2; but d × d = 0.
            let (position, motion) = (self.particles.position[i], self.particles.displacement[i]);
            position.as_dvec3().cross(motion.as_dvec3()) * f64::from(self.particles.mass[i]) / h
        })
    }

    fn sum<T: std::iter::Sum>(&self, of: impl Fn(usize, f64) -> T) -> T {
        let movable = |i: &usize| self.particles.inverse_mass[*i] > 0.0;
        let bodies = self.bodies.iter();
        bodies
            .flat_map(|body| body.particles.clone().map(move |i| (i, body.displacement_time())))
            .filter(|(i, _)| movable(i))
            .map(|(i, h)| of(i, f64::from(h)))
            .sum()
    }

    /// How far off the sticks are.
    pub fn strain(&self) -> Strain {
        let (mut max, mut sum, mut count) = (0.0f32, 0.0f64, 0usize);
        for handle in self.bodies() {
            let Ok(body) = self.body(handle) else { continue };
            let positions = body.positions();
            for stick in body.sticks() {
                let length = positions[stick.a as usize].distance(positions[stick.b as usize]);
                let strain = (length / stick.rest_length - 1.0).abs();
                max = max.max(strain);
                sum += f64::from(strain);
                count += 1;
            }
        }
        Strain { max, mean: if count > 0 { (sum / count as f64) as f32 } else { 0.0 } }
    }

    /// How deep bodies are in each other now, measured on every pair of rigid bodies whose boxes overlap.
    pub fn penetration(&self) -> Penetration {
        let mut depths = Vec::new();
        self.rigid_depths(&mut depths);
        self.wall_depths(&mut depths);
        depths.retain(|&depth| depth > 0.0);
        let mean = depths.iter().fold(0.0, |sum, depth| sum + depth) / depths.len().max(1) as f32;
        Penetration { max: depths.iter().copied().fold(0.0, f32::max), mean, count: depths.len() }
    }

    fn rigid_depths(&self, depths: &mut Vec<f32>) {
        let trusses: Vec<(&Body, &Truss)> = self
            .bodies
            .iter()
            .filter_map(|body| match &body.substance {
                Substance::Truss { truss } => Some((body, &**truss)),
                Substance::Rigid(_) | Substance::Deformable(_) | Substance::HalfSpace(_) => None,
            })
            .collect();
        let hull = |(body, truss): (&Body, &Truss)| {
            let start = body.particles.start;
            &self.particles.position[start..start + truss.surface().vertex_count()]
        };
        let candidate = |(index, &truss): (usize, &(&Body, &Truss))| Candidate {
            body: index as u32,
            bounds: Aabb::around(hull(truss), 0.0),
            awake: !truss.0.fixed,
        };
        let mut candidates: Vec<Candidate> = trusses.iter().enumerate().map(candidate).collect();
        let (mut pairs, mut epa) = (Vec::new(), Epa::default());
        find_pairs(&mut candidates, BroadPhase::SortAndSweep, &mut pairs);
        for (a, b) in pairs {
            let [a, b] = [a, b].map(|index| Points(hull(trusses[index as usize])));
            let mut unknown_axis = glam::Vec3::ZERO;
            let found = distance::contact(&a, &b, &mut unknown_axis, &mut epa);
            depths.extend(found.features.map(|features| features.depth));
        }
    }

    fn wall_depths(&self, depths: &mut Vec<f32>) {
        for wall in &self.bodies {
            let Substance::HalfSpace(wall) = &wall.substance else { continue };
            for body in self.bodies.iter().filter(|body| !body.fixed) {
                let positions = &self.particles.position[body.particles.clone()];
                depths.extend(positions.iter().map(|&x| wall.offset - wall.normal.dot(x)).reduce(f32::max));
            }
        }
    }

    /// A hash of everything that moves: positions, displacements, masses and sleep, bit for bit. Equal states
    /// have equal hashes, on every platform.
    pub fn state_hash(&self) -> u64 {
        let store = &self.particles;
        let mut hash = Fnv::default();
        let vectors = store.position.iter().chain(&store.displacement);
        vectors.flat_map(|vector| vector.to_array()).for_each(|number| hash.write(number.to_bits()));
        store.inverse_mass.iter().for_each(|number| hash.write(number.to_bits()));
        self.bodies.iter().for_each(|body| hash.write(u32::from(body.rest.asleep)));
        hash.0
    }
}

/// The 64-bit FNV-1a hash.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn write(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}
