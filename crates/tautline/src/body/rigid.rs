//! Rigid bodies of four particles.
//!
//! Any rigid body has the motion of four equal masses at s∘tᵢ in its principal frame, with t = (1, 1, 1),
//! (1, −1, −1), (−1, 1, −1), (−1, −1, 1) and sₖ = √(Cₖ/M), Cₖ = ∫ xₖ² dm (Routh's equimomental system;
//! Laus & Selig 2020, Acta Mechanica). Mass, centre and inertia are exact, and the particles are all that is stored of
//! its motion.

use std::sync::Arc;

use glam::{DMat3, DVec3, Mat3, Quat, Vec3};
use serde::{Deserialize, Serialize};

use super::surface::{Combine, Surface};
use crate::error::{Error, coordinates, within};
use crate::norm::Norm;
use crate::shape::Shape;

/// tᵢ: where the particles are in the principal frame, in units of s.
pub(crate) const CORNERS: [Vec3; 4] = [
    Vec3::new(1.0, 1.0, 1.0),
    Vec3::new(1.0, -1.0, -1.0),
    Vec3::new(-1.0, 1.0, -1.0),
    Vec3::new(-1.0, -1.0, 1.0),
];

/// What moves a rigid body.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Motion {
    /// Forces and contacts.
    #[default]
    Dynamic,
    /// Its velocity alone, as set: it pushes others and nothing pushes it.
    Kinematic,
    /// Nothing.
    Fixed,
}

/// Which bodies collide: two do if each is a member of a group that the other collides with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CollisionGroups {
    /// One bit for each group the body belongs to.
    pub memberships: u32,
    /// One bit for each group it collides with.
    pub filter: u32,
}

impl Default for CollisionGroups {
    /// Member of all groups, colliding with all.
    fn default() -> Self {
        Self { memberships: u32::MAX, filter: u32::MAX }
    }
}

impl CollisionGroups {
    /// Whether bodies of these groups collide.
    pub fn collide_with(self, other: Self) -> bool {
        self.memberships & other.filter != 0 && other.memberships & self.filter != 0
    }
}

/// A rigid body to be added to a world: a shape, how heavy it is, where it starts and how it moves.
///
/// ```
/// use std::sync::Arc;
/// use tautline::{HalfSpace, RigidBody, Settings, Shape, Vec3, World};
///
/// let mut world = World::new(Settings::default())?;
/// world.add(HalfSpace::floor(0.0))?;
/// let ball = Arc::new(Shape::sphere(0.5)?);
/// let ball = world.add(RigidBody::new(&ball).mass(2.0).position(Vec3::Y * 3.0).restitution(0.8))?;
/// for _ in 0..60 {
///     world.step(1.0 / 60.0)?;
/// }
/// assert!(world.body(ball)?.velocity().y > 0.0, "it has bounced");
/// # Ok::<(), tautline::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBody {
    pub(crate) shape: Arc<Shape>,
    pub(crate) weight: Weight,
    pub(crate) position: Vec3,
    pub(crate) rotation: Quat,
    pub(crate) velocity: Vec3,
    pub(crate) angular_velocity: Vec3,
    pub(crate) traits: Traits,
    pub(crate) surface: Surface,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Weight {
    Mass(f32),
    Density(f32),
}

/// What distinguishes rigid bodies of one shape, besides their surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Traits {
    pub(crate) motion: Motion,
    pub(crate) gravity_scale: f32,
    /// In 1/s.
    pub(crate) linear_damping: f32,
    /// In 1/s.
    pub(crate) angular_damping: f32,
    pub(crate) groups: CollisionGroups,
    pub(crate) can_sleep: bool,
    pub(crate) reports_contacts: bool,
}

impl RigidBody {
    /// A body of this shape at the origin, at rest, of 1000 kg/m³, friction 0.5 and no restitution.
    pub fn new(shape: &Arc<Shape>) -> Self {
        let traits = Traits {
            motion: Motion::Dynamic,
            gravity_scale: 1.0,
            linear_damping: 0.0,
            angular_damping: 0.0,
            groups: CollisionGroups::default(),
            can_sleep: true,
            reports_contacts: false,
        };
        Self {
            shape: Arc::clone(shape),
            weight: Weight::Density(1000.0),
            position: Vec3::ZERO,
            rotation: Quat::IDENTITY,
            velocity: Vec3::ZERO,
            angular_velocity: Vec3::ZERO,
            traits,
            surface: Surface::default(),
        }
    }

    /// Where the origin of the shape's frame is, in m.
    pub fn position(self, position: Vec3) -> Self {
        Self { position, ..self }
    }

    /// Rotation from the shape's frame to the world; normalised when added.
    pub fn rotation(self, rotation: Quat) -> Self {
        Self { rotation, ..self }
    }

    /// Velocity of the centre of mass, in m/s.
    pub fn velocity(self, velocity: Vec3) -> Self {
        Self { velocity, ..self }
    }

    /// Angular velocity, in rad/s, in the world's frame.
    pub fn angular_velocity(self, angular_velocity: Vec3) -> Self {
        Self { angular_velocity, ..self }
    }

    /// Mass, in kg, spread evenly over the shape's volume.
    pub fn mass(self, mass: f32) -> Self {
        Self { weight: Weight::Mass(mass), ..self }
    }

    /// Density, in kg/m³.
    pub fn density(self, density: f32) -> Self {
        Self { weight: Weight::Density(density), ..self }
    }

    /// Coulomb's coefficient of friction.
    pub fn friction(mut self, friction: f32) -> Self {
        self.surface.friction = friction;
        self
    }

    /// Speed apart over speed together of a collision, 0 to 1.
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.surface.restitution = restitution;
        self
    }

    /// How far, in m, the normal force acts in front of the point of contact when it rolls; 0 = it rolls freely.
    pub fn rolling_friction(mut self, rolling_friction: f32) -> Self {
        self.surface.rolling_friction = rolling_friction;
        self
    }

    /// How friction and restitution combine with those of what it touches.
    pub fn combine(mut self, friction: Combine, restitution: Combine) -> Self {
        self.surface.friction_rule = friction;
        self.surface.restitution_rule = restitution;
        self
    }

    /// The whole surface at once.
    pub fn surface(self, surface: Surface) -> Self {
        Self { surface, ..self }
    }

    /// Never moves.
    pub fn fixed(mut self) -> Self {
        self.traits.motion = Motion::Fixed;
        self
    }

    /// Moves by its velocity alone, pushing others and pushed by none.
    pub fn kinematic(mut self) -> Self {
        self.traits.motion = Motion::Kinematic;
        self
    }

    /// How many times the world's gravity acts on it.
    pub fn gravity_scale(mut self, gravity_scale: f32) -> Self {
        self.traits.gravity_scale = gravity_scale;
        self
    }

    /// Rates at which its motion and its rotation die out, in 1/s: v' = v/(1 + damping·h).
    pub fn damping(mut self, linear: f32, angular: f32) -> Self {
        self.traits.linear_damping = linear;
        self.traits.angular_damping = angular;
        self
    }

    /// Which bodies it collides with.
    pub fn groups(mut self, groups: CollisionGroups) -> Self {
        self.traits.groups = groups;
        self
    }

    /// It is never put to sleep.
    pub fn never_sleep(mut self) -> Self {
        self.traits.can_sleep = false;
        self
    }

    /// It reports what it touches: [`World::contact_events`](crate::World::contact_events).
    pub fn report_contacts(mut self) -> Self {
        self.traits.reports_contacts = true;
        self
    }

    /// Checks everything and finds the mass.
    pub(crate) fn build(&self) -> Result<Rigid, Error> {
        coordinates("position", self.position)?;
        coordinates("velocity", self.velocity)?;
        coordinates("angular_velocity", self.angular_velocity)?;
        let length_squared = self.rotation.length_squared();
        within("rotation", length_squared, 1e-6, 1e6, "a quaternion with a length near 1")?;
        self.surface.validate()?;
        self.traits.validate()?;
        let dynamic = self.traits.motion == Motion::Dynamic;
        if dynamic && self.shape.volume() <= 0.0 {
            let problem = "has no volume: a mesh or height field can only be fixed or kinematic".into();
            return Err(Error::Invalid { field: "shape".into(), problem });
        }
        let mass = match self.weight {
            Weight::Mass(mass) => within("mass", mass, 1e-20, 1e20, "a mass from 1e-20 to 1e20 (kg)")?,
            Weight::Density(density) => {
                within("density", density, 1e-20, 1e20, "a density from 1e-20 to 1e20 (kg/m³)")?;
                let mass = density * self.shape.volume();
                if dynamic {
                    within(
                        "density",
                        mass,
                        1e-20,
                        1e20,
                        "a density that gives a mass from 1e-20 to 1e20 kg",
                    )?;
                }
                mass
            }
        };
        // What does not move by it may be as large as it likes, or without volume.
        let mass = mass.clamp(1e-20, 1e20);
        Ok(Rigid { shape: Arc::clone(&self.shape), mass, traits: self.traits })
    }

    /// Its frame at the start.
    pub(crate) fn frame(&self) -> Frame {
        Frame::of_shape(&self.shape, self.position, self.rotation.normalize())
    }
}

impl Traits {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        within("gravity_scale", self.gravity_scale, -1e6, 1e6, "a number from -1e6 to 1e6")?;
        within("damping.linear", self.linear_damping, 0.0, 1e6, "a rate from 0 to 1e6 (1/s)")?;
        within("damping.angular", self.angular_damping, 0.0, 1e6, "a rate from 0 to 1e6 (1/s)")?;
        Ok(())
    }
}

/// A rigid body in a world, besides its particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rigid {
    /// Shared between bodies; a snapshot stores each once, beside the bodies.
    #[serde(skip, default = "Shape::placeholder")]
    pub(crate) shape: Arc<Shape>,
    /// In kg; of what is not dynamic what it would be, within 1e-20 to 1e20.
    pub(crate) mass: f32,
    pub(crate) traits: Traits,
}

impl Rigid {
    /// sₖ, in m: how far the particles are from the centre along the principal axes.
    pub(crate) fn spread(&self) -> Vec3 {
        match self.traits.motion {
            Motion::Dynamic => {
                let moments = self.shape.second_moments();
                Vec3::new(moments.x.sqrt(), moments.y.sqrt(), moments.z.sqrt())
            }
            // They carry a pose and no inertia.
            Motion::Kinematic | Motion::Fixed => Vec3::ONE,
        }
    }

    /// Principal moments of inertia per mass, in m².
    pub(crate) fn inertia_per_mass(&self) -> Vec3 {
        let s = self.spread();
        let c = s * s;
        Vec3::new(c.y + c.z, c.z + c.x, c.x + c.y)
    }

    /// Moments of inertia about the principal axes, in kg m²; 0 for what is not solid.
    pub(crate) fn principal_moments(&self) -> Vec3 {
        let c = self.shape.second_moments();
        Vec3::new(c.y + c.z, c.z + c.x, c.x + c.y) * self.mass
    }

    /// Checks a body from untrusted bytes.
    pub(crate) fn validate(&self) -> Result<(), Error> {
        self.traits.validate()?;
        within("mass", self.mass, 1e-20, 1e20, "a mass from 1e-20 to 1e20 (kg)").map(|_| ())
    }
}

/// Where a rigid body is: its centre of mass and its principal axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    /// In m.
    pub(crate) center: Vec3,
    /// From the principal frame to the world.
    pub(crate) axes: Mat3,
}

impl Frame {
    /// The frame of a body whose shape's own frame is at `position`, turned by `rotation`.
    pub(crate) fn of_shape(shape: &Shape, position: Vec3, rotation: Quat) -> Self {
        let center = position + rotation * shape.center_of_mass();
        Self { center, axes: Mat3::from_quat(rotation * shape.principal_rotation()) }
    }

    /// The frame that four particles are in. So far from the origin that rounding leaves them in a plane, a line or a point,
    /// it is one of those that may have been.
    pub(crate) fn of_particles(x: &[Vec3]) -> Self {
        let center = (x[0] + x[1] + x[2] + x[3]) * 0.25;
        let (first, second) = ((x[0] + x[1]) - (x[2] + x[3]), (x[0] - x[1]) + (x[2] - x[3]));
        let unit = |v: Vec3| Some(v * (1.0 / v.norm())).filter(|unit| unit.is_finite());
        let e0 = unit(first).unwrap_or(Vec3::X);
        let e2 = unit(e0.cross(second)).unwrap_or_else(|| e0.any_orthonormal_vector());
        Self { center, axes: Mat3::from_cols(e0, e2.cross(e0), e2) }
    }

    /// Position and rotation of the shape's own frame.
    pub(crate) fn pose(&self, shape: &Shape) -> (Vec3, Quat) {
        let rotation = (Quat::from_mat3(&self.axes) * shape.principal_rotation().conjugate()).normalize();
        (self.center - rotation * shape.center_of_mass(), rotation)
    }

    /// The four particles, in m.
    pub(crate) fn particles(&self, spread: Vec3) -> [Vec3; 4] {
        CORNERS.map(|corner| self.center + self.axes * (corner * spread))
    }

    /// How a point of the body (in the world, m) is put together from the four particles:
    /// wᵢ = ¼ (1 + Σₖ pₖ tᵢₖ / sₖ) with p the point in the principal frame.
    pub(crate) fn weights(&self, point: Vec3, spread: Vec3) -> [f32; 4] {
        let local = self.axes.transpose() * (point - self.center) / spread;
        CORNERS.map(|corner| 0.25 * (1.0 + local.dot(corner)))
    }
}

/// The motion of four particles as a rigid one: the velocity of their centre and the angular velocity, in the units
/// of their displacements.
pub(crate) fn rigid_motion(frame: &Frame, x: &[Vec3], d: &[Vec3], inertia_per_mass: Vec3) -> (Vec3, Vec3) {
    let linear = (d[0] + d[1] + d[2] + d[3]) * 0.25;
    let moment: Vec3 = x.iter().zip(d).map(|(x, d)| (*x - frame.center).cross(*d)).sum::<Vec3>() * 0.25;
    (linear, frame.axes * (frame.axes.transpose() * moment / inertia_per_mass))
}

/// The axes of four particles, and the moment of their displacements about their centre over their number, in m²:
/// `f64` adds no rounding to that of the particles.
pub(crate) fn exact_rotation(x: &[Vec3], d: &[Vec3]) -> (DMat3, DVec3) {
    let x: [DVec3; 4] = std::array::from_fn(|k| x[k].as_dvec3());
    let center = (x[0] + x[1] + x[2] + x[3]) * 0.25;
    let e0 = ((x[0] + x[1]) - (x[2] + x[3])).unit_or(DVec3::X);
    let across = e0.cross((x[0] - x[1]) + (x[2] - x[3]));
    let e2 = across.try_unit().unwrap_or_else(|| e0.any_orthonormal_vector());
    let moments = x.iter().zip(d).map(|(x, d)| (*x - center).cross(d.as_dvec3()));
    let moment = moments.fold(DVec3::ZERO, |sum, moment| sum + moment) * 0.25;
    (DMat3::from_cols(e0, e2.cross(e0), e2), moment)
}

/// Principal moments of inertia per mass of particles so far out, both in `f64`.
pub(crate) fn exact_inertia(spread: Vec3) -> DVec3 {
    let spread = spread.as_dvec3();
    let c = spread * spread;
    DVec3::new(c.y + c.z, c.z + c.x, c.x + c.y)
}
