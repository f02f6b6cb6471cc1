//! The shape of a sphere tree: which features lie under which node.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::Error;

/// What a leaf holds: 1 to 4 particles, by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Feature {
    /// A lone particle.
    Point(u32),
    /// A piece of rope, or an edge.
    Segment([u32; 2]),
    /// A face.
    Triangle([u32; 3]),
    /// A cell of a cloth grid, in order around it.
    Quad([u32; 4]),
}

impl Feature {
    /// The particles, in the order given.
    #[inline]
    pub fn particles(&self) -> &[u32] {
        match self {
            Feature::Point(particle) => std::slice::from_ref(particle),
            Feature::Segment(particles) => particles,
            Feature::Triangle(particles) => particles,
            Feature::Quad(particles) => particles,
        }
    }
}

/// A balanced binary tree over features, with nothing to store but their order.
///
/// The nodes form a heap: node 0 is the root, node `i` has the children `2i + 1` and `2i + 2`, and of the
/// `2n − 1` nodes for `n` features the last `n` are the leaves; leaf `k` is node `n − 1 + k`. So siblings are
/// neighbours in memory, a bottom-up pass runs backwards through an array, no leaf is deeper than ⌈log₂ n⌉,
/// and no stored link can be wrong.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Topology {
    /// Per leaf.
    features: Vec<Feature>,
    /// Per leaf: the feature's place in the list the tree was built from.
    feature_indices: Vec<u32>,
    /// One more than the largest particle index.
    particle_count: u32,
}

impl Topology {
    /// Arranges `features` by where they lie in `positions`, the rest pose (m): a set of features is cut in
    /// two across the longest axis of the bounding box of their centres. Ties go to the lower index.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are no features or more than 2³⁰, if one names a particle that is not there, or if
    /// a position is not finite.
    pub fn build(features: &[Feature], positions: &[Vec3]) -> Result<Self, Error> {
        check_features(features, positions.len())?;
        if let Some(index) = positions.iter().position(|position| !position.is_finite()) {
            return Err(invalid(format!("positions[{index}]"), "a coordinate is not finite"));
        }
        let centers: Vec<Vec3> = features.iter().map(|feature| mean_position(feature, positions)).collect();
        let mut order: Vec<u32> = (0..features.len() as u32).collect();
        let mut feature_indices = vec![0; features.len()];
        // Left to cut: the node and the part of `order` under it.
        let mut pending = vec![(0, &mut order[..])];
        while let Some((node, part)) = pending.pop() {
            if let [feature] = part {
                feature_indices[node - (features.len() - 1)] = *feature;
                continue;
            }
            let left_count = left_leaf_count(part.len());
            let axis = longest_axis(part, &centers);
            part.select_nth_unstable_by(left_count, |&p, &q| {
                centers[p as usize][axis].total_cmp(&centers[q as usize][axis]).then(p.cmp(&q))
            });
            let (left, right) = part.split_at_mut(left_count);
            pending.push((2 * node + 1, left));
            pending.push((2 * node + 2, right));
        }
        let particle_count = particle_count(features);
        let features = feature_indices.iter().map(|&index| features[index as usize]).collect();
        Ok(Topology { features, feature_indices, particle_count })
    }

    /// How many leaves there are; at least 1.
    #[inline]
    pub fn leaf_count(&self) -> usize {
        self.features.len()
    }

    /// How many nodes there are.
    #[inline]
    pub fn node_count(&self) -> usize {
        2 * self.features.len() - 1
    }

    /// How many positions a call must bring: one more than the largest particle index.
    pub fn particle_count(&self) -> usize {
        self.particle_count as usize
    }

    /// The features, by leaf.
    #[inline]
    pub fn features(&self) -> &[Feature] {
        &self.features
    }

    /// For each leaf its feature's place in the list that the tree was built from.
    #[inline]
    pub fn feature_indices(&self) -> &[u32] {
        &self.feature_indices
    }

    /// The two children of an inner node; `None` for a leaf.
    #[inline]
    pub fn children(&self, node: usize) -> Option<[usize; 2]> {
        (node + 1 < self.leaf_count()).then_some([2 * node + 1, 2 * node + 2])
    }

    /// Checks a tree that came from outside, before its first use.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it does not fit `particle_count` particles, or its lists do not fit each other.
    pub fn validate(&self, particle_count: usize) -> Result<(), Error> {
        check_features(&self.features, particle_count)?;
        if self.particle_count != self::particle_count(&self.features) {
            return Err(invalid(
                "particle_count".into(),
                "it must be one more than the largest particle index",
            ));
        }
        let mut sorted = self.feature_indices.clone();
        sorted.sort_unstable();
        if !sorted.iter().copied().eq(0..self.features.len() as u32) {
            return Err(invalid("feature_indices".into(), "it must name each feature once"));
        }
        Ok(())
    }

    /// # Errors
    /// [`Error::Invalid`] if there are fewer positions than the features need.
    pub(super) fn check_positions(&self, positions: &[Vec3]) -> Result<(), Error> {
        if positions.len() < self.particle_count() {
            let problem = format!("{} positions for {} particles", positions.len(), self.particle_count);
            return Err(Error::Invalid { field: "positions".into(), problem });
        }
        Ok(())
    }
}

pub(super) fn invalid(field: String, problem: &str) -> Error {
    Error::Invalid { field, problem: problem.into() }
}

fn check_features(features: &[Feature], particle_count: usize) -> Result<(), Error> {
    if features.is_empty() || features.len() > 1 << 30 {
        return Err(invalid("features".into(), "there must be between 1 and 2³⁰ of them"));
    }
    let outside = |feature: &Feature| feature.particles().iter().any(|&p| p as usize >= particle_count);
    match features.iter().position(outside) {
        Some(index) => Err(invalid(format!("features[{index}]"), "it names a particle that is not there")),
        None => Ok(()),
    }
}

fn particle_count(features: &[Feature]) -> u32 {
    let largest = features.iter().flat_map(|feature| feature.particles()).max();
    largest.map_or(0, |&largest| largest.saturating_add(1))
}

fn mean_position(feature: &Feature, positions: &[Vec3]) -> Vec3 {
    let particles = feature.particles();
    let sum: Vec3 = particles.iter().map(|&particle| positions[particle as usize]).sum();
    sum / particles.len() as f32
}

/// How many of `count` ≥ 2 leaves a heap has in its left half: that of the largest full tree inside, and as
/// many of the remaining leaves as the left half's lowest level has room for.
fn left_leaf_count(count: usize) -> usize {
    let half = 1 << (count.ilog2() - 1);
    half + (count - 2 * half).min(half)
}

fn longest_axis(part: &[u32], centers: &[Vec3]) -> usize {
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    for &index in part {
        low = low.min(centers[index as usize]);
        high = high.max(centers[index as usize]);
    }
    let size = high - low;
    if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    }
}
