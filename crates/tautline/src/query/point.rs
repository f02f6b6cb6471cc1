//! The closest place of a body.

use glam::Vec3;

use super::{QueryFilter, at_most};
use crate::error::{Error, coordinates, within};
use crate::geometry::query::{Closest, closest_to_half_space};
use crate::world::{BodyHandle, World};

/// The place of a body's surface that is closest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointHit {
    /// The body.
    pub body: BodyHandle,
    /// The closest place, in m.
    pub point: Vec3,
    /// Unit, out of the body: the point asked for is `point + distance * normal`.
    pub normal: Vec3,
    /// In m; below 0 if the point asked for is in the body.
    pub distance: f32,
}

impl World {
    /// The body whose surface is closest to a point (m), within the distance `max` (m); if the point is in bodies, the
    /// one it is deepest in. Of bodies equally close the one that was added first.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a coordinate or `max` is; [`Error::StaleHandle`] if the filter's is.
    pub fn closest_point(
        &self,
        point: Vec3,
        max: f32,
        filter: QueryFilter,
    ) -> Result<Option<PointHit>, Error> {
        coordinates("point", point)?;
        within("max", max, 0.0, 1e10, "a distance from 0 to 1e10 (m)")?;
        let selection = self.select(filter)?;
        let (from, limit) = (point.as_dvec3(), f64::from(max));
        let mut first: Option<(usize, Closest)> = None;
        let mut offer = |body: usize, found: Closest| {
            let is_closer = first.is_none_or(|(other, at)| (found.distance, body) < (at.distance, other));
            if found.distance <= limit && is_closer {
                first = Some((body, found));
            }
            // What is around the point is looked at to the last, for the deepest.
            first.map_or(limit, |(_, at)| at.distance.max(0.0))
        };
        let mut bound = limit;
        for (index, wall) in self.selected_walls(selection) {
            let found = closest_to_half_space(from, wall.normal.as_dvec3(), f64::from(wall.offset));
            bound = offer(index, found);
        }
        let tree = &self.query_index().tree;
        tree.nearest(point, at_most(bound), self.settings.instructions, |item, _| {
            let found = self.selected_piece(item, selection);
            if let Some((body, found)) = found.and_then(|(body, piece)| Some((body, piece.closest(from)?))) {
                bound = offer(body, found);
            }
            at_most(bound)
        });
        Ok(first.map(|(body, found)| PointHit {
            body: self.slots.handle(body),
            point: found.point.as_vec3(),
            normal: found.normal.as_vec3(),
            distance: found.distance as f32,
        }))
    }
}
