//! Ropes that are wound in and out.

use super::World;
use crate::body::{Deformable, Substance};
use crate::error::{Error, within};
use crate::settings::ClothSolver;
use crate::slots::BodyHandle;

impl World {
    /// The length of a rope at rest, in m: of all its segments together.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is no rope.
    pub fn rope_length(&self, rope: BodyHandle) -> Result<f32, Error> {
        match &self.bodies[self.slots.index(rope)?].substance {
            Substance::Deformable(rope) if rope.is_rope() => Ok(rope.length()),
            _ => Err(no_rope()),
        }
    }

    /// Winds a rope in or out: all its segments get shorter or longer alike, evenly over the next step, until together
    /// they have this length, in m. Set anew before every step, it makes a winch. A length that is far from the present
    /// one is reached by a tenth of that in each step. The rope's mass stays as it is. It wakes the rope.
    ///
    /// Under the paper's solver the rope has its new length at once.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is no rope; [`Error::OutOfRange`] unless every segment is
    /// then from 1e-6 to 1e9 m long.
    pub fn set_rope_length(&mut self, rope: BodyHandle, length: f32) -> Result<(), Error> {
        let index = self.slots.index(rope)?;
        let is_at_once = self.settings.cloth == ClothSolver::Paper;
        let Substance::Deformable(rope) = &mut self.bodies[index].substance else { return Err(no_rope()) };
        if !rope.is_rope() {
            return Err(no_rope());
        }
        rope.check_length(length)?;
        if is_at_once {
            let factor = length / rope.length();
            rope.sticks.iter_mut().for_each(|stick| stick.rest_length *= factor);
        } else {
            rope.winding = Some(length);
        }
        self.wake_body(index);
        Ok(())
    }
}

impl Deformable {
    /// All sticks together, at rest, in m.
    pub(crate) fn length(&self) -> f32 {
        self.sticks.iter().map(|stick| stick.rest_length).sum()
    }

    /// Refuses a length that would make its shortest or its longest segment something else than a segment.
    pub(crate) fn check_length(&self, length: f32) -> Result<(), Error> {
        let lengths = || self.sticks.iter().map(|stick| stick.rest_length);
        let (shortest, longest) = lengths()
            .fold((f32::INFINITY, 0.0_f32), |(low, high), length| (low.min(length), high.max(length)));
        let total = self.length();
        let expected = "a length (m) that makes every segment 1e-6 to 1e9 m long";
        within("length", length, 1e-6 / shortest * total, 1e9 / longest * total, expected)?;
        Ok(())
    }
}

fn no_rope() -> Error {
    Error::Invalid { field: "rope".into(), problem: "is no rope".into() }
}
