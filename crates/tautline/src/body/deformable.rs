//! What cloth, rope and soft solids have in common: sticks, angles, flesh, and a layered sphere tree.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::fabric::Fabric;
use super::flesh::Flesh;
use crate::constraint::{Angle, Bending, Stick};
use crate::error::Error;
use crate::geometry::sphere_tree::{DescentStack, Feature, LayeredTree, descend_self};

/// A body without a shape of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Deformable {
    /// The surface of a cloth or soft solid, in triangles; none for a rope.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) sticks: Vec<Stick>,
    pub(crate) angles: Vec<Angle>,
    pub(crate) bendings: Vec<Bending>,
    pub(crate) tree: LayeredTree,
    /// The rectangle it is, if it is one.
    pub(crate) grid: Option<GridShape>,
    /// Flexural rigidity, in N m; `None` = limp.
    pub(crate) rigidity: Option<f32>,
    /// The inside of a soft solid.
    pub(crate) flesh: Option<Flesh>,
    /// How far from a solid its particles and leaf centres are kept, in m.
    pub(crate) thickness: f32,
    /// `None` if it passes through itself.
    pub(crate) neighbours: Option<Neighbours>,
    /// The length that a rope is being wound to, in m.
    pub(crate) winding: Option<f32>,
    pub(crate) fabric: Fabric,
    /// What rounding has left of its positions, in m; none before the first step.
    pub(crate) remainders: Vec<Vec3>,
    /// λ of each angle, then of each bending: scratch memory, zeroed at the start of a substep.
    #[serde(skip)]
    pub(crate) multipliers: Vec<f32>,
}

/// A rectangle of particles, row by row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct GridShape {
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    /// Between neighbours in a row and in a column, in m.
    pub(crate) edges: [f32; 2],
}

impl GridShape {
    /// How far every particle is from one, along the flat sheet, in m.
    pub(crate) fn distances(&self, from: u32) -> Vec<f32> {
        let offset = |a: u32, b: u32, edge: f32| (a as f32 - b as f32) * edge;
        let distance = |particle: u32| {
            let x = offset(particle % self.columns, from % self.columns, self.edges[0]);
            let y = offset(particle / self.columns, from / self.columns, self.edges[1]);
            (x * x + y * y).sqrt()
        };
        (0..self.columns * self.rows).map(distance).collect()
    }
}

/// What a builder knows of a deformable body.
pub(crate) struct Parts {
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) sticks: Vec<Stick>,
    pub(crate) angles: Vec<Angle>,
    pub(crate) bendings: Vec<Bending>,
    pub(crate) grid: Option<GridShape>,
    pub(crate) rigidity: Option<f32>,
    pub(crate) flesh: Option<Flesh>,
    pub(crate) leaves: Vec<Feature>,
    /// Added to the radius of every leaf sphere, in m.
    pub(crate) leaf_margin: f32,
    pub(crate) thickness: f32,
    pub(crate) self_collision: bool,
    pub(crate) fabric: Fabric,
}

/// What a cloth, rope or soft solid becomes in a world.
pub(crate) struct BuiltDeformable {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) body: Deformable,
    /// Of each particle, in m/s.
    pub(crate) velocities: Vec<Vec3>,
    /// Of each particle, in kg.
    pub(crate) masses: Vec<f32>,
    pub(crate) friction: f32,
    pub(crate) pins: Vec<u32>,
}

impl Deformable {
    pub(crate) fn new(parts: Parts, rest: &[Vec3]) -> Result<Self, Error> {
        let tree = LayeredTree::new(&parts.leaves, rest, parts.leaf_margin)?;
        let neighbours = parts.self_collision.then(|| Neighbours::of(&tree));
        let Parts { triangles, sticks, angles, bendings, grid, rigidity, flesh, thickness, fabric, .. } =
            parts;
        Ok(Self {
            triangles,
            sticks,
            angles,
            bendings,
            grid,
            rigidity,
            flesh,
            tree,
            thickness,
            neighbours,
            winding: None,
            fabric,
            remainders: Vec::new(),
            multipliers: Vec::new(),
        })
    }

    /// Particles along the longer side of a sheet, about; sticks are what needs more small steps, the more the finer.
    pub(crate) fn fineness(&self, particles: usize) -> usize {
        match &self.grid {
            Some(grid) => grid.columns.max(grid.rows) as usize,
            None if self.sticks.is_empty() || self.is_rope() => 0,
            None => (particles as f32).sqrt() as usize,
        }
    }

    pub(crate) fn is_rope(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Whether it is a rope of which each segment begins where the last one ended.
    pub(crate) fn is_chain(&self) -> bool {
        self.is_rope() && self.sticks.iter().zip(0..).all(|(stick, i)| [stick.a, stick.b] == [i, i + 1])
    }

    /// How far beyond its particles the spheres of its leaves may reach, in m.
    pub(crate) fn reach(&self) -> f32 {
        let largest = self.tree.leaf_spheres().iter().map(|sphere| sphere.radius).fold(0.0, f32::max);
        largest.max(self.thickness)
    }

    /// What rounding has left of the position of a particle, in m; nothing if the particle has been put elsewhere since.
    pub(crate) fn remainder(&self, particle: usize, position: Vec3) -> Vec3 {
        let remainder = self.remainders.get(particle).copied().unwrap_or_default();
        if position + remainder == position { remainder } else { Vec3::ZERO }
    }

    /// Refuses what the paper's solver does not know.
    pub(crate) fn check_for_paper(&self) -> Result<(), Error> {
        let bends = self.rigidity.map(|_| "bending_stiffness");
        let Some(field) = self.fabric.beyond_paper().or(bends) else { return Ok(()) };
        let problem = "is unknown to the paper's solver: `Settings::cloth` must be `ClothSolver::SmallSteps`";
        Err(Error::Invalid { field: field.into(), problem: problem.into() })
    }

    pub(crate) fn validate(&self, particle_count: usize) -> Result<(), Error> {
        self.tree.validate(particle_count)?;
        let sound_compliance = |compliance: f32| (0.0..f32::INFINITY).contains(&compliance);
        let ok = |indices: &[u32]| indices.iter().all(|&i| (i as usize) < particle_count);
        let sound = self.triangles.iter().all(|t| ok(t))
            && self.sticks.iter().all(|s| ok(&[s.a, s.b]) && s.is_sound())
            && self
                .angles
                .iter()
                .all(|a| ok(&[a.a, a.b, a.c]) && a.limit.is_finite() && sound_compliance(a.compliance))
            && self.bendings.iter().all(|b| {
                ok(&b.edge) && ok(&b.wings) && b.limit.is_finite() && sound_compliance(b.compliance)
            })
            && self.thickness >= 0.0
            && self.winding.is_none_or(|length| self.is_rope() && self.check_length(length).is_ok())
            && self.flesh.as_ref().is_none_or(|flesh| flesh.is_sound(particle_count))
            && self.rigidity.is_none_or(|rigidity| (0.0..f32::INFINITY).contains(&rigidity))
            && self.fabric.is_sound(particle_count, self.sticks.len())
            && self.neighbours.as_ref().is_none_or(|n| n.is_valid(self.tree.topology().leaf_count()));
        if sound {
            Ok(())
        } else {
            Err(Error::Snapshot("a cloth, rope or soft solid is inconsistent".into()))
        }
    }
}

/// Leaves of one tree that do not collide with each other, because they hang together and their spheres overlap
/// at rest.
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
        let features = tree.topology().features();
        let mut overlapping: Vec<Vec<u32>> = vec![Vec::new(); features.len()];
        let visit = |a: usize, b: usize| overlapping[a.min(b)].push(a.max(b) as u32);
        descend_self(tree, &mut DescentStack::default(), |_, _| false, visit);
        let (mut others, mut starts) = (Vec::new(), vec![0]);
        for (leaf, overlapping) in overlapping.into_iter().enumerate() {
            let from = others.len();
            others.extend(connected(leaf, overlapping, features));
            others[from..].sort_unstable();
            starts.push(others.len() as u32);
        }
        Self { others, starts }
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

/// Those of the `overlapping` leaves that hang together with `leaf` through each other: the strand of a rope
/// that crosses itself overlaps too, but is no neighbour.
fn connected(leaf: usize, mut overlapping: Vec<u32>, features: &[Feature]) -> Vec<u32> {
    let touch = |a: u32, b: u32| {
        let particles = features[b as usize].particles();
        features[a as usize].particles().iter().any(|particle| particles.contains(particle))
    };
    let mut found = vec![leaf as u32];
    let mut next = 0;
    while let Some(&from) = found.get(next) {
        found.extend(overlapping.extract_if(.., |other| touch(from, *other)));
        next += 1;
    }
    found.split_off(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;

    #[test]
    fn neighbours_on_a_square_grid_are_at_chebyshev_distance_1() {
        let n = 6u32;
        let mesh = primitives::grid(n, n, 1.0, 1.0).unwrap();
        let cell = |row: u32, column: u32| {
            let first = row * n + column;
            Feature::Quad([first, first + 1, first + n + 1, first + n])
        };
        let cells = (0..n - 1).flat_map(|row| (0..n - 1).map(move |column| (row, column)));
        let leaves: Vec<Feature> = cells.map(|(row, column)| cell(row, column)).collect();
        let tree = LayeredTree::new(&leaves, &mesh.positions, 0.0).unwrap();
        let neighbours = Neighbours::of(&tree);
        let place = |leaf: usize| {
            let index = tree.topology().feature_indices()[leaf];
            [index / (n - 1), index % (n - 1)]
        };
        for a in 0..leaves.len() {
            for b in (0..leaves.len()).filter(|&b| b != a) {
                let distance = (0..2).map(|k| place(a)[k].abs_diff(place(b)[k])).max().unwrap();
                assert_eq!(neighbours.contains(a, b), distance <= 1, "{:?} {:?}", place(a), place(b));
            }
        }
    }

    #[test]
    fn strands_that_cross_are_no_neighbours() {
        // Along x, round a corner, back, and over the second segment.
        let flat =
            |points: &[[f32; 2]]| points.iter().map(|&[x, z]| Vec3::new(x, 0.0, z)).collect::<Vec<_>>();
        let mut points =
            flat(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.], [4., 0.], [5., 0.], [5., 1.], [5., 2.]]);
        points.extend(flat(&[[4., 2.5], [3., 2.5], [2., 2.5], [1.5, 1.5], [1.5, 0.5], [1.5, -0.5]]));
        let leaves: Vec<Feature> = (0..13).map(|i| Feature::Segment([i, i + 1])).collect();
        let tree = LayeredTree::new(&leaves, &points, 0.1).unwrap();
        let neighbours = Neighbours::of(&tree);
        let leaf = |index: u32| tree.topology().feature_indices().iter().position(|&i| i == index).unwrap();
        assert!(neighbours.contains(leaf(0), leaf(1)));
        assert!(!neighbours.contains(leaf(1), leaf(12)), "segment 12 crosses segment 1");
    }
}
