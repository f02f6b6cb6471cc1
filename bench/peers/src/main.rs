//! tautline, rapier3d and Box3D on the same scenes, in turns: how long a step takes, how deep bodies penetrate, how
//! much cloth is stretched and tangled, how much moves at rest. README.md says what is compared and what building it takes.

mod args;
mod box3d;
mod canvas;
mod chart;
mod cloth;
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
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use serde_json::Map;
use tautline_scene::export::{check_writable, write_atomically};

use args::Arguments;
use canvas::Picture;

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
    let charts = arguments.chart.as_deref().map(|file| (file.to_owned(), cloth_chart(file)));
    let chart_files =
        charts.iter().flat_map(|(bodies, cloth)| [bodies, cloth]).flat_map(|file| canvas::files(file));
    // A comparison takes minutes: better refused before than after.
    for file in arguments.json.iter().cloned().chain(chart_files) {
        check_writable(&file)?;
    }
    let (plan, cloth_plan) = (arguments.plan()?, arguments.cloth_plan()?);
    // One thread for all: tautline spreads its work over the pool that a step is called from.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut json = Map::new();
    if !plan.scenes.is_empty() {
        let results = pool.install(|| compare::compare(&plan))?;
        print!("{}", report::table(&results));
        json.insert("e1".into(), report::json_rows(&results).into());
        if let Some((file, _)) = &charts {
            write_chart(&chart::chart(&results), file)?;
        }
    }
    if !cloth_plan.supports.is_empty() {
        let results = pool.install(|| cloth::compare(&cloth_plan))?;
        print!("{}", cloth::table(&results));
        for &support in &cloth_plan.supports {
            json.insert(support.key().into(), cloth::json_rows(&results, support).into());
        }
        if let Some((_, file)) = &charts {
            write_chart(&cloth::chart(&results), file)?;
        }
    }
    if let Some(file) = &arguments.json {
        write_text(file, &(serde_json::to_string_pretty(&json)? + "\n"))?;
    }
    Ok(())
}

/// `peers.svg` → `peers-cloth.svg`.
fn cloth_chart(file: &Path) -> PathBuf {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    file.with_file_name(format!("{stem}-cloth.svg"))
}

fn write_chart(picture: &impl Picture, file: &Path) -> Result<(), Failure> {
    let [svg, png] = canvas::files(file);
    write_text(&svg, &canvas::svg(picture)?)?;
    canvas::write_png(picture, &png)
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let at_path = |source| tautline_scene::Error::Io { path: path.to_owned(), source };
    Ok(write_atomically(path, |file| file.write_all(text.as_bytes()).map_err(at_path))?)
}
