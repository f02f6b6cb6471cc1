//! What a pair of convex bodies costs in a step: `cargo bench -p tautline --bench gjk`. Every figure is the time
//! of one pair; each case goes round many pairs, so that branch prediction cannot learn them by heart.

use divan::{Bencher, black_box};
use tautline::geometry::distance::{contact, distance};
use tautline::geometry::epa::Epa;
use tautline::geometry::gjk;
use tautline::geometry::support::{Points, Support};
use tautline::{DVec3, Quat, Vec3};

const PAIRS: usize = 1024;

type Pair = (Vec<Vec3>, Vec<Vec3>);

fn main() {
    divan::main();
}

#[divan::bench(args = SHAPES)]
fn separated_cached(bencher: Bencher, shape: &Shape) {
    let mut pairs = shape.pairs(2.1, 2.5).into_iter().map(|pair| (pair, Vec3::ZERO)).collect::<Vec<_>>();
    for ((a, b), axis) in &mut pairs {
        gjk::intersect(&Points(a), &Points(b), axis);
    }
    let mut i = 0;
    bencher.bench_local(|| {
        i = (i + 1) % PAIRS;
        let ((a, b), axis) = &mut pairs[i];
        gjk::intersect(&Points(a), &Points(b), axis).proximity
    });
}

#[divan::bench(args = SHAPES)]
fn separated_cold(bencher: Bencher, shape: &Shape) {
    let pairs = shape.pairs(2.1, 2.5);
    let mut i = 0;
    bencher.bench_local(|| {
        i = (i + 1) % PAIRS;
        let (a, b) = &pairs[i];
        let mut axis = Vec3::ZERO;
        gjk::intersect(&Points(a), &Points(b), &mut axis).proximity
    });
}

#[divan::bench(args = SHAPES)]
fn intersecting_cached(bencher: Bencher, shape: &Shape) {
    let mut pairs = shape.pairs(1.3, 1.5).into_iter().map(|pair| (pair, Vec3::ZERO)).collect::<Vec<_>>();
    let mut epa = Epa::default();
    let mut i = 0;
    bencher.bench_local(|| {
        i = (i + 1) % PAIRS;
        let ((a, b), axis) = &mut pairs[i];
        contact(&Points(a), &Points(b), axis, &mut epa)
    });
}

#[divan::bench(args = SHAPES)]
fn intersecting_cold(bencher: Bencher, shape: &Shape) {
    let pairs = shape.pairs(1.3, 1.5);
    let mut epa = Epa::default();
    let mut i = 0;
    bencher.bench_local(|| {
        i = (i + 1) % PAIRS;
        let (a, b) = &pairs[i];
        let mut axis = Vec3::ZERO;
        contact(&Points(a), &Points(b), &mut axis, &mut epa)
    });
}

#[divan::bench(args = SHAPES)]
fn distance_query(bencher: Bencher, shape: &Shape) {
    let pairs = shape.pairs(1.0, 3.0);
    let mut i = 0;
    bencher.bench_local(|| {
        i = (i + 1) % PAIRS;
        distance(&pairs[i].0, &pairs[i].1)
    });
}

#[divan::bench(args = SHAPES)]
fn support(bencher: Bencher, shape: &Shape) {
    let pairs = shape.pairs(2.1, 2.5);
    let mut i = 0;
    bencher.bench_local(|| {
        i = (i + 1) % PAIRS;
        Points(&pairs[i].0).support(black_box(DVec3::new(0.3, 0.2, -0.7)))
    });
}

/// A body of unit radius, turned at random in every pair.
struct Shape {
    name: &'static str,
    points: fn() -> Vec<Vec3>,
}

const SHAPES: [Shape; 2] =
    [Shape { name: "icosahedra", points: icosahedron }, Shape { name: "boxes", points: cube }];

impl std::fmt::Display for Shape {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl Shape {
    /// Pairs whose centres lie between two distances, in radii.
    fn pairs(&self, near: f32, far: f32) -> Vec<Pair> {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
        };
        let mut body = |at: Vec3| -> Vec<Vec3> {
            let turn = Quat::from_xyzw(random(), random(), random(), random()).normalize();
            (self.points)().into_iter().map(|p| turn * p + at).collect()
        };
        (0..PAIRS)
            .map(|i| {
                let offset = near + (far - near) * i as f32 / PAIRS as f32;
                (body(Vec3::ZERO), body(Vec3::new(0.6, 0.0, 0.8) * offset))
            })
            .collect()
    }
}

fn icosahedron() -> Vec<Vec3> {
    let (s, l) = (0.525_731_1, 0.850_650_8);
    let ends = [(s, l), (-s, l), (s, -l), (-s, -l)];
    ends.into_iter()
        .flat_map(|(i, j)| [Vec3::new(i, j, 0.0), Vec3::new(0.0, i, j), Vec3::new(j, 0.0, i)])
        .collect()
}

fn cube() -> Vec<Vec3> {
    let half = 1.0 / 3.0_f32.sqrt();
    let sign = |i: u32, bit: u32| if i >> bit & 1 == 0 { -half } else { half };
    (0..8).map(|i| Vec3::new(sign(i, 0), sign(i, 1), sign(i, 2))).collect()
}
