//! The end of a step: particles are written.
//!
//! What is written to is in the order of the bodies, what is read in that of places: so runs of bodies are done side by
//! side, and each looks up where its own is.

use glam::Vec3;

use super::block::ParticleRows;
use super::crew::Written;
use super::lineup::Lineup;
use super::{Lost, RigidSolver};
use crate::body::Body;
use crate::parallel;
use crate::particles::{Particles, is_within_reach};
use crate::settings::Settings;
use crate::simd::LANES;

/// From so many bodies on it pays to do them side by side, …
const WORTHWHILE: usize = 1024;
/// … so many at a time.
const CHUNK: usize = 256;
/// Blocks that are written at a time.
const BLOCKS: usize = 32;

/// Bodies that follow each other, with their particles.
struct Run<'a> {
    /// The number of the first body, and of its first particle.
    first: (usize, usize),
    bodies: &'a mut [Body],
    positions: &'a mut [Vec3],
    displacements: &'a mut [Vec3],
    lost: Vec<Lost>,
}

impl RigidSolver {
    /// Writes the particles, and keeps the multipliers for the next step. A body that has left all reach stays where it
    /// was, and is told of.
    pub(crate) fn finish(
        &mut self,
        bodies: &mut [Body],
        particles: &mut Particles,
        settings: &Settings,
        h: f32,
    ) -> Vec<Lost> {
        if self.is_hasty {
            self.crew.calm(&self.lineup, settings.instructions);
        }
        self.land(&self.timing(settings, h));
        self.sweep(settings.instructions);
        self.listener.finish(&self.groups, &self.pairs);
        self.keep_multipliers(settings);
        let worthwhile = parallel::is_worthwhile(bodies.len(), WORTHWHILE);
        let mut written = vec![Written::NOTHING; self.lineup.solved / LANES];
        let mut tasks: Vec<_> = (0..).step_by(BLOCKS).zip(written.chunks_mut(BLOCKS)).collect();
        parallel::for_each(&mut tasks, worthwhile, |(first, written)| {
            for (block, written) in (*first..).zip(written.iter_mut()) {
                *written = self.crew.particles_of(block, settings.instructions);
            }
        });
        let mut runs = runs(bodies, particles);
        parallel::for_each(&mut runs, worthwhile, |run| run.write(&self.lineup, &written, h));
        let lost = runs.into_iter().flat_map(|run| run.lost).collect();
        self.note_flights(bodies, particles);
        lost
    }
}

/// All bodies in runs. Their particles follow each other as they do.
fn runs<'a>(bodies: &'a mut [Body], particles: &'a mut Particles) -> Vec<Run<'a>> {
    let (mut positions, mut displacements) = (&mut particles.position[..], &mut particles.displacement[..]);
    let (mut start, mut runs) = (0, Vec::with_capacity(bodies.len().div_ceil(CHUNK)));
    for (number, bodies) in bodies.chunks_mut(CHUNK).enumerate() {
        let count = bodies.iter().map(|body| body.particles.len()).sum();
        let (own_positions, other_positions) = positions.split_at_mut(count);
        let (own_displacements, other_displacements) = displacements.split_at_mut(count);
        (positions, displacements) = (other_positions, other_displacements);
        runs.push(Run {
            first: (number * CHUNK, start),
            bodies,
            positions: own_positions,
            displacements: own_displacements,
            lost: Vec::new(),
        });
        start += count;
    }
    runs
}

impl Run<'_> {
    fn write(&mut self, lineup: &Lineup, written: &[Written], h: f32) {
        let (first_body, first_particle) = self.first;
        for (index, body) in (first_body..).zip(self.bodies.iter_mut()) {
            let Some(place) = lineup.place_of_motion(index) else { continue };
            let (Written { positions, displacements, within_reach }, lane) =
                (&written[place / LANES], place % LANES);
            let vector = |rows: &ParticleRows, k: usize| {
                Vec3::new(rows[3 * k].0[lane], rows[3 * k + 1].0[lane], rows[3 * k + 2].0[lane])
            };
            let moved: [[Vec3; 2]; 4] =
                std::array::from_fn(|k| [vector(positions, k), vector(displacements, k)]);
            if within_reach >> lane & 1 == 0 {
                let particle = moved.iter().position(|&[x, d]| !is_within_reach(x, d));
                self.lost.push(Lost { body: index, particle: particle.unwrap_or(0) as u32 });
                continue;
            }
            let start = body.particles.start - first_particle;
            for (i, [position, displacement]) in (start..).zip(moved) {
                self.positions[i] = position;
                self.displacements[i] = displacement;
            }
            body.previous_step = h;
        }
    }
}
