//! Pairs of point sets of every kind that has ever broken a distance query.

use tautline::geometry::distance::distance;
use tautline::{Quat, Vec3};

pub(crate) type Pair = (Vec<Vec3>, Vec<Vec3>);
type Case = (&'static str, fn(&mut Random) -> Pair);

/// SplitMix64: the same pairs on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.bits() >> 40) as f32 / (1u64 << 24) as f32)
    }

    pub(crate) fn index(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    pub(crate) fn point(&mut self, reach: f32) -> Vec3 {
        Vec3::from_array([0; 3].map(|_| self.between(-reach, reach)))
    }

    pub(crate) fn rotation(&mut self) -> Quat {
        let [x, y, z, w] = [0; 4].map(|_| self.between(-1.0, 1.0));
        Quat::from_xyzw(x, y, z, w + 1e-3).normalize()
    }
}

/// Name and generator of each case.
pub(crate) const CASES: [Case; 30] = [
    ("random hulls", |r| (hull(r, 1.0), moved(hull(r, 1.0), r.point(1.6)))),
    ("random hulls of 20", |r| (cloud(r, 20, 1.0), moved(cloud(r, 20, 1.0), r.point(1.5)))),
    ("boxes", |r| (turned(block(r), r.rotation()), moved(turned(block(r), r.rotation()), r.point(1.2)))),
    ("boxes on a grid", |r| (grid_block(r), grid_block(r))),
    ("icosahedra", |r| {
        (turned(icosahedron(), r.rotation()), moved(turned(icosahedron(), r.rotation()), r.point(1.2)))
    }),
    ("touching", |r| kissing(r, 1.0, 0.0)),
    ("1 m, gap 1e-6", |r| kissing(r, 1.0, 1e-6)),
    ("1 m, depth 1e-6", |r| kissing(r, 1.0, -1e-6)),
    ("0.25 m, gap 1e-6", |r| kissing(r, 0.125, 1e-6)),
    ("0.25 m, depth 1e-6", |r| kissing(r, 0.125, -1e-6)),
    ("1 km, gap 1e-3", |r| kissing(r, 500.0, 1e-3)),
    ("1 km, depth 1e-3", |r| kissing(r, 500.0, -1e-3)),
    ("face on face", face_on_face),
    ("deep", |r| (solid(r), moved(solid(r), r.point(0.05)))),
    ("coincident", |r| {
        let a = solid(r);
        (a.clone(), a)
    }),
    ("nearly coincident", |r| {
        let a = solid(r);
        (a.clone(), moved(a, r.point(1e-6)))
    }),
    ("contained", |r| (hull(r, 1.0), moved(scaled(hull(r, 1.0), 0.05), r.point(0.1)))),
    ("flat, 1e-6 thick", |r| {
        let at = Vec3::new(r.between(-1.0, 1.0), r.between(-3e-6, 3e-6), r.between(-1.0, 1.0));
        (plate(r), moved(plate(r), at))
    }),
    ("flat, tilted", |r| {
        (turned(plate(r), r.rotation()), moved(turned(plate(r), r.rotation()), r.point(0.5)))
    }),
    ("lattice points", |r| (lattice(r), lattice(r))),
    ("needles", |r| (needle(r), moved(needle(r), r.point(0.1)))),
    ("segment and solid", |r| (cloud(r, 2, 1.0), moved(solid(r), r.point(1.0)))),
    ("point and solid", |r| (cloud(r, 1, 1.0), moved(solid(r), r.point(1.0)))),
    ("triangles", |r| (cloud(r, 3, 1.0), moved(cloud(r, 3, 1.0), r.point(0.5)))),
    ("triangles, touching", |r| {
        let (a, b) = (cloud(r, 3, 1.0), cloud(r, 3, 1.0));
        shifted_to(a, b, 0.0)
    }),
    ("slivers", |r| (sliver(r), moved(sliver(r), r.point(0.3)))),
    ("coplanar triangles", |r| (flattened(cloud(r, 3, 1.0)), flattened(cloud(r, 3, 1.0)))),
    ("collinear", |r| (line(r), moved(line(r), r.point(0.5)))),
    ("duplicates", |r| (doubled(r), doubled(r))),
    ("100 m against 0.1 m", |r| {
        let (a, at) = (scaled(solid(r), 100.0), r.point(100.0));
        (a, moved(scaled(solid(r), 0.1), at))
    }),
];

pub(crate) fn icosahedron() -> Vec<Vec3> {
    let (s, l) = (0.525_731_1, 0.850_650_8);
    let mut points = Vec::new();
    for (i, j) in [(s, l), (-s, l), (s, -l), (-s, -l)] {
        points.extend([Vec3::new(i, j, 0.0), Vec3::new(0.0, i, j), Vec3::new(j, 0.0, i)]);
    }
    points
}

pub(crate) fn block_of(half: Vec3) -> Vec<Vec3> {
    let sign = |i: usize, bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
    (0..8).map(|i| half * Vec3::new(sign(i, 0), sign(i, 1), sign(i, 2))).collect()
}

pub(crate) fn moved(points: Vec<Vec3>, by: Vec3) -> Vec<Vec3> {
    points.into_iter().map(|p| p + by).collect()
}

pub(crate) fn turned(points: Vec<Vec3>, rotation: Quat) -> Vec<Vec3> {
    points.into_iter().map(|p| rotation * p).collect()
}

fn scaled(points: Vec<Vec3>, by: f32) -> Vec<Vec3> {
    points.into_iter().map(|p| p * by).collect()
}

fn cloud(r: &mut Random, count: usize, reach: f32) -> Vec<Vec3> {
    (0..count).map(|_| r.point(reach)).collect()
}

fn hull(r: &mut Random, reach: f32) -> Vec<Vec3> {
    let count = 4 + r.index(9);
    cloud(r, count, reach)
}

fn block(r: &mut Random) -> Vec<Vec3> {
    block_of(Vec3::from_array([0; 3].map(|_| r.between(0.05, 1.0))))
}

/// Corners and faces on multiples of ¼: most pairs share planes, edges or corners.
fn grid_block(r: &mut Random) -> Vec<Vec3> {
    let half = Vec3::from_array([0; 3].map(|_| 0.25 * (1 + r.index(3)) as f32));
    let at = Vec3::from_array([0; 3].map(|_| 0.25 * r.index(7) as f32));
    moved(block_of(half), at)
}

/// A random hull, a turned box, a box or a turned icosahedron.
pub(crate) fn solid(r: &mut Random) -> Vec<Vec3> {
    match r.index(4) {
        0 => hull(r, 1.0),
        1 => turned(block(r), r.rotation()),
        2 => block(r),
        _ => turned(icosahedron(), r.rotation()),
    }
}

/// Two solids of this radius, `gap` apart.
fn kissing(r: &mut Random, radius: f32, gap: f32) -> Pair {
    let (a, b) = (solid(r), moved(solid(r), r.point(1.5)));
    shifted_to(scaled(a, radius), scaled(b, radius), gap)
}

/// A pair moved together or apart until its signed distance is `gap`, within the rounding of its coordinates.
fn shifted_to(a: Vec<Vec3>, mut b: Vec<Vec3>, gap: f32) -> Pair {
    for _ in 0..2 {
        let found = distance(&a, &b).unwrap();
        b = moved(b, found.normal * (gap - found.distance));
    }
    (a, b)
}

/// Boxes turned alike, one on the other, from a millionth of a metre above to as much below its face.
fn face_on_face(r: &mut Random) -> Pair {
    let (lower, upper) = (block(r), block(r));
    let top = |points: &[Vec3]| points.iter().map(|p| p.y).fold(0.0, f32::max);
    let above = Vec3::new(r.between(-0.5, 0.5), top(&lower) + top(&upper) + r.between(-1e-6, 1e-6), 0.1);
    let turn = if r.index(2) == 0 { Quat::IDENTITY } else { r.rotation() };
    (turned(lower, turn), turned(moved(upper, above), turn))
}

/// A triangle whose third corner is next to the line through the others.
fn sliver(r: &mut Random) -> Vec<Vec3> {
    let (p, q) = (r.point(1.0), r.point(1.0));
    vec![p, q, p.lerp(q, r.between(0.0, 1.0)) + r.point(1e-6)]
}

fn plate(r: &mut Random) -> Vec<Vec3> {
    let half = Vec3::new(r.between(0.2, 1.0), 0.5e-6, r.between(0.2, 1.0));
    let tilt = if r.index(2) == 0 { Quat::IDENTITY } else { Quat::from_rotation_y(r.between(0.0, 3.0)) };
    turned(block_of(half), tilt)
}

/// Points of a 4 × 4 × 4 lattice: full of faces with many corners, collinear triples and exact contact.
fn lattice(r: &mut Random) -> Vec<Vec3> {
    let at = Vec3::from_array([0; 3].map(|_| r.index(4) as f32));
    let count = 4 + r.index(9);
    (0..count).map(|_| (at + Vec3::from_array([0; 3].map(|_| r.index(4) as f32))) * 0.25).collect()
}

fn needle(r: &mut Random) -> Vec<Vec3> {
    let half = Vec3::new(r.between(1e-5, 1e-3), r.between(1e-5, 1e-3), 1.0);
    turned(block_of(half), r.rotation())
}

fn flattened(points: Vec<Vec3>) -> Vec<Vec3> {
    points.into_iter().map(|p| Vec3::new(p.x, 0.25, p.z)).collect()
}

fn line(r: &mut Random) -> Vec<Vec3> {
    // Multiples of a step that is exact in f32: truly collinear. Half of them along an axis.
    let step = match r.index(2) {
        0 => Vec3::X * 0.125,
        _ => (r.point(1.0) * 64.0).round() / 64.0,
    };
    (0..3 + r.index(3)).map(|_| step * (r.index(9) as f32 - 4.0)).collect()
}

fn doubled(r: &mut Random) -> Vec<Vec3> {
    let mut points = hull(r, 1.0);
    for _ in 0..4 {
        points.push(points[r.index(points.len())]);
    }
    points
}
