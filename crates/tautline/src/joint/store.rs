//! The joints of a world.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{Joint, JointDescription, Kind, Motor, State};
use crate::error::Error;
use crate::norm::Norm;
use crate::order::PutInOrder;
use crate::slots::Slots;
use crate::world::World;

pub use crate::slots::JointHandle;

/// What happened to a joint in the last step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum JointEvent {
    /// It broke, and holds nothing any more. Its view tells force and torque.
    Broke {
        /// The joint.
        joint: JointHandle,
    },
}

/// All joints, with their handles, in the order they were added.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Joints {
    pub(crate) slots: Slots,
    pub(crate) items: Vec<Joint>,
    #[serde(skip)]
    pub(crate) events: Vec<JointEvent>,
}

impl Joints {
    /// The joints that hold, with their indices.
    pub(crate) fn holding(&self) -> impl Iterator<Item = (usize, &Joint)> {
        self.items.iter().enumerate().filter(|(_, joint)| !joint.state.is_broken)
    }

    /// The pairs of bodies, sorted, that do not collide since a joint connects them.
    pub(crate) fn separated(&self) -> Vec<[u32; 2]> {
        let pair = |(_, joint): (usize, &Joint)| {
            let base = joint.base.filter(|_| !joint.strength.collide_connected)?;
            Some([joint.body.min(base), joint.body.max(base)])
        };
        let mut pairs: Vec<[u32; 2]> = self.holding().filter_map(pair).collect();
        pairs.put_in_order();
        pairs
    }

    /// Keeps what a step has made of joints; `adds`: its force to that of an earlier part of it.
    pub(crate) fn keep(&mut self, states: impl IntoIterator<Item = (u32, State)>, adds: bool) {
        for (index, state) in states {
            let kept = &mut self.items[index as usize].state;
            let before = if adds { [kept.force, kept.torque] } else { [Vec3::ZERO; 2] };
            let state = State { force: before[0] + state.force, torque: before[1] + state.torque, ..state };
            // What numbers cannot say any more begins anew.
            let anew = State { is_broken: state.is_broken, ..State::default() };
            *kept = if state.is_finite() { state } else { anew };
        }
    }

    fn remove(&mut self, index: usize) {
        self.slots.remove(index);
        self.items.remove(index);
    }

    /// Removes the joints of a body that is removed, and returns which bodies they held as well. The bodies behind
    /// it move down.
    pub(crate) fn remove_body(&mut self, body: u32) -> Vec<u32> {
        let mut let_go = Vec::new();
        for index in (0..self.items.len()).rev() {
            let joint = &self.items[index];
            if joint.body == body || joint.base == Some(body) {
                let_go.extend(
                    [Some(joint.body), joint.base].into_iter().flatten().filter(|&other| other != body),
                );
                self.remove(index);
            }
        }
        let moved = |other: u32| other - u32::from(other > body);
        for joint in &mut self.items {
            joint.body = moved(joint.body);
            joint.base = joint.base.map(moved);
        }
        let_go.into_iter().map(moved).collect()
    }

    /// Checks joints from untrusted bytes.
    pub(crate) fn is_valid(&self, body_count: usize) -> bool {
        self.slots.is_valid(self.items.len()) && self.items.iter().all(|joint| joint.is_sound(body_count))
    }
}

impl World {
    /// Adds a joint: a [`BallJoint`](crate::BallJoint), [`HingeJoint`](crate::HingeJoint),
    /// [`FixedJoint`](crate::FixedJoint), [`SliderJoint`](crate::SliderJoint) or
    /// [`DistanceJoint`](crate::DistanceJoint). It wakes the bodies it holds. Points that it keeps together and that
    /// are apart are drawn together, no faster than [`Settings::separation_speed`](crate::Settings).
    ///
    /// # Errors
    /// [`Error::StaleHandle`] for a body that is not there, [`Error::Invalid`] for one that is not rigid, a joint of
    /// a body with itself or between two that are not dynamic, and [`Error::OutOfRange`] for a wrong number, by
    /// field; the world is as before.
    pub fn add_joint(&mut self, joint: impl Into<JointDescription>) -> Result<JointHandle, Error> {
        let joint = joint.into().build(self)?;
        self.joints.items.push(joint);
        let handle = self.joints.slots.push();
        self.disturb_joint(self.joints.items.len() - 1);
        self.rigid.invalidate();
        Ok(handle)
    }

    /// Removes a joint, and wakes the bodies it held.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn remove_joint(&mut self, handle: JointHandle) -> Result<(), Error> {
        let index = self.joints.slots.index(handle)?;
        self.disturb_joint(index);
        self.joints.remove(index);
        self.rigid.invalidate();
        Ok(())
    }

    /// The handles of all joints, also broken ones, in the order they were added.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = JointHandle> + '_ {
        (0..self.joints.items.len()).map(|index| self.joints.slots.handle(index))
    }

    /// What happened to joints in the last step.
    pub fn joint_events(&self) -> &[JointEvent] {
        &self.joints.events
    }

    /// Drives a hinge or a slider from now on, or with `None` lets it go.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] for a joint of another kind; [`Error::OutOfRange`] for a wrong
    /// number, by field.
    pub fn set_motor(&mut self, handle: JointHandle, motor: Option<Motor>) -> Result<(), Error> {
        self.change_joint(handle, |kind| match kind {
            Kind::Hinge(drive) | Kind::Slider(drive) => {
                drive.motor = motor;
                Ok(())
            }
            Kind::Ball { .. } | Kind::Fixed | Kind::Distance { .. } => {
                let problem = "only hinges and sliders have one".into();
                Err(Error::Invalid { field: "motor".into(), problem })
            }
        })
    }

    /// Sets the lowest and the highest angle of a hinge (rad), translation of a slider (m) or length of a distance
    /// joint (m), or with `None` takes them away; a distance joint without limits is a spring or nothing.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] for a joint of another kind; [`Error::OutOfRange`] for a wrong
    /// number, by field.
    pub fn set_limits(&mut self, handle: JointHandle, limits: Option<[f32; 2]>) -> Result<(), Error> {
        self.change_joint(handle, |kind| match kind {
            Kind::Hinge(drive) | Kind::Slider(drive) => {
                drive.limits = limits;
                Ok(())
            }
            Kind::Distance { limits: range, .. } => {
                *range = limits;
                Ok(())
            }
            Kind::Ball { .. } | Kind::Fixed => {
                let problem = "only hinges, sliders and distance joints have them".into();
                Err(Error::Invalid { field: "limits".into(), problem })
            }
        })
    }

    fn change_joint(
        &mut self,
        handle: JointHandle,
        change: impl FnOnce(&mut Kind) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let index = self.joints.slots.index(handle)?;
        let mut kind = self.joints.items[index].kind;
        change(&mut kind)?;
        kind.validate()?;
        self.joints.items[index].kind = kind;
        self.disturb_joint(index);
        Ok(())
    }

    /// Wakes the bodies of a joint.
    fn disturb_joint(&mut self, index: usize) {
        let joint = &self.joints.items[index];
        for body in [Some(joint.body), joint.base].into_iter().flatten() {
            self.wake_body(body as usize);
        }
    }

    /// Breaks joints that held too much in the step.
    pub(crate) fn break_joints(&mut self) {
        for (index, joint) in
            self.joints.items.iter_mut().enumerate().filter(|(_, joint)| !joint.state.is_broken)
        {
            let state = &joint.state;
            let exceeds = |size: f32, most: Option<f32>| most.is_some_and(|most| size > most);
            let strength = &joint.strength;
            if exceeds(state.force.norm(), strength.break_force)
                || exceeds(state.torque.norm(), strength.break_torque)
            {
                joint.state.is_broken = true;
                let joint = self.joints.slots.handle(index);
                self.joints.events.push(JointEvent::Broke { joint });
                self.rigid.invalidate();
            }
        }
    }
}
