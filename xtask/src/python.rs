//! The Python package: installed into an environment of its own below the target folder, and tested there.

use std::path::{Path, PathBuf};

use crate::command::{cargo, exists, output, program, run};
use crate::project::Project;
use crate::steps::Outcome;

const PACKAGE: &str = "bindings/python";
/// Of the package's `requires-python`.
const OLDEST: (u32, u32) = (3, 9);

/// Installs the package with its test extras, and runs its tests, mypy and stubtest. Nothing outside the target folder is
/// touched, and what is compiled goes where the workspace's own release build is: the engine is not compiled again, since
/// the command line asks for the features of `syn` that PyO3 asks for.
pub(crate) fn python(project: &Project) -> Result<Outcome, String> {
    let environment = match environment(project) {
        Ok(environment) => environment,
        Err(missing) => {
            return Ok(Outcome::LeftOut(format!("the Python package was not checked: {missing}")));
        }
    };
    run(&mut cargo(project, &["build", "--release", "--locked"]))?;
    let folder = project.root.join(PACKAGE);
    let mut install = environment.pip(project, &[".[test]"]);
    run(install.current_dir(&folder).env("CARGO_TARGET_DIR", &project.target))?;
    let mut pytest = environment.python(project, &["-m", "pytest"]);
    run(pytest.current_dir(&folder).env("TAUTLINE_PROGRAM", project.tautline("release")))?;
    run(environment.python(project, &["-m", "mypy"]).current_dir(&folder))?;
    let stubtest = ["-m", "mypy.stubtest", "tautline._engine", "--mypy-config-file", "pyproject.toml"];
    run(environment.python(project, &stubtest).current_dir(&folder))?;
    Ok(Outcome::Passed)
}

/// A virtual environment.
struct Environment {
    python: PathBuf,
}

impl Environment {
    fn python(&self, project: &Project, arguments: &[&str]) -> std::process::Command {
        program(project, &self.python, arguments)
    }

    fn pip(&self, project: &Project, arguments: &[&str]) -> std::process::Command {
        // Most of what is installed is never imported: it is compiled when it is.
        let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile"];
        let mut command = self.python(project, &install);
        command.args(arguments);
        command
    }
}

/// The environment, made if it is not there; or what is missing for that.
fn environment(project: &Project) -> Result<Environment, String> {
    if !exists("python3") {
        return Err("there is no python3".into());
    }
    let version = "import sys; print(*sys.version_info[:2])";
    let version = output(&mut program(project, "python3", &["-c", version]))?;
    let numbers: Vec<u32> = version.split_whitespace().filter_map(|number| number.parse().ok()).collect();
    if !matches!(numbers[..], [major, minor] if (major, minor) >= OLDEST) {
        return Err(format!("python3 is {}, and 3.9 is the oldest that it is for", version.trim()));
    }
    let folder = project.target.join("python/venv");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if !works(project, &python) {
        let path = folder.to_str().ok_or("the target folder's path is not UTF-8")?;
        run(&mut program(project, "python3", &["-m", "venv", "--clear", path]))
            .map_err(|error| format!("{error}; on Debian the package python3-venv is needed"))?;
    }
    let environment = Environment { python };
    // What builds the package; that it can be had tells that the rest can.
    run(&mut environment.pip(project, &["maturin>=1.9,<2"]))
        .map_err(|error| format!("the package registry could not be reached: {error}"))?;
    Ok(environment)
}

/// Whether an environment is there, and its Python still is.
fn works(project: &Project, python: &Path) -> bool {
    python.exists()
        && program(project, python, &["-m", "pip", "--version"]).output().is_ok_and(|o| o.status.success())
}
