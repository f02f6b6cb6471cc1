//! TOML as JSON, for the one reader of documents. What is kept of a long text is text: a tree of all its values would take
//! many times as much.
//!
//! The library `toml_parser` splits the text into tokens and decodes keys, strings and numbers. How tokens make
//! statements and values is in `reader`, what may be in which table in `table`, and where something is in `trail`.

mod reader;
mod table;
mod trail;

use reader::Reader;
use trail::{Search, Trail};

/// Why a text was refused, and the byte where.
#[derive(Debug)]
pub(super) struct Refusal {
    pub(super) offset: usize,
    pub(super) message: String,
}

impl Refusal {
    fn new(offset: usize, message: impl Into<String>) -> Self {
        Self { offset, message: message.into() }
    }
}

/// What there is, or why not.
type Outcome<T = ()> = Result<T, Refusal>;

/// The JSON that says the same. Numbers that are not finite, dates and times, which no JSON has, are refused, and so is more
/// nesting than any document has, or more keys.
pub(super) fn to_json(text: &str) -> Outcome<String> {
    Reader::new(text).document(Trail::NONE)
}

/// Byte offset of the value at a path, or of the innermost one on the way to it that is there. Of a table that a header or
/// a dotted key makes, it is that of its name.
pub(super) fn offset_of(text: &str, path: &str) -> usize {
    let search = Search::new(path);
    // A text that is refused is searched up to there.
    let _ = Reader::new(text).document(Trail::of(&search));
    search.found()
}

#[cfg(test)]
mod tests;
