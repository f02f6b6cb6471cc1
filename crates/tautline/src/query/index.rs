//! What queries search: a tree over the boxes of all pieces of all bodies.

use glam::Vec3;

use super::piece::{Piece, piece_count};
use crate::body::Body;
use crate::collision::bvh::Bvh;

/// Made from a world as it is; a world that moves needs another.
#[derive(Debug, Clone)]
pub(crate) struct Index {
    items: Vec<Item>,
    pub(super) tree: Bvh,
}

/// A piece of a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    /// Its index in the world.
    pub(super) body: usize,
    number: usize,
}

impl Index {
    pub(super) fn new(bodies: &[Body], positions: &[Vec3]) -> Self {
        let (mut items, mut boxes) = (Vec::new(), Vec::new());
        for (index, body) in bodies.iter().enumerate() {
            for number in 0..piece_count(body) {
                if let Some(piece) = Piece::of(body, positions, number) {
                    items.push(Item { body: index, number });
                    boxes.push(piece.bounds());
                }
            }
        }
        Self { items, tree: Bvh::new(&boxes) }
    }

    pub(super) fn item(&self, item: u32) -> Item {
        self.items[item as usize]
    }
}

impl Item {
    pub(super) fn piece<'a>(self, bodies: &'a [Body], positions: &'a [Vec3]) -> Option<Piece<'a>> {
        Piece::of(&bodies[self.body], positions, self.number)
    }
}
