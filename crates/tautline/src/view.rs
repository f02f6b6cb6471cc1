//! Looking at a body.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{Mat3, Quat, Vec3};

use crate::body::{
    Body, BodyKind, CollisionGroups, Frame, Motion, Substance, Surface, Truss, exact_inertia, exact_rotation,
    volume_of,
};
use crate::constraint::Stick;
use crate::error::Error;
use crate::particles::Particles;
use crate::shape::Shape;
use crate::world::{BodyHandle, World};

impl World {
    /// A body, to be looked at.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn body(&self, handle: BodyHandle) -> Result<BodyView<'_>, Error> {
        let index = self.slots.index(handle)?;
        Ok(BodyView { body: &self.bodies[index], particles: &self.particles })
    }
}

/// A body as it is now.
#[derive(Debug, Clone, Copy)]
pub struct BodyView<'a> {
    body: &'a Body,
    particles: &'a Particles,
}

impl<'a> BodyView<'a> {
    pub(crate) fn body(&self) -> &'a Body {
        self.body
    }

    /// What it is.
    pub fn kind(&self) -> BodyKind {
        self.body.kind()
    }

    /// Positions of its particles, in m; empty for a half-space. To draw it, see [`BodyView::surface_positions`].
    pub fn positions(&self) -> &'a [Vec3] {
        &self.particles.position[self.body.particles.clone()]
    }

    /// Inverse masses of its particles, in 1/kg; 0 = pinned.
    pub fn inverse_masses(&self) -> &'a [f32] {
        &self.particles.inverse_mass[self.body.particles.clone()]
    }

    /// The volume that it holds (m³) and the pressure in it (Pa over the surroundings), if it is a cloth filled with gas.
    fn gas(&self) -> Option<(f64, f64)> {
        let deformable = self.body.deformable()?;
        let gas = deformable.fabric.gas?;
        let volume = volume_of(&deformable.triangles, self.positions());
        Some((volume, gas.pressure_at(volume)))
    }

    /// The volume that a cloth with [gas](crate::Cloth::pressure) in it holds, in m³; `None` for all else.
    pub fn volume(&self) -> Option<f32> {
        self.gas().map(|(volume, _)| volume as f32)
    }

    /// The pressure in a cloth with [gas](crate::Cloth::pressure) in it, in Pa over the surroundings; `None` for all else.
    pub fn pressure(&self) -> Option<f32> {
        self.gas().map(|(_, pressure)| pressure as f32)
    }

    /// Velocity of a particle, in m/s: its mean over the last substep. Zero for one that is not there.
    pub fn particle_velocity(&self, particle: u32) -> Vec3 {
        let displacements = &self.particles.displacement[self.body.particles.clone()];
        displacements.get(particle as usize).map_or(Vec3::ZERO, |&d| d / self.body.displacement_time())
    }

    /// The vertices of its surface, in m, whatever it is: those of a rigid body's shape where it is now, for others
    /// their particles; empty for a half-space.
    pub fn surface_positions(&self) -> Cow<'a, [Vec3]> {
        match &self.body.substance {
            Substance::Rigid(rigid) => {
                let (position, rotation) = Frame::of_particles(self.positions()).pose(&rigid.shape);
                let rotation = Mat3::from_quat(rotation);
                rigid.shape.positions().iter().map(|&point| position + rotation * point).collect()
            }
            _ => Cow::Borrowed(self.positions()),
        }
    }

    /// The triangles of its surface over its [`BodyView::surface_positions`], counter-clockwise seen from outside;
    /// empty for ropes and half-spaces. Cloth that [tears](crate::Cloth::tear_at) has fewer of them then, in their order.
    pub fn triangles(&self) -> &'a [[u32; 3]] {
        match &self.body.substance {
            Substance::Rigid(rigid) => rigid.shape.triangles(),
            Substance::Truss { truss } => truss.triangles(),
            Substance::Deformable(deformable) => &deformable.triangles,
            Substance::HalfSpace(_) => &[],
        }
    }

    /// Its sticks, over its particles.
    pub fn sticks(&self) -> &'a [Stick] {
        match &self.body.substance {
            Substance::Truss { truss } => truss.sticks(),
            Substance::Deformable(deformable) => &deformable.sticks,
            Substance::Rigid(_) | Substance::HalfSpace(_) => &[],
        }
    }

    /// The tetrahedra of a soft solid, over its particles; those that were as good as flat are left out. Empty for others.
    pub fn tetrahedra(&self) -> &'a [[u32; 4]] {
        match &self.body.substance {
            Substance::Deformable(deformable) => {
                deformable.flesh.as_ref().map_or(&[], |flesh| &flesh.corners)
            }
            Substance::Rigid(_) | Substance::Truss { .. } | Substance::HalfSpace(_) => &[],
        }
    }

    /// Its shape, if it is a rigid body of four particles.
    pub fn shape(&self) -> Option<&'a Arc<Shape>> {
        self.body.rigid().map(|rigid| &rigid.shape)
    }

    /// Its shape, if it is a truss.
    pub fn truss(&self) -> Option<&'a Truss> {
        match &self.body.substance {
            Substance::Truss { truss } => Some(truss),
            Substance::Rigid(_) | Substance::Deformable(_) | Substance::HalfSpace(_) => None,
        }
    }

    /// Unit normal out of the solid and offset (m) along it, if it is a half-space.
    pub fn plane(&self) -> Option<(Vec3, f32)> {
        match &self.body.substance {
            Substance::HalfSpace(wall) => Some((wall.normal, wall.offset)),
            Substance::Rigid(_) | Substance::Truss { .. } | Substance::Deformable(_) => None,
        }
    }

    /// Of a rigid body, where the origin of its shape's frame is (m) and the rotation from there to the world. Of a
    /// truss, the mean of its particles and the rotation that best carries its rest positions into them.
    pub fn pose(&self) -> Option<(Vec3, Quat)> {
        match &self.body.substance {
            Substance::Rigid(rigid) => Some(Frame::of_particles(self.positions()).pose(&rigid.shape)),
            Substance::Truss { truss } => Some(truss.pose(self.positions())),
            Substance::Deformable(_) | Substance::HalfSpace(_) => None,
        }
    }

    /// Angular velocity in the world's frame, in rad/s, of a rigid body of four particles: its mean over the last
    /// substep. Zero for any other.
    pub fn angular_velocity(&self) -> Vec3 {
        let Substance::Rigid(rigid) = &self.body.substance else { return Vec3::ZERO };
        let displacements = &self.particles.displacement[self.body.particles.clone()];
        let (axes, moment) = exact_rotation(self.positions(), displacements);
        let turn = axes * (axes.transpose() * moment / exact_inertia(rigid.spread()));
        (turn / f64::from(self.body.displacement_time())).as_vec3()
    }

    /// Velocity of the body at a point (in the world, m), in m/s: of a rigid body that of its material point there, of
    /// others that of the nearest particle; zero for a half-space.
    pub fn velocity_at(&self, point: Vec3) -> Vec3 {
        if self.body.is_rigid() {
            return self.velocity() + self.angular_velocity().cross(point - self.center_of_mass());
        }
        let far = |i: &u32| self.positions()[*i as usize].distance_squared(point);
        let nearest = (0..self.positions().len() as u32).min_by(|i, j| far(i).total_cmp(&far(j)));
        nearest.map_or(Vec3::ZERO, |i| self.particle_velocity(i))
    }

    /// The moments of inertia of a rigid body about its principal axes, in kg m², ascending; 0 for what has no inside
    /// or is no rigid body.
    pub fn principal_moments(&self) -> Vec3 {
        self.body.rigid().map_or(Vec3::ZERO, |rigid| rigid.principal_moments())
    }

    /// The inertia tensor of a rigid body about its centre of mass, in the world's frame, in kg m²; 0 for what has no
    /// inside or is no rigid body.
    pub fn inertia(&self) -> Mat3 {
        if !self.body.is_rigid() {
            return Mat3::ZERO;
        }
        let axes = Frame::of_particles(self.positions()).axes;
        axes * Mat3::from_diagonal(self.principal_moments()) * axes.transpose()
    }

    /// Σ m x / Σ m, in m; the origin for a half-space.
    pub fn center_of_mass(&self) -> Vec3 {
        self.mean(|i| self.particles.position[i])
    }

    /// Σ m v / Σ m, in m/s.
    pub fn velocity(&self) -> Vec3 {
        self.mean(|i| self.particles.displacement[i]) / self.body.displacement_time()
    }

    /// Σ m, in kg; 0 for a half-space. Of a rigid body that is not dynamic what it would weigh.
    pub fn mass(&self) -> f32 {
        self.particles.mass[self.body.particles.clone()].iter().sum()
    }

    /// Friction, restitution and how they combine.
    pub fn surface(&self) -> Surface {
        self.body.surface
    }

    /// What moves it. Trusses, cloth and rope are dynamic unless they are fixed.
    pub fn motion(&self) -> Motion {
        match self.body.rigid() {
            Some(rigid) => rigid.traits.motion,
            None if self.body.fixed => Motion::Fixed,
            None => Motion::Dynamic,
        }
    }

    /// How many times the world's gravity acts on it.
    pub fn gravity_scale(&self) -> f32 {
        self.body.rigid().map_or(1.0, |rigid| rigid.traits.gravity_scale)
    }

    /// The rates at which the motion and the rotation of a rigid body die out, in 1/s; 0 for others, see
    /// [`Settings::damping`](crate::Settings::damping).
    pub fn damping(&self) -> [f32; 2] {
        self.body
            .rigid()
            .map_or([0.0; 2], |rigid| [rigid.traits.linear_damping, rigid.traits.angular_damping])
    }

    /// Which bodies it collides with; all, if it is no rigid body.
    pub fn groups(&self) -> CollisionGroups {
        self.body.rigid().map_or(CollisionGroups::default(), |rigid| rigid.traits.groups)
    }

    /// Coulomb's coefficient of friction.
    pub fn friction(&self) -> f32 {
        self.body.surface.friction
    }

    /// Whether it never moves.
    pub fn is_fixed(&self) -> bool {
        self.body.fixed
    }

    /// Whether it has been put to sleep.
    pub fn is_asleep(&self) -> bool {
        self.body.rest.asleep
    }

    fn mean(&self, of: impl Fn(usize) -> Vec3) -> Vec3 {
        let total = self.mass();
        if total == 0.0 {
            return Vec3::ZERO;
        }
        self.body.particles.clone().map(|i| of(i) * (self.particles.mass[i] / total)).sum()
    }
}
