//! Handles that outlive what they name: a number of a slot and the generation it is in.

use serde::{Deserialize, Serialize};

use crate::error::Error;

/// What every handle is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub(crate) struct Key {
    slot: u32,
    generation: u32,
}

/// Names a body of a world, also after other bodies have been removed. The handle of a removed body is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct BodyHandle(Key);

/// Names a joint of a world, also after others have been removed. The handle of a joint that was removed, by itself
/// or with one of its bodies, is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct JointHandle(Key);

/// Names an attachment of a world, also after others have been removed. The handle of an attachment that was removed, by
/// itself or with one of its bodies, is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct AttachmentHandle(Key);

macro_rules! handles {
    ($($handle:ident),*) => {
        $(impl From<Key> for $handle {
            fn from(key: Key) -> Self {
                Self(key)
            }
        }
        impl From<$handle> for Key {
            fn from(handle: $handle) -> Self {
                handle.0
            }
        })*
    };
}
handles!(BodyHandle, JointHandle, AttachmentHandle);

/// Which handle names which item of a list.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Slots {
    /// Per slot its generation, and the index of the item in it.
    slots: Vec<(u32, Option<u32>)>,
    free: Vec<u32>,
    /// Per item its slot.
    of_item: Vec<u32>,
}

impl Slots {
    /// A handle for an item that is appended.
    pub(crate) fn push<H: From<Key>>(&mut self) -> H {
        let index = self.of_item.len() as u32;
        let slot = self.free.pop().unwrap_or(self.slots.len() as u32);
        if slot as usize == self.slots.len() {
            self.slots.push((0, None));
        }
        self.slots[slot as usize].1 = Some(index);
        self.of_item.push(slot);
        self.handle(index as usize)
    }

    pub(crate) fn handle<H: From<Key>>(&self, index: usize) -> H {
        let slot = self.of_item[index];
        Key { slot, generation: self.slots[slot as usize].0 }.into()
    }

    pub(crate) fn index(&self, handle: impl Into<Key>) -> Result<usize, Error> {
        let handle = handle.into();
        match self.slots.get(handle.slot as usize) {
            Some(&(generation, Some(index))) if generation == handle.generation => Ok(index as usize),
            _ => Err(Error::StaleHandle),
        }
    }

    /// Retires the handle of an item; the items behind it move down by one.
    pub(crate) fn remove(&mut self, index: usize) {
        let slot = self.of_item.remove(index);
        let (generation, _) = self.slots[slot as usize];
        self.slots[slot as usize] = (generation.wrapping_add(1), None);
        self.free.push(slot);
        for (_, item) in &mut self.slots {
            *item = item.map(|item| item - u32::from(item as usize > index));
        }
    }

    /// Whether every empty slot is free exactly once, and no other is.
    fn is_free_sound(&self) -> bool {
        let empty = (0..self.slots.len() as u32).filter(|&slot| self.slots[slot as usize].1.is_none());
        let mut free = self.free.clone();
        free.sort_unstable();
        empty.eq(free)
    }

    pub(crate) fn is_valid(&self, item_count: usize) -> bool {
        self.of_item.len() == item_count
            && self.of_item.iter().enumerate().all(|(index, &slot)| {
                self.slots.get(slot as usize).is_some_and(|&(_, item)| item == Some(index as u32))
            })
            && self.slots.iter().flat_map(|(_, item)| item).count() == item_count
            && self.is_free_sound()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_removed_handle_stays_refused_when_its_slot_is_used_again() {
        let mut slots = Slots::default();
        let (first, second): (BodyHandle, BodyHandle) = (slots.push(), slots.push());
        slots.remove(0);
        assert_eq!(slots.index(first), Err(Error::StaleHandle));
        assert_eq!(slots.index(second), Ok(0));
        let third: BodyHandle = slots.push();
        assert_eq!(slots.index(third), Ok(1));
        assert_eq!(slots.index(first), Err(Error::StaleHandle));
        assert!(slots.is_valid(2));
    }
}
