//! All engines on all scenes in turns, and what is said of each.

use indicatif::ProgressBar;

use super::engine::Contender;
use super::judge::Verdict;
use super::measure::{Run, Running, STEPS};
use super::scene::{Start, Support};
use crate::Failure;
use crate::compare::{median, progress};

/// What is to be run.
pub(crate) struct Plan {
    pub(crate) supports: Vec<Support>,
    /// Particles along each side of the cloth.
    pub(crate) resolutions: Vec<u32>,
    pub(crate) contenders: Vec<Contender>,
    /// How many starts, each with noise of its own.
    pub(crate) starts: u32,
}

/// All runs of one engine on one scene.
pub(crate) struct Series {
    pub(super) support: Support,
    pub(super) n: u32,
    pub(super) contender: Contender,
    pub(super) runs: Vec<Run>,
}

/// What is said of an engine on a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Summary {
    /// CPU time per step in ms, median of the starts.
    pub(super) milliseconds: f64,
    /// The same of the fastest run: nearest to what an idle machine takes.
    pub(super) fastest: f64,
    /// At the end, each the median of the starts, in %.
    pub(super) max_stretch: f64,
    pub(super) mean_stretch: f64,
    /// The largest of an edge at any judgement of any start, in %.
    pub(super) worst_stretch: f64,
    /// The most at the end, and at any judgement, of any start.
    pub(super) intersections: usize,
    pub(super) worst_intersections: usize,
    /// The deepest at the end, of any start, in mm.
    pub(super) depth_mm: f64,
    /// The most at the end of any start.
    pub(super) rope_pierces: usize,
    /// The largest at the end of any start, in %.
    pub(super) rope_stretch: f64,
    /// At the end, the fastest of all starts, in m/s.
    pub(super) mean_speed: f64,
    /// At the end, the lowest of all starts, in m.
    pub(super) mean_height: f64,
    /// Whether it is up at the end of every start.
    pub(super) is_held: bool,
}

impl Series {
    /// What these runs say.
    pub(super) fn summary(&self) -> Summary {
        let times = sorted(self.runs.iter().map(|run| run.milliseconds / STEPS as f64));
        let ends = || self.runs.iter().filter_map(|run| run.verdicts.last());
        let all = || self.runs.iter().flat_map(|run| &run.verdicts);
        let percent = |of: fn(&Verdict) -> f64| 100.0 * median(&sorted(ends().map(of)));
        let end = |of: fn(&Verdict) -> f64| largest(ends().map(of));
        Summary {
            milliseconds: median(&times),
            fastest: times[0],
            max_stretch: percent(|verdict| verdict.max_stretch),
            mean_stretch: percent(|verdict| verdict.mean_stretch),
            worst_stretch: 100.0 * largest(all().map(|verdict| verdict.max_stretch)),
            intersections: ends().map(|verdict| verdict.intersections).max().unwrap_or(0),
            worst_intersections: all().map(|verdict| verdict.intersections).max().unwrap_or(0),
            depth_mm: 1e3 * end(|verdict| verdict.depth),
            rope_pierces: ends().map(|verdict| verdict.rope_pierces).max().unwrap_or(0),
            rope_stretch: 100.0 * end(|verdict| verdict.rope_stretch),
            mean_speed: end(|verdict| verdict.mean_speed),
            mean_height: -end(|verdict| -verdict.mean_height),
            is_held: ends().all(|verdict| verdict.is_held),
        }
    }
}

/// Ascending, what is no number last.
fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.map(|value| if value.is_nan() { f64::NAN } else { value }).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Not a number if one is not.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    sorted(values).last().copied().unwrap_or(0.0)
}

/// Steps that an engine simulates before it is the next one's turn.
const TURN: usize = 20;

/// Runs everything, scene by scene, the engines in turns.
pub(crate) fn compare(plan: &Plan) -> Result<Vec<Series>, Failure> {
    let scenes =
        || plan.supports.iter().flat_map(|&support| plan.resolutions.iter().map(move |&n| (support, n)));
    let runs_of =
        |n: u32| plan.contenders.iter().map(move |c| u64::from(c.starts(n, plan.starts))).sum::<u64>();
    let weight = |n: u32| u64::from(n) * u64::from(n);
    let bar = progress(scenes().map(|(_, n)| weight(n) * runs_of(n) * STEPS as u64).sum());
    let mut all = Vec::new();
    for (support, n) in scenes() {
        let empty = |&contender: &Contender| Series { support, n, contender, runs: Vec::new() };
        let mut series: Vec<Series> = plan.contenders.iter().map(empty).collect();
        for seed in 0..plan.starts {
            bar.set_message(format!("{} {n} × {n}, {} of {}", support.key(), seed + 1, plan.starts));
            let start = Start { support, n, seed: seed.into() };
            run_all(&mut series, &start, plan.starts, &bar)?;
        }
        all.append(&mut series);
    }
    bar.finish_and_clear();
    Ok(all)
}

/// One run of each engine that still has to run.
fn run_all(series: &mut [Series], start: &Start, asked: u32, bar: &ProgressBar) -> Result<(), Failure> {
    let due = |series: &&mut Series| start.seed < series.contender.starts(start.n, asked).into();
    let mut due: Vec<&mut Series> = series.iter_mut().filter(due).collect();
    let begin = due.iter().map(|series| Running::new(series.contender, start));
    let mut running = begin.collect::<Result<Vec<_>, _>>()?;
    let told = || bar.inc(u64::from(start.n) * u64::from(start.n));
    let mut going = true;
    while going {
        going = false;
        for one in &mut running {
            going |= one.advance(TURN, &told)?;
        }
    }
    due.iter_mut().zip(running).for_each(|(series, one)| series.runs.push(one.finish()));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::engine::Make;
    use super::*;

    fn series(stretches: [[f64; 2]; 3]) -> Series {
        let run = |stretches: [f64; 2]| {
            let verdict = |max_stretch: f64| Verdict {
                max_stretch,
                intersections: (100.0 * max_stretch) as usize,
                is_held: max_stretch < 0.5,
                ..Verdict::default()
            };
            Run { milliseconds: 300.0 * stretches[0], verdicts: stretches.map(verdict).to_vec() }
        };
        let contender = Contender { make: Make::Ours, self_collision: true };
        Series { support: Support::Cube, n: 20, contender, runs: stretches.map(run).to_vec() }
    }

    #[test]
    fn medians_at_the_end_and_the_worst_of_all() {
        let found = series([[0.2, 0.03], [0.3, 0.01], [0.1, 0.02]]).summary();
        assert_eq!((found.milliseconds, found.fastest), (0.2, 0.1));
        assert_eq!((found.max_stretch, found.worst_stretch), (2.0, 30.0));
        assert_eq!((found.intersections, found.worst_intersections, found.is_held), (3, 30, true));
    }

    #[test]
    fn what_is_no_number_is_not_passed_over() {
        let found = series([[0.1, f64::NAN], [0.1, 0.02], [0.1, -f64::NAN]]).summary();
        assert!(found.max_stretch.is_nan() && found.worst_stretch.is_nan() && !found.is_held);
    }
}
