//! `tautline bench`: the time of a step, phase by phase.

use serde::Serialize;
use tautline_scene::document::Scene;
use tautline_scene::registry::scenes;
use tautline_scene::run::{PhaseMilliseconds, Run, RunOptions, RunSummary};

use crate::args::Bench;
use crate::failure::Failure;
use crate::output::{print, print_json, table};
use crate::progress::{bar, no_bar, tell};
use crate::scene::find;

/// Every repeat starts the scene anew: the work is the same each time, only the machine's mood differs.
const REPEATS: usize = 5;
const STEPS: u16 = 120;

#[derive(Debug, Serialize)]
struct Row {
    scene: String,
    bodies: usize,
    particles: usize,
    steps: u64,
    repeats: usize,
    ms_per_step: f64,
    ms_per_step_by_phase: PhaseMilliseconds,
}

pub(crate) fn bench(arguments: &Bench) -> Result<(), Failure> {
    let all = || scenes().iter().map(|scene| scene.name.to_owned()).collect();
    let names: Vec<String> = if arguments.scenes.is_empty() { all() } else { arguments.scenes.clone() };
    let documents: Result<Vec<Scene>, Failure> = names.iter().map(|name| find(name, &[])).collect();
    let bar = if arguments.json { no_bar() } else { bar("bench") };
    let mut rows = Vec::new();
    for (done, document) in documents?.iter().enumerate() {
        tell(&bar, done as u64, names.len() as u64);
        bar.set_message(document.name.clone());
        rows.push(measure(document)?);
    }
    bar.finish_and_clear();
    if arguments.json { print_json(&rows) } else { print(&text(&rows)) }
}

/// The median of some runs from the scene's start.
fn measure(document: &Scene) -> Result<Row, Failure> {
    let options = RunOptions { seconds: Some(f32::from(STEPS) * document.dt), record: false };
    let mut runs = Vec::new();
    for _ in 0..REPEATS {
        runs.push(Run::new(document.build()?, options)?.complete(&mut |_, _| ())?.summary);
    }
    runs.sort_by(|a, b| a.ms_per_step.total_cmp(&b.ms_per_step));
    let RunSummary { scene, bodies, particles, steps, ms_per_step, ms_per_step_by_phase, .. } =
        runs.swap_remove(REPEATS / 2);
    Ok(Row { scene, bodies, particles, steps, repeats: REPEATS, ms_per_step, ms_per_step_by_phase })
}

fn text(rows: &[Row]) -> String {
    let header = [
        "scene",
        "bodies",
        "particles",
        "ms/step",
        "integrate",
        "broad",
        "narrow",
        "separate",
        "relax",
        "solve",
        "steps/s",
    ];
    let cells = |row: &Row| {
        let phases = &row.ms_per_step_by_phase;
        let times = [
            row.ms_per_step,
            phases.integrate,
            phases.broad_phase,
            phases.narrow_phase,
            phases.separate,
            phases.relax,
            phases.solve,
        ];
        let mut cells = vec![row.scene.clone(), row.bodies.to_string(), row.particles.to_string()];
        cells.extend(times.map(|ms| format!("{ms:.4}")));
        cells.push(format!("{:.0}", 1e3 / row.ms_per_step));
        cells
    };
    let rows: Vec<Vec<String>> = rows.iter().map(cells).collect();
    format!("Median of {REPEATS} runs of {STEPS} steps from the start.\n{}", table(&header, &rows))
}
