//! The long form of `tests/cloth_trials.rs`: how often cloth passes through itself, trial by trial.
//!
//! `cargo bench -p tautline-scene --bench cloth_trials -- --n 20,30,40 --seeds 20 --only heap,fold`

use std::process::ExitCode;
use std::time::Instant;

use tautline::Settings;
use tautline_scene::cloth_trials::{Found, Trial};

struct Plan {
    resolutions: Vec<u32>,
    seeds: u64,
    trials: Vec<Trial>,
}

fn main() -> ExitCode {
    let plan = match plan(std::env::args().skip(1)) {
        Ok(plan) => plan,
        Err(problem) => {
            eprintln!("{problem}; options: --n 20,30,40 --seeds 20 --only cube,heap,fold,settle,pair");
            return ExitCode::FAILURE;
        }
    };
    let mut passed = true;
    println!("trial     n  free at end  worst  (seed, step)   stretch max/mean %   fastest m/s   ms/step");
    for &n in &plan.resolutions {
        for &trial in &plan.trials {
            passed &= run(trial, n, plan.seeds);
        }
    }
    if passed { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Prints a line and says whether the demands hold: free at the end, and at most two on the way; at 100 × 100 only the
/// end counts.
fn run(trial: Trial, n: u32, seeds: u64) -> bool {
    let start = Instant::now();
    let found: Result<Vec<Found>, _> =
        (0..seeds).map(|seed| trial.run(n, seed, Settings::default())).collect();
    let found = match found {
        Ok(found) => found,
        Err(error) => {
            println!("{:6} {n:4}  {error}", trial.name());
            return false;
        }
    };
    let milliseconds = 1e3 * start.elapsed().as_secs_f64() / (seeds as f64 * trial.steps() as f64);
    let free = found.iter().filter(|found| found.at_end == 0).count();
    let worst = found.iter().zip(0u64..).max_by_key(|(found, seed)| (found.worst, u64::MAX - seed));
    let (worst, seed, step) = worst.map_or((0, 0, 0), |(found, seed)| (found.worst, seed, found.worst_step));
    let largest = |of: fn(&Found) -> f64| found.iter().map(of).fold(0.0, f64::max);
    println!(
        "{:6} {n:4}  {free:4} of {seeds:2}  {worst:6}  ({seed:2}, {step:3})  {:12.2} {:7.3}  {:13.3}  {milliseconds:9.2}",
        trial.name(),
        100.0 * largest(|found| found.stretch.max),
        100.0 * largest(|found| found.stretch.mean),
        largest(|found| found.mean_speed),
    );
    free == found.len() && (worst <= 2 || n >= 100)
}

fn plan(mut arguments: impl Iterator<Item = String>) -> Result<Plan, String> {
    let mut plan = Plan { resolutions: vec![20, 30, 40], seeds: 20, trials: Trial::ALL.to_vec() };
    while let Some(name) = arguments.next() {
        // Cargo says so to every benchmark.
        if name == "--bench" {
            continue;
        }
        let value = arguments.next().ok_or(format!("{name} has no value"))?;
        let number = |text: &str| text.parse::<u32>().map_err(|error| format!("{name} {text}: {error}"));
        match name.as_str() {
            "--n" => plan.resolutions = value.split(',').map(number).collect::<Result<_, _>>()?,
            "--seeds" => plan.seeds = number(&value)?.into(),
            "--only" => plan.trials = value.split(',').map(trial).collect::<Result<_, _>>()?,
            _ => return Err(format!("{name} is no option")),
        }
    }
    Ok(plan)
}

fn trial(name: &str) -> Result<Trial, String> {
    Trial::ALL.into_iter().find(|trial| trial.name() == name).ok_or(format!("{name} is no trial"))
}
