//! The one error type of scenes: which file, which field, what is wrong and what would be right.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::mesh_file::{Place, Refusal};

/// Why a scene or a file was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file that cannot be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A document that is not JSON, JSON5 or TOML, or whose fields are not those of a scene.
    #[error("{0}")]
    Parse(Box<ParseError>),
    /// A document whose values are wrong: every problem, in the document's order.
    #[error("{}", list(.0))]
    Invalid(Vec<Problem>),
    /// A mesh file that is malformed.
    #[error("{}{}: {}", path.display(), place(refusal), refusal.message)]
    Mesh {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where in it.
        refusal: Refusal,
    },
    /// A name that no scene has.
    #[error("there is no scene named {name:?}; there are: {}", known.join(", "))]
    UnknownScene {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: Vec<&'static str>,
    },
    /// A name that no parameter of the scene has.
    #[error("the scene {scene} has no parameter named {name:?}; it has: {}", known.join(", "))]
    UnknownParameter {
        /// The scene's name.
        scene: &'static str,
        /// The name asked for.
        name: String,
        /// The names there are.
        known: Vec<&'static str>,
    },
    /// A value that a scene's parameter cannot have.
    #[error("{name}: {value:?} is not {expected}")]
    ParameterValue {
        /// The parameter's name.
        name: String,
        /// The value given; empty where there was none.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A file name whose extension names no format that can be read or written.
    #[error("{}: no known format; the extension must be one of {supported}", path.display())]
    UnsupportedFormat {
        /// The file asked for.
        path: PathBuf,
        /// The extensions that would do, such as ".json, .json5, .toml".
        supported: &'static str,
    },
    /// A picture of a size, rate or frame that cannot be made.
    #[error("{option}: {problem}")]
    Unsupported {
        /// The option in question, such as `width`.
        option: &'static str,
        /// What is wrong and what would be right.
        problem: String,
    },
    /// A recording that contradicts itself.
    #[error("recording, track \"{track}\": {problem}")]
    Recording {
        /// The track's name.
        track: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The engine refused what the scene asked of it.
    #[error(transparent)]
    Engine(#[from] tautline::Error),
}

impl Error {
    /// An input or output error at `path`.
    pub(crate) fn io(path: &Path, source: std::io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }
}

/// A message for people. What it quotes of a file may be as long as the file, or have characters that a terminal obeys.
pub(crate) fn legible(message: impl Into<String>) -> String {
    /// In bytes: of the beginning, and of the end, where it says what would be right.
    const HEAD: usize = 100;
    const TAIL: usize = 300;
    let mut message: String = message.into();
    if message.len() > HEAD + TAIL {
        let is_boundary = |&at: &usize| message.is_char_boundary(at);
        let head = (0..=HEAD).rev().find(is_boundary).unwrap_or(0);
        let tail = (message.len() - TAIL..message.len()).find(is_boundary).unwrap_or(message.len());
        message.replace_range(head..tail, "…");
    }
    if !message.contains(char::is_control) {
        return message;
    }
    let escaped = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    message.chars().map(escaped).collect()
}

/// Where a document stopped making sense, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct ParseError {
    /// The file, where it came from one.
    pub file: Option<PathBuf>,
    /// Path of the field, such as `bodies[3].cloth.mass`; empty where the text itself is malformed.
    pub field: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.file {
            Some(file) => write!(f, "{}:{}:{}: ", file.display(), self.line, self.column)?,
            None => write!(f, "line {}, column {}: ", self.line, self.column)?,
        }
        if !self.field.is_empty() {
            write!(f, "{}: ", self.field)?;
        }
        f.write_str(&self.message)
    }
}

/// One thing wrong with a document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Path of the field, such as `bodies[3].cloth.mass`.
    pub path: String,
    /// What was found there and what would be right, such as `-1 is not a finite number above 0`.
    pub message: String,
}

impl Problem {
    /// The same problem of a part of something, whose path begins so.
    pub(crate) fn within(self, start: &str) -> Self {
        Self { path: format!("{start}{}", self.path), ..self }
    }

    /// The same problem of a part by itself, whose path begins so in the whole.
    pub(crate) fn without(self, start: &str) -> Self {
        let path = self.path.strip_prefix(start).map(str::to_owned);
        Self { path: path.unwrap_or(self.path), ..self }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.message)
    }
}

/// One problem a line.
fn list(problems: &[Problem]) -> String {
    problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n")
}

/// `:12` for line 12, as editors understand it; other places in words.
fn place(refusal: &Refusal) -> String {
    match &refusal.place {
        Some(Place::Line(line)) => format!(":{line}"),
        Some(place) => format!(": {place}"),
        None => String::new(),
    }
}
