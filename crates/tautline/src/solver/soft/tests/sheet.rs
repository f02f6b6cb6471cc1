use glam::Vec3;

use super::*;
use crate::simd::Kernel;
use crate::solver::soft::points::get;
use crate::solver::soft::tests::{noise, on_all, positions, wavy_sheet};

struct Turn<'a>(&'a Grid, &'a [f32], usize);

impl Kernel for Turn<'_> {
    type Output = [Vec<f32>; 2];

    #[inline(always)]
    fn run<L: Lanes>(self) -> [Vec<f32>; 2] {
        let Self(grid, numbers, stride) = self;
        let mut turned = vec![0.0; grid.stride() * stride];
        turn::<L>(grid, numbers, &mut turned, stride);
        let mut back = vec![0.0; numbers.len()];
        turn_back::<L>(grid, &turned, &mut back, stride);
        [turned, back]
    }
}

#[test]
fn rows_become_columns_and_come_back() {
    for (columns, rows) in [(2, 2), (9, 8), (14, 9), (15, 16), (33, 5), (40, 23)] {
        let grid = Grid::new(16, columns, rows);
        let numbers: Vec<f32> = (0..grid.places().end + LANES).map(|k| 2.0 + noise(k)).collect();
        let stride = rows.next_multiple_of(LANES);
        let [turned, back] = on_all(|| Turn(&grid, &numbers, stride));
        for row in 0..rows {
            for column in 0..columns {
                let place = grid.place(row, column);
                assert_eq!(turned[column * stride + row], numbers[place], "{row}, {column}");
                assert_eq!(back[place], numbers[place], "{row}, {column}");
            }
        }
        let is_outside = |place: &usize| !grid.places().contains(place);
        assert!((0..numbers.len()).filter(is_outside).all(|place| back[place] == 0.0));
    }
}

struct Pull<'a>(&'a Sheet, &'a Points, bool);

impl Kernel for Pull<'_> {
    type Output = Coordinates;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Coordinates {
        let (mut sheet, mut points) = (self.0.clone(), self.1.clone());
        sheet.pull_threads::<L>(&mut points, true, self.2, &mut Vec::new());
        positions(&points)
    }
}

/// A sheet, and the same one laid out the other way round.
#[test]
fn rows_are_solved_as_columns_are() {
    let span = |length: f32| Span { low: length, high: length, compliance: 0.0 };
    let (columns, rows) = (21, 12);
    let grids = [Grid::new(8, columns, rows), Grid::new(8, rows, columns)];
    let [sheet, other] = grids.map(|grid| {
        let weave = if grid.columns == columns { [0.09, 0.08, 0.12] } else { [0.08, 0.09, 0.12] };
        let bending = if grid.columns == columns { [8.0, 20.0] } else { [20.0, 8.0] };
        Sheet::new(grid, weave.map(span), Some(bending), 1.0)
    });
    let mut points = wavy_sheet(&sheet.grid, sheet.grid.places().end, 0.0);
    points.inverse_mass[sheet.grid.place(3, 4)] = 0.0;
    let mut others = Points::default();
    others.reset(other.grid.places().end);
    for row in 0..rows {
        for column in 0..columns {
            let (from, to) = (sheet.grid.place(row, column), other.grid.place(column, row));
            others.put(to, points.at(from), Vec3::ZERO);
            others.inverse_mass[to] = points.inverse_mass[from];
        }
    }
    for is_even in [false, true] {
        let found = on_all(|| Pull(&sheet, &points, is_even));
        let expected = on_all(|| Pull(&other, &others, !is_even));
        for row in 0..rows {
            for column in 0..columns {
                let at = get(&found, sheet.grid.place(row, column));
                assert_eq!(at, get(&expected, other.grid.place(column, row)), "{row}, {column}");
            }
        }
        assert_ne!(found[1], positions(&points)[1]);
    }
}
