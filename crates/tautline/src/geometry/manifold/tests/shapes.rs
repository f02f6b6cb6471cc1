//! Convex parts made by hand.

use glam::{Mat3, Quat, Vec3};

use crate::geometry::manifold::Placement;
use crate::mesh::convex_hull;
use crate::shape::{Convex, Face};

/// Numbers that follow from a seed.
pub(super) struct Random(pub(super) u64);

impl Random {
    /// From −1 to 1.
    pub(super) fn signed(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    }

    pub(super) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * 0.5 * (self.signed() + 1.0)
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.between(0.0, 0.999_99) * count as f32) as usize
    }

    pub(super) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.signed(), self.signed(), self.signed())
    }

    pub(super) fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.vector();
            if v.length_squared() <= 1.0 && v.length_squared() > 0.01 {
                return v.normalize();
            }
        }
    }

    pub(super) fn rotation(&mut self) -> Quat {
        Quat::from_xyzw(self.signed(), self.signed(), self.signed(), self.signed()).normalize()
    }
}

pub(super) fn placed(rotation: Quat, translation: Vec3) -> Placement {
    Placement { rotation: Mat3::from_quat(rotation), translation }
}

/// A's frame in B's.
pub(super) fn inverse(placement: &Placement) -> Placement {
    let rotation = placement.rotation.transpose();
    Placement { rotation, translation: -(rotation * placement.translation) }
}

pub(super) fn ball(radius: f32) -> Convex {
    Convex::new(vec![Vec3::ZERO], vec![], vec![], radius)
}

pub(super) fn capsule(radius: f32, half_height: f32) -> Convex {
    Convex::new(vec![Vec3::Y * -half_height, Vec3::Y * half_height], vec![], vec![], radius)
}

pub(super) fn triangle(corners: [Vec3; 3]) -> Convex {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    let offset = normal.dot(corners[0]);
    let faces = vec![
        Face { normal, offset, first: 0, count: 3 },
        Face { normal: -normal, offset: -offset, first: 3, count: 3 },
    ];
    Convex::new(corners.to_vec(), faces, vec![0, 1, 2, 0, 2, 1], 0.0)
}

pub(super) fn cuboid(half: Vec3) -> Convex {
    let sign = |i: usize, bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
    hull((0..8).map(|i| half * Vec3::new(sign(i, 0), sign(i, 1), sign(i, 2))).collect())
}

pub(super) fn tetrahedron(size: f32) -> Convex {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    hull(corners.map(|c| Vec3::from_array(c) * size).to_vec())
}

pub(super) fn icosahedron(radius: f32) -> Convex {
    let (s, l) = (0.525_731_1, 0.850_650_8);
    let ends = [(s, l), (-s, l), (s, -l), (-s, -l)];
    let corners = ends.into_iter().flat_map(|(i, j)| [[i, j, 0.0], [0.0, i, j], [j, 0.0, i]]);
    hull(corners.map(|c| Vec3::from_array(c) * radius).collect())
}

pub(super) fn prism(sides: usize, radius: f32, half_height: f32) -> Convex {
    let step = Quat::from_rotation_y(std::f32::consts::TAU / sides as f32);
    let mut arm = Vec3::X * radius;
    let mut corners = Vec::new();
    for _ in 0..sides {
        corners.extend([arm - Vec3::Y * half_height, arm + Vec3::Y * half_height]);
        arm = step * arm;
    }
    hull(corners)
}

pub(super) fn random_hull(random: &mut Random, count: usize) -> Convex {
    hull((0..count).map(|_| random.direction() * random.between(0.6, 1.0)).collect())
}

/// The hull of points, with coplanar triangles merged.
pub(super) fn hull(points: Vec<Vec3>) -> Convex {
    let mesh = convex_hull(&points).expect("the points span a volume").mesh;
    let normal = |t: &[u32; 3]| {
        let [p, q, r] = t.map(|i| mesh.positions[i as usize]);
        (q - p).cross(r - p).normalize()
    };
    let (mut faces, mut loops, mut done) = (Vec::new(), Vec::new(), vec![false; mesh.triangles.len()]);
    for i in 0..mesh.triangles.len() {
        if done[i] {
            continue;
        }
        let n = normal(&mesh.triangles[i]);
        let mut edges = Vec::new();
        for (j, t) in mesh.triangles.iter().enumerate().filter(|(_, t)| normal(t).dot(n) > 0.999_99) {
            done[j] = true;
            edges.extend([[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
        }
        let outline: Vec<_> = edges.iter().filter(|e| !edges.contains(&[e[1], e[0]])).copied().collect();
        let (first, start) = (loops.len(), outline[0][0]);
        let mut at = start;
        loop {
            loops.push(at as u16);
            at = outline.iter().find(|e| e[0] == at).expect("the outline is closed")[1];
            if at == start {
                break;
            }
        }
        let count = (loops.len() - first) as u32;
        let offset = n.dot(mesh.positions[start as usize]);
        faces.push(Face { normal: n, offset, first: first as u32, count });
    }
    Convex::new(mesh.positions, faces, loops, 0.0)
}
