//! What the checks need besides Rust: installed on Debian as root; elsewhere the line that installs it is printed.

use std::process::Command;

use crate::command::{exists, program, run};
use crate::files::text_files;
use crate::project::Project;
use crate::steps::Outcome;
use crate::tidy::unsafe_lines;

/// The Khronos validator of GLB files, as an npm package.
const VALIDATOR: &str = "tests/gltf-validator";
/// On Debian.
const NODE: &[&str] = &["nodejs", "npm"];

/// Where Miri looks: only at tests of the folders that have unsafe code, since it is slow.
const ENGINE: &str = "tautline";
const UNSAFE_TESTS: &[&str] = &["simd::", "parallel::team::"];

/// rustfmt, clippy, Node and the npm packages that tests use.
pub(crate) fn setup(project: &Project) -> Result<Outcome, String> {
    for (component, tool) in [("rustfmt", "cargo-fmt"), ("clippy", "cargo-clippy")] {
        if !exists(tool) {
            run(&mut program(project, "rustup", &["component", "add", component]))?;
        }
    }
    if !node_is_there()
        && let Err(problem) = install_on_debian(project, NODE)
    {
        return Ok(Outcome::LeftOut(format!("Node: {problem}")));
    }
    match install_validator(project) {
        Ok(()) => Ok(Outcome::Passed),
        Err(problem) => Ok(Outcome::LeftOut(format!("the npm packages of {VALIDATOR}: {problem}"))),
    }
}

/// What to say of the tests that run the validator: without it they pass without looking.
pub(crate) fn gltf_validator(project: &Project) -> Result<Outcome, String> {
    if node_is_there() && validator_is_there(project) {
        return Ok(Outcome::Passed);
    }
    Ok(Outcome::LeftOut("GLB files were not checked by the Khronos validator, which needs Node".into()))
}

/// Node and its packages' installer.
pub(crate) fn node_is_there() -> bool {
    exists("node") && exists("npm")
}

fn validator_is_there(project: &Project) -> bool {
    project.root.join(VALIDATOR).join("node_modules/gltf-validator").is_dir()
}

/// Installs packages of Debian, as root; elsewhere says what would.
pub(crate) fn install_on_debian(project: &Project, packages: &[&str]) -> Result<(), String> {
    let install = [&["install", "--yes", "--no-install-recommends"], packages].concat();
    if !(exists("apt-get") && is_root(project)) {
        return Err(format!("not installed; on Debian this does it: sudo apt-get {}", install.join(" ")));
    }
    run(&mut program(project, "apt-get", &["update", "--quiet"]))?;
    run(program(project, "apt-get", &install).env("DEBIAN_FRONTEND", "noninteractive"))
}

fn is_root(project: &Project) -> bool {
    let id = program(project, "id", &["-u"]).output();
    id.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

fn install_validator(project: &Project) -> Result<(), String> {
    let folder = project.root.join(VALIDATOR);
    let changed = |file: &str| folder.join(file).metadata().and_then(|data| data.modified()).ok();
    // npm leaves a copy of the lock file with what it installed.
    if validator_is_there(project)
        && changed("node_modules/.package-lock.json") >= changed("package-lock.json")
    {
        return Ok(());
    }
    run(program(project, "npm", &["ci", "--no-audit", "--no-fund"]).current_dir(folder))
}

/// Miri runs the engine's tests where there is unsafe code for it to judge.
pub(crate) fn miri(project: &Project) -> Result<Outcome, String> {
    let files = text_files(&project.root)?;
    if files.iter().all(|file| unsafe_lines(file).is_empty()) {
        return Ok(Outcome::Noted("there is no unsafe code, so nothing for Miri to judge".into()));
    }
    miri_test(project, ENGINE, UNSAFE_TESTS)
}

/// Miri runs the unit tests of the mesh readers, over seeds that are changed and cut off.
pub(crate) fn miri_of_readers(project: &Project) -> Result<Outcome, String> {
    miri_test(project, "tautline-scene", &["mesh_file::"])
}

/// What compiles the engine for [`miri`].
pub(crate) fn miri_compilations(project: &Project) -> [Command; 2] {
    [install_miri(project), miri_command(project, ENGINE, &["--no-run"])]
}

/// Runs the unit tests of a package that have any of these in their names under Miri.
fn miri_test(project: &Project, package: &str, tests: &[&str]) -> Result<Outcome, String> {
    run(&mut install_miri(project))?;
    run(&mut miri_command(project, package, &[&["--"], tests].concat()))?;
    Ok(Outcome::Passed)
}

fn install_miri(project: &Project) -> Command {
    let toolchain =
        ["toolchain", "install", "nightly", "--profile", "minimal", "--component", "miri,rust-src"];
    program(project, "rustup", &toolchain)
}

fn miri_command(project: &Project, package: &str, more: &[&str]) -> Command {
    // Through rustup: the Cargo that runs this program is of the stable toolchain.
    let test = ["run", "nightly", "cargo", "miri", "test", "--locked", "-p", package, "--lib"];
    let mut command = program(project, "rustup", &[&test, more].concat());
    // The unsafe code is about these instructions.
    command.env("RUSTFLAGS", "-C target-feature=+avx2");
    command
}
