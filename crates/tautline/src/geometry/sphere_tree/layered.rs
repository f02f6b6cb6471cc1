//! The layered tree: a node's sphere is the smallest around its children's spheres. For cloth and rope.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::build::{Feature, Topology, invalid};
use super::descend::SphereHierarchy;
use crate::Error;
use crate::geometry::Sphere;

/// A sphere tree for a body that deforms: refitted whole, bottom-up, in O(n) (paper 5.2).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LayeredTree {
    topology: Topology,
    thickness: f32,
    /// Per node; the last `leaf_count` are the leaves'.
    spheres: Vec<Sphere>,
}

impl LayeredTree {
    /// Builds the tree in the rest pose `positions` and fits it to them. `thickness` (m) is added to the radius of every
    /// leaf: the radius of a rope, or 0.
    ///
    /// # Errors
    /// As [`Topology::build`], and [`Error::OutOfRange`] if `thickness` is negative or not finite.
    pub fn new(features: &[Feature], positions: &[Vec3], thickness: f32) -> Result<Self, Error> {
        check_thickness(thickness)?;
        let topology = Topology::build(features, positions)?;
        let spheres = vec![Sphere::default(); topology.node_count()];
        let mut tree = LayeredTree { topology, thickness, spheres };
        tree.refit(positions)?;
        Ok(tree)
    }

    /// Moves all spheres to the particles' `positions` (m). Positions that are not finite do no harm but to
    /// the spheres above them: these overlap nothing, or leave such a particle out.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are fewer positions than the features need; the tree is as before.
    pub fn refit(&mut self, positions: &[Vec3]) -> Result<(), Error> {
        self.topology.check_positions(positions)?;
        let (inner, leaves) = self.spheres.split_at_mut(self.topology.leaf_count() - 1);
        for (sphere, feature) in leaves.iter_mut().zip(self.topology.features()) {
            *sphere = around_feature(feature, positions);
            sphere.radius += self.thickness;
        }
        // Children come after their parent, so backwards they are ready first.
        for node in (0..inner.len()).rev() {
            let child = 2 * node + 1;
            self.spheres[node] = Sphere::around_two(self.spheres[child], self.spheres[child + 1]);
        }
        Ok(())
    }

    /// The arrangement of the features.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// All spheres by node, as of the last refit.
    pub fn spheres(&self) -> &[Sphere] {
        &self.spheres
    }

    /// The spheres of the leaves, as of the last refit.
    pub fn leaf_spheres(&self) -> &[Sphere] {
        &self.spheres[self.topology.leaf_count() - 1..]
    }

    /// What is added to the radius of every leaf, in m.
    pub fn thickness(&self) -> f32 {
        self.thickness
    }

    /// Checks a tree that came from outside, before its first use.
    ///
    /// # Errors
    /// [`Error::Invalid`] or [`Error::OutOfRange`] if it does not fit `particle_count` particles, or its lists do not
    /// fit each other.
    pub fn validate(&self, particle_count: usize) -> Result<(), Error> {
        self.topology.validate(particle_count)?;
        check_thickness(self.thickness)?;
        if self.spheres.len() != self.topology.node_count() {
            return Err(invalid("spheres".into(), "there must be one for each node"));
        }
        Ok(())
    }
}

impl SphereHierarchy for &LayeredTree {
    #[inline]
    fn leaf_count(&self) -> usize {
        self.topology.leaf_count()
    }

    #[inline]
    fn sphere(&mut self, node: usize) -> Sphere {
        self.spheres[node]
    }
}

fn check_thickness(thickness: f32) -> Result<(), Error> {
    if thickness >= 0.0 && thickness.is_finite() {
        return Ok(());
    }
    let expected = "a finite number, 0 or above";
    Err(Error::OutOfRange { field: "thickness".into(), value: thickness.into(), expected })
}

#[inline]
fn around_feature(feature: &Feature, positions: &[Vec3]) -> Sphere {
    let at = |particle: u32| positions[particle as usize];
    match *feature {
        Feature::Point(particle) => Sphere { center: at(particle), radius: 0.0 },
        Feature::Segment([a, b]) => Sphere::around_segment(at(a), at(b)),
        Feature::Triangle([a, b, c]) => Sphere::around_triangle(at(a), at(b), at(c)),
        Feature::Quad([a, b, c, d]) => Sphere::around_quad(at(a), at(b), at(c), at(d)),
    }
}
