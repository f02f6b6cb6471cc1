//! The signed distance of two convex hulls, by tautline and by parry3d: time per query, and how far the two differ. The same
//! points for both, one thread, in turns.

use std::hint::black_box;
use std::time::Instant;

use parry3d::math::{Pose, Vector};
use parry3d::query;
use parry3d::shape::ConvexPolyhedron;
use tautline::geometry::distance::distance;
use tautline::{Quat, Vec3};

/// Pairs of each shape and placement.
const PAIRS: usize = 512;
/// Times that each side goes through them; the fastest time counts.
const ROUNDS: usize = 40;

/// What a pair is made of: a name and the points, on the unit sphere.
type Solid = (&'static str, fn() -> Vec<Vec3>);
/// How far the centres are apart, in radii.
type Placement = (&'static str, [f32; 2]);

const SOLIDS: [Solid; 4] =
    [("cube", cube), ("icosahedron", icosahedron), ("32 points", || ball(32)), ("128 points", || ball(128))];

const PLACEMENTS: [Placement; 4] =
    [("apart", [2.5, 4.0]), ("near", [1.9, 2.1]), ("touching", [1.5, 1.7]), ("deep", [0.2, 1.0])];

struct Pair {
    points: [Vec<Vec3>; 2],
    hulls: [ConvexPolyhedron; 2],
    /// Where the second hull is, whose points are about its own centre.
    pose: Pose,
}

/// Seconds per query of either side, and the largest difference of their answers, in m.
struct Measured {
    ours: f64,
    peer: f64,
    difference: f32,
    /// Queries that parry3d gave no answer to.
    unanswered: usize,
}

fn main() -> Result<(), String> {
    println!(
        "{:12} {:10} {:>10} {:>10} {:>7} {:>12}",
        "hulls", "lie", "tautline", "parry3d", "ratio", "differ by"
    );
    let mut ratios = Vec::new();
    for (name, points) in SOLIDS {
        for (placement, apart) in PLACEMENTS {
            let measured = measure(&pairs(&points(), apart)?);
            let ratio = measured.ours / measured.peer;
            ratios.push(ratio);
            let [ours, peer] =
                [measured.ours, measured.peer].map(|seconds| format!("{:.0} ns", 1e9 * seconds));
            let note = if measured.unanswered > 0 {
                format!(" ({} unanswered)", measured.unanswered)
            } else {
                String::new()
            };
            println!(
                "{name:12} {placement:10} {ours:>10} {peer:>10} {ratio:7.2} {:>10.1e} m{note}",
                measured.difference
            );
        }
    }
    let mean = ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64;
    println!("geometric mean of the ratios: {:.2}", mean.exp());
    Ok(())
}

fn measure(pairs: &[Pair]) -> Measured {
    let mut measured = Measured { ours: f64::INFINITY, peer: f64::INFINITY, difference: 0.0, unanswered: 0 };
    for pair in pairs {
        match (ours(pair), peer(pair)) {
            (Some(ours), Some(peer)) => measured.difference = measured.difference.max((ours - peer).abs()),
            _ => measured.unanswered += 1,
        }
    }
    for _ in 0..ROUNDS {
        measured.ours = measured.ours.min(seconds_each(pairs, ours));
        measured.peer = measured.peer.min(seconds_each(pairs, peer));
    }
    measured
}

fn seconds_each(pairs: &[Pair], query: fn(&Pair) -> Option<f32>) -> f64 {
    let start = Instant::now();
    for pair in pairs {
        black_box(query(black_box(pair)));
    }
    start.elapsed().as_secs_f64() / pairs.len() as f64
}

fn ours(pair: &Pair) -> Option<f32> {
    let [a, b] = &pair.points;
    distance(a, b).ok().map(|found| found.distance)
}

/// Its query that also tells how deep two shapes are in each other.
fn peer(pair: &Pair) -> Option<f32> {
    let [a, b] = &pair.hulls;
    query::contact(&Pose::IDENTITY, a, &pair.pose, b, f32::MAX).ok().flatten().map(|contact| contact.dist)
}

/// Both turned at random, their centres so many radii apart.
fn pairs(points: &[Vec3], [near, far]: [f32; 2]) -> Result<Vec<Pair>, String> {
    let mut random = Random(1);
    let mut pairs = Vec::with_capacity(PAIRS);
    for i in 0..PAIRS {
        let apart = near + (far - near) * i as f32 / PAIRS as f32;
        let center = random.direction() * apart;
        let [a, b] = [random.rotation(), random.rotation()]
            .map(|turn| points.iter().map(|&point| turn * point).collect::<Vec<_>>());
        let hulls = [hull(&a)?, hull(&b)?];
        let moved = b.iter().map(|&point| point + center).collect();
        pairs.push(Pair { points: [a, moved], hulls, pose: Pose::from_translation(vector(center)) });
    }
    Ok(pairs)
}

fn hull(points: &[Vec3]) -> Result<ConvexPolyhedron, String> {
    let points: Vec<Vector> = points.iter().copied().map(vector).collect();
    ConvexPolyhedron::from_convex_hull(&points)
        .ok_or_else(|| "parry3d makes no hull of the points".to_owned())
}

fn vector(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn cube() -> Vec<Vec3> {
    let half = 1.0 / 3.0_f32.sqrt();
    let sign = |i: u32, bit: u32| if i >> bit & 1 == 0 { -half } else { half };
    (0..8).map(|i| Vec3::new(sign(i, 0), sign(i, 1), sign(i, 2))).collect()
}

fn icosahedron() -> Vec<Vec3> {
    let (s, l) = (0.525_731_1, 0.850_650_8);
    let ends = [(s, l), (-s, l), (s, -l), (-s, -l)];
    ends.into_iter()
        .flat_map(|(i, j)| [Vec3::new(i, j, 0.0), Vec3::new(0.0, i, j), Vec3::new(j, 0.0, i)])
        .collect()
}

fn ball(count: usize) -> Vec<Vec3> {
    let mut random = Random(count as u64);
    (0..count).map(|_| random.direction()).collect()
}

/// A linear congruential generator: the same pairs on every machine.
struct Random(u64);

impl Random {
    /// Uniform in [−1, 1).
    fn number(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let point = Vec3::new(self.number(), self.number(), self.number());
            if (0.01..1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }

    fn rotation(&mut self) -> Quat {
        Quat::from_xyzw(self.number(), self.number(), self.number(), self.number()).normalize()
    }
}
