//! What all builders of joints have in common, and the check of what they describe.

use glam::{Mat3, Quat, Vec3};

use super::measure::LocalFrame;
use super::{BallJoint, DistanceJoint, FixedJoint, HingeJoint, Joint, Kind, SliderJoint, State, Strength};
use crate::body::{Body, Frame, Motion, Substance};
use crate::error::{Error, coordinates, positive, within};
use crate::norm::Norm;
use crate::world::{BodyHandle, World};

/// A joint to be added to a world: any of the builders turns into one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum JointDescription {
    /// Two points stay together.
    Ball(BallJoint),
    /// Two points and an axis stay together.
    Hinge(HingeJoint),
    /// Nothing moves.
    Fixed(FixedJoint),
    /// Only a shift along an axis is free.
    Slider(SliderJoint),
    /// Two points keep a distance.
    Distance(DistanceJoint),
}

macro_rules! describe {
    ($($builder:ident => $variant:ident),*) => {
        $(impl From<$builder> for JointDescription {
            fn from(builder: $builder) -> Self {
                Self::$variant(builder)
            }
        })*
    };
}
describe!(
    BallJoint => Ball, HingeJoint => Hinge, FixedJoint => Fixed, SliderJoint => Slider, DistanceJoint => Distance
);

/// What every builder knows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Link {
    pub(crate) body: BodyHandle,
    pub(crate) base: Option<BodyHandle>,
    pub(crate) anchors: Anchors,
    pub(crate) strength: Strength,
}

/// Where a joint is, first on the body, then on its base; in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Anchors {
    /// At the body's centre of mass.
    Center,
    World([Vec3; 2]),
    Local([Vec3; 2]),
}

impl Link {
    pub(crate) fn new(body: BodyHandle, base: Option<BodyHandle>) -> Self {
        Self { body, base, anchors: Anchors::Center, strength: Strength::default() }
    }
}

/// What every builder can be told.
macro_rules! common {
    ($builder:ident) => {
        impl $builder {
            /// Both sides at this point of the world, in m; without this, at the body's centre of mass.
            pub fn anchor(self, point: glam::Vec3) -> Self {
                self.anchors(point, point)
            }

            /// A point for either side, in the world, in m.
            pub fn anchors(mut self, on_body: glam::Vec3, on_base: glam::Vec3) -> Self {
                self.link.anchors = $crate::joint::build::Anchors::World([on_body, on_base]);
                self
            }

            /// A point for either side, in the frames of their shapes, in m; on the world, in the world.
            pub fn local_anchors(mut self, on_body: glam::Vec3, on_base: glam::Vec3) -> Self {
                self.link.anchors = $crate::joint::build::Anchors::Local([on_body, on_base]);
                self
            }

            /// By how much it gives way to a force, in m/N; 0 = as little as a substep allows. What is soft this way
            /// loses its swing slowly, the more so the stiffer it is.
            pub fn compliance(mut self, compliance: f32) -> Self {
                self.link.strength.compliance = compliance;
                self
            }

            /// Breaks once the mean force in a step is greater than this, in N.
            pub fn break_force(mut self, force: f32) -> Self {
                self.link.strength.break_force = Some(force);
                self
            }

            /// Lets the two bodies collide with each other, which they otherwise do not.
            pub fn collide_connected(mut self) -> Self {
                self.link.strength.collide_connected = true;
                self
            }
        }
    };
}

/// What every builder can be told that holds rotations.
macro_rules! common_angular {
    ($builder:ident) => {
        impl $builder {
            /// By how much it gives way to a torque, in rad/(N m); 0 = as little as a substep allows.
            pub fn angular_compliance(mut self, compliance: f32) -> Self {
                self.link.strength.angular_compliance = compliance;
                self
            }

            /// Breaks once the mean torque in a step is greater than this, in N m.
            pub fn break_torque(mut self, torque: f32) -> Self {
                self.link.strength.break_torque = Some(torque);
                self
            }
        }
    };
}
pub(crate) use {common, common_angular};

impl Strength {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        within("compliance", self.compliance, 0.0, 1e20, "a compliance from 0 to 1e20 (m/N)")?;
        let expected = "a compliance from 0 to 1e20 (rad/(N m))";
        within("angular_compliance", self.angular_compliance, 0.0, 1e20, expected)?;
        self.break_force.map_or(Ok(0.0), |force| positive("break_force", force))?;
        self.break_torque.map_or(Ok(0.0), |torque| positive("break_torque", torque))?;
        Ok(())
    }
}

/// A body that a joint is to hold.
struct Side {
    index: Option<u32>,
    is_dynamic: bool,
    frame: Frame,
    /// From the frame of the shape to the principal one.
    center: Vec3,
    rotation: Quat,
}

impl Side {
    fn world() -> Self {
        let frame = Frame { center: Vec3::ZERO, axes: Mat3::IDENTITY };
        Self { index: None, is_dynamic: false, frame, center: Vec3::ZERO, rotation: Quat::IDENTITY }
    }

    /// A rigid body; a half-space is as good as the world.
    fn of(field: &str, index: usize, body: &Body, positions: &[Vec3]) -> Result<Self, Error> {
        match &body.substance {
            Substance::Rigid(rigid) => Ok(Self {
                index: Some(index as u32),
                is_dynamic: rigid.traits.motion == Motion::Dynamic,
                frame: Frame::of_particles(&positions[body.particles.clone()]),
                center: rigid.shape.center_of_mass(),
                rotation: rigid.shape.principal_rotation().conjugate(),
            }),
            Substance::HalfSpace(_) => Ok(Self::world()),
            Substance::Truss { .. } | Substance::Deformable(_) => {
                let problem = "is not a rigid body: joints hold only those".into();
                Err(Error::Invalid { field: field.into(), problem })
            }
        }
    }

    fn to_principal(&self, point: Vec3) -> Vec3 {
        self.rotation * (point - self.center)
    }

    fn anchor(&self, anchor: Vec3, basis: Mat3) -> LocalFrame {
        LocalFrame { anchor, basis: self.frame.axes.transpose() * basis }
    }
}

impl JointDescription {
    fn link(&self) -> &Link {
        match self {
            Self::Ball(joint) => &joint.link,
            Self::Hinge(joint) => &joint.link,
            Self::Fixed(joint) => &joint.link,
            Self::Slider(joint) => &joint.link,
            Self::Distance(joint) => &joint.link,
        }
    }

    /// The axis that it is about, in the world.
    fn axis(&self) -> Vec3 {
        match self {
            Self::Ball(joint) => joint.axis,
            Self::Hinge(joint) => joint.axis,
            Self::Slider(joint) => joint.axis,
            Self::Fixed(_) | Self::Distance(_) => Vec3::X,
        }
    }

    /// The kind, with `length` (m) between its anchors.
    fn kind(&self, length: f32) -> Result<Kind, Error> {
        let kind = match self {
            Self::Ball(joint) => Kind::Ball { cone: joint.cone, twist: joint.twist },
            Self::Hinge(joint) => Kind::Hinge(joint.drive),
            Self::Fixed(_) => Kind::Fixed,
            Self::Slider(joint) => Kind::Slider(joint.drive),
            Self::Distance(joint) => joint.kind(length),
        };
        kind.validate()?;
        Ok(kind)
    }

    /// Checks everything, and finds out where it is on the bodies as they stand.
    pub(crate) fn build(&self, world: &World) -> Result<Joint, Error> {
        let link = self.link();
        link.strength.validate()?;
        let side = |field: &str, handle: BodyHandle| {
            let index = world.slots.index(handle)?;
            Side::of(field, index, &world.bodies[index], &world.particles.position)
        };
        let body = side("body", link.body)?;
        let base = link.base.map_or(Ok(Side::world()), |base| side("base", base))?;
        if link.base == Some(link.body) {
            let problem = "is the body itself: a joint holds two".into();
            return Err(Error::Invalid { field: "base".into(), problem });
        }
        // A half-space has no index: it can be a base, not a body.
        let (Some(index), true) = (body.index, body.is_dynamic || base.is_dynamic) else {
            let problem = "neither the body nor its base is dynamic: nothing to hold".into();
            return Err(Error::Invalid { field: "joint".into(), problem });
        };
        let [on_body, on_base] = anchors(&link.anchors, &body, &base)?;
        let basis = basis(coordinates("axis", self.axis())?)?;
        let (on_body, on_base) = (body.anchor(on_body, basis), base.anchor(on_base, basis));
        let reach = on_body.on_body(body.frame.center, body.frame.axes).anchor();
        let length = reach.distance_to(on_base.on_body(base.frame.center, base.frame.axes).anchor());
        let kind = self.kind(length)?;
        let (strength, state) = (link.strength, State::default());
        Ok(Joint { kind, body: index, base: base.index, on_body, on_base, strength, state })
    }
}

/// The anchors in the principal frames.
fn anchors(anchors: &Anchors, body: &Side, base: &Side) -> Result<[Vec3; 2], Error> {
    let in_frame = |side: &Side, point: Vec3| side.frame.axes.transpose() * (point - side.frame.center);
    match *anchors {
        Anchors::Center => Ok([Vec3::ZERO, in_frame(base, body.frame.center)]),
        Anchors::World([on_body, on_base]) => {
            coordinates("anchor", on_body)?;
            coordinates("anchor", on_base)?;
            Ok([in_frame(body, on_body), in_frame(base, on_base)])
        }
        Anchors::Local([on_body, on_base]) => {
            coordinates("local_anchor", on_body)?;
            coordinates("local_anchor", on_base)?;
            Ok([body.to_principal(on_body), base.to_principal(on_base)])
        }
    }
}

/// Right-handed axes, the first along this one.
fn basis(axis: Vec3) -> Result<Mat3, Error> {
    let scaled = axis / axis.abs().max_element();
    let Some(axis) = scaled.try_unit() else {
        return Err(Error::Invalid {
            field: "axis".into(),
            problem: "is zero; any length but that will do".into(),
        });
    };
    let second = axis.any_orthonormal_vector();
    Ok(Mat3::from_cols(axis, second, axis.cross(second)))
}
