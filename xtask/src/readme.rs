//! What README.md promises: its commands run, its scene is valid, its program is the one in `examples`.

use std::fs;
use std::path::Path;

use crate::command::{cargo, program, run};
use crate::project::Project;
use crate::steps::Outcome;

/// The command that this check is a part of.
const ITSELF: &str = "cargo xtask test";

pub(crate) fn readme(project: &Project) -> Result<Outcome, String> {
    let text = read(&project.root.join("README.md"))?;
    let blocks = code_blocks(&text);
    compare_with_example(project, &blocks)?;
    run(&mut cargo(project, &["build", "--release", "--locked"]))?;
    let scenes = check_scenes(project, &blocks)?;
    let commands: Vec<String> = of_language(&blocks, "sh").flat_map(str::lines).filter_map(as_run).collect();
    for command in &commands {
        run_in_shell(project, command)?;
    }
    if commands.is_empty() || scenes == 0 {
        return Err("README.md has no commands, or no scene, to check".into());
    }
    Ok(Outcome::Noted(format!("{} commands, {scenes} scene(s), one program", commands.len())))
}

/// Runs every program in `examples`.
pub(crate) fn examples(project: &Project) -> Result<Outcome, String> {
    let entries =
        fs::read_dir(project.root.join("examples")).map_err(|error| format!("examples: {error}"))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().to_str()?.strip_suffix(".rs").map(str::to_owned))
        .collect();
    names.sort();
    for name in &names {
        run(&mut cargo(project, &["run", "--quiet", "--release", "--locked", "--example", name]))?;
    }
    if names.is_empty() {
        return Err("there are no examples".into());
    }
    Ok(Outcome::Noted(names.join(", ")))
}

fn compare_with_example(project: &Project, blocks: &[(&str, &str)]) -> Result<(), String> {
    let example = read(&project.root.join("examples/hello.rs"))?;
    match of_language(blocks, "rust").next() {
        Some(block) if block == example => Ok(()),
        Some(_) => Err("README.md: the Rust program differs from examples/hello.rs".into()),
        None => Err("README.md has no Rust program".into()),
    }
}

fn check_scenes(project: &Project, blocks: &[(&str, &str)]) -> Result<usize, String> {
    let mut count = 0;
    for scene in of_language(blocks, "json") {
        let path = project.target.join("readme-scene.json");
        fs::write(&path, scene).map_err(|error| format!("{}: {error}", path.display()))?;
        let file = path.to_str().ok_or("the target folder's path is not UTF-8")?;
        run(&mut program(project, project.tautline("release"), &["check", file]))?;
        run(&mut program(project, project.tautline("release"), &["run", file, "--seconds", "1"]))?;
        count += 1;
    }
    Ok(count)
}

/// In a shell that knows the release build as `tautline`.
fn run_in_shell(project: &Project, command: &str) -> Result<(), String> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let release = project.target.join("release");
    let folders = std::iter::once(release).chain(std::env::split_paths(&path));
    let path = std::env::join_paths(folders).map_err(|error| error.to_string())?;
    run(program(project, "sh", &["-c", command]).env("PATH", path))
}

/// How a line of a README block is run. One that takes long says in its comment how it is quick, and is run
/// so: `tautline reproduce --out out/paper   # minutes; --quick: seconds`.
fn as_run(line: &str) -> Option<String> {
    let (command, comment) = line.split_once(" #").unwrap_or((line, ""));
    let command = command.trim();
    if command.is_empty() || command.starts_with('#') || command == ITSELF {
        return None;
    }
    let quick = if comment.contains("--quick") { " --quick" } else { "" };
    Some(format!("{command}{quick}"))
}

/// Language and content of each fenced block.
fn code_blocks(markdown: &str) -> Vec<(&str, &str)> {
    // Odd pieces lie between two fences.
    let inside = markdown.split("```").skip(1).step_by(2);
    inside.filter_map(|block| block.split_once('\n')).collect()
}

fn of_language<'a>(blocks: &'a [(&str, &'a str)], language: &'a str) -> impl Iterator<Item = &'a str> {
    blocks.iter().filter(move |(name, _)| *name == language).map(|(_, content)| *content)
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_found_by_language() {
        let markdown = "a\n```sh\none\ntwo\n```\nb\n```json\n{}\n```\n";
        assert_eq!(code_blocks(markdown), [("sh", "one\ntwo\n"), ("json", "{}\n")]);
        assert_eq!(of_language(&code_blocks(markdown), "json").collect::<Vec<_>>(), ["{}\n"]);
    }

    #[test]
    fn a_long_command_is_run_in_its_quick_form_and_the_test_command_not_at_all() {
        assert_eq!(as_run("tautline list"), Some("tautline list".into()));
        assert_eq!(
            as_run("tautline r --out o  # minutes; --quick: seconds"),
            Some("tautline r --out o --quick".into())
        );
        assert_eq!(as_run("cargo xtask test   # everything"), None);
        assert_eq!(as_run("# a comment"), None);
        assert_eq!(as_run(""), None);
    }
}
