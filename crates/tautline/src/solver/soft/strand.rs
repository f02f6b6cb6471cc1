//! Ropes against cloth, other ropes and themselves: segments with a radius.
//!
//! What may touch is listed every few small steps, with a margin for how far all may get until then. Which side of a
//! segment something is on is that of the small step's start, so that nothing gets through however fast.

use glam::{DVec3, Vec3};

use super::points::{PointSlices, Points};
use super::spin::Couples;
use super::tile::{Bounds, Tile};
use crate::norm::Norm;
use crate::order::PutInOrder;
use crate::simd::{Lanes, Vec3x8};

/// What is further apart than so many times as far as it is kept apart has not come through.
const FAR: f32 = 3.0;

/// A segment of a rope.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub(super) ends: [u32; 2],
    /// In m.
    pub(super) radius: f32,
    pub(super) friction: f32,
    /// The rope's number, and the segment's in it.
    pub(super) rope: u32,
    pub(super) number: u32,
    /// How many segments of the same rope are too near along it to touch it; `u32::MAX` = all.
    pub(super) exempt: u32,
    /// Whether a particle of the rope is held.
    pub(super) is_held: bool,
}

/// A cloth that ropes may touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheeting<'a> {
    /// The piece's number.
    pub(super) piece: u32,
    pub(super) tiles: &'a [Tile],
    pub(super) boxes: &'a [Bounds],
    /// In m.
    pub(super) thickness: f32,
    pub(super) friction: f32,
}

/// A particle of cloth near a segment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Brush {
    pub(super) place: u32,
    /// The ends of the segment.
    ends: [u32; 2],
    /// How far they are kept apart, in m.
    distance: f32,
    friction: f32,
    /// The number of both among the couples.
    couple: u32,
    /// The piece that leans on what is held when they touch; `u32::MAX` = none.
    leaning: u32,
}

/// Two segments near each other.
#[derive(Debug, Clone, Copy)]
struct Near {
    a: [u32; 2],
    b: [u32; 2],
    /// How far they are kept apart, in m.
    distance: f32,
    friction: f32,
    /// The number of their ropes among the couples.
    couple: u32,
}

/// All segments of awake ropes, and what they may touch.
#[derive(Debug, Clone, Default)]
pub(super) struct Strands {
    segments: Vec<Segment>,
    pub(super) brushes: Vec<Brush>,
    nears: Vec<Near>,
    /// The pairs of places, ascending, of which one holds the other: segments of nets, and attachments.
    links: Vec<[u32; 2]>,
}

impl Strands {
    pub(super) fn reset(&mut self) {
        self.segments.clear();
        self.brushes.clear();
        self.nears.clear();
    }

    pub(super) fn add(&mut self, segments: impl Iterator<Item = Segment>) {
        self.segments.extend(segments);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// Tells which places hold each other: what is at them does not touch.
    pub(super) fn link(&mut self, links: impl Iterator<Item = [u32; 2]>) {
        self.links.clear();
        self.links.extend(links.map(|[a, b]| [a.min(b), a.max(b)]));
        self.links.put_in_order();
    }

    /// Lists what may touch while nothing moves by more than `margin` (m).
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn look<'a, L: Lanes>(
        &mut self,
        points: &Points,
        sheets: impl Iterator<Item = Sheeting<'a>>,
        margin: f32,
        couples: &mut Couples,
    ) {
        self.brushes.clear();
        self.nears.clear();
        let boxes: Vec<Bounds> = self.segments.iter().map(|segment| bounds_of(segment, points)).collect();
        let all = boxes.iter().fold(Bounds::EMPTY, |all, bounds| all.with(*bounds));
        for sheet in sheets {
            for (tile, tile_box) in sheet.tiles.iter().zip(sheet.boxes) {
                let near = tile_box.grown(sheet.thickness + margin);
                if !near.meets(&all) {
                    continue;
                }
                for (segment, _) in self.segments.iter().zip(&boxes).filter(|(_, bounds)| near.meets(bounds))
                {
                    let out = (&mut self.brushes, &mut *couples);
                    list_particles::<L>(points, tile, segment, (&sheet, margin), out);
                }
            }
        }
        self.list_segments(&boxes, margin, couples);
        let links = &self.links;
        if !links.is_empty() {
            self.brushes.retain(|brush| !are_linked(links, [brush.place; 2], brush.ends));
            self.nears.retain(|near| !are_linked(links, near.a, near.b));
        }
    }

    /// Pairs of segments: swept along x.
    fn list_segments(&mut self, boxes: &[Bounds], margin: f32, couples: &mut Couples) {
        let mut order: Vec<usize> = (0..boxes.len()).collect();
        order.put_in_order_by(|&a, &b| boxes[a].low.x.total_cmp(&boxes[b].low.x).then(a.cmp(&b)));
        let mut pairs = Vec::new();
        for (rank, &first) in order.iter().enumerate() {
            let near = boxes[first].grown(margin);
            for &second in &order[rank + 1..] {
                if boxes[second].low.x > near.high.x {
                    break;
                }
                let (a, b) = (first.min(second), first.max(second));
                if near.meets(&boxes[second]) && may_touch(&self.segments[a], &self.segments[b]) {
                    pairs.push((a, b));
                }
            }
        }
        pairs.put_in_order();
        self.nears.extend(pairs.into_iter().map(|(a, b)| {
            let (a, b) = (&self.segments[a], &self.segments[b]);
            let friction = (a.friction * b.friction).sqrt();
            let distance = a.radius + b.radius;
            let couple = couples.number([a.rope, b.rope]);
            Near { a: a.ends, b: b.ends, distance, friction, couple }
        }));
    }

    /// Moves apart what is too close, with friction; what was too close before by `recovery` (m) at most. Calls `leans` with
    /// the pieces of cloth that lean on held ropes.
    pub(super) fn part(
        &self,
        points: &mut Points,
        recovery: f32,
        couples: &mut Couples,
        mut leans: impl FnMut(u32),
    ) {
        let mut points = points.slices();
        for brush in &self.brushes {
            if brush.part(&mut points, recovery, couples) && brush.leaning != u32::MAX {
                leans(brush.leaning);
            }
        }
        self.nears.iter().for_each(|near| near.part(&mut points, recovery, couples));
    }
}

fn bounds_of(segment: &Segment, points: &Points) -> Bounds {
    let [a, b] = segment.ends.map(|place| points.at(place as usize));
    Bounds { low: a.min(b), high: a.max(b) }.grown(segment.radius)
}

fn may_touch(a: &Segment, b: &Segment) -> bool {
    let shares_end = || a.ends.iter().any(|end| b.ends.contains(end));
    a.rope != b.rope || (b.number - a.number > a.exempt && !shares_end())
}

/// Whether an end of one is held by an end of the other.
fn are_linked(links: &[[u32; 2]], a: [u32; 2], b: [u32; 2]) -> bool {
    let is_link = |a: u32, b: u32| links.binary_search(&[a.min(b), a.max(b)]).is_ok();
    a.into_iter().any(|from| b.into_iter().any(|to| is_link(from, to)))
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn list_particles<L: Lanes>(
    points: &Points,
    tile: &Tile,
    segment: &Segment,
    (sheet, margin): (&Sheeting<'_>, f32),
    (out, couples): (&mut Vec<Brush>, &mut Couples),
) {
    let distance = sheet.thickness + segment.radius;
    let [start, end] = segment.ends.map(|place| points.at(place as usize));
    let along = end - start;
    for &first in &tile.eights {
        let from = points.eight_at::<L>(first as usize) - Vec3x8::splat(start);
        let share = from.dot(Vec3x8::splat(along)) / L::splat(along.length_squared().max(1e-30));
        let share = share.max(L::splat(0.0)).min(L::splat(1.0));
        let gap = from - Vec3x8::splat(along) * share;
        let reach = distance + margin;
        let is_near = L::splat(reach * reach).greater(gap.length_squared());
        let mut lanes = is_near.and(points.are_there::<L>(first as usize)).bits();
        if lanes == 0 {
            continue;
        }
        let couple = couples.number([sheet.piece, segment.rope]);
        let friction = (sheet.friction * segment.friction).sqrt();
        let leaning = if segment.is_held { sheet.piece } else { u32::MAX };
        while lanes != 0 {
            let place = first + lanes.trailing_zeros();
            lanes &= lanes - 1;
            out.push(Brush { place, ends: segment.ends, distance, friction, couple, leaning });
        }
    }
}

impl Brush {
    /// Of the particle and the nearest place of the segment, as they are: the gap that is missing along the line between
    /// them, and friction. Tells whether they touched.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn part(&self, points: &mut PointSlices<'_>, recovery: f32, couples: &mut Couples) -> bool {
        let (place, [start, end]) = (self.place as usize, [self.ends[0] as usize, self.ends[1] as usize]);
        let (from, to) = (points.at(start), points.at(end));
        let (at, along) = (points.at(place), to - from);
        let share = ((at - from).dot(along) / along.length_squared().max(1e-30)).clamp(0.0, 1.0);
        let gap = from + along * share - at;
        let (squared, reach) = (gap.length_squared(), self.distance * FAR);
        if squared >= reach * reach {
            return false;
        }
        let (moved, before) = (points.motion(start), points.motion(place));
        let slip = moved + (points.motion(end) - moved) * share - before;
        let mass = points.inverse_mass[place];
        let (at_start, at_end) =
            (points.inverse_mass[start] * (1.0 - share), points.inverse_mass[end] * share);
        let mobility = mass + at_start * (1.0 - share) + at_end * share;
        let law = (self.distance, self.friction, couples.turn(self.couple));
        let Some(Pushed { impulse, out, moment }) = push(gap, slip, law, mobility, recovery) else {
            return false;
        };
        for (place, share) in [(start, at_start), (end, at_end), (place, -mass)] {
            points.shift(place, impulse * share);
            points.carry(place, out * share);
        }
        couples.add(self.couple, moment);
        true
    }
}

impl Near {
    /// As [`Brush::part`], of the nearest places of two segments.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn part(&self, points: &mut PointSlices<'_>, recovery: f32, couples: &mut Couples) {
        let [a, b] = [self.a, self.b].map(|ends| ends.map(|place| place as usize));
        let (ends_a, ends_b) = (a.map(|place| points.at(place)), b.map(|place| points.at(place)));
        let [share_a, share_b] = nearest_shares(ends_a, ends_b);
        let weights = [[1.0 - share_a, share_a], [1.0 - share_b, share_b]];
        let mix = |ends: [Vec3; 2], weights: [f32; 2]| ends[0] * weights[0] + ends[1] * weights[1];
        let gap = mix(ends_b, weights[1]) - mix(ends_a, weights[0]);
        if gap.norm() >= FAR * self.distance {
            return;
        }
        let slip = mix(b.map(|place| points.motion(place)), weights[1])
            - mix(a.map(|place| points.motion(place)), weights[0]);
        let of = |[start, end]: [usize; 2], [at_start, at_end]: [f32; 2]| {
            [points.inverse_mass[start] * at_start, points.inverse_mass[end] * at_end]
        };
        let [shares_a, shares_b] = [of(a, weights[0]), of(b, weights[1])];
        let dot = |a: [f32; 2], b: [f32; 2]| a[0] * b[0] + a[1] * b[1];
        let mobility = dot(shares_a, weights[0]) + dot(shares_b, weights[1]);
        let law = (self.distance, self.friction, couples.turn(self.couple));
        let Some(Pushed { impulse, out, moment }) = push(gap, slip, law, mobility, recovery) else {
            return;
        };
        for (place, share) in b.into_iter().zip(shares_b).chain(a.into_iter().zip(shares_a.map(|w| -w))) {
            points.shift(place, impulse * share);
            points.carry(place, out * share);
        }
        couples.add(self.couple, moment);
    }
}

/// What two that are `gap` (m) apart and have moved by `slip` (m) against each other in this small step give each other.
struct Pushed {
    /// What the second gets per inverse mass that becomes velocity, …
    impulse: Vec3,
    /// … and what does not.
    out: Vec3,
    /// What that adds to angular momentum, in kg m² in a small step.
    moment: DVec3,
}

/// With friction by Coulomb's law on displacements, but for what turns with the whole by `turn` (rad). What has passed the
/// other is taken back to its side. Nothing if they do not touch. Along and across as `pair::part_pair`.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn push(
    gap: Vec3,
    slip: Vec3,
    (distance, friction, turn): (f32, f32, Vec3),
    mobility: f32,
    recovery: f32,
) -> Option<Pushed> {
    let before = gap - slip;
    let has_passed = gap.dot(before) < 0.0;
    if !has_passed && gap.length_squared() >= distance * distance || mobility <= 0.0 {
        return None;
    }
    let length = gap.norm();
    let (normal, apart) = if has_passed {
        (before.unit_or(Vec3::Y), -length)
    } else if gap.dot(before) > 0.5 * length * length.max(before.norm()) {
        (before.unit_or(Vec3::Y), length)
    } else {
        (gap.unit_or(Vec3::Y), length)
    };
    let depth = distance - apart;
    let across = slip - normal * slip.dot(normal);
    let rubbing = across - turn.cross(before);
    let grip = (friction * depth / rubbing.norm().max(1e-9)).min(1.0);
    // What is deeper than it moved in is moved out without velocity.
    let braked = depth.min((-slip.dot(normal)).max(0.0));
    let out = (depth - braked).min(recovery);
    let slowed = (across - rubbing * grip) * (out / (before.norm() + out).max(1e-9));
    let impulse = (normal * braked - rubbing * grip - slowed) / mobility;
    let out = normal * (out / mobility);
    let moment = before.cross(impulse) + out.cross(slip + impulse * mobility);
    Some(Pushed { impulse, out, moment: moment.as_dvec3() })
}

/// Where two segments are nearest to each other: shares from their starts (Ericson, Real-Time Collision Detection,
/// 5.1.9). One may be a point.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn nearest_shares(a: [Vec3; 2], b: [Vec3; 2]) -> [f32; 2] {
    let (along_a, along_b, between) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (aa, bb, ab) = (along_a.length_squared(), along_b.length_squared().max(1e-30), along_a.dot(along_b));
    let (from_a, from_b) = (along_a.dot(between), along_b.dot(between));
    if aa < 1e-20 {
        return [0.0, (from_b / bb).clamp(0.0, 1.0)];
    }
    let crossing = aa * bb - ab * ab;
    let share_a = if crossing > 1e-9 * aa * bb {
        ((ab * from_b - from_a * bb) / crossing).clamp(0.0, 1.0)
    } else {
        0.5
    };
    let share_b = (ab * share_a + from_b) / bb;
    if share_b < 0.0 {
        [(-from_a / aa).clamp(0.0, 1.0), 0.0]
    } else if share_b > 1.0 {
        [((ab - from_a) / aa).clamp(0.0, 1.0), 1.0]
    } else {
        [share_a, share_b]
    }
}

#[cfg(test)]
#[path = "tests/strand.rs"]
mod tests;
