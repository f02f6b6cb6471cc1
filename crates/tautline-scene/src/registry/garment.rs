//! Garments in a heap.

use std::collections::BTreeMap;

use tautline::Vec3;

use super::{NamedScene, Parameter, Parameters};
use crate::document::{AxisAngle, Body, Camera, Cloth, HalfSpace, MeshSource, Rotation, Scene, Surface};
use crate::random::Random;

pub(super) const GARMENTS: NamedScene = NamedScene {
    name: "garments",
    description: "Shirts and ponchos fall on each other and make a heap.",
    parameters: &[Parameter::count("n", "how many garments", 10, (1, 20)), Parameter::SEED],
    document: garments,
};

/// Of the squares that garments are cut in, in m.
const CELL: f32 = 0.035;

fn garments(p: &Parameters) -> Scene {
    let mut random = Random::new(p.seed());
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    for i in 0..p.count("n") {
        let mesh = if i % 3 == 2 { poncho() } else { shirt() };
        let place = Vec3::Y * (0.35 + 0.4 * i as f32) + random.in_cube(0.12) * Vec3::new(1.0, 0.0, 1.0);
        let axis = Vec3::Y + random.in_cube(0.15);
        let turn = AxisAngle { axis: axis.to_array(), degrees: random.between(0.0, 360.0) };
        bodies.push(Body::Cloth(Cloth {
            surface: Surface::Mesh(mesh),
            position: place.to_array(),
            rotation: Rotation::AxisAngle(turn),
            mass: 0.2,
            // Sheets may lie closer than by default: else no seam could be pressed flat.
            thickness: Some(0.4 * CELL),
            ..Cloth::default()
        }));
    }
    let camera = Some(Camera { eye: [1.1, 1.4, 2.2], target: [0.0, 0.4, 0.0], fov: 42.0 });
    Scene { seconds: 5.0, record_every: 2, bodies, camera, ..Scene::default() }
}

/// A square with a slit to put one's head through.
fn poncho() -> MeshSource {
    let is_cloth = |[i, j]: [i32; 2]| !((-3..3).contains(&i) && (-1..1).contains(&j));
    let mut sewn = Sewn::default();
    for cell in cells([-12, 12], [-12, 12]).filter(|&cell| is_cloth(cell)) {
        sewn.add(cell, true, |[i, j]| ([i, j, 0], 0.0));
    }
    sewn.mesh
}

/// Of a shirt, in cells from its middle: half its width, how far its sleeves reach, half the width of its neck.
const CHEST: i32 = 7;
const SLEEVE: i32 = 13;
const NECK: i32 = 3;
/// Along it: the shoulders, where the sleeves end below, the hem.
const SHOULDER: i32 = -9;
const ARMPIT: i32 = -3;
const HEM: i32 = 10;

/// Two sheets, front and back, sewn along the sides, the shoulders and the sleeves; open at the neck, the hem and the
/// wrists. It is bulged, as if worn, so that its sheets begin apart.
fn shirt() -> MeshSource {
    let is_cloth = |[i, j]: [i32; 2]| (-CHEST..CHEST).contains(&i) || j < ARMPIT;
    let mut sewn = Sewn::default();
    for (layer, side) in [(1, 1.0), (2, -1.0)] {
        for cell in cells([-SLEEVE, SLEEVE], [SHOULDER, HEM]).filter(|&cell| is_cloth(cell)) {
            sewn.add(cell, side > 0.0, |[i, j]| {
                let apart = from_seam([i, j]);
                let layer = if apart == 0 { 0 } else { layer };
                ([i, j, layer], side * (0.8 * apart as f32).min(2.4))
            });
        }
    }
    sewn.mesh
}

/// How many cells a corner of a shirt's cells is away from the next seam.
fn from_seam([i, j]: [i32; 2]) -> i32 {
    let across = i.abs();
    let shoulder = (NECK - across).max(j - SHOULDER);
    let sleeve = (CHEST - across).max((ARMPIT - j).abs());
    let side = (CHEST - across).abs().max(ARMPIT - j);
    shoulder.min(sleeve).min(side)
}

/// The cells of a rectangle, by their corners with the smallest coordinates.
fn cells([left, right]: [i32; 2], [back, front]: [i32; 2]) -> impl Iterator<Item = [i32; 2]> {
    (back..front).flat_map(move |j| (left..right).map(move |i| [i, j]))
}

/// Cells of cloth that share the corners of the same name.
#[derive(Default)]
struct Sewn {
    mesh: MeshSource,
    corners: BTreeMap<[i32; 3], u32>,
}

impl Sewn {
    /// Adds a cell that looks up or down; `corner` tells the name and the height, in cells, of each of its corners.
    fn add(&mut self, [i, j]: [i32; 2], is_up: bool, corner: impl Fn([i32; 2]) -> ([i32; 3], f32)) {
        let mut number = |place: [i32; 2]| {
            let (name, height) = corner(place);
            let positions = &mut self.mesh.positions;
            *self.corners.entry(name).or_insert_with(|| {
                positions.push([place[0] as f32, height, place[1] as f32].map(|cells| cells * CELL));
                positions.len() as u32 - 1
            })
        };
        let [a, b, c, d] = [[i, j], [i, j + 1], [i + 1, j + 1], [i + 1, j]].map(&mut number);
        // Every other cell is cut the other way, so that cloth is alike in both directions.
        let halves = if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        let facing = |[a, b, c]: [u32; 3]| if is_up { [a, b, c] } else { [a, c, b] };
        self.mesh.triangles.extend(halves.map(facing));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shirt_is_one_surface_with_four_openings() {
        let mesh = shirt();
        let mut sides = BTreeMap::new();
        for [a, b, c] in &mesh.triangles {
            for side in [[a, b], [b, c], [c, a]] {
                *sides.entry(side.map(|&corner| corner)).or_insert(0) += 1;
            }
        }
        assert!(sides.values().all(|&count| count == 1), "its triangles look the same way");
        let open: Vec<[u32; 2]> =
            sides.keys().filter(|[a, b]| !sides.contains_key(&[*b, *a])).copied().collect();
        let around = 2 * (2 * NECK + 2 * CHEST + 2 * (ARMPIT - SHOULDER));
        assert_eq!(open.len() as i32, around);
        // A sphere with four holes: V − E + F = 2 − 4.
        let edges = (3 * mesh.triangles.len() + open.len()) / 2;
        assert_eq!(mesh.positions.len() + mesh.triangles.len() + 2, edges);
    }
}
