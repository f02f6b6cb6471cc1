//! Every problem of a scene file.

use serde_json::json;
use tautline_scene::build::BuiltScene;
use tautline_scene::{Error, Problem, load};

use crate::args::Check;
use crate::failure::Failure;
use crate::output::{counted, print, print_json};

pub(super) fn check(arguments: &Check) -> Result<(), Failure> {
    let file = arguments.file.display();
    let problems = match load(&arguments.file).and_then(|scene| scene.build()) {
        Ok(scene) => return report_sound(arguments, &scene),
        Err(error @ (Error::Io { .. } | Error::UnsupportedFormat { .. })) => return Err(error.into()),
        Err(error) => problems(error),
    };
    if arguments.json {
        let list: Vec<_> = problems.iter().map(|p| json!({ "path": p.path, "message": p.message })).collect();
        print_json(&json!({ "file": file.to_string(), "ok": false, "problems": list }))?;
        return Err(Failure::Reported);
    }
    let line = |problem: &Problem| match problem.path.as_str() {
        "" => format!("{file}: {}\n", problem.message),
        path => format!("{file}: {path}: {}\n", problem.message),
    };
    Err(Failure::Scene(problems.iter().map(line).collect()))
}

fn report_sound(arguments: &Check, scene: &BuiltScene) -> Result<(), Failure> {
    let file = arguments.file.display();
    let (bodies, particles) = (scene.world.bodies().len(), scene.world.positions().len());
    if arguments.json {
        return print_json(&json!({
            "file": file.to_string(), "ok": true, "problems": [], "bodies": bodies, "particles": particles,
        }));
    }
    let (bodies, particles) =
        (counted(bodies, ["body", "bodies"]), counted(particles, ["particle", "particles"]));
    print(&format!("{file}: no problems; {bodies}, {particles}\n"))
}

/// One problem for every thing that is wrong.
fn problems(error: Error) -> Vec<Problem> {
    match error {
        Error::Invalid(problems) => problems,
        Error::Parse(error) => {
            let place = format!("line {}, column {}: ", error.line, error.column);
            vec![Problem { path: error.field, message: place + &error.message }]
        }
        other => vec![Problem { path: String::new(), message: other.to_string() }],
    }
}
