//! Project tasks. `cargo xtask test` runs everything that must pass.

mod ahead;
mod command;
mod files;
mod hashes;
mod meshes;
mod page;
mod project;
mod python;
mod readme;
mod setup;
mod steps;
mod tidy;
mod web;

use std::process::ExitCode;

use project::Project;
use steps::{MORE, STEPS};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let project = match Project::find() {
        Ok(project) => project,
        Err(problem) => return refuse(&problem),
    };
    match arguments[..] {
        ["web"] => match web::build(&project).and_then(|()| page::build(&project)) {
            Ok(()) => ExitCode::SUCCESS,
            Err(problem) => refuse(&problem),
        },
        ["test"] => steps::run(&project, STEPS),
        ["test", "--only", name] => match STEPS.iter().chain(MORE).find(|step| step.name == name) {
            Some(step) => steps::run(&project, std::slice::from_ref(step)),
            None => refuse(&format!("there is no step `{name}`\n\n{}", usage())),
        },
        [] | ["help" | "--help" | "-h"] => {
            println!("{}", usage());
            ExitCode::SUCCESS
        }
        _ => refuse(&usage()),
    }
}

fn refuse(message: &str) -> ExitCode {
    eprintln!("{message}");
    ExitCode::from(2)
}

fn usage() -> String {
    let mut text = "cargo xtask test               everything that must pass\n\
                    cargo xtask web                builds the npm package and the playground\n\
                    cargo xtask test --only NAME   one step of the test:\n"
        .to_owned();
    for step in STEPS.iter().chain(MORE) {
        text += &format!("\n  {:9} {}", step.name, step.about);
    }
    text
}
