use super::*;
use crate::simd::Kernel;
use crate::solver::soft::tests::{on_all, positions, wavy_sheet};

struct Look<'a>(&'a [Tile], &'a Points, Bounds);

impl Kernel for Look<'_> {
    type Output = (Vec<Bounds>, Vec<u32>);

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let Self(tiles, points, bounds) = self;
        let (mut boxes, mut found) = (Vec::new(), Vec::new());
        for tile in tiles {
            boxes.push(tile.bounds::<L>(points));
            for &place in &tile.eights {
                let bits = inside::<L>(points, &positions(points), place as usize, &bounds);
                found.extend((0..LANES as u32).filter(|lane| bits >> lane & 1 == 1).map(|lane| place + lane));
            }
        }
        found.sort_unstable();
        (boxes, found)
    }
}

#[test]
fn every_particle_of_a_sheet_is_in_one_tile_and_in_its_box() {
    for (columns, rows) in [(2, 2), (16, 8), (17, 9), (40, 23)] {
        let grid = Grid::new(16, columns, rows);
        let points = wavy_sheet(&grid, grid.places().end, 1.0);
        let bounds = Bounds { low: Vec3::new(0.25, 0.9, -0.1), high: Vec3::new(0.95, 1.1, 0.75) };
        let tiles = tiles_of_grid(&grid);
        let (boxes, found) = on_all(|| Look(&tiles, &points, bounds));
        let mut tile_of = vec![usize::MAX; points.presence.len()];
        for (number, tile) in tiles.iter().enumerate() {
            assert!(tile.eights.len() <= MOST_EIGHTS);
            let mut expected = Bounds::EMPTY;
            let there = |place: &usize| points.presence[*place] == 1.0;
            for place in tile.eights.iter().flat_map(|&k| k as usize..k as usize + LANES).filter(there) {
                assert_eq!(tile_of[place], usize::MAX, "{place} is in two tiles");
                tile_of[place] = number;
                expected = expected.with(Bounds { low: points.at(place), high: points.at(place) });
            }
            assert_eq!(boxes[number], expected);
        }
        let is_in = |place: &u32| {
            let at = points.at(*place as usize);
            at.cmpge(bounds.low).all() && at.cmple(bounds.high).all()
        };
        let mut expected: Vec<u32> =
            (0..columns * rows).map(|k| grid.place(k / columns, k % columns) as u32).filter(is_in).collect();
        expected.sort_unstable();
        assert_eq!(found, expected);
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let at = |row: usize, column: usize| tiles[tile_of[grid.place(row, column)]].at;
            let (here, next) = (at(row, column), at((row + 1).min(rows - 1), (column + 1).min(columns - 1)));
            assert!((0..2).all(|k| here[k].abs_diff(next[k]) <= 1), "{here:?} {next:?} are neighbours");
        }
    }
}

#[test]
fn places_that_follow_each_other_are_tiled_in_order() {
    let tiles = tiles_of_run(16..16 + 37 * LANES);
    let eights: Vec<u32> = tiles.iter().flat_map(|tile| tile.eights.clone()).collect();
    assert_eq!(eights, (0..37).map(|k| 16 + 8 * k).collect::<Vec<u32>>());
    assert!(tiles.iter().all(|tile| tile.eights.len() <= MOST_EIGHTS));
}

#[test]
fn boxes_that_touch_meet() {
    let unit = Bounds { low: Vec3::ZERO, high: Vec3::ONE };
    let beside = |x: f32| Bounds { low: Vec3::new(x, 0.5, 0.5), high: Vec3::new(x + 1.0, 2.0, 2.0) };
    assert!(unit.meets(&beside(1.0)) && beside(1.0).meets(&unit));
    assert!(!unit.meets(&beside(1.01)) && unit.grown(0.02).meets(&beside(1.01)));
    assert!(!Bounds::EMPTY.meets(&unit) && Bounds::EMPTY.with(unit) == unit);
}
