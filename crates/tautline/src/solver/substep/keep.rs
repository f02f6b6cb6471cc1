//! The end of a step, for contacts: their multipliers are kept for the next one, and the anchors of what has slid follow.

use super::RigidSolver;
use super::batch::{Batch, PointRows};
use super::group::{Group, Groups};
use super::held::Held;
use super::pairs::Detail;
use crate::parallel;
use crate::settings::Settings;
use crate::simd::{Kernel, LANES, Lanes, Row, run};

/// From so many pairs on it pays to do them side by side.
const WORTHWHILE: usize = 1024;

impl RigidSolver {
    /// Writes the multipliers to the contacts that they are of.
    pub(super) fn keep_multipliers(&mut self, settings: &Settings) {
        self.groups.iter_mut().filter(|group| !group.is_empty()).for_each(Group::forget_blows);
        let (groups, details) = (&self.groups, &mut self.pairs.details);
        let worthwhile = parallel::is_worthwhile(details.len(), WORTHWHILE);
        // Every run goes through all batches, so there are not more than threads.
        let runs = if worthwhile { parallel::threads() } else { 1 };
        let length = details.len().div_ceil(runs).max(1);
        let mut runs: Vec<_> = (0..).step_by(length).zip(details.chunks_mut(length)).collect();
        parallel::for_each(&mut runs, worthwhile, |(first, details)| {
            run(settings.instructions, Keep { groups, first: *first, details });
        });
    }
}

/// To a run of pairs, of which the first has this number.
struct Keep<'a> {
    groups: &'a Groups,
    first: u32,
    details: &'a mut [Detail],
}

impl Kernel for Keep<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { groups, first, details } = self;
        for Group { batches, points, .. } in groups.iter().filter(|group| !group.is_empty()) {
            for batch in batches {
                keep::<L>(batch, &points[batch.range()], (first, details));
            }
        }
    }
}

/// The multipliers of a batch.
#[inline(always)]
fn keep<L: Lanes>(batch: &Batch, points: &[PointRows], (first, details): (u32, &mut [Detail])) {
    let mut indices = [usize::MAX; LANES];
    let mut is_any = false;
    for (index, pair) in indices.iter_mut().zip(&batch.pairs) {
        // Of another run, or of no pair, it is none of these.
        *index = pair.wrapping_sub(first) as usize;
        is_any |= *index < details.len();
    }
    if !is_any {
        return;
    }
    for (number, two) in points.chunks(2).enumerate() {
        let mut before = [Held::header(None); LANES];
        for lane in 0..LANES {
            let held = details.get(indices[lane]).and_then(|detail| detail.held.as_ref());
            before[lane] = Held::friction_of_two(held, number);
        }
        let friction = L::transpose(friction(two, L::gather(before)));
        for lane in 0..LANES {
            let held = details.get_mut(indices[lane]).and_then(|detail| detail.held.as_mut());
            if let Some(held) = held {
                let mut row = Row::ZERO;
                friction[lane].store(&mut row);
                held.keep_two(number, two.iter().map(|rows| rows.normal_impulse.0[lane]), row);
            }
        }
    }
}

/// The columns of the friction of one or two points, given those of when the step began: see `HeldPoint`.
#[inline(always)]
fn friction<L: Lanes>(points: &[PointRows], mut columns: [L; LANES]) -> [L; LANES] {
    for (rows, columns) in points.iter().zip(columns.chunks_exact_mut(4)) {
        for axis in 0..2 {
            columns[axis] = columns[axis] - L::load(&rows.slid[axis]);
            columns[2 + axis] = L::load(&rows.tangent_impulses[axis]);
        }
    }
    columns
}
