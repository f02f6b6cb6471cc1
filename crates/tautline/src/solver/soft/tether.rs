//! Tethers: no particle is further from one that is held than along the cloth or rope.
//!
//! Where something is held, its whole weight hangs on a few sticks, and small steps alone would leave these long. A tether
//! from each particle to the held ones nearest to it takes the load at once (Kim, Chentanez and Müller 2012, Long range
//! attachments). It pulls, and never pushes.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::points::Points;
use crate::constraint::Stick;
use crate::simd::{LANES, Lanes, Row, Vec3x8, read};

/// How many held particles a particle is tied to at most.
const MOST: usize = 4;

/// Eight particles and the held one each is tied to.
#[derive(Debug, Clone)]
struct Tied {
    place: u32,
    held: [u32; LANES],
    length: Row,
}

/// The tethers of a piece.
#[derive(Debug, Clone, Default)]
pub(super) struct Tethers {
    tied: Vec<Tied>,
}

impl Tethers {
    /// Of particles numbered as in their body. `distances` tells how far all are from a held one along the material, in m.
    pub(super) fn new(
        held: &[u32],
        count: usize,
        mut distances: impl FnMut(u32) -> Vec<f32>,
        place: impl Fn(usize) -> usize,
    ) -> Self {
        let mut nearest: Vec<Vec<(f32, u32)>> = vec![Vec::new(); count];
        for &from in held {
            for (near, distance) in nearest.iter_mut().zip(distances(from)) {
                let at = near.partition_point(|&(other, _)| other <= distance);
                if at < MOST && distance.is_finite() && distance > 0.0 {
                    near.insert(at, (distance, from));
                    near.truncate(MOST);
                }
            }
        }
        let mut tied = Vec::new();
        for rank in 0..MOST {
            let mut rows: std::collections::BTreeMap<usize, Tied> = std::collections::BTreeMap::new();
            for (particle, near) in nearest.iter().enumerate() {
                let Some(&(distance, from)) = near.get(rank) else { continue };
                let (own, other) = (place(particle), place(from as usize));
                let first = own - own % LANES;
                let row = rows.entry(first).or_insert_with(|| Tied {
                    place: first as u32,
                    held: std::array::from_fn(|lane| (first + lane) as u32),
                    length: Row([f32::MAX; LANES]),
                });
                row.held[own % LANES] = other as u32;
                row.length.0[own % LANES] = distance;
            }
            tied.extend(rows.into_values());
        }
        Self { tied }
    }

    /// Draws every particle in that is too far off.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn tighten<L: Lanes>(&self, points: &mut Points) {
        for tied in &self.tied {
            let place = tied.place as usize;
            let mut held = [Row::ZERO; 3];
            for (axis, row) in held.iter_mut().enumerate() {
                for (number, &from) in row.0.iter_mut().zip(&tied.held) {
                    *number = points.start[axis][from as usize] + points.offset[axis][from as usize];
                }
            }
            let held = Vec3x8::<L>::load(&held);
            let at = points.eight_at(place);
            let (away, most) = (at - held, L::load(&tied.length));
            let length = away.length_squared().max(L::splat(1e-24)).sqrt();
            let is_free = read::<L>(&points.inverse_mass, place).greater(L::splat(0.0));
            let is_taut = length.greater(most).and(is_free);
            if is_taut.bits() != 0 {
                let share = is_taut.and(most / length - L::splat(1.0));
                points.shift_eight(place, away * share);
            }
        }
    }
}

/// How far every particle is from one along sticks, in m; infinite where none leads (Dijkstra).
pub(super) fn distances_along(sticks: &[Stick], count: usize, from: u32) -> Vec<f32> {
    let mut neighbours: Vec<Vec<(u32, f32)>> = vec![Vec::new(); count];
    for stick in sticks {
        neighbours[stick.a as usize].push((stick.b, stick.rest_length));
        neighbours[stick.b as usize].push((stick.a, stick.rest_length));
    }
    let mut distances = vec![f32::INFINITY; count];
    distances[from as usize] = 0.0;
    // Positive numbers are in the order of their bits.
    let mut next = BinaryHeap::from([Reverse((0_u32, from))]);
    while let Some(Reverse((bits, particle))) = next.pop() {
        let distance = f32::from_bits(bits);
        if distance > distances[particle as usize] {
            continue;
        }
        for &(neighbour, length) in &neighbours[particle as usize] {
            let through = distance + length;
            if through < distances[neighbour as usize] {
                distances[neighbour as usize] = through;
                next.push(Reverse((through.to_bits(), neighbour)));
            }
        }
    }
    distances
}

#[cfg(test)]
#[path = "tests/tether.rs"]
mod tests;
