//! The small steps of a substep, in physical order.

use glam::Vec3;

use super::SoftSolver;
use super::attach::Moment;
use super::elastic::Stiffen;
use super::gas;
use super::hinge;
use super::hot::Contacts;
use super::pair::{Parting, part_pair};
use super::piece::{Layout, Piece};
use super::points::{Points, SmallStep};
use super::sheet::Sheet;
use super::solid::Solid;
use super::stick::Span;
use super::strand::Sheeting;
use super::touch::{self, Push, Skin};
use crate::body::Body;
use crate::simd::{Instructions, Kernel, Lanes, run};

/// Which cloth and ropes may touch which is looked at once in so many small steps, or in a few less.
const LOOK_EVERY: usize = 5;
/// By how much faster than now things may get until the next look.
const HASTE: f32 = 1.5;

/// The substep that is being made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Timing {
    /// A small step, in s.
    pub(super) small: f32,
    /// Small steps.
    pub(super) count: usize,
    /// In m/s².
    pub(super) gravity: Vec3,
    /// In m/s.
    pub(super) wind: Vec3,
    /// In kg/m³.
    pub(super) air_density: f32,
    /// In 1/s.
    pub(super) damping: f32,
    /// The speed at which what was too deep before is moved out, in m/s.
    pub(super) recovery: f32,
    pub(super) instructions: Instructions,
}

/// In how many small steps what may touch is looked at once, where a substep has `count`: equal parts of it.
pub(super) fn look_every(count: usize) -> u32 {
    count.div_ceil(count.div_ceil(LOOK_EVERY)) as u32
}

impl Timing {
    fn moment(&self, number: usize) -> Moment {
        let left = (self.count - number - 1) as f32;
        Moment { left, small: self.small, recovery: self.recovery * self.small }
    }

    fn push(&self, number: usize) -> Push {
        let Moment { left, recovery, .. } = self.moment(number);
        Push { recovery, left }
    }
}

impl SoftSolver {
    /// All small steps of a substep.
    pub(super) fn make_small_steps(&mut self, solids: &mut [Solid<'_>], bodies: &[Body], timing: &Timing) {
        let instructions = timing.instructions;
        let mut until_search = 0;
        for number in 0..timing.count {
            solids.iter_mut().for_each(Solid::advance);
            self.wind_ropes();
            self.blow(number, timing);
            run(instructions, Integrate(self, timing));
            self.press(timing.small);
            self.sew(timing.small);
            if until_search == 0 {
                let left = timing.count - number;
                until_search = run(instructions, FindTouches { solver: self, solids, bodies, left });
                self.ties.exempt(&mut self.touches);
            }
            until_search -= 1;
            self.load_ties(solids, timing.moment(number));
            run(instructions, Relax(self));
            run(instructions, Stiffen(self, timing.small));
            self.turn_hinges(timing.small);
            run(instructions, Part(self, timing.recovery * timing.small));
            run(instructions, PullRopes(self));
            self.unload_ties(solids, timing.moment(number));
            run(instructions, PushOut { solver: self, solids, push: timing.push(number) });
            run(instructions, SweepWindows { solver: self, solids, push: timing.push(number) });
            self.ties.pull(&mut self.points, solids, timing.moment(number));
            self.done += 1;
        }
        run(instructions, Settle(&mut self.points));
    }
}

struct Settle<'a>(&'a mut Points);

impl Kernel for Settle<'_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        self.0.settle::<L>();
    }
}

struct Integrate<'a>(&'a mut SoftSolver, &'a Timing);

impl Kernel for Integrate<'_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        let Self(SoftSolver { points, pieces, led, .. }, timing) = self;
        let h = timing.small;
        for piece in pieces {
            let step = SmallStep {
                keep: 1.0 / (1.0 + timing.damping * h),
                fall: timing.gravity * (h * h),
                limit: piece.longest_motion,
                calming: piece.calming(h),
            };
            piece.fastest = points.integrate::<L>(piece.places.clone(), step);
        }
        for &(place, motion) in led.iter() {
            points.lead(place, motion);
        }
    }
}

/// Finds what may be touched in the next small steps, and for how many of the `left` ones that holds.
struct FindTouches<'a, 'b> {
    solver: &'a mut SoftSolver,
    solids: &'a [Solid<'b>],
    bodies: &'a [Body],
    left: usize,
}

impl Kernel for FindTouches<'_, '_> {
    type Output = usize;

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) -> usize {
        let SoftSolver { points, pieces, touches, .. } = self.solver;
        touches.clear();
        // No more than half the thickness at a time: planes of edges and corners hold only near where they were found.
        let steps = |piece: &Piece| ((0.5 * piece.thickness / piece.fastest.max(1e-12)) as usize).max(1);
        let count = pieces.iter().map(steps).fold(self.left, usize::min);
        for (number, piece) in pieces.iter_mut().enumerate() {
            piece.fit_boxes::<L>(points);
            let margin = piece.fastest * count as f32 + 0.25 * piece.thickness;
            let around = piece.bounds().grown(piece.thickness + margin);
            for (solid_number, solid) in self.solids.iter().enumerate() {
                let stance = solid.stance(self.left as f32);
                if solid.bounds(&stance).is_some_and(|bounds| !around.meets(&bounds)) {
                    continue;
                }
                let friction = self.bodies[piece.body].surface.against(&solid.skin).friction;
                let skin = Skin { piece: number as u32, thickness: piece.thickness, margin, friction };
                let tiles = (&piece.tiles[..], &piece.boxes[..]);
                touch::find::<L>(tiles, points, (solid_number, solid, &stance), skin, touches);
            }
        }
        for piece in pieces {
            if let Layout::Sheet(sheet) = &mut piece.layout {
                sheet.windows.list_touches(&sheet.grid, touches);
            }
        }
        count
    }
}

/// Tethers, threads, a sweep, bending.
struct Relax<'a>(&'a mut SoftSolver);

impl Kernel for Relax<'_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        let SoftSolver { points, pieces, pivots, done, .. } = self.0;
        let is_even = done.is_multiple_of(2);
        for piece in pieces {
            // They go by the length that a rope was laid out with.
            if piece.winding.is_none() {
                piece.tethers.tighten::<L>(points);
            }
            let is_held = piece.is_held();
            piece.elastic.sweep::<L>(points);
            match &mut piece.layout {
                Layout::Sheet(sheet) => {
                    sheet.pull_threads::<L>(points, is_held, is_even, pivots);
                    let whole = sheet.grid.whole();
                    let pass = (&sheet.weave, is_even || !is_held);
                    let (mut moving, masses) = points.moving();
                    sheet.grid.sweep::<L>(&mut moving, masses, &whole, pass);
                }
                Layout::Loose(batches) => {
                    let sweeps = if piece.balloon.is_some() { gas::SWEEPS } else { 1 };
                    for _ in 0..sweeps {
                        batches.sweep::<L>(points);
                    }
                }
                Layout::Rope | Layout::Net(_) | Layout::Solid(_) => {}
            }
        }
    }
}

/// Keeps cloth and ropes from each other and themselves.
struct Part<'a>(&'a mut SoftSolver, f32);

impl Kernel for Part<'_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        let Self(solver, recovery) = self;
        let is_time = solver.done.is_multiple_of(solver.look_every);
        if is_time {
            solver.couples.clear();
        }
        if is_time && !solver.meetings.is_empty() {
            solver.look_at_cloth::<L>();
        }
        if is_time && !solver.strands.is_empty() {
            solver.look_at_ropes::<L>();
        }
        let SoftSolver { points, pieces, strands, meetings, couples, .. } = solver;
        couples.look::<L>(points, pieces);
        meetings.part(points, recovery, couples);
        strands.part(points, recovery, couples, |piece| pieces[piece as usize].rest.leans = true);
        couples.give_back::<L>(points, pieces);
    }
}

impl SoftSolver {
    fn sew(&mut self, h: f32) {
        for piece in &mut self.pieces {
            piece.seams.pull(&mut self.points, h);
        }
    }

    fn turn_hinges(&mut self, h: f32) {
        if self.done.is_multiple_of(hinge::EVERY) {
            for piece in &self.pieces {
                piece.hinges.turn(&mut self.points, h * h * hinge::EVERY as f32);
            }
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn look_at_cloth<L: Lanes>(&mut self) {
        let mut number = 0;
        for piece in &self.pieces {
            if piece.is_rope() {
                continue;
            }
            let tiles = number..number + piece.tiles.len();
            number = tiles.end;
            for tile in tiles.clone() {
                self.meetings.update_tile::<L>(tile, &self.points);
            }
            if let Layout::Sheet(sheet) = &piece.layout {
                for tile in tiles {
                    self.meetings.update_cone::<L>(tile, &sheet.grid, &self.points);
                }
            }
        }
        // What has moved since the step began has in its first look moved for one small step only.
        let ahead = if self.done == 0 { self.look_every as f32 } else { 1.0 };
        self.meetings.look::<L>(&self.points, ahead, &mut self.couples);
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn look_at_ropes<L: Lanes>(&mut self) {
        let fastest = self.pieces.iter().map(|piece| piece.fastest).fold(0.0, f32::max);
        let thinnest = self.pieces.iter().map(|piece| piece.thickness).fold(f32::INFINITY, f32::min);
        let margin = 2.0 * HASTE * self.look_every as f32 * fastest + 0.5 * thinnest;
        for piece in &mut self.pieces {
            piece.fit_boxes::<L>(&self.points);
        }
        let is_cloth = |(_, piece): &(usize, &Piece)| !piece.is_rope();
        let sheets = self.pieces.iter().enumerate().filter(is_cloth).map(|(number, piece)| Sheeting {
            piece: number as u32,
            tiles: &piece.tiles,
            boxes: &piece.boxes,
            thickness: piece.thickness,
            friction: piece.friction,
        });
        self.strands.look::<L>(&self.points, sheets, margin, &mut self.couples);
    }
}

/// Ropes last, so that nothing stretches them.
struct PullRopes<'a>(&'a mut SoftSolver);

impl Kernel for PullRopes<'_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        let SoftSolver { points, pieces, bundles, pivots, .. } = self.0;
        for bundle in bundles {
            bundle.solve::<L>(points, pivots);
        }
        for piece in pieces {
            if let Layout::Net(batches) = &piece.layout {
                (0..NET_SWEEPS).for_each(|_| batches.sweep::<L>(points));
            }
        }
    }
}

/// Where a sheet is still stretched around something solid, sweeps and pushes out again.
struct SweepWindows<'a, 'b> {
    solver: &'a mut SoftSolver,
    solids: &'a mut [Solid<'b>],
    push: Push,
}

impl Kernel for SweepWindows<'_, '_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        let SoftSolver { points, pieces, touches, strands, meetings, couples, done, look_every, .. } =
            self.solver;
        let push = self.push;
        for piece in pieces.iter_mut() {
            let is_even = done.is_multiple_of(2) || !piece.is_held();
            let Layout::Sheet(sheet) = &mut piece.layout else { continue };
            let Sheet { grid, weave, windows, .. } = &mut **sheet;
            let is_fine = grid.columns.max(grid.rows) >= FINE;
            let tolerance = if is_fine { HOT_AND_FINE } else { HOT };
            // Whenever what may touch has been looked for, of which windows keep the numbers.
            if done.is_multiple_of(*look_every) {
                windows.find::<L>(grid, weave, points, tolerance);
                windows.list_members(grid);
                windows.list_touches(grid, touches);
                windows.list_meetings(grid, &strands.brushes, meetings.near());
            }
            let limit = COOL * tolerance;
            let limits = weave.map(|span| Span { low: 0.0, high: span.high * (1.0 + limit), ..span });
            for (window, contacts) in windows.windows.iter().zip(&windows.contacts) {
                let Contacts { touches: listed, brushes, pairs } = contacts;
                // What moves in turn is pushed once in a small step: what it gets is to be in the velocity of what pushes.
                let solid_of = |number: &u32| &self.solids[touches[*number as usize].solid as usize];
                let has_mover = listed.iter().any(|number| solid_of(number).inverse_mass > 0.0);
                if contacts.is_empty() || has_mover {
                    continue;
                }
                let (mut moving, masses) = points.moving();
                grid.sweep::<L>(&mut moving, masses, window, (&limits, is_even));
                let mut points = points.slices();
                for &([a, b], distance) in pairs {
                    let parting = Parting { distance, most: 0.0, friction: 0.0, turn: Vec3::ZERO };
                    part_pair(&mut points, [a as usize, b as usize], parting);
                }
                for &number in brushes {
                    strands.brushes[number as usize].part(&mut points, 0.0, couples);
                }
                for &number in listed {
                    let touch = &mut touches[number as usize];
                    let solid = &mut self.solids[touch.solid as usize];
                    touch.solve_again::<L>(&mut points, solid, push);
                }
            }
        }
        couples.give_back::<L>(points, pieces);
    }
}

/// How often the segments of a net are swept in a small step.
const NET_SWEEPS: u32 = 4;
/// By what share of its length an edge is longer that is hot, …
const HOT: f32 = 0.03;
/// … in sheets of …
const HOT_AND_FINE: f32 = 0.045;
/// … so many particles along a side.
const FINE: usize = 80;
/// To what share of that it is pulled in.
const COOL: f32 = 0.8;

/// Moves all out of what is solid.
struct PushOut<'a, 'b> {
    solver: &'a mut SoftSolver,
    solids: &'a mut [Solid<'b>],
    push: Push,
}

impl Kernel for PushOut<'_, '_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        let SoftSolver { points, pieces, touches, .. } = self.solver;
        let push = self.push;
        let mut points = points.slices();
        for touch in touches {
            let solid = &mut self.solids[touch.solid as usize];
            if touch.solve::<L>(&mut points, solid, push) {
                pieces[touch.piece as usize].rest.leans |= solid.inverse_mass == 0.0;
                pieces[touch.piece as usize].rest.is_pushed |= solid.inverse_mass > 0.0;
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/small_step.rs"]
mod tests;
