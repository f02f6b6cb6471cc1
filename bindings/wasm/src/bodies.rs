//! Bodies: what they are, how they are drawn, how they come and go.

use serde_json::{Value, json};
use tautline::{BodyHandle, BodyKind, BodyView, Motion};
use tautline_scene::build::{Look, Part};
use tautline_scene::document::parse_part;
use wasm_bindgen::prelude::*;

use crate::failure::Failure;
use crate::session::Session;

#[wasm_bindgen]
impl Session {
    /// Every body in the order of the world: `[{handle, kind, name, color, look, mesh, radius, first, count}]`.
    pub fn bodies(&mut self) -> String {
        let mut first = 0;
        let mut all = Vec::new();
        for handle in self.scene.world().bodies() {
            let (Ok(body), Some(part)) = (self.scene.world().body(handle), self.scene.part(handle)) else {
                continue;
            };
            let count = body.positions().len();
            let mesh = self.meshes.number(part);
            let number = self.scene.bodies().number(handle);
            all.push(described(&body, part, json!([number, mesh, first, count])));
            first += count;
        }
        Value::from(all).to_string()
    }

    /// The number of a body's name in the document or its description.
    pub fn add(&mut self, text: &str) -> Result<u32, JsValue> {
        let body = parse_part(text).map_err(Failure::from)?;
        Ok(self.scene.add(body).map_err(Failure::from)?)
    }

    pub fn remove(&mut self, body: u32) -> Result<(), JsValue> {
        Ok(self.scene.remove(body).map_err(Failure::from)?)
    }

    /// How many triangles a sheet has: fewer when it tears.
    pub fn triangle_count(&self, body: u32) -> Result<u32, JsValue> {
        Ok(self.view(body)?.triangles().len() as u32)
    }

    /// The triangles of a sheet.
    pub fn triangles(&self, body: u32) -> Result<Vec<u32>, JsValue> {
        Ok(self.view(body)?.triangles().as_flattened().to_vec())
    }

    /// The particles that a body's sticks are between.
    pub fn segments(&self, body: u32) -> Result<Vec<u32>, JsValue> {
        Ok(self.view(body)?.sticks().iter().flat_map(|stick| [stick.a, stick.b]).collect())
    }

    /// The particles that do not move.
    pub fn pins(&self, body: u32) -> Result<Vec<u32>, JsValue> {
        let view = self.view(body)?;
        let masses = if view.kind() == BodyKind::Rigid { &[] } else { view.inverse_masses() };
        Ok((0..).zip(masses).filter(|(_, mass)| **mass == 0.0).map(|(particle, _)| particle).collect())
    }

    /// Centre of mass (m), velocity (m/s), angular velocity (rad/s), mass (kg), pressure (Pa, NaN if there is no gas).
    pub fn state(&self, body: u32) -> Result<Vec<f32>, JsValue> {
        let view = self.view(body)?;
        let vectors = [view.center_of_mass(), view.velocity(), view.angular_velocity()];
        let numbers = [view.mass(), view.pressure().unwrap_or(f32::NAN)];
        Ok(vectors.iter().flat_map(|vector| vector.to_array()).chain(numbers).collect())
    }

    /// What moves a body.
    pub fn motion(&self, body: u32) -> Result<String, JsValue> {
        let motion = match self.view(body)?.motion() {
            Motion::Dynamic => "dynamic",
            Motion::Kinematic => "kinematic",
            Motion::Fixed => "fixed",
        };
        Ok(motion.to_owned())
    }
}

impl Session {
    pub(crate) fn view(&self, number: u32) -> Result<BodyView<'_>, Failure> {
        let body: BodyHandle = self.body(number)?;
        Ok(self.scene.world().body(body)?)
    }
}

/// `numbers` are those of the body and its mesh, its first particle and how many it has.
fn described(body: &BodyView<'_>, part: &Part, numbers: Value) -> Value {
    let kind = match body.kind() {
        BodyKind::Rigid => "rigid",
        BodyKind::Truss => "truss",
        BodyKind::Cloth => "cloth",
        BodyKind::Rope => "rope",
        BodyKind::SoftSolid => "soft-solid",
        BodyKind::HalfSpace => "half-space",
    };
    let (look, radius) = match part.look {
        Look::Solid(_) => ("solid", 0.0),
        Look::Round(_) => ("round", 0.0),
        Look::Sheet => ("sheet", 0.0),
        Look::Tube { radius } => ("tube", radius),
        Look::Wall(_) => ("wall", 0.0),
    };
    let [red, green, blue] = part.color;
    json!({
        "numbers": numbers, "kind": kind, "name": part.name, "look": look, "radius": radius,
        "color": u32::from_be_bytes([0, red, green, blue]),
    })
}
