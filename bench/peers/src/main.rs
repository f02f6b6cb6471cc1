//! tautline, rapier3d and Box3D on the same scenes, in turns: how long a step takes, how deep bodies penetrate, how
//! much they move at rest. README.md says what is compared and what building it takes.

mod args;
mod box3d;
mod chart;
mod compare;
mod engine;
mod icosahedron;
mod judge;
mod measure;
mod ours;
mod rapier;
mod report;
mod scene;

use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use tautline_scene::export::{check_writable, write_atomically};

use args::Arguments;

/// Whatever ends the comparison early.
type Failure = Box<dyn Error + Send + Sync>;

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let chart_files = arguments.chart.as_deref().map(chart::files);
    // A comparison takes minutes: better refused before than after.
    for file in arguments.json.iter().chain(chart_files.iter().flatten()) {
        check_writable(file)?;
    }
    let plan = arguments.plan()?;
    // One thread for all: tautline spreads its work over the pool that a step is called from.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let results = pool.install(|| compare::compare(&plan))?;
    print!("{}", report::table(&results));
    if let Some(file) = &arguments.json {
        write_text(file, &report::json(&results)?)?;
    }
    if let Some([svg, png]) = &chart_files {
        let bars = chart::panels(&results);
        write_text(svg, &chart::svg(&bars)?)?;
        chart::write_png(&bars, png)?;
    }
    Ok(())
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let at_path = |source| tautline_scene::Error::Io { path: path.to_owned(), source };
    Ok(write_atomically(path, |file| file.write_all(text.as_bytes()).map_err(at_path))?)
}
