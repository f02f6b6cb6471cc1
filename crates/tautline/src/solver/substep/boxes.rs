//! Boxes larger than the bodies, so that these may move for a while before anybody has to look who may meet whom.

use glam::{Mat3, Vec3};

use super::block::{Block, Rows3, column};
use super::crew::{Crew, Earlier, Track};
use super::lineup::Lineup;
use crate::body::{Body, CollisionGroups, Motion, Rigid};
use crate::collision::Aabb;
use crate::norm::Norm;
use crate::shape::Part;
use crate::simd::LANES;

/// By how much more than it needs a body's box is larger, as a share of its reach.
const SKIN: f32 = 0.08;
/// For how many more steps of the same motion a box is large enough.
const STEPS_AHEAD: f32 = 0.5;
/// As far as boxes reach, in m: what is about to leave the numbers there are has a box that is finite all the same.
const FAR: Vec3 = Vec3::splat(1e37);
/// Around nothing.
const NOTHING: Aabb = Aabb { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

/// A rigid body for the search, where it was when its box was made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Boxed {
    pub(super) body: u32,
    pub(super) place: u32,
    /// How far it may get, in m.
    pub(super) room: f32,
    reach: f32,
    pub(super) center: Vec3,
    groups: CollisionGroups,
    pub(super) is_dynamic: bool,
    /// Whether it has one part and is solid.
    pub(super) is_single: bool,
}

impl Crew {
    /// Makes the boxes of all bodies where they are.
    pub(super) fn set_boxes(&mut self, lineup: &Lineup) {
        for (block, places) in lineup.places.chunks(LANES).enumerate() {
            let Block { center, axes: [x, y, _], .. } = self.blocks[block];
            for (lane, &body) in places.iter().enumerate() {
                let is_own = lineup.is_place_of((block * LANES + lane) as u32, body);
                let room = if is_own { self.room(block, lane) } else { f32::INFINITY };
                self.tracks[block].room.0[lane] = room;
            }
            (self.tracks[block].boxed, self.tracks[block].leaves) = (Earlier { center, axes: [x, y] }, 0);
        }
    }

    /// Makes the box of one body where it is.
    pub(super) fn set_box(&mut self, place: u32) {
        let (index, lane) = (place as usize / LANES, place as usize % LANES);
        let room = self.room(index, lane);
        let (track, block) = (&mut self.tracks[index], &self.blocks[index]);
        let copy = |to: &mut Rows3, from: &Rows3| {
            to.iter_mut().zip(from).for_each(|(to, from)| to.0[lane] = from.0[lane]);
        };
        copy(&mut track.boxed.center, &block.center);
        track.boxed.axes.iter_mut().zip(&block.axes).for_each(|(to, from)| copy(to, from));
        track.room.0[lane] = room;
    }

    /// How far a body may get from where its box is made.
    fn room(&self, block: usize, lane: usize) -> f32 {
        let reach = self.blocks[block].constants.reach.0[lane];
        self.tracks[block].need.0[lane] * (1.0 + STEPS_AHEAD) + SKIN * reach
    }

    fn track_of(&self, place: u32) -> (&Track, usize) {
        (&self.tracks[place as usize / LANES], place as usize % LANES)
    }
}

impl Boxed {
    /// The body in a place, if it is a rigid one, with the box that was last made for it.
    pub(super) fn new((body, place): (u32, u32), crew: &Crew, bodies: &[Body]) -> Option<Self> {
        let rigid = bodies[body as usize].rigid()?;
        let (track, lane) = crew.track_of(place);
        Some(Self {
            body,
            place,
            room: track.room.0[lane],
            reach: rigid.shape.reach(),
            center: column(&track.boxed.center, lane),
            groups: rigid.traits.groups,
            is_dynamic: rigid.traits.motion == Motion::Dynamic,
            is_single: rigid.shape.surface().is_none() && rigid.shape.parts().len() == 1,
        })
    }

    /// Its axes.
    pub(super) fn axes(&self, crew: &Crew) -> Mat3 {
        let (track, lane) = crew.track_of(self.place);
        let [x, y] = track.boxed.axes.each_ref().map(|rows| column(rows, lane));
        Mat3::from_cols(x, y, x.cross(y))
    }

    pub(super) fn bounds(&self, crew: &Crew, rigid: &Rigid) -> Aabb {
        let axes = self.axes(crew);
        let parts = rigid.shape.parts().iter().map(|part| (part.low, part.high));
        let boxes = parts.chain(rigid.shape.surface().map(|surface| surface.bounds()));
        let bounds = boxes.fold(NOTHING, |sum, (low, high)| {
            let part = Aabb::around_turned(self.center, &axes, low, high);
            Aabb { low: sum.low.min(part.low), high: sum.high.max(part.high) }
        });
        let bounds = bounds.grown(self.room);
        Aabb { low: bounds.low.max(-FAR).min(FAR), high: bounds.high.max(-FAR).min(FAR) }
    }

    /// Around one of its parts.
    pub(super) fn box_of(&self, axes: &Mat3, part: &Part) -> Aabb {
        Aabb::around_turned(self.center, axes, part.low, part.high).grown(self.room)
    }

    /// Whether it meets half-spaces.
    pub(super) fn meets_half_spaces(&self) -> bool {
        self.is_dynamic && self.groups.collide_with(CollisionGroups::default())
    }

    /// Whether the balls around both overlap, and nothing forbids them to collide.
    #[inline(always)]
    pub(super) fn may_meet(&self, other: &Self, separated: &[[u32; 2]]) -> bool {
        // The same sum whichever of the two asks.
        let apart = (self.reach + self.room) + (other.reach + other.room);
        // Not `<=`: what is not a number may be anywhere.
        let is_far = self.center.distance_to(other.center) > apart;
        !is_far
            && self.groups.collide_with(other.groups)
            && separated.binary_search(&[self.body.min(other.body), self.body.max(other.body)]).is_err()
    }
}
