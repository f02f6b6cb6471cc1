//! Attachments: points of cloth and rope held to each other, to solids and to the world.
//!
//! All three directions are solved at once, with a compliance as in XPBD (Macklin, Müller and Chentanez 2016, Eq 18).
//! Alone that would let a light particle go to its heavy load and the load hardly give way, so that a rope would be
//! stretched by what hangs on it. Therefore a particle that is held firmly to something solid weighs as much as both
//! while sheets, ropes and contacts are solved, and what it was moved by then is done to the solid as well.

use glam::{Mat3, Vec3};

use super::SoftSolver;
use super::piece::Piece;
use super::points::Points;
use super::solid::Solid;
use super::touch::Touch;
use crate::attachment::{Attached, Attachments, End};
use crate::body::Body;
use crate::norm::Norm;
use crate::particles::Particles;

/// How many times heavier a particle gets that is held to what does not move, …
const IMMOVABLE: f32 = 1e3;
/// … and by what moves at most.
const HEAVIEST: f32 = 1e6;

/// All attachments that hold something awake.
#[derive(Debug, Clone, Default)]
pub(super) struct Ties {
    ties: Vec<Tie>,
    loads: Vec<Load>,
}

/// An attachment. Impulses are in kg m in a small step.
#[derive(Debug, Clone)]
struct Tie {
    /// Its index in the world.
    attachment: usize,
    ends: [Hold; 2],
    /// In m/N.
    compliance: f32,
    /// How many stiff ones its solid hangs on.
    company: f32,
    /// What was done to the first end in this small step, as far as it counts against compliance, …
    multiplier: Vec3,
    /// … and in this step.
    total: Vec3,
}

#[derive(Debug, Clone, Copy)]
enum Hold {
    Places {
        places: [usize; 3],
        weights: [f32; 3],
    },
    /// A point of a body, in its principal frame (m), and the solid's number in this substep.
    Solid {
        body: usize,
        point: Vec3,
        number: usize,
    },
    Still(Vec3),
}

/// A particle that carries what is attached to it.
#[derive(Debug, Clone, Copy)]
struct Load {
    tie: usize,
    place: usize,
    /// How much of that it carries, in kg.
    mass: f32,
    /// Its own inverse mass, and its displacement before.
    inverse_mass: f32,
    displacement: Vec3,
}

/// When and how ties pull.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    /// Small steps of the substep that are still to come.
    pub(super) left: f32,
    /// A small step, in s.
    pub(super) small: f32,
    /// By how much what is apart may be drawn together in it, in m.
    pub(super) recovery: f32,
}

impl Ties {
    pub(super) fn new(
        attachments: &Attachments,
        pieces: &[Piece],
        bodies: &[Body],
        particles: &Particles,
    ) -> Self {
        let hold = |end: End| Hold::of(end, pieces, bodies, particles);
        let tie = |(attachment, attached): (usize, &Attached)| Tie {
            attachment,
            ends: attached.ends.map(hold),
            compliance: attached.compliance(),
            company: 1.0,
            multiplier: Vec3::ZERO,
            total: Vec3::ZERO,
        };
        let is_awake = |tie: &Tie| tie.ends.iter().any(|end| matches!(end, Hold::Places { .. }));
        let mut ties: Vec<Tie> = attachments.holding().map(tie).filter(is_awake).collect();
        let solids: Vec<usize> =
            ties.iter().filter(|tie| tie.compliance == 0.0).filter_map(Tie::body).collect();
        for tie in &mut ties {
            let company = solids.iter().filter(|&&body| Some(body) == tie.body()).count();
            tie.company = company.max(1) as f32;
        }
        Self { ties, loads: Vec::new() }
    }

    pub(super) fn begin_step(&mut self) {
        self.ties.iter_mut().for_each(|tie| tie.total = Vec3::ZERO);
    }

    /// The pairs of places that are held to each other.
    pub(super) fn links(&self) -> impl Iterator<Item = [u32; 2]> {
        self.ties.iter().flat_map(|tie| {
            let [a, b] = tie.ends;
            a.held().flat_map(move |(from, _)| b.held().map(move |(to, _)| [from as u32, to as u32]))
        })
    }

    /// Finds the solids of a substep, which are in the order of their bodies.
    pub(super) fn begin_substep(&mut self, solids: &[Solid<'_>]) {
        self.ties.retain_mut(|tie| {
            tie.ends.iter_mut().all(|end| match end {
                Hold::Solid { body, number, .. } => {
                    *number = solids.partition_point(|solid| solid.body < *body);
                    solids.get(*number).is_some_and(|solid| solid.body == *body)
                }
                Hold::Places { .. } | Hold::Still(_) => true,
            })
        });
    }

    /// Lets the particles that are held to a solid through it.
    pub(super) fn exempt(&self, touches: &mut [Touch]) {
        for [particles, solid] in self.ties.iter().filter_map(Tie::carried) {
            let Hold::Solid { number, .. } = solid else { continue };
            for touch in touches.iter_mut().filter(|touch| touch.solid as usize == number) {
                particles.held().for_each(|(place, _)| touch.exempt(place));
            }
        }
    }

    /// Draws all ends together.
    pub(super) fn pull(&mut self, points: &mut Points, solids: &mut [Solid<'_>], moment: Moment) {
        for tie in &mut self.ties {
            tie.pull(points, solids, moment);
        }
    }

    /// Begins a small step, once all has moved on.
    fn begin(&mut self) {
        self.ties.iter_mut().for_each(|tie| tie.multiplier = Vec3::ZERO);
    }

    /// Lets particles weigh as much as what is firmly attached to them.
    fn load(&mut self, points: &mut Points, solids: &[Solid<'_>], left: f32) {
        self.loads.clear();
        for (tie, stiff) in self.ties.iter().enumerate().filter(|(_, tie)| tie.compliance == 0.0) {
            let Some([particles, carried]) = stiff.carried() else { continue };
            let (at, motion) = particles.at(points, solids, left);
            let meeting = at - motion;
            let mobility = carried.most_mobility(meeting, solids, left) * stiff.company;
            for (place, weight) in particles.held() {
                let inverse_mass = points.inverse_mass[place];
                if inverse_mass == 0.0 {
                    continue;
                }
                let most = if mobility > 0.0 { HEAVIEST } else { IMMOVABLE };
                let mass = weight * (1.0 / mobility).min(most / inverse_mass);
                let displacement = points.motion(place);
                self.loads.push(Load { tie, place, mass, inverse_mass, displacement });
                points.inverse_mass[place] /= 1.0 + mass * inverse_mass;
            }
        }
    }

    /// Takes the load off particles, and moves what they carried as they have been moved.
    fn unload(&mut self, points: &mut Points, solids: &mut [Solid<'_>], left: f32) {
        // In reverse, since a particle may carry several.
        for load in self.loads.iter().rev() {
            points.inverse_mass[load.place] = load.inverse_mass;
            let tie = &mut self.ties[load.tie];
            let Some([_, carried]) = tie.carried() else { continue };
            let impulse = (points.motion(load.place) - load.displacement) * load.mass;
            carried.push(points, solids, impulse, points.begun_at(load.place), left);
            // What is carried is the first end or the second.
            let is_first = !matches!(tie.ends[0], Hold::Places { .. });
            tie.total += if is_first { impulse } else { -impulse };
        }
    }

    /// What was done to the first end of each attachment in this step, in kg m in a small step.
    pub(super) fn totals(&self) -> impl Iterator<Item = (usize, Vec3)> {
        self.ties.iter().map(|tie| (tie.attachment, tie.total))
    }
}

impl SoftSolver {
    /// Draws attachments together, and lets particles carry what is attached to them until [`SoftSolver::unload_ties`].
    pub(super) fn load_ties(&mut self, solids: &mut [Solid<'_>], moment: Moment) {
        let Self { ties, points, .. } = self;
        ties.begin();
        ties.pull(points, solids, moment);
        ties.load(points, solids, moment.left);
    }

    /// Takes from particles what they carried.
    pub(super) fn unload_ties(&mut self, solids: &mut [Solid<'_>], moment: Moment) {
        let Self { ties, points, .. } = self;
        ties.unload(points, solids, moment.left);
    }
}

impl Tie {
    /// The particles that carry, and what is solid or still and hangs on them; `None` if both ends are of cloth or rope.
    fn carried(&self) -> Option<[Hold; 2]> {
        match self.ends {
            [Hold::Places { .. }, Hold::Places { .. }] => None,
            [particles @ Hold::Places { .. }, carried] | [carried, particles] => Some([particles, carried]),
        }
    }

    /// The body that it hangs on.
    fn body(&self) -> Option<usize> {
        self.ends.iter().find_map(|end| match end {
            Hold::Solid { body, .. } => Some(*body),
            Hold::Places { .. } | Hold::Still(_) => None,
        })
    }

    fn pull(&mut self, points: &mut Points, solids: &mut [Solid<'_>], moment: Moment) {
        let [a, b] = self.ends;
        let ((at_a, motion_a), (at_b, motion_b)) =
            (a.at(points, solids, moment.left), b.at(points, solids, moment.left));
        // Both are pushed at one point, where one was when the small step began, so that angular momentum is kept although
        // they are apart.
        let meeting = if let Hold::Places { .. } = a { at_a - motion_a } else { at_b - motion_b };
        let softness = self.compliance / (moment.small * moment.small);
        let mobility = a.mobility(points, meeting, solids, moment.left)
            + b.mobility(points, meeting, solids, moment.left);
        let mobility = mobility + Mat3::from_diagonal(Vec3::splat(softness));
        let size = mobility.x_axis.x + mobility.y_axis.y + mobility.z_axis.z;
        if size <= 0.0 {
            return;
        }
        let mut gap = at_b - at_a;
        if self.compliance == 0.0 {
            // Of what was apart before the small step a part may stay so.
            let before = gap - (motion_b - motion_a);
            gap -= before * (1.0 - (moment.recovery / before.norm().max(1e-30)).min(1.0));
        }
        let impulse = (mobility * (1.0 / size)).inverse() * ((gap - self.multiplier * softness) / size);
        self.multiplier += impulse;
        self.total += impulse;
        a.push(points, solids, impulse, meeting, moment.left);
        b.push(points, solids, -impulse, meeting, moment.left);
    }
}

impl Hold {
    fn of(end: End, pieces: &[Piece], bodies: &[Body], particles: &Particles) -> Self {
        match end {
            End::Particles { body, particles: numbers, weights } => {
                let body = body as usize;
                match pieces.binary_search_by_key(&body, |piece| piece.body) {
                    Ok(piece) => {
                        let place = |particle: u32| pieces[piece].place(particle as usize);
                        Self::Places { places: numbers.map(place), weights }
                    }
                    // It does not move.
                    Err(_) => {
                        let at = &particles.position[bodies[body].particles.clone()];
                        let share = |(number, weight): (u32, f32)| at[number as usize] * weight;
                        Self::Still(numbers.into_iter().zip(weights).map(share).sum())
                    }
                }
            }
            End::Point { body, point } => Self::Solid { body: body as usize, point, number: 0 },
            End::World(point) => Self::Still(point),
        }
    }

    /// The places of the particles that are held, with their weights.
    fn held(self) -> impl Iterator<Item = (usize, f32)> {
        let (places, weights) = match self {
            Self::Places { places, weights } => (places, weights),
            Self::Solid { .. } | Self::Still(_) => ([0; 3], [0.0; 3]),
        };
        places.into_iter().zip(weights).filter(|&(_, weight)| weight > 0.0)
    }

    /// Where it is (m), and how it moves in this small step (m).
    fn at(self, points: &Points, solids: &[Solid<'_>], left: f32) -> (Vec3, Vec3) {
        match self {
            Self::Places { .. } => {
                self.held().fold((Vec3::ZERO, Vec3::ZERO), |(at, motion), (place, weight)| {
                    (at + points.at(place) * weight, motion + points.motion(place) * weight)
                })
            }
            Self::Solid { point, number, .. } => {
                let stance = solids[number].stance(left);
                let arm = stance.axes * point;
                (stance.center + arm, stance.linear + stance.angular.cross(arm))
            }
            Self::Still(point) => (point, Vec3::ZERO),
        }
    }

    /// By how much an impulse at `meeting` (m) moves it, in 1/kg.
    fn mobility(self, points: &Points, meeting: Vec3, solids: &[Solid<'_>], left: f32) -> Mat3 {
        match self {
            Self::Places { .. } => {
                let share = |(place, weight): (usize, f32)| weight * weight * points.inverse_mass[place];
                Mat3::from_diagonal(Vec3::splat(self.held().map(share).sum()))
            }
            Self::Solid { number, .. } => {
                let solid = &solids[number];
                let arm = meeting - solid.begun_at(left);
                let moved = |axis: Vec3| {
                    axis * solid.inverse_mass + (solid.inverse_inertia * arm.cross(axis)).cross(arm)
                };
                Mat3::from_cols(moved(Vec3::X), moved(Vec3::Y), moved(Vec3::Z))
            }
            Self::Still(_) => Mat3::ZERO,
        }
    }

    /// The most by which an impulse at `meeting` moves a solid, or a little more, in 1/kg.
    fn most_mobility(self, meeting: Vec3, solids: &[Solid<'_>], left: f32) -> f32 {
        let Self::Solid { number, .. } = self else { return 0.0 };
        let solid = &solids[number];
        let arm = meeting - solid.begun_at(left);
        let turned = |axis: Vec3| {
            let turned = arm.cross(axis);
            turned.dot(solid.inverse_inertia * turned)
        };
        solid.inverse_mass + turned(Vec3::X) + turned(Vec3::Y) + turned(Vec3::Z)
    }

    /// Gives it an impulse at `meeting` (m), in kg m in a small step.
    fn push(self, points: &mut Points, solids: &mut [Solid<'_>], impulse: Vec3, meeting: Vec3, left: f32) {
        match self {
            Self::Places { .. } => {
                for (place, weight) in self.held() {
                    points.shift(place, impulse * (weight * points.inverse_mass[place]));
                }
            }
            Self::Solid { number, .. } => {
                let solid = &mut solids[number];
                let arm = meeting - solid.begun_at(left);
                solid.push(impulse, arm);
            }
            Self::Still(_) => {}
        }
    }
}

#[cfg(test)]
#[path = "tests/attach.rs"]
mod tests;
