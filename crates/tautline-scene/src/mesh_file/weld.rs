//! One vertex per place, and no vertex without a triangle.

use tautline::Vec3;
use tautline::mesh::TriMesh;

/// Makes vertices one that are equal to the bit, −0 being 0. The first of them stays, and their order.
pub(super) fn weld(mut mesh: TriMesh) -> TriMesh {
    let positions = &mut mesh.positions;
    // −0 + 0 is +0.
    positions.iter_mut().for_each(|position| *position += Vec3::ZERO);
    let bits = |vertex: u32| positions[vertex as usize].to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&vertex| (bits(vertex), vertex));
    let mut first_at_place: Vec<u32> = vec![0; positions.len()];
    for same in order.chunk_by(|&a, &b| bits(a) == bits(b)) {
        same.iter().for_each(|&vertex| first_at_place[vertex as usize] = same[0]);
    }
    drop(order);
    for vertex in mesh.triangles.as_flattened_mut() {
        *vertex = first_at_place[*vertex as usize];
    }
    let kept: Vec<bool> = first_at_place.iter().zip(0..).map(|(&first, vertex)| first == vertex).collect();
    keep(mesh, &kept)
}

/// Leaves out the vertices of no triangle and keeps the order of the others.
pub(super) fn without_unused(mesh: TriMesh) -> TriMesh {
    let mut used = vec![false; mesh.positions.len()];
    for &vertex in mesh.triangles.as_flattened() {
        used[vertex as usize] = true;
    }
    keep(mesh, &used)
}

/// Leaves out vertices, of which no triangle may use one.
fn keep(mut mesh: TriMesh, kept: &[bool]) -> TriMesh {
    let mut next = 0;
    let number = |&kept: &bool| {
        next += u32::from(kept);
        next.wrapping_sub(1)
    };
    let renumbered: Vec<u32> = kept.iter().map(number).collect();
    let mut keeps = kept.iter();
    mesh.positions.retain(|_| keeps.next() == Some(&true));
    for vertex in mesh.triangles.as_flattened_mut() {
        *vertex = renumbered[*vertex as usize];
    }
    mesh
}
