//! Sphere trees of the paper's largest cloth, 40 × 40 particles: 1521 quads.

use divan::{Bencher, black_box};
use tautline::Vec3;
use tautline::geometry::smallest_enclosing_sphere;
use tautline::geometry::sphere_tree::{
    DescentStack, Feature, LayeredTree, WrappedSpheres, WrappedTree, descend_pair, descend_self,
};

const N: u32 = 40;
const EDGE: f32 = 0.05;

fn main() {
    divan::main();
}

fn quads() -> Vec<Feature> {
    let corner = |i: u32| i % (N - 1) + N * (i / (N - 1));
    let quad = |i| Feature::Quad([i, i + 1, i + N + 1, i + N]);
    (0..(N - 1) * (N - 1)).map(|i| quad(corner(i))).collect()
}

fn flat() -> Vec<Vec3> {
    (0..N * N).map(|i| Vec3::new((i % N) as f32, 0.0, (i / N) as f32) * EDGE).collect()
}

/// Folded both ways into pleats of seven edges whose layers lie half an edge apart, then shaken by a
/// quarter of an edge.
fn crumpled() -> Vec<Vec3> {
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / 8_388_608.0 - 1.0
    };
    let pleat = |i: u32| if i / 7 % 2 == 0 { i % 7 } else { 7 - i % 7 } as f32;
    let layer = |i: u32| (i / 7) as f32;
    let place = |i: u32| {
        let (column, row) = (i % N, i / N);
        Vec3::new(pleat(column), 0.5 * layer(column) + 3.0 * layer(row), pleat(row))
    };
    (0..N * N).map(|i| (place(i) + Vec3::new(noise(), noise(), noise()) * 0.25) * EDGE).collect()
}

fn tree(positions: &[Vec3]) -> LayeredTree {
    let mut tree = LayeredTree::new(&quads(), &flat(), 0.0).unwrap();
    tree.refit(positions).unwrap();
    tree
}

fn self_descent(bencher: Bencher, positions: &[Vec3]) {
    let tree = tree(positions);
    let cells: Vec<(u32, u32)> =
        tree.topology().feature_indices().iter().map(|&index| (index % (N - 1), index / (N - 1))).collect();
    let adjacent = |i: usize, j: usize| {
        let (p, q) = (cells[i], cells[j]);
        p.0.abs_diff(q.0) <= 1 && p.1.abs_diff(q.1) <= 1
    };
    let mut stack = DescentStack::default();
    let mut count = 0;
    let tests = descend_self(&tree, &mut stack, adjacent, |_, _| count += 1);
    eprintln!("{tests} sphere pairs tested, {count} leaf pairs found");
    let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(count);
    bencher.bench_local(|| {
        pairs.clear();
        descend_self(black_box(&tree), &mut stack, adjacent, |i, j| pairs.push((i as u32, j as u32)))
    });
}

#[divan::bench]
fn build(bencher: Bencher) {
    let (features, positions) = (quads(), flat());
    bencher.bench(|| LayeredTree::new(black_box(&features), &positions, 0.0));
}

#[divan::bench]
fn build_wrapped(bencher: Bencher) {
    let (features, positions) = (quads(), crumpled());
    bencher.bench(|| WrappedTree::new(black_box(&features), &positions, 0.0));
}

#[divan::bench]
fn smallest_sphere_of_1600(bencher: Bencher) {
    let positions = crumpled();
    bencher.bench(|| smallest_enclosing_sphere(black_box(&positions)));
}

#[divan::bench]
fn refit_flat(bencher: Bencher) {
    let positions = flat();
    let mut tree = tree(&positions);
    bencher.bench_local(|| tree.refit(black_box(&positions)));
}

#[divan::bench]
fn refit_crumpled(bencher: Bencher) {
    let positions = crumpled();
    let mut tree = tree(&positions);
    bencher.bench_local(|| tree.refit(black_box(&positions)));
}

#[divan::bench]
fn self_flat(bencher: Bencher) {
    self_descent(bencher, &flat());
}

#[divan::bench]
fn self_crumpled(bencher: Bencher) {
    self_descent(bencher, &crumpled());
}

/// A flat cloth through the middle of a cube half its size.
#[divan::bench]
fn cloth_and_cube(bencher: Bencher) {
    let cloth = tree(&flat());
    let side = 0.5 * N as f32 * EDGE;
    let low = Vec3::new(0.5, -1.0, 0.5) * side;
    let corners: Vec<Vec3> = (0..8)
        .map(|i| low + Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * side)
        .collect();
    let quads = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let faces: Vec<Feature> = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [Feature::Triangle([a, b, c]), Feature::Triangle([a, c, d])])
        .collect();
    let cube = WrappedTree::new(&faces, &corners, 0.01).unwrap();
    let (mut state, mut stack) = (WrappedSpheres::default(), DescentStack::default());
    bencher.bench_local(|| {
        state.invalidate();
        let mut pairs = 0;
        let pose = cube.pose(black_box(&corners), &mut state).ok()?;
        descend_pair(&cloth, pose, &mut stack, |_, _| pairs += 1);
        Some(pairs)
    });
}
