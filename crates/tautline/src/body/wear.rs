//! What being stretched does to cloth for good: it creeps, and it tears.

use glam::Vec3;

use super::deformable::Deformable;
use super::fabric::Creep;
use crate::constraint::{Bending, Stick};
use crate::order::PutInOrder;

impl Deformable {
    /// Lets it tear and creep, after a step of `dt` (s). Returns whether anything has changed.
    pub(crate) fn wear(&mut self, positions: &[Vec3], dt: f32) -> bool {
        let wear = self.fabric.wear;
        let has_torn = wear.tear_at.is_some_and(|limit| self.tear(positions, limit));
        let has_crept = wear.creep.is_some_and(|creep| self.creep(positions, creep, dt));
        has_torn || has_crept
    }

    /// Lets sticks that are strained beyond the yield value y follow: with the length l, d → l/(1 + y) with what is left of
    /// the difference after a step, e^(−r dt).
    fn creep(&mut self, positions: &[Vec3], creep: Creep, dt: f32) -> bool {
        let share = -libm::expm1f(-creep.rate * dt);
        let mut has_crept = false;
        for stick in &mut self.sticks {
            let beyond = (1.0 + stick.strain(positions)) / (1.0 + creep.yield_strain) - 1.0;
            let longer = Stick { rest_length: stick.rest_length * (1.0 + share * beyond), ..*stick };
            if beyond > 0.0 && longer.rest_length > stick.rest_length && longer.is_sound() {
                *stick = longer;
                has_crept = true;
            }
        }
        has_crept
    }

    /// Takes out what is strained beyond `limit`, with the triangles beside it and what else needs them.
    fn tear(&mut self, positions: &[Vec3], limit: f32) -> bool {
        let torn = self.torn_edges(positions, limit);
        let is_whole = |triangle: &[u32; 3]| {
            torn.iter().all(|edge| !edge.iter().all(|particle| triangle.contains(particle)))
        };
        // What has no triangles would be a rope.
        if torn.is_empty() || !self.triangles.iter().any(is_whole) {
            return false;
        }
        self.triangles.retain(is_whole);
        self.bendings.retain(|Bending { edge: [start, end], wings, .. }| {
            wings.iter().all(|&wing| is_whole(&[*start, *end, wing]))
        });
        self.drop_threads();
        self.fabric.gas = None;
        true
    }

    /// The ends of sticks that tear: of those around a particle, the one that is strained most; among equals the first.
    fn torn_edges(&self, positions: &[Vec3], limit: f32) -> Vec<[u32; 2]> {
        let strains: Vec<f32> = self.sticks.iter().map(|stick| stick.strain(positions)).collect();
        let mut most = vec![usize::MAX; positions.len()];
        for (number, stick) in self.sticks.iter().enumerate().filter(|(number, _)| strains[*number] > limit) {
            for end in [stick.a, stick.b] {
                let most = &mut most[end as usize];
                if strains.get(*most).is_none_or(|strain| strains[number] > *strain) {
                    *most = number;
                }
            }
        }
        let tears = |(number, stick): &(usize, &Stick)| {
            [stick.a, stick.b].iter().all(|&end| most[end as usize] == *number)
        };
        self.sticks.iter().enumerate().filter(tears).map(|(_, stick)| [stick.a, stick.b]).collect()
    }

    /// Takes out the sticks that are edges of no triangle any more.
    fn drop_threads(&mut self) {
        let sorted = |a: u32, b: u32| [a.min(b), a.max(b)];
        let edges_of = |&[a, b, c]: &[u32; 3]| [sorted(a, b), sorted(b, c), sorted(c, a)];
        let mut edges: Vec<[u32; 2]> = self.triangles.iter().flat_map(edges_of).collect();
        edges.put_in_order();
        let is_edge = |stick: &Stick| edges.binary_search(&sorted(stick.a, stick.b)).is_ok();
        if let Some(compliances) =
            self.fabric.stretch.as_mut().and_then(|stretch| stretch.compliances.as_mut())
        {
            let mut sticks = self.sticks.iter();
            compliances.retain(|_| sticks.next().is_some_and(is_edge));
        }
        self.sticks.retain(is_edge);
    }
}
