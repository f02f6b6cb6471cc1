//! `tautline list`: the named scenes and their parameters.

use serde_json::{Value, json};
use tautline_scene::registry::{NamedScene, Parameter, scenes};

use crate::args::List;
use crate::failure::Failure;
use crate::output::{print, print_json};

pub(crate) fn list(arguments: &List) -> Result<(), Failure> {
    if arguments.json {
        return print_json(&scenes().iter().map(scene_json).collect::<Vec<_>>());
    }
    let mut text: String = scenes().iter().map(scene_text).collect();
    text += "\nRun one with `tautline run NAME --set NAME=VALUE --out FILE.gif`.\n";
    print(&text)
}

fn scene_text(scene: &NamedScene) -> String {
    let mut text = format!("{}\n    {}\n", scene.name, scene.description);
    for Parameter { name, description, default, min, max, .. } in scene.parameters {
        text += &format!("    {name} = {default} ({min} to {max}): {description}\n");
    }
    text
}

fn scene_json(scene: &NamedScene) -> Value {
    let parameters: Vec<Value> = scene.parameters.iter().map(parameter_json).collect();
    json!({ "name": scene.name, "description": scene.description, "parameters": parameters })
}

fn parameter_json(parameter: &Parameter) -> Value {
    let Parameter { name, description, default, min, max, integer } = parameter;
    // A whole number is written without a fraction, which every reader of JSON understands as one.
    let value = |number: f64| if *integer { json!(number as i64) } else { json!(number) };
    json!({
        "name": name, "description": description, "integer": integer,
        "default": value(*default), "min": value(*min), "max": value(*max),
    })
}
