//! The solver of cloth, rope and soft solids: small steps, many to a substep, each with one pass over everything.
//!
//! At the same cost, one sweep in each of many small steps leaves ten to twenty times less stretch than many sweeps in a
//! few. What a sweep spreads slowly along a sheet or rope is solved in whole threads at once, and what hangs on held
//! particles by tethers. Rigid bodies have made their substep by then; cloth and rope meet them on the way, push them and
//! are pushed.

mod air;
mod attach;
mod batch;
mod bend;
mod elastic;
mod gas;
mod grid;
mod hinge;
mod hot;
mod meet;
mod pair;
mod patch;
mod piece;
mod points;
mod probe;
mod rest;
mod ropes;
mod seam;
mod sheet;
mod small_step;
mod solid;
mod spin;
mod stick;
mod strand;
mod tether;
mod thread;
mod tile;
mod touch;
mod winding;

use glam::Vec3;

use crate::attachment::Attachments;
use crate::body::{Body, Deformable, Substance};
use crate::constraint::Stick;
use crate::order::PutInOrder;
use crate::particles::{Particles, is_within_reach};
use crate::settings::Settings;
use crate::simd::LANES;
use crate::solver::substep::RigidSolver;

use attach::Ties;
use meet::{Meetings, Member};
use piece::{Layout, Piece, span_of};
use points::{Points, set};
use rest::Rest;
use ropes::{Bundle, Rope};
use small_step::{Timing, look_every};
use solid::Solid;
use spin::Couples;
use stick::Span;
use strand::{Segment, Strands};
use thread::Pivot;
use touch::Touch;

pub(crate) use batch::colors;
pub(crate) use rest::sleepers_near_movers;

/// Small steps in a second: so many, and so many more for every particle along the longer side of a cloth, within bounds.
const LEAST_RATE: f32 = 1440.0;
const RATE_PER_PARTICLE: f32 = 24.0;
const RATES: [f32; 2] = [1920.0, 3840.0];
/// What share of their motion against each other particles of cloth that touch lose in a small step.
const CLING: f32 = 0.3;

/// All awake cloth and rope.
#[derive(Debug, Clone, Default)]
pub(crate) struct SoftSolver {
    points: Points,
    pieces: Vec<Piece>,
    bundles: Vec<Bundle>,
    meetings: Meetings,
    strands: Strands,
    touches: Vec<Touch>,
    ties: Ties,
    couples: Couples,
    /// Scratch memory.
    pivots: Vec<Pivot>,
    /// Held particles that are led along: their places, and their motion in a small step (m).
    led: Vec<(usize, Vec3)>,
    /// Small steps made in this step.
    done: u32,
    /// Small steps that there are in it.
    planned: u32,
    /// In how many small steps what may touch is looked for once.
    look_every: u32,
    /// Small steps in a second, about.
    rate: f32,
    /// Whether bodies have come, gone or changed since everything was laid out.
    is_stale: bool,
    /// The small step that elastic cloth and rope are laid out for, in s.
    laid_out_for: f32,
}

impl SoftSolver {
    /// Has everything laid out anew before the next step.
    pub(crate) fn invalidate(&mut self) {
        self.is_stale = true;
    }

    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        self.pieces.clear();
        self.ties = Ties::default();
        self.is_stale = true;
    }

    /// Reads the particles of all awake cloth and rope; `h` is a substep (s).
    pub(crate) fn begin(
        &mut self,
        (bodies, particles, attachments): (&[Body], &Particles, &Attachments),
        settings: &Settings,
        h: f32,
    ) {
        self.done = 0;
        let is_awake = |(_, body): &(usize, &Body)| body.is_awake() && body.is_soft();
        let awake = bodies.iter().enumerate().filter(is_awake).map(|(index, _)| index);
        let is_elastic = self.pieces.iter().any(|piece| piece.is_elastic);
        let is_other_step = is_elastic && h / self.small_steps(h) != self.laid_out_for;
        if self.is_stale || is_other_step || !awake.eq(self.pieces.iter().map(|piece| piece.body)) {
            self.lay_out(bodies, particles, h);
            self.ties = Ties::new(attachments, &self.pieces, bodies, particles);
            self.link(bodies);
        }
        self.ties.begin_step();
        self.planned = self.small_steps(h) as u32 * settings.substeps;
        self.look_every = look_every(self.small_steps(h) as usize);
        let small = h / self.small_steps(h);
        self.led.clear();
        for kick in &mut self.points.kick {
            kick.clear();
            kick.resize(if particles.is_forced() { self.points.inverse_mass.len() } else { 0 }, 0.0);
        }
        for number in 0..self.pieces.len() {
            self.read(number, bodies, particles, settings.gravity * (small * small), small);
        }
        self.meetings.forget(&self.points);
    }

    /// Reads a piece; `fall` is what gravity adds to a displacement in a small step (m).
    fn read(&mut self, number: usize, bodies: &[Body], particles: &Particles, fall: Vec3, small: f32) {
        let piece = &mut self.pieces[number];
        let body = &bodies[piece.body];
        let Substance::Deformable(deformable) = &body.substance else { return };
        piece.tie(body, deformable, particles);
        piece.note_winding(deformable);
        piece.rest = Rest { calm_for: body.rest.calm_for, ..Rest::default() };
        let scale = small / body.displacement_time();
        // Half of how much longer than this the last small step was: see `VerletStep`.
        let lag = (body.previous_step / small - 1.0) * 0.5;
        for (number, i) in body.particles.clone().enumerate() {
            let (place, mass) = (piece.place(number), particles.inverse_mass[i]);
            let mut displacement = particles.displacement[i] * scale;
            if mass > 0.0 {
                let kick = particles.force(i) * (mass * small * small);
                displacement += (fall + kick) * lag;
                if particles.is_forced() {
                    set(&mut self.points.kick, place, kick);
                }
            } else if displacement != Vec3::ZERO {
                self.led.push((place, displacement));
            }
            let position = particles.position[i];
            self.points.put(place, position, displacement);
            self.points.carry(place, deformable.remainder(number, position));
            self.points.inverse_mass[place] = mass;
        }
    }

    fn lay_out(&mut self, bodies: &[Body], particles: &Particles, h: f32) {
        self.is_stale = false;
        self.rate = rate_of(bodies);
        let small = h / self.small_steps(h);
        self.laid_out_for = small;
        self.pieces.clear();
        self.strands.reset();
        let mut end = 0;
        for (index, body) in bodies.iter().enumerate().filter(|(_, body)| body.is_awake()) {
            if let Substance::Deformable(deformable) = &body.substance {
                self.pieces.push(Piece::new(index, body, deformable, particles, end, small));
                end = self.pieces.last().map_or(end, |piece| piece.places.end);
            }
        }
        self.points.reset(end);
        self.meetings.reset(self.points.inverse_mass.len());
        let mut ropes = Vec::new();
        for (number, piece) in self.pieces.iter_mut().enumerate() {
            let body = &bodies[piece.body];
            for particle in 0..body.particles.len() {
                self.points.presence[piece.place(particle)] = 1.0;
            }
            let Substance::Deformable(deformable) = &body.substance else { continue };
            if deformable.is_rope() {
                if let Layout::Rope = piece.layout {
                    ropes.push(Rope { start: piece.places.start, spans: spans_of_rope(deformable, small) });
                }
                self.strands.add(segments(number as u32, piece, deformable, body));
            } else {
                let distance = 2.0 * piece.thickness;
                let exempt = piece.exempt(deformable, distance, &mut self.meetings.material);
                let meets_itself = deformable.neighbours.is_some();
                let member = Member { piece: number as u32, meets_itself, distance, exempt, friction: CLING };
                self.meetings.add(&piece.tiles, member);
                piece.longest_motion = distance;
            }
        }
        ropes.put_in_order_by_key(|rope: &Rope| (rope.spans.len(), rope.start));
        let mean = self.pieces.iter().map(|piece| piece.mean_inverse_mass).fold(0.0, f32::max);
        // What follows the end of a shorter rope would pull at it: only ropes of one length go side by side.
        let alike = ropes.chunk_by(|a, b| a.spans.len() == b.spans.len());
        let bundle = |ropes: &[Rope]| Bundle::new(ropes.to_vec(), mean);
        self.bundles = alike.flat_map(|ropes| ropes.chunks(LANES)).map(bundle).collect();
    }

    /// Notes what holds what, and so does not touch it.
    fn link(&mut self, bodies: &[Body]) {
        self.meetings.link(self.ties.links());
        let of_net = |piece: &Piece| match &bodies[piece.body].substance {
            Substance::Deformable(net) if matches!(piece.layout, Layout::Net(_)) => {
                let start = piece.places.start as u32;
                net.sticks.iter().map(|stick| [start + stick.a, start + stick.b]).collect()
            }
            _ => Vec::new(),
        };
        self.strands.link(self.ties.links().chain(self.pieces.iter().flat_map(of_net)));
    }

    /// One substep of `h` (s), after the rigid bodies have made theirs.
    pub(crate) fn substep(&mut self, bodies: &[Body], rigid: &mut RigidSolver, settings: &Settings, h: f32) {
        if self.pieces.is_empty() {
            return;
        }
        let count = self.small_steps(h);
        let solid = |(index, body)| Solid::of(index, body, rigid, count);
        let mut solids: Vec<Solid<'_>> = bodies.iter().enumerate().filter_map(solid).collect();
        let timing = Timing {
            small: h / count,
            count: count as usize,
            gravity: settings.gravity,
            wind: settings.wind,
            air_density: settings.air_density,
            damping: settings.damping,
            recovery: settings.separation_speed.unwrap_or(f32::INFINITY),
            instructions: settings.instructions,
        };
        self.ties.begin_substep(&solids);
        self.make_small_steps(&mut solids, bodies, &timing);
        for solid in &solids {
            if let Some(change) = solid.outcome(count) {
                rigid.nudge(solid.body, &change);
            }
        }
    }

    /// Where a particle of an awake cloth or rope is (m) and how it moves (m/s).
    pub(crate) fn particle(&self, body: usize, particle: usize, h: f32) -> Option<(Vec3, Vec3)> {
        let place = self.place(body, particle)?;
        Some((self.points.at(place), self.points.motion(place) / (h / self.small_steps(h))))
    }

    /// Changes how a particle of an awake cloth or rope moves, by so much (m/s).
    pub(crate) fn push(&mut self, body: usize, particle: usize, change: Vec3, h: f32) {
        if let Some(place) = self.place(body, particle) {
            let motion = self.points.motion(place) + change * (h / self.small_steps(h));
            self.points.set_motion(place, motion);
        }
    }

    /// With what force (N) each attachment that holds held its first end in this step of substeps of `h` (s), on the
    /// mean, with its index.
    pub(crate) fn attachment_forces(&self, h: f32) -> Vec<(usize, Vec3)> {
        let small = h / self.small_steps(h);
        let scale = 1.0 / (small * small * self.done.max(1) as f32);
        let is_done = self.done > 0;
        self.ties.totals().filter(|_| is_done).map(|(index, total)| (index, total * scale)).collect()
    }

    /// How many small steps a substep of `h` (s) has.
    fn small_steps(&self, h: f32) -> f32 {
        (h * self.rate).round().max(1.0)
    }

    fn place(&self, body: usize, particle: usize) -> Option<usize> {
        self.pieces.iter().find(|piece| piece.body == body).map(|piece| piece.place(particle))
    }

    /// Writes the particles. Returns the bodies that have left all reach, which stay where they were, each with its first
    /// particle that has.
    pub(crate) fn finish(
        &mut self,
        bodies: &mut [Body],
        particles: &mut Particles,
        h: f32,
    ) -> Vec<(usize, u32)> {
        let small = h / self.small_steps(h);
        let (mut lost, mut moved) = (Vec::new(), Vec::new());
        for piece in &self.pieces {
            let body = &mut bodies[piece.body];
            moved.clear();
            moved.extend(piece.in_order().map(|place| (self.points.at(place), self.points.motion(place))));
            let is_lost = |&(position, displacement): &(Vec3, Vec3)| !is_within_reach(position, displacement);
            if let Some(number) = moved.iter().position(is_lost) {
                lost.push((piece.body, number as u32));
                continue;
            }
            for (i, &(position, displacement)) in body.particles.clone().zip(&moved) {
                (particles.position[i], particles.displacement[i]) = (position, displacement);
            }
            body.previous_step = small;
            if let Substance::Deformable(deformable) = &mut body.substance {
                deformable.remainders.clear();
                deformable.remainders.extend(piece.in_order().map(|place| self.points.rest(place)));
                let stitches = &piece.seams.stitches;
                for (seam, stitch) in deformable.fabric.seams.iter_mut().zip(stitches) {
                    seam.rest_length = stitch.rest_length;
                }
            }
        }
        self.keep_winding(bodies);
        self.is_stale |= !lost.is_empty();
        lost
    }
}

/// The spans of a rope's sticks in small steps of `h` (s).
fn spans_of_rope(rope: &Deformable, h: f32) -> Vec<Span> {
    let stretch = rope.fabric.stretch.as_ref();
    let compliances = stretch.and_then(|stretch| stretch.compliances.as_deref()).unwrap_or(&[]);
    let compliances = compliances.iter().copied().chain(std::iter::repeat(0.0));
    let span = |(stick, compliance): (&Stick, f32)| span_of(stick.rest_length, compliance / (h * h));
    rope.sticks.iter().zip(compliances).map(span).collect()
}

/// The segments of a rope.
fn segments(number: u32, piece: &Piece, rope: &Deformable, body: &Body) -> impl Iterator<Item = Segment> {
    let (start, friction, radius) = (piece.places.start as u32, body.surface.friction, rope.thickness);
    let is_held = piece.is_held();
    // Segments that a bend could bring so near are neighbours, and no contact.
    let shortest = rope.sticks.iter().map(|stick| stick.rest_length).fold(f32::INFINITY, f32::min);
    let near = (3.0 * radius / shortest).ceil().min(1e6) as u32 + 1;
    // In a net, numbers do not tell what is near.
    let near = if rope.is_chain() { near } else { 0 };
    let exempt = if rope.neighbours.is_some() { near } else { u32::MAX };
    rope.sticks.iter().zip(0..).map(move |(stick, number_in_rope)| Segment {
        ends: [start + stick.a, start + stick.b],
        radius,
        friction,
        rope: number,
        number: number_in_rope,
        exempt,
        is_held,
    })
}

/// How many small steps awake cloth and rope take in a second. A sweep carries strain one edge further, so that what is
/// finer needs more.
fn rate_of(bodies: &[Body]) -> f32 {
    let finest = |body: &Body| match &body.substance {
        Substance::Deformable(deformable) if body.is_awake() => deformable.fineness(body.particles.len()),
        _ => 0,
    };
    let fineness = bodies.iter().map(finest).max().unwrap_or(0);
    (LEAST_RATE + RATE_PER_PARTICLE * fineness as f32).clamp(RATES[0], RATES[1])
}

#[cfg(test)]
mod tests;
