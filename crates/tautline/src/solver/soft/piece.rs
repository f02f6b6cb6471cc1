//! A cloth or rope among the points.

use std::ops::Range;

use super::air::Sail;
use super::batch::Batches;
use super::elastic::Elastic;
use super::gas::Balloon;
use super::grid::Grid;
use super::hinge::Hinges;
use super::meet::{Exempt, lay_flat};
use super::points::{Coordinates, Points};
use super::rest::Rest;
use super::seam::Seams;
use super::sheet::Sheet;
use super::stick::Span;
use super::tether::{Tethers, distances_along};
use super::tile::{Bounds, Tile, tiles_of_grid, tiles_of_run};
use crate::body::{Body, Deformable, Stretch};
use crate::constraint::Stick;
use crate::particles::Particles;
use crate::simd::{LANES, Lanes};

/// Soft solids are not kept from themselves where they were nearer than this, in the distances they are kept: what lies
/// between holds them apart.
const SQUEEZE: f32 = 2.0;

/// A cloth, rope or soft solid that is awake.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// The body's index in the world.
    pub(super) body: usize,
    pub(super) layout: Layout,
    pub(super) places: Range<usize>,
    /// By particle of the body, its place.
    placed: Vec<u32>,
    pub(super) tiles: Vec<Tile>,
    /// Around each tile, in m, with what was there when they were last made.
    pub(super) boxes: Vec<Bounds>,
    /// Which particles are held.
    held: Vec<u32>,
    pub(super) friction: f32,
    /// Of a particle of mean mass, in 1/kg.
    pub(super) mean_inverse_mass: f32,
    pub(super) rest: Rest,
    pub(super) tethers: Tethers,
    pub(super) hinges: Hinges,
    /// Sticks that give, before those that do not.
    pub(super) elastic: Batches,
    /// Whether something in it depends on how long a small step is.
    pub(super) is_elastic: bool,
    pub(super) seams: Seams,
    pub(super) sail: Option<Sail>,
    pub(super) balloon: Option<Balloon>,
    /// How far particles are kept from solids, in m.
    pub(super) thickness: f32,
    /// How far a particle may go in a small step, in m.
    pub(super) longest_motion: f32,
    /// How far the fastest particle went in the last small step, in m.
    pub(super) fastest: f32,
    /// By what factor a rope is wound in this step.
    pub(super) winding: Option<f32>,
}

/// How the sticks of a piece are solved.
#[derive(Debug, Clone)]
pub(super) enum Layout {
    Sheet(Box<Sheet>),
    /// In any order.
    Loose(Batches),
    /// As tetrahedra instead.
    Solid(Elastic),
    /// With others, in a bundle.
    Rope,
    /// Segments in any order, last.
    Net(Batches),
}

impl Piece {
    pub(super) fn new(
        index: usize,
        body: &Body,
        deformable: &Deformable,
        particles: &Particles,
        start: usize,
        h: f32,
    ) -> Self {
        let count = body.particles.len();
        let masses = &particles.mass[body.particles.clone()];
        let mean_inverse_mass = count as f32 / masses.iter().sum::<f32>();
        let (layout, places, tiles) = match &deformable.grid {
            Some(shape) => {
                let grid = Grid::new(start, shape.columns as usize, shape.rows as usize);
                let [along, down] = shape.edges;
                let across = (along * along + down * down).sqrt();
                let weave = [along, down, across].map(|length| span_of(length, 0.0));
                let bending = deformable.rigidity.map(|rigidity| bending_of(rigidity, shape.edges, h));
                let sheet = Sheet::new(grid, weave, bending, mean_inverse_mass);
                (Layout::Sheet(Box::new(sheet)), grid.places(), tiles_of_grid(&grid))
            }
            None => {
                let places = start..start + count.next_multiple_of(LANES);
                let layout = match (&deformable.flesh, deformable.is_rope(), deformable.is_chain()) {
                    (Some(flesh), ..) => Layout::Solid(Elastic::new(flesh, masses, start)),
                    (None, false, _) => Layout::Loose(stiff_sticks(deformable, start)),
                    (None, true, false) => Layout::Net(sticks_of_net(deformable, start, h)),
                    (None, true, true) => Layout::Rope,
                };
                (layout, places.clone(), tiles_of_run(places))
            }
        };
        let boxes = vec![Bounds::EMPTY; tiles.len()];
        let mut piece = Self {
            body: index,
            layout,
            places,
            placed: Vec::new(),
            tiles,
            boxes,
            held: Vec::new(),
            friction: body.surface.friction,
            mean_inverse_mass,
            rest: Rest::default(),
            tethers: Tethers::default(),
            hinges: Hinges::default(),
            elastic: Batches::new(&[]),
            is_elastic: deformable.rigidity.is_some() || deformable.fabric.stretch.is_some(),
            seams: Seams::default(),
            sail: None,
            balloon: None,
            thickness: deformable.thickness,
            longest_motion: f32::MAX,
            fastest: 0.0,
            winding: None,
        };
        piece.placed = (0..count).map(|particle| piece.find_place(particle) as u32).collect();
        piece.dress(deformable, start, h);
        piece.tie(body, deformable, particles);
        piece
    }

    /// What is not of every cloth and rope: hinges, sticks that give, air, gas and seams.
    fn dress(&mut self, deformable: &Deformable, start: usize, h: f32) {
        let Deformable { angles, bendings, triangles, fabric, .. } = deformable;
        self.hinges =
            Hinges::new(angles, bendings, fabric.bends_by_stiffness, |particle| self.place(particle));
        let place = |corner: u32| self.place(corner as usize) as u32;
        let placed = || triangles.iter().map(|triangle| triangle.map(place)).collect::<Vec<_>>();
        let sail = fabric.air.map(|air| Sail::new(placed(), air, self.places.clone()));
        let balloon = fabric.gas.map(|gas| Balloon::new(placed(), gas, self.places.clone()));
        let seams = Seams::new(&fabric.seams, |particle| self.place(particle));
        (self.sail, self.balloon, self.seams) = (sail, balloon, seams);
        if let Layout::Loose(_) = self.layout {
            self.elastic = elastic_sticks(deformable, start, self.mean_inverse_mass, h);
        }
    }

    /// The place of a particle of the body.
    #[inline(always)]
    pub(super) fn place(&self, particle: usize) -> usize {
        self.placed[particle] as usize
    }

    /// The places of all particles of the body, in their order.
    pub(super) fn in_order(&self) -> impl Iterator<Item = usize> {
        self.placed.iter().map(|&place| place as usize)
    }

    fn find_place(&self, particle: usize) -> usize {
        match &self.layout {
            Layout::Sheet(sheet) => {
                sheet.grid.place(particle / sheet.grid.columns, particle % sheet.grid.columns)
            }
            Layout::Loose(_) | Layout::Solid(_) | Layout::Rope | Layout::Net(_) => {
                self.places.start + particle
            }
        }
    }

    /// Ties particles to those that are held, if these have changed.
    pub(super) fn tie(&mut self, body: &Body, deformable: &Deformable, particles: &Particles) {
        let masses = &particles.inverse_mass[body.particles.clone()];
        let held: Vec<u32> =
            (0..).zip(masses).filter(|(_, w)| **w == 0.0).map(|(particle, _)| particle).collect();
        if held == self.held {
            return;
        }
        self.held = held;
        if let Layout::Solid(_) | Layout::Rope = self.layout {
            // The one may stretch, the other is solved from end to end.
            return;
        }
        let count = body.particles.len();
        let longest = deformable.fabric.stretch.as_ref().map_or(1.0, Stretch::longest);
        let along = |from: u32| match &deformable.grid {
            Some(grid) => grid.distances(from),
            None => distances_along(&deformable.sticks, count, from),
        };
        // What may be pulled to any length is tied to nothing.
        let distances = |from: u32| {
            let mut distances = along(from);
            distances.iter_mut().for_each(|distance| *distance *= longest);
            distances
        };
        self.tethers = Tethers::new(&self.held, count, distances, |particle| self.place(particle));
    }

    /// Whether it is a rope or net, and no cloth.
    pub(super) fn is_rope(&self) -> bool {
        matches!(self.layout, Layout::Rope | Layout::Net(_))
    }

    pub(super) fn is_held(&self) -> bool {
        !self.held.is_empty()
    }

    /// Which of its particles are too near in the material to push each other when they are kept `distance` (m) apart.
    pub(super) fn exempt(
        &self,
        deformable: &Deformable,
        distance: f32,
        material: &mut Coordinates,
    ) -> Exempt {
        if let (Layout::Sheet(sheet), Some(shape)) = (&self.layout, &deformable.grid) {
            lay_flat(&sheet.grid, shape.edges, material);
            return Exempt::of_sheet(distance, shape.edges);
        }
        if let Some(flesh) = &deformable.flesh {
            let count = flesh.edges.iter().map(|edge| edge.a.max(edge.b) as usize + 1).max().unwrap_or(0);
            return Exempt::along(&flesh.edges, count, self.places.start, distance * SQUEEZE);
        }
        let seams = deformable.fabric.seams.iter().map(|seam| Stick { rest_length: 0.0, ..*seam });
        let sticks: Vec<Stick> = deformable.sticks.iter().copied().chain(seams).collect();
        Exempt::along(&sticks, self.places.len(), self.places.start, distance * 1.2)
    }

    /// Brings the boxes around tiles up to date.
    #[inline(always)]
    pub(super) fn fit_boxes<L: Lanes>(&mut self, points: &Points) {
        for (bounds, tile) in self.boxes.iter_mut().zip(&self.tiles) {
            *bounds = tile.bounds::<L>(points);
        }
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.boxes.iter().fold(Bounds::EMPTY, |all, bounds| all.with(*bounds))
    }
}

/// The sticks of a net, by place.
fn sticks_of_net(net: &Deformable, start: usize, h: f32) -> Batches {
    let start = start as u32;
    let placed = |(stick, span): (&Stick, Span)| ([stick.a + start, stick.b + start], span);
    let sticks: Vec<_> = net.sticks.iter().zip(super::spans_of_rope(net, h)).map(placed).collect();
    Batches::new(&sticks)
}

/// The sticks of a mesh that do not give, or not beyond their limit.
fn stiff_sticks(cloth: &Deformable, start: usize) -> Batches {
    let start = start as u32;
    let span = |length: f32| match &cloth.fabric.stretch {
        None => Some(span_of(length, 0.0)),
        Some(Stretch { limit: None, .. }) => None,
        Some(stretch) => {
            let low = if stretch.compliances.is_some() { 0.0 } else { length };
            Some(Span { low, high: length * stretch.longest(), compliance: 0.0 })
        }
    };
    let placed =
        |stick: &Stick| span(stick.rest_length).map(|span| ([stick.a + start, stick.b + start], span));
    Batches::new(&cloth.sticks.iter().filter_map(placed).collect::<Vec<_>>())
}

/// The sticks of a mesh that give, in small steps of `h` (s).
///
/// Of the sticks around a particle, those swept first see where the forces have taken it, and those swept last where the
/// first have pulled it back to. On the mean a stick finds half of that and gives by the compliance it has and the inverse
/// mass of a particle: so much is taken off beforehand.
fn elastic_sticks(cloth: &Deformable, start: usize, mean_inverse_mass: f32, h: f32) -> Batches {
    let stretch = cloth.fabric.stretch.as_ref();
    let Some(compliances) = stretch.and_then(|stretch| stretch.compliances.as_ref()) else {
        return Batches::new(&[]);
    };
    let start = start as u32;
    let placed = |(stick, compliance): (&Stick, &f32)| {
        let compliance = (compliance / (h * h) - mean_inverse_mass).max(0.0);
        ([stick.a + start, stick.b + start], span_of(stick.rest_length, compliance))
    };
    Batches::new(&cloth.sticks.iter().zip(compliances).map(placed).collect::<Vec<_>>())
}

pub(super) fn span_of(length: f32, compliance: f32) -> Span {
    Span { low: length, high: length, compliance }
}

/// α/h² of bending along rows and along columns, with an h² of a small step times the two from one time to the next.
/// At each inner particle a strip as wide as a cell bends: k = B b/e, α = e²/k.
fn bending_of(rigidity: f32, [along, down]: [f32; 2], h: f32) -> [f32; 2] {
    let compliance = |edge: f32, width: f32| edge * edge * edge / (rigidity * width) / (2.0 * h * h);
    [compliance(along, down), compliance(down, along)]
}

#[cfg(test)]
#[path = "tests/piece.rs"]
mod tests;
