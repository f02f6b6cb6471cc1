//! The engine in WebAssembly and the npm package around it.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{cargo, output, program, run};
use crate::project::Project;
use crate::setup::node_is_there;
use crate::steps::Outcome;

/// The npm package.
const PACKAGE: &str = "bindings/wasm/npm";
const TARGET: &str = "wasm32-unknown-unknown";
/// The most bytes of the engine as it is sent, gzipped: a little more than it has. The aim is half of that.
const MOST_BYTES: usize = 875_000;

/// Builds the package: the engine, its glue, its types.
pub(crate) fn build(project: &Project) -> Result<(), String> {
    let package = project.root.join(PACKAGE);
    for mut command in compilations(project) {
        run(&mut command)?;
    }
    install_packages(project, &package)?;
    write_glue(project)?;
    for script in ["document", "build"] {
        run(npm(project, &["run", script]).current_dir(&package))?;
    }
    Ok(())
}

/// What compiles the engine, and the tool that writes its glue, which has a workspace of its own.
pub(crate) fn compilations(project: &Project) -> [Command; 3] {
    let engine = ["build", "--locked", "--package", "tautline-wasm", "--target", TARGET, "--profile", "web"];
    let mut tool =
        cargo(project, &["build", "--locked", "--manifest-path", "bindings/wasm/bindgen/Cargo.toml"]);
    tool.env("CARGO_TARGET_DIR", tool_folder(project));
    let mut engine = cargo(project, &engine);
    engine.args(["--config", &without_home()]);
    [program(project, "rustup", &["target", "add", TARGET]), engine, tool]
}

/// A setting that keeps the folder of whoever builds the engine out of it, so that it has the same bytes wherever it is built.
fn without_home() -> String {
    let cargo_home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = cargo_home.or_else(|| Some(std::env::home_dir()?.join(".cargo"))).unwrap_or_default();
    // A literal string of TOML: folders of Windows have backslashes.
    format!("target.{TARGET}.rustflags=['--remap-path-prefix={}=']", home.join("registry/src").display())
}

fn tool_folder(project: &Project) -> PathBuf {
    project.target.join("bindgen")
}

/// The package builds, is small, has what it should, and does what its tests say, the bits of the native engine included.
pub(crate) fn web(project: &Project) -> Result<Outcome, String> {
    if !node_is_there() {
        return Ok(Outcome::LeftOut("the npm package, which needs Node".into()));
    }
    build(project)?;
    let package = project.root.join(PACKAGE);
    run(npm(project, &["run", "check"]).current_dir(&package))?;
    run(&mut cargo(project, &["build", "--locked", "--release", "--package", "tautline-cli"]))?;
    run(npm(project, &["test"]).current_dir(&package).env("TAUTLINE", project.tautline("release")))?;
    let size = gzipped_size(project)?;
    let note = format!("the engine is {} kB gzipped", size / 1000);
    if size > MOST_BYTES {
        Err(format!("{note}, more than {}", MOST_BYTES / 1000))
    } else {
        Ok(Outcome::Noted(note))
    }
}

pub(crate) fn npm(project: &Project, arguments: &[&str]) -> Command {
    program(project, "npm", arguments)
}

/// As the lock file says, unless they are there.
pub(crate) fn install_packages(project: &Project, package: &Path) -> Result<(), String> {
    let changed = |file: &str| package.join(file).metadata().and_then(|data| data.modified()).ok();
    let installed = changed("node_modules/.package-lock.json");
    if installed.is_some() && installed >= changed("package-lock.json") {
        return Ok(());
    }
    run(npm(project, &["ci", "--no-audit", "--no-fund"]).current_dir(package))
}

/// Writes what JavaScript calls the engine by.
fn write_glue(project: &Project) -> Result<(), String> {
    let tool = tool_folder(project).join("debug").join(format!("bindgen{}", std::env::consts::EXE_SUFFIX));
    let module = project.target.join(TARGET).join("web/tautline_wasm.wasm");
    let engine = PathBuf::from(PACKAGE).join("src/engine");
    run(program(project, tool, &[]).arg(module).arg(engine))
}

fn gzipped_size(project: &Project) -> Result<usize, String> {
    let script = "import { gzipSync } from 'node:zlib'; import { readFileSync } from 'node:fs'; \
                  console.log(gzipSync(readFileSync(process.argv[1]), { level: 9 }).length)";
    let engine = PathBuf::from(PACKAGE).join("dist/engine/engine_bg.wasm");
    let mut node = program(project, "node", &["--input-type=module", "--eval", script]);
    let text = output(node.arg(engine))?;
    text.trim().parse().map_err(|_| format!("{text:?} is not a size"))
}
