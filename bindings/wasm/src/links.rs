//! Joints and attachments.

use serde_json::{Value, json};
use tautline::{JointEvent, JointKind, Motor};
use tautline_scene::document::parse_part;
use wasm_bindgen::prelude::*;

use crate::failure::Failure;
use crate::session::Session;

#[wasm_bindgen]
impl Session {
    pub fn add_joint(&mut self, text: &str) -> Result<u32, JsValue> {
        let joint = parse_part(text).map_err(Failure::from)?;
        Ok(self.scene.add_joint(&joint).map_err(Failure::from)?)
    }

    pub fn remove_joint(&mut self, joint: u32) -> Result<(), JsValue> {
        Ok(self.scene.remove_joint(joint).map_err(Failure::from)?)
    }

    pub fn attach(&mut self, text: &str) -> Result<u32, JsValue> {
        let attachment = parse_part(text).map_err(Failure::from)?;
        Ok(self.scene.attach(&attachment).map_err(Failure::from)?)
    }

    pub fn detach(&mut self, attachment: u32) -> Result<(), JsValue> {
        Ok(self.scene.detach(attachment).map_err(Failure::from)?)
    }

    /// Speed and strength of a motor; nothing takes it away.
    pub fn set_motor(&mut self, joint: u32, motor: &[f32]) -> Result<(), JsValue> {
        let joint = self.scene.joints().handle(joint).map_err(Failure::from)?;
        let motor = match *motor {
            [speed, strength] => Some(Motor { speed, strength }),
            _ => None,
        };
        Ok(self.scene.world_mut().set_motor(joint, motor).map_err(Failure::from)?)
    }

    /// The lowest and the highest; nothing takes them away.
    pub fn set_limits(&mut self, joint: u32, limits: &[f32]) -> Result<(), JsValue> {
        let joint = self.scene.joints().handle(joint).map_err(Failure::from)?;
        let limits = <[f32; 2]>::try_from(limits).ok();
        Ok(self.scene.world_mut().set_limits(joint, limits).map_err(Failure::from)?)
    }

    /// All joints as they are now.
    pub fn joints(&self) -> String {
        let world = self.world();
        let described = |handle| {
            let joint = world.joint(handle).ok()?;
            let kind = match joint.kind() {
                JointKind::Ball => "ball",
                JointKind::Hinge => "hinge",
                JointKind::Fixed => "fixed",
                JointKind::Slider => "slider",
                JointKind::Distance => "distance",
            };
            Some(json!({
                "handle": self.scene.joints().number(handle), "kind": kind, "body": self.number(joint.body()),
                "base": joint.base().map(|base| self.number(base)),
                "anchors": joint.anchors().map(|anchor| anchor.to_array()),
                "angle": joint.angle(), "translation": joint.translation(),
                "force": joint.force().to_array(), "isBroken": joint.is_broken(),
            }))
        };
        Value::from(world.joints().filter_map(described).collect::<Vec<_>>()).to_string()
    }

    /// All attachments as they are now.
    pub fn attachments(&self) -> String {
        let world = self.world();
        let described = |handle| {
            let attachment = world.attachment(handle).ok()?;
            Some(json!({
                "handle": self.scene.attachments().number(handle),
                "bodies": attachment.bodies().map(|body| body.map(|body| self.number(body))),
                "ends": attachment.ends().map(|end| end.to_array()),
                "force": attachment.force().to_array(), "isBroken": attachment.is_broken(),
            }))
        };
        Value::from(world.attachments().filter_map(described).collect::<Vec<_>>()).to_string()
    }

    /// Joints that broke in the last step.
    pub fn broken_joints(&self) -> Vec<u32> {
        let broken = self.world().joint_events().iter().filter_map(|event| match event {
            JointEvent::Broke { joint } => self.scene.joints().number(*joint),
            _ => None,
        });
        broken.collect()
    }
}
