//! Recordings made by hand: motion that looks plausible, without an engine.

#![allow(dead_code)] // Each test file takes what it needs.

use tautline::mesh::TriMesh;
use tautline::{Quat, Vec3};
use tautline_scene::recording::{Motion, Recording, Surface, Track};
use tautline_scene::render::palette;

const FRAME_RATE: f32 = 30.0;

/// Regular, with its corners at that distance (m) from the origin.
pub(crate) fn icosahedron(radius: f32) -> TriMesh {
    let t = (1.0 + 5.0_f32.sqrt()) / 2.0;
    let corners = [
        [-1.0, t, 0.0],
        [1.0, t, 0.0],
        [-1.0, -t, 0.0],
        [1.0, -t, 0.0],
        [0.0, -1.0, t],
        [0.0, 1.0, t],
        [0.0, -1.0, -t],
        [0.0, 1.0, -t],
        [t, 0.0, -1.0],
        [t, 0.0, 1.0],
        [-t, 0.0, -1.0],
        [-t, 0.0, 1.0],
    ];
    let triangles = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let positions = corners.map(|c| Vec3::from(c).normalize() * radius).to_vec();
    TriMesh { positions, triangles }
}

/// A box around the origin.
pub(crate) fn cuboid(half: Vec3) -> TriMesh {
    let corner = |i: u32| {
        let sign = |bit: u32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        half * Vec3::new(sign(0), sign(1), sign(2))
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriMesh { positions: (0..8).map(corner).collect(), triangles }
}

/// The topology of a sheet of n × m quads, x first; positions are left at zero.
fn grid(n: u32, m: u32) -> TriMesh {
    let at = |i, j| j * (n + 1) + i;
    let quads = (0..m).flat_map(|j| (0..n).map(move |i| (i, j)));
    let triangles = quads
        .flat_map(|(i, j)| {
            [[at(i, j), at(i, j + 1), at(i + 1, j)], [at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)]]
        })
        .collect();
    TriMesh { positions: vec![Vec3::ZERO; ((n + 1) * (m + 1)) as usize], triangles }
}

fn track(name: &str, color: [u8; 3], surface: Surface, mesh: TriMesh, motion: Motion) -> Track {
    Track { name: name.into(), color, surface, mesh, motion }
}

/// Deforming, with the first frame as its mesh.
fn deforming(
    name: &str,
    color: [u8; 3],
    surface: Surface,
    mut mesh: TriMesh,
    frames: Vec<Vec<Vec3>>,
) -> Track {
    mesh.positions.clone_from(&frames[0]);
    track(name, color, surface, mesh, Motion::Deforming(frames))
}

/// Six walls of a room of that half-width, each facing inwards and standing on y = 0.
fn walls(half: f32) -> Vec<Track> {
    let inwards = cuboid(Vec3::splat(half));
    (0..6)
        .map(|i| {
            let triangles = inwards.triangles[2 * i..2 * i + 2].iter().map(|&[a, b, c]| [a, c, b]).collect();
            let positions = inwards.positions.iter().map(|&p| p + Vec3::Y * half).collect();
            let mesh = TriMesh { positions, triangles };
            track(&format!("wall {i}"), [222, 220, 214], Surface::Wall, mesh, Motion::Still)
        })
        .collect()
}

/// Icosahedra that fall, roll and come to rest in a room: balls to the motion, icosahedra to the eye.
pub(crate) fn icosahedra(count: usize, frames: usize) -> Recording {
    let (half, radius) = (2.0, 0.32);
    let start = |i: usize| {
        let (layer, cell) = (i / 16, i % 16);
        let offset = |k: usize| (k as f32 - 1.5) * 0.9 + 0.07 * ((i * 7 + k * 3) % 5) as f32 - 0.14;
        Vec3::new(offset(cell % 4), 0.7 + 0.85 * layer as f32, offset(cell / 4))
    };
    let mut places: Vec<Vec3> = (0..count).map(start).collect();
    let mut before: Vec<Vec3> = places
        .iter()
        .enumerate()
        .map(|(i, &p)| p - Vec3::new((i % 3) as f32 - 1.0, 0.0, 0.6) * 0.005)
        .collect();
    let mut turns = vec![Quat::IDENTITY; count];
    let mut poses = vec![Vec::new(); count];
    for _ in 0..frames {
        for _ in 0..4 {
            for (i, place) in places.iter_mut().enumerate() {
                let moved = (*place - before[i]) * 0.998;
                before[i] = *place;
                *place += moved - Vec3::Y * (9.81 / (4.0 * FRAME_RATE * 4.0 * FRAME_RATE));
                let spin = Vec3::new(moved.z, 0.3 * moved.x, -moved.x) / radius;
                turns[i] = (Quat::from_scaled_axis(spin) * turns[i]).normalize();
            }
            for _ in 0..6 {
                separate(&mut places, radius * 0.92);
                for place in &mut places {
                    let reach = half - radius * 0.9;
                    place.x = place.x.clamp(-reach, reach);
                    place.z = place.z.clamp(-reach, reach);
                    place.y = place.y.max(radius * 0.85);
                }
            }
        }
        for (i, poses) in poses.iter_mut().enumerate() {
            poses.push((places[i], turns[i]));
        }
    }
    let mesh = icosahedron(radius);
    let mut tracks = walls(half);
    tracks.extend(poses.into_iter().enumerate().map(|(i, poses)| {
        let name = format!("icosahedron {i}");
        track(&name, palette(i % 6), Surface::Solid, mesh.clone(), Motion::Rigid(poses))
    }));
    Recording { name: "icosahedra".into(), frame_rate: FRAME_RATE, tracks }
}

fn separate(places: &mut [Vec3], radius: f32) {
    for i in 0..places.len() {
        for j in 0..i {
            let apart = places[i] - places[j];
            let overlap = 2.0 * radius - apart.length();
            if overlap > 0.0 {
                let shift = apart.normalize_or(Vec3::Y) * (overlap / 2.0);
                places[i] += shift;
                places[j] -= shift;
            }
        }
    }
}

/// A sheet of n × n quads that sinks onto a cube on a floor, waving, and a tube that swings beside it.
pub(crate) fn sheet_and_tube(n: u32, frames: usize) -> Recording {
    let sheet = |frame: usize| {
        let t = frame as f32 / FRAME_RATE;
        let sink = (t / 2.0).min(1.0);
        let vertex = |i: u32, j: u32| {
            let (u, v) = (i as f32 / n as f32 * 2.4 - 1.2, j as f32 / n as f32 * 2.4 - 1.2);
            let beyond = (u.abs().max(v.abs()) - 0.55).max(0.0);
            let folds = 0.10 * (u.atan2(v) * 6.0).sin() * beyond;
            let wave = 0.05 * (4.0 * u + 3.0 * t).sin() * (1.0 - 0.6 * sink);
            let drop = 1.05 - sink * beyond * 1.25;
            let pull = 1.0 - 0.28 * sink * beyond;
            Vec3::new(u * pull + folds, (drop + wave * 0.6 + 0.06).max(0.02), v * pull + folds)
        };
        (0..=n).flat_map(|j| (0..=n).map(move |i| vertex(i, j))).collect::<Vec<_>>()
    };
    let tube = |frame: usize| {
        let t = frame as f32 / FRAME_RATE;
        let ring = |k: u32, s: u32| {
            let along = s as f32 / 40.0 * 3.0 - 1.5;
            let sag = 0.4 + 0.45 * along * along;
            let swing = 0.15 * (3.0 * t).sin() * (2.25 - along * along);
            let (sin, cos) = (k as f32 / 10.0 * std::f32::consts::TAU).sin_cos();
            Vec3::new(along, sag + 0.05 * sin, 1.7 + swing + 0.05 * cos)
        };
        (0..=40).flat_map(|s| (0..=10).map(move |k| ring(k, s))).collect::<Vec<_>>()
    };
    let floor = TriMesh {
        positions: [[-1, -1], [-1, 1], [1, 1], [1, -1]]
            .map(|[x, z]| Vec3::new(x as f32, 0.0, z as f32) * 30.0)
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    let mut cube = cuboid(Vec3::splat(0.5));
    cube.positions.iter_mut().for_each(|p| p.y += 0.5);
    let tracks = vec![
        track("floor", [222, 220, 214], Surface::Wall, floor, Motion::Still),
        track("cube", palette(4), Surface::Solid, cube, Motion::Still),
        deforming("sheet", palette(3), Surface::Sheet, grid(n, n), (0..frames).map(sheet).collect()),
        deforming("tube", palette(0), Surface::Round, grid(10, 40), (0..frames).map(tube).collect()),
    ];
    Recording { name: "sheet and tube".into(), frame_rate: FRAME_RATE, tracks }
}
