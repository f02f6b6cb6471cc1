//! Handles that outlive what they name: a number of a slot and the generation it is in.

use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Names a body of a world, also after other bodies have been removed. The handle of a removed body is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct BodyHandle {
    slot: u32,
    generation: u32,
}

/// Which handle names which body.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Slots {
    /// Per slot its generation, and the index of the body in it.
    slots: Vec<(u32, Option<u32>)>,
    free: Vec<u32>,
    /// Per body its slot.
    of_body: Vec<u32>,
}

impl Slots {
    /// A handle for a body that is appended.
    pub(crate) fn push(&mut self) -> BodyHandle {
        let index = self.of_body.len() as u32;
        let slot = self.free.pop().unwrap_or(self.slots.len() as u32);
        if slot as usize == self.slots.len() {
            self.slots.push((0, None));
        }
        self.slots[slot as usize].1 = Some(index);
        self.of_body.push(slot);
        self.handle(index as usize)
    }

    pub(crate) fn handle(&self, index: usize) -> BodyHandle {
        let slot = self.of_body[index];
        BodyHandle { slot, generation: self.slots[slot as usize].0 }
    }

    pub(crate) fn index(&self, handle: BodyHandle) -> Result<usize, Error> {
        match self.slots.get(handle.slot as usize) {
            Some(&(generation, Some(index))) if generation == handle.generation => Ok(index as usize),
            _ => Err(Error::StaleHandle),
        }
    }

    /// Retires the handle of a body; the bodies behind it move down by one.
    pub(crate) fn remove(&mut self, index: usize) {
        let slot = self.of_body.remove(index);
        let (generation, _) = self.slots[slot as usize];
        self.slots[slot as usize] = (generation.wrapping_add(1), None);
        self.free.push(slot);
        for (_, body) in &mut self.slots {
            *body = body.map(|body| body - u32::from(body as usize > index));
        }
    }

    /// Whether every empty slot is free exactly once, and no other is.
    fn is_free_sound(&self) -> bool {
        let empty = (0..self.slots.len() as u32).filter(|&slot| self.slots[slot as usize].1.is_none());
        let mut free = self.free.clone();
        free.sort_unstable();
        empty.eq(free)
    }

    pub(crate) fn is_valid(&self, body_count: usize) -> bool {
        self.of_body.len() == body_count
            && self.of_body.iter().enumerate().all(|(index, &slot)| {
                self.slots.get(slot as usize).is_some_and(|&(_, body)| body == Some(index as u32))
            })
            && self.slots.iter().flat_map(|(_, body)| body).count() == body_count
            && self.is_free_sound()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_removed_handle_stays_refused_when_its_slot_is_used_again() {
        let mut slots = Slots::default();
        let (first, second) = (slots.push(), slots.push());
        slots.remove(0);
        assert_eq!(slots.index(first), Err(Error::StaleHandle));
        assert_eq!(slots.index(second), Ok(0));
        let third = slots.push();
        assert_eq!(slots.index(third), Ok(1));
        assert_eq!(slots.index(first), Err(Error::StaleHandle));
        assert!(slots.is_valid(2));
    }
}
