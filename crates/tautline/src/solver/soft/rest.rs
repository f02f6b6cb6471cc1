//! Cloth and rope at rest.

use super::SoftSolver;
use super::piece::Piece;
use super::tile::Bounds;
use crate::body::Body;
use crate::norm::Norm;
use crate::particles::Particles;
use crate::rest::note_drift;
use crate::settings::Sleep;

/// What lies on something and is slower than this on the mean (root of the mean square), in m/s, …
const CALM: f32 = 0.15;
/// … for this long, in s, is calmed:
const PATIENCE: f32 = 0.25;
/// its slow motion dies out at this rate, in 1/s, …
const CALMING: f32 = 276.0;
/// … and its motion at this speed, in m/s, not at all.
const LIVELY: f32 = 0.5;

/// What a step tells about a piece's rest.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rest {
    /// Whether it has touched something that does not move.
    pub(super) leans: bool,
    /// Whether it has touched a rigid body that moves.
    pub(super) is_pushed: bool,
    /// For how long it has been calm and leaning, in s, when the step began.
    pub(super) calm_for: f32,
}

/// How slow motion is calmed in a small step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Calming {
    /// The share that what is at rest loses; 0 = none.
    pub(super) share: f32,
    /// The displacement that loses nothing, in m.
    pub(super) lively: f32,
}

impl Piece {
    /// What sags or rocks on its support would go on for long, since nothing here takes energy but friction. Free fall and
    /// swinging are none of this: only what leans on something that does not move is calmed.
    pub(super) fn calming(&self, h: f32) -> Calming {
        let is_calm = self.rest.calm_for >= PATIENCE;
        Calming { share: if is_calm { CALMING * h / (1.0 + CALMING * h) } else { 0.0 }, lively: LIVELY * h }
    }
}

impl SoftSolver {
    /// Ends a step of `dt` (s): counts how long bodies have been calm, and keeps rigid bodies awake that awake cloth or
    /// rope touches.
    pub(crate) fn note_rest(&mut self, bodies: &mut [Body], particles: &Particles, dt: f32) {
        for piece in &mut self.pieces {
            let body = &mut bodies[piece.body];
            let rate = body.displacement_time();
            let squares = body.particles.clone().map(|i| particles.displacement[i].length_squared());
            let mean = squares.sum::<f32>() / body.particles.len() as f32;
            let is_calm = piece.rest.leans && mean < CALM * CALM * rate * rate;
            body.rest.calm_for = if is_calm { body.rest.calm_for + dt } else { 0.0 };
        }
    }

    /// Puts cloth and rope to sleep that has drifted slower than `sleep.speed` for `sleep.seconds`, all together that may
    /// touch; not what touches a rigid body that moves.
    pub(crate) fn put_to_sleep(
        &mut self,
        bodies: &mut [Body],
        particles: &mut Particles,
        sleep: Sleep,
        dt: f32,
    ) {
        let mut restless = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            let body = &mut bodies[piece.body];
            note_drift(body, &particles.position, sleep, dt);
            restless.push(piece.rest.is_pushed || body.rest.still_for < sleep.seconds);
        }
        let reaches: Vec<Bounds> =
            self.pieces.iter().map(|piece| piece.bounds().grown(2.0 * piece.thickness)).collect();
        // What is near something restless stays awake too, and so on.
        while let Some(next) = (0..restless.len()).find(|&a| {
            !restless[a] && (0..restless.len()).any(|b| restless[b] && reaches[a].meets(&reaches[b]))
        }) {
            restless[next] = true;
        }
        for (piece, _) in self.pieces.iter().zip(&restless).filter(|(_, is_restless)| !**is_restless) {
            let body = &mut bodies[piece.body];
            body.rest.asleep = true;
            particles.displacement[body.particles.clone()].fill(glam::Vec3::ZERO);
        }
    }
}

/// How many times faster than what sleeps is what wakes it.
const WAKING_SPEED: f32 = 2.0;

/// Sleeping cloth and rope whose boxes are near one of something that moves, and sleeping rigid bodies near cloth and rope
/// that moves; and, since those may carry others, what sleeps near them.
pub(crate) fn sleepers_near_movers(
    bodies: &[Body],
    particles: &Particles,
    sleep: Option<Sleep>,
) -> Vec<usize> {
    let is_sleeper = |body: &Body| !body.fixed && body.rest.asleep && (body.is_soft() || body.is_rigid());
    let has_soft = bodies.iter().any(Body::is_soft);
    let Some(sleep) = sleep.filter(|_| has_soft && bodies.iter().any(is_sleeper)) else { return Vec::new() };
    let near = |body: &Body| (body.is_soft(), reach_of(body, particles));
    let mut movers: Vec<(bool, Bounds)> = bodies
        .iter()
        .filter(|body| (body.is_soft() || body.is_rigid()) && moves(body, particles, sleep))
        .map(near)
        .collect();
    let mut sleepers: Vec<usize> = (0..bodies.len()).filter(|&index| is_sleeper(&bodies[index])).collect();
    let mut woken = Vec::new();
    while let Some((is_soft, mover)) = movers.pop() {
        sleepers.retain(|&index| {
            // Rigid bodies wake each other by their contacts.
            let body = &bodies[index];
            let wakes = (is_soft || body.is_soft()) && reach_of(body, particles).meets(&mover);
            if wakes {
                woken.push(index);
                movers.push(near(body));
            }
            !wakes
        });
    }
    woken
}

/// Whether a body moves enough to wake others. Of cloth and rope drift tells, since particles that are pulled to and fro in
/// small steps have speeds that lead nowhere.
fn moves(body: &Body, particles: &Particles, sleep: Sleep) -> bool {
    if body.is_soft() {
        return body.is_awake() && body.rest.still_for < sleep.seconds / (WAKING_SPEED * WAKING_SPEED);
    }
    let reach = WAKING_SPEED * sleep.speed * body.displacement_time();
    body.is_awake() && particles.displacement[body.particles.clone()].iter().any(|d| d.norm() > reach)
}

/// The box around a body and how far it touches, in m.
fn reach_of(body: &Body, particles: &Particles) -> Bounds {
    let positions = &particles.position[body.particles.clone()];
    let around = |bounds: Bounds, &at: &glam::Vec3| bounds.with(Bounds { low: at, high: at });
    let bounds = positions.iter().fold(Bounds::EMPTY, around);
    match body.rigid() {
        // Four particles near the centre of mass stand for it.
        Some(rigid) => bounds.grown(rigid.shape.reach()),
        None => bounds.grown(2.0 * body.reach()),
    }
}
