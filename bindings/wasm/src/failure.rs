//! Refusals, as the package turns them into its `TautlineError`.

use serde_json::{Value, json};
use tautline_scene::document::locate_in_json;
use tautline_scene::mesh_file::Refusal;
use tautline_scene::{Error, Problem};
use wasm_bindgen::JsValue;

use crate::scenes::notation;

/// Why a call was refused: `{kind, problems: [{path, message, line?, column?}]}`.
pub(crate) struct Failure {
    kind: &'static str,
    problems: Vec<Problem>,
    /// Line and column of each problem, from 1, as far as they are known.
    places: Vec<Option<(usize, usize)>>,
}

impl Failure {
    /// Values that are wrong.
    pub(crate) fn invalid(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self::of("invalid", path, message)
    }

    /// A text or file that is none of its kind.
    pub(crate) fn parse(message: impl Into<String>) -> Self {
        Self::of("parse", "", message)
    }

    fn of(kind: &'static str, path: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            kind,
            problems: vec![Problem { path: path.into(), message: message.into() }],
            places: vec![None],
        }
    }

    /// With the places of problems in the text that they are of, where those are not known yet.
    pub(crate) fn located(mut self, text: &str, format: &str) -> Self {
        if notation(format).is_err() {
            return self;
        }
        for (problem, place) in self.problems.iter().zip(&mut self.places) {
            place.get_or_insert_with(|| locate_in_json(text, &problem.path));
        }
        self
    }

    /// Forgets where in a text its problems are.
    pub(crate) fn forget_places(&mut self) {
        self.places.fill(None);
    }

    /// Its problems, each as an object.
    pub(crate) fn problems(&self) -> Value {
        let told = |(problem, place): (&Problem, &Option<(usize, usize)>)| {
            let mut told = json!({ "path": problem.path, "message": problem.message });
            if let Some((line, column)) = place {
                told["line"] = json!(line);
                told["column"] = json!(column);
            }
            told
        };
        self.problems.iter().zip(&self.places).map(told).collect::<Vec<_>>().into()
    }
}

impl From<tautline::Error> for Failure {
    fn from(error: tautline::Error) -> Self {
        use tautline::Error as E;
        match error {
            E::OutOfRange { field, value, expected } => {
                Self::invalid(field, format!("{value} is not {expected}"))
            }
            E::Invalid { field, problem } => Self::invalid(field, problem),
            E::StaleHandle => Self::of("stale", "", error.to_string()),
            E::Mesh(defect) => Self::invalid("mesh", defect.to_string()),
            E::Snapshot(problem) => Self::invalid("snapshot", problem),
            other => Self::invalid("", other.to_string()),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Engine(error) => error.into(),
            Error::Invalid(problems) => {
                let places = vec![None; problems.len()];
                Self { kind: "invalid", problems, places }
            }
            Error::Parse(error) => Self {
                places: vec![Some((error.line, error.column))],
                ..Self::of("parse", error.field, error.message)
            },
            Error::Mesh { refusal, .. } => refusal.into(),
            Error::ParameterValue { name, value, expected } => {
                Self::invalid(format!("parameters.{name}"), format!("{value:?} is not {expected}"))
            }
            Error::UnknownParameter { ref name, .. } => {
                Self::invalid(format!("parameters.{name}"), error.to_string())
            }
            other => Self::invalid("", other.to_string()),
        }
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        let places = vec![refusal.line().map(|line| (line, 1))];
        Self { places, ..Self::parse(refusal.to_string()) }
    }
}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> Self {
        let text = json!({ "kind": failure.kind, "problems": failure.problems() }).to_string();
        JsValue::from_str(&text)
    }
}
