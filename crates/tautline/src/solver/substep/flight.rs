//! Bodies that fly by themselves turn exactly.
//!
//! Between steps a body is four particles of `f32`. What they cannot hold of its spin is lost in every step, and the
//! substeps round it as well: about 1e-6 of the angle that it turns by goes astray, and nothing ever corrects it. Where a
//! body touches others that is nothing against what those do to it. But what nothing is near flies on for long: its
//! rotation and its angular momentum are kept in `f64`, and make the substeps of `rigidity` by themselves.
//!
//! Such a body also makes its substeps as all do, so that cloth sees it where it is. When they are over, it is put where
//! its flight has led, unless something has pushed it meanwhile.

use glam::{DMat3, DQuat, DVec3, Vec3};
use serde::{Deserialize, Serialize};

use super::RigidSolver;
use super::block::{Block, column, columns};
use super::crew::{Timing, set_lane};
use super::lineup::NOBODY;
use crate::body::{Body, exact_inertia, exact_rotation};
use crate::order::PutInOrder;
use crate::parallel;
use crate::particles::Particles;
use crate::simd::{LANES, Row};

/// What turns by less than this in a step, in rad, makes some ten turns a minute: rounding turns it by less than 1e-4 rad
/// in that time, and it is not worth an exact flight, which costs as much as the rest of its step.
pub(super) const LEAST_TURN: f32 = 0.02;
/// Half the angle, in rad, up to which a substep's rotation is solved for: from there on the iteration takes long, and
/// soon does not end. The `f32` way follows what is faster, as far as it can.
const FASTEST: f64 = 0.25;
/// How near u is to be to the one before, as an angle in rad: far below what `f32` tells apart.
const EXACT: f64 = 1e-15;
/// The iteration is over by then: each one gains a factor of a third at least.
const MOST_ITERATIONS: usize = 32;
/// From so many flights on it pays to make them side by side.
const WORTHWHILE: usize = 64;

/// How a body is turned and how it turns, as exactly as is known.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Spin {
    /// From the principal frame to the world.
    rotation: DQuat,
    /// Angular momentum over the mass, in the world's frame, in m²/s.
    momentum: DVec3,
}

/// The particles of a body, and the time of their displacements, in s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Written {
    positions: [Vec3; 4],
    displacements: [Vec3; 4],
    time: f32,
}

/// A body that flies by itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Flight {
    /// Its index in the world.
    body: u32,
    spin: Spin,
    /// What the spin was written as when the last step ended. If the particles are any others now, the body has been
    /// moved from outside, and they alone say how.
    written: Written,
}

/// All bodies that fly by themselves, in the order of their indices.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Flights(Vec<Flight>);

impl Flights {
    fn index(&self, body: u32) -> Option<usize> {
        self.0.binary_search_by_key(&body, |flight| flight.body).ok()
    }

    fn find(&self, body: u32) -> Option<&Flight> {
        self.index(body).map(|index| &self.0[index])
    }

    /// Something has pushed a body.
    pub(super) fn end(&mut self, body: usize) {
        if let Some(index) = self.index(body as u32) {
            self.0.remove(index);
        }
    }

    /// Forgets a body that is removed; those behind it move down.
    pub(super) fn remove_body(&mut self, body: u32) {
        self.end(body as usize);
        self.0.iter_mut().for_each(|flight| flight.body -= u32::from(flight.body > body));
    }

    /// All that the next step depends on and that is not in the particles.
    fn numbers(&self, bodies: &[Body], particles: &Particles) -> impl Iterator<Item = f64> {
        let goes_on =
            |flight: &&Flight| flight.written == Written::of(&bodies[flight.body as usize], particles);
        self.0.iter().filter(goes_on).flat_map(|Flight { spin, .. }| {
            spin.rotation.to_array().into_iter().chain(spin.momentum.to_array())
        })
    }

    /// Checks flights from untrusted bytes.
    pub(super) fn is_valid(&self, bodies: &[Body]) -> bool {
        let is_sound = |Flight { body, spin, .. }: &Flight| {
            bodies.get(*body as usize).is_some_and(Body::is_rigid)
                && (spin.rotation.length_squared() - 1.0).abs() < 1e-9
                && spin.momentum.is_finite()
        };
        self.0.iter().all(is_sound) && self.0.is_sorted_by(|a, b| a.body < b.body)
    }
}

impl RigidSolver {
    /// Finds out who flies by itself in this step: bodies that turn fast enough, that nothing is near, and that neither
    /// joints nor forces turn. In haste nobody does.
    pub(crate) fn take_off(&mut self, bodies: &[Body], particles: &Particles, h: f32) {
        let known = std::mem::take(&mut self.flights);
        let tracks = self.crew.tracks[..self.lineup.solved / LANES].iter();
        if self.is_hasty || tracks.clone().all(|track| track.spinning == 0) {
            return;
        }
        let mut is_near = vec![false; bodies.len()];
        for pair in &self.pairs.pairs {
            (is_near[pair.a as usize], is_near[pair.b as usize]) = (true, true);
        }
        for (block, track) in tracks.enumerate().filter(|(_, track)| track.spinning != 0) {
            for lane in (0..LANES).filter(|lane| track.spinning >> lane & 1 == 1) {
                let place = block * LANES + lane;
                let body = self.lineup.places[place];
                if !self.is_loose(place) || is_near.get(body as usize) != Some(&false) {
                    continue;
                }
                let written = Written::of(&bodies[body as usize], particles);
                let flight = known.find(body).filter(|flight| flight.written == written);
                let spin = flight.map_or_else(|| written.spin(), |flight| flight.spin);
                if !spin.is_too_fast(inertia(&self.crew.blocks[block], lane), f64::from(h)) {
                    self.flights.0.push(Flight { body, spin, written });
                }
            }
        }
        self.flights.0.put_in_order_by(|a, b| a.body.cmp(&b.body));
    }

    /// Whether a body that impulses turn stands in a place, and nothing but contacts does.
    fn is_loose(&self, place: usize) -> bool {
        let is_own = self.lineup.is_place_of(place as u32, self.lineup.places[place]);
        let turns = self.crew.blocks[place / LANES].constants.response.0[place % LANES] > 0.0;
        let is_driven =
            self.crew.kicks.get(place).is_some_and(|kick| kick.0[4..7].iter().any(|&turn| turn != 0.0));
        is_own && turns && !is_driven && self.assembly_of(place) == NOBODY
    }

    /// Puts those who have flown where their flights have led.
    pub(super) fn land(&mut self, timing: &Timing) {
        let (blocks, place_of) = (&mut self.crew.blocks, &self.lineup.place_of);
        let worthwhile = parallel::is_worthwhile(self.flights.0.len(), WORTHWHILE);
        parallel::for_each(&mut self.flights.0, worthwhile, |flight| {
            let place = place_of[flight.body as usize] as usize;
            flight.spin.fly(&blocks[place / LANES], place % LANES, timing);
        });
        for flight in &self.flights.0 {
            let place = place_of[flight.body as usize] as usize;
            let row = &mut self.crew.velocities[place];
            flight.spin.write(&mut blocks[place / LANES], place % LANES, row, f64::from(timing.h));
        }
    }

    /// What the next step depends on and the particles are too coarse for.
    pub(crate) fn exact_numbers(&self, bodies: &[Body], particles: &Particles) -> impl Iterator<Item = f64> {
        self.flights.numbers(bodies, particles)
    }

    /// Notes what the particles were written as.
    pub(super) fn note_flights(&mut self, bodies: &[Body], particles: &Particles) {
        for flight in &mut self.flights.0 {
            flight.written = Written::of(&bodies[flight.body as usize], particles);
        }
    }
}

impl Written {
    /// Of a rigid body.
    fn of(body: &Body, particles: &Particles) -> Self {
        let four = |vectors: &[Vec3]| std::array::from_fn(|k| vectors[body.particles.start + k]);
        Self {
            positions: four(&particles.position),
            displacements: four(&particles.displacement),
            time: body.displacement_time(),
        }
    }

    /// What there is to be read from them, see `block`.
    fn spin(&self) -> Spin {
        let (axes, moment) = exact_rotation(&self.positions, &self.displacements);
        Spin { rotation: DQuat::from_mat3(&axes), momentum: moment / f64::from(self.time) }
    }
}

impl Spin {
    /// The angular velocity in the body's frame, in rad/s.
    fn angular(&self, inertia: DVec3) -> DVec3 {
        (self.rotation.conjugate() * self.momentum) / inertia
    }

    /// Whether it could ever turn by more in a substep than is solved for, with the energy that it has: ω² ≤ 2 E/I₁.
    /// What is not finite is.
    fn is_too_fast(&self, inertia: DVec3, h: f64) -> bool {
        let angular = self.angular(inertia);
        let largest = angular.dot(angular * inertia) / inertia.min_element();
        let limit = 2.0 * FASTEST / h;
        !(largest < limit * limit && self.rotation.is_finite())
    }

    /// Makes the substeps of a body, as `rigidity` does.
    fn fly(&mut self, block: &Block, lane: usize, timing: &Timing) {
        let (inertia, h) = (inertia(block, lane), f64::from(timing.h));
        let rate = f64::from(block.constants.damping[1].0[lane]) + f64::from(timing.damping);
        let kept = 1.0 / (1.0 + rate * h);
        for _ in 0..timing.substeps as usize {
            let turned = self.rotation * turn(self.angular(inertia) * (0.5 * h), inertia);
            // So near to unit length that one Newton step makes it so.
            self.rotation = turned * (1.5 - 0.5 * turned.length_squared());
            self.momentum *= kept;
        }
    }

    /// Puts a body, with its row of velocities, where it says.
    fn write(&self, block: &mut Block, lane: usize, row: &mut Row, h: f64) {
        let axes = DMat3::from_quat(self.rotation).as_mat3();
        for (rows, axis) in block.axes.iter_mut().zip([axes.x_axis, axes.y_axis, axes.z_axis]) {
            set_lane(rows, lane, axis);
        }
        let start = columns(&block.start_axes, lane).as_dmat3();
        let turn = self.rotation * (self.angular(inertia(block, lane)) * h);
        let scaled = start.transpose() * turn * column(&block.constants.root_inertia, lane).as_dvec3();
        row.0[4..7].copy_from_slice(&scaled.as_vec3().to_array());
    }
}

fn inertia(block: &Block, lane: usize) -> DVec3 {
    exact_inertia(column(&block.constants.spread, lane))
}

/// The rotation of a substep in the body's frame that solves the equation of `rigidity`, from ω h/2.
fn turn(half: DVec3, inertia: DVec3) -> DQuat {
    let next = |u: DVec3| {
        let real = (1.0 - u.length_squared()).sqrt();
        (half - u.cross(u * inertia) / inertia) / real
    };
    let mut u = half;
    for _ in 0..MOST_ITERATIONS {
        let before = u;
        u = next(before);
        if (u - before).length_squared() <= EXACT * EXACT {
            break;
        }
    }
    DQuat::from_xyzw(u.x, u.y, u.z, (1.0 - u.length_squared()).sqrt())
}
