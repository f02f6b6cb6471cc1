//! From poses to contacts: the narrow phase over the list of pairs.
//!
//! A body's version rises when it has moved more than a quarter of a millimetre; a pair whose versions are the same
//! keeps its contact, and the solver finds its distances from the anchors. Else the balls around both bodies are
//! looked at, which ends more than half of the pairs that moved; then the axis remembered of the pair is tried, and
//! only then the distance is searched for.

use std::sync::Arc;

use glam::{Mat3, Vec2, Vec3};

use super::held::{Held, HeldPoint};
use super::pairs::{Detail, Pair};
use super::tangents::Tangents;
use crate::body::{Body, HalfSpace, Substance};
use crate::geometry::manifold::{
    Former, MAX_POINTS, Manifold, Memory, Placement, Scratch, collide, collide_plane, collide_triangle,
};
use crate::geometry::query::Rounded;
use crate::norm::Norm;
use crate::shape::{Convex, Shape, Surface};
use crate::simd::{Kernel, Lanes, Row};

/// What the narrow phase reads.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub(super) bodies: &'a [Body],
    pub(super) versions: &'a [u32],
    pub(super) place_of: &'a [u32],
    /// Of places that are solved for, which of what joints hold their body is in.
    pub(super) assembly_of: &'a [u32],
    /// One for each place.
    pub(super) shapes: &'a [Option<Arc<Shape>>],
    /// Two for each place, see `prepare`.
    pub(super) poses: &'a [Row],
    /// One for each place: motion in a substep.
    pub(super) velocities: &'a [Row],
    pub(super) substeps: f32,
    /// Whether any bodies may approach each other in the step by more than some inner radius.
    pub(super) has_fast: bool,
    /// How far apart contacts are kept at least, in m.
    pub(super) margin: f32,
    /// How far gravity lets what is free fall in the step, in m.
    pub(super) fall: Vec3,
}

/// Points further apart than this no longer hold on to each other, in m.
const LETS_GO: f32 = 1e-3;
/// A contact goes on as the last one did while its normal turns by less than 26° between them (cosine): what pressed
/// along another would throw the bodies about.
const SAME_WAY: f32 = 0.9;
/// How near a point is to an older one to go on as it did, as a share of the size of the body, squared.
const SAME_PLACE_SQUARED: f32 = 0.02;
/// By how much the speed that bodies approach each other at counts for how far ahead contacts are found.
const LOOK_AHEAD: f32 = 1.5;
/// What share of their motion counts as approach whatever its direction.
const SIDEWAYS: f32 = 0.1;

/// A body's place in the world.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    pub(super) center: Vec3,
    pub(super) axes: Mat3,
    /// Motion in a whole step, in m.
    pub(super) motion: Vec3,
    /// How far its rotation moves its points in a whole step, in m.
    turning: f32,
    reach: f32,
}

impl Placed {
    /// At rest at the origin.
    const WORLD: Self =
        Self { center: Vec3::ZERO, axes: Mat3::IDENTITY, motion: Vec3::ZERO, turning: 0.0, reach: 0.0 };
}

impl<'a> Scene<'a> {
    /// The shape of a body, if it is a rigid one.
    #[inline(always)]
    pub(super) fn shape(&self, body: u32) -> Option<&'a Shape> {
        self.shapes.get(self.place_of[body as usize] as usize)?.as_deref()
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn placed(&self, body: u32) -> Placed {
        let place = self.place_of[body as usize] as usize;
        let (first, second) = (&self.poses[2 * place].0, &self.poses[2 * place + 1].0);
        let (e0, e1) =
            (Vec3::new(second[0], second[1], second[2]), Vec3::new(second[3], second[4], second[5]));
        let velocity = &self.velocities[place].0;
        Placed {
            center: Vec3::new(first[0], first[1], first[2]),
            axes: Mat3::from_cols(e0, e1, e0.cross(e1)),
            motion: Vec3::new(velocity[0], velocity[1], velocity[2]) * self.substeps,
            turning: second[6],
            reach: second[7],
        }
    }

    /// How far the points of a body move in a whole step at most, in m.
    pub(super) fn motion(&self, body: u32) -> f32 {
        let placed = self.placed(body);
        placed.motion.norm() + placed.turning
    }

    /// Whether the balls around two bodies are further apart than contacts are looked for.
    #[inline(always)]
    fn are_apart(&self, a: &Placed, b: &Placed) -> bool {
        let (between, approach) = (b.center - a.center, a.motion - b.motion);
        let distance = between.norm();
        let closing = (between.dot(approach) / distance).max(0.0) + SIDEWAYS * approach.norm();
        let margin = self.margin + 0.5 * (a.turning + b.turning) + LOOK_AHEAD * closing;
        distance > a.reach + b.reach + margin
    }

    #[inline(always)]
    fn stamp(&self, pair: &Pair) -> u32 {
        self.versions[pair.a as usize].wrapping_add(self.versions[pair.b as usize])
    }
}

/// Brings the contacts of a run of pairs up to date.
pub(super) struct Detect<'a> {
    pub(super) scene: Scene<'a>,
    pub(super) pairs: &'a mut [Pair],
    pub(super) details: &'a mut [Detail],
    pub(super) scratch: &'a mut Scratch,
}

impl Kernel for Detect<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { scene, pairs, details, scratch } = self;
        for (pair, detail) in pairs.iter_mut().zip(details) {
            let stamp = scene.stamp(pair);
            if stamp != pair.stamp {
                pair.stamp = stamp;
                update::<L>(scene, pair, detail, scratch);
            }
        }
    }
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn update<L: Lanes>(scene: Scene<'_>, pair: &mut Pair, detail: &mut Detail, scratch: &mut Scratch) {
    let a = scene.placed(pair.a);
    scratch.former = detail.held.as_ref().map_or_else(Former::default, |held| Former::new(held.keys()));
    let (manifold, b) = match scene.shape(pair.b) {
        Some(shape) => {
            let b = scene.placed(pair.b);
            if scene.are_apart(&a, &b) {
                // What is remembered would be of another approach: the margin of a fast one has to be its own.
                if pair.points > 0 || detail.memory.axis != Vec3::ZERO {
                    detail.memory = Memory::default();
                    (pair.points, detail.held) = (0, None);
                }
                return;
            }
            let Some(part_a) = part(scene, pair.a, detail.part_a) else { return };
            let manifold = match shape.surface() {
                Some(surface) => {
                    collide_with_triangle::<L>(scene, (part_a, surface), (&a, &b), (pair, detail), scratch)
                }
                None => {
                    let Some(part_b) = part(scene, pair.b, detail.part_b) else { return };
                    collide_parts::<L>(scene, (part_a, part_b), (&a, &b), (pair, detail), scratch)
                }
            };
            (manifold, b)
        }
        None => {
            let Substance::HalfSpace(wall) = &scene.bodies[pair.b as usize].substance else { return };
            let Some(part_a) = part(scene, pair.a, detail.part_a) else { return };
            (collide_with_wall::<L>(scene, part_a, &a, wall, scratch), Placed::WORLD)
        }
    };
    if manifold.count > 0 {
        hold(scene, &manifold, (&a, &b), pair, detail);
    } else if pair.points > 0 {
        detail.held = None;
    }
    pair.points = manifold.count as u32;
}

#[inline(always)]
fn part<'a>(scene: Scene<'a>, body: u32, part: u32) -> Option<&'a Convex> {
    scene.shape(body)?.parts().get(part as usize).map(|part| &part.convex)
}

/// The points on the wall are in the world's frame.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn collide_with_wall<L: Lanes>(
    scene: Scene<'_>,
    part: &Convex,
    a: &Placed,
    wall: &HalfSpace,
    scratch: &mut Scratch,
) -> Manifold {
    let offset = wall.offset - wall.normal.dot(a.center);
    let closing = -wall.normal.dot(a.motion);
    let margin = scene.margin + LOOK_AHEAD * closing.max(0.0) + 0.5 * a.turning;
    if -offset - a.reach > margin {
        return Manifold::default();
    }
    let mut manifold = collide_plane::<L>(part, a.axes.transpose() * wall.normal, offset, scratch, margin);
    for point in &mut manifold.points {
        point.on_b = a.center + a.axes * point.on_b;
    }
    manifold
}

/// Where the frame of b is in that of a, how a approaches b in a step (m, in a's frame), and how far ahead their
/// contacts are looked for because they turn (m).
#[inline(always)]
fn relative(scene: Scene<'_>, a: &Placed, b: &Placed) -> (Placement, Vec3, f32) {
    let to_a = a.axes.transpose();
    let b_in_a = Placement { rotation: to_a * b.axes, translation: to_a * (b.center - a.center) };
    (b_in_a, to_a * (a.motion - b.motion), scene.margin + 0.5 * (a.turning + b.turning))
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn collide_with_triangle<L: Lanes>(
    scene: Scene<'_>,
    (part, surface): (&Convex, &Surface),
    (a, b): (&Placed, &Placed),
    (pair, detail): (&Pair, &mut Detail),
    scratch: &mut Scratch,
) -> Manifold {
    let (mut b_in_a, approach, base) = relative(scene, a, b);
    let triangle = surface.triangle(detail.part_b);
    let closing = -(b_in_a.rotation * triangle.normal).dot(approach);
    let margin = base + LOOK_AHEAD * (closing.max(0.0) + SIDEWAYS * approach.norm());
    let mut is_foreseen = false;
    loop {
        let memory = &mut detail.memory;
        let manifold = collide_triangle::<L>(part, &triangle, &b_in_a, (memory, scratch), margin);
        if is_foreseen || !scene.is_far_off(&manifold, approach, pair) {
            return manifold;
        }
        let shapes = [Rounded::of(part), Rounded { corners: &triangle.corners, radius: 0.0 }];
        match scene.at_first_touch([pair.a, pair.b], [a, b], shapes) {
            Some(there) => b_in_a = there,
            None => return Manifold::default(),
        }
        is_foreseen = true;
    }
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn collide_parts<L: Lanes>(
    scene: Scene<'_>,
    (part_a, part_b): (&Convex, &Convex),
    (a, b): (&Placed, &Placed),
    (pair, detail): (&Pair, &mut Detail),
    scratch: &mut Scratch,
) -> Manifold {
    let (mut b_in_a, approach, base) = relative(scene, a, b);
    let axis = detail.memory.axis;
    let closing = if axis == Vec3::ZERO {
        approach.norm()
    } else {
        axis.dot(approach).max(0.0) + SIDEWAYS * approach.norm()
    };
    let margin = base + LOOK_AHEAD * closing;
    let mut is_foreseen = false;
    loop {
        let memory = &mut detail.memory;
        let manifold = collide::<L>(part_a, part_b, &b_in_a, (memory, scratch), margin);
        if is_foreseen || !scene.is_far_off(&manifold, approach, pair) {
            return manifold;
        }
        let shapes = [Rounded::of(part_a), Rounded::of(part_b)];
        match scene.at_first_touch([pair.a, pair.b], [a, b], shapes) {
            Some(there) => b_in_a = there,
            None => return Manifold::default(),
        }
        is_foreseen = true;
    }
}

/// Keeps a contact, which goes on as the pair's last one did.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn hold(scene: Scene<'_>, manifold: &Manifold, (a, b): (&Placed, &Placed), pair: &Pair, detail: &mut Detail) {
    let normal = a.axes * manifold.normal;
    let mut points = [HeldPoint::default(); MAX_POINTS];
    for (point, found) in points.iter_mut().zip(&manifold.points[..manifold.count]) {
        *point = HeldPoint::new(found.on_a, found.on_b, found.key);
    }
    let points = &mut points[..manifold.count];
    let Some(old) = &mut detail.held else {
        let [surface_a, surface_b] = [pair.a, pair.b].map(|body| scene.bodies[body as usize].surface);
        detail.held = Some(Held::new(normal, surface_a.against(&surface_b), points));
        return;
    };
    let (old_normal, old_tangents, tangents) = (old.normal(), old.tangents(), Tangents::new(normal));
    let is_same_way = normal.dot(old_normal) > SAME_WAY;
    for point in points.iter_mut().filter(|_| is_same_way) {
        let Some(before) = predecessor(old, point.key(), point.on_a(), a.reach) else { continue };
        let distance = (b.center + b.axes * before.on_b()) - (a.center + a.axes * before.on_a());
        let sticks = before.normal_impulse() > 0.0 && distance.dot(old_normal) < LETS_GO;
        let drift = distance + old_tangents.vector(before.slip());
        let slip = if sticks { tangents.along(drift) } else { Vec2::ZERO };
        let pull = tangents.along(old_tangents.vector(before.tangent_impulse()));
        point.continue_from(before.normal_impulse(), pull, slip);
    }
    old.replace(normal, old.touch(), points);
}

/// The point of the last contact that a new one goes on from: of the same features, or else the nearest.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn predecessor(old: &Held, key: u32, on_a: Vec3, reach: f32) -> Option<HeldPoint> {
    let mut nearest = SAME_PLACE_SQUARED * reach * reach;
    let mut found = None;
    for point in old.points() {
        if point.key() == key {
            return Some(point);
        }
        let distance = point.on_a().distance_squared(on_a);
        if distance < nearest {
            nearest = distance;
            found = Some(point);
        }
    }
    found
}
