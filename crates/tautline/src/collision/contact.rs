//! A contact: two points of two surfaces, each a weighted mean of particles, that have to be moved apart.

use glam::Vec3;

use crate::geometry::feature::FeaturePoint;
use crate::particles::Particles;

/// A point p = Σ λᵢ xᵢ of a body's surface, Σ λᵢ = 1: a vertex, a point of an edge or face, or the middle of a
/// leaf.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Patch {
    /// Indices into the world's particles; unused places repeat the first with weight 0.
    pub(crate) particles: [u32; 4],
    pub(crate) weights: [f32; 4],
}

impl Patch {
    pub(crate) fn vertex(particle: usize) -> Self {
        Self { particles: [particle as u32; 4], weights: [1.0, 0.0, 0.0, 0.0] }
    }

    /// `first` is the number of the body's first particle.
    pub(crate) fn feature(first: usize, point: &FeaturePoint) -> Self {
        let mut patch = Self::vertex(first + point.indices[0] as usize);
        for (k, (index, weight)) in point.iter().enumerate() {
            patch.particles[k] = (first + index as usize) as u32;
            patch.weights[k] = weight;
        }
        patch
    }

    /// The mean of one to four particles of a body.
    pub(crate) fn mean(first: usize, particles: &[u32]) -> Self {
        let mut patch = Self { weights: [0.0; 4], ..Self::vertex(first + particles[0] as usize) };
        for (k, &particle) in particles.iter().enumerate().take(4) {
            patch.particles[k] = (first + particle as usize) as u32;
            patch.weights[k] = 1.0 / particles.len() as f32;
        }
        patch
    }

    pub(crate) fn terms(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        self.particles
            .iter()
            .zip(self.weights)
            .filter(|&(_, weight)| weight != 0.0)
            .map(|(&i, w)| (i as usize, w))
    }

    pub(crate) fn point(&self, of: &[Vec3]) -> Vec3 {
        self.terms().map(|(i, weight)| of[i] * weight).sum()
    }

    /// Σ wᵢ λᵢ², in 1/kg: how easily the point moves.
    pub(crate) fn mobility(&self, particles: &Particles) -> f32 {
        self.terms().map(|(i, weight)| particles.inverse_mass[i] * weight * weight).sum()
    }
}

/// Two points that have to be moved apart along a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    /// Index of the body that owns `a`.
    pub(crate) body_a: u32,
    /// Index of the body that owns `b`, or of the half-space.
    pub(crate) body_b: u32,
    pub(crate) a: Patch,
    /// `None`: a half-space, which never moves.
    pub(crate) b: Option<Patch>,
    /// Unit, from A to B.
    pub(crate) normal: Vec3,
    /// The depth is n·(p_A − p_B) − offset, in m, wherever the particles have been moved since detection.
    pub(crate) offset: f32,
    pub(crate) friction: f32,
}

impl Contact {
    /// How deep A is in B now, in m; negative once they are apart.
    pub(crate) fn depth(&self, positions: &[Vec3]) -> f32 {
        let point_b = self.b.map_or(Vec3::ZERO, |b| b.point(positions));
        self.normal.dot(self.a.point(positions) - point_b) - self.offset
    }
}
