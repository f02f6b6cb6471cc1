//! From what the command line names to a scene document.

use std::path::Path;

use tautline_scene::document::{self, Format, Scene};
use tautline_scene::{load, registry};

use crate::args::Solver;
use crate::failure::Failure;

/// The document of a named scene with parameters set (`n=100`), or of a scene file, which has none.
pub(crate) fn find(scene: &str, assignments: &[String]) -> Result<Scene, Failure> {
    let path = Path::new(scene);
    if Format::of_path(path).is_none() && !scene.contains(['/', '\\']) {
        let named = registry::find(scene)?;
        let mut parameters = named.defaults();
        for assignment in assignments {
            parameters.assign(assignment)?;
        }
        return Ok(named.document(&parameters));
    }
    match assignments.first() {
        None => Ok(load(path)?),
        Some(assignment) => Err(Failure::Usage(format!(
            "--set {assignment}: a scene file has no parameters, only named scenes have"
        ))),
    }
}

/// Replaces the solver; see [`document::Settings::use_solver`].
pub(crate) fn use_solver(scene: &mut Scene, solver: Solver) {
    scene.settings.use_solver(match solver {
        Solver::Paper => document::Solver::Paper,
        Solver::Default => document::Solver::Default,
    });
}
