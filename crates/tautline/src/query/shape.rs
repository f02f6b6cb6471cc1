//! What a shape overlaps, and what it first touches on its way.

use glam::{Quat, Vec3};

use super::piece::Pose;
use super::{QueryFilter, Selection, at_most};
use crate::collision::Aabb;
use crate::error::{Error, coordinates, within};
use crate::geometry::query::{Motion, Rounded, Touch, first_touch, first_touch_of_half_space};
use crate::shape::Shape;
use crate::world::{BodyHandle, World};

/// Where a moving shape first touches a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CastHit {
    /// The body.
    pub body: BodyHandle,
    /// How much of its way the shape has gone, from 0 (it touches from the start) to 1. Never late.
    pub fraction: f32,
    /// Where on the body's surface it touches then, or is deepest in it, in m.
    pub point: Vec3,
    /// Unit, out of the body.
    pub normal: Vec3,
}

/// A convex part of a shape on its way.
struct Mover<'a> {
    motion: Motion<'a>,
    /// Its box at the start.
    bounds: Aabb,
    /// The box around its whole way.
    swept: Aabb,
}

impl World {
    /// The first body that a shape touches which moves from `position` (of its own frame's origin, m), turned by
    /// `rotation`, by `translation` (m) without turning. Of bodies touched at once the one that was added first.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a coordinate or the rotation is; [`Error::Invalid`] if the shape has no inside;
    /// [`Error::StaleHandle`] if the filter's is.
    pub fn shape_cast(
        &self,
        shape: &Shape,
        position: Vec3,
        rotation: Quat,
        translation: Vec3,
        filter: QueryFilter,
    ) -> Result<Option<CastHit>, Error> {
        coordinates("translation", translation)?;
        let movers = movers(shape, position, rotation, translation)?;
        let selection = self.select(filter)?;
        let mut first: Option<(usize, Touch)> = None;
        let mut offer = |body: usize, touch: Touch| {
            if first.is_none_or(|(other, at)| (touch.time, body) < (at.time, other)) {
                first = Some((body, touch));
            }
            first.map_or(1.0, |(_, at)| at.time)
        };
        let mut max = 1.0;
        for mover in &movers {
            self.walls_touched(mover, selection, |body, touch| max = offer(body, touch));
            let tree = &self.query_index().tree;
            let instructions = self.settings.instructions;
            tree.sweep(mover.bounds, translation, at_most(max), instructions, |item, _| {
                if let Some((body, touch)) = self.touched(item, mover, selection) {
                    max = offer(body, touch);
                }
                at_most(max)
            });
        }
        Ok(first.map(|(body, touch)| CastHit {
            body: self.slots.handle(body),
            fraction: touch.time as f32,
            point: touch.at.point.as_vec3(),
            normal: -touch.at.normal.as_vec3(),
        }))
    }

    /// The bodies that a shape overlaps or touches whose own frame's origin is at `position` (m), turned by
    /// `rotation`; in the order of [`World::bodies`].
    ///
    /// # Errors
    /// As [`World::shape_cast`].
    pub fn overlap(
        &self,
        shape: &Shape,
        position: Vec3,
        rotation: Quat,
        filter: QueryFilter,
    ) -> Result<Vec<BodyHandle>, Error> {
        let movers = movers(shape, position, rotation, Vec3::ZERO)?;
        let selection = self.select(filter)?;
        let mut found = vec![false; self.bodies.len()];
        for mover in &movers {
            self.walls_touched(mover, selection, |body, _| found[body] = true);
            let index = self.query_index();
            index.tree.overlaps(mover.bounds, self.settings.instructions, |item| {
                if !found[index.item(item).body]
                    && let Some((body, _)) = self.touched(item, mover, selection)
                {
                    found[body] = true;
                }
            });
        }
        let indices = found.iter().enumerate().filter(|(_, found)| **found);
        Ok(indices.map(|(index, _)| self.slots.handle(index)).collect())
    }

    fn walls_touched(&self, mover: &Mover<'_>, selection: Selection, mut visit: impl FnMut(usize, Touch)) {
        for (index, wall) in self.selected_walls(selection) {
            let (normal, offset) = (wall.normal.as_dvec3(), f64::from(wall.offset));
            if let Some(touch) = first_touch_of_half_space(&mover.motion, normal, offset, 0.0) {
                visit(index, touch);
            }
        }
    }

    /// The body a piece is of, and when it is first touched.
    fn touched(&self, item: u32, mover: &Mover<'_>, selection: Selection) -> Option<(usize, Touch)> {
        let (body, piece) = self.selected_piece(item, selection)?;
        let mut first: Option<Touch> = None;
        piece.convex_sets(&mover.swept, |fixed| {
            let touch = first_touch(&mover.motion, fixed, 0.0);
            if let Some(touch) = touch.filter(|touch| first.is_none_or(|at| touch.time < at.time)) {
                first = Some(touch);
            }
        });
        first.map(|touch| (body, touch))
    }
}

fn movers(shape: &Shape, position: Vec3, rotation: Quat, translation: Vec3) -> Result<Vec<Mover<'_>>, Error> {
    coordinates("position", position)?;
    within("rotation", rotation.length_squared(), 1e-6, 1e6, "a quaternion with a length near 1")?;
    if !shape.is_solid() {
        let problem = "has no inside: a mesh or height field can be found, but finds nothing".into();
        return Err(Error::Invalid { field: "shape".into(), problem });
    }
    let (pose, way) = (Pose::of_shape(shape, position, rotation), translation.as_dvec3());
    Ok(shape
        .parts()
        .iter()
        .map(|part| {
            let bounds = pose.bounds(part.low, part.high);
            let low = bounds.low.min(bounds.low + translation);
            let high = bounds.high.max(bounds.high + translation);
            let motion = Motion::translation(Rounded::of(&part.convex), pose.position, pose.rotation, way);
            Mover { motion, bounds, swept: Aabb { low, high } }
        })
        .collect())
}
