//! The wrapped tree: a node's sphere is the smallest around the geometry below it. For rigid bodies.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::build::{Feature, Topology, invalid};
use super::descend::SphereHierarchy;
use crate::Error;
use crate::geometry::Sphere;
use crate::geometry::{SupportPoints, smallest_enclosing_sphere};
use crate::norm::Norm;

/// A sphere tree for bodies that keep their shape. It holds no positions, so all bodies of one shape share it; each
/// has its own [`WrappedSpheres`], and [`WrappedTree::pose`] puts the two and the particles together.
///
/// A node's centre is a fixed weighted mean of its at most four support particles, and its radius is fixed:
/// O(1) per node (paper 5.2), exact under rigid motion. Weights rather than a new circumsphere, because four nearly
/// coplanar particles that move by 1 % can throw their circumsphere anywhere, but not their mean.
///
/// Trusses give a little, so radii are enlarged by `padding`, a fraction. Spheres go on containing
/// their geometry while it is stretched by at most that fraction in every direction (any affine map: centre and geometry
/// map alike, and no distance grows by more). For other deformations [`WrappedTree::padding_needed`] measures it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct WrappedTree {
    topology: Topology,
    padding: f32,
    nodes: Vec<WrappedNode>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct WrappedNode {
    support: SupportPoints,
    /// Of the smallest sphere in the rest pose, in m; without padding.
    rest_radius: f32,
}

/// The spheres of one body with a [`WrappedTree`], each computed when a descent first asks for it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct WrappedSpheres {
    spheres: Vec<Sphere>,
    /// Per node: the motion for which its sphere was computed.
    stamps: Vec<u32>,
    /// The current motion; never 0, the stamp of spheres not computed yet.
    motion: u32,
}

/// A body's tree in its present pose, ready to be descended.
#[derive(Debug)]
pub struct WrappedPose<'a> {
    tree: &'a WrappedTree,
    positions: &'a [Vec3],
    state: &'a mut WrappedSpheres,
}

impl WrappedTree {
    /// Builds the tree in the rest pose `positions` (m). `padding` enlarges all radii by that fraction, such as
    /// 0.01 for a truss whose sticks give 1 %.
    ///
    /// # Errors
    /// As [`Topology::build`], and [`Error::OutOfRange`] if `padding` is negative or not finite.
    pub fn new(features: &[Feature], positions: &[Vec3], padding: f32) -> Result<Self, Error> {
        check_padding(padding)?;
        let topology = Topology::build(features, positions)?;
        let mut nodes = Vec::with_capacity(topology.node_count());
        for particles in particles_below(&topology) {
            let points: Vec<Vec3> = particles.iter().map(|&particle| positions[particle as usize]).collect();
            let Some(enclosing) = smallest_enclosing_sphere(&points) else {
                return Err(invalid("positions".into(), "a coordinate is not finite"));
            };
            let mut support = enclosing.support;
            support.points = support.points.map(|point| particles[point as usize]);
            nodes.push(WrappedNode { support, rest_radius: enclosing.sphere.radius });
        }
        Ok(WrappedTree { topology, padding, nodes })
    }

    /// A node's sphere for the particles' `positions`, of which there must be `topology().particle_count()`.
    #[inline]
    pub fn sphere(&self, node: usize, positions: &[Vec3]) -> Sphere {
        let WrappedNode { support, rest_radius } = &self.nodes[node];
        let [p, q, r, s] = support.points.map(|particle| positions[particle as usize]);
        let [_, along_q, along_r, along_s] = support.weights;
        let center = p + ((q - p) * along_q + (r - p) * along_r + (s - p) * along_s);
        // Rounding of the centre: a few units in the last place of its coordinates and of the differences.
        let extent = center.x.abs() + center.y.abs() + center.z.abs() + rest_radius;
        Sphere { center, radius: rest_radius * (1.0 + self.padding) + 4.0 * f32::EPSILON * extent }
    }

    /// Joins the tree with a body's state and its particles' `positions` (m). After the particles have moved, call
    /// [`WrappedSpheres::invalidate`] first.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are fewer positions than the features need.
    pub fn pose<'a>(
        &'a self,
        positions: &'a [Vec3],
        state: &'a mut WrappedSpheres,
    ) -> Result<WrappedPose<'a>, Error> {
        self.topology.check_positions(positions)?;
        state.fit(self.nodes.len());
        Ok(WrappedPose { tree: self, positions, state })
    }

    /// The smallest padding with which every sphere contains its geometry at `positions` (m): 0 after a
    /// rigid motion, up to rounding. O(n log n); for choosing and checking the padding of a kind of body.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are fewer positions than the features need.
    pub fn padding_needed(&self, positions: &[Vec3]) -> Result<f32, Error> {
        self.topology.check_positions(positions)?;
        let mut needed = 0.0_f32;
        for (node, particles) in particles_below(&self.topology).iter().enumerate() {
            let center = self.sphere(node, positions).center;
            let rest_radius = self.nodes[node].rest_radius;
            for &particle in particles {
                let distance = center.distance_to(positions[particle as usize]);
                if distance > rest_radius {
                    needed = needed.max((distance - rest_radius) / rest_radius);
                }
            }
        }
        Ok(needed)
    }

    /// The arrangement of the features.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// By which fraction the radii are enlarged.
    pub fn padding(&self) -> f32 {
        self.padding
    }

    /// Checks a tree that came from outside, before its first use.
    ///
    /// # Errors
    /// [`Error::Invalid`] or [`Error::OutOfRange`] if it does not fit `particle_count` particles, or its lists do not
    /// fit each other.
    pub fn validate(&self, particle_count: usize) -> Result<(), Error> {
        self.topology.validate(particle_count)?;
        check_padding(self.padding)?;
        if self.nodes.len() != self.topology.node_count() {
            return Err(invalid("nodes".into(), "there must be one for each node"));
        }
        let sound = |node: &WrappedNode| {
            let SupportPoints { points, weights, count } = node.support;
            (1..=4).contains(&count)
                && points.iter().all(|&point| point < self.topology.particle_count() as u32)
                && weights.iter().all(|weight| (0.0..=1.0).contains(weight))
                && (0.0..f32::INFINITY).contains(&node.rest_radius)
        };
        match self.nodes.iter().position(|node| !sound(node)) {
            Some(index) => {
                Err(invalid(format!("nodes[{index}]"), "its support or its radius is out of range"))
            }
            None => Ok(()),
        }
    }
}

impl WrappedSpheres {
    /// Says that the body has moved: every sphere is computed anew when it is next asked for.
    pub fn invalidate(&mut self) {
        self.motion = self.motion.wrapping_add(1);
        if self.motion == 0 {
            self.stamps.fill(0);
            self.motion = 1;
        }
    }

    /// How many spheres have been computed since the last [`WrappedSpheres::invalidate`].
    pub fn computed_count(&self) -> usize {
        self.stamps.iter().filter(|&&stamp| stamp == self.motion).count()
    }

    fn fit(&mut self, node_count: usize) {
        if self.spheres.len() != node_count || self.stamps.len() != node_count || self.motion == 0 {
            self.spheres = vec![Sphere::default(); node_count];
            self.stamps = vec![0; node_count];
            self.motion = 1;
        }
    }
}

impl SphereHierarchy for WrappedPose<'_> {
    #[inline]
    fn leaf_count(&self) -> usize {
        self.tree.topology.leaf_count()
    }

    #[inline]
    fn sphere(&mut self, node: usize) -> Sphere {
        if self.state.stamps[node] != self.state.motion {
            self.state.spheres[node] = self.tree.sphere(node, self.positions);
            self.state.stamps[node] = self.state.motion;
        }
        self.state.spheres[node]
    }
}

/// For every node the particles of the features below it, ascending, each once.
fn particles_below(topology: &Topology) -> Vec<Vec<u32>> {
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); topology.leaf_count() - 1];
    below.extend(topology.features().iter().map(|feature| feature.particles().to_vec()));
    for node in (0..below.len()).rev() {
        if let Some([left, right]) = topology.children(node) {
            below[node] = [&below[left][..], &below[right][..]].concat();
        }
        below[node].sort_unstable();
        below[node].dedup();
    }
    below
}

fn check_padding(padding: f32) -> Result<(), Error> {
    if padding >= 0.0 && padding.is_finite() {
        return Ok(());
    }
    let expected = "a finite number, 0 or above";
    Err(Error::OutOfRange { field: "padding".into(), value: padding.into(), expected })
}
