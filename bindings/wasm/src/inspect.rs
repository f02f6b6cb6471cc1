//! How it works, for pictures.

use serde_json::{Value, json};
use tautline::Vec3;
use tautline::geometry::feature::FeaturePoint;
use tautline::geometry::gjk::{Iteration, Proximity};
use tautline::geometry::simplex::CsoVertex;
use tautline::inspect::{ContactPoint, FeatureOfBody, GjkTrace};
use tautline::mesh::convex_hull;
use wasm_bindgen::prelude::*;

use crate::failure::Failure;
use crate::session::Session;

/// The most pairs of vertices whose differences are drawn.
const MOST_DIFFERENCES: usize = 40_000;

#[wasm_bindgen]
impl Session {
    /// Spheres of a body: x, y, z, radius and level of each.
    pub fn spheres(&self, body: u32) -> Result<Vec<f32>, JsValue> {
        let spheres = self.view(body)?.spheres();
        let numbers = spheres.into_iter().flat_map(|(sphere, level)| {
            let [x, y, z] = sphere.center.to_array();
            [x, y, z, sphere.radius, level as f32]
        });
        Ok(numbers.collect())
    }

    /// The lowest and the highest corner of the box around each body; infinite for half-spaces.
    pub fn boxes(&self) -> Vec<f32> {
        let world = self.world();
        let none = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        let bounds = |body| world.body(body).ok().and_then(|body| body.bounds()).unwrap_or(none);
        world.bodies().flat_map(|body| bounds(body).map(|corner| corner.to_array())).flatten().collect()
    }

    /// GJK between two rigid bodies.
    pub fn gjk(&self, a: u32, b: u32) -> Result<String, JsValue> {
        let (a, b) = (self.body(a)?, self.body(b)?);
        let trace = self.world().trace_gjk(a, b).map_err(Failure::from)?;
        let result = match trace.found.proximity {
            Proximity::Separated => "separated",
            Proximity::Intersecting => "intersecting",
            Proximity::Unresolved => "unresolved",
        };
        let hit_face = trace.hit.map(|hit| {
            json!({
                "vertices": hit.face.vertices.map(|vertex| told(&trace, &vertex)),
                "normal": hit.face.normal.to_array(), "depth": hit.face.depth,
                "featureA": feature(&trace.hulls[0], &hit.features.a),
                "featureB": feature(&trace.hulls[1], &hit.features.b),
            })
        });
        let iterations: Vec<Value> = trace.iterations.iter().map(|step| iteration(&trace, step)).collect();
        let told = json!({
            "difference": difference(&trace), "iterations": iterations, "result": result,
            "points": trace.points().map(|point| point.to_array()), "distance": trace.distance(),
            "hitFace": hit_face,
        });
        Ok(told.to_string())
    }

    /// Where bodies touch.
    pub fn contact_points(&self) -> String {
        let told = |contact: ContactPoint| {
            let [a, b] = contact.bodies.map(|body| self.number(body));
            let [point_a, point_b] = contact.points.map(|point| point.to_array());
            let [feature_a, feature_b] = contact.features.map(|feature| {
                feature.map(|FeatureOfBody { positions, weights }| {
                    let points: Vec<_> = positions.iter().map(Vec3::to_array).collect();
                    json!({ "points": points, "weights": weights })
                })
            });
            json!({
                "a": a, "b": b, "pointA": point_a, "pointB": point_b, "normal": contact.normal.to_array(),
                "depth": contact.depth, "impulse": contact.impulse, "featureA": feature_a, "featureB": feature_b,
            })
        };
        Value::from(self.world().contact_points().into_iter().map(told).collect::<Vec<_>>()).to_string()
    }

    /// The colour of each stick of a body.
    pub fn stick_colors(&self, body: u32) -> Result<Vec<u32>, JsValue> {
        Ok(self.world().stick_colors(self.body(body)?).map_err(Failure::from)?)
    }

    /// Pairs of rigid bodies in contact: both bodies and the number of their colour, in turn.
    pub fn contact_colors(&self) -> Vec<u32> {
        let pairs = self.world().contact_colors().into_iter();
        pairs.flat_map(|([a, b], color)| [self.number(a), self.number(b), color]).collect()
    }

    /// The paper's list of a truss for a particle: numbers of its sticks in the order in which they are relaxed.
    pub fn ordered_list(&self, body: u32, particle: u32) -> Result<Vec<u32>, JsValue> {
        let view = self.view(body)?;
        let truss = view.truss().ok_or_else(|| Failure::invalid("body", "it is not a truss"))?;
        Ok(truss.ordered_list(particle as usize).into_owned())
    }

    /// By which share of its rest length each stick of a body is too long.
    pub fn strains(&self, body: u32) -> Result<Vec<f32>, JsValue> {
        let view = self.view(body)?;
        let at = |particle: u32| view.positions().get(particle as usize).copied().unwrap_or_default();
        let strain = |a: u32, b: u32, rest: f32| at(a).distance(at(b)) / rest - 1.0;
        Ok(view.sticks().iter().map(|stick| strain(stick.a, stick.b, stick.rest_length)).collect())
    }
}

fn told(trace: &GjkTrace, vertex: &CsoVertex) -> Value {
    let [a, b] = [vertex.a, vertex.b].map(|index| index as usize);
    let place =
        |side: usize, index: usize| trace.hulls[side].get(index).copied().unwrap_or_default().to_array();
    json!({ "point": vertex.point.to_array(), "onA": place(0, a), "onB": place(1, b) })
}

fn iteration(trace: &GjkTrace, step: &Iteration) -> Value {
    let weighted = |(vertex, weight): (&CsoVertex, &f64)| {
        let mut vertex = told(trace, vertex);
        vertex["weight"] = json!(weight);
        vertex
    };
    let simplex = step.simplex.vertices().iter().zip(step.simplex.weights()).map(weighted);
    json!({
        "direction": step.direction.to_array(), "support": told(trace, &step.vertex),
        "simplex": simplex.collect::<Vec<_>>(), "closest": step.closest.to_array(),
        "distance": step.closest.length(),
    })
}

fn feature(hull: &[Vec3], point: &FeaturePoint) -> Value {
    let places: Vec<_> = point
        .iter()
        .map(|(index, _)| hull.get(index as usize).copied().unwrap_or_default().to_array())
        .collect();
    let weights: Vec<f32> = point.iter().map(|(_, weight)| weight).collect();
    json!({ "points": places, "weights": weights })
}

/// A ⊖ B as a mesh: the hull of all differences of vertices; nothing where there are too many, or they are flat.
fn difference(trace: &GjkTrace) -> Value {
    let [a, b] = &trace.hulls;
    if a.len() * b.len() > MOST_DIFFERENCES {
        return Value::Null;
    }
    let points: Vec<Vec3> = a.iter().flat_map(|&p| b.iter().map(move |&q| p - q)).collect();
    match convex_hull(&points) {
        Ok(hull) => {
            let positions: Vec<f32> = hull.mesh.positions.iter().flat_map(|point| point.to_array()).collect();
            json!({ "positions": positions, "indices": hull.mesh.triangles.as_flattened() })
        }
        Err(_) => Value::Null,
    }
}
