//! Running other programs, seen or captured.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::project::Project;

/// Cargo, in the workspace's folder: the same one that runs this program.
pub(crate) fn cargo(project: &Project, arguments: &[&str]) -> Command {
    program(project, std::env::var("CARGO").unwrap_or_else(|_| "cargo".into()), arguments)
}

/// Any program, in the workspace's folder.
pub(crate) fn program(project: &Project, name: impl AsRef<Path>, arguments: &[&str]) -> Command {
    let mut command = Command::new(name.as_ref());
    command.args(arguments).current_dir(&project.root).stdin(Stdio::null());
    // Set by the `cargo run` around this program for its own package; they would only confuse another build.
    command.env_remove("CARGO_MANIFEST_DIR").env_remove("CARGO_PKG_NAME");
    command
}

/// Shows the command, runs it with its output in view, and asks for success.
pub(crate) fn run(command: &mut Command) -> Result<(), String> {
    println!("$ {}", line(command));
    let status = command.status().map_err(|error| format!("`{}` does not start: {error}", line(command)))?;
    if status.success() { Ok(()) } else { Err(format!("`{}` failed ({status})", line(command))) }
}

/// As [`run`], but returns what it prints to standard output.
pub(crate) fn output(command: &mut Command) -> Result<String, String> {
    println!("$ {}", line(command));
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("`{}` does not start: {error}", line(command)))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        Ok(text)
    } else {
        Err(format!("`{}` failed ({})\n{text}", line(command), output.status))
    }
}

/// Whether a program is there and answers to `--version`.
pub(crate) fn exists(name: &str) -> bool {
    let quiet = Command::new(name).arg("--version").stdin(Stdio::null()).stderr(Stdio::null()).output();
    quiet.is_ok_and(|output| output.status.success())
}

fn line(command: &Command) -> String {
    let name = Path::new(command.get_program()).file_name().unwrap_or(command.get_program());
    let words = std::iter::once(name).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
