//! Text to document, in three notations, with the place of the first thing that is not one.

use std::path::Path;

use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Deserializer};

use super::{Scene, limits, locate, nesting, toml};
use crate::error::{Error, ParseError, legible};

/// A notation for documents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// JSON.
    Json,
    /// JSON with comments and trailing commas.
    Json5,
    /// TOML.
    Toml,
}

impl Format {
    /// The notation that a file's extension names, in any case: `json`, `json5` or `toml`.
    pub fn of_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "json" => Some(Self::Json),
            "json5" => Some(Self::Json5),
            "toml" => Some(Self::Toml),
            _ => None,
        }
    }
}

/// The most bytes of JSON5 that become JSON: in between they take up to a hundred times as much memory.
const JSON5_BYTES: usize = 16 << 20;

/// Reads a document. Its values are not judged: that is [`Scene::check`].
///
/// # Errors
/// [`Error::Parse`] with the line, the column and the path of the field.
pub fn parse(text: &str, format: Format) -> Result<Scene, Error> {
    refuse_large(text)?;
    match format {
        Format::Json => parse_json(text),
        Format::Json5 => parse_json5(text),
        Format::Toml => parse_toml(text),
    }
}

/// Reads a part of a document, such as one body, from JSON. Its values are not judged.
///
/// # Errors
/// As [`parse`].
pub fn parse_part<Part: DeserializeOwned>(text: &str) -> Result<Part, Error> {
    refuse_large(text)?;
    parse_json(text)
}

/// JSON of a JSON5 text, for [`parse_part`]: one deserializer for both notations is half the code. Fields of which there
/// are two are one then, the last. What is wrong with the values behind it is told by paths, for [`locate`](super::locate()) to find.
///
/// # Errors
/// [`Error::Parse`] with the line and the column.
pub fn json_of_json5(text: &str) -> Result<String, Error> {
    if text.len() > JSON5_BYTES {
        let message = format!("{} bytes of JSON5 are more than {JSON5_BYTES}", text.len());
        return Err(refusal("", (1, 1), message));
    }
    let value: serde_json::Value = read_json5(text)?;
    Ok(value.to_string())
}

fn refuse_large(text: &str) -> Result<(), Error> {
    if text.len() as u64 > limits::FILE_BYTES {
        let message = format!("{} bytes are more than {}", text.len(), limits::FILE_BYTES);
        return Err(refusal("", (1, 1), message));
    }
    Ok(())
}

fn parse_json<Part: DeserializeOwned>(text: &str) -> Result<Part, Error> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let place = |error: &serde_json::Error| (error.line(), error.column().max(1));
    let message = |error: &serde_json::Error| {
        let text = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        text.strip_suffix(&place).unwrap_or(&text).to_owned()
    };
    let scene = at_path(&mut deserializer, place, message)?;
    deserializer.end().map_err(|error| refusal("", place(&error), message(&error)))?;
    Ok(scene)
}

fn parse_json5(text: &str) -> Result<Scene, Error> {
    // The whole text first: only this entry looks for something after the end of the document.
    read_json5::<IgnoredAny>(text)?;
    at_path(&mut json5::Deserializer::from_str(text), |error| place_json5(text, error), message_json5)
}

/// Reads all of a text, without the path of what is wrong.
fn read_json5<T: DeserializeOwned>(text: &str) -> Result<T, Error> {
    if let Some(offset) = nesting::too_deep(text) {
        let message = format!("it nests more than {} levels deep", limits::NESTING);
        return Err(refusal("", line_and_column(text, offset), message));
    }
    json5::from_str(text).map_err(|error| refusal("", place_json5(text, &error), message_json5(&error)))
}

/// Where the text ends too early: the start of what is not closed, or without a position.
fn place_json5(text: &str, error: &json5::Error) -> (usize, usize) {
    error.position().map_or_else(|| line_and_column(text, text.len()), |at| (at.line + 1, at.column + 1))
}

fn message_json5(error: &json5::Error) -> String {
    match error.code() {
        Some(code) => code.to_string(),
        None => {
            let text = error.to_string();
            let place = error.position().map_or_else(String::new, |at| format!(" at {at}"));
            text.strip_suffix(&place).unwrap_or(&text).to_owned()
        }
    }
}

fn parse_toml(text: &str) -> Result<Scene, Error> {
    let json = toml::to_json(text)
        .map_err(|error| refusal("", line_and_column(text, error.offset), error.message))?;
    let scene = parse_json(&json);
    // To find a place in the text takes as much memory again.
    drop(json);
    scene.map_err(|error| match error {
        Error::Parse(mut error) => {
            (error.line, error.column) = locate(text, Format::Toml, &error.field);
            Error::Parse(error)
        }
        other => other,
    })
}

/// Reads a document and tells the path of the field that could not be read.
fn at_path<'de, Part: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
    place: impl Fn(&D::Error) -> (usize, usize),
    message: impl Fn(&D::Error) -> String,
) -> Result<Part, Error> {
    serde_path_to_error::deserialize(deserializer).map_err(|error| {
        let path = error.path().to_string();
        // `.` is the root, `?` a key that could not be read.
        let field = path.trim_end_matches('?').trim_end_matches('.');
        refusal(field, place(error.inner()), message(error.inner()))
    })
}

fn refusal(field: &str, (line, column): (usize, usize), message: String) -> Error {
    let (field, message) = (legible(field), legible(message));
    Error::Parse(Box::new(ParseError { file: None, field, line, column, message }))
}

/// Line and column, from 1, of a byte; the column counts characters.
pub(crate) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let column = before.get(line_start..).unwrap_or_default().chars().count() + 1;
    (before.matches('\n').count() + 1, column)
}
