//! `tautline run`: a scene to pictures, animations and statistics.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use tautline_scene::document::Scene;
use tautline_scene::export::{self, Format, Options, check_writable, frame_path};
use tautline_scene::render;
use tautline_scene::run::{Outcome, Run as SceneRun, RunOptions, RunSummary};

use crate::args::{Run, Size};
use crate::failure::Failure;
use crate::output::{counted, json, make_folder_of, print, write_text};
use crate::progress::{bar, begin, no_bar, tell};
use crate::scene::{find, use_solver};

pub(crate) fn run(arguments: &Run) -> Result<(), Failure> {
    let mut scene = find(&arguments.scene, &arguments.set)?;
    prepare(&arguments.out, &arguments.stats)?;
    if let Some(solver) = arguments.solver {
        use_solver(&mut scene, solver);
    }
    let bar = if arguments.json { no_bar() } else { bar(&scene.name) };
    let Run { seconds, out, size, .. } = arguments;
    let summary = in_pool(arguments.threads, || perform(&scene, *seconds, (out, *size), &bar))??;
    bar.finish_and_clear();
    let statistics = json(&summary)?;
    if let Some(path) = &arguments.stats {
        write_text(path, &statistics)?;
    }
    if arguments.json {
        return print(&statistics);
    }
    let files = arguments.out.iter().chain(&arguments.stats);
    print(&(describe(&summary) + &files.map(|path| describe_file(path)).collect::<String>()))
}

/// Runs a scene and writes what it looked like, in this size, to each of `files`, which have been prepared.
pub(crate) fn perform(
    scene: &Scene,
    seconds: Option<f32>,
    (files, size): (&[PathBuf], Option<Size>),
    bar: &ProgressBar,
) -> Result<RunSummary, Failure> {
    let options = RunOptions { seconds, record: !files.is_empty() };
    let run = SceneRun::new(scene.build()?, options)?;
    let outcome = run.complete(&mut |done, total| tell(bar, done, total))?;
    for path in files {
        begin(bar, path.display().to_string());
        export(&outcome, path, size, bar)?;
    }
    Ok(outcome.summary)
}

fn export(outcome: &Outcome, path: &Path, size: Option<Size>, bar: &ProgressBar) -> Result<(), Failure> {
    let Some(recording) = &outcome.recording else { return Ok(()) };
    let mut picture = render::Settings { camera: outcome.camera, ..render::Settings::default() };
    if let Some(Size { width, height }) = size {
        (picture.width, picture.height) = (width, height);
    }
    let options = Options { picture, ..Options::default() };
    let mut progress = |done: usize, total: usize| tell(bar, done as u64, total as u64);
    Ok(export::write(recording, path, &options, &mut progress)?)
}

/// Refuses, before anything is run for them, files that could not be written, and makes their folders.
pub(crate) fn prepare<'a>(
    pictures: &'a [PathBuf],
    others: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    for path in pictures {
        Format::of(path)?;
    }
    let mut seen = BTreeSet::new();
    for path in pictures.iter().chain(others) {
        if !seen.insert(path) {
            return Err(Failure::Usage(format!(
                "{}: named twice; each file is written once",
                path.display()
            )));
        }
    }
    for path in seen {
        make_folder_of(path)?;
        check_writable(path)?;
    }
    Ok(())
}

/// Does something in a pool of so many threads, or in the one that there is.
fn in_pool<T: Send>(threads: Option<u16>, task: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let Some(threads) = threads else { return Ok(task()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build();
    let pool = pool.map_err(|error| Failure::Usage(format!("--threads {threads}: {error}")))?;
    Ok(pool.install(task))
}

/// A few lines on what came of a run.
pub(crate) fn describe(summary: &RunSummary) -> String {
    let RunSummary { scene, bodies, particles, steps, seconds, ms_per_step, .. } = summary;
    let percent = |share: f32| f64::from(share) * 100.0;
    let mut text = format!(
        "{scene}: {}, {}; {} ({seconds:.2} s) of {ms_per_step:.3} ms\n",
        counted(*bodies, ["body", "bodies"]),
        counted(*particles, ["particle", "particles"]),
        counted(*steps as usize, ["step", "steps"]),
    );
    text += &format!(
        "  at the end: sticks off by {:.2} % (mean {:.3} %), penetration {:.2} mm (mean {:.2} mm), {:.3} J\n",
        percent(summary.max_stick_strain),
        percent(summary.mean_stick_strain),
        summary.max_penetration_mm,
        summary.mean_penetration_mm,
        summary.kinetic_energy,
    );
    if summary.escaped > 0 || summary.nonfinite > 0 {
        let escaped = counted(summary.escaped, ["body", "bodies"]);
        text += &format!("  {escaped} escaped, {} became non-finite\n", summary.nonfinite);
    }
    text + &format!("  state {}\n", summary.state_hash)
}

/// A line on a file that was written, or on one for each frame.
pub(crate) fn describe_file(path: &Path) -> String {
    if let Ok(Format::Obj | Format::Ply) = Format::of(path) {
        return format!("  wrote {} and so on, one for each frame\n", frame_path(path, 0, 1).display());
    }
    let size = std::fs::metadata(path).map_or(0, |file| file.len());
    format!("  wrote {} ({} kB)\n", path.display(), size.div_ceil(1000))
}
