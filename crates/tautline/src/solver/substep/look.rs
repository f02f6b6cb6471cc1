//! What the solver has kept of its contacts, to be looked at.

use glam::Vec3;

use super::RigidSolver;
use super::batch::NO_PAIR;

/// A point of a contact.
pub(crate) struct KeptPoint {
    /// Indices of the bodies in the world.
    pub(crate) bodies: [u32; 2],
    /// Unit, from the first to the second.
    pub(crate) normal: Vec3,
    /// On either, in its frame, in m.
    pub(crate) anchors: [Vec3; 2],
    /// In kg m.
    pub(crate) multiplier: f32,
}

impl RigidSolver {
    /// Every point of every contact.
    pub(crate) fn contact_points(&self) -> impl Iterator<Item = KeptPoint> {
        let pairs = self.pairs.pairs.iter().zip(&self.pairs.details).filter(|(pair, _)| pair.points > 0);
        pairs.flat_map(|(pair, detail)| {
            detail.held.iter().flat_map(|held| {
                held.points().map(|point| KeptPoint {
                    bodies: [pair.a, pair.b],
                    normal: held.normal(),
                    anchors: [point.on_a(), point.on_b()],
                    multiplier: point.normal_impulse(),
                })
            })
        })
    }

    /// Pairs of bodies in contact, by their indices in the world, each with the number of its batch. Empty if bodies have
    /// come or gone since the last step.
    pub(crate) fn batches(&self) -> Vec<([u32; 2], u32)> {
        if self.is_stale {
            return Vec::new();
        }
        let batches = (0..).zip(self.groups.batches());
        let all = batches.flat_map(|(number, batch)| batch.pairs.iter().map(move |&pair| (pair, number)));
        let real = all.filter(|(pair, _)| *pair != NO_PAIR);
        let of_pair = |(pair, number): (u32, u32)| {
            self.pairs.pairs.get(pair as usize).map(|pair| ([pair.a, pair.b], number))
        };
        real.filter_map(of_pair).collect()
    }
}
