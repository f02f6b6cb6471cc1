//! Seams: particles that are drawn together at a bounded speed.

use super::points::Points;
use crate::constraint::Stick;
use crate::norm::Norm;

/// The speed at which ends of a seam are drawn together, in m/s.
const SPEED: f32 = 1.0;

/// The seams of a piece.
#[derive(Debug, Clone, Default)]
pub(super) struct Seams {
    /// By place, with how far apart their ends may be now (m).
    pub(super) stitches: Vec<Stick>,
}

impl Seams {
    /// `place` tells where a particle of the body is.
    pub(super) fn new(seams: &[Stick], place: impl Fn(usize) -> usize) -> Self {
        let at = |particle: u32| place(particle as usize) as u32;
        let stitch = |seam: &Stick| Stick { a: at(seam.a), b: at(seam.b), ..*seam };
        Self { stitches: seams.iter().map(stitch).collect() }
    }

    /// Draws every seam tighter for a small step of `h` (s), as a rope would that is wound up.
    pub(super) fn pull(&mut self, points: &mut Points, h: f32) {
        for stitch in &mut self.stitches {
            stitch.rest_length = (stitch.rest_length - SPEED * h).max(0.0);
            let places = [stitch.a, stitch.b].map(|place| place as usize);
            let [wa, wb] = places.map(|place| points.inverse_mass[place]);
            let between = points.at(places[1]) - points.at(places[0]);
            let length = between.norm();
            if wa + wb > 0.0 && length > stitch.rest_length {
                let pull = between * ((length - stitch.rest_length) / (length * (wa + wb)));
                points.shift(places[0], pull * wa);
                points.shift(places[1], -(pull * wb));
            }
        }
    }
}
