//! The playground: its page, the page that plays recordings, and their tests in Chromium.

use crate::command::{exists, run};
use crate::project::Project;
use crate::setup::{install_on_debian, node_is_there};
use crate::steps::Outcome;
use crate::web::{install_packages, npm};

/// The page's folder.
const PAGE: &str = "playground";
/// The page that recordings are put into, as it is made and as it is kept.
const REPLAY: &str = "crates/tautline-scene/src/export/html/replay.html";
/// On Debian.
const CHROMIUM: &[&str] = &["chromium", "fonts-dejavu-core"];

/// Builds the playground on the npm package, which has to be there.
pub(crate) fn build(project: &Project) -> Result<(), String> {
    let page = project.root.join(PAGE);
    install_packages(project, &page)?;
    for script in ["build", "replay"] {
        run(npm(project, &["run", script]).current_dir(&page))?;
    }
    Ok(())
}

/// The page builds, its types hold, and recordings are put into the page that is made of it. The npm package has been
/// built by the step before.
pub(crate) fn page(project: &Project) -> Result<Outcome, String> {
    if !node_is_there() {
        return Ok(Outcome::LeftOut("the playground, which needs Node".into()));
    }
    let kept = project.root.join(REPLAY);
    let before = std::fs::read(&kept).map_err(|error| format!("{REPLAY}: {error}"))?;
    build(project)?;
    if std::fs::read(&kept).is_ok_and(|after| after != before) {
        return Err(format!("{REPLAY} was not what `cargo xtask web` makes; it is now: commit it"));
    }
    let page = project.root.join(PAGE);
    run(npm(project, &["run", "check"]).current_dir(&page))?;
    Ok(Outcome::Passed)
}

/// The built page does what its users do with it, in a browser.
pub(crate) fn browser(project: &Project) -> Result<Outcome, String> {
    let page = project.root.join(PAGE);
    if !exists("chromium")
        && let Err(problem) = install_on_debian(project, CHROMIUM)
    {
        return Ok(Outcome::LeftOut(format!("the playground in a browser: {problem}")));
    }
    run(npm(project, &["test"]).current_dir(&page).env("TAUTLINE", project.tautline("release")))?;
    Ok(Outcome::Noted("pictures of every scene are in playground/test-results".into()))
}
