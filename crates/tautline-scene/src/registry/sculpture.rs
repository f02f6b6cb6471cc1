//! Meshes made by code: what people bring as files.

use tautline::Vec3;
use tautline::mesh::{TriMesh, primitives};

use crate::document::MeshSource;
use crate::random::Random;

/// A bump of a ball: around a direction, how far it stands out (below 0: a dent), and how sharp it is.
type Bump = ([f32; 3], f32, f32);

/// Body, head with two long ears, tail, and flat where it sits.
const RABBIT: [Bump; 8] = [
    ([0.55, 0.75, 0.0], 0.75, 9.0),
    ([0.34, 0.93, 0.24], 0.9, 60.0),
    ([0.34, 0.93, -0.24], 0.9, 60.0),
    ([0.85, 0.5, 0.0], 0.22, 30.0),
    ([-0.95, -0.25, 0.0], 0.35, 30.0),
    ([0.6, -0.75, 0.4], 0.3, 14.0),
    ([0.6, -0.75, -0.4], 0.3, 14.0),
    ([-0.2, -1.0, 0.0], -0.25, 3.0),
];

/// A head on a neck: skull, brow, nose, lips, chin, ears, sockets.
const HEAD: [Bump; 12] = [
    ([-0.3, 0.8, 0.0], 0.2, 4.0),
    ([0.9, 0.38, 0.0], 0.1, 20.0),
    ([0.98, 0.05, 0.0], 0.26, 70.0),
    ([0.95, -0.28, 0.0], 0.08, 60.0),
    ([0.82, -0.58, 0.0], 0.16, 25.0),
    ([0.0, 0.02, 1.0], 0.2, 50.0),
    ([0.0, 0.02, -1.0], 0.2, 50.0),
    ([0.86, 0.2, 0.33], -0.1, 60.0),
    ([0.86, 0.2, -0.33], -0.1, 60.0),
    ([-0.1, -1.0, 0.0], 0.75, 8.0),
    ([-0.9, -0.45, 0.0], -0.1, 6.0),
    ([0.3, -0.75, 0.0], -0.08, 10.0),
];

/// Something like a rabbit, 1 m from its paws to the tips of its ears, with its middle near the origin.
pub(super) fn rabbit(subdivisions: u32) -> MeshSource {
    source(bumpy(subdivisions, 0.35, &RABBIT))
}

/// A head of about 0.8 m looking along X, as a scanner sees it: every vertex is off by up to `noise` (m).
pub(super) fn scanned_head(subdivisions: u32, noise: f32) -> MeshSource {
    let mut mesh = bumpy(subdivisions, 0.36, &HEAD);
    let mut random = Random::new(1);
    for position in &mut mesh.positions {
        // Narrower from ear to ear.
        *position = *position * Vec3::new(1.0, 1.0, 0.8) + random.in_cube(noise);
    }
    source(mesh)
}

/// A ball of this radius (m) with bumps.
fn bumpy(subdivisions: u32, radius: f32, bumps: &[Bump]) -> TriMesh {
    // A radius of 1 m is never refused.
    let mut mesh = primitives::icosphere(1.0, subdivisions).unwrap_or_default();
    for position in &mut mesh.positions {
        let height = |&(direction, height, sharpness): &Bump| {
            let cosine = position.dot(Vec3::from(direction).normalize());
            height * libm::expf(sharpness * (cosine - 1.0))
        };
        *position *= radius * (1.0 + bumps.iter().map(height).sum::<f32>());
    }
    mesh
}

/// A tube along an S of two half circles, closed at both ends; `bend` is their radius, in m.
pub(super) fn bent_tube(bend: f32, radius: f32, rings: u32, sides: u32) -> MeshSource {
    let half = rings / 2;
    let line: Vec<[Vec3; 2]> = (0..=2 * half).map(|ring| on_s(bend, ring as f32 / half as f32)).collect();
    let mut mesh = MeshSource::default();
    for &[middle, outward] in &line {
        for side in 0..sides {
            let (sin, cos) = libm::sincosf(std::f32::consts::TAU * side as f32 / sides as f32);
            mesh.positions.push((middle + (outward * cos + Vec3::Y * sin) * radius).to_array());
        }
    }
    let (last, corners) = (line.len() as u32 - 1, mesh.positions.len() as u32);
    mesh.positions.extend([line[0][0], line[last as usize][0]].map(|end| end.to_array()));
    let corner = |ring: u32, side: u32| ring * sides + side % sides;
    for side in 0..sides {
        for ring in 0..last {
            let [a, b] = [corner(ring, side), corner(ring, side + 1)];
            let [c, d] = [corner(ring + 1, side + 1), corner(ring + 1, side)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
        mesh.triangles.push([corners, corner(0, side + 1), corner(0, side)]);
        mesh.triangles.push([corners + 1, corner(last, side), corner(last, side + 1)]);
    }
    mesh
}

/// A point of the S and the direction there, across it, that turns with it; from 0 over 1 in the middle to 2.
fn on_s(bend: f32, along: f32) -> [Vec3; 2] {
    let is_first = along <= 1.0;
    let angle = std::f32::consts::PI * if is_first { along } else { 2.0 - (along - 1.0) };
    let (sin, cos) = libm::sincosf(angle);
    // The first half circle runs from the far end to the origin, the other on from there, turning the other way.
    let (center, outward) = if is_first {
        (Vec3::X * bend, Vec3::new(cos, 0.0, sin))
    } else {
        (Vec3::X * -bend, Vec3::new(cos, 0.0, sin))
    };
    [center + outward * bend, if is_first { outward } else { -outward }]
}

/// A star of so many tips between two planes; `radius` to its tips, in m.
pub(super) fn star(tips: u32, radius: f32, thickness: f32) -> MeshSource {
    let count = 2 * tips;
    let mut mesh = MeshSource::default();
    for y in [-thickness / 2.0, thickness / 2.0] {
        for k in 0..count {
            let (sin, cos) = libm::sincosf(std::f32::consts::TAU * k as f32 / count as f32);
            let reach = if k % 2 == 0 { radius } else { 0.45 * radius };
            mesh.positions.push([reach * cos, y, -reach * sin]);
        }
        mesh.positions.push([0.0, y, 0.0]);
    }
    let (upper, lower_middle, upper_middle) = (count + 1, count, 2 * count + 1);
    for a in 0..count {
        let b = (a + 1) % count;
        mesh.triangles.extend([[lower_middle, b, a], [upper_middle, upper + a, upper + b]]);
        mesh.triangles.extend([[a, b, upper + b], [a, upper + b, upper + a]]);
    }
    mesh
}

fn source(mesh: TriMesh) -> MeshSource {
    MeshSource { positions: mesh.positions.iter().map(|p| p.to_array()).collect(), triangles: mesh.triangles }
}

#[cfg(test)]
mod tests {
    use tautline::mesh::MassProperties;

    use super::*;

    #[test]
    fn all_are_closed_and_face_outwards() {
        for mesh in [rabbit(3), scanned_head(4, 0.001), bent_tube(0.3, 0.08, 16, 8), star(5, 0.3, 0.1)] {
            let mesh = TriMesh {
                positions: mesh.positions.iter().copied().map(Vec3::from).collect(),
                triangles: mesh.triangles,
            };
            assert!(MassProperties::of(&mesh, 1.0).unwrap().volume > 0.0);
        }
        // Half of it is a half torus: π² R r² each.
        let tube = bent_tube(0.3, 0.08, 64, 48);
        let mesh = TriMesh {
            positions: tube.positions.iter().copied().map(Vec3::from).collect(),
            triangles: tube.triangles,
        };
        let exact = 2.0 * std::f64::consts::PI.powi(2) * 0.3 * 0.0064;
        assert!((MassProperties::of(&mesh, 1.0).unwrap().volume / exact - 1.0).abs() < 0.02);
    }
}
