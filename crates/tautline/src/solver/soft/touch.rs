//! Where particles may touch what is solid, eight at a time: found every few small steps as planes, solved in each.
//!
//! A particle is kept at its cloth's thickness, or its rope's radius, from a plane with the normal of the nearest place
//! of a solid. The plane is on the side that the particle was on when it was found, so that nothing gets through however
//! thin; it moves with the solid.

use glam::{Mat3, Vec3};

use super::points::{PointSlices, Points};
use super::probe::{Facet, Form, Probe, probe_triangles};
use super::solid::{Matter, Solid, Stance, part_bounds};
use super::tile::{Bounds, Tile, within};
use crate::norm::Norm;
use crate::shape::Surface;
use crate::simd::{LANES, Lanes, Matrix3x8, Row, Vec3x8, column, read};

/// Eight particles and the planes they are kept above.
#[derive(Debug, Clone)]
pub(super) struct Touch {
    /// The first place.
    place: u32,
    /// The solid's number.
    pub(super) solid: u32,
    /// The piece's number.
    pub(super) piece: u32,
    friction: f32,
    normal: [Row; 3],
    /// normal · x of a particle x that just touches, in m; −∞ where there is nothing to touch.
    offset: Row,
    /// How the place of the solid that is touched moves in a small step without what is done to it, in m.
    motion: [Row; 3],
    /// Where that place is from the solid's centre of mass, in m.
    arm: [Row; 3],
    /// Small steps since it was found.
    age: f32,
    /// How far the solid was from its course then.
    astray: (Vec3, Vec3),
}

/// What of a cloth or rope touches solids.
#[derive(Debug, Clone, Copy)]
pub(super) struct Skin {
    /// The piece's number.
    pub(super) piece: u32,
    /// How far particles are kept from solids, in m.
    pub(super) thickness: f32,
    /// Beyond that, how far ahead contacts are found, in m.
    pub(super) margin: f32,
    pub(super) friction: f32,
}

/// Finds the touches of some tiles with a solid.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn find<L: Lanes>(
    (tiles, boxes): (&[Tile], &[Bounds]),
    points: &Points,
    (number, solid, stance): (usize, &Solid<'_>, &Stance),
    skin: Skin,
    out: &mut Vec<Touch>,
) {
    let finder = Finder { points, stance, number: number as u32, skin, astray: solid.astray() };
    let reach = skin.thickness + skin.margin;
    match &solid.matter {
        Matter::HalfSpace(normal, offset) => {
            for (tile, bounds) in tiles.iter().zip(boxes) {
                let corner = Vec3::select(normal.cmpgt(Vec3::ZERO), bounds.low, bounds.high);
                if normal.dot(corner) < offset + reach {
                    finder.tile::<L>(tile, Target::HalfSpace(*normal, *offset), 0.0, out);
                }
            }
        }
        Matter::Parts(parts) => {
            for (part, form) in parts {
                let near = part_bounds(part, stance).grown(reach);
                for (tile, _) in tiles.iter().zip(boxes).filter(|(_, bounds)| near.meets(bounds)) {
                    finder.tile::<L>(tile, Target::Form(form, &near), part.convex.radius, out);
                }
            }
        }
        Matter::Surface(surface) => {
            let mut triangles = Triangles::default();
            for (tile, bounds) in tiles.iter().zip(boxes) {
                triangles.near(surface, stance, &bounds.grown(reach));
                if !triangles.facets.is_empty() {
                    finder.tile::<L>(tile, Target::Triangles(&triangles.facets), 0.0, out);
                }
            }
        }
    }
}

/// The triangles near a tile.
#[derive(Default)]
struct Triangles {
    numbers: Vec<u32>,
    facets: Vec<Facet>,
}

impl Triangles {
    fn near(&mut self, surface: &Surface, stance: &Stance, bounds: &Bounds) {
        let (middle, half) = ((bounds.low + bounds.high) * 0.5, (bounds.high - bounds.low) * 0.5);
        let axes = stance.axes.transpose();
        let extent = axes.x_axis.abs() * half.x + axes.y_axis.abs() * half.y + axes.z_axis.abs() * half.z;
        let center = stance.to_local(middle);
        surface.triangles_in(center - extent, center + extent, &mut self.numbers);
        self.facets.clear();
        let corners = self.numbers.iter().map(|&number| surface.triangle(number).corners);
        self.facets.extend(corners.map(Facet::new));
    }
}

/// What eight particles are compared with.
#[derive(Clone, Copy)]
enum Target<'a> {
    HalfSpace(Vec3, f32),
    /// What is not in the box is too far away.
    Form(&'a Form<'a>, &'a Bounds),
    Triangles(&'a [Facet]),
}

struct Finder<'a> {
    points: &'a Points,
    stance: &'a Stance,
    number: u32,
    skin: Skin,
    astray: (Vec3, Vec3),
}

impl Finder<'_> {
    #[inline(always)]
    fn tile<L: Lanes>(&self, tile: &Tile, target: Target<'_>, radius: f32, out: &mut Vec<Touch>) {
        for &place in &tile.eights {
            self.eight::<L>(place, target, radius, out);
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn eight<L: Lanes>(&self, place: u32, target: Target<'_>, radius: f32, out: &mut Vec<Touch>) {
        let at = self.points.eight_at::<L>(place as usize);
        let from_center = at - Vec3x8::splat(self.stance.center);
        let reach = self.skin.thickness + self.skin.margin;
        let probe = match target {
            Target::HalfSpace(normal, offset) => {
                let normal = Vec3x8::splat(normal);
                Probe { distance: at.dot(normal) - L::splat(offset), normal }
            }
            Target::Form(_, near) if within(at, near) == 0 => return,
            Target::Form(form, _) => self.turned(form.probe(self.local(from_center), reach + radius)),
            Target::Triangles(facets) => self.turned(probe_triangles(self.local(from_center), facets, reach)),
        };
        let distance = probe.distance - L::splat(radius);
        let is_near = L::splat(reach).greater(distance).and(self.points.are_there::<L>(place as usize));
        if is_near.bits() == 0 {
            return;
        }
        let arm = from_center - probe.normal * distance;
        let motion = Vec3x8::splat(self.stance.linear) + Vec3x8::splat(self.stance.angular).cross(arm);
        let height = at.dot(probe.normal) - distance + L::splat(self.skin.thickness);
        let mut touch = Touch {
            place,
            solid: self.number,
            piece: self.skin.piece,
            friction: self.skin.friction,
            normal: [Row::ZERO; 3],
            offset: Row::ZERO,
            motion: [Row::ZERO; 3],
            arm: [Row::ZERO; 3],
            age: 0.0,
            astray: self.astray,
        };
        probe.normal.store(&mut touch.normal);
        motion.store(&mut touch.motion);
        arm.store(&mut touch.arm);
        is_near.select(height, L::splat(f32::NEG_INFINITY)).store(&mut touch.offset);
        out.push(touch);
    }

    #[inline(always)]
    fn local<L: Lanes>(&self, from_center: Vec3x8<L>) -> Vec3x8<L> {
        lanes_of(&self.stance.axes).apply_transposed(from_center)
    }

    #[inline(always)]
    fn turned<L: Lanes>(&self, probe: Probe<L>) -> Probe<L> {
        Probe { normal: lanes_of(&self.stance.axes).apply(probe.normal), ..probe }
    }
}

#[inline(always)]
fn lanes_of<L: Lanes>(axes: &Mat3) -> Matrix3x8<L> {
    Matrix3x8([Vec3x8::splat(axes.x_axis), Vec3x8::splat(axes.y_axis), Vec3x8::splat(axes.z_axis)])
}

/// How contacts push.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push {
    /// The most by which particles that were already too deep are moved out in a small step, in m.
    pub(super) recovery: f32,
    /// Small steps of the substep that are still to come.
    pub(super) left: f32,
}

impl Touch {
    pub(super) fn place(&self) -> usize {
        self.place as usize
    }

    /// Lets a particle through, if it is one of its own.
    pub(super) fn exempt(&mut self, place: usize) {
        if let Some(offset) = place.checked_sub(self.place()).and_then(|lane| self.offset.0.get_mut(lane)) {
            *offset = f32::NEG_INFINITY;
        }
    }

    /// Moves its particles out of what it is about, with friction (Coulomb's law on displacements: the tangential one of
    /// this small step is taken back, by at most μ times what is corrected along the normal). Tells
    /// whether it has touched.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn solve<L: Lanes>(
        &mut self,
        points: &mut PointSlices<'_>,
        solid: &mut Solid<'_>,
        push: Push,
    ) -> bool {
        self.age += 1.0;
        self.solve_again::<L>(points, solid, push)
    }

    /// As [`Touch::solve`], once more in the same small step.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn solve_again<L: Lanes>(
        &self,
        points: &mut PointSlices<'_>,
        solid: &mut Solid<'_>,
        push: Push,
    ) -> bool {
        let place = self.place as usize;
        if !points.has_eight_at(place) {
            return false;
        }
        let normal = Vec3x8::<L>::load(&self.normal);
        let carried = Vec3x8::<L>::load(&self.motion);
        let mut offset = L::load(&self.offset) + normal.dot(carried) * L::splat(self.age);
        if solid.inverse_mass > 0.0 {
            offset = offset + normal.dot(self.astray_by(solid));
        }
        let at = points.eight_at::<L>(place);
        let depth = offset - at.dot(normal);
        let free = read::<L>(points.inverse_mass, place);
        let zero = L::splat(0.0);
        let hits = depth.greater(zero).and(free.greater(zero));
        if hits.bits() == 0 {
            return false;
        }
        let slip = points.motion_of_eight(place) - carried;
        let along = slip.dot(normal);
        let depth = hits.and(depth.min((-along).max(zero) + L::splat(push.recovery)));
        if solid.inverse_mass > 0.0 {
            self.share(points, solid, depth, slip - normal * along, push.left);
            return true;
        }
        let across = slip - normal * along;
        let length = across.length_squared().max(L::splat(1e-24)).sqrt();
        let grip = (depth * L::splat(self.friction) / length).min(L::splat(1.0));
        points.shift_eight(place, normal * depth - across * hits.and(grip));
        true
    }

    /// How far the places that are touched have been moved from their course since they were found.
    #[inline(always)]
    fn astray_by<L: Lanes>(&self, solid: &Solid<'_>) -> Vec3x8<L> {
        let (shift, turn) = solid.astray();
        let arm = Vec3x8::<L>::load(&self.arm);
        Vec3x8::splat(shift - self.astray.0) + Vec3x8::splat(turn - self.astray.1).cross(arm)
    }

    /// As [`Touch::solve`] for a solid that is moved in turn: particle after particle. Both are pushed where the particle is,
    /// a thickness from the surface, so that together they turn nothing. `slip` is against the course that the solid was
    /// found on.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn share<L: Lanes>(
        &self,
        points: &mut PointSlices<'_>,
        solid: &mut Solid<'_>,
        depth: L,
        slip: Vec3x8<L>,
        left: f32,
    ) {
        let (mut depths, mut slips) = (Row::ZERO, [Row::ZERO; 3]);
        depth.store(&mut depths);
        slip.store(&mut slips);
        let (shift, turn) = solid.astray();
        for lane in (0..LANES).filter(|&lane| depths.0[lane] > 0.0) {
            let place = self.place as usize + lane;
            let (normal, arm) = (column(&self.normal, lane), points.begun_at(place) - solid.begun_at(left));
            let (shift_now, turn_now) = solid.astray();
            // What the particles before it did to the solid.
            let given_way = (shift_now - shift) + (turn_now - turn).cross(arm);
            let depth = depths.0[lane] + given_way.dot(normal);
            if depth <= 0.0 {
                continue;
            }
            let mass = points.inverse_mass[place];
            let mobility = |direction: Vec3| {
                let turned = arm.cross(direction);
                mass + solid.inverse_mass + turned.dot(solid.inverse_inertia * turned)
            };
            let pressure = depth / mobility(normal);
            let slip = column(&slips, lane);
            let length = slip.norm();
            let mut impulse = normal * pressure;
            if length > 1e-12 {
                let direction = slip / length;
                impulse -= direction * (length / mobility(direction)).min(self.friction * pressure);
            }
            points.shift(place, impulse * mass);
            solid.push(-impulse, arm);
        }
    }
}

#[cfg(test)]
#[path = "tests/touch.rs"]
mod tests;
