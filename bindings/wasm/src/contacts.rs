//! What began to touch, still does and has parted in the last step.

use serde_json::{Value, json};
use tautline::{ContactEvent, ContactEventKind};
use wasm_bindgen::prelude::*;

use crate::session::Session;

#[wasm_bindgen]
impl Session {
    pub fn report_contacts(&mut self, body: u32, on: bool) -> Result<(), JsValue> {
        self.with_body(body, |world, body| world.set_report_contacts(body, on))
    }

    pub fn contact_events(&self) -> String {
        let told = |event: &ContactEvent| {
            let kind = match event.kind {
                ContactEventKind::Began => "began",
                ContactEventKind::Persists => "persists",
                ContactEventKind::Ended => "ended",
            };
            let [a, b] = event.bodies.map(|body| self.number(body));
            json!({
                "kind": kind, "a": a, "b": b, "point": event.point.to_array(), "normal": event.normal.to_array(),
                "impulse": event.impulse, "approachSpeed": event.approach_speed,
            })
        };
        Value::from(self.world().contact_events().iter().map(told).collect::<Vec<_>>()).to_string()
    }
}
