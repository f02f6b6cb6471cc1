//! Triangles on the same corners.

use super::super::edges::{by_edge, sides};
use super::super::groups::Groups;
use super::Why;
use super::patient::Patient;
use crate::order::PutInOrder;

const NONE: u32 = u32::MAX;

/// Keeps the first of triangles with the same corners. Where they come in pairs that face each other and what hangs
/// together of them meets a surface that goes on without them, they are a wall inside a solid: none is kept.
pub(super) fn drop_duplicates(patient: &mut Patient) {
    let triangles = &patient.mesh.triangles;
    let (heap_of, heaps) = heaps(triangles);
    let mut joined = Groups::new(heaps.len());
    let mut meets_surface = vec![false; heaps.len()];
    let all = sides(triangles, &vec![true; triangles.len()]);
    for sharing in by_edge(&all) {
        let in_heaps =
            || sharing.iter().map(|side| heap_of[side.triangle() as usize]).filter(|&heap| heap != NONE);
        let Some(first) = in_heaps().next() else { continue };
        in_heaps().for_each(|heap| joined.join(first, heap));
        if sharing.len() - in_heaps().count() >= 2 {
            meets_surface[first as usize] = true;
        }
    }
    let mut is_wall = vec![false; heaps.len()];
    for heap in (0..heaps.len()).filter(|&heap| meets_surface[heap]) {
        is_wall[joined.find(heap as u32) as usize] = true;
    }
    let (mut doubles, mut walls) = (vec![true; triangles.len()], vec![true; triangles.len()]);
    for (heap, members) in heaps.iter().enumerate() {
        if is_wall[joined.find(heap as u32) as usize] && is_even(triangles, members) {
            members.iter().for_each(|&triangle| walls[triangle as usize] = false);
        } else {
            members[1..].iter().for_each(|&triangle| doubles[triangle as usize] = false);
        }
    }
    // The numbers of the second step are those after the first.
    let mut left = doubles.iter();
    walls.retain(|_| left.next() == Some(&true));
    patient.keep(&doubles, Why::Duplicate);
    patient.keep(&walls, Why::Wall);
}

/// Triangles with the same corners, lowest first, and the number of such a heap for each triangle in one.
fn heaps(triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<Vec<u32>>) {
    let mut sorted: Vec<([u32; 3], u32)> = triangles.iter().copied().zip(0..).collect();
    sorted.iter_mut().for_each(|(corners, _)| corners.sort_unstable());
    sorted.put_in_order();
    let several = sorted.chunk_by(|a, b| a.0 == b.0).filter(|heap| heap.len() > 1);
    let heaps: Vec<Vec<u32>> =
        several.map(|heap| heap.iter().map(|&(_, triangle)| triangle).collect()).collect();
    let mut heap_of = vec![NONE; triangles.len()];
    for (heap, members) in (0..).zip(&heaps) {
        members.iter().for_each(|&triangle| heap_of[triangle as usize] = heap);
    }
    (heap_of, heaps)
}

/// Whether as many face one way as the other.
fn is_even(triangles: &[[u32; 3]], members: &[u32]) -> bool {
    let is_ascending = |[a, b, c]: [u32; 3]| [a < b, b < c, c < a].into_iter().filter(|&is| is).count() == 2;
    2 * members.iter().filter(|&&triangle| is_ascending(triangles[triangle as usize])).count()
        == members.len()
}
