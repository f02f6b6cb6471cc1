//! Scene documents and the named scenes, without a world.

use serde_json::{Value, json};
use tautline_scene::Error;
use tautline_scene::document::{Format, Scene, Solver, json_of_json5, parse_part};
use tautline_scene::registry::{self, NamedScene, Parameter};
use wasm_bindgen::prelude::*;

use crate::failure::Failure;

/// The version of the engine.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// All named scenes: `[{name, description, parameters}]`.
#[wasm_bindgen]
pub fn scenes() -> String {
    let parameter = |p: &Parameter| {
        json!({
            "name": p.name, "description": p.description, "default": p.default,
            "min": p.min, "max": p.max, "integer": p.integer,
        })
    };
    let scene = |scene: &NamedScene| {
        let parameters: Vec<Value> = scene.parameters.iter().map(parameter).collect();
        json!({ "name": scene.name, "description": scene.description, "parameters": parameters })
    };
    Value::from(registry::scenes().iter().map(scene).collect::<Vec<_>>()).to_string()
}

/// The document of a named scene, in JSON; `names` and `values` are its parameters.
#[wasm_bindgen]
pub fn document(name: &str, names: Vec<String>, values: &[f64]) -> Result<String, JsValue> {
    let scene = registry::find(name).map_err(Failure::from)?;
    let mut parameters = scene.defaults();
    for (name, &value) in names.iter().zip(values) {
        parameters.set(name, value).map_err(Failure::from)?;
    }
    Ok(written(&scene.document(&parameters)))
}

/// What is wrong with a document, `[]` if nothing.
#[wasm_bindgen]
pub fn validate(text: &str, format: &str) -> Result<String, JsValue> {
    let problems = match read(text, format).and_then(|scene| Ok(scene.check()?)) {
        Ok(()) => json!([]),
        Err(failure) => failure.located(text, format).problems(),
    };
    Ok(problems.to_string())
}

/// A document in JSON, with every field that has a default.
#[wasm_bindgen(js_name = parse)]
pub fn parse_document(text: &str, format: &str) -> Result<String, JsValue> {
    Ok(written(&read(text, format)?))
}

/// The same scene for another solver.
#[wasm_bindgen]
pub fn with_solver(text: &str, solver: &str) -> Result<String, JsValue> {
    let mut scene = read(text, "json")?;
    scene.settings.use_solver(match solver {
        "default" => Solver::Default,
        "paper" => Solver::Paper,
        other => {
            let message = format!("{other:?} is no solver: default or paper");
            return Err(Failure::invalid("solver", message).into());
        }
    });
    Ok(written(&scene))
}

/// A document, read but not judged.
pub(crate) fn read(text: &str, format: &str) -> Result<Scene, Failure> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    match notation(format)? {
        Format::Json5 => parse_part(&json_of_json5(text)?).map_err(without_place),
        _ => Ok(parse_part(text)?),
    }
}

/// A refusal of JSON that was made of JSON5, in which its place says nothing.
fn without_place(error: Error) -> Failure {
    let mut failure = Failure::from(error);
    failure.forget_places();
    failure
}

pub(crate) fn notation(format: &str) -> Result<Format, Failure> {
    match format {
        "json" => Ok(Format::Json),
        "json5" => Ok(Format::Json5),
        other => Err(Failure::invalid("format", format!("{other:?} is no format: json or json5"))),
    }
}

/// Documents are plain data, which has no way to fail.
fn written(scene: &Scene) -> String {
    serde_json::to_string(scene).unwrap_or_default()
}
