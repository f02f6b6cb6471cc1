//! Drag and lift: what the air does to the triangles of a cloth.
//!
//! Each corner of a triangle feels a third of its area, with the corner's own velocity against the air. So drag damps
//! every way in which a cloth can move, corner by corner, and in an implicit step never turns a motion round. Lift is at
//! right angles to the velocity against the air; it turns that and changes nothing in its size.

use std::ops::Range;

use glam::Vec3;

use super::SoftSolver;
use super::points::Points;
use super::small_step::Timing;
use crate::body::AirGrip;
use crate::norm::Norm;

/// How triangles stand in the air is looked at once in so many small steps.
const EVERY: usize = 4;

/// What the air takes hold of.
#[derive(Debug, Clone)]
pub(super) struct Sail {
    /// By place.
    triangles: Vec<[u32; 3]>,
    grip: AirGrip,
    places: Range<usize>,
    /// Of every place: Σ A/3 |n·D|, in m³, …
    fronts: Vec<f32>,
    /// … and Σ A/3 (n·D)(n |D| − D (n·D)/|D|), in m⁴, with the motion D of the air past it in a small step.
    lifts: Vec<Vec3>,
}

impl SoftSolver {
    /// Lets the air act before small step `number` of the substep.
    pub(super) fn blow(&mut self, number: usize, timing: &Timing) {
        let wind = timing.wind * timing.small;
        for sail in self.pieces.iter_mut().filter_map(|piece| piece.sail.as_mut()) {
            if number.is_multiple_of(EVERY) {
                sail.look(&self.points, wind);
            }
            sail.blow(&mut self.points, wind, 0.5 * timing.air_density);
        }
    }
}

impl Sail {
    pub(super) fn new(triangles: Vec<[u32; 3]>, grip: AirGrip, places: Range<usize>) -> Self {
        Self { triangles, grip, places, fronts: Vec::new(), lifts: Vec::new() }
    }

    /// Changes displacements; `wind` is how far the air moves in a small step (m), and `scale` ½ ρ (kg/m³).
    fn blow(&self, points: &mut Points, wind: Vec3, scale: f32) {
        for (place, (front, lift)) in self.places.clone().zip(self.fronts.iter().zip(&self.lifts)) {
            let by_mass = scale * points.inverse_mass[place];
            if by_mass > 0.0 && *front > 0.0 {
                let motion = points.motion(place);
                let against = wind - motion;
                let (slowed, across) = (by_mass * self.grip.drag * front, *lift * (by_mass * self.grip.lift));
                points.set_motion(place, motion + change(against, slowed, across));
            }
        }
    }

    fn look(&mut self, points: &Points, wind: Vec3) {
        self.fronts.clear();
        self.fronts.resize(self.places.len(), 0.0);
        self.lifts.clear();
        self.lifts.resize(self.places.len(), Vec3::ZERO);
        for triangle in &self.triangles {
            let corners = triangle.map(|place| place as usize);
            let [a, b, c] = corners.map(|place| points.at(place));
            let doubled = (b - a).cross(c - a);
            let size = doubled.norm();
            if size < 1e-30 {
                continue;
            }
            for place in corners {
                let (front, lift) = exposure(doubled / size, size / 6.0, wind - points.motion(place));
                self.fronts[place - self.places.start] += front;
                self.lifts[place - self.places.start] += lift;
            }
        }
    }
}

/// A |n·D| and A (n·D)(n |D| − D (n·D)/|D|) of an area A with the unit normal n past which air moves by D.
fn exposure(normal: Vec3, area: f32, against: Vec3) -> (f32, Vec3) {
    let (through, length) = (normal.dot(against), against.norm());
    if length < 1e-30 {
        return (0.0, Vec3::ZERO);
    }
    let across = normal * length - against * (through / length);
    (area * through.abs(), across * (area * through))
}

/// What the air changes of a displacement, when it moves by D against it: drag takes the share c/(1 + c), as of an
/// implicit step D' = D − c D'; lift then turns D towards −`across` and leaves it as long as it is.
fn change(against: Vec3, slowed: f32, across: Vec3) -> Vec3 {
    let dragged = against * (slowed / (1.0 + slowed));
    if across == Vec3::ZERO {
        return dragged;
    }
    let left = against - dragged;
    let turned = left - across;
    let size = turned.norm();
    let turned = if size > 0.0 { turned * (left.norm() / size) } else { left };
    dragged + (left - turned)
}

#[cfg(test)]
#[path = "tests/air.rs"]
mod tests;
