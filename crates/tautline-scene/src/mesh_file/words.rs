//! The words of a text, with the line that each is in.

use super::Refusal;
use super::refusal::quoted;

/// A coordinate as text; one that is not finite is none.
pub(super) fn coordinate(word: &str) -> Option<f32> {
    word.parse().ok().filter(|value: &f32| value.is_finite())
}

/// The words of a text, and the line of the next.
#[derive(Clone)]
pub(super) struct Words<'a> {
    lines: std::str::Lines<'a>,
    words: std::iter::Peekable<std::str::SplitAsciiWhitespace<'a>>,
    line: usize,
}

impl<'a> Words<'a> {
    /// Begins before a text whose first line has this number.
    pub(super) fn new(text: &'a str, first_line: usize) -> Self {
        Self { lines: text.lines(), words: "".split_ascii_whitespace().peekable(), line: first_line - 1 }
    }

    pub(super) fn peek(&mut self) -> Option<&'a str> {
        while self.words.peek().is_none() {
            let line = self.lines.next()?;
            self.line += 1;
            self.words = line.split_ascii_whitespace().peekable();
        }
        self.words.peek().copied()
    }

    pub(super) fn next(&mut self) -> Option<&'a str> {
        self.peek()?;
        self.words.next()
    }

    pub(super) fn skip_line(&mut self) {
        self.words = "".split_ascii_whitespace().peekable();
    }

    pub(super) fn keyword(&mut self, keyword: &str) -> Result<(), Refusal> {
        match self.next() {
            Some(word) if word.eq_ignore_ascii_case(keyword) => Ok(()),
            found => Err(self.unexpected(found, &format!("`{keyword}`"))),
        }
    }

    /// The next word as a coordinate.
    pub(super) fn coordinate(&mut self) -> Result<f32, Refusal> {
        let found = self.next();
        found.and_then(coordinate).ok_or_else(|| self.unexpected(found, "a coordinate, a finite number"))
    }

    /// A refusal of the word read last.
    pub(super) fn unexpected(&self, found: Option<&str>, expected: &str) -> Refusal {
        self.refuse(match found {
            Some(word) => format!("{} is not {expected}", quoted(word)),
            None => format!("the file ends where {expected} should be"),
        })
    }

    /// A refusal of the line that was read last.
    pub(super) fn refuse(&self, message: String) -> Refusal {
        Refusal::at_line(self.line, message)
    }
}
