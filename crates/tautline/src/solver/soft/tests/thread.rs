use glam::{DVec3, Vec3};

use super::*;
use crate::simd::{Kernel, Numbers, Row};
use crate::solver::soft::points::{Coordinates, set};
use crate::solver::soft::stick::Span;
use crate::solver::soft::tests::{cloud, farthest, in_f64, moved, on_all, weights};

/// Nine knots, sixteen threads side by side, from place 8 on.
const KNOTS: usize = 9;
const STRIDE: usize = 24;
const PLACES: usize = 8 + KNOTS * STRIDE;

struct Solve<S>(S, f32, Coordinates, Numbers);

impl Kernel for Solve<Span> {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let Self(spans, regularisation, positions, masses) = self;
        let threads = Threads { start: 8, stride: STRIDE, knots: KNOTS, count: 16, spans, regularisation };
        moved(positions, |moving| threads.solve::<L>(moving, &masses, &mut Vec::new()))
    }
}

impl Kernel for Solve<&[[Row; 3]]> {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let Self(spans, regularisation, positions, masses) = self;
        let threads = Threads { start: 8, stride: STRIDE, knots: KNOTS, count: 16, spans, regularisation };
        moved(positions, |moving| threads.solve::<L>(moving, &masses, &mut Vec::new()))
    }
}

/// Gauss' elimination with pivots.
fn solve_dense(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| matrix[a][k].abs().total_cmp(&matrix[b][k].abs())).unwrap();
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        for row in k + 1..n {
            let factor = matrix[row][k] / matrix[k][k];
            let pivots = matrix[k].clone();
            for (number, pivot) in matrix[row].iter_mut().zip(pivots).skip(k) {
                *number -= factor * pivot;
            }
            right[row] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|column| matrix[k][column] * right[column]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right
}

/// One Newton step for all sticks of a thread: (∇C W ∇Cᵀ + ε + α/h²) λ = −C, moved by W ∇Cᵀ λ.
fn newton(positions: &mut [DVec3], masses: &[f64], spans: &[[f64; 3]], epsilon: f64) {
    let sticks = spans.len();
    let (mut gradients, mut excess) = (vec![vec![DVec3::ZERO; sticks + 1]; sticks], vec![0.0; sticks]);
    for (j, [low, high, _]) in spans.iter().enumerate() {
        let between = positions[j + 1] - positions[j];
        if masses[j] + masses[j + 1] > 0.0 {
            excess[j] = between.length() - between.length().clamp(*low, *high);
            (gradients[j][j], gradients[j][j + 1]) = (-between.normalize(), between.normalize());
        }
    }
    let matrix = (0..sticks).map(|i| {
        let entry = |j: usize| {
            let sum: f64 = (0..=sticks).map(|k| masses[k] * gradients[i][k].dot(gradients[j][k])).sum();
            sum + if i == j { epsilon + spans[i][2] } else { 0.0 }
        };
        (0..sticks).map(entry).collect()
    });
    let multipliers = solve_dense(matrix.collect(), excess.iter().map(|c| -c).collect());
    for (k, position) in positions.iter_mut().enumerate() {
        *position += (0..sticks).map(|j| gradients[j][k] * multipliers[j]).sum::<DVec3>() * masses[k];
    }
}

fn solved(spans: impl Fn(usize, usize) -> [f64; 3], epsilon: f64) -> Vec<DVec3> {
    let (mut expected, all_masses) = (in_f64(&cloud(PLACES, 3)), weights(PLACES));
    for thread in 0..16 {
        let places: Vec<usize> = (0..KNOTS).map(|knot| 8 + knot * STRIDE + thread).collect();
        let mut own: Vec<DVec3> = places.iter().map(|&place| expected[place]).collect();
        let masses: Vec<f64> = places.iter().map(|&place| f64::from(all_masses[place])).collect();
        let spans: Vec<[f64; 3]> = (0..KNOTS - 1).map(|stick| spans(stick, thread)).collect();
        newton(&mut own, &masses, &spans, epsilon);
        places.iter().zip(own).for_each(|(&place, at)| expected[place] = at);
    }
    expected
}

#[test]
fn threads_are_solved_as_by_gauss_elimination() {
    for (low, high, compliance) in [(0.5, 0.5, 0.0), (0.4, 1.2, 0.0), (0.8, 0.8, 3.0)] {
        let span = Span { low, high, compliance };
        let expected = solved(|_, _| [low, high, compliance].map(f64::from), f64::from(0.1_f32));
        let found = on_all(|| Solve(span, 0.1, cloud(PLACES, 3), weights(PLACES)));
        let off = farthest(&found, &expected);
        assert!(off < 2e-5, "{span:?}: {off} m off");
    }
}

#[test]
fn so_are_threads_whose_sticks_have_spans_of_their_own() {
    let number = |stick: usize, lane: usize| 0.3 + 0.1 * ((stick * 5 + lane) % 8) as f32;
    let row = |k: usize, scale: f32| Row(std::array::from_fn(|lane| scale * number(k, lane)));
    let rows: Vec<[Row; 3]> = (0..KNOTS - 1).map(|k| [row(k, 1.0), row(k, 1.1), row(k, 0.5)]).collect();
    let span =
        |stick: usize, thread: usize| rows[stick].each_ref().map(|row| f64::from(row.0[thread % LANES]));
    let found = on_all(|| Solve(&rows[..], 0.1, cloud(PLACES, 3), weights(PLACES)));
    let off = farthest(&found, &solved(span, f64::from(0.1_f32)));
    assert!(off < 2e-5, "{off} m off");
}

/// Of a chain that hangs straight from a held knot all lengths are linear in what moves: one solve mends them all.
#[test]
fn a_stretched_chain_that_hangs_straight_is_mended_at_once() {
    let mut chain = cloud(PLACES, 4);
    let mut masses: Numbers = std::iter::repeat_n(1.0, PLACES).collect();
    for thread in 0..16 {
        let mut depth = 0.0;
        for knot in 0..KNOTS {
            let place = 8 + knot * STRIDE + thread;
            set(&mut chain, place, Vec3::new(thread as f32, -depth, 0.0));
            masses[place] = if knot == 0 { 0.0 } else { 1.0 + knot as f32 };
            depth += 0.08 + 0.02 * ((knot * 3 + thread) % 5) as f32;
        }
    }
    let span = Span { low: 0.1, high: 0.1, compliance: 0.0 };
    let mended = in_f64(&on_all(|| Solve(span, 0.0, chain.clone(), masses.clone())));
    for thread in 0..16 {
        for knot in 0..KNOTS {
            let expected = DVec3::new(thread as f64, -0.1 * knot as f64, 0.0);
            let found = mended[8 + knot * STRIDE + thread];
            assert!(found.distance(expected) < 3e-6, "{found} instead of {expected}");
        }
    }
}
