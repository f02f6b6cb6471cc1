//! Pairs of parts of rigid bodies that are near each other, kept from step to step.
//!
//! The list is made from boxes that are larger than their bodies, and holds until a body leaves its box: bodies at
//! rest never do. A pair that is still there when the list is made anew keeps its contact and its multipliers.

use serde::{Deserialize, Serialize};

use super::held::{Held, MOST_POINTS};
use crate::body::{Body, Substance, Touch};
use crate::geometry::manifold::Memory;

/// What is looked at in every step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Pair {
    /// Indices of the bodies in the world.
    pub(super) a: u32,
    pub(super) b: u32,
    /// The sum of the versions of both when their contact was found.
    pub(super) stamp: u32,
    /// How many points it has.
    pub(super) points: u32,
}

/// What is looked at if a body has moved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Detail {
    /// The part of a's shape, and that of b's: of a mesh its triangle.
    pub(super) part_a: u32,
    pub(super) part_b: u32,
    pub(super) touch: Touch,
    pub(super) memory: Memory,
    /// Once there is one.
    pub(super) held: Option<Box<Held>>,
}

/// Which parts a pair is of. Sorted by this.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) part_a: u32,
    pub(super) part_b: u32,
}

/// A stamp that no versions add up to.
pub(super) const NEVER: u32 = u32::MAX;

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pairs {
    pub(super) pairs: Vec<Pair>,
    pub(super) details: Vec<Detail>,
}

impl Pairs {
    pub(super) fn key(&self, index: usize) -> Key {
        let (pair, detail) = (&self.pairs[index], &self.details[index]);
        Key { a: pair.a, b: pair.b, part_a: detail.part_a, part_b: detail.part_b }
    }

    /// Makes the list anew from ascending keys.
    pub(super) fn replace(&mut self, keys: &[Key], touch: impl Fn(&Key) -> Touch) {
        let old = std::mem::take(self);
        let mut old_keys =
            (0..old.pairs.len()).map(|index| old.key(index)).collect::<Vec<_>>().into_iter().peekable();
        let mut old = old.pairs.into_iter().zip(old.details);
        self.pairs.reserve(keys.len());
        self.details.reserve(keys.len());
        for key in keys {
            let mut kept = None;
            while let Some(old_key) = old_keys.next_if(|old_key| old_key <= key) {
                kept = old.next().filter(|_| old_key == *key);
            }
            let (pair, detail) = kept.unwrap_or_else(|| {
                let Key { a, b, part_a, part_b } = *key;
                let detail =
                    Detail { part_a, part_b, touch: touch(key), memory: Memory::default(), held: None };
                (Pair { a, b, stamp: NEVER, points: 0 }, detail)
            });
            self.pairs.push(pair);
            self.details.push(detail);
        }
    }

    /// Checks a list from untrusted bytes.
    pub(super) fn is_valid(&self, bodies: &[Body]) -> bool {
        let is_sound = |(pair, detail): (&Pair, &Detail)| {
            let exist = (pair.a.max(pair.b) as usize) < bodies.len();
            let is_held = detail.held.as_ref().is_some_and(|held| held.is_sound());
            exist
                && has_part(&bodies[pair.a as usize], detail.part_a)
                && has_part(&bodies[pair.b as usize], detail.part_b)
                && pair.points as usize <= MOST_POINTS
                && (pair.points == 0 || is_held)
                && detail.touch.is_sound()
        };
        self.pairs.len() == self.details.len()
            && self.pairs.iter().zip(&self.details).all(is_sound)
            && (1..self.pairs.len()).all(|index| self.key(index - 1) < self.key(index))
    }

    /// Forgets the pairs of a body that is removed; the bodies behind it move down.
    pub(super) fn remove_body(&mut self, body: u32) {
        self.forget(body);
        for pair in &mut self.pairs {
            pair.a -= u32::from(pair.a > body);
            pair.b -= u32::from(pair.b > body);
        }
    }

    /// Forgets the pairs of a body.
    pub(super) fn forget(&mut self, body: u32) {
        let mut keep =
            self.pairs.iter().map(|pair| pair.a != body && pair.b != body).collect::<Vec<_>>().into_iter();
        self.details.retain(|_| keep.next() == Some(true));
        self.pairs.retain(|pair| pair.a != body && pair.b != body);
    }
}

/// Whether a body has a part, or a triangle, of this number.
fn has_part(body: &Body, part: u32) -> bool {
    match &body.substance {
        Substance::Rigid(rigid) => match rigid.shape.surface() {
            Some(surface) => (part as usize) < surface.mesh().triangles.len(),
            None => (part as usize) < rigid.shape.parts().len(),
        },
        Substance::HalfSpace(_) => part == 0,
        Substance::Truss { .. } | Substance::Deformable(_) => false,
    }
}
