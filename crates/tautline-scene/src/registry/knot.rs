//! A knot that is pulled tight.

use tautline::Vec3;

use super::hold::on_body;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    Body, BodyRef, Camera, Color, Cue, HalfSpace, Motion, Rigid, Rope, Scene, Shape, Thread,
};

pub(super) const KNOT: NamedScene = NamedScene {
    name: "knot",
    description: "An overhand knot in a rope is pulled tight.",
    parameters: &[
        Parameter::count("segments", "segments of the rope", 72, (40, 160)),
        Parameter::count("left", "what is left of its length in the knot, in radii", 24, (20, 60)),
    ],
    document: knot,
};

/// Of the rope, in m.
const RADIUS: f32 = 0.022;
/// Where the knot is, in m.
const HEIGHT: f32 = 1.0;
/// Of the balls that its ends are held by, in m.
const GRIP: f32 = 0.05;
/// When it begins to be pulled, and how fast each end, in s and m/s.
const BEGIN: f32 = 0.3;
const SPEED: f32 = 0.25;

fn knot(p: &Parameters) -> Scene {
    let segments = p.count("segments");
    let points = evenly(&overhand(4000), segments);
    let length: f32 = points.windows(2).map(|two| two[0].distance(two[1])).sum();
    let rope = Rope {
        name: Some("rope".to_owned()),
        path: Thread::Points(points.iter().map(Vec3::to_array).collect()),
        radius: RADIUS,
        mass: 0.5,
        self_collision: true,
        bending: Some(2.0),
        color: Some(Color([196, 142, 74])),
        ..Rope::default()
    };
    let (first, last) = (points[0], points[segments as usize]);
    let pulled = length - p.count("left") as f32 * RADIUS - first.distance(last);
    let duration = pulled.max(0.0) / (2.0 * SPEED);
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Rope(rope)];
    let (mut attachments, mut cues) = (Vec::new(), Vec::new());
    for (name, end, particle, way) in [("left", first, 0, -1.0), ("right", last, segments, 1.0)] {
        bodies.push(Body::Rigid(Rigid {
            name: Some(name.to_owned()),
            shape: Shape::Sphere { radius: GRIP },
            position: (end + Vec3::X * (way * (GRIP + RADIUS))).to_array(),
            motion: Some(Motion::Kinematic),
            color: Some(Color([88, 94, 106])),
            ..Rigid::default()
        }));
        attachments.push(on_body("rope", particle, name, end.to_array()));
        cues.extend([(BEGIN, way * SPEED), (BEGIN + duration, 0.0)].map(|(at, speed)| Cue {
            at,
            body: BodyRef::Name(name.to_owned()),
            velocity: [speed, 0.0, 0.0],
            angular_velocity: [0.0; 3],
        }));
    }
    let camera = Some(Camera { eye: [0.3, 1.5, 3.9], target: [0.0, 0.95, 0.0], fov: 40.0 });
    Scene { seconds: 4.0, record_every: 2, bodies, attachments, cues, camera, ..Scene::default() }
}

/// A curve with an overhand knot in it whose ends lead away along X: Shastri's, x = t³ − 3t, y = t⁴ − 4t²,
/// z = t⁵ − 10t (Tôhoku Mathematical Journal 44, 1992), turned so that what he calls z leads along the rope.
fn overhand(count: u32) -> Vec<Vec3> {
    let point = |i: u32| {
        let t = 4.44 * i as f32 / count as f32 - 2.22;
        let [x, y, z] = [t * t * t - 3.0 * t, t * t * (t * t - 4.0), t * (t * t * t * t - 10.0)];
        Vec3::new(0.032 * z, HEIGHT + 0.07 * y, 0.09 * x)
    };
    (0..=count).map(point).collect()
}

/// So many points at equal distances along a line through many.
fn evenly(line: &[Vec3], segments: u32) -> Vec<Vec3> {
    let length: f32 = line.windows(2).map(|two| two[0].distance(two[1])).sum();
    let (mut points, mut passed) = (vec![line[0]], 0.0);
    for two in line.windows(2) {
        let along = two[0].distance(two[1]);
        let next = length * points.len() as f32 / segments as f32;
        if passed + along >= next && points.len() < segments as usize {
            points.push(two[0].lerp(two[1], (next - passed) / along));
        }
        passed += along;
    }
    points.extend(line.last());
    points
}
