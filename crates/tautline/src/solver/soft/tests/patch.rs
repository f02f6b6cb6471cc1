use glam::DVec3;

use super::*;
use crate::simd::Kernel;
use crate::solver::soft::tests::{noise3, on_all, positions, wavy_sheet};
use crate::solver::soft::tile::tiles_of_grid;

struct ConeOf<'a>(&'a Grid, &'a Tile, &'a Points);

impl Kernel for ConeOf<'_> {
    type Output = Cone;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Cone {
        cone_of::<L>(self.0, self.1, &positions(self.2), self.2)
    }
}

/// The normal of the cell whose first corner is here, as from both its diagonals.
fn normal_of(grid: &Grid, points: &Points, row: usize, column: usize) -> DVec3 {
    let at = |down: usize, right: usize| points.at(grid.place(row + down, column + right)).as_dvec3();
    (at(1, 1) - at(0, 0)).cross(at(1, 0) - at(0, 1)).normalize()
}

/// Whether the cell whose first corner is here has a free diagonal that is much shorter than the other.
fn is_folded(grid: &Grid, points: &Points, row: usize, column: usize) -> bool {
    let at = |down: usize, right: usize| points.at(grid.place(row + down, column + right)).as_dvec3();
    (at(1, 0) - at(0, 1)).length_squared() < f64::from(FOLDED) * (at(1, 1) - at(0, 0)).length_squared()
}

#[test]
fn cones_hold_the_normals_of_all_cells_and_no_more() {
    for (columns, rows) in [(2, 2), (17, 9), (31, 20), (40, 8)] {
        let grid = Grid::new(8, columns, rows);
        let points = wavy_sheet(&grid, grid.places().end, 0.0);
        for tile in tiles_of_grid(&grid) {
            let cone = on_all(|| ConeOf(&grid, &tile, &points));
            let cells = (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| (row, column)));
            let is_own = |&(row, column): &(usize, usize)| {
                let place = grid.place(row, column);
                tile.eights.iter().any(|&eight| (eight as usize..eight as usize + LANES).contains(&place))
            };
            let cosine = |(row, column)| normal_of(&grid, &points, row, column).dot(cone.axis.as_dvec3());
            let own: Vec<(usize, usize)> = cells.filter(is_own).collect();
            // What is folded faces any way. A last row or column alone has no cells, and no direction.
            let is_any = own.iter().any(|&(row, column)| is_folded(&grid, &points, row, column));
            let widest = own.into_iter().map(cosine).reduce(f64::min);
            let expected = if is_any { -1.0 } else { widest.unwrap_or(-1.0) };
            let off = (f64::from(cone.cosine) - expected).abs();
            assert!(off < 1e-5, "{columns} × {rows}, {:?}: {cone:?}, not {expected}", tile.at);
        }
    }
}

/// A corner that lies on the one across the cell, where the diagonals have next to no direction.
#[test]
fn a_folded_corner_faces_any_way() {
    let grid = Grid::new(8, 9, 9);
    let mut points = wavy_sheet(&grid, grid.places().end, 0.0);
    for (row, column) in (0..9).flat_map(|row| (0..9).map(move |column| (row, column))) {
        points.put(grid.place(row, column), Vec3::new(column as f32, 0.0, row as f32), Vec3::ZERO);
    }
    let tile = &tiles_of_grid(&grid)[0];
    assert!(on_all(|| ConeOf(&grid, tile, &points)).cosine > 0.999);
    let across = points.at(grid.place(0, 1));
    points.put(grid.place(1, 0), across + Vec3::Y * 0.02, Vec3::ZERO);
    assert_eq!(on_all(|| ConeOf(&grid, tile, &points)), Cone::ALL);
}

/// Whether all directions in both cones are within an angle of the middle between their axes.
#[test]
fn cones_are_smooth_if_both_are_within_the_angle() {
    let angle = 75.0_f32.to_radians();
    for k in 0..300 {
        let cone = |k: usize, widest: f32| Cone { axis: noise3(k).normalize(), cosine: widest.cos() };
        let widths = [noise3(k + 5000).x.abs() * 1.5, noise3(k + 5000).y.abs() * 1.5];
        let (a, b) = (cone(k, widths[0]), cone(k + 1000, widths[1]));
        let between = a.axis.dot(b.axis).clamp(-1.0, 1.0).acos();
        let reach = 0.5 * between + widths[0].max(widths[1]);
        if (reach - angle).abs() > 1e-3 {
            assert_eq!(a.is_smooth_with(&b, angle.cos()), reach < angle, "{a:?} {b:?}");
            assert_eq!(b.is_smooth_with(&a, angle.cos()), reach < angle);
        }
        assert!(!a.is_smooth_with(&Cone::ALL, angle.cos()));
    }
}
