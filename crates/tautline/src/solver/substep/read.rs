//! The beginning of a step: particles become blocks and rows.

use glam::Vec3;

use super::block::{Block, Motion, ParticleRows, Rows3, particles};
use super::crew::{Squad, Timing, Track, store};
use super::flight::LEAST_TURN;
use crate::body::{Body, CORNERS};
use crate::particles::Particles;
use crate::simd::{Kernel, LANES, Lanes, Row, Vec3x8};

/// How far a body moves before its contacts are looked for anew, in m.
const TOLERANCE: f32 = 2.5e-4;
/// By how much the speed of a body counts for how far ahead its pairs are found.
const LOOK_AHEAD: f32 = 1.5;

/// What goes less far than this in a step is in no haste, in m, however small it is.
const RUSH: f32 = 0.25;

/// A body in which this ratio of the moments of inertia turns by a radian in a step, or one with four times the ratio by
/// half of that, has another inertia then.
const SLENDER: f32 = 256.0;

/// Particles to blocks and rows.
pub(super) struct Read<'a, 'b> {
    pub(super) squad: &'a mut Squad<'b>,
    pub(super) bodies: &'a [Body],
    pub(super) particles: &'a Particles,
    pub(super) timing: &'a Timing,
}

/// The particles of eight bodies, the factors that make their displacements those of a substep, and half of how
/// much longer than that their last substep was, in substeps.
struct Inputs {
    positions: ParticleRows,
    displacements: ParticleRows,
    forces: ParticleRows,
    scale: Row,
    lag: Row,
}

impl Read<'_, '_> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn inputs(&self, places: &[u32]) -> Inputs {
        let mut inputs = Inputs {
            positions: [Row::ZERO; 12],
            displacements: [Row::ZERO; 12],
            forces: [Row::ZERO; 12],
            scale: Row::ZERO,
            lag: Row::ZERO,
        };
        for (lane, &body) in places.iter().enumerate() {
            let Some(body) = self.bodies.get(body as usize) else {
                // Somewhere a body could be.
                set_particles(&mut inputs.positions, lane, &CORNERS);
                continue;
            };
            let range = body.particles.clone();
            set_particles(&mut inputs.positions, lane, &self.particles.position[range.clone()]);
            set_particles(&mut inputs.displacements, lane, &self.particles.displacement[range.clone()]);
            set_particles(&mut inputs.forces, lane, self.particles.forces(range));
            inputs.scale.0[lane] = self.timing.h / body.displacement_time();
            inputs.lag.0[lane] = (body.previous_step / self.timing.h - 1.0) * 0.5;
        }
        inputs
    }
}

#[inline(always)]
fn set_particles(rows: &mut ParticleRows, lane: usize, particles: &[Vec3]) {
    for (rows, particle) in rows.chunks_exact_mut(3).zip(particles) {
        for (row, number) in rows.iter_mut().zip(particle.to_array()) {
            row.0[lane] = number;
        }
    }
}

impl Kernel for Read<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for i in 0..self.squad.blocks.len() {
            let range = i * LANES..(i + 1) * LANES;
            let inputs = self.inputs(&self.squad.places[range.clone()]);
            let block = &mut self.squad.blocks[i];
            let motion = block.read::<L>(&inputs.positions, &inputs.displacements, L::load(&inputs.scale));
            let columns = block.velocity_rows(motion);
            let kick: [L; LANES] = kick(self.timing, self.particles.is_forced(), block, &inputs);
            let lag = L::load(&inputs.lag);
            let mut lagging = columns;
            for k in 0..LANES {
                lagging[k] = columns[k] + kick[k] * lag;
            }
            store(lagging, &mut self.squad.velocities[range.clone()]);
            if let Some(kicks) = self.squad.kicks.get_mut(range.clone()) {
                store(kick, kicks);
            }
            let turning = track(self.timing, block, motion, &mut self.squad.tracks[i]);
            write_poses::<L>(block, turning, &mut self.squad.poses[2 * range.start..2 * range.end]);
            self.squad.accumulated[range].fill(Row::ZERO);
        }
    }
}

/// What gravity and forces add to the rows in a substep.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn kick<L: Lanes>(timing: &Timing, is_forced: bool, block: &Block, inputs: &Inputs) -> [L; LANES] {
    let constants = &block.constants;
    let (zero, h) = (L::splat(0.0), timing.h);
    let gravity = Vec3x8::splat(timing.gravity * (h * h)) * L::load(&constants.gravity_scale);
    if !is_forced {
        return [gravity.x, gravity.y, gravity.z, zero, zero, zero, zero, zero];
    }
    let h_squared = L::splat(h * h);
    let (forces, positions) = (particles::<L>(&inputs.forces), particles::<L>(&inputs.positions));
    let center = Vec3x8::<L>::load(&block.center);
    let (mut total, mut torque) = (Vec3x8::<L>::zero(), Vec3x8::<L>::zero());
    for (force, position) in forces.into_iter().zip(positions) {
        total = total + force;
        torque = torque + (position - center).cross(force);
    }
    let linear = gravity + total * (L::load(&constants.inverse_mass) * h_squared);
    let turn = block.axes_now().apply_transposed(torque).scale(Vec3x8::load(&constants.inverse_root_inertia));
    let turn = turn * (L::load(&constants.response) * h_squared);
    [linear.x, linear.y, linear.z, zero, turn.x, turn.y, turn.z, zero]
}

/// Notes which bodies have moved, and which may leave their boxes. Returns how far each one's rotation moves its
/// points in the step, in m.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn track<L: Lanes>(timing: &Timing, block: &Block, motion: Motion<L>, track: &mut Track) -> L {
    let substeps = L::splat(timing.substeps);
    let reach = L::load(&block.constants.reach);
    let turning = motion.angular.length() * reach * substeps;
    let way = motion.linear.length() * substeps;
    let look_ahead = way * L::splat(LOOK_AHEAD);
    let rush = way.greater((reach + reach).max(L::splat(RUSH)));
    // Balls may turn as they like.
    let room = reach - L::load(&block.constants.inner_radius);
    let (square, whirl, swing) = (reach * reach, turning * room, (turning + way) * room);
    let whirls = whirl.greater(square);
    // A blow turns what flies by about as much as it would have gone.
    let inertia = Vec3x8::<L>::load(&block.constants.inertia);
    let largest = inertia.x.max(inertia.y).max(inertia.z);
    let least = inertia.x.min(inertia.y).min(inertia.z);
    let swings = (swing * swing * largest).greater(square * square * least * L::splat(SLENDER));
    track.spinning = turning.greater(reach * L::splat(LEAST_TURN)).bits();
    (track.rushing, track.turning) = (rush.bits(), whirls.bits() | swings.bits());
    let need = look_ahead + turning + L::splat(0.5 * timing.margin);
    need.store(&mut track.need);
    let moved = block.moved_squared::<L>(&track.seen.center, &track.seen.axes);
    let has_moved = moved.greater(L::splat(TOLERANCE * TOLERANCE));
    track.moved |= has_moved.bits();
    if track.moved != 0 {
        update(has_moved, &mut track.seen.center, &block.center);
        for (rows, now) in track.seen.axes.iter_mut().zip(&block.axes) {
            update(has_moved, rows, now);
        }
    }
    let away = block.moved_squared::<L>(&track.boxed.center, &track.boxed.axes).sqrt();
    track.leaves = (away + need).greater(L::load(&track.room)).bits();
    turning
}

/// Where the mask is set.
#[inline(always)]
fn update<L: Lanes>(mask: L, rows: &mut Rows3, now: &Rows3) {
    Vec3x8::select(mask, Vec3x8::<L>::load(now), Vec3x8::load(rows)).store(rows);
}

/// See `prepare::Poses`.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn write_poses<L: Lanes>(block: &Block, turning: L, poses: &mut [Row]) {
    let constants = &block.constants;
    let center = Vec3x8::<L>::load(&block.center);
    let root = Vec3x8::<L>::load(&constants.inverse_root_inertia);
    let mass = L::load(&constants.inverse_mass);
    let response = L::load(&constants.response);
    let first = L::transpose([center.x, center.y, center.z, mass, root.x, root.y, root.z, response]);
    let [e0, e1, _] = block.axes_now::<L>().0;
    let reach = L::load(&constants.reach);
    let second = L::transpose([e0.x, e0.y, e0.z, e1.x, e1.y, e1.z, turning, reach]);
    for (lane, pose) in poses.chunks_exact_mut(2).enumerate() {
        first[lane].store(&mut pose[0]);
        second[lane].store(&mut pose[1]);
    }
}
