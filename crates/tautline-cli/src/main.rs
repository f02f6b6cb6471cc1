//! The tautline command line: arguments → scene → run → files → exit code. No physics and no scenes of its own.

mod args;
mod bench;
mod check;
mod demo;
mod failure;
mod list;
mod output;
mod picture;
mod progress;
mod reproduce;
mod run;
mod scene;
mod validate;
mod view;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match &arguments.command {
        None => demo::demo(),
        Some(Command::List(list)) => list::list(list),
        Some(Command::Run(run)) => run::run(run),
        Some(Command::View(view)) => view::view(view),
        Some(Command::Check(check)) => check::check(check),
        Some(Command::Bench(bench)) => bench::bench(bench),
        Some(Command::Reproduce(reproduce)) => reproduce::reproduce(reproduce),
        Some(Command::Validate(validate)) => validate::validate(validate),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
