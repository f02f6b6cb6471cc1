//! What a file says besides its surface.

use std::fmt;

/// Something that was passed over, and how often it came.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// What it is, such as "materials".
    pub what: String,
    /// How often.
    pub count: usize,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.count, self.what)
    }
}

/// Unknown things that are told apart: names in a hostile file may all differ.
const MOST: usize = 20;

/// Notes under way, in the order in which they first came.
#[derive(Debug, Default)]
pub(super) struct Notes(Vec<Note>);

impl Notes {
    /// Counts `count` more of something; what is never seen is not noted.
    pub(super) fn add(&mut self, what: &str, count: usize) {
        if count == 0 {
            return;
        }
        let what =
            if self.0.len() < MOST || self.0.iter().any(|note| note.what == what) { what } else { "others" };
        match self.0.iter_mut().find(|note| note.what == what) {
            Some(note) => note.count += count,
            None => self.0.push(Note { what: what.to_owned(), count }),
        }
    }

    pub(super) fn into_vec(self) -> Vec<Note> {
        self.0
    }
}
