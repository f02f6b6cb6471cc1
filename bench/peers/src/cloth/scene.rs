//! The two scenes that every engine is given: a square of cloth above a cube, and above a rope.

use glam::Vec3;
use tautline_scene::random::Random;

/// Along each side of the cloth, in m; it weighs 1 kg.
pub(super) const SIDE: f32 = 2.0;
/// Half of the side of the cube, which is fixed and stands on the floor, in m.
pub(super) const CUBE_HALF: f32 = 0.5;
/// Of everything.
pub(super) const FRICTION: f32 = 0.5;
/// Rate at which the motion of the cloth dies out in the air, in 1/s.
pub(super) const AIR_DAMPING: f32 = 0.1;
/// Of the rope, in m; it weighs 1 kg.
pub(super) const ROPE_RADIUS: f32 = 0.02;
/// Along the rope, in m.
pub(super) const ROPE_LENGTH: f64 = 3.0;
pub(super) const ROPE_SEGMENTS: u32 = 50;
/// How far particles are moved up or down at the start, in m: enough that no two runs are alike, too little to stretch an
/// edge by more than 5e-5.
const NOISE: f32 = 1e-4;

/// What the cloth falls on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Support {
    /// A fixed cube of 1 m.
    Cube,
    /// A rope that is held at both ends, 2.6 m apart.
    Rope,
}

/// A scene at its beginning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Start {
    pub(super) support: Support,
    /// Particles along each side of the cloth.
    pub(super) n: u32,
    /// Of the noise.
    pub(super) seed: u64,
}

impl Support {
    /// What the experiment is called.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Cube => "e2",
            Self::Rope => "e3",
        }
    }
}

impl Start {
    /// How high the cloth is, in m.
    pub(super) fn height(&self) -> f32 {
        match self.support {
            Support::Cube => 2.0 * CUBE_HALF + 0.5,
            Support::Rope => ROPE_END_HEIGHT as f32 + 0.1,
        }
    }

    /// Where the cloth's particles are: column after column along x, in rows along z, particle `row·n + column`.
    pub(super) fn positions(&self) -> Vec<Vec3> {
        let mut random = Random::new(self.seed);
        let along = |i: u32| SIDE * (i as f32 / (self.n - 1) as f32 - 0.5);
        let places = (0..self.n).flat_map(|row| (0..self.n).map(move |column| (column, row)));
        let position = |(column, row)| {
            Vec3::new(along(column), self.height() + random.between(-NOISE, NOISE), along(row))
        };
        places.map(position).collect()
    }

    /// The particles of the rope, if there is one.
    pub(super) fn rope(&self) -> Vec<Vec3> {
        match self.support {
            Support::Cube => Vec::new(),
            Support::Rope => rope(),
        }
    }
}

const ROPE_HALF_SPAN: f64 = 1.3;
const ROPE_END_HEIGHT: f64 = 2.5;

/// Equally far along the parabola of [`ROPE_LENGTH`] between both ends: y = c x² + const.
fn rope() -> Vec<Vec3> {
    let half_length = 0.5 * ROPE_LENGTH;
    let c = solve(|c| arc_length(c, ROPE_HALF_SPAN) - half_length, 10.0);
    let point = |i: u32| {
        let from_middle = ROPE_LENGTH * (f64::from(i) / f64::from(ROPE_SEGMENTS) - 0.5);
        let x = solve(|x| arc_length(c, x) - from_middle.abs(), ROPE_HALF_SPAN).copysign(from_middle);
        let y = ROPE_END_HEIGHT - c * (ROPE_HALF_SPAN * ROPE_HALF_SPAN - x * x);
        Vec3::new(x as f32, y as f32, 0.0)
    };
    (0..=ROPE_SEGMENTS).map(point).collect()
}

/// Of y = c x² from its lowest point to x, c > 0: with t = 2 c x it is (t √(1 + t²) + arsinh t)/4c.
fn arc_length(c: f64, x: f64) -> f64 {
    let t = 2.0 * c * x;
    if t == 0.0 { x } else { (t * (1.0 + t * t).sqrt() + t.asinh()) / (4.0 * c) }
}

/// Where a function that grows is 0, between 0 and `most`.
fn solve(function: impl Fn(f64) -> f64, most: f64) -> f64 {
    let (mut low, mut high) = (0.0, most);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rope_hangs_between_its_ends_in_equal_parts() {
        let rope = rope();
        assert_eq!(rope.len(), 51);
        assert!(rope[0].distance(Vec3::new(-1.3, 2.5, 0.0)) < 1e-6);
        assert!(rope[50].distance(Vec3::new(1.3, 2.5, 0.0)) < 1e-6);
        let lengths: Vec<f32> = rope.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
        assert!(lengths.iter().all(|length| (length - 0.06).abs() < 2e-5), "{lengths:?}");
        // Found once by integrating in 200 000 steps.
        assert!(rope[1].distance(Vec3::new(-1.257_699_4, 2.457_449_1, 0.0)) < 1e-6, "{}", rope[1]);
        assert!(rope[3].distance(Vec3::new(-1.170_927_7, 2.374_568_8, 0.0)) < 1e-6, "{}", rope[3]);
    }

    #[test]
    fn starts_differ_by_noise_and_only_by_that() {
        let start = |seed: u64| Start { support: Support::Rope, n: 20, seed }.positions();
        assert_eq!(start(1), start(1));
        let (a, b) = (start(1), start(2));
        assert_ne!(a, b);
        let apart = a.iter().zip(&b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(apart <= 2.0 * NOISE + 1e-6, "{apart}");
        assert_eq!((a[19].x, a[19].z, a[380].x, a[380].z), (1.0, -1.0, -1.0, 1.0));
    }
}
