//! What `cargo xtask test` does, in order, and how it is summed up.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use crate::command::{cargo, run as run_command};
use crate::project::Project;
use crate::{ahead, hashes, meshes, page, python, readme, setup, tidy, web};

/// One thing that must pass.
pub(crate) struct Step {
    pub(crate) name: &'static str,
    pub(crate) about: &'static str,
    check: fn(&Project) -> Result<Outcome, String>,
}

/// How a step ended that did not fail.
pub(crate) enum Outcome {
    Passed,
    /// Passed, and this is worth a line in the summary.
    Noted(String),
    /// Something could not be checked here, and why.
    LeftOut(String),
}

/// Cheap and telling ones first; those that build, by what they share.
pub(crate) const STEPS: &[Step] = &[
    Step { name: "setup", about: "what the other steps need is there, or is installed", check: setup::setup },
    Step { name: "format", about: "rustfmt changes nothing", check: format },
    Step { name: "tidy", about: "architecture, file sizes, paths, links", check: tidy::tidy },
    Step { name: "ahead", about: "slow builds of later steps are begun", check: ahead::begin },
    Step { name: "clippy", about: "no warnings, in any target", check: clippy },
    Step { name: "docs", about: "no warnings", check: docs },
    Step { name: "tests", about: "all tests of the workspace", check: tests },
    Step { name: "hashes", about: "debug, release, 1 and 2 threads: the same bits", check: hashes::hashes },
    Step { name: "web", about: "the npm package: builds, is small, has the same bits", check: web::web },
    Step { name: "page", about: "the playground builds, and its types hold", check: page::page },
    Step {
        name: "browser",
        about: "the playground in Chromium: every scene, hands, hostile input",
        check: page::browser,
    },
    Step { name: "examples", about: "each runs and what it asserts holds", check: readme::examples },
    Step { name: "readme", about: "its commands, its scene and its program", check: readme::readme },
    Step {
        name: "python",
        about: "the package installs, its tests pass, its types hold",
        check: python::python,
    },
    Step { name: "miri", about: "tests of unsafe code, if there is any", check: setup::miri },
];

/// By name only: one fetches a hundred megabytes of packages for their meshes, the other is slow.
pub(crate) const MORE: &[Step] = &[
    Step {
        name: "meshes",
        about: "meshes of public packages are examined and repaired",
        check: meshes::meshes,
    },
    Step {
        name: "miri-readers",
        about: "tests of the mesh readers, under Miri",
        check: setup::miri_of_readers,
    },
];

fn format(project: &Project) -> Result<Outcome, String> {
    run_command(&mut cargo(project, &["fmt", "--all", "--check"]))?;
    Ok(Outcome::Passed)
}

fn clippy(project: &Project) -> Result<Outcome, String> {
    let arguments = ["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"];
    run_command(&mut cargo(project, &arguments))?;
    Ok(Outcome::Passed)
}

/// Of the libraries: the command line has the engine's name, and its pages would overwrite the engine's.
fn docs(project: &Project) -> Result<Outcome, String> {
    let mut command = cargo(project, &["doc", "--workspace", "--lib", "--no-deps", "--locked"]);
    run_command(command.env("RUSTDOCFLAGS", "-D warnings"))?;
    Ok(Outcome::Passed)
}

/// Where property tests begin to draw their cases, unless the caller says: what holds of a commit today holds of it
/// tomorrow. `cargo test` by itself draws other cases each time.
const SEED: (&str, &str) = ("PROPTEST_RNG_SEED", "20130521");

fn tests(project: &Project) -> Result<Outcome, String> {
    let mut command = cargo(project, &["test", "--workspace", "--locked", "--no-fail-fast"]);
    if std::env::var_os(SEED.0).is_none() {
        command.env(SEED.0, SEED.1);
    }
    run_command(&mut command)?;
    setup::gltf_validator(project)
}

/// Runs steps to the end, whatever fails, and says at the end how each went.
pub(crate) fn run(project: &Project, steps: &[Step]) -> ExitCode {
    let start = Instant::now();
    let mut summary = String::new();
    let (mut failed, mut left_out) = (0, 0);
    for (index, step) in steps.iter().enumerate() {
        println!("\n=== {} ({} of {}): {}", step.name, index + 1, steps.len(), step.about);
        let begin = Instant::now();
        let (word, note) = match (step.check)(project) {
            Ok(Outcome::Passed) => ("ok", String::new()),
            Ok(Outcome::Noted(note)) => ("ok", note),
            Ok(Outcome::LeftOut(what)) if project.ci => ("FAILED", format!("left out: {what}")),
            Ok(Outcome::LeftOut(what)) => ("LEFT OUT", what),
            Err(problem) => ("FAILED", problem),
        };
        failed += usize::from(word == "FAILED");
        left_out += usize::from(word == "LEFT OUT");
        if !note.is_empty() {
            println!("{note}");
        }
        let first = note.lines().next().unwrap_or_default();
        let line = format!("{:9} {:>7}  {word:8}  {first}", step.name, seconds(begin.elapsed()));
        summary += &format!("\n  {}", line.trim_end());
    }
    println!("\n=== summary, {} in all{summary}", seconds(start.elapsed()));
    if failed > 0 {
        println!("\n{failed} of {} steps failed", steps.len());
        return ExitCode::FAILURE;
    }
    if left_out > 0 {
        println!("\nall steps passed, but {left_out} left something out, as said above");
    } else {
        println!("\nall steps passed, nothing was left out");
    }
    ExitCode::SUCCESS
}

fn seconds(time: Duration) -> String {
    format!("{:.1} s", time.as_secs_f64())
}
