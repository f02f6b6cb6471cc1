//! The beginning of a substep: forces, and the multipliers of the last one, are added to velocities.

use glam::Vec3;

use super::crew::{Crew, Squad, Timing};
use super::lineup::Lineup;
use crate::simd::{Kernel, LANES, Lanes, Row, run};

impl Crew {
    /// Writes out what forces add in a substep, if gravity is the only one.
    pub(super) fn write_kicks(&mut self, timing: &Timing) {
        if self.kicks.is_empty() {
            let [x, y, z, ..] = gravity(timing).0;
            let scales = self.blocks.iter().flat_map(|block| block.constants.gravity_scale.0);
            let kick = |scale: f32| Row([x * scale, y * scale, z * scale, 0.0, 0.0, 0.0, 0.0, 0.0]);
            self.kicks.extend(scales.map(kick));
        }
    }

    /// Adds what forces and contacts do in a substep.
    pub(super) fn kick(&mut self, lineup: &Lineup, timing: &Timing, is_first: bool) {
        let gravity = gravity(timing);
        self.for_each(lineup, lineup.stripes(), |squad| {
            run(timing.instructions, Kick { squad, gravity, is_first });
        });
    }
}

/// What gravity adds to the velocity of a body whose scale is 1, in a substep.
fn gravity(timing: &Timing) -> Row {
    let Vec3 { x, y, z } = timing.gravity * (timing.h * timing.h);
    Row([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// What has changed since the last time is what the contacts did; it is done again, until it changes again.
struct Kick<'a, 'b> {
    squad: &'a mut Squad<'b>,
    gravity: Row,
    is_first: bool,
}

impl Kernel for Kick<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Squad { blocks, poses, velocities, accumulated, kicks, .. } = self.squad;
        let gravity = L::load(&self.gravity);
        let chunks = velocities.chunks_exact_mut(LANES).zip(accumulated.chunks_exact_mut(LANES));
        for (i, ((velocities, accumulated), poses)) in
            chunks.zip(poses.chunks_exact_mut(2 * LANES)).enumerate()
        {
            let scales = &blocks[i].constants.gravity_scale.0;
            let kicks = kicks.get(i * LANES..(i + 1) * LANES);
            let before = &mut poses[..LANES];
            for lane in 0..LANES {
                let now = L::load(&velocities[lane]);
                let mut sum = L::load(&accumulated[lane]);
                if !self.is_first {
                    sum = sum + (now - L::load(&before[lane]));
                    sum.store(&mut accumulated[lane]);
                }
                let kick = match kicks {
                    Some(kicks) => L::load(&kicks[lane]),
                    None => gravity * L::splat(scales[lane]),
                };
                let kicked = now + sum + kick;
                kicked.store(&mut velocities[lane]);
                kicked.store(&mut before[lane]);
            }
        }
    }
}
