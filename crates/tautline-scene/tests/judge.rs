//! The judge of cloth and rope against closed forms and against brute force.

use proptest::prelude::*;
use tautline::mesh::{TriMesh, primitives};
use tautline::{DVec3, Quat, Vec3};
use tautline_scene::judge::{Sheet, TriangleId, intersections, rope_pierces};
use tautline_scene::random::Random;

fn sheet(mesh: &TriMesh) -> Sheet<'_> {
    Sheet { positions: &mesh.positions, triangles: &mesh.triangles }
}

fn placed(mesh: &TriMesh, position: Vec3, rotation: Quat) -> TriMesh {
    let positions = mesh.positions.iter().map(|&p| position + rotation * p).collect();
    TriMesh { positions, triangles: mesh.triangles.clone() }
}

fn count(meshes: &[&TriMesh]) -> usize {
    intersections(&meshes.iter().map(|mesh| sheet(mesh)).collect::<Vec<_>>()).len()
}

/// Upright, across x, wide and high enough to cut through every sheet here.
fn wall(x: f32) -> TriMesh {
    let corner = |y: f32, z: f32| Vec3::new(x, y, z);
    TriMesh {
        positions: vec![corner(-9.0, -40.0), corner(-9.0, 40.0), corner(40.0, 0.0)],
        triangles: vec![[0, 1, 2]],
    }
}

#[test]
fn a_wall_through_a_grid_meets_both_triangles_of_each_cell_it_cuts() {
    let grid = primitives::grid(8, 6, 7.0, 5.0).unwrap();
    let within = wall(0.3);
    assert_eq!(count(&[&grid, &within]), 2 * 5);
    // As one mesh, whose corners have numbers of their own.
    let shift = grid.positions.len() as u32;
    let mut one = grid.clone();
    one.positions.extend(&within.positions);
    one.triangles.extend(within.triangles.iter().map(|t| t.map(|index| index + shift)));
    assert_eq!(count(&[&one]), 2 * 5);
    assert_eq!(count(&[&grid, &wall(3.6)]), 0, "beside it");
    let found = intersections(&[sheet(&grid), sheet(&within)]);
    assert!(found.iter().all(|[a, b]| a.sheet == 0 && *b == TriangleId { sheet: 1, triangle: 0 }));
    assert!(found.is_sorted());
}

#[test]
fn what_is_flat_folded_flat_or_closed_has_none() {
    let grid = primitives::grid(20, 20, 2.0, 2.0).unwrap();
    assert_eq!(count(&[&grid]), 0);
    assert_eq!(count(&[&grid, &grid]), 0, "one on the other, in one plane");
    let mut folded = grid.clone();
    folded.positions.iter_mut().for_each(|p| p.x = p.x.abs());
    assert_eq!(count(&[&folded]), 0, "folded on itself");
    let ball = primitives::icosphere(1.0, 3).unwrap();
    assert_eq!(count(&[&ball]), 0);
    assert_eq!(count(&[&ball, &placed(&ball, Vec3::X * 2.001, Quat::IDENTITY)]), 0);
    assert!(count(&[&ball, &placed(&ball, Vec3::X * 1.999, Quat::IDENTITY)]) > 0);
}

#[test]
fn a_corner_through_a_sheet_counts_from_the_last_bit_on() {
    let floor = TriMesh {
        positions: vec![Vec3::new(-9.0, 0.0, -9.0), Vec3::new(0.0, 0.0, 9.0), Vec3::new(9.0, 0.0, -9.0)],
        triangles: vec![[0, 1, 2]],
    };
    let above = |height: f32| TriMesh {
        positions: vec![Vec3::new(0.1, height, 0.2), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.3, 1.0, 0.4)],
        triangles: vec![[0, 1, 2]],
    };
    assert_eq!(count(&[&floor, &above(1e-30)]), 0);
    assert_eq!(count(&[&floor, &above(0.0)]), 0);
    assert_eq!(count(&[&floor, &above(-1e-30)]), 1);
}

#[test]
fn a_rope_pierces_what_it_passes_through() {
    let grid = primitives::grid(11, 11, 10.0, 10.0).unwrap();
    let rope = |x: f32, z: f32| [2.0, 1.0, -1.0, -2.0].map(|y| Vec3::new(x, y, z));
    let pierces = |x: f32, z: f32| rope_pierces(&rope(x, z), &[sheet(&grid)]);
    let inside = pierces(0.3, 0.6);
    assert_eq!((inside.len(), inside[0].segment, inside[0].triangle.sheet), (1, 1, 0));
    assert_eq!(pierces(0.5, 0.0).len(), 2, "an edge belongs to the triangles on both sides");
    assert_eq!(pierces(0.0, 0.0).len(), 6, "a corner to six");
    assert_eq!(pierces(5.1, 0.0).len(), 0);
    let twice = [sheet(&grid), sheet(&grid)];
    assert_eq!(rope_pierces(&rope(0.3, 0.6), &twice).len(), 2);
    assert!(rope_pierces(&[Vec3::X], &twice).is_empty() && rope_pierces(&[], &[]).is_empty());
}

#[test]
fn what_is_missing_or_no_number_takes_no_part() {
    let grid = primitives::grid(8, 6, 7.0, 5.0).unwrap();
    let mut broken = wall(0.3);
    broken.positions[1].y = f32::NAN;
    assert_eq!(count(&[&grid, &broken]), 0);
    let mut short = grid.clone();
    short.positions.truncate(24);
    assert!((1..10).contains(&count(&[&short, &wall(0.3)])));
    assert!(rope_pierces(&[Vec3::Y, Vec3::NAN], &[sheet(&grid)]).is_empty());
}

/// A crumpled grid: the worst that cloth can look like.
fn crumpled(n: u32, seed: u64, roughness: f32) -> TriMesh {
    let mut random = Random::new(seed);
    let mut mesh = primitives::grid(n, n, 1.0, 1.0).unwrap();
    let edge = 1.0 / (n - 1) as f32;
    mesh.positions.iter_mut().for_each(|p| *p = *p * 0.4 + random.in_cube(roughness * edge));
    mesh
}

/// Every pair of every sheet, by solving for the place on the edge and in the triangle (Möller and Trumbore 1997).
fn brute_force(meshes: &[TriMesh]) -> usize {
    let all: Vec<(usize, [u32; 3], [DVec3; 3])> = meshes
        .iter()
        .enumerate()
        .flat_map(|(number, mesh)| {
            let place = |index: u32| mesh.positions[index as usize].as_dvec3();
            mesh.triangles.iter().map(move |&t| (number, t, t.map(place)))
        })
        .collect();
    let mut found = 0;
    for (i, (sheet, indices, a)) in all.iter().enumerate() {
        for (other, other_indices, b) in &all[..i] {
            let neighbours = sheet == other && indices.iter().any(|index| other_indices.contains(index));
            found += usize::from(!neighbours && (0..3).any(|k| hits(a, k, b) || hits(b, k, a)));
        }
    }
    found
}

fn hits(edges: &[DVec3; 3], k: usize, [a, b, c]: &[DVec3; 3]) -> bool {
    let (start, along) = (edges[k], edges[(k + 1) % 3] - edges[k]);
    let (e1, e2, from) = (*b - *a, *c - *a, start - *a);
    let (p, q) = (along.cross(e2), from.cross(e1));
    let determinant = e1.dot(p);
    let (u, v, t) = (from.dot(p) / determinant, along.dot(q) / determinant, e2.dot(q) / determinant);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn crumpled_sheets_have_as_many_as_brute_force_finds(
        seed in any::<u64>(),
        n in 2u32..10,
        sheets in 1usize..4,
        roughness in 0.2f32..3.0,
    ) {
        let meshes: Vec<TriMesh> =
            (0..sheets as u64).map(|k| crumpled(n, seed.wrapping_add(k), roughness)).collect();
        let found = intersections(&meshes.iter().map(sheet).collect::<Vec<_>>());
        prop_assert_eq!(found.len(), brute_force(&meshes));
        prop_assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
