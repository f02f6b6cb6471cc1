//! Scenes with rope.

use super::{NamedScene, Parameter, Parameters};
use crate::document::{Body, HalfSpace, Pin, Rope, RopeEnd, Scene, Settings, Thread, Weight};

pub(super) const CATENARY: NamedScene = NamedScene {
    name: "catenary",
    description: "A rope of 3 m held at two points 2 m apart is let go from a V and settles in a catenary.",
    parameters: &[Parameter::count("links", "segments of the rope", 50, (2, 500))],
    document: catenary,
};

fn catenary(p: &Parameters) -> Scene {
    let links = p.count("links");
    // Half of 3 m down from each end: √(1.5² − 1²) m.
    let drop = 1.25f32.sqrt();
    let height = 1.6;
    let point = |i: u32| {
        let x = 2.0 * i as f32 / links as f32 - 1.0;
        [x, height - drop * (1.0 - x.abs()), 0.0]
    };
    let rope = Rope {
        path: Thread::Points((0..=links).map(point).collect()),
        length: Some(3.0),
        pins: vec![Pin::Place(RopeEnd::First), Pin::Place(RopeEnd::Last)],
        radius: 0.015,
        ..Rope::default()
    };
    let bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Rope(rope)];
    let settings = Settings { damping: Some(1.0), ..Settings::default() };
    Scene { seconds: 6.0, record_every: 2, settings, bodies, ..Scene::default() }
}

pub(super) const WHIP: NamedScene = NamedScene {
    name: "whip",
    description: "A rope with a heavy end is let go level and swings like a whip.",
    parameters: &[Parameter::count("links", "segments of the rope", 40, (1, 500))],
    document: whip,
};

fn whip(p: &Parameters) -> Scene {
    let rope = Rope {
        path: Thread::Line { from: [0.0, 2.5, 0.0], to: [2.0, 2.5, 0.0], segments: p.count("links") },
        pins: vec![Pin::Place(RopeEnd::First)],
        radius: 0.03,
        weights: vec![Weight { at: Pin::Place(RopeEnd::Last), mass: 0.5 }],
        ..Rope::default()
    };
    let bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Rope(rope)];
    let settings = Settings { damping: Some(0.1), ..Settings::default() };
    Scene { seconds: 6.0, record_every: 2, settings, bodies, ..Scene::default() }
}

/// A rope's points, equally far along the catenary of `length` m between two ends `span` m apart at `height` m.
pub(super) fn hanging(span: f64, length: f64, height: f64, segments: u32) -> Vec<[f32; 3]> {
    let a = catenary_parameter(span, length);
    let top = a * libm::cosh(span / (2.0 * a));
    let point = |i: u32| {
        // s = a sinh(x/a) from the lowest point.
        let s = length * (f64::from(i) / f64::from(segments) - 0.5);
        let x = a * libm::asinh(s / a);
        [x, height - top + a * libm::cosh(x / a), 0.0].map(|coordinate| coordinate as f32)
    };
    (0..=segments).map(point).collect()
}

/// The a of y = a cosh(x/a) with 2a sinh(span/2a) = length, by bisection: the length falls with a.
fn catenary_parameter(span: f64, length: f64) -> f64 {
    let (mut low, mut high) = (0.01 * span, 100.0 * span);
    for _ in 0..100 {
        let a = (low + high) / 2.0;
        if 2.0 * a * libm::sinh(span / (2.0 * a)) > length { low = a } else { high = a }
    }
    (low + high) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hanging_rope_has_its_length_and_span() {
        let points = hanging(2.6, 3.0, 2.5, 400);
        let (first, last) = (points[0], points[400]);
        assert!((last[0] - first[0] - 2.6).abs() < 1e-5 && (first[1] - 2.5).abs() < 1e-5);
        let length: f32 = points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum();
        assert!((length - 3.0).abs() < 1e-4, "{length}");
    }
}
