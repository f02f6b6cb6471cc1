//! Who may meet whom: boxes larger than the bodies, and the list of pairs made from them.

use glam::{Mat3, Vec3};

use super::RigidSolver;
use super::block::{column, columns};
use super::crew::Crew;
use super::lineup::{Lineup, NOBODY};
use super::pairs::{Key, Pairs};
use crate::body::{Body, CollisionGroups, HalfSpace, Motion, Rigid, Substance};
use crate::collision::Aabb;
use crate::collision::bvh::{PairSearch, overlapping_pairs};
use crate::parallel;
use crate::settings::Settings;
use crate::shape::{Part, Surface};
use crate::simd::{Instructions, LANES};

/// By how much more than it needs a body's box is larger, as a share of its reach.
const SKIN: f32 = 0.08;
/// For how many more steps of the same motion a box is large enough.
const STEPS_AHEAD: f32 = 0.5;
/// From so many bodies on it pays to enclose them side by side, …
const WORTHWHILE: usize = 1024;
/// … so many at a time.
const CHUNK: usize = 256;

/// As far as boxes reach, in m: what is about to leave the numbers there are has a box that is finite all the same.
const FAR: Vec3 = Vec3::splat(1e37);

/// A rigid body for the search.
#[derive(Debug, Clone, Copy)]
struct Boxed {
    body: u32,
    place: u32,
    /// How far it may get, in m.
    room: f32,
    reach: f32,
    center: Vec3,
    groups: CollisionGroups,
    is_dynamic: bool,
    /// Whether it does not move at all.
    is_still: bool,
    /// Whether it has one part and is solid.
    is_single: bool,
}

/// What the search needs while it lasts.
#[derive(Debug, Clone, Default)]
pub(super) struct BoxSearch {
    overlaps: PairSearch,
    boxed: Vec<Boxed>,
    /// One for each of `boxed`.
    bounds: Vec<Aabb>,
    movable: Vec<bool>,
    /// By place.
    rooms: Vec<f32>,
    found: Vec<(u32, u32)>,
    keys: Vec<Key>,
    /// The last list of pairs.
    spare: Pairs,
}

impl RigidSolver {
    /// Makes boxes for all bodies where they are, and the list of pairs anew.
    pub(super) fn find_pairs(&mut self, bodies: &[Body], settings: &Settings) {
        let Self { search, lineup, crew, pairs, .. } = self;
        search.enclose(lineup, crew, bodies);
        crew.set_boxes(&search.rooms);
        search.keys.clear();
        search.pair_up(crew, bodies, &self.separated, settings.instructions);
        search.pair_with_half_spaces(crew, bodies);
        search.keys.sort();
        pairs.replace(&search.keys, &mut search.spare, |key| {
            let surface = |body: u32| bodies[body as usize].surface;
            surface(key.a).against(&surface(key.b))
        });
    }

    /// Gives back the memory of the search in a step that needs none: most do not, once bodies rest.
    pub(super) fn end_search(&mut self) {
        if self.search.boxed.capacity() > 0 {
            let mut overlaps = std::mem::take(&mut self.search).overlaps;
            overlaps.shrink();
            self.search.overlaps = overlaps;
            self.pairs.shrink();
        }
    }
}

impl BoxSearch {
    /// Gives every rigid body a box that lets it move as it does for a while.
    fn enclose(&mut self, lineup: &Lineup, crew: &Crew, bodies: &[Body]) {
        let Self { boxed, bounds, movable, rooms, .. } = self;
        boxed.clear();
        let standing = lineup.place_of.iter().zip(0..).filter(|&(&place, _)| place != NOBODY);
        boxed.extend(standing.map(|(&place, body)| Boxed::unknown(body, place)));
        bounds.clear();
        bounds.resize(boxed.len(), NOTHING);
        let worthwhile = parallel::is_worthwhile(boxed.len(), WORTHWHILE);
        let mut chunks: Vec<_> = boxed.chunks_mut(CHUNK).zip(bounds.chunks_mut(CHUNK)).collect();
        parallel::for_each(&mut chunks, worthwhile, |(boxed, bounds)| {
            for (entry, bounds) in boxed.iter_mut().zip(bounds.iter_mut()) {
                *bounds = entry.enclose(crew, bodies);
            }
        });
        movable.clear();
        movable.extend(boxed.iter().map(|entry| entry.is_dynamic));
        rooms.clear();
        rooms.resize(lineup.places.len(), f32::INFINITY);
        for entry in boxed.iter().filter(|entry| !entry.is_still) {
            rooms[entry.place as usize] = entry.room;
        }
    }

    fn pair_up(&mut self, crew: &Crew, bodies: &[Body], separated: &[[u32; 2]], instructions: Instructions) {
        let Self { overlaps, boxed, bounds, movable, found, keys, .. } = self;
        let may_meet = |a: u32, b: u32| boxed[a as usize].may_meet(&boxed[b as usize], separated);
        overlapping_pairs(bounds, movable, may_meet, instructions, overlaps, found);
        for &(a, b) in found.iter() {
            let (a, b) = (&boxed[a as usize], &boxed[b as usize]);
            // Of the two the one that moves comes first.
            let (a, b) = if a.is_dynamic { (a, b) } else { (b, a) };
            if a.is_single && b.is_single {
                keys.push(Key { a: a.body, b: b.body, part_a: 0, part_b: 0 });
            } else if let (Some(rigid_a), Some(rigid_b)) =
                (bodies[a.body as usize].rigid(), bodies[b.body as usize].rigid())
            {
                pair_parts(crew, (a, rigid_a), (b, rigid_b), keys);
            }
        }
    }

    /// Every part that reaches over a plane.
    fn pair_with_half_spaces(&mut self, crew: &Crew, bodies: &[Body]) {
        let Self { boxed, bounds, keys, .. } = self;
        let walls: Vec<(u32, &HalfSpace)> = (0..)
            .zip(bodies)
            .filter_map(|(index, body)| match &body.substance {
                Substance::HalfSpace(wall) => Some((index, wall)),
                _ => None,
            })
            .collect();
        let collides =
            |entry: &Boxed| entry.is_dynamic && entry.groups.collide_with(CollisionGroups::default());
        for (entry, bounds) in boxed.iter().zip(bounds).filter(|(entry, _)| collides(entry)) {
            for &(wall_body, wall) in walls.iter().filter(|(_, wall)| reaches_over(bounds, wall)) {
                let Some(rigid) = bodies[entry.body as usize].rigid() else { continue };
                let axes = axes_at(crew, entry.place);
                for (part_a, part) in (0..).zip(rigid.shape.parts()) {
                    if reaches_over(&entry.box_of(&axes, part), wall) {
                        keys.push(Key { a: entry.body, b: wall_body, part_a, part_b: 0 });
                    }
                }
            }
        }
    }
}

/// Around nothing.
const NOTHING: Aabb = Aabb { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

impl Boxed {
    fn unknown(body: u32, place: u32) -> Self {
        Self {
            body,
            place,
            room: 0.0,
            reach: 0.0,
            center: Vec3::ZERO,
            groups: CollisionGroups::default(),
            is_dynamic: false,
            is_still: true,
            is_single: false,
        }
    }

    /// Finds out about the body, and makes its box.
    fn enclose(&mut self, crew: &Crew, bodies: &[Body]) -> Aabb {
        let body = &bodies[self.body as usize];
        let Some(rigid) = body.rigid() else { return NOTHING };
        let (block, lane) = (self.place as usize / LANES, self.place as usize % LANES);
        let motion = rigid.traits.motion;
        let surface = rigid.shape.surface();
        self.center = column(&crew.blocks[block].center, lane);
        self.reach = rigid.shape.reach();
        self.room = crew.tracks[block].need.0[lane] * (1.0 + STEPS_AHEAD) + SKIN * self.reach;
        self.groups = rigid.traits.groups;
        self.is_dynamic = motion == Motion::Dynamic;
        self.is_still = motion == Motion::Fixed || (self.is_dynamic && !body.is_awake());
        self.is_single = surface.is_none() && rigid.shape.parts().len() == 1;
        let axes = axes_at(crew, self.place);
        let parts = rigid.shape.parts().iter().map(|part| (part.low, part.high));
        let boxes = parts.chain(surface.map(|surface| surface.bounds()));
        let bounds = boxes.fold(NOTHING, |sum, (low, high)| {
            let part = Aabb::around_turned(self.center, &axes, low, high);
            Aabb { low: sum.low.min(part.low), high: sum.high.max(part.high) }
        });
        let bounds = bounds.grown(self.room);
        Aabb { low: bounds.low.max(-FAR).min(FAR), high: bounds.high.max(-FAR).min(FAR) }
    }

    /// Whether the balls around both overlap, and nothing forbids them to collide.
    #[inline(always)]
    fn may_meet(&self, other: &Self, separated: &[[u32; 2]]) -> bool {
        let apart = self.reach + other.reach + self.room + other.room;
        // Not `<=`: what is not a number may be anywhere.
        let is_far = self.center.distance(other.center) > apart;
        !is_far
            && self.groups.collide_with(other.groups)
            && separated.binary_search(&[self.body.min(other.body), self.body.max(other.body)]).is_err()
    }

    /// Around one of its parts.
    fn box_of(&self, axes: &Mat3, part: &Part) -> Aabb {
        Aabb::around_turned(self.center, axes, part.low, part.high).grown(self.room)
    }
}

/// The axes of the body in a place.
fn axes_at(crew: &Crew, place: u32) -> Mat3 {
    columns(&crew.blocks[place as usize / LANES].axes, place as usize % LANES)
}

/// All pairs of parts, or of parts and triangles, whose boxes overlap.
fn pair_parts(
    crew: &Crew,
    (a, rigid_a): (&Boxed, &Rigid),
    (b, rigid_b): (&Boxed, &Rigid),
    keys: &mut Vec<Key>,
) {
    let (axes_a, axes_b) = (axes_at(crew, a.place), axes_at(crew, b.place));
    if let Some(surface) = rigid_b.shape.surface() {
        pair_with_triangles((a, &axes_a, rigid_a.shape.parts()), (b, &axes_b, surface), keys);
        return;
    }
    for (part_a, box_a) in (0..).zip(rigid_a.shape.parts()) {
        let box_a = a.box_of(&axes_a, box_a);
        for (part_b, box_b) in (0..).zip(rigid_b.shape.parts()) {
            if box_a.overlaps(&b.box_of(&axes_b, box_b)) {
                keys.push(Key { a: a.body, b: b.body, part_a, part_b });
            }
        }
    }
}

/// All triangles of a surface near the parts of a body.
fn pair_with_triangles(
    (a, axes_a, parts): (&Boxed, &Mat3, &[Part]),
    (b, axes_b, surface): (&Boxed, &Mat3, &Surface),
    keys: &mut Vec<Key>,
) {
    let mut triangles = Vec::new();
    let to_b = axes_b.transpose();
    let (center, axes) = (to_b * (a.center - b.center), to_b * *axes_a);
    for (part_a, part) in (0..).zip(parts) {
        let near = Aabb::around_turned(center, &axes, part.low, part.high).grown(a.room + b.room);
        triangles.clear();
        surface.triangles_in(near.low, near.high, &mut triangles);
        keys.extend(triangles.iter().map(|&part_b| Key { a: a.body, b: b.body, part_a, part_b }));
    }
}

fn reaches_over(bounds: &Aabb, wall: &HalfSpace) -> bool {
    let lowest = Vec3::select(wall.normal.cmpgt(Vec3::ZERO), bounds.low, bounds.high);
    wall.normal.dot(lowest) <= wall.offset
}
