//! Where rays enter bodies.

use glam::{DVec3, Vec3};

use super::{QueryFilter, Selection, at_most};
use crate::error::{Error, coordinates, within};
use crate::geometry::query::{self, Ray, ray_to_half_space};
use crate::norm::Norm;
use crate::order::PutInOrder;
use crate::world::{BodyHandle, World};

/// Where a ray enters a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayHit {
    /// The body.
    pub body: BodyHandle,
    /// Where, in m.
    pub point: Vec3,
    /// Unit, out of the body; of a triangle without an inside the side that the ray comes from. If the ray begins in
    /// the body, out of the closest place of its surface.
    pub normal: Vec3,
    /// From the origin of the ray, in m; 0 if that is in the body.
    pub distance: f32,
}

impl World {
    /// The first body that a ray enters from `origin` (m) along `direction` (of a length from 1e-6 to 1e6), up to the
    /// distance `max` (m). Of bodies equally far away the one that was added first.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a coordinate, the direction or `max` is; [`Error::StaleHandle`] if the filter's is.
    pub fn ray_cast(
        &self,
        origin: Vec3,
        direction: Vec3,
        max: f32,
        filter: QueryFilter,
    ) -> Result<Option<RayHit>, Error> {
        let (ray, selection) = (checked(origin, direction, max)?, self.select(filter)?);
        let mut first: Option<(usize, query::RayHit)> = None;
        self.ray_hits(&ray, selection, |body, hit| {
            if first.is_none_or(|(other, at)| (hit.t, body) < (at.t, other)) {
                first = Some((body, hit));
            }
            first.map_or(ray.max, |(_, at)| at.t)
        });
        Ok(first.map(|(body, hit)| self.told(&ray, body, hit)))
    }

    /// All bodies that a ray enters, see [`World::ray_cast`], each where it enters it first; nearest first.
    ///
    /// # Errors
    /// As [`World::ray_cast`].
    pub fn ray_cast_all(
        &self,
        origin: Vec3,
        direction: Vec3,
        max: f32,
        filter: QueryFilter,
    ) -> Result<Vec<RayHit>, Error> {
        let (ray, selection) = (checked(origin, direction, max)?, self.select(filter)?);
        let mut hits = Vec::new();
        self.ray_hits(&ray, selection, |body, hit| {
            hits.push((body, hit));
            ray.max
        });
        hits.put_in_order_by(|(a, at), (b, bt)| a.cmp(b).then(at.t.total_cmp(&bt.t)));
        hits.dedup_by_key(|(body, _)| *body);
        hits.put_in_order_by(|(_, at), (_, bt)| at.t.total_cmp(&bt.t));
        Ok(hits.into_iter().map(|(body, hit)| self.told(&ray, body, hit)).collect())
    }

    /// Calls `visit` with the index of a body and where the ray enters a piece of it, for all that may be nearer than
    /// what `visit` returned last.
    fn ray_hits(&self, ray: &Ray, selection: Selection, mut visit: impl FnMut(usize, query::RayHit) -> f64) {
        let mut max = ray.max;
        for (index, wall) in self.selected_walls(selection) {
            if let Some(hit) = ray_to_half_space(ray, wall.normal.as_dvec3(), f64::from(wall.offset)) {
                max = visit(index, hit);
            }
        }
        let (origin, direction) = (ray.origin.as_vec3(), ray.direction.as_vec3());
        let tree = &self.query_index().tree;
        tree.ray(origin, direction, at_most(max), self.settings.instructions, |item, _| {
            let found = self.selected_piece(item, selection);
            if let Some((body, hit)) = found.and_then(|(body, piece)| Some((body, piece.ray(ray)?))) {
                max = visit(body, hit);
            }
            at_most(max)
        });
    }

    fn told(&self, ray: &Ray, body: usize, hit: query::RayHit) -> RayHit {
        RayHit {
            body: self.slots.handle(body),
            point: ray.at(hit.t).as_vec3(),
            normal: hit.normal.as_vec3(),
            distance: (hit.t * ray.direction.norm()) as f32,
        }
    }
}

fn checked(origin: Vec3, direction: Vec3, max: f32) -> Result<Ray, Error> {
    coordinates("origin", origin)?;
    coordinates("direction", direction)?;
    let direction: DVec3 = direction.as_dvec3();
    let length = direction.norm();
    within("direction", length as f32, 1e-6, 1e6, "a vector with a length from 1e-6 to 1e6")?;
    within("max", max, 0.0, 1e10, "a distance from 0 to 1e10 (m)")?;
    Ok(Ray { origin: origin.as_dvec3(), direction, max: f64::from(max) / length })
}
