//! Numbers as text. Elements are told apart by their number of words, not by lines.

use super::super::Refusal;
use super::super::words::Words;
use super::header::{Element, Kind};
use super::source::{Source, check_room};

/// The words after the header.
#[derive(Clone)]
pub(super) struct Text<'a> {
    words: Words<'a>,
    /// Bytes of the words not yet read, at most.
    remaining: usize,
}

impl<'a> Text<'a> {
    pub(super) fn new(text: &'a str, first_line: usize) -> Self {
        Self { words: Words::new(text, first_line), remaining: text.len() }
    }

    fn next(&mut self) -> Option<&'a str> {
        let word = self.words.next()?;
        self.remaining -= word.len();
        Some(word)
    }
}

impl Source for Text<'_> {
    fn check_room(&self, element: &Element) -> Result<(), Refusal> {
        // A digit for each number.
        check_room(element, element.properties.len(), self.remaining).map_err(Refusal::new)
    }

    fn integer(&mut self, _: Kind) -> Result<i64, Refusal> {
        let word = self.next();
        let number = word.and_then(|word| word.parse().ok());
        number.ok_or_else(|| self.words.unexpected(word, "a whole number"))
    }

    fn coordinate(&mut self, _: Kind) -> Result<f32, Refusal> {
        let word = self.next();
        let number = word.and_then(super::super::words::coordinate);
        number.ok_or_else(|| self.words.unexpected(word, "a coordinate, a finite number"))
    }

    fn skip(&mut self, _: Kind, count: usize) -> Result<(), Refusal> {
        for _ in 0..count {
            self.next().ok_or_else(|| self.words.unexpected(None, "a number"))?;
        }
        Ok(())
    }

    fn refuse(&self, message: String) -> Refusal {
        self.words.refuse(message)
    }

    fn remaining(&self) -> usize {
        self.remaining
    }
}
