//! Who may meet whom: boxes larger than the bodies, and the list of pairs made from them.

use glam::{Mat3, Vec3};

use super::RigidSolver;
use super::lineup::NOBODY;
use super::pairs::Key;
use crate::body::{Body, CollisionGroups, HalfSpace, Motion, Rigid, Substance};
use crate::collision::Aabb;
use crate::collision::bvh::overlapping_pairs;
use crate::settings::Settings;
use crate::shape::{Part, Surface};
use crate::simd::LANES;

/// By how much more than it needs a body's box is larger, as a share of its reach.
const SKIN: f32 = 0.08;
/// For how many more steps of the same motion a box is large enough.
const STEPS_AHEAD: f32 = 1.0;

/// As far as boxes reach, in m: what is about to leave the numbers there are has a box that is finite all the same.
const FAR: Vec3 = Vec3::splat(1e37);

/// A rigid body for the search.
struct Boxed {
    body: u32,
    room: f32,
    center: Vec3,
    axes: Mat3,
    bounds: Aabb,
}

impl RigidSolver {
    /// Makes boxes for all bodies where they are, and the list of pairs anew.
    pub(super) fn find_pairs(&mut self, bodies: &[Body], settings: &Settings) {
        let mut rooms = vec![f32::INFINITY; self.lineup.places.len()];
        let mut boxed = Vec::new();
        for (index, body) in bodies.iter().enumerate() {
            let Substance::Rigid(rigid) = &body.substance else { continue };
            let place = self.lineup.place_of[index];
            if place == NOBODY {
                continue;
            }
            let entry = self.enclose(index as u32, place as usize, rigid);
            if !is_still(body, rigid) {
                rooms[place as usize] = entry.room;
            }
            boxed.push(entry);
        }
        self.crew.set_boxes(&rooms);
        let mut keys = Vec::new();
        self.pair_up(bodies, &boxed, settings, &mut keys);
        pair_with_half_spaces(bodies, &boxed, &mut keys);
        keys.sort();
        self.pairs.replace(&keys, |key| {
            let surface = |body: u32| bodies[body as usize].surface;
            surface(key.a).against(&surface(key.b))
        });
    }

    /// The box of a body that lets it move as it does for a while.
    fn enclose(&self, body: u32, place: usize, rigid: &Rigid) -> Boxed {
        let (block, lane) = (&self.crew.blocks[place / LANES], place % LANES);
        let column =
            |rows: &super::block::Rows3| Vec3::new(rows[0].0[lane], rows[1].0[lane], rows[2].0[lane]);
        let (center, axes) = (column(&block.center), block.axes.each_ref().map(column));
        let axes = Mat3::from_cols(axes[0], axes[1], axes[2]);
        let need = self.crew.tracks[place / LANES].need.0[lane];
        let room = need * (1.0 + STEPS_AHEAD) + SKIN * rigid.shape.reach();
        let parts =
            rigid.shape.parts().iter().map(|part| Aabb::around_turned(center, &axes, part.low, part.high));
        let nothing = Aabb { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };
        let surface = rigid.shape.surface().map(|surface| surface.bounds());
        let surface = surface.map(|(low, high)| Aabb::around_turned(center, &axes, low, high));
        let bounds = parts
            .chain(surface)
            .fold(nothing, |sum, part| Aabb { low: sum.low.min(part.low), high: sum.high.max(part.high) });
        let bounds = bounds.grown(room);
        let bounds = Aabb { low: bounds.low.max(-FAR).min(FAR), high: bounds.high.max(-FAR).min(FAR) };
        Boxed { body, room, center, axes, bounds }
    }

    fn pair_up(&mut self, bodies: &[Body], boxed: &[Boxed], settings: &Settings, keys: &mut Vec<Key>) {
        let boxes: Vec<Aabb> = boxed.iter().map(|entry| entry.bounds).collect();
        let movable: Vec<bool> = boxed.iter().map(|entry| is_dynamic(&bodies[entry.body as usize])).collect();
        let mut found = Vec::new();
        overlapping_pairs(&boxes, &movable, settings.instructions, &mut self.search, &mut found);
        for (a, b) in found {
            let (a, b) = (&boxed[a as usize], &boxed[b as usize]);
            // Of the two the one that moves comes first.
            let (a, b) = if is_dynamic(&bodies[a.body as usize]) { (a, b) } else { (b, a) };
            let [Substance::Rigid(rigid_a), Substance::Rigid(rigid_b)] =
                [a, b].map(|entry| &bodies[entry.body as usize].substance)
            else {
                continue;
            };
            let pair = [a.body.min(b.body), a.body.max(b.body)];
            let is_separated = self.separated.binary_search(&pair).is_ok();
            if !is_separated && rigid_a.traits.groups.collide_with(rigid_b.traits.groups) {
                pair_parts((a, rigid_a), (b, rigid_b), keys);
            }
        }
    }
}

/// All pairs of parts, or of parts and triangles, whose boxes overlap.
fn pair_parts((a, rigid_a): (&Boxed, &Rigid), (b, rigid_b): (&Boxed, &Rigid), keys: &mut Vec<Key>) {
    let (parts_a, parts_b) = (rigid_a.shape.parts(), rigid_b.shape.parts());
    let (centers, reach) = (a.center.distance(b.center), rigid_a.shape.reach() + rigid_b.shape.reach());
    if centers > reach + a.room + b.room {
        return;
    }
    if let Some(surface) = rigid_b.shape.surface() {
        pair_with_triangles((a, parts_a), (b, surface), keys);
        return;
    }
    if parts_a.len() == 1 && parts_b.len() == 1 {
        keys.push(Key { a: a.body, b: b.body, part_a: 0, part_b: 0 });
        return;
    }
    for (part_a, box_a) in (0..).zip(parts_a) {
        let box_a = Aabb::around_turned(a.center, &a.axes, box_a.low, box_a.high).grown(a.room);
        for (part_b, box_b) in (0..).zip(parts_b) {
            let box_b = Aabb::around_turned(b.center, &b.axes, box_b.low, box_b.high).grown(b.room);
            if box_a.overlaps(&box_b) {
                keys.push(Key { a: a.body, b: b.body, part_a, part_b });
            }
        }
    }
}

/// All triangles of a surface near the parts of a body.
fn pair_with_triangles((a, parts): (&Boxed, &[Part]), (b, surface): (&Boxed, &Surface), keys: &mut Vec<Key>) {
    let mut triangles = Vec::new();
    let to_b = b.axes.transpose();
    let (center, axes) = (to_b * (a.center - b.center), to_b * a.axes);
    for (part_a, part) in (0..).zip(parts) {
        let near = Aabb::around_turned(center, &axes, part.low, part.high).grown(a.room + b.room);
        triangles.clear();
        surface.triangles_in(near.low, near.high, &mut triangles);
        keys.extend(triangles.iter().map(|&part_b| Key { a: a.body, b: b.body, part_a, part_b }));
    }
}

/// Every part that reaches over a plane.
fn pair_with_half_spaces(bodies: &[Body], boxed: &[Boxed], keys: &mut Vec<Key>) {
    let walls: Vec<(u32, &HalfSpace)> = (0..)
        .zip(bodies)
        .filter_map(|(index, body)| match &body.substance {
            Substance::HalfSpace(wall) => Some((index, wall)),
            _ => None,
        })
        .collect();
    for entry in boxed {
        let Substance::Rigid(rigid) = &bodies[entry.body as usize].substance else { continue };
        if rigid.traits.motion != Motion::Dynamic
            || !rigid.traits.groups.collide_with(CollisionGroups::default())
        {
            continue;
        }
        for &(wall_body, wall) in &walls {
            if !reaches_over(&entry.bounds, wall) {
                continue;
            }
            for (part_a, part) in (0..).zip(rigid.shape.parts()) {
                let bounds =
                    Aabb::around_turned(entry.center, &entry.axes, part.low, part.high).grown(entry.room);
                if reaches_over(&bounds, wall) {
                    keys.push(Key { a: entry.body, b: wall_body, part_a, part_b: 0 });
                }
            }
        }
    }
}

fn reaches_over(bounds: &Aabb, wall: &HalfSpace) -> bool {
    let lowest = Vec3::select(wall.normal.cmpgt(Vec3::ZERO), bounds.low, bounds.high);
    wall.normal.dot(lowest) <= wall.offset
}

fn is_dynamic(body: &Body) -> bool {
    matches!(&body.substance, Substance::Rigid(rigid) if rigid.traits.motion == Motion::Dynamic)
}

fn is_still(body: &Body, rigid: &Rigid) -> bool {
    rigid.traits.motion == Motion::Fixed || (rigid.traits.motion == Motion::Dynamic && !body.is_awake())
}
