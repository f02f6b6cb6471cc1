//! Cloth against itself and other cloth: pairs of particles kept apart.
//!
//! Particles closer than about the length of an edge push each other apart, so that nothing gets between two of them. The
//! pairs are listed by pairs of tiles, each with its own margin: a list is made anew only when its two tiles have moved
//! against each other by more than that. Tiles beside each other that face one way have none.
//!
//! Particles that are neighbours in the material do not push each other, but for those across the fold of a cell: it may
//! be folded along its diagonal, but not so sharply that its halves get through each other.
//!
//! Every list is in the order of its particles, and the lists in that of their tiles, so that which pairs are near decides
//! what happens, and not when lists were made.

use super::grid::Grid;
use super::pair::{Parting, part_pair};
use super::patch::{Cone, cone_of};
use super::points::{Coordinates, Points, get, set};
use super::spin::Couples;
use super::tile::{Around, Bounds, MOST_EIGHTS, Tile, inside};
use crate::constraint::Stick;
use crate::norm::Norm;
use crate::order::PutInOrder;
use crate::simd::{LANES, Lanes, Numbers, Vec3x8};
use glam::DVec3;

/// Tiles that bend less than this (75°) together do not touch each other. Its cosine.
const SMOOTH: f32 = 0.258_819_05;
/// How far beyond the thickness pairs are listed, in thicknesses.
const MARGIN: f32 = 0.25;
/// How far beyond the thickness, in thicknesses, pairs may be that the others of a pass push into each other.
const PUSH: f32 = 0.1;
/// What was too close is moved apart at this share of the speed at which other things are: sticks turn what they are
/// lengthened by into motion, and cloth that crumples would gain energy.
const GENTLY: f32 = 0.1;
/// To what share of its length the diagonal of a cell that no stick holds may be folded: by 106°. Less, and folds beside each
/// other cross; more, and what is whipped about does.
const SHARPEST: f32 = 0.6;
/// Motion until the next look is expected to be as fast as that since the last, times this.
const HASTE: f32 = 1.5;

/// A cloth among others.
#[derive(Debug, Clone)]
pub(super) struct Member {
    /// The piece's number.
    pub(super) piece: u32,
    pub(super) meets_itself: bool,
    /// How far its particles are kept apart, in m.
    pub(super) distance: f32,
    pub(super) exempt: Exempt,
    /// What share of their motion against each other its particles lose in a small step when they touch.
    pub(super) friction: f32,
}

/// Which particles of a cloth do not push each other, being neighbours.
#[derive(Debug, Clone)]
pub(super) enum Exempt {
    /// Those no further apart than `reach` in the material, in m: of sheets, whose `material` is known and whose cells
    /// have diagonals of such a length, in m.
    Within { reach: f32, diagonal: f32 },
    /// For each particle, by place from the first on, those of higher place, ascending.
    Listed(usize, Vec<Vec<u32>>),
}

impl Exempt {
    /// Of a sheet whose particles are kept apart by `distance` (m) and whose cells have such edges (m).
    pub(super) fn of_sheet(distance: f32, [along, down]: [f32; 2]) -> Self {
        let diagonal = (along * along + down * down).sqrt() * 1.001;
        Self::Within { reach: diagonal.max(distance * 1.001), diagonal }
    }

    /// Of particles at places from `start` on, with sticks between them: those no further than `distance` (m) along
    /// sticks.
    pub(super) fn along(sticks: &[Stick], count: usize, start: usize, distance: f32) -> Self {
        let mut neighbours: Vec<Vec<(u32, f32)>> = vec![Vec::new(); count];
        for stick in sticks {
            neighbours[stick.a as usize].push((stick.b, stick.rest_length));
            neighbours[stick.b as usize].push((stick.a, stick.rest_length));
        }
        let near = |from: u32| {
            let mut found: Vec<(u32, f32)> = vec![(from, 0.0)];
            let mut next = 0;
            while let Some(&(particle, so_far)) = found.get(next) {
                next += 1;
                for &(neighbour, length) in &neighbours[particle as usize] {
                    let is_new = found.iter().all(|(other, _)| *other != neighbour);
                    if is_new && (so_far + length <= distance || so_far == 0.0) {
                        found.push((neighbour, so_far + length));
                    }
                }
            }
            let later = found.into_iter().filter(|(particle, _)| *particle > from);
            let mut places: Vec<u32> = later.map(|(particle, _)| particle + start as u32).collect();
            places.sort_unstable();
            places
        };
        Self::Listed(start, (0..count as u32).map(near).collect())
    }
}

/// All cloth that may meet.
#[derive(Debug, Clone, Default)]
pub(super) struct Meetings {
    members: Vec<Member>,
    tiles: Vec<Tile>,
    /// By tile, the member it belongs to.
    member_of: Vec<u32>,
    /// Where particles are in the material, in m, by place.
    pub(super) material: Coordinates,
    boxes: Vec<Bounds>,
    /// The sides of the boxes, coordinate by coordinate: as many as make whole eights.
    lows: Coordinates,
    highs: Coordinates,
    cones: Vec<Cone>,
    /// How tiles have moved since the last look: bounds of what their particles did.
    motions: Vec<Bounds>,
    /// Positions at the last look, which is now while there is one.
    base: Coordinates,
    lists: Vec<List>,
    spare: Vec<List>,
    /// The pairs of places, ascending, that are attached to each other.
    links: Vec<[u32; 2]>,
}

/// Eight particles from a place on.
#[derive(Clone, Copy)]
struct Eight<L> {
    place: usize,
    at: Vec3x8<L>,
}

/// The pairs of two tiles.
#[derive(Debug, Clone, Default)]
struct List {
    tiles: [u32; 2],
    /// The number of their pieces among the couples, if they have pairs that are near.
    couple: u32,
    /// How far they have moved against each other since it was made, in m.
    moved: f32,
    distance: f32,
    friction: f32,
    pairs: Pairs,
    /// How far corners of a cell are kept apart across its fold, in m.
    fold: f32,
    folds: Pairs,
}

/// Pairs that are kept apart in one way.
#[derive(Debug, Clone, Default)]
struct Pairs {
    all: Vec<[u32; 2]>,
    /// Those of them that may come too close until the next look.
    near: Vec<[u32; 2]>,
}

impl Meetings {
    pub(super) fn reset(&mut self, places: usize) {
        self.members.clear();
        self.tiles.clear();
        self.member_of.clear();
        self.lists.clear();
        self.lows.iter_mut().chain(&mut self.highs).for_each(Numbers::clear);
        for numbers in &mut self.material {
            numbers.clear();
            numbers.resize(places, 0.0);
        }
    }

    /// Adds a cloth.
    pub(super) fn add(&mut self, tiles: &[Tile], member: Member) {
        self.tiles.extend_from_slice(tiles);
        self.member_of.resize(self.tiles.len(), self.members.len() as u32);
        self.members.push(member);
        self.boxes.resize(self.tiles.len(), Bounds::EMPTY);
        let eights = self.tiles.len().next_multiple_of(LANES);
        self.lows.iter_mut().for_each(|sides| sides.resize(eights, f32::INFINITY));
        self.highs.iter_mut().for_each(|sides| sides.resize(eights, f32::NEG_INFINITY));
        self.cones.clear();
        self.cones.resize(self.tiles.len(), Cone::ALL);
        self.motions.resize(self.tiles.len(), Bounds::EMPTY);
    }

    /// Forgets all lists, so that the next ones follow from where all is.
    pub(super) fn forget(&mut self, points: &Points) {
        self.spare.append(&mut self.lists);
        // Nothing has moved from there yet.
        self.base.clone_from(&points.start);
    }

    /// Tells which places are attached to each other: they do not push.
    pub(super) fn link(&mut self, links: impl Iterator<Item = [u32; 2]>) {
        self.links.clear();
        self.links.extend(links.map(|[a, b]| [a.min(b), a.max(b)]));
        self.links.put_in_order();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The tile of this number, to be brought up to date.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn update_tile<L: Lanes>(&mut self, tile: usize, points: &Points) {
        let (mut around, mut motion) = (Around::<L>::nothing(), Around::nothing());
        for &place in &self.tiles[tile].eights {
            let place = place as usize;
            let is_there = points.are_there::<L>(place);
            let now = points.eight_at::<L>(place);
            around.add(is_there, now);
            motion.add(is_there, now - Vec3x8::read(&self.base, place));
            now.write(&mut self.base, place);
        }
        let bounds = around.bounds();
        (self.boxes[tile], self.motions[tile]) = (bounds, motion.bounds());
        set(&mut self.lows, tile, bounds.low);
        set(&mut self.highs, tile, bounds.high);
    }

    /// Tells which way a tile of a sheet faces. All tiles are up to date.
    #[inline(always)]
    pub(super) fn update_cone<L: Lanes>(&mut self, tile: usize, grid: &Grid, points: &Points) {
        self.cones[tile] = cone_of::<L>(grid, &self.tiles[tile], &self.base, points);
    }

    /// Brings all lists up to date. Tiles have been. `ahead` is how long it is until the next look, in times since the last.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn look<L: Lanes>(&mut self, points: &Points, ahead: f32, couples: &mut Couples) {
        let mut old = std::mem::take(&mut self.lists).into_iter().peekable();
        let mut lists = Vec::new();
        let farthest = self.members.iter().map(|member| member.distance).fold(0.0, f32::max);
        let mut nearby = Vec::new();
        for a in 0..self.tiles.len() {
            self.find_nearby::<L>(a, farthest * (1.0 + MARGIN), &mut nearby);
            for &b in &nearby {
                let Some((distance, friction)) = self.may_meet(a, b) else { continue };
                let tiles = [a as u32, b as u32];
                while let Some(gone) = old.next_if(|list| list.tiles < tiles) {
                    self.spare.push(gone);
                }
                let moved = self.relative_motion(a, b);
                let mut list = match old.next_if(|list| list.tiles == tiles) {
                    Some(list) => list,
                    None => List { tiles, moved: f32::INFINITY, ..self.spare.pop().unwrap_or_default() },
                };
                list.moved += moved;
                (list.distance, list.friction, list.fold) = (distance, friction, self.fold_of(a, distance));
                let soon = HASTE * ahead * moved;
                if list.moved + soon > MARGIN * distance {
                    list.moved = 0.0;
                    self.list_pairs::<L>(points, &mut list);
                }
                list.pairs.keep_near(&self.base, distance * (1.0 + PUSH) + soon);
                list.folds.keep_near(&self.base, list.fold * (1.0 + PUSH) + soon);
                if !list.is_idle() {
                    let piece_of = |tile: usize| self.members[self.member_of[tile] as usize].piece;
                    list.couple = couples.number([a, b].map(piece_of));
                }
                lists.push(list);
            }
        }
        self.spare.extend(old);
        self.lists = lists;
    }

    /// The tiles from `tile` on whose boxes are no further from its own than `reach` (m).
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn find_nearby<L: Lanes>(&self, tile: usize, reach: f32, out: &mut Vec<usize>) {
        out.clear();
        let own = self.boxes[tile].grown(reach);
        let (low, high) = (Vec3x8::<L>::splat(own.low), Vec3x8::<L>::splat(own.high));
        for first in (tile - tile % LANES..self.tiles.len()).step_by(LANES) {
            let (lows, highs) = (Vec3x8::<L>::read(&self.lows, first), Vec3x8::<L>::read(&self.highs, first));
            let mut lanes = !(apart(high, lows) | apart(highs, low)) & ((1 << LANES) - 1);
            while lanes != 0 {
                let other = first + lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                if other >= tile {
                    out.push(other);
                }
            }
        }
    }

    /// How far apart the particles of two tiles are kept, and their friction; `None` if they do not meet.
    fn may_meet(&self, a: usize, b: usize) -> Option<(f32, f32)> {
        let (first, second) = (self.member_of[a] as usize, self.member_of[b] as usize);
        let (one, other) = (&self.members[first], &self.members[second]);
        let distance = 0.5 * (one.distance + other.distance);
        let reach = distance * (1.0 + MARGIN);
        if !self.boxes[a].grown(reach).meets(&self.boxes[b]) || first == second && !one.meets_itself {
            return None;
        }
        let (at, to) = (self.tiles[a].at, self.tiles[b].at);
        let is_beside = first == second && (0..2).all(|k| at[k].abs_diff(to[k]) <= 1);
        if is_beside && self.cones[a].is_smooth_with(&self.cones[b], SMOOTH) {
            return None;
        }
        Some((distance, (one.friction * other.friction).sqrt()))
    }

    /// How far corners of a tile's cells are kept apart across their folds, in m, where others are by `distance`.
    fn fold_of(&self, tile: usize, distance: f32) -> f32 {
        match self.members[self.member_of[tile] as usize].exempt {
            Exempt::Within { diagonal, .. } => distance.min(diagonal * SHARPEST),
            Exempt::Listed(..) => 0.0,
        }
    }

    /// How far a particle of one tile can have moved against one of the other since the last look, in m.
    fn relative_motion(&self, a: usize, b: usize) -> f32 {
        let (a, b) = (&self.motions[a], &self.motions[b]);
        (a.high - b.low).abs().max((b.high - a.low).abs()).norm()
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn list_pairs<L: Lanes>(&self, points: &Points, list: &mut List) {
        let [a, b] = list.tiles.map(|tile| tile as usize);
        let reach = list.distance * (1.0 + MARGIN);
        let reach_squared = L::splat(reach * reach);
        let is_one = self.member_of[a] == self.member_of[b];
        let exempt = is_one.then(|| &self.members[self.member_of[a] as usize].exempt);
        let (near_a, near_b) = (self.boxes[a].grown(reach), self.boxes[b].grown(reach));
        list.pairs.all.clear();
        list.folds.all.clear();
        let (mut others, mut count) = ([Eight { place: 0, at: Vec3x8::<L>::zero() }; MOST_EIGHTS], 0);
        for &place in &self.tiles[b].eights {
            if inside::<L>(points, &self.base, place as usize, &near_a) != 0 {
                let at = Vec3x8::read(&self.base, place as usize);
                others[count] = Eight { place: place as usize, at };
                count += 1;
            }
        }
        for &first in &self.tiles[a].eights {
            let mut lanes = inside::<L>(points, &self.base, first as usize, &near_b);
            while lanes != 0 {
                let place = first as usize + lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let at = Vec3x8::splat(get(&self.base, place));
                // Within a tile every pair is listed once, with the lower place first.
                let behind = if a == b {
                    others[..count].partition_point(|other| other.place + LANES <= place)
                } else {
                    0
                };
                for other in &others[behind..count] {
                    // Where there is no particle is near none.
                    let is_near = reach_squared.greater((other.at - at).length_squared());
                    if is_near.bits() != 0 {
                        self.list_near::<L>(
                            place,
                            (other.place, is_near.bits()),
                            a == b,
                            exempt,
                            [&mut list.pairs.all, &mut list.folds.all],
                        );
                    }
                }
            }
        }
    }

    /// Lists those of eight particles whose bits are set, as near one, unless they are its neighbours in the material.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn list_near<L: Lanes>(
        &self,
        place: usize,
        (others, mut near): (usize, u32),
        is_same_tile: bool,
        exempt: Option<&Exempt>,
        [out, folds]: [&mut Vec<[u32; 2]>; 2],
    ) {
        if let Some(&Exempt::Within { reach, diagonal }) = exempt {
            let apart = Vec3x8::<L>::read(&self.material, others) - Vec3x8::splat(get(&self.material, place));
            let squared = apart.length_squared();
            // Sticks go from the first corner of a cell to the last.
            let is_across = L::splat(0.0).greater(apart.x * apart.y);
            let is_fold = L::splat(diagonal * diagonal).greater(squared).and(is_across);
            let mut across = near & is_fold.bits();
            while across != 0 {
                let other = others + across.trailing_zeros() as usize;
                across &= across - 1;
                if !is_same_tile || other > place {
                    folds.push([place as u32, other as u32]);
                }
            }
            near &= squared.greater(L::splat(reach * reach)).bits();
        }
        while near != 0 {
            let other = others + near.trailing_zeros() as usize;
            near &= near - 1;
            let (low, high) = (place.min(other), place.max(other));
            let is_neighbour = match exempt {
                Some(Exempt::Listed(start, lists)) => {
                    lists.get(low - start).is_some_and(|list| list.binary_search(&(high as u32)).is_ok())
                }
                _ => false,
            };
            let is_neighbour = is_neighbour || self.links.binary_search(&[low as u32, high as u32]).is_ok();
            if (!is_same_tile || other > place) && !is_neighbour {
                out.push([place as u32, other as u32]);
            }
        }
    }

    /// The pairs that may come too close until the next look, and how far each is kept apart, in m.
    pub(super) fn near(&self) -> impl Iterator<Item = ([u32; 2], f32)> {
        self.lists.iter().flat_map(|list| {
            let pairs = list.pairs.near.iter().map(|&pair| (pair, list.distance));
            pairs.chain(list.folds.near.iter().map(|&pair| (pair, list.fold)))
        })
    }

    /// Moves all pairs apart that are too close, with friction; what was too close before by `recovery` (m) at most.
    pub(super) fn part(&self, points: &mut Points, recovery: f32, couples: &mut Couples) {
        let mut points = points.slices();
        for list in &self.lists {
            if list.is_idle() {
                continue;
            }
            let &List { distance, friction, couple, fold, .. } = list;
            let parting = Parting { distance, most: GENTLY * recovery, friction, turn: couples.turn(couple) };
            let folding = Parting { distance: fold, friction: 0.0, ..parting };
            let mut moment = DVec3::ZERO;
            for (pairs, parting) in [(&list.pairs, parting), (&list.folds, folding)] {
                for &[a, b] in &pairs.near {
                    if let Some(added) = part_pair(&mut points, [a as usize, b as usize], parting) {
                        moment += added.as_dvec3();
                    }
                }
            }
            couples.add(couple, moment);
        }
    }
}

impl List {
    /// Whether nothing in it may come too close until the next look.
    fn is_idle(&self) -> bool {
        self.pairs.near.is_empty() && self.folds.near.is_empty()
    }
}

impl Pairs {
    /// Finds the pairs that are no further apart than this, in m.
    #[inline(always)]
    fn keep_near(&mut self, positions: &Coordinates, reach: f32) {
        self.near.clear();
        for &[a, b] in &self.all {
            let apart = get(positions, b as usize) - get(positions, a as usize);
            if apart.length_squared() < reach * reach {
                self.near.push([a, b]);
            }
        }
    }
}

/// Bits of the lanes in which a low side is beyond a high one.
#[inline(always)]
fn apart<L: Lanes>(high: Vec3x8<L>, low: Vec3x8<L>) -> u32 {
    low.x.greater(high.x).bits() | low.y.greater(high.y).bits() | low.z.greater(high.z).bits()
}

/// Where every place of a sheet is in the material, in m.
pub(super) fn lay_flat(grid: &Grid, edges: [f32; 2], material: &mut Coordinates) {
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let place = grid.place(row, column);
            material[0][place] = column as f32 * edges[0];
            material[1][place] = row as f32 * edges[1];
        }
    }
}

#[cfg(test)]
#[path = "tests/meet.rs"]
mod tests;
