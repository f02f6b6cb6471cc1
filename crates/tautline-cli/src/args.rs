//! What can be asked for on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use tautline_scene::render::MAX_SIZE;

/// Rigid bodies, cloth and rope in one world.
///
/// Without a command, two scenes are run and written to the folder `out`.
#[derive(Debug, Parser)]
#[command(name = "tautline", version, max_term_width = 100)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the named scenes and their parameters.
    List(List),
    /// Run a scene and write pictures, animations and statistics.
    Run(Run),
    /// Open the playground in the browser: scenes to grab, change and look into.
    View(View),
    /// Check a scene or mesh file and name every problem in it. Exit code 0: none, 1: some, 2: no such file.
    Check(Check),
    /// Measure the time of a step, phase by phase.
    Bench(Bench),
    /// Run the paper's experiments and write tables, charts and a report.
    Reproduce(Reproduce),
    /// Compare the solver with closed forms. Exit code 1 if a case is off by more than is demanded.
    Validate(Validate),
}

#[derive(Debug, Args)]
pub(crate) struct List {
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Run {
    /// A named scene (see `tautline list`), or a scene file: .json, .json5 or .toml.
    pub(crate) scene: String,
    /// Set a parameter of a named scene; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// How long to run, in s; what the scene says if absent.
    #[arg(long, value_parser = seconds)]
    pub(crate) seconds: Option<f32>,
    /// Which solver to use; what the scene says if absent.
    #[arg(long)]
    pub(crate) solver: Option<Solver>,
    /// How many threads to use; all cores if absent. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    /// Write an animation (.glb, .gif, .mp4), a page that plays it (.html), a picture (.png), a point cache (.pc2), arrays
    /// (.npz) or a mesh for each frame (.obj, .ply); may be repeated.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Vec<PathBuf>,
    /// How large pictures are, in pixels, such as 1280x720; 640x480 if absent.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    pub(crate) size: Option<Size>,
    /// Write the statistics of the run.
    #[arg(long, value_name = "FILE.json")]
    pub(crate) stats: Option<PathBuf>,
    /// Print the statistics as JSON, and no progress.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct View {
    /// A named scene (see `tautline list`), or a scene file: .json, .json5 or .toml.
    pub(crate) scene: Option<String>,
    /// Set a parameter of a named scene; may be repeated.
    #[arg(long, value_name = "NAME=VALUE", requires = "scene")]
    pub(crate) set: Vec<String>,
    /// The port to serve it at; a free one if absent.
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    pub(crate) port: u16,
    /// Where the built playground is; `playground/dist` of the source folder if absent.
    #[arg(long, value_name = "DIR")]
    pub(crate) page: Option<PathBuf>,
    /// Only print the address.
    #[arg(long)]
    pub(crate) no_open: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    /// A scene file: .json, .json5 or .toml; or a mesh file: .obj, .stl, .ply, .gltf or .glb.
    pub(crate) file: PathBuf,
    /// Print JSON, with every defect of a mesh; the table names the first of each kind.
    #[arg(long)]
    pub(crate) json: bool,
    /// Repair the mesh and write it: .obj, .stl or .ply. The exit code is that of the repaired mesh.
    #[arg(long, value_name = "FILE")]
    pub(crate) repair: Option<PathBuf>,
    /// Draw the mesh as it is in the file, from the front and from behind, with its defects marked.
    #[arg(long, value_name = "FILE.png")]
    pub(crate) picture: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Bench {
    /// Named scenes; all of them if absent.
    pub(crate) scenes: Vec<String>,
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Reproduce {
    /// The folder to write to; made if it is not there.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Fewer sizes and steps: seconds instead of minutes, to see that everything works.
    #[arg(long)]
    pub(crate) quick: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Validate {
    /// Numbers of cases, told of in full; all of them if absent.
    #[arg(value_name = "CASE")]
    pub(crate) cases: Vec<u32>,
    /// Write the results.
    #[arg(long, value_name = "FILE.json")]
    pub(crate) json: Option<PathBuf>,
    /// Write a chart of the errors, beside those of other engines: .svg or .png.
    #[arg(long, value_name = "FILE")]
    pub(crate) chart: Option<PathBuf>,
    /// Substeps in a step; what the default settings say if absent.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) substeps: Option<u32>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Solver {
    /// The paper's: one substep, ordered relaxation with a tolerance of 1 %.
    Paper,
    /// Substeps: rigid bodies of four particles, stacks and joints solved exactly, threads of cloth and rope as wholes.
    Default,
}

/// Of a picture, in pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

fn size(text: &str) -> Result<Size, String> {
    let pixels = |text: &str| text.parse().ok().filter(|pixels| (1..=MAX_SIZE).contains(pixels));
    text.split_once('x')
        .and_then(|(width, height)| Some(Size { width: pixels(width)?, height: pixels(height)? }))
        .ok_or_else(|| format!("it must be a width and a height of 1 to {MAX_SIZE} pixels, such as 1280x720"))
}

/// The longest run, in s: an hour of simulated time.
const MOST_SECONDS: f32 = 3600.0;

fn seconds(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(seconds) if seconds > 0.0 && seconds <= MOST_SECONDS => Ok(seconds),
        _ => Err(format!("it must be a number above 0 and at most {MOST_SECONDS} (s)")),
    }
}
