//! Numbers of bodies, joints and attachments, never used twice.

use std::collections::BTreeMap;

use tautline::{AttachmentHandle, BodyHandle, Error, GrabHandle, JointHandle};

/// What can be numbered.
pub trait Numbered: Copy + Ord {}

impl Numbered for BodyHandle {}
impl Numbered for JointHandle {}
impl Numbered for AttachmentHandle {}
impl Numbered for GrabHandle {}

/// Which number is which handle. A number goes stale with its handle and is not given to another.
#[derive(Debug, Clone)]
pub struct Numbers<H> {
    /// By number.
    handles: Vec<Option<H>>,
    of: BTreeMap<H, u32>,
}

impl<H> Default for Numbers<H> {
    fn default() -> Self {
        Self { handles: Vec::new(), of: BTreeMap::new() }
    }
}

impl<H: Numbered> Numbers<H> {
    /// The handle of a number. That of what has been removed stays known, since a snapshot may bring it back: the world
    /// refuses it until then.
    ///
    /// # Errors
    /// [`Error::StaleHandle`] for a number that was never given, or only before all was built anew.
    pub fn handle(&self, number: u32) -> Result<H, Error> {
        self.handles.get(number as usize).copied().flatten().ok_or(Error::StaleHandle)
    }

    /// The number of a handle.
    pub fn number(&self, handle: H) -> Option<u32> {
        self.of.get(&handle).copied()
    }

    /// The number that comes next.
    pub(super) fn next(&self) -> u32 {
        self.handles.len() as u32
    }

    /// A number for what is new, even if something had its handle in a past that was undone.
    pub fn push_new(&mut self, handle: H) -> u32 {
        let number = self.next();
        self.handles.push(Some(handle));
        if let Some(old) = self.of.insert(handle, number) {
            self.handles[old as usize] = None;
        }
        number
    }

    /// The number of a handle that may be new.
    pub fn push(&mut self, handle: H) -> u32 {
        *self.of.entry(handle).or_insert_with(|| {
            self.handles.push(Some(handle));
            self.handles.len() as u32 - 1
        })
    }

    /// Numbers from 0 on for what was built first or anew.
    pub(super) fn assign(&mut self, all: impl Iterator<Item = H>) {
        for (number, handle) in all.enumerate() {
            match self.handles.get_mut(number) {
                Some(place) => *place = Some(handle),
                None => self.handles.push(Some(handle)),
            }
            self.of.insert(handle, number as u32);
        }
    }

    /// No number names anything.
    pub fn forget_all(&mut self) {
        self.handles.fill(None);
        self.of.clear();
    }
}
