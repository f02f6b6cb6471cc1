//! All engines on all scenes in turns, and what is said of each phase.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::Failure;
use crate::engine::Contender;
use crate::judge::Verdict;
use crate::measure::{Run, Running, STOPS};
use crate::scene::Scene;

/// What is to be run.
pub(crate) struct Plan {
    pub(crate) scenes: Vec<Scene>,
    pub(crate) contenders: Vec<Contender>,
    pub(crate) repeats: u32,
}

/// All runs of one engine on one scene.
pub(crate) struct Series {
    /// Number of bodies.
    pub(crate) n: usize,
    pub(crate) contender: Contender,
    pub(crate) runs: Vec<Run>,
}

/// A part of a run that ends at a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Phase {
    pub(crate) name: &'static str,
    /// Index of the first and of the last stop that belong to it.
    stops: [usize; 2],
}

/// Bodies fly and collide.
pub(crate) const FLYING: Phase = Phase { name: "flying", stops: [0, 0] };
/// They lie, more or less.
pub(crate) const SETTLED: Phase = Phase { name: "settled", stops: [1, 2] };
/// The first part of that.
pub(crate) const EARLY: Phase = Phase { name: "early", stops: [1, 1] };
/// The rest of it.
pub(crate) const LATE: Phase = Phase { name: "late", stops: [2, 2] };

/// What is said of an engine in a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Summary {
    /// CPU time per step in ms, median of the runs.
    pub(crate) milliseconds: f64,
    /// The same of the fastest run: nearest to what an idle machine takes.
    pub(crate) fastest: f64,
    /// The deepest at any stop of the phase in any run, in mm.
    pub(crate) max_mm: f64,
    /// The greatest mean at any stop of the phase in any run, in mm.
    pub(crate) mean_mm: f64,
    /// Kinetic energy at the phase's end, mean over the bodies, the greatest of all runs, in J/kg.
    pub(crate) energy: f64,
    /// Bodies that are outside the room or not finite at the phase's end, the most of all runs.
    pub(crate) lost: usize,
}

impl Phase {
    /// First step and the one after the last.
    pub(crate) fn steps(self) -> [usize; 2] {
        let [first, last] = self.stops;
        [first.checked_sub(1).map_or(0, |before| STOPS[before]), STOPS[last]]
    }
}

impl Series {
    /// What these runs say of a phase.
    pub(crate) fn summary(&self, phase: Phase) -> Summary {
        let [first, last] = phase.stops;
        let [begin, end] = phase.steps();
        let per_step = |run: &Run| run.milliseconds[first..=last].iter().sum::<f64>() / (end - begin) as f64;
        let mut times: Vec<f64> = self.runs.iter().map(per_step).collect();
        times.sort_by(f64::total_cmp);
        let worst = |value: fn(&Verdict) -> f64, from: usize| {
            let judged = self.runs.iter().flat_map(|run| &run.verdicts[from..=last]);
            judged.map(value).fold(0.0, f64::max)
        };
        Summary {
            milliseconds: median(&times),
            fastest: times[0],
            max_mm: 1e3 * worst(|verdict| verdict.max_depth, first),
            mean_mm: 1e3 * worst(|verdict| verdict.mean_depth, first),
            energy: worst(|verdict| verdict.energy, last),
            lost: worst(|verdict| (verdict.escaped + verdict.non_finite) as f64, last) as usize,
        }
    }
}

/// Of ascending values, at least one.
pub(crate) fn median(values: &[f64]) -> f64 {
    let upper = values.len() / 2;
    0.5 * (values[upper] + values[(values.len() - 1) / 2])
}

/// Steps that an engine simulates before it is the next one's turn. The machine's moods last longer and so meet all
/// alike; what an engine must fetch back into the caches is little beside so many steps.
const TURN: usize = 60;

/// Runs everything, scene by scene, the engines in turns.
pub(crate) fn compare(plan: &Plan) -> Result<Vec<Series>, Failure> {
    let bodies: usize = plan.scenes.iter().map(|scene| scene.bodies.len()).sum();
    let runs = plan.contenders.len() * plan.repeats as usize;
    let bar = progress((bodies * runs * STOPS[STOPS.len() - 1]) as u64);
    let mut all = Vec::new();
    for scene in &plan.scenes {
        let n = scene.bodies.len();
        let start = |&contender: &Contender| Series { n, contender, runs: Vec::new() };
        let mut series: Vec<Series> = plan.contenders.iter().map(start).collect();
        for repeat in 1..=plan.repeats {
            bar.set_message(format!("{n} bodies, {repeat} of {}", plan.repeats));
            let runs = repeat_all(scene, &plan.contenders, &|| bar.inc(n as u64))?;
            series.iter_mut().zip(runs).for_each(|(series, run)| series.runs.push(run));
        }
        all.append(&mut series);
    }
    bar.finish_and_clear();
    Ok(all)
}

/// One run of each engine.
fn repeat_all(scene: &Scene, contenders: &[Contender], told: &dyn Fn()) -> Result<Vec<Run>, Failure> {
    let begin = contenders.iter().map(|&contender| Running::new(contender, scene));
    let mut running = begin.collect::<Result<Vec<_>, _>>()?;
    let mut going = true;
    while going {
        going = false;
        for one in &mut running {
            going |= one.advance(TURN, told)?;
        }
    }
    Ok(running.into_iter().map(Running::finish).collect())
}

/// A bar on standard error, if that is a terminal; it counts bodies × steps, which time goes with.
pub(crate) fn progress(total: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr_with_hz(4));
    // The template is fixed: if it were wrong, the bar would look plainer.
    let style = ProgressStyle::with_template("{msg:24} {bar:32} {percent:>3} %  {elapsed}, {eta} to go")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.with_style(style)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(max_depth: f64, energy: f64) -> Verdict {
        Verdict { max_depth, mean_depth: 0.1 * max_depth, contacts: 1, energy, escaped: 0, non_finite: 0 }
    }

    #[test]
    fn phases_take_the_median_time_and_the_worst_depth() {
        let run = |scale: f64| Run {
            milliseconds: [120.0 * scale, 360.0 * scale, 300.0 * scale],
            verdicts: vec![verdict(0.003, 9.0), verdict(0.002 * scale, 8.0), verdict(0.001, 0.5)],
        };
        let runs = [1.0, 5.0, 2.0].map(run).to_vec();
        let series = Series { n: 1, contender: Contender::Rapier, runs };
        let flying = series.summary(FLYING);
        assert_eq!((flying.milliseconds, flying.fastest, flying.max_mm), (2.0, 1.0, 3.0));
        let settled = series.summary(SETTLED);
        assert_eq!((settled.milliseconds, settled.energy), (2.75, 0.5));
        assert!((settled.max_mm - 10.0).abs() < 1e-9 && (settled.mean_mm - 1.0).abs() < 1e-9);
        assert_eq!(series.summary(EARLY).milliseconds, 4.0);
        assert_eq!(series.summary(LATE).max_mm, 1.0);
    }

    #[test]
    fn a_median_of_an_even_number_is_between_the_middle_two() {
        assert_eq!(median(&[3.0]), 3.0);
        assert_eq!(median(&[1.0, 2.0, 4.0, 9.0]), 3.0);
    }

    #[test]
    fn phases_cover_all_steps() {
        assert_eq!(
            [FLYING, SETTLED, EARLY, LATE].map(Phase::steps),
            [[0, 120], [120, 600], [120, 300], [300, 600]]
        );
    }
}
