//! Rigid bodies and half-spaces as cloth and rope see them during a substep.

use glam::{Mat3, Vec3};

use super::probe::Form;
use super::tile::Bounds;
use crate::body::{Body, Substance, Surface as Skin};
use crate::shape::{Part, Surface};
use crate::solver::substep::{Change, RigidSolver, rotation};

/// Something solid.
#[derive(Debug, Clone)]
pub(super) struct Solid<'a> {
    /// The body's index in the world.
    pub(super) body: usize,
    pub(super) skin: Skin,
    pub(super) matter: Matter<'a>,
    /// Centre of mass at the end of the substep, in m.
    center: Vec3,
    axes: Mat3,
    /// Motion in a small step, in m and rad, that it has without what is done to it here.
    linear: Vec3,
    angular: Vec3,
    /// 1/m, in 1/kg; 0 = nothing moves it.
    pub(super) inverse_mass: f32,
    /// In the world's frame, in 1/(kg m²).
    pub(super) inverse_inertia: Mat3,
    /// What has been done to it, of its motion in a small step.
    change: Change,
}

/// What it is made of, in its own frame.
#[derive(Debug, Clone)]
pub(super) enum Matter<'a> {
    Parts(Vec<(&'a Part, Form<'a>)>),
    Surface(&'a Surface),
    /// n and offset of n · x < offset.
    HalfSpace(Vec3, f32),
}

/// Where a solid is at some small step, and how it moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stance {
    pub(super) center: Vec3,
    pub(super) axes: Mat3,
    pub(super) linear: Vec3,
    pub(super) angular: Vec3,
}

impl Stance {
    pub(super) fn to_local(self, point: Vec3) -> Vec3 {
        self.axes.transpose() * (point - self.center)
    }
}

impl<'a> Solid<'a> {
    /// A body during a substep of so many small steps, if it is solid.
    pub(super) fn of(index: usize, body: &'a Body, rigid: &RigidSolver, small_steps: f32) -> Option<Self> {
        match &body.substance {
            Substance::HalfSpace(wall) => Some(Self::still(index, body, wall.normal, wall.offset)),
            Substance::Rigid(solid) => {
                let seen = rigid.see(index)?;
                let shape = &solid.shape;
                let matter = match shape.surface() {
                    Some(surface) => Matter::Surface(surface),
                    None => Matter::Parts(
                        shape.parts().iter().map(|part| (part, Form::of(&part.convex))).collect(),
                    ),
                };
                let inverse = seen.inverse_mass / seen.inertia_per_mass;
                Some(Self {
                    body: index,
                    skin: body.surface,
                    matter,
                    center: seen.center,
                    axes: seen.axes,
                    linear: seen.linear / small_steps,
                    angular: seen.angular / small_steps,
                    inverse_mass: seen.inverse_mass,
                    inverse_inertia: seen.axes * Mat3::from_diagonal(inverse) * seen.axes.transpose(),
                    change: Change::default(),
                })
            }
            Substance::Truss { .. } | Substance::Deformable(_) => None,
        }
    }

    fn still(body: usize, description: &Body, normal: Vec3, offset: f32) -> Self {
        Self {
            body,
            skin: description.surface,
            matter: Matter::HalfSpace(normal, offset),
            center: Vec3::ZERO,
            axes: Mat3::IDENTITY,
            linear: Vec3::ZERO,
            angular: Vec3::ZERO,
            inverse_mass: 0.0,
            inverse_inertia: Mat3::ZERO,
            change: Change::default(),
        }
    }

    /// Where it is when `left` small steps of the substep are still to come.
    pub(super) fn stance(&self, left: f32) -> Stance {
        let turn = self.change.turn - self.angular * left;
        Stance {
            center: self.center - self.linear * left + self.change.shift,
            axes: rotation(turn) * self.axes,
            linear: self.linear + self.change.linear,
            angular: self.angular + self.change.angular,
        }
    }

    /// How far it has been moved from its course by what is done to it: shift and turn.
    pub(super) fn astray(&self) -> (Vec3, Vec3) {
        (self.change.shift, self.change.turn)
    }

    /// Where its centre of mass was when the small step began after which `left` are still to come, in m. What pushes it
    /// and something else at one place must have both arms from then, or it would turn the two by different amounts.
    pub(super) fn begun_at(&self, left: f32) -> Vec3 {
        self.center - self.linear * (left + 1.0) + (self.change.shift - self.change.linear)
    }

    /// Gives it an impulse, in kg m in a small step, at an arm (m) from its centre: that moves it at once, and from then
    /// on in every small step.
    #[inline(always)]
    pub(super) fn push(&mut self, impulse: Vec3, arm: Vec3) {
        let (linear, angular) = (impulse * self.inverse_mass, self.inverse_inertia * arm.cross(impulse));
        self.change.linear += linear;
        self.change.angular += angular;
        self.change.shift += linear;
        self.change.turn += angular;
    }

    /// Begins a small step: what it has been given moves it on.
    pub(super) fn advance(&mut self) {
        self.change.shift += self.change.linear;
        self.change.turn += self.change.angular;
    }

    /// What the substep did to it, in units of a substep; `None` if nothing did.
    pub(super) fn outcome(&self, small_steps: f32) -> Option<Change> {
        let Change { linear, angular, .. } = self.change;
        let is_touched = linear != Vec3::ZERO || angular != Vec3::ZERO;
        is_touched.then(|| Change {
            linear: linear * small_steps,
            angular: angular * small_steps,
            ..self.change
        })
    }

    /// A box around it at a stance, in m; half-spaces have none.
    pub(super) fn bounds(&self, stance: &Stance) -> Option<Bounds> {
        match &self.matter {
            Matter::Parts(parts) => {
                Some(parts.iter().fold(Bounds::EMPTY, |all, (part, _)| all.with(part_bounds(part, stance))))
            }
            Matter::Surface(surface) => {
                let (low, high) = surface.bounds();
                Some(turned_box(low, high, stance))
            }
            Matter::HalfSpace(..) => None,
        }
    }
}

/// A box around a part, in m.
pub(super) fn part_bounds(part: &Part, stance: &Stance) -> Bounds {
    turned_box(part.low, part.high, stance)
}

/// A box around a turned box.
fn turned_box(low: Vec3, high: Vec3, stance: &Stance) -> Bounds {
    let (middle, half) = ((low + high) * 0.5, (high - low) * 0.5);
    let center = stance.center + stance.axes * middle;
    let [x, y, z] = [stance.axes.x_axis, stance.axes.y_axis, stance.axes.z_axis].map(Vec3::abs);
    let extent = x * half.x + y * half.y + z * half.z;
    Bounds { low: center - extent, high: center + extent }
}

#[cfg(test)]
#[path = "tests/solid.rs"]
mod tests;
