//! Ropes that are wound in or out: their segments get shorter or longer from small step to small step.

use super::SoftSolver;
use super::piece::{Layout, Piece};
use crate::body::{Body, Deformable, Substance};

/// By what share a rope gets longer or shorter in a step, at most.
const MOST: f32 = 0.1;

impl Piece {
    /// Notes by what factor the rope's length is to change in the coming step.
    pub(super) fn note_winding(&mut self, rope: &Deformable) {
        let factor = |length: f32| (length / rope.length()).clamp(1.0 - MOST, 1.0 + MOST);
        self.winding = rope.winding.map(factor);
    }
}

impl SoftSolver {
    /// Winds ropes on, at the start of a small step.
    pub(super) fn wind_ropes(&mut self) {
        let done = (self.done + 1) as f32 / self.planned as f32;
        for piece in &mut self.pieces {
            let Some(factor) = piece.winding else { continue };
            // In the end it is what is kept, to the bit.
            let factor = if done < 1.0 { 1.0 + (factor - 1.0) * done } else { factor };
            match &mut piece.layout {
                Layout::Rope => {
                    let start = piece.places.start;
                    self.bundles.iter_mut().for_each(|bundle| bundle.scale(start, factor));
                }
                Layout::Net(batches) => batches.scale = factor,
                Layout::Sheet(_) | Layout::Loose(_) | Layout::Solid(_) => {}
            }
        }
    }

    /// Keeps what has been wound. Everything is laid out anew, since tethers and contacts go by length.
    pub(super) fn keep_winding(&mut self, bodies: &mut [Body]) {
        for piece in &self.pieces {
            let (Some(factor), Substance::Deformable(rope)) =
                (piece.winding, &mut bodies[piece.body].substance)
            else {
                continue;
            };
            let is_there =
                rope.winding.is_some_and(|length| (length / rope.length() / factor - 1.0).abs() < 1e-6);
            rope.sticks.iter_mut().for_each(|stick| stick.rest_length *= factor);
            if is_there {
                rope.winding = None;
            }
            self.is_stale = true;
        }
    }
}
