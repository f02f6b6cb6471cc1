//! What the tests of the kernels share.

use std::fmt::Debug;

use glam::{DVec3, Vec3};

use super::grid::Grid;
use super::points::{Coordinates, Moving, Points, get, set};
use crate::body::Cloth;
use crate::simd::{Instructions, Kernel, Numbers, run};

/// A number from −1 to 1 that looks random.
pub(super) fn noise(k: usize) -> f32 {
    let mixed = (k as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (mixed >> 40) as f32 / (1 << 23) as f32 - 1.0
}

pub(super) fn noise3(k: usize) -> Vec3 {
    Vec3::new(noise(3 * k), noise(3 * k + 1), noise(3 * k + 2))
}

/// Numbers by place, in the box from −1 to 1.
pub(super) fn cloud(places: usize, seed: usize) -> Coordinates {
    let mut positions: Coordinates = std::array::from_fn(|_| Numbers::zeros(places));
    (0..places).for_each(|place| set(&mut positions, place, noise3(seed * 10_000 + place)));
    positions
}

/// Inverse masses from 0.5 to 1.5 kg⁻¹; of every fifth particle 0.
pub(super) fn weights(places: usize) -> Numbers {
    (0..places).map(|place| if place % 5 == 3 { 0.0 } else { 1.0 + 0.5 * noise(place) }).collect()
}

/// Runs a kernel with every instruction set: all give the same bits.
pub(super) fn on_all<K: Kernel>(kernel: impl Fn() -> K) -> K::Output
where
    K::Output: Debug,
{
    let result = run(Instructions::Scalar, kernel());
    // Debug writes numbers so that they can be read back to the bit.
    let bits = format!("{result:?}");
    for instructions in [Instructions::Baseline, Instructions::Widest] {
        assert!(format!("{:?}", run(instructions, kernel())) == bits, "{instructions:?} gives other bits");
    }
    result
}

/// Where a kernel moves particles at rest.
pub(super) fn moved(start: Coordinates, kernel: impl FnOnce(&mut Moving<'_>)) -> Coordinates {
    let mut offset: Coordinates = std::array::from_fn(|_| Numbers::zeros(start[0].len()));
    kernel(&mut Moving { start: &start, offset: &mut offset });
    sums(&start, &offset)
}

/// Where all particles are.
pub(super) fn positions(points: &Points) -> Coordinates {
    sums(&points.start, &points.offset)
}

fn sums(a: &Coordinates, b: &Coordinates) -> Coordinates {
    std::array::from_fn(|axis| a[axis].iter().zip(&b[axis]).map(|(a, b)| a + b).collect())
}

pub(super) fn in_f64(positions: &Coordinates) -> Vec<DVec3> {
    (0..positions[0].len()).map(|place| get(positions, place).as_dvec3()).collect()
}

/// How far the farthest particle is from where it should be, in m.
pub(super) fn farthest(positions: &Coordinates, expected: &[DVec3]) -> f64 {
    in_f64(positions).iter().zip(expected).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// A stick in f64, relaxed once along what lay between its ends at the `start`, unless it has turned far from it: least
/// and greatest length, α/h².
pub(super) fn relax_in_f64(
    positions: &mut [DVec3],
    start: &[DVec3],
    masses: &[f32],
    [a, b]: [usize; 2],
    [low, high, compliance]: [f32; 3],
) {
    let [wa, wb] = [a, b].map(|place| f64::from(masses[place]));
    if wa + wb == 0.0 {
        return;
    }
    let between = positions[b] - positions[a];
    let length = between.length();
    let excess = length - length.clamp(f64::from(low), f64::from(high));
    let before = start[b] - start[a];
    let is_steady = between.dot(before) > 0.5 * length * length;
    let direction = if is_steady { before } else { between };
    let along = between.dot(direction) / length;
    let pull = direction * (excess / (along * (wa + wb + f64::from(compliance))));
    positions[a] += pull * wa;
    positions[b] -= pull * wb;
}

/// The sticks of a sheet by colour, between (row, column) and (row, column): the sweep's order.
pub(super) fn sticks_by_colour(columns: usize, rows: usize) -> Vec<Vec<[[usize; 2]; 2]>> {
    let cells = || (0..rows).flat_map(|row| (0..columns).map(move |column| [row, column]));
    let to = |[down, right]: [usize; 2], is_in: &dyn Fn([usize; 2]) -> bool| -> Vec<[[usize; 2]; 2]> {
        let stick = |[row, column]: [usize; 2]| [[row, column], [row + down, column + right]];
        cells()
            .filter(|&at| is_in(at))
            .map(stick)
            .filter(|[_, [row, column]]| *row < rows && *column < columns)
            .collect()
    };
    let mut colours = Vec::new();
    for (step, axis) in [([0, 1], 1), ([1, 0], 0), ([1, 1], 0)] {
        colours.extend((0..2).map(|parity| to(step, &|at: [usize; 2]| at[axis] % 2 == parity)));
    }
    colours
}

/// A sheet of cells of 0.1 m by 0.1 m that waves and is crumpled a little.
pub(super) fn wavy_sheet(grid: &Grid, places: usize, height: f32) -> Points {
    let mut points = Points::default();
    points.reset(places);
    put_wavy(&mut points, grid, height);
    points
}

pub(super) fn put_wavy(points: &mut Points, grid: &Grid, height: f32) {
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let place = grid.place(row, column);
            let (x, z) = (column as f32 * 0.1, row as f32 * 0.1);
            let wave = 0.1 * (7.0 * x).sin() + 0.06 * (9.0 * z + 2.0 * x).cos();
            let at = Vec3::new(x, height + wave, z) + noise3(place) * 0.01;
            points.put(place, at, Vec3::ZERO);
            points.inverse_mass[place] = 1.0;
            points.presence[place] = 1.0;
        }
    }
}

#[test]
fn the_colours_hold_every_stick_of_a_cloth_once() {
    for (columns, rows) in [(2, 2), (5, 3), (8, 9)] {
        let built = Cloth::grid(columns, rows, 1.0, 1.0).build().unwrap();
        let number = |[row, column]: [usize; 2]| (row * columns as usize + column) as u32;
        let mut own: Vec<[u32; 2]> =
            built.body.sticks.iter().map(|stick| [stick.a.min(stick.b), stick.a.max(stick.b)]).collect();
        let colours = sticks_by_colour(columns as usize, rows as usize);
        let mut swept: Vec<[u32; 2]> = colours.iter().flatten().map(|ends| ends.map(number)).collect();
        own.sort_unstable();
        swept.sort_unstable();
        assert_eq!(swept, own);
        for colour in colours {
            let mut ends: Vec<[usize; 2]> = colour.into_iter().flatten().collect();
            let count = ends.len();
            ends.sort_unstable();
            ends.dedup();
            assert_eq!(ends.len(), count, "no two of a colour share a particle");
        }
    }
}
