//! Nothing goes through anything: when the substeps are over, the way that each fast body has come is looked at, and
//! where it led through another it ends at their first touch. (Where bodies are in haste, that is after every substep.)
//!
//! Contacts hold what meets in a step as far as they were foreseen when it began, and as far as one pass solves them.
//! At a hundred metres a second both can be wrong. So the core of a part, which is the part at four fifths of its
//! size, may not enter another part on the straight way from where the step began to where it ended; if it did,
//! both bodies stop where they first touched, with the velocities they have, and the next step finds them there.
//! What overlaps less than that is left to the contacts, and sliding, rolling and resting bodies never notice.
//!
//! The time lost is part of one step, and momentum is not touched. Only what was stopped so at once, at a place where it
//! had its contacts all the time, also loses its approach: those contacts cannot hold it, or it would hang there.

use glam::{DMat3, DQuat, DVec3, Vec3};

use super::RigidSolver;
use super::block::{Block, Rows3};
use super::lineup::NOBODY;
use super::pairs::{Detail, Pair};
use crate::geometry::manifold::Triangle;
use crate::geometry::query::{Motion, Rounded, Touch, first_touch};
use crate::shape::Convex;
use crate::simd::{Instructions, Kernel, LANES, Lanes, Vec3x8, run};

/// The sizes of cores, as shares of that of their part; the first counts until it is in another.
const CORES: [f32; 3] = [0.8, 0.4, 0.0];
/// What moves less than this share of its inner radius in a step goes through nothing …
const FAST: f32 = 0.5;
/// … and neither do bodies that move less than this against each other.
const FAST_TOGETHER: f64 = 0.75;
/// A core in another by less than this share of its inner radius, and this (m), touches it.
const TOUCHING: f32 = 0.1;
const ROUNDING: f32 = 1e-6;
/// Bodies that meet before this share of a way is over had their contact all the time.
const AT_ONCE: f64 = 0.1;
/// The angle that what was stopped so may turn by in a substep, in rad.
const MOST_TURN: f32 = 0.5;
/// How often ways are looked at again after some were cut short; the last time what still meets does not move.
const ROUNDS: usize = 8;

/// The way of a body in a step, straight and turning steadily.
#[derive(Debug, Clone, Copy)]
struct Way {
    center: DVec3,
    rotation: DQuat,
    shift: DVec3,
    /// Axis times angle.
    turn: DVec3,
    /// Whether it can be cut short.
    is_free: bool,
    is_cut: bool,
}

impl Way {
    fn of(block: &Block, lane: usize) -> Self {
        let column = |rows: &Rows3| Vec3::new(rows[0].0[lane], rows[1].0[lane], rows[2].0[lane]);
        let rotation = |axes: &[Rows3; 3]| {
            let [x, y, z] = axes.each_ref().map(|rows| column(rows).as_dvec3());
            DQuat::from_mat3(&DMat3::from_cols(x, y, z)).normalize()
        };
        let (start, end) = (rotation(&block.start_axes), rotation(&block.axes));
        let turn = end * start.inverse();
        // The shorter way round.
        let turn = if turn.w < 0.0 { -turn } else { turn };
        Self {
            center: column(&block.center).as_dvec3(),
            rotation: start,
            shift: column(&block.shift).as_dvec3(),
            turn: turn.to_scaled_axis(),
            is_free: block.constants.inverse_mass.0[lane] > 0.0,
            is_cut: false,
        }
    }

    fn is_finite(&self) -> bool {
        self.center.is_finite()
            && self.rotation.is_finite()
            && self.shift.is_finite()
            && self.turn.is_finite()
    }

    fn motion<'a>(&self, shape: Rounded<'a>) -> Motion<'a> {
        Motion {
            shape,
            position: self.center,
            rotation: self.rotation,
            linear: self.shift,
            angular: self.turn,
        }
    }

    /// How far a point of the body that is at `place` at `time` moves from then to the end.
    fn shift_from(&self, time: f64, place: DVec3) -> DVec3 {
        let arm = place - (self.center + self.shift * time);
        self.shift * (1.0 - time) + DQuat::from_scaled_axis(self.turn * (1.0 - time)) * arm - arm
    }

    fn without_turn(self) -> Self {
        if self.is_free { Self { turn: DVec3::ZERO, ..self } } else { self }
    }

    /// Ended at `time`, and carried along by the other if that moves on.
    fn cut(mut self, time: f64, other: &Self) -> Self {
        if self.is_free {
            let place = self.center + self.shift * time;
            let carried = if other.is_free { DVec3::ZERO } else { other.shift_from(time, place) };
            self.shift = place + carried - self.center;
            self.turn *= time;
            self.is_cut = true;
        }
        self
    }

    /// Puts a body at its end.
    fn write(&self, block: &mut Block, lane: usize) {
        let set = |rows: &mut Rows3, value: Vec3| {
            rows.iter_mut().zip(value.to_array()).for_each(|(row, number)| row.0[lane] = number);
        };
        set(&mut block.shift, self.shift.as_vec3());
        let axes = DMat3::from_quat(DQuat::from_scaled_axis(self.turn) * self.rotation);
        for (rows, axis) in block.axes.iter_mut().zip([axes.x_axis, axes.y_axis, axes.z_axis]) {
            set(rows, axis.as_vec3());
        }
    }
}

/// Which of eight bodies are fast: a mask by lanes.
struct Fast<'a>(&'a Block);

impl Kernel for Fast<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<L: Lanes>(self) -> u32 {
        let constants = &self.0.constants;
        let mut turn = L::splat(0.0);
        for (now, before) in self.0.axes.iter().zip(&self.0.start_axes) {
            turn = turn + (Vec3x8::<L>::load(now) - Vec3x8::load(before)).length_squared();
        }
        // How far one of its points has moved at most: √(|Δc|² + r² Σ|Δeₖ|²/2).
        let reach = L::load(&constants.reach);
        let shift = Vec3x8::<L>::load(&self.0.shift).length_squared();
        let limit = L::load(&constants.inner_radius) * L::splat(FAST);
        (shift + reach * reach * L::splat(0.5) * turn).greater(limit * limit).bits()
    }
}

/// Two bodies that were stopped as soon as they moved: their contact did not hold them.
struct Blocked {
    places: [usize; 2],
    /// Unit, from the first to the second.
    normal: Vec3,
}

/// A pair of parts of which one is fast.
struct Candidate<'a> {
    /// Where their bodies move.
    places: [usize; 2],
    a: &'a Convex,
    b: Other<'a>,
    /// From the centre of either body, how far its parts reach, in m; of a triangle the ball around it.
    balls: [(Vec3, f32); 2],
    /// The smaller one of those that are solid, in m.
    inner_radius: f32,
    /// How far the corners of either body stand out over its inner radius, in m.
    corners: [f32; 2],
}

enum Other<'a> {
    Part(&'a Convex),
    Triangle(Triangle),
}

impl RigidSolver {
    /// Ends the ways of fast bodies where they would lead through others.
    pub(super) fn sweep(&mut self, instructions: Instructions) {
        let blocks = self.crew.blocks[..self.lineup.solved / LANES].iter();
        let fast: Vec<u32> = blocks.map(|block| run(instructions, Fast(block))).collect();
        if fast.iter().all(|&lanes| lanes == 0) {
            return;
        }
        let candidates = self.candidates(&fast);
        // What joints hold together would be torn apart: it is not cut short.
        let mut ways: Vec<Option<Way>> = vec![None; self.lineup.places.len()];
        for place in candidates.iter().flat_map(|candidate| candidate.places) {
            ways[place].get_or_insert_with(|| {
                let way = Way::of(&self.crew.blocks[place / LANES], place % LANES);
                Way { is_free: way.is_free && !self.is_held(place), ..way }
            });
        }
        let blocked = cut_short(&candidates, &mut ways);
        for (place, way) in ways.iter().enumerate() {
            if let Some(way) = way.filter(|way| way.is_cut) {
                way.write(&mut self.crew.blocks[place / LANES], place % LANES);
            }
        }
        blocked.into_iter().for_each(|blocked| self.stop(&blocked));
    }

    /// Takes the approach of two bodies to each other out of their velocities, as far as it is not rotation: a blow
    /// against their centres, without restitution. And slows their rotation to what a substep can follow.
    fn stop(&mut self, blocked: &Blocked) {
        let row = |place: usize| &self.crew.velocities[place].0;
        let [a, b] = blocked.places.map(row);
        let linear = |row: &[f32; LANES]| Vec3::new(row[0], row[1], row[2]);
        let approach = (linear(a) - linear(b)).dot(blocked.normal).max(0.0);
        let weights = [a[3], b[3]];
        for (i, sign) in [(0, -1.0), (1, 1.0)] {
            let place = blocked.places[i];
            let root = self.crew.blocks[place / LANES].constants.root_inertia.each_ref();
            let root = root.map(|row| row.0[place % LANES]);
            let row = &mut self.crew.velocities[place].0;
            if weights[i] <= 0.0 {
                continue;
            }
            let change = blocked.normal * (sign * approach * weights[i] / (weights[0] + weights[1]));
            row.iter_mut().zip(change.to_array()).for_each(|(number, change)| *number += change);
            let turn = Vec3::new(row[4] / root[0], row[5] / root[1], row[6] / root[2]).length();
            let kept = (MOST_TURN / turn.max(MOST_TURN)).min(1.0);
            row[4..7].iter_mut().for_each(|number| *number *= kept);
        }
    }

    /// The pairs of which one body is fast, as masks of lanes say.
    fn candidates(&self, fast: &[u32]) -> Vec<Candidate<'_>> {
        let is_fast = |place: u32| {
            fast.get(place as usize / LANES).is_some_and(|lanes| lanes >> (place as usize % LANES) & 1 == 1)
        };
        let candidate = |(pair, detail): (&Pair, &Detail)| {
            let place = |body: u32| self.lineup.place_of.get(body as usize).copied();
            let places = [place(pair.a)?, place(pair.b).filter(|&place| place != NOBODY)?];
            let moving = places.map(|place| self.lineup.moving_place(place));
            if !moving.into_iter().any(is_fast) {
                return None;
            }
            let [Some(shape_a), Some(shape_b)] =
                places.map(|place| self.crew.shapes[place as usize].as_ref())
            else {
                return None;
            };
            let a = &shape_a.parts().get(detail.part_a as usize)?.convex;
            let b = match shape_b.surface() {
                Some(surface) => Other::Triangle(surface.triangle(detail.part_b)),
                None => Other::Part(&shape_b.parts().get(detail.part_b as usize)?.convex),
            };
            let balls = [(Vec3::ZERO, shape_a.reach()), b.ball(shape_b.reach())];
            let solid = [shape_a, shape_b].into_iter().filter(|shape| shape.is_solid());
            let inner_radius = solid.map(|shape| shape.inner_radius()).fold(f32::INFINITY, f32::min);
            let corners = [shape_a, shape_b].map(|shape| shape.reach() - shape.inner_radius());
            Some(Candidate { places: moving.map(|place| place as usize), a, b, balls, inner_radius, corners })
        };
        self.pairs.pairs.iter().zip(&self.pairs.details).filter_map(candidate).collect()
    }
}

/// Cuts ways short until nothing meets on them. Returns who hardly moved for it.
fn cut_short(candidates: &[Candidate<'_>], ways: &mut [Option<Way>]) -> Vec<Blocked> {
    let mut blocked = Vec::new();
    for round in 0..ROUNDS {
        let mut has_met = false;
        for candidate in candidates {
            let [Some(a), Some(b)] = candidate.places.map(|place| ways[place]) else { continue };
            let is_known = round > 0 && !a.is_cut && !b.is_cut;
            if is_known || !(a.is_finite() && b.is_finite()) {
                continue;
            }
            let Some(touch) = candidate.first_touch(&a, &b) else { continue };
            let [place_a, place_b] = candidate.places;
            let (mut a, mut b, mut time) = (a, b, touch.time);
            if round == 0 && time < AT_ONCE {
                blocked.push(Blocked { places: candidate.places, normal: touch.at.normal.as_vec3() });
                // What cannot turn may still go, and be pushed out.
                (a, b) = (a.without_turn(), b.without_turn());
                time = candidate.first_touch(&a, &b).map_or(1.0, |touch| touch.time);
            }
            let time = if round + 1 == ROUNDS { 0.0 } else { time };
            (ways[place_a], ways[place_b]) = (Some(a.cut(time, &b)), Some(b.cut(time, &a)));
            has_met = true;
        }
        if !has_met {
            break;
        }
    }
    blocked
}

impl Other<'_> {
    fn ball(&self, reach: f32) -> (Vec3, f32) {
        match self {
            Self::Part(_) => (Vec3::ZERO, reach),
            Self::Triangle(triangle) => {
                let center = mean(&triangle.corners);
                (center, triangle.corners.iter().map(|p| p.distance(center)).fold(0.0, f32::max))
            }
        }
    }

    fn rounded(&self) -> Rounded<'_> {
        match self {
            Self::Part(part) => Rounded::of(part),
            Self::Triangle(triangle) => Rounded { corners: &triangle.corners, radius: 0.0 },
        }
    }

    fn size(&self) -> f32 {
        match self {
            Self::Part(part) => part.size,
            Self::Triangle(_) => f32::INFINITY,
        }
    }
}

impl Candidate<'_> {
    /// When the core of the smaller part enters the other; or rather when the parts first touch before that.
    fn first_touch(&self, a: &Way, b: &Way) -> Option<Touch> {
        if self.is_slow(a, b) || self.is_wide_of(a, b) || self.begins_behind(a, b) {
            return None;
        }
        // What has its core in another already may still not get a smaller one there.
        for share in CORES {
            let mut corners = Vec::new();
            let [core_a, core_b] = self.shapes(share, &mut corners);
            let touch = |target: f64| first_touch(&a.motion(core_a), &b.motion(core_b), target);
            let found = touch(0.0)?;
            if found.time > 0.0 {
                let [whole_a, whole_b] = self.shapes(1.0, &mut corners);
                let whole = first_touch(&a.motion(whole_a), &b.motion(whole_b), 0.0);
                return whole.filter(|whole| whole.time > 0.0).or(Some(found));
            }
            // It was stopped here before; it may come half as near to being in it.
            let deep = f64::from(TOUCHING * self.inner_radius + ROUNDING);
            if found.at.gap > -deep {
                return touch(0.5 * (found.at.gap - deep));
            }
        }
        None
    }

    /// Both parts, the smaller one drawn towards the mean of its corners.
    fn shapes<'c>(&'c self, share: f32, corners: &'c mut Vec<Vec3>) -> [Rounded<'c>; 2] {
        let (whole_a, whole_b) = (Rounded::of(self.a), self.b.rounded());
        let is_a_smaller = self.a.size <= self.b.size();
        let whole = if is_a_smaller { whole_a } else { whole_b };
        let middle = mean(whole.corners);
        corners.clear();
        corners.extend(whole.corners.iter().map(|corner| middle + (*corner - middle) * share));
        let core = Rounded { corners, radius: whole.radius * share };
        if is_a_smaller { [core, whole_b] } else { [whole_a, core] }
    }

    /// Whether they hardly move against each other, for their size. What turns is as large as it was but for its corners.
    fn is_slow(&self, a: &Way, b: &Way) -> bool {
        let [stir_a, stir_b] =
            [(a, 0), (b, 1)].map(|(way, i)| way.turn.length() * f64::from(self.corners[i]));
        let least = f64::from(self.inner_radius);
        (a.shift - b.shift).length() + stir_a + stir_b < FAST_TOGETHER * least
    }

    /// Whether balls around both pass each other.
    fn is_wide_of(&self, a: &Way, b: &Way) -> bool {
        let [(at_a, reach_a), (at_b, reach_b)] = self.balls;
        let [place_a, place_b] =
            [(a, at_a), (b, at_b)].map(|(way, at)| way.center + way.rotation * at.as_dvec3());
        // A point of a body that turns leaves its straight way.
        let stray = f64::from(at_b.length()) * b.turn.length();
        let (between, closing) = (place_b - place_a, a.shift - b.shift);
        let time = (between.dot(closing) / closing.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (between - closing * time).length() > f64::from(reach_a) + f64::from(reach_b) + stray
    }

    /// Whether the middle of a starts behind the triangle: triangles stop what comes from the front.
    fn begins_behind(&self, a: &Way, b: &Way) -> bool {
        let Other::Triangle(triangle) = &self.b else { return false };
        let middle = a.center + a.rotation * mean(&self.a.vertices).as_dvec3();
        let in_b = b.rotation.inverse() * (middle - b.center);
        (in_b - triangle.corners[0].as_dvec3()).dot(triangle.normal.as_dvec3()) <= 0.0
    }
}

fn mean(corners: &[Vec3]) -> Vec3 {
    corners.iter().sum::<Vec3>() / corners.len().max(1) as f32
}
