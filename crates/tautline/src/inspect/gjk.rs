//! GJK between two bodies, iteration by iteration.

use glam::Vec3;

use crate::body::Substance;
use crate::error::Error;
use crate::geometry::epa::{Epa, HitFace};
use crate::geometry::feature::ContactFeatures;
use crate::geometry::gjk::{self, Gjk, Iteration, MAX_ITERATIONS, Proximity};
use crate::geometry::support::Points;
use crate::norm::Norm;
use crate::world::{BodyHandle, World};

/// The most vertices of a hull that is traced.
const MOST_VERTICES: usize = 5000;

/// How GJK finds out how two bodies lie.
#[derive(Debug, Clone)]
pub struct GjkTrace {
    /// The vertices of either body, in m: what the indices of all vertices count in.
    pub hulls: [Vec<Vec3>; 2],
    /// One after another.
    pub iterations: Vec<Iteration>,
    /// What came of them.
    pub found: Gjk,
    /// If the bodies overlap, where they are hit.
    pub hit: Option<HitFeatures>,
}

/// Where two bodies that overlap are hit.
#[derive(Debug, Clone, Copy)]
pub struct HitFeatures {
    /// The face of A ⊖ B nearest to the origin.
    pub face: HitFace,
    /// The features that it is made of, and their points that separation moves.
    pub features: ContactFeatures,
}

impl World {
    /// GJK between the convex hulls of the vertices of two rigid bodies or trusses as they are now, without a memory of
    /// earlier steps, then EPA if they overlap. Of what is round it sees the vertices that are drawn.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] for a body of another kind, or of more than 5000 vertices.
    pub fn trace_gjk(&self, a: BodyHandle, b: BodyHandle) -> Result<GjkTrace, Error> {
        let hulls = [self.hull("a", a)?, self.hull("b", b)?];
        let (set_a, set_b) = (Points(&hulls[0]), Points(&hulls[1]));
        let (mut iterations, mut axis) = (Vec::new(), Vec3::ZERO);
        let found = gjk::trace(&set_a, &set_b, &mut axis, &mut |iteration| iterations.push(iteration));
        let hit = (found.proximity == Proximity::Intersecting).then(|| {
            let face = Epa::default().hit_face(&set_a, &set_b, &found.simplex, axis, MAX_ITERATIONS);
            HitFeatures { face, features: ContactFeatures::new(&set_a, &set_b, &face) }
        });
        Ok(GjkTrace { hulls, iterations, found, hit })
    }

    fn hull(&self, field: &str, handle: BodyHandle) -> Result<Vec<Vec3>, Error> {
        let view = self.body(handle)?;
        let vertices = match &self.bodies[self.slots.index(handle)?].substance {
            Substance::Rigid(_) => view.surface_positions().into_owned(),
            Substance::Truss { truss } => view.positions()[..truss.surface().vertex_count()].to_vec(),
            Substance::Deformable(_) | Substance::HalfSpace(_) => Vec::new(),
        };
        if (1..=MOST_VERTICES).contains(&vertices.len()) {
            return Ok(vertices);
        }
        let problem = format!("is not a rigid body or truss of at most {MOST_VERTICES} vertices");
        Err(Error::Invalid { field: field.into(), problem })
    }
}

impl GjkTrace {
    /// The closest points of two hulls that are apart, or those of the features of two that overlap, in m.
    pub fn points(&self) -> [Vec3; 2] {
        if let Some(hit) = &self.hit {
            return [hit.features.point_a, hit.features.point_b];
        }
        let simplex = &self.found.simplex;
        let mean = |side: usize| {
            let terms = simplex.vertices().iter().zip(simplex.weights()).map(|(vertex, &weight)| {
                let index = [vertex.a, vertex.b][side] as usize;
                self.hulls[side].get(index).copied().unwrap_or_default() * weight as f32
            });
            terms.sum()
        };
        [mean(0), mean(1)]
    }

    /// The distance of the hulls, in m; below 0 how deep they are in each other.
    pub fn distance(&self) -> f32 {
        let [a, b] = self.points();
        self.hit.as_ref().map_or_else(|| a.distance_to(b), |hit| -hit.features.depth)
    }
}
