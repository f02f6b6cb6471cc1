//! Measuring a world: energy, momentum, stretch, penetration, and a hash of its state.

use glam::{DVec3, Vec3};

use crate::body::{Body, CollisionGroups, Frame, Motion, Substance};
use crate::collision::Aabb;
use crate::collision::bvh::{PairSearch, overlapping_pairs};
use crate::geometry::query::separation;
use crate::norm::Norm;
use crate::query::{Piece, solid_piece_count};
use crate::shape::Convex;
use crate::world::World;

/// How far off the sticks of a world are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Strain {
    /// Largest |length/rest length − 1|.
    pub max: f32,
    /// Mean |length/rest length − 1|.
    pub mean: f32,
}

/// How deep bodies are in each other: solids in solids, solids and particles in half-spaces. Pairs that cannot collide,
/// by their groups, since a joint connects them or because neither is moved by contacts, do not count.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Penetration {
    /// Deepest, in m.
    pub max: f32,
    /// Mean over the penetrating pairs, in m; each pair counts once, with its deepest place.
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

    /// −Σ m g·x over all particles that can move, in J: 0 at the origin. The g of a rigid body is scaled by its
    /// gravity scale.
    pub fn potential_energy(&self) -> f64 {
        let store = &self.particles;
        let energy = |body: &Body| -> f64 {
            let scale = body.rigid().map_or(1.0, |rigid| f64::from(rigid.traits.gravity_scale));
            let gravity = self.settings.gravity.as_dvec3() * scale;
            let movable = body.particles.clone().filter(|&i| store.inverse_mass[i] > 0.0);
            movable.map(|i| -f64::from(store.mass[i]) * gravity.dot(store.position[i].as_dvec3())).sum()
        };
        self.bodies.iter().map(energy).sum()
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
                let length = positions[stick.a as usize].distance_to(positions[stick.b as usize]);
                let strain = (length / stick.rest_length - 1.0).abs();
                max = max.max(strain);
                sum += f64::from(strain);
                count += 1;
            }
        }
        Strain { max, mean: if count > 0 { (sum / count as f64) as f32 } else { 0.0 } }
    }

    /// How deep bodies are in each other now, measured on every pair of solids whose boxes overlap.
    pub fn penetration(&self) -> Penetration {
        let mut depths = Vec::new();
        self.solid_depths(&mut depths);
        self.wall_depths(&mut depths);
        depths.retain(|&depth| depth > 0.0);
        let mean = depths.iter().fold(0.0, |sum, depth| sum + depth) / depths.len().max(1) as f32;
        Penetration { max: depths.iter().copied().fold(0.0, f32::max), mean, count: depths.len() }
    }

    fn solid_depths(&self, depths: &mut Vec<f32>) {
        let bodies = self.bodies.iter().enumerate().filter(|(_, body)| solid_piece_count(body) > 0);
        let (indices, bodies): (Vec<u32>, Vec<&Body>) = bodies.map(|(i, body)| (i as u32, body)).unzip();
        let positions = &self.particles.position;
        let solids: Vec<Solid<'_>> = bodies.into_iter().map(|body| Solid::of(body, positions)).collect();
        let boxes: Vec<Aabb> = solids.iter().map(|solid| solid.bounds).collect();
        let movable: Vec<bool> = solids.iter().map(|solid| is_dynamic(solid.body)).collect();
        let (mut search, mut pairs) = (PairSearch::default(), Vec::new());
        let connected = self.joints.separated();
        let collide = |a: u32, b: u32| {
            // Indices grow with the solids.
            let pair = [a.min(b), a.max(b)].map(|solid| indices[solid as usize]);
            groups(solids[a as usize].body).collide_with(groups(solids[b as usize].body))
                && connected.binary_search(&pair).is_err()
        };
        overlapping_pairs(&boxes, &movable, collide, self.settings.instructions, &mut search, &mut pairs);
        depths.extend(pairs.iter().map(|&(a, b)| solids[a as usize].depth_in(&solids[b as usize])));
    }

    fn wall_depths(&self, depths: &mut Vec<f32>) {
        for wall in &self.bodies {
            let Substance::HalfSpace(wall) = &wall.substance else { continue };
            let collides =
                |body: &&Body| is_dynamic(body) && groups(body).collide_with(CollisionGroups::default());
            for body in self.bodies.iter().filter(collides) {
                let lowest = self.heights(body, wall.normal).reduce(f32::min);
                depths.extend(lowest.map(|lowest| wall.offset - lowest));
            }
        }
    }

    /// How high the corners and particles of a body are along a unit normal, in m; of round parts their lowest place.
    fn heights<'a>(&'a self, body: &'a Body, normal: Vec3) -> impl Iterator<Item = f32> + 'a {
        let positions = &self.particles.position[body.particles.clone()];
        let rigid = body.rigid().map(|rigid| (rigid, Frame::of_particles(positions)));
        let corners = rigid.into_iter().flat_map(move |(rigid, frame)| {
            let (along, height) = (frame.axes.transpose() * normal, normal.dot(frame.center));
            let parts = rigid.shape.parts().iter().map(|part| &part.convex);
            let lowest = move |part: &'a Convex| {
                part.vertices.iter().map(move |corner| height + along.dot(*corner) - part.radius)
            };
            parts.flat_map(lowest)
        });
        let particles = if body.is_rigid() { &[] } else { positions };
        corners.chain(particles.iter().map(move |x| normal.dot(*x)))
    }

    /// A hash of everything that moves: positions, displacements, masses and sleep, and how those spin that fly
    /// by themselves, bit for bit. Equal states have equal hashes, on every platform.
    pub fn state_hash(&self) -> u64 {
        let store = &self.particles;
        let mut hash = Fnv::default();
        let vectors = store.position.iter().chain(&store.displacement);
        vectors.flat_map(|vector| vector.to_array()).for_each(|number| hash.write(number.to_bits()));
        store.inverse_mass.iter().for_each(|number| hash.write(number.to_bits()));
        self.bodies.iter().for_each(|body| hash.write(u32::from(body.rest.asleep)));
        let words = |number: f64| [number.to_bits() as u32, (number.to_bits() >> 32) as u32];
        self.rigid.exact_numbers(&self.bodies, store).flat_map(words).for_each(|word| hash.write(word));
        hash.0
    }
}

fn is_dynamic(body: &Body) -> bool {
    body.rigid().map_or(!body.fixed, |rigid| rigid.traits.motion == Motion::Dynamic)
}

fn groups(body: &Body) -> CollisionGroups {
    body.rigid().map_or(CollisionGroups::default(), |rigid| rigid.traits.groups)
}

/// A body that others can be in.
struct Solid<'a> {
    body: &'a Body,
    pieces: Vec<(Piece<'a>, Aabb)>,
    bounds: Aabb,
}

impl<'a> Solid<'a> {
    fn of(body: &'a Body, positions: &'a [Vec3]) -> Self {
        let pieces = (0..solid_piece_count(body)).filter_map(|number| Piece::of(body, positions, number));
        let bounded = |piece: Piece<'a>| {
            let bounds = piece.bounds();
            (piece, bounds)
        };
        let pieces: Vec<_> = pieces.map(bounded).collect();
        let corners: Vec<Vec3> = pieces.iter().flat_map(|(_, bounds)| [bounds.low, bounds.high]).collect();
        Self { body, pieces, bounds: Aabb::around(&corners, 0.0) }
    }

    /// The depth of the deepest pair of their parts, in m; 0 or less if they do not overlap.
    fn depth_in(&self, other: &Self) -> f32 {
        let mut least = f64::INFINITY;
        for (a, bounds_a) in &self.pieces {
            for (b, bounds_b) in other.pieces.iter().filter(|(_, bounds)| bounds.overlaps(bounds_a)) {
                a.convex_sets(bounds_b, |a| {
                    b.convex_sets(bounds_a, |b| least = least.min(separation(a, b).gap));
                });
            }
        }
        -least as f32
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
