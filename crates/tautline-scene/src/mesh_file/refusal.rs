//! Why a mesh file was refused, and where in it.

use std::fmt;

use crate::error::legible;

/// What is wrong with a mesh file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Where, if not everywhere.
    pub place: Option<Place>,
    /// What is wrong and what would be right.
    pub message: String,
}

/// A place in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// The line of a text, from 1.
    Line(usize),
    /// The byte of a binary file, from 0.
    Byte(usize),
    /// The path of a field of JSON, such as `meshes[0].primitives[1].indices`.
    Field(String),
}

impl Refusal {
    pub(super) fn new(message: impl Into<String>) -> Self {
        Self { place: None, message: legible(message) }
    }

    pub(super) fn at_line(line: usize, message: impl Into<String>) -> Self {
        Self { place: Some(Place::Line(line)), message: legible(message) }
    }

    pub(super) fn at_byte(byte: usize, message: impl Into<String>) -> Self {
        Self { place: Some(Place::Byte(byte)), message: legible(message) }
    }

    pub(super) fn at_field(field: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: Some(Place::Field(legible(field))), message: legible(message) }
    }

    /// The line, where the place is one.
    pub fn line(&self) -> Option<usize> {
        match self.place {
            Some(Place::Line(line)) => Some(line),
            _ => None,
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Some(place) => write!(f, "{place}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Field(field) => f.write_str(field),
        }
    }
}

impl std::error::Error for Refusal {}

/// A word of a file, in quotes and shortened: a hostile one may be as long as the file.
pub(super) fn quoted(word: &str) -> String {
    const LONGEST: usize = 40;
    let shown: String = word.chars().take(LONGEST).collect();
    let more = if shown.len() < word.len() { "…" } else { "" };
    format!("{shown:?}{more}")
}
