//! The least depth of all, or the distance, in f64: GJK and EPA on the same corners. Some microseconds; for
//! deep overlaps and for what f32 cannot tell.

use glam::{DMat3, DVec3, Vec3};

use super::clip::Polygon;
use super::core::{Core, Pair};
use super::reduce::{Candidate, Former, reduce};
use super::touch::Touch;
use crate::geometry::epa::Epa;
use crate::geometry::gjk::{self, MAX_ITERATIONS, Proximity};
use crate::geometry::support::{Points, Support};
use crate::norm::Norm;

/// Memory to be kept and reused, so that calls allocate nothing.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    epa: Epa,
    pub(super) polygon: Polygon,
    /// Of the pair to be looked at next.
    pub(crate) former: Former,
}

impl Scratch {
    /// The best of the candidates, at most four; see [`reduce`].
    #[inline(always)]
    pub(super) fn reduce(&mut self, normal: Vec3, size: f32) -> &[Candidate] {
        let candidates = &mut self.polygon.candidates;
        let count = reduce(candidates, normal, size, &self.former);
        &candidates[..count]
    }
}

/// Corners of B, seen from A.
struct Placed<'a> {
    corners: &'a [Vec3],
    rotation: DMat3,
    translation: DVec3,
}

impl Support for Placed<'_> {
    fn support(&self, direction: DVec3) -> u32 {
        Points(self.corners).support(self.rotation.transpose() * direction)
    }

    fn point(&self, index: u32) -> DVec3 {
        self.rotation * Points(self.corners).point(index) + self.translation
    }
}

/// Where the cores are nearest, or least deep in each other. `axis`, unit, says which way flat cores that touch are
/// to be pushed apart. `size` is passed on.
#[cold]
#[inline(never)]
pub(super) fn touch<B: Core>(pair: &Pair<B>, scratch: &mut Scratch, axis: Vec3, size: f32) -> Touch {
    let a = Points(&pair.a.vertices);
    let b = Placed {
        corners: pair.b.vertices(),
        rotation: pair.b_in_a.rotation.as_dmat3(),
        translation: pair.b_in_a.translation.as_dvec3(),
    };
    let mut start = axis;
    let gjk = gjk::closest(&a, &b, &mut start);
    let (vertices, weights, normal, separation) = if gjk.proximity == Proximity::Separated {
        let (vertices, weights) = gjk.simplex.triangle();
        let apart = -gjk.simplex.closest_point();
        (vertices, weights, apart.unit_or(axis.as_dvec3()), apart.norm())
    } else {
        let face = scratch.epa.hit_face(&a, &b, &gjk.simplex, axis, MAX_ITERATIONS - gjk.iterations);
        (face.vertices, face.barycentric, face.normal, -face.depth)
    };
    let mean = |points: [DVec3; 3]| points[0] * weights[0] + points[1] * weights[1] + points[2] * weights[2];
    Touch {
        normal: normal.as_vec3(),
        separation: separation as f32,
        on_a: mean(vertices.map(|v| a.point(v.a))).as_vec3(),
        on_b: mean(vertices.map(|v| b.point(v.b))).as_vec3(),
        pairs: vertices.map(|v| [v.a as u16, v.b as u16]),
        count: 3,
        size,
    }
    .aligned()
}
