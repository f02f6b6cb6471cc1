//! `tautline` alone: two scenes, side by side, to be looked at.

use std::path::{Path, PathBuf};

use indicatif::MultiProgress;
use tautline_scene::run::RunSummary;

use crate::failure::Failure;
use crate::output::print;
use crate::progress::{no_bar, with_style};
use crate::run::{describe, describe_file, perform, prepare};
use crate::scene::find;

const SCENES: [&str; 2] = ["icosahedra", "cloth-on-cube"];
const FOLDER: &str = "out";

const NEXT: &str = "
Look at it: open the .gif files in a browser, and the .glb files in Blender or any glTF viewer, where they can
be turned and played.
Next:
  tautline list                                             the other scenes and their parameters
  tautline run icosahedra --set n=200 --out out/200.gif     the same, and more of it
  tautline run SCENE.json --out out/mine.glb                a scene of your own
  tautline reproduce --out out/paper                        the paper's experiments, charts and a report
From the source folder, write `cargo run --release --` for `tautline`.
";

pub(crate) fn demo() -> Result<(), Failure> {
    prepare(&SCENES.map(files).concat(), None)?;
    let bars = MultiProgress::new();
    let runs = std::thread::scope(|scope| {
        let threads = SCENES.map(|name| scope.spawn(|| run(name, &bars)));
        threads.map(|thread| thread.join())
    });
    let mut text = String::new();
    for (run, name) in runs.into_iter().zip(SCENES) {
        let lost = |_| Failure::Usage(format!("{name}: its thread ended early"));
        let summary = run.map_err(lost)??;
        text += &describe(&summary);
        files(name).iter().for_each(|path| text += &describe_file(path));
    }
    print(&(text + NEXT))
}

fn run(name: &str, bars: &MultiProgress) -> Result<RunSummary, Failure> {
    let bar = bars.add(with_style(no_bar(), name));
    let summary = perform(&find(name, &[])?, None, (&files(name), None), &bar)?;
    bar.finish_and_clear();
    Ok(summary)
}

fn files(name: &str) -> [PathBuf; 2] {
    ["gif", "glb"].map(|extension| Path::new(FOLDER).join(name).with_extension(extension))
}
