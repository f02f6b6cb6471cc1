//! Closed surfaces to divide: convex, flat-sided, concave, knotted, thin and hollow ones.

use std::collections::BTreeMap;
use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use tautline::mesh::TriMesh;

/// A stream of numbers in 0..1, the same for the same seed (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// A quad a, b, c, d as two triangles, split along a–c or b–d.
fn quad([a, b, c, d]: [u32; 4], along_ac: bool) -> [[u32; 3]; 2] {
    if along_ac { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
}

/// The unit cube; bit k of `diagonals` picks the diagonal of side k.
pub(crate) fn cube(diagonals: u32) -> TriMesh {
    let positions = (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let split = |(k, side): (usize, &[u32; 4])| quad(*side, diagonals >> k & 1 == 0);
    TriMesh { positions, triangles: sides.iter().enumerate().flat_map(split).collect() }
}

pub(crate) fn icosahedron() -> TriMesh {
    let g = (1.0 + 5f32.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for (s, t) in [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
        positions.push(Vec3::new(s, t * g, 0.0));
    }
    for k in 0..4 {
        let Vec3 { x, y, .. } = positions[k];
        positions.push(Vec3::new(0.0, x, y));
    }
    for k in 0..4 {
        let Vec3 { x, y, .. } = positions[k];
        positions.push(Vec3::new(y, 0.0, x));
    }
    hull_by_brute_force(positions)
}

/// The hull of few points in general position.
fn hull_by_brute_force(positions: Vec<Vec3>) -> TriMesh {
    let n = positions.len();
    let mut triangles = Vec::new();
    for (i, j, k) in (0..n).flat_map(|i| (0..n).flat_map(move |j| (0..n).map(move |k| (i, j, k)))) {
        let (a, b, c) = (positions[i], positions[j], positions[k]);
        let normal = (b - a).cross(c - a);
        let is_lowest_rotation = i < j && i < k && j != k;
        if is_lowest_rotation && positions.iter().all(|p| normal.dot(p - a) < 1e-5) {
            triangles.push([i as u32, j as u32, k as u32]);
        }
    }
    TriMesh { positions, triangles }
}

/// Every triangle into four, the new corners pushed out to the unit sphere.
pub(crate) fn icosphere(levels: u32) -> TriMesh {
    let mut mesh = icosahedron();
    for _ in 0..levels {
        let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let mut finer = Vec::new();
        for &[a, b, c] in &mesh.triangles {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]| {
                *middles.entry([p.min(q), p.max(q)]).or_insert_with(|| {
                    mesh.positions.push((mesh.positions[p as usize] + mesh.positions[q as usize]) / 2.0);
                    mesh.positions.len() as u32 - 1
                })
            });
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        mesh.triangles = finer;
    }
    mesh.positions.iter_mut().for_each(|p| *p = p.normalize());
    mesh
}

/// A sphere whose vertices are at random distances from the middle, in 1 − depth .. 1.
pub(crate) fn spiky(levels: u32, depth: f32, seed: u64) -> TriMesh {
    let mut random = Random(seed);
    let mut mesh = icosphere(levels);
    mesh.positions.iter_mut().for_each(|p| *p *= 1.0 - depth * random.unit());
    mesh
}

/// A sphere with a deep round dent from +y.
pub(crate) fn dented(levels: u32) -> TriMesh {
    let mut mesh = icosphere(levels);
    for p in &mut mesh.positions {
        let across = (p.x * p.x + p.z * p.z) / 0.36;
        if p.y > 0.0 && across < 1.0 {
            p.y -= 1.6 * (1.0 - across);
        }
    }
    mesh
}

/// A ball with a round void in it.
pub(crate) fn hollow(levels: u32) -> TriMesh {
    let (mut outer, inner) = (icosphere(levels), icosphere(levels));
    let offset = outer.positions.len() as u32;
    outer.positions.extend(inner.positions.iter().map(|p| p * 0.7));
    outer.triangles.extend(inner.triangles.iter().map(|&[a, b, c]| [a + offset, c + offset, b + offset]));
    outer
}

/// A tube of `sides` corners around a closed curve.
pub(crate) fn tube(rings: u32, sides: u32, radius: f32, curve: impl Fn(f32) -> Vec3) -> TriMesh {
    let mut positions = Vec::new();
    for i in 0..rings {
        let t = i as f32 / rings as f32;
        let (centre, ahead) = (curve(t), (curve(t + 1e-3) - curve(t - 1e-3)).normalize());
        let u = ahead.cross(Vec3::new(0.1, 0.2, 1.0)).normalize();
        let v = ahead.cross(u);
        for j in 0..sides {
            let angle = TAU * j as f32 / sides as f32;
            positions.push(centre + radius * (u * angle.cos() + v * angle.sin()));
        }
    }
    let at = |i: u32, j: u32| i % rings * sides + j % sides;
    let cells = (0..rings).flat_map(|i| (0..sides).map(move |j| (i, j)));
    let triangles =
        cells.flat_map(|(i, j)| quad([at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)], true));
    TriMesh { positions, triangles: triangles.collect() }
}

pub(crate) fn torus(rings: u32, sides: u32, radius: f32) -> TriMesh {
    tube(rings, sides, radius, |t| Vec3::new((TAU * t).cos(), (TAU * t).sin(), 0.0))
}

pub(crate) fn trefoil(rings: u32, sides: u32, radius: f32) -> TriMesh {
    tube(rings, sides, radius, |t| {
        let a = TAU * t;
        let r = 2.0 + (3.0 * a).cos();
        Vec3::new(r * (2.0 * a).cos(), r * (2.0 * a).sin(), (3.0 * a).sin())
    })
}

/// A polygon, counter-clockwise in the xy plane, swept along z in `layers` and turned by `twist` in all;
/// `diagonal` picks the side quads' diagonals by layer and side.
pub(crate) fn extrusion(
    polygon: &[Vec2],
    height: f32,
    layers: u32,
    twist: f32,
    diagonal: impl Fn(u32, u32) -> bool,
) -> TriMesh {
    let n = polygon.len() as u32;
    let mut positions = Vec::new();
    for k in 0..=layers {
        let share = k as f32 / layers as f32;
        let turn = Vec2::from_angle(twist * share);
        positions.extend(polygon.iter().map(|p| turn.rotate(*p).extend(height * share)));
    }
    let mut triangles = Vec::new();
    for [a, b, c] in ears(polygon) {
        let top = layers * n;
        triangles.extend([[a, c, b], [a + top, b + top, c + top]]);
    }
    for (k, i) in (0..layers).flat_map(|k| (0..n).map(move |i| (k, i))) {
        let at = |k: u32, i: u32| k * n + i % n;
        triangles.extend(quad([at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)], diagonal(k, i)));
    }
    TriMesh { positions, triangles }
}

/// A simple polygon into triangles by cutting ears.
fn ears(polygon: &[Vec2]) -> Vec<[u32; 3]> {
    let turn = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|i| polygon[i as usize]);
        (b - a).perp_dot(c - a)
    };
    let mut left: Vec<u32> = (0..polygon.len() as u32).collect();
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let ear = (0..n).find(|&k| {
            let [a, b, c] = [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
            let within = |p: u32| [[a, b, p], [b, c, p], [c, a, p]].iter().all(|&t| turn(t) >= 0.0);
            turn([a, b, c]) > 0.0 && !left.iter().any(|&p| ![a, b, c].contains(&p) && within(p))
        });
        let k = ear.expect("a simple polygon has an ear");
        triangles.push([left[(k + n - 1) % n], left[k], left[(k + 1) % n]]);
        left.remove(k);
    }
    triangles.push([left[0], left[1], left[2]]);
    triangles
}

pub(crate) fn polygon(corners: &[[f32; 2]]) -> Vec<Vec2> {
    corners.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
}

pub(crate) fn regular(n: u32) -> Vec<Vec2> {
    (0..n).map(|i| Vec2::from_angle(TAU * i as f32 / n as f32)).collect()
}

pub(crate) fn star(points: u32, inner: f32) -> Vec<Vec2> {
    let spoke = |i: u32| if i.is_multiple_of(2) { 1.0 } else { inner };
    (0..2 * points).map(|i| Vec2::from_angle(TAU * i as f32 / (2 * points) as f32) * spoke(i)).collect()
}

/// The letter C as a thick arc.
pub(crate) fn letter_c(steps: u32) -> Vec<Vec2> {
    let angle = |i: u32| 0.6 + (TAU - 1.2) * i as f32 / steps as f32;
    let outer = (0..=steps).map(|i| Vec2::from_angle(angle(i)));
    let inner = (0..=steps).rev().map(|i| Vec2::from_angle(angle(i)) * 0.7);
    outer.chain(inner).collect()
}

/// A comb: `teeth` narrow teeth on a bar.
pub(crate) fn comb(teeth: u32) -> Vec<Vec2> {
    let mut outline = vec![Vec2::new(2.0 * teeth as f32 - 1.0, -1.0)];
    for k in (0..teeth).rev() {
        let x = 2.0 * k as f32;
        outline.push(Vec2::new(x + 1.0, if k + 1 == teeth { 5.0 } else { 0.0 }));
        if k + 1 != teeth {
            outline.push(Vec2::new(x + 1.0, 5.0));
        }
        outline.push(Vec2::new(x, 5.0));
        if k > 0 {
            outline.push(Vec2::new(x, 0.0));
        }
    }
    outline.push(Vec2::new(0.0, -1.0));
    outline
}

/// A box whose sides are grids of n × n cells, their diagonals at random.
pub(crate) fn subdivided_box(n: u32, size: Vec3, seed: u64) -> TriMesh {
    let mut random = Random(seed);
    let (mut indices, mut positions, mut triangles) = (BTreeMap::new(), Vec::new(), Vec::new());
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, n)]) {
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let mut at = |i: u32, j: u32| {
                let mut cell = [0; 3];
                (cell[axis], cell[(axis + 1) % 3], cell[(axis + 2) % 3]) = (side, i, j);
                *indices.entry(cell).or_insert_with(|| {
                    positions.push(Vec3::from_array(cell.map(|k| k as f32 / n as f32)) * size);
                    positions.len() as u32 - 1
                })
            };
            let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let [a, b, c, d] = corners;
            let outward = if side == 0 { [a, d, c, b] } else { corners };
            triangles.extend(quad(outward, random.unit() < 0.5));
        }
    }
    TriMesh { positions, triangles }
}
