//! Looks for the place of a value while a text is read.

use std::cell::Cell;

/// The path of a value, and how much of it has been seen where.
pub(super) struct Search<'p> {
    /// Names, and indices as they are written.
    steps: Vec<&'p str>,
    /// The length of the longest part of the path that has been seen, and the offset where it was first.
    found: Cell<(usize, usize)>,
}

impl<'p> Search<'p> {
    /// For a path such as `bodies[3].cloth.mass`.
    pub(super) fn new(path: &'p str) -> Self {
        let steps = path.split(['.', '[', ']']).filter(|step| !step.is_empty()).collect();
        Self { steps, found: Cell::default() }
    }

    pub(super) fn found(&self) -> usize {
        let (_, offset) = self.found.get();
        offset
    }
}

/// Goes into values beside the reader, for as long as the path looked for leads there.
#[derive(Clone, Copy)]
pub(super) struct Trail<'s>(Option<(&'s Search<'s>, usize)>);

impl<'s> Trail<'s> {
    /// Nothing is looked for.
    pub(super) const NONE: Self = Self(None);

    pub(super) fn of(search: &'s Search<'s>) -> Self {
        Self(Some((search, 0)))
    }

    /// Into the value of a key.
    pub(super) fn key(self, name: &str, offset: usize) -> Self {
        self.follow(offset, |step| step == name)
    }

    /// Into an item of a list.
    pub(super) fn item(self, index: usize, offset: usize) -> Self {
        self.follow(offset, |step| step.parse() == Ok(index))
    }

    /// Into an item of a list, or no further.
    pub(super) fn item_if(self, index: Option<usize>, offset: usize) -> Self {
        index.map_or(self, |index| self.item(index, offset))
    }

    fn follow(self, offset: usize, is_there: impl FnOnce(&str) -> bool) -> Self {
        let Self(Some((search, depth))) = self else { return Self::NONE };
        if !search.steps.get(depth).is_some_and(|step| is_there(step)) {
            return Self::NONE;
        }
        let depth = depth + 1;
        if depth > search.found.get().0 {
            search.found.set((depth, offset));
        }
        Self(Some((search, depth)))
    }
}
