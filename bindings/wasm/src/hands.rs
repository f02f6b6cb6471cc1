//! What moves bodies from outside: grabs, forces, velocities, single particles.

use serde_json::{Value, json};
use tautline::{Grip, Quat};
use wasm_bindgen::prelude::*;

use crate::failure::Failure;
use crate::session::{Session, vec3};

#[wasm_bindgen]
impl Session {
    pub fn grab(
        &mut self,
        body: u32,
        point: &[f32],
        frequency: f32,
        max_acceleration: f32,
    ) -> Result<u32, JsValue> {
        let grip = Grip { frequency, max_acceleration };
        let grab = self.with_body(body, |world, body| world.grab(body, vec3(point), grip))?;
        Ok(self.grabs.push_new(grab))
    }

    pub fn move_grab(&mut self, grab: u32, target: &[f32]) -> Result<(), JsValue> {
        let grab = self.held(grab)?;
        Ok(self.scene.world_mut().move_grab(grab, vec3(target)).map_err(Failure::from)?)
    }

    pub fn release(&mut self, grab: u32) -> Result<(), JsValue> {
        let grab = self.held(grab)?;
        Ok(self.scene.world_mut().release(grab).map_err(Failure::from)?)
    }

    /// What is held: `[{handle, body, point, target}]`.
    pub fn grabs(&self) -> String {
        let world = self.world();
        let told = |(grab, body)| {
            let [point, target] = world.grab_ends(grab).ok()?.map(|end| end.to_array());
            let (handle, body) = (self.grabs.number(grab), self.number(body));
            Some(json!({ "handle": handle, "body": body, "point": point, "target": target }))
        };
        Value::from(world.grabs().filter_map(told).collect::<Vec<_>>()).to_string()
    }

    pub fn set_pose(&mut self, body: u32, position: &[f32], rotation: &[f32]) -> Result<(), JsValue> {
        let rotation = quaternion(rotation)?;
        self.with_body(body, |world, body| world.set_pose(body, vec3(position), rotation))
    }

    pub fn set_velocity(&mut self, body: u32, velocity: &[f32]) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.set_velocity(body, vec3(velocity)))
    }

    pub fn set_angular_velocity(&mut self, body: u32, velocity: &[f32]) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.set_angular_velocity(body, vec3(velocity)))
    }

    /// At the centre of mass if `point` is empty.
    pub fn apply_force(&mut self, body: u32, force: &[f32], point: &[f32]) -> Result<(), JsValue> {
        self.with_body(body, |world, body| match point {
            [] => world.apply_force(body, vec3(force)),
            _ => world.apply_force_at_point(body, vec3(force), vec3(point)),
        })
    }

    /// At the centre of mass if `point` is empty.
    pub fn apply_impulse(&mut self, body: u32, impulse: &[f32], point: &[f32]) -> Result<(), JsValue> {
        self.with_body(body, |world, body| match point {
            [] => world.apply_impulse(body, vec3(impulse)),
            _ => world.apply_impulse_at_point(body, vec3(impulse), vec3(point)),
        })
    }

    pub fn apply_torque(&mut self, body: u32, torque: &[f32]) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.apply_torque(body, vec3(torque)))
    }

    pub fn pin(&mut self, body: u32, particle: u32) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.pin(body, particle))
    }

    pub fn unpin(&mut self, body: u32, particle: u32) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.unpin(body, particle))
    }

    pub fn set_particle_position(
        &mut self,
        body: u32,
        particle: u32,
        position: &[f32],
    ) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.set_particle_position(body, particle, vec3(position)))
    }

    pub fn set_particle_velocity(
        &mut self,
        body: u32,
        particle: u32,
        velocity: &[f32],
    ) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.set_particle_velocity(body, particle, vec3(velocity)))
    }

    pub fn rope_length(&self, rope: u32) -> Result<f32, JsValue> {
        Ok(self.world().rope_length(self.body(rope)?).map_err(Failure::from)?)
    }

    pub fn set_rope_length(&mut self, rope: u32, length: f32) -> Result<(), JsValue> {
        self.with_body(rope, |world, rope| world.set_rope_length(rope, length))
    }

    pub fn set_wind(&mut self, wind: &[f32]) -> Result<(), JsValue> {
        Ok(self.scene.world_mut().set_wind(vec3(wind)).map_err(Failure::from)?)
    }

    pub fn wake(&mut self, body: u32) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.wake(body))
    }

    fn held(&self, grab: u32) -> Result<tautline::GrabHandle, Failure> {
        Ok(self.grabs.handle(grab)?)
    }
}

/// A rotation of any length above 0; nothing is none.
pub(crate) fn quaternion(numbers: &[f32]) -> Result<Quat, Failure> {
    let Ok(numbers) = <[f32; 4]>::try_from(numbers) else { return Ok(Quat::IDENTITY) };
    let length = Quat::from_array(numbers).length();
    if length.is_finite() && length > 1e-6 {
        return Ok(Quat::from_array(numbers) / length);
    }
    Err(Failure::invalid("rotation", "it is not a quaternion of a finite length above 0"))
}
