use super::*;
use crate::simd::Kernel;
use crate::solver::soft::points::Coordinates;
use crate::solver::soft::tests::{cloud, farthest, in_f64, moved, on_all, relax_in_f64, weights};

const PLACES: usize = 96;

struct Run((usize, usize, usize), Span, usize);

impl Kernel for Run {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let Self(run, span, seed) = self;
        moved(cloud(PLACES, seed), |moving| {
            let masses = weights(PLACES);
            relax_runs(&mut Knots::of(moving, &masses), run, (1, 0), Spans::<L>::splat(span));
        })
    }
}

/// Runs from before and from behind, of all lengths: also those that are no multiple of eight.
#[test]
fn a_run_is_its_sticks_one_by_one() {
    let spans = [(0.7, 0.7, 0.0), (0.4, 0.9, 0.0), (0.5, 0.5, 2.0)];
    for count in 0..=25 {
        for (a, b) in [(0, 32), (32, 0), (3, 28), (41, 9)] {
            for (low, high, compliance) in spans {
                let span = Span { low, high, compliance };
                let mut expected = in_f64(&cloud(PLACES, count));
                let still = expected.clone();
                for k in 0..count {
                    relax_in_f64(
                        &mut expected,
                        &still,
                        &weights(PLACES),
                        [a + k, b + k],
                        [low, high, compliance],
                    );
                }
                let relaxed = on_all(|| Run((a, b, count), span, count));
                assert!(farthest(&relaxed, &expected) < 1e-6, "{count} from {a} to {b}");
                let outside =
                    |place: usize| !(a..a + count).contains(&place) && !(b..b + count).contains(&place);
                let relaxed = in_f64(&relaxed);
                assert!((0..PLACES).filter(|&k| outside(k)).all(|k| relaxed[k] == still[k]));
            }
        }
    }
}

#[test]
fn what_is_within_its_span_or_held_stays_to_the_bit() {
    let run = (0, 32, 20);
    let (before, masses) = (in_f64(&cloud(PLACES, 1)), weights(PLACES));
    let after = in_f64(&on_all(|| Run(run, Span { low: 0.5, high: 1.5, compliance: 0.0 }, 1)));
    let mut kept = 0;
    for k in 0..20 {
        let length = before[k].distance(before[32 + k]);
        let is_kept = (0.501..1.499).contains(&length);
        kept += usize::from(is_kept);
        assert!(!is_kept || (after[k], after[32 + k]) == (before[k], before[32 + k]), "{length}");
        assert!(
            length < 1.501 || masses[k] + masses[32 + k] == 0.0 || after[k] != before[k] || masses[k] == 0.0
        );
    }
    assert!((3..18).contains(&kept), "{kept} of 20 are within: this shows little");
    assert!((0..PLACES).filter(|&k| masses[k] == 0.0).all(|k| after[k] == before[k]));
}

struct EachItsOwn;

impl Kernel for EachItsOwn {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let rows: &[[Row; 3]] = &spans();
        moved(cloud(PLACES, 2), |moving| {
            for stick in 0..rows.len() {
                let ends = [stick * LANES, (stick + 1) * LANES];
                let spans: Spans<L> = rows.span(stick);
                relax_spans(moving, &weights(PLACES), ends, spans);
            }
        })
    }
}

fn spans() -> [[Row; 3]; 6] {
    let row =
        |k: usize, from: f32, step: f32| Row(std::array::from_fn(|j| from + step * ((3 * k + j) % 7) as f32));
    std::array::from_fn(|k| [row(k, 0.1, 0.05), row(k, 0.5, 0.1), row(k, 0.0, 0.3)])
}

#[test]
fn sticks_with_spans_of_their_own_are_relaxed_to_these() {
    let start = in_f64(&cloud(PLACES, 2));
    let mut expected = start.clone();
    for (stick, rows) in spans().iter().enumerate() {
        for lane in 0..LANES {
            let ends = [stick, stick + 1].map(|k| k * LANES + lane);
            let span = rows.each_ref().map(|row| row.0[lane]);
            relax_in_f64(&mut expected, &start, &weights(PLACES), ends, span);
        }
    }
    assert!(farthest(&on_all(|| EachItsOwn), &expected) < 2e-6);
}
