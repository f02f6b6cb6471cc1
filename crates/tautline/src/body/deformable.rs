//! What cloth and rope have in common: sticks, angles, and a layered sphere tree.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::constraint::{Angle, Bending, Stick};
use crate::error::Error;
use crate::geometry::sphere_tree::{DescentStack, Feature, LayeredTree, descend_self};

/// A body without a shape of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Deformable {
    /// The surface of a cloth, in triangles; none for a rope.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) sticks: Vec<Stick>,
    pub(crate) angles: Vec<Angle>,
    pub(crate) bendings: Vec<Bending>,
    pub(crate) tree: LayeredTree,
    /// How far from a solid its particles and leaf centres are kept, in m.
    pub(crate) thickness: f32,
    /// `None` if it passes through itself.
    pub(crate) neighbours: Option<Neighbours>,
    /// λ of each angle, then of each bending: scratch memory, zeroed at the start of a substep.
    #[serde(skip)]
    pub(crate) multipliers: Vec<f32>,
}

/// What a builder knows of a deformable body.
pub(crate) struct Parts {
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) sticks: Vec<Stick>,
    pub(crate) angles: Vec<Angle>,
    pub(crate) bendings: Vec<Bending>,
    pub(crate) leaves: Vec<Feature>,
    /// Added to the radius of every leaf sphere, in m.
    pub(crate) leaf_margin: f32,
    pub(crate) thickness: f32,
    pub(crate) self_collision: bool,
}

/// What a cloth or rope becomes in a world.
pub(crate) struct BuiltDeformable {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) body: Deformable,
    pub(crate) velocity: Vec3,
    pub(crate) mass: f32,
    pub(crate) friction: f32,
    pub(crate) pins: Vec<u32>,
}

impl Deformable {
    pub(crate) fn new(parts: Parts, rest: &[Vec3]) -> Result<Self, Error> {
        let tree = LayeredTree::new(&parts.leaves, rest, parts.leaf_margin)?;
        let neighbours = parts.self_collision.then(|| Neighbours::of(&tree));
        let Parts { triangles, sticks, angles, bendings, thickness, .. } = parts;
        Ok(Self { triangles, sticks, angles, bendings, tree, thickness, neighbours, multipliers: Vec::new() })
    }

    pub(crate) fn is_rope(&self) -> bool {
        self.triangles.is_empty()
    }

    /// How far beyond its particles the spheres of its leaves may reach, in m.
    pub(crate) fn reach(&self) -> f32 {
        let largest = self.tree.leaf_spheres().iter().map(|sphere| sphere.radius).fold(0.0, f32::max);
        largest.max(self.thickness)
    }

    pub(crate) fn validate(&self, particle_count: usize) -> Result<(), Error> {
        self.tree.validate(particle_count)?;
        let ok = |indices: &[u32]| indices.iter().all(|&i| (i as usize) < particle_count);
        let sound = self.triangles.iter().all(|t| ok(t))
            && self.sticks.iter().all(|s| ok(&[s.a, s.b]) && s.rest_length.is_finite())
            && self.angles.iter().all(|a| ok(&[a.a, a.b, a.c]) && a.limit.is_finite() && a.compliance >= 0.0)
            && self
                .bendings
                .iter()
                .all(|b| ok(&b.edge) && ok(&b.wings) && b.limit.is_finite() && b.compliance >= 0.0)
            && self.thickness >= 0.0
            && self.neighbours.as_ref().is_none_or(|n| n.is_valid(self.tree.topology().leaf_count()));
        if sound { Ok(()) } else { Err(Error::Snapshot("a cloth or rope is inconsistent".into())) }
    }
}

/// Leaves of one tree that do not collide with each other, because their spheres overlap at rest.
///
/// On a square grid these are the cells at Chebyshev distance 1. Excluding only leaves that share a vertex
/// would leave pairs that push each other apart for ever; where cells are oblong, more than one ring overlaps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Neighbours {
    /// For every leaf its neighbours of higher number, ascending.
    others: Vec<u32>,
    /// Where those of each leaf start in `others`, and a last one for the end.
    starts: Vec<u32>,
}

impl Neighbours {
    /// Of a tree that is fitted to the rest positions.
    fn of(tree: &LayeredTree) -> Self {
        let mut pairs = Vec::new();
        descend_self(
            tree,
            &mut DescentStack::default(),
            |_, _| false,
            |a, b| {
                pairs.push((a.min(b) as u32, a.max(b) as u32));
            },
        );
        pairs.sort_unstable();
        let leaves = 0..=tree.topology().leaf_count();
        let starts = leaves.map(|leaf| pairs.partition_point(|&(a, _)| (a as usize) < leaf) as u32).collect();
        Self { others: pairs.into_iter().map(|(_, b)| b).collect(), starts }
    }

    #[inline]
    pub(crate) fn contains(&self, a: usize, b: usize) -> bool {
        let (low, high) = (a.min(b), a.max(b) as u32);
        self.others[self.starts[low] as usize..self.starts[low + 1] as usize].contains(&high)
    }

    fn is_valid(&self, leaf_count: usize) -> bool {
        self.starts.len() == leaf_count + 1
            && self.starts.is_sorted()
            && self.starts[leaf_count] as usize <= self.others.len()
    }
}
