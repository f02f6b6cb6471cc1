//! Errors of the engine and of scenes as exceptions of `tautline._errors`, with the path of the field.

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

/// An exception to be raised.
pub(crate) struct Failure(PyErr);

/// What a method returns.
pub(crate) type Outcome<T> = Result<T, Failure>;

impl Failure {
    /// A value that is wrong, by its field.
    pub(crate) fn invalid(path: &str, problem: impl std::fmt::Display) -> Self {
        raise("InvalidValueError", &format!("{path}: {problem}"), Some(path), &[])
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        failure.0
    }
}

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Self(error)
    }
}

impl From<tautline::Error> for Failure {
    fn from(error: tautline::Error) -> Self {
        use tautline::Error;
        let text = error.to_string();
        match &error {
            Error::OutOfRange { field, .. } | Error::Invalid { field, .. } => {
                raise("InvalidValueError", &text, Some(field), &[])
            }
            Error::Mesh(_) => raise("MeshError", &text, Some("mesh"), &[]),
            Error::StaleHandle => raise("StaleHandleError", &text, None, &[]),
            Error::Snapshot(_) => raise("SnapshotError", &text, Some("snapshot"), &[]),
            _ => raise("TautlineError", &text, None, &[]),
        }
    }
}

impl From<tautline_scene::Error> for Failure {
    fn from(error: tautline_scene::Error) -> Self {
        use tautline_scene::Error;
        let text = error.to_string();
        match error {
            Error::Engine(error) => error.into(),
            Error::Io { path, source } => {
                let path = path.display().to_string();
                // With a number Python picks the class, such as FileNotFoundError.
                let error = match source.raw_os_error() {
                    Some(number) => PyOSError::new_err((number, source.to_string(), path)),
                    None => PyOSError::new_err(text),
                };
                Failure(error)
            }
            Error::Parse(error) => raise(
                "SceneError",
                &text,
                Some(&error.field),
                &[(error.field.clone(), error.message.clone())],
            ),
            Error::Invalid(problems) => {
                let list: Vec<_> =
                    problems.into_iter().map(|problem| (problem.path, problem.message)).collect();
                let first = list.first().map(|(path, _)| path.clone());
                raise("SceneError", &text, first.as_deref(), &list)
            }
            Error::Mesh { path, .. } => raise("MeshError", &text, Some(&path.display().to_string()), &[]),
            Error::UnknownScene { .. } => raise("InvalidValueError", &text, Some("name"), &[]),
            Error::UnknownParameter { name, .. } | Error::ParameterValue { name, .. } => {
                raise("InvalidValueError", &text, Some(&name), &[])
            }
            Error::UnsupportedFormat { .. } => raise("InvalidValueError", &text, Some("path"), &[]),
            Error::Unsupported { option, .. } => raise("InvalidValueError", &text, Some(option), &[]),
            Error::Recording { track, .. } => raise("TautlineError", &text, Some(&track), &[]),
            _ => raise("TautlineError", &text, None, &[]),
        }
    }
}

/// An exception of `tautline._errors` by the name of its class.
fn raise(class: &str, message: &str, path: Option<&str>, problems: &[(String, String)]) -> Failure {
    Python::attach(|py| {
        let make = || {
            let class = py.import("tautline._errors")?.getattr(class)?;
            class.call1((message, path, problems.to_vec()))
        };
        Failure(match make() {
            Ok(exception) => PyErr::from_value(exception),
            Err(error) => error,
        })
    })
}
