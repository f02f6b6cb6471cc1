use glam::{DVec3, Vec3};

use super::*;
use crate::simd::{Kernel, Numbers};
use crate::solver::soft::points::{Coordinates, set};
use crate::solver::soft::tests::{
    farthest, in_f64, moved, noise, noise3, on_all, relax_in_f64, sticks_by_colour,
};

const WEAVE: [[f32; 3]; 3] = [[0.1, 0.1, 0.0], [0.12, 0.13, 0.0], [0.15, 0.15, 0.5]];

fn weave() -> Weave {
    WEAVE.map(|[low, high, compliance]| Span { low, high, compliance })
}

/// A crumpled sheet; what is between its rows is full of noise, which no stick may see.
fn sheet(grid: &Grid) -> (Coordinates, Numbers) {
    let length = grid.places().end + LANES;
    let mut positions: Coordinates =
        std::array::from_fn(|axis| (0..length).map(|k| 50.0 * noise(k * 3 + axis)).collect());
    let mut masses = Numbers::zeros(length);
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let place = grid.place(row, column);
            let at = Vec3::new(column as f32 * 0.1, 0.0, row as f32 * 0.1) + noise3(place) * 0.05;
            set(&mut positions, place, at);
            masses[place] = if place % 7 == 2 { 0.0 } else { 1.0 + 0.5 * noise(place) };
        }
    }
    (positions, masses)
}

struct Sweep<'a>(&'a Grid, &'a Window, bool);

impl Kernel for Sweep<'_> {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let (positions, masses) = sheet(self.0);
        moved(positions, |moving| self.0.sweep::<L>(moving, &masses, self.1, (&weave(), self.2)))
    }
}

/// All sticks with both ends in a window, one by one; rows are even or odd as counted from its first.
fn swept(grid: &Grid, window: &Window, is_even: bool) -> Vec<DVec3> {
    let (positions, masses) = sheet(grid);
    let start = in_f64(&positions);
    let mut expected = start.clone();
    let place =
        |[row, column]: [usize; 2]| grid.place(window.rows.start + row, window.columns.start + column);
    let mut colours = sticks_by_colour(window.columns.len(), window.rows.len());
    if !is_even {
        colours.swap(4, 5);
    }
    for (number, colour) in colours.iter().enumerate() {
        for ends in colour {
            relax_in_f64(&mut expected, &start, &masses, ends.map(place), WEAVE[number / 2]);
        }
    }
    expected
}

#[test]
fn a_sweep_relaxes_every_stick_once() {
    for columns in 2..=19 {
        for rows in [2, 3, 6] {
            let grid = Grid::new(16, columns, rows);
            let whole = grid.whole();
            for is_even in [true, false] {
                let found = on_all(|| Sweep(&grid, &whole, is_even));
                let off = farthest(&found, &swept(&grid, &whole, is_even));
                assert!(off < 2e-6, "{columns} × {rows}: {off} m off");
            }
        }
    }
}

#[test]
fn a_window_is_swept_and_nothing_else() {
    let grid = Grid::new(8, 33, 12);
    for rows in [0..12, 0..5, 3..4, 7..12] {
        for columns in [0..33, 0..7, 2..3, 6..19, 20..33, 30..32] {
            let window = Window { rows: rows.clone(), columns };
            let found = on_all(|| Sweep(&grid, &window, true));
            let off = farthest(&found, &swept(&grid, &window, true));
            assert!(off < 2e-6, "{window:?}: {off} m off");
            let (before, after) = (in_f64(&sheet(&grid).0), in_f64(&found));
            for row in 0..grid.rows {
                for column in 0..grid.columns {
                    let place = grid.place(row, column);
                    let is_in = window.rows.contains(&row) && window.columns.contains(&column);
                    assert!(is_in || after[place] == before[place], "{window:?} moved {row}, {column}");
                }
            }
        }
    }
}

#[test]
fn every_particle_has_a_place_of_its_own() {
    for (columns, rows) in [(2, 2), (15, 3), (16, 4), (17, 5)] {
        let grid = Grid::new(24, columns, rows);
        let mut places: Vec<usize> =
            (0..rows * columns).map(|k| grid.place(k / columns, k % columns)).collect();
        assert!(places.iter().all(|place| grid.places().contains(place)));
        places.sort_unstable();
        places.dedup();
        assert_eq!(
            (places.len(), grid.places().start % LANES, grid.stride() % LANES),
            (rows * columns, 0, 0)
        );
    }
}
