//! The end of a step, for contacts: their multipliers are kept for the next one, and the anchors of what has slid follow.

use super::RigidSolver;
use super::batch::{Batch, HeaderRows, PointRows};
use super::group::{Group, Groups};
use super::held::Held;
use super::pairs::Detail;
use crate::parallel;
use crate::settings::Settings;
use crate::simd::{Kernel, LANES, Lanes, Vec3x8, run};

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
        for Group { batches, headers, points, .. } in groups.iter().filter(|group| !group.is_empty()) {
            for (batch, header) in batches.iter().zip(headers) {
                keep::<L>(batch, header, &points[batch.range()], (first, details));
            }
        }
    }
}

/// The multipliers of a batch.
#[inline(always)]
fn keep<L: Lanes>(
    batch: &Batch,
    header: &HeaderRows,
    points: &[PointRows],
    (first, details): (u32, &mut [Detail]),
) {
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
    let tangents = [Vec3x8::<L>::load(&header.tangents[0]), Vec3x8::load(&header.tangents[1])];
    for (k, rows) in points.iter().enumerate() {
        let mut before = [Held::header(None); LANES];
        for lane in 0..LANES {
            let held = details.get(indices[lane]).and_then(|detail| detail.held.as_ref());
            [_, before[lane]] = Held::rows_of_point(held, k);
        }
        let [x, y, z, ..] = L::gather(before);
        let friction = L::transpose(friction(&tangents, rows, Vec3x8::new(x, y, z)));
        for lane in 0..LANES {
            let held = details.get_mut(indices[lane]).and_then(|detail| detail.held.as_mut());
            if let Some([anchors, row]) = held.and_then(|held| held.rows_of_point_mut(k)) {
                anchors.0[3] = rows.normal_impulse.0[lane];
                friction[lane].store(row);
            }
        }
    }
}

/// The columns of the points' friction, see `HeldPoint`, given what had slid when the step began.
#[inline(always)]
fn friction<L: Lanes>(tangents: &[Vec3x8<L>; 2], rows: &PointRows, slip: Vec3x8<L>) -> [L; LANES] {
    let [first, second] = tangents;
    let pull = *first * L::load(&rows.tangent_impulses[0]) + *second * L::load(&rows.tangent_impulses[1]);
    let slip = slip - *first * L::load(&rows.slid[0]) - *second * L::load(&rows.slid[1]);
    let zero = L::splat(0.0);
    [slip.x, slip.y, slip.z, zero, pull.x, pull.y, pull.z, zero]
}
