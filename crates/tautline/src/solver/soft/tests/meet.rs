use std::collections::BTreeSet;

use glam::Vec3;

use super::*;
use crate::simd::Kernel;
use crate::solver::soft::grid::Grid;
use crate::solver::soft::tests::{noise3, on_all, put_wavy};
use crate::solver::soft::tile::tiles_of_grid;

const DISTANCE: f32 = 0.12;
const SMALL: usize = 80;

/// Two sheets of cells of 10 cm, the upper one with its far half folded back over the near one.
#[derive(Debug, Clone)]
struct Scene {
    grids: [Grid; 2],
    points: Points,
    meetings: Meetings,
    couples: Couples,
}

fn scene(meets_itself: bool) -> Scene {
    let first = Grid::new(0, 34, 18);
    let grids = [first, Grid::new(first.places().end, 19, 12)];
    let end = grids[1].places().end;
    let mut points = Points::default();
    points.reset(end);
    grids.iter().zip([0.2, 0.0]).for_each(|(grid, height)| put_wavy(&mut points, grid, height));
    let mut meetings = Meetings::default();
    meetings.reset(points.inverse_mass.len());
    for (piece, grid) in (0..).zip(&grids) {
        lay_flat(grid, [0.1, 0.1], &mut meetings.material);
        let exempt = Exempt::of_sheet(DISTANCE, [0.1, 0.1]);
        let member = Member { piece, meets_itself, distance: DISTANCE, exempt, friction: 0.3 };
        meetings.add(&tiles_of_grid(grid), member);
    }
    let folded = &grids[0];
    for (row, column) in (0..18).flat_map(|row| (17..34).map(move |column| (row, column))) {
        let place = folded.place(row, column);
        let at = points.at(place);
        let at = Vec3::new(3.3 - at.x, at.y + 0.1, at.z);
        points.put(place, at, Vec3::ZERO);
    }
    meetings.forget(&points);
    Scene { grids, points, meetings, couples: Couples::default() }
}

impl Scene {
    #[inline(always)]
    fn look<L: Lanes>(&mut self, has_cones: bool) {
        for tile in 0..self.meetings.tiles.len() {
            self.meetings.update_tile::<L>(tile, &self.points);
        }
        for tile in (0..self.meetings.tiles.len()).filter(|_| has_cones) {
            let grid = &self.grids[self.meetings.member_of[tile] as usize];
            self.meetings.update_cone::<L>(tile, grid, &self.points);
        }
        self.couples.clear();
        self.meetings.look::<L>(&self.points, 1.0, &mut self.couples);
    }

    fn drift(&mut self, step: usize) {
        for place in 0..self.points.inverse_mass.len() {
            let side = if place < self.grids[1].start { -1.0 } else { 1.0 };
            let motion = Vec3::Y * (side * 0.002) + noise3(place) * 0.002;
            if self.points.presence[place] == 1.0 {
                self.points.shift(place, motion * (1.0 + 0.3 * (step as f32).sin()));
            }
        }
    }

    fn listed(&self) -> BTreeSet<[u32; 2]> {
        let pairs = self.meetings.lists.iter().flat_map(|list| &list.pairs.all);
        let mut sorted = BTreeSet::new();
        for &[a, b] in pairs {
            assert!(sorted.insert([a.min(b), a.max(b)]), "{a} and {b} are listed twice");
        }
        sorted
    }

    /// Row and column, and the sheet.
    fn particles(&self) -> Vec<(usize, [usize; 2], u32)> {
        let of = |sheet: usize| {
            let grid = self.grids[sheet];
            let cells =
                (0..grid.rows).flat_map(move |row| (0..grid.columns).map(move |column| [row, column]));
            cells.map(move |[row, column]| (sheet, [row, column], grid.place(row, column) as u32))
        };
        of(0).chain(of(1)).collect()
    }

    /// All pairs nearer than `reach`, but for neighbours in the material and tiles whose cones are smooth.
    fn near(&self, reach: f32, meets_itself: bool) -> BTreeSet<[u32; 2]> {
        let particles = self.particles();
        let mut tile_of = vec![0; self.points.inverse_mass.len()];
        for (number, tile) in self.meetings.tiles.iter().enumerate() {
            for &eight in &tile.eights {
                tile_of[eight as usize..eight as usize + 8].fill(number);
            }
        }
        let mut near = BTreeSet::new();
        for (number, &(sheet, at, place)) in particles.iter().enumerate() {
            for &(other_sheet, other_at, other) in &particles[number + 1..] {
                let is_one = sheet == other_sheet;
                let rings = (0..2).map(|k| at[k].abs_diff(other_at[k])).max();
                let (a, b) = (tile_of[place as usize], tile_of[other as usize]);
                let to = [a, b].map(|tile| self.meetings.tiles[tile].at);
                let beside = is_one && (0..2).all(|k| to[0][k].abs_diff(to[1][k]) <= 1);
                let cones = [a, b].map(|tile| self.meetings.cones[tile]);
                let is_skipped = beside && cones[0].is_smooth_with(&cones[1], SMOOTH);
                let is_exempt = is_one && (!meets_itself || rings <= Some(1));
                let distance = self.points.at(place as usize).distance(self.points.at(other as usize));
                if distance < reach && !is_exempt && !is_skipped {
                    near.insert([place.min(other), place.max(other)]);
                }
            }
        }
        near
    }
}

struct Look(Scene, bool);

impl Kernel for Look {
    type Output = Scene;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> Scene {
        self.0.look::<L>(self.1);
        self.0
    }
}

#[test]
fn all_pairs_within_the_margin_are_listed_and_no_others() {
    for has_cones in [false, true] {
        for meets_itself in [false, true] {
            let start = scene(meets_itself);
            let found = on_all(|| Look(start.clone(), has_cones));
            let reach = DISTANCE * (1.0 + MARGIN);
            let (sure, near) =
                (found.near(reach - 1e-5, meets_itself), found.near(reach + 1e-5, meets_itself));
            let listed = found.listed();
            assert!(listed.is_superset(&sure) && listed.is_subset(&near));
            let least = if meets_itself { SMALL } else { 0 };
            assert!(sure.len() > least, "{} pairs are near", sure.len());
        }
    }
}

#[test]
fn all_that_is_too_close_stays_listed_while_sheets_move() {
    for has_cones in [false, true] {
        let mut moving = on_all(|| Look(scene(true), has_cones));
        let (mut kept, mut most) = (0, 0);
        for step in 0..40 {
            // Until the next look, too.
            moving.drift(step);
            let close = moving.near(DISTANCE, true);
            assert!(close.is_subset(&moving.listed()), "step {step}, before the look");
            moving = on_all(|| Look(moving.clone(), has_cones));
            let close = moving.near(DISTANCE, true);
            assert!(close.is_subset(&moving.listed()), "step {step}, after the look");
            kept += moving.meetings.lists.iter().filter(|list| list.moved > 0.0).count();
            most = most.max(close.len());
        }
        assert!(kept > 100 && most > SMALL, "{kept} lists were kept, {most} pairs close");
    }
}

#[test]
fn it_does_not_matter_when_lists_were_made() {
    let mut kept = scene(true);
    // Where much overlaps, a pass moves particles by more than the margin.
    for _ in 0..20 {
        kept.meetings.forget(&kept.points);
        kept = on_all(|| Look(kept.clone(), true));
        kept.meetings.part(&mut kept.points, f32::MAX, &mut kept.couples);
    }
    let mut fresh = kept.clone();
    for step in 0..30 {
        for scene in [&mut kept, &mut fresh] {
            scene.drift(step);
        }
        fresh.meetings.forget(&fresh.points);
        kept = on_all(|| Look(kept.clone(), true));
        fresh = on_all(|| Look(fresh.clone(), true));
        for scene in [&mut kept, &mut fresh] {
            scene.meetings.part(&mut scene.points, f32::MAX, &mut scene.couples);
        }
        assert!(kept.points.offset == fresh.points.offset, "step {step}");
        assert!(kept.points.remainder == fresh.points.remainder, "step {step}");
    }
}

/// Heaps of fine cloth had triangles that went through each other at folds: nothing kept the halves of a cell apart.
#[test]
fn a_cell_is_not_folded_flat() {
    let mut folded = scene(true);
    let grid = folded.grids[1];
    let [right, below] = [grid.place(5, 6), grid.place(6, 5)];
    let beside = folded.points.at(below) + Vec3::new(0.01, 0.02, 0.0);
    folded.points.put(right, beside, Vec3::ZERO);
    folded.meetings.forget(&folded.points);
    for _ in 0..40 {
        folded = on_all(|| Look(folded.clone(), true));
        folded.meetings.part(&mut folded.points, 0.1, &mut folded.couples);
    }
    let apart = folded.points.at(right).distance(folded.points.at(below));
    let expected = SHARPEST * 0.1 * 2.0_f32.sqrt();
    assert!((apart / expected - 1.0).abs() < 0.01, "{apart} m instead of {expected}");
    assert!(folded.points.motion(right).length() < 1e-6, "it is given no velocity");
}

/// Two particles, the second of them three times as light, `gap` (m) apart that come closer by `closing` (m) in a small step and
/// slide by 1 cm.
fn pair(gap: f32, closing: f32) -> Points {
    let mut points = Points::default();
    points.reset(8);
    for (place, side) in [(0, -0.5), (1, 0.5)] {
        let direction = Vec3::new(0.6, 0.0, 0.8);
        points.put(place, direction * (side * gap), Vec3::ZERO);
        points.set_motion(place, direction * (-side * closing) + Vec3::Y * (side * 0.01));
        points.inverse_mass[place] = if place == 0 { 1.0 } else { 3.0 };
    }
    points
}

/// Pairs that are too close end at about their distance and come no closer; all they lose of their angular momentum is
/// what friction takes, which is told.
#[test]
fn a_pair_is_parted_and_keeps_its_momentum() {
    let momentum = |points: &Points| points.motion(0) + points.motion(1) / 3.0;
    let turned = |points: &Points| {
        let of =
            |place: usize| points.begun_at(place).cross(points.motion(place)) / points.inverse_mass[place];
        of(0) + of(1)
    };
    let energy =
        |points: &Points| points.motion(0).length_squared() + points.motion(1).length_squared() / 3.0;
    for (gap, closing) in [(0.05, 0.0), (0.05, 0.02), (0.11, 0.1), (0.01, 0.1), (0.13, 0.1)] {
        for friction in [0.0, 0.25] {
            let mut points = pair(gap, closing);
            let before = points.clone();
            let parting = Parting { distance: DISTANCE, most: f32::MAX, friction, turn: Vec3::ZERO };
            let told = part_pair(&mut points.slices(), [0, 1], parting);
            assert_eq!(told.is_some(), gap < DISTANCE);
            let told = told.unwrap_or(Vec3::ZERO);
            assert!((turned(&points) - turned(&before) - told).length() < 1e-9, "{gap}: {told}");
            assert!(friction > 0.0 || gap < 0.02 || told.length() < 1e-9, "{gap}: {told}");
            assert!((momentum(&points) - momentum(&before)).length() < 1e-8);
            assert!(energy(&points) <= energy(&before));
            let apart = points.at(0).distance(points.at(1));
            assert!(apart > 0.999 * gap.max(DISTANCE) && apart < 1.02 * gap.max(DISTANCE), "{gap}: {apart}");
            let approach = |points: &Points| {
                let between = points.begun_at(1) - points.begun_at(0);
                (points.motion(0) - points.motion(1)).dot(between.normalize())
            };
            let braked = (approach(&before) - approach(&points)).max(0.0);
            assert!(gap < 0.02 || braked < 1.02 * (DISTANCE - gap).max(0.0) + 1e-7, "{gap}: {braked}");
        }
    }
}

/// Friction is what a pair does against the whole that it is of.
#[test]
fn what_turns_with_the_whole_does_not_rub() {
    let mut points = pair(0.11, 0.0);
    let between = points.begun_at(1) - points.begun_at(0);
    let slip = points.motion(1) - points.motion(0);
    let turn = between.cross(slip) / between.length_squared();
    let parting = Parting { distance: DISTANCE, most: 0.0, friction: 0.5, turn };
    let told = part_pair(&mut points.slices(), [0, 1], parting).unwrap();
    let change = points.motion(1) - points.motion(0) - slip;
    assert!(told.length() < 1e-9 && change.cross(between).length() < 1e-9, "{told}, {change}");
}

/// Along sticks, those within a distance are exempt; and direct neighbours always.
#[test]
fn neighbours_along_sticks_are_exempt() {
    let stick = |a: u32, rest_length: f32| Stick { a, b: a + 1, rest_length };
    let sticks: Vec<Stick> =
        [0.1, 0.1, 0.5, 0.1, 0.2].into_iter().zip(0..).map(|(l, a)| stick(a, l)).collect();
    let Exempt::Listed(16, lists) = Exempt::along(&sticks, 6, 16, 0.25) else { panic!("it lists") };
    let expected: [&[u32]; 6] = [&[17, 18], &[18], &[19], &[20], &[21], &[]];
    assert_eq!(lists, expected);
}
