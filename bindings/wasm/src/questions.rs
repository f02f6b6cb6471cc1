//! What is where: rays, shapes, closest points.

use serde_json::{Value, json};
use tautline::{PointHit, QueryFilter, RayHit, Shape};
use tautline_scene::document::{self, parse_part};
use wasm_bindgen::prelude::*;

use crate::failure::Failure;
use crate::hands::quaternion;
use crate::session::{Session, vec3};

#[wasm_bindgen]
impl Session {
    /// `which` is a body that is left out or −1, then whether what is fixed and what can move is found.
    pub fn ray_cast(
        &self,
        origin: &[f32],
        direction: &[f32],
        max: f32,
        which: &[i32],
    ) -> Result<String, JsValue> {
        let filter = self.filter(which)?;
        let hit = self.world().ray_cast(vec3(origin), vec3(direction), max, filter).map_err(Failure::from)?;
        Ok(json!(hit.map(|hit| self.ray_hit(hit))).to_string())
    }

    pub fn ray_cast_all(
        &self,
        origin: &[f32],
        direction: &[f32],
        max: f32,
        which: &[i32],
    ) -> Result<String, JsValue> {
        let filter = self.filter(which)?;
        let hits =
            self.world().ray_cast_all(vec3(origin), vec3(direction), max, filter).map_err(Failure::from)?;
        Ok(Value::from(hits.into_iter().map(|hit| self.ray_hit(hit)).collect::<Vec<_>>()).to_string())
    }

    pub fn closest_point(&self, point: &[f32], max: f32, which: &[i32]) -> Result<String, JsValue> {
        let filter = self.filter(which)?;
        let hit = self.world().closest_point(vec3(point), max, filter).map_err(Failure::from)?;
        let told = hit.map(|PointHit { body, point, normal, distance }| {
            json!({
                "body": self.number(body), "point": point.to_array(), "normal": normal.to_array(),
                "distance": distance,
            })
        });
        Ok(json!(told).to_string())
    }

    /// The bodies that a shape of a document would overlap.
    pub fn overlap(
        &self,
        shape: &str,
        position: &[f32],
        rotation: &[f32],
        which: &[i32],
    ) -> Result<Vec<u32>, JsValue> {
        let (shape, rotation, filter) = (made(shape)?, quaternion(rotation)?, self.filter(which)?);
        let found = self.world().overlap(&shape, vec3(position), rotation, filter).map_err(Failure::from)?;
        Ok(found.into_iter().map(|body| self.number(body)).collect())
    }

    /// The first body that a shape of a document would touch on its way.
    pub fn shape_cast(
        &self,
        shape: &str,
        position: &[f32],
        rotation: &[f32],
        motion: &[f32],
        which: &[i32],
    ) -> Result<String, JsValue> {
        let (shape, rotation, filter) = (made(shape)?, quaternion(rotation)?, self.filter(which)?);
        let hit = self
            .world()
            .shape_cast(&shape, vec3(position), rotation, vec3(motion), filter)
            .map_err(Failure::from)?;
        let told = hit.map(|hit| {
            json!({
                "body": self.number(hit.body), "point": hit.point.to_array(), "normal": hit.normal.to_array(),
                "fraction": hit.fraction,
            })
        });
        Ok(json!(told).to_string())
    }

    fn filter(&self, which: &[i32]) -> Result<QueryFilter, Failure> {
        let all = QueryFilter::default();
        let &[exclude, fixed, movable] = which else { return Ok(all) };
        let exclude = u32::try_from(exclude).ok().map(|number| self.body(number)).transpose()?;
        Ok(QueryFilter { exclude, fixed: fixed != 0, movable: movable != 0, ..all })
    }

    fn ray_hit(&self, RayHit { body, point, normal, distance }: RayHit) -> Value {
        json!({
            "body": self.number(body), "point": point.to_array(), "normal": normal.to_array(), "distance": distance,
        })
    }
}

/// The shape of a document.
fn made(text: &str) -> Result<Shape, Failure> {
    let shape: document::Shape = parse_part(text)?;
    Ok(shape.build()?)
}
