//! Bodies that roll down a slope, and boxes that topple on one.

use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{Error, Quat, RigidBody, Shape, Vec3};

use super::case::{Case, Part, Trial};
use super::lab::{G, center, run, threshold, turned};
use super::slope::{Brick, Slope};

pub(super) fn cases() -> Vec<Case> {
    vec![rolling(), toppling()]
}

/// A body that rolls about its Z axis.
#[derive(Clone, Copy)]
struct Roller {
    name: &'static str,
    shape: fn(f32) -> Result<Shape, Error>,
    /// In m.
    radius: f32,
    /// Turned about X at first, so that what its axis is becomes Z.
    tip: f32,
}

fn faceted(radius: f32) -> Result<Shape, Error> {
    Shape::convex_hull(&primitives::icosphere(radius, 5)?.positions)
}

const LYING: f32 = std::f32::consts::FRAC_PI_2;

fn rolling() -> Case {
    const SECONDS: f64 = 2.0;
    let trial = |(roller, degrees): (Roller, f64)| {
        Trial::one(move |conditions| {
            let slope = Slope { steepness: libm::tan(f64::to_radians(degrees)), heading: 0.3 };
            let mut world = slope.world(conditions, 1.0)?;
            let shape = Arc::new((roller.shape)(roller.radius)?);
            let moments = shape.second_moments().as_dvec3();
            // About the axis of the rollers all others are alike; the axis of long ones comes first.
            let inertia_per_mass = moments.y + moments.z;
            let rotation = slope.rotation() * Quat::from_rotation_x(roller.tip);
            let position = (slope.normal() * f64::from(roller.radius)).as_vec3();
            let body = RigidBody::new(&shape).mass(1.0).friction(1.0).position(position).rotation(rotation);
            let body = world.add(body)?;
            let start = center(&world, body)?;
            run(&mut world, SECONDS)?;
            let way = (center(&world, body)? - start).dot(slope.downhill());
            let t = world.time();
            let radius = f64::from(roller.radius);
            let expected = G * slope.sin() / (1.0 + inertia_per_mass / (radius * radius));
            let name = format!("{}, {degrees}°", roller.name);
            Ok(Part::relative(name, [2.0 * way / (t * t), expected], 2e-3, "m/s²"))
        })
    };
    let ball = Roller { name: "ball of 1 m", shape: Shape::sphere, radius: 0.5, tip: 0.0 };
    let small = Roller { name: "ball of 10 cm", radius: 0.05, ..ball };
    let faceted = Roller { name: "hull of 10 242 vertices", shape: faceted, ..ball };
    let capsule = |radius: f32| Shape::capsule(radius, 0.5);
    let capsule = Roller { name: "capsule", shape: capsule, radius: 0.2, tip: LYING };
    let variants = [(ball, 20.0), (small, 20.0), (faceted, 20.0), (capsule, 20.0), (ball, 5.0), (ball, 40.0)];
    Case {
        id: 11,
        group: "Rolling and toppling",
        name: "a round body rolls down",
        formula: "a = g sin θ/(1 + I/mr²)",
        note: "I is that of the body as it is, of a faceted one too. A hull tips from facet to facet and loses energy at each, as \
               a wheel without a rim does: with 10 242 vertices it is 1.5 % behind a ball in steps of 1/480 s. In steps of \
               1/60 s it rolls over one and a half facets in each and is faster than the ball, whatever the substeps: contacts \
               know the points that were near when the step began.",
        trials: variants.map(trial).into(),
    }
}

fn toppling() -> Case {
    const SECONDS: f64 = 10.0;
    let trial = |[width, height]: [f32; 2]| {
        Trial::one(move |conditions| {
            let brick = Brick {
                half_extents: Vec3::new(0.5 * width, 0.5 * height, 0.5 * width),
                mass: 1.0,
                friction: 2.0,
                turn: 0.0,
            };
            let topples = |steepness: f64| {
                let slope = Slope { steepness, heading: 0.0 };
                let (mut world, body) = brick.lie_on(slope, conditions)?;
                run(&mut world, SECONDS)?;
                let (_, rotation) = super::lab::pose(&world, body)?;
                // By then it lies on its side, or stands.
                Ok(turned(rotation, tautline::DVec3::Y).dot(slope.normal()) < 0.5)
            };
            let expected = f64::from(width) / f64::from(height);
            let measured = threshold([0.97 * expected, 1.03 * expected], 1e-5, topples)?;
            Ok(Part::relative(format!("{width} × {height} m"), [measured, expected], 3e-3, ""))
        })
    };
    Case {
        id: 12,
        group: "Rolling and toppling",
        name: "a tall box on a slope topples",
        formula: "tan θ = w/h",
        note: "",
        trials: [[0.5, 2.0], [1.0, 2.0], [0.2, 1.0], [0.05, 0.2]].map(trial).into(),
    }
}
