//! Builds that are begun before their step's turn comes: the compiler spends much of them on one core, as it does with what
//! the first steps ask of it, so the two share the machine.

use std::process::{Command, Stdio};
use std::thread;

use crate::project::Project;
use crate::steps::Outcome;
use crate::{setup, web};

/// Begins the builds, one after another, unseen. The step that a build is for asks for it again: it waits for what has not
/// ended, has nothing to do if it has, and tells what is wrong.
pub(crate) fn begin(project: &Project) -> Result<Outcome, String> {
    let mut builds = Vec::new();
    if setup::node_is_there() {
        builds.extend(web::compilations(project));
    }
    builds.extend(setup::miri_compilations(project));
    let note = format!("{} commands", builds.len());
    thread::spawn(move || builds.into_iter().for_each(run_unseen));
    Ok(Outcome::Noted(note))
}

fn run_unseen(mut command: Command) {
    // A failure is seen when its step runs the command again.
    let _ = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
}
