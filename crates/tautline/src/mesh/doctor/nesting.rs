//! Which closed surfaces lie inside others.

use glam::DVec3;
use robust::{Coord, orient2d};

use crate::geometry::box_tree::{Bounds, BoxTree};
use crate::mesh::tetrahedra::predicates::orient;

/// Triangles over the rays that are looked at, for every triangle: surfaces inside each other by the thousand have the
/// square of their number.
const MOST_LOOKS: usize = 200;

/// For every point with the number of its own surface, how many other surfaces it lies inside of; nothing for those that
/// would take too long. `surface` is that of each triangle, if it is of a closed surface.
///
/// A ray along X is counted with its sides: exact, and as if the point were shifted by next to nothing, so that edges
/// and corners on the ray count once.
pub(super) fn depths(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    surface: &[Option<u32>],
    asked: &[(u32, u32)],
) -> Vec<Option<u32>> {
    let items: Vec<usize> = (0..triangles.len()).filter(|&triangle| surface[triangle].is_some()).collect();
    let boxes: Vec<Bounds> = items
        .iter()
        .map(|&triangle| Bounds::around(triangles[triangle].map(|vertex| points[vertex as usize])))
        .collect();
    let tree = BoxTree::new(&boxes);
    let mut looks_left = items.len().saturating_mul(MOST_LOOKS);
    let depth = |&(vertex, own): &(u32, u32)| {
        let p = points[vertex as usize];
        let ray = Bounds { low: p, high: DVec3::new(f64::INFINITY, p.y, p.z) };
        let mut crossed: Vec<u32> = Vec::new();
        tree.overlapping(&ray, |item| {
            let triangle = items[item as usize];
            if let Some(other) = surface[triangle].filter(|&other| other != own)
                && is_hit(points, triangles[triangle], vertex)
            {
                crossed.push(other);
            }
            looks_left = looks_left.saturating_sub(1);
            looks_left > 0
        });
        crossed.sort_unstable();
        let odd = crossed.chunk_by(|a, b| a == b).filter(|hits| hits.len() % 2 == 1).count();
        (looks_left > 0).then_some(odd as u32)
    };
    asked.iter().map(depth).collect()
}

/// Whether the ray along +X from a vertex goes through a triangle.
fn is_hit(points: &[DVec3], triangle: [u32; 3], from: u32) -> bool {
    let p = points[from as usize];
    let turns = winding(triangle.map(|vertex| points[vertex as usize]), p);
    if turns == 0 || triangle.contains(&from) {
        return false;
    }
    // Counter-clockwise seen from +X, the triangle is ahead of what lies below it.
    let side = orient(points, triangle, from);
    if turns > 0 { side < 0.0 } else { side > 0.0 }
}

/// How often the triangle's projection along X winds around a point, each edge on the point's side at one end only.
fn winding(corners: [DVec3; 3], p: DVec3) -> i32 {
    let flat = |q: DVec3| Coord { x: q.y, y: q.z };
    let [a, b, c] = corners;
    let count = |from: DVec3, to: DVec3| match (from.z <= p.z, to.z <= p.z) {
        (true, false) => i32::from(orient2d(flat(from), flat(to), flat(p)) > 0.0),
        (false, true) => -i32::from(orient2d(flat(to), flat(from), flat(p)) > 0.0),
        _ => 0,
    };
    count(a, b) + count(b, c) + count(c, a)
}
