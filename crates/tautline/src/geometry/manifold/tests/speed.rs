//! What a call costs: `cargo test --release -p tautline --lib manifold::tests::speed -- --ignored --nocapture`.

// The tidy check takes what follows this line for tests.
#[cfg(test)]
use std::hint::black_box;
use std::time::Instant;

use glam::{Quat, Vec3};

use super::oracle::signed_distance;
use super::shapes::*;
use super::*;

/// Pairs that are gone round, so that the processor does not learn one by heart.
const PAIRS: usize = 256;
const ROUNDS: usize = 400;

struct Bench<'a> {
    shapes: [&'a Convex; 2],
    pairs: &'a mut [(Placement, Memory)],
    margin: f32,
    scratch: Scratch,
}

impl Kernel for &mut Bench<'_> {
    type Output = usize;

    #[inline(always)]
    fn run<L: Lanes>(self) -> usize {
        let mut points = 0;
        for (placement, memory) in self.pairs.iter_mut() {
            let memory = (memory, &mut self.scratch);
            points += collide::<L>(self.shapes[0], self.shapes[1], placement, memory, self.margin).count;
        }
        points
    }
}

/// Nanoseconds for a call in the quickest round, and the mean number of points, of pairs that stir by about a
/// millimetre between calls.
fn measure(shapes: [&Convex; 2], mut pairs: Vec<(Placement, Memory)>, margin: f32) -> (f64, f64) {
    let mut random = Random(5);
    let rest: Vec<Placement> = pairs.iter().map(|pair| pair.0).collect();
    let mut bench = Bench { shapes, pairs: &mut pairs, margin, scratch: Scratch::default() };
    run(Instructions::Widest, &mut bench);
    let (mut points, mut least) = (0, f64::INFINITY);
    for _ in 0..ROUNDS {
        let turn = Mat3::from_quat(Quat::from_scaled_axis(random.vector() * 0.001));
        let shift = random.vector() * 0.0005;
        for ((placement, _), rest) in bench.pairs.iter_mut().zip(&rest) {
            *placement = Placement { rotation: turn * rest.rotation, translation: rest.translation + shift };
        }
        let start = Instant::now();
        points += black_box(run(Instructions::Widest, &mut bench));
        least = least.min(start.elapsed().as_secs_f64());
    }
    (least / PAIRS as f64 * 1e9, points as f64 / (PAIRS * ROUNDS) as f64)
}

/// Pairs at a distance, turned at random.
fn loose(shapes: [&Convex; 2], gap: f32) -> Vec<(Placement, Memory)> {
    let mut random = Random(3);
    let placement = |_| {
        let rotation = random.rotation();
        let direction = random.direction();
        let mut at = placed(rotation, direction * 2.0);
        for _ in 0..30 {
            let distance = signed_distance(shapes[0], shapes[1], &at) as f32;
            at.translation += direction * (gap - distance);
        }
        (at, Memory::default())
    };
    (0..PAIRS).map(placement).collect()
}

/// Pairs that lie on each other with the faces `face` of A and of B, overlapping by a millimetre.
fn stacked(shapes: [&Convex; 2]) -> Vec<(Placement, Memory)> {
    let mut random = Random(4);
    let placement = |_| {
        let [a, b] = shapes;
        let (up, down) = (a.faces[random.below(a.faces.len())], b.faces[random.below(b.faces.len())]);
        let middle = |convex: &Convex, face| {
            let corners = convex.corners(face);
            let count = corners.len() as f32;
            corners.map(|(_, p)| p).sum::<Vec3>() / count
        };
        let turn = Quat::from_axis_angle(up.normal, random.signed() * 3.0)
            * Quat::from_rotation_arc(down.normal, -up.normal);
        let offset = up.normal.any_orthonormal_vector() * random.signed() * 0.1;
        let at = middle(a, up) + offset - turn * middle(b, down) - up.normal * 0.001;
        (placed(turn, at), Memory::default())
    };
    (0..PAIRS).map(placement).collect()
}

#[test]
#[ignore = "it measures"]
fn nanoseconds_per_call() {
    let shapes = [("icosahedra", icosahedron(0.5)), ("boxes", cuboid(Vec3::splat(0.5)))];
    for (name, shape) in &shapes {
        let both = [shape, shape];
        let show = |case: &str, (time, points): (f64, f64)| {
            println!("{name:12} {case:24} {time:7.1} ns {points:5.2} points");
        };
        show("apart", measure(both, loose(both, 0.1), 0.02));
        show("within margin", measure(both, loose(both, 0.01), 0.02));
        show("vertex, edge touching", measure(both, loose(both, -0.001), 0.02));
        show("face on face", measure(both, stacked(both), 0.02));
    }
    let (ball, capsule, cube) = (ball(0.5), capsule(0.2, 0.4), cuboid(Vec3::splat(0.5)));
    let others = [
        ("balls", [&ball, &ball]),
        ("ball on box", [&cube, &ball]),
        ("capsules", [&capsule, &capsule]),
        ("capsule on box", [&cube, &capsule]),
    ];
    for (name, both) in others {
        let (time, points) = measure(both, loose(both, -0.001), 0.02);
        println!("{name:12} touching {time:7.1} ns {points:5.2} points");
    }
}
