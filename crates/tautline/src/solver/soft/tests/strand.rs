use proptest::prelude::*;

use super::*;
use crate::geometry::closest::closest_between_segments;
use crate::simd::Kernel;
use crate::solver::soft::tests::{noise3, on_all, wavy_sheet};

fn vector() -> impl Strategy<Value = Vec3> {
    let lattice = prop::array::uniform3(-3..=3).prop_map(|c: [i32; 3]| Vec3::from(c.map(|k| k as f32)));
    prop_oneof![lattice, prop::array::uniform3(-3.0_f32..3.0).prop_map(Vec3::from)]
}

fn gap(a: [Vec3; 2], b: [Vec3; 2], [share_a, share_b]: [f64; 2]) -> f64 {
    let at = |ends: [Vec3; 2], share: f64| ends[0].as_dvec3().lerp(ends[1].as_dvec3(), share);
    at(a, share_a).distance(at(b, share_b))
}

proptest! {
    #[test]
    fn the_nearest_places_of_two_segments_are_found(
        a in prop::array::uniform2(vector()),
        b in prop::array::uniform2(vector()),
        is_point in any::<bool>(),
    ) {
        let a = if is_point { [a[0]; 2] } else { a };
        prop_assume!(b[0].distance(b[1]) > 0.01 && (is_point || a[0].distance(a[1]) > 0.01));
        let shares = nearest_shares(a, b);
        prop_assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)), "{shares:?}");
        let ends = [a, b].map(|ends| ends.map(Vec3::as_dvec3));
        let exact = closest_between_segments(ends[0], ends[1]).map(|weights| weights[1]);
        let (found, expected) = (gap(a, b, shares.map(f64::from)), gap(a, b, exact));
        prop_assert!((found - expected).abs() < 1e-3, "{found}, not {expected}");
    }
}

const SEGMENTS: u32 = 20;

/// A rope of segments of 6 cm that waves across a sheet of 10 × 10 particles.
fn scene() -> (Points, Strands, Vec<Tile>) {
    let grid = crate::solver::soft::grid::Grid::new(0, 10, 10);
    let start = grid.places().end;
    let mut points = wavy_sheet(&grid, start + 64, 0.1);
    let mut strands = Strands::default();
    for knot in 0..=SEGMENTS as usize {
        let place = start + knot;
        let at = Vec3::new(0.06 * knot as f32 - 0.1, 0.1 + 0.05 * (knot as f32).sin(), 0.45);
        points.put(place, at, Vec3::ZERO);
        points.inverse_mass[place] = 0.5;
        points.presence[place] = 1.0;
    }
    let segment = |number: u32| Segment {
        ends: [start as u32 + number, start as u32 + number + 1],
        radius: 0.03,
        friction: 0.5,
        rope: 1,
        number,
        exempt: 2,
        is_held: number == 0,
    };
    strands.add((0..SEGMENTS).map(segment));
    (points, strands, crate::solver::soft::tile::tiles_of_grid(&grid))
}

struct Look<'a>(&'a Strands, &'a Points, &'a [Tile], f32);

impl Kernel for Look<'_> {
    type Output = Vec<([u32; 2], [u32; 2])>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let Self(strands, points, tiles, margin) = self;
        let mut strands = strands.clone();
        let boxes: Vec<Bounds> = tiles.iter().map(|tile| tile.bounds::<L>(points)).collect();
        let sheet = Sheeting { piece: 0, tiles, boxes: &boxes, thickness: 0.06, friction: 0.5 };
        strands.look::<L>(points, std::iter::once(sheet), margin, &mut Couples::default());
        let of_brushes = strands.brushes.iter().map(|brush| ([brush.place; 2], brush.ends));
        let mut nears: Vec<_> = strands.nears.iter().map(|near| (near.a, near.b)).chain(of_brushes).collect();
        nears.sort_unstable();
        nears
    }
}

/// What is nearer than thickness, radius and margin is listed: all particles, all pairs of segments but neighbours.
#[test]
fn all_that_may_touch_is_listed() {
    let (points, strands, tiles) = scene();
    for margin in [0.0, 0.02, 0.1] {
        let listed = on_all(|| Look(&strands, &points, &tiles, margin));
        let mut particles = 0;
        for segment in &strands.segments {
            let ends = segment.ends.map(|end| points.at(end as usize));
            for place in (0..points.presence.len()).filter(|&place| points.presence[place] == 1.0) {
                let at = [points.at(place); 2];
                let exact = closest_between_segments(at.map(Vec3::as_dvec3), ends.map(Vec3::as_dvec3));
                let away = gap(at, ends, exact.map(|weights| weights[1])) - 0.09 - f64::from(margin);
                let is_cloth = place < strands.segments[0].ends[0] as usize;
                let is_listed = listed.contains(&([place as u32; 2], segment.ends));
                assert!(away.abs() < 1e-6 || is_listed == (is_cloth && away < 0.0), "{place}: {away}");
                particles += usize::from(is_listed);
            }
            for other in strands.segments.iter().filter(|other| other.number > segment.number) {
                let to = other.ends.map(|end| points.at(end as usize));
                let exact = closest_between_segments(ends.map(Vec3::as_dvec3), to.map(Vec3::as_dvec3));
                let away = gap(ends, to, exact.map(|weights| weights[1])) - 0.06 - f64::from(margin);
                let may = other.number - segment.number > 2;
                let is_listed = listed.contains(&(segment.ends, other.ends));
                assert!(!is_listed || may);
                assert!(is_listed || !may || away > -1e-6, "{} {}: {away}", segment.number, other.number);
            }
        }
        assert!(particles > 10, "{particles} particles are near");
    }
}

/// A segment and another that crosses it too close, at rest or after they have passed each other in this small step.
#[test]
fn crossing_segments_are_parted_and_momentum_is_kept() {
    for (height, fall) in [(0.03, 0.0), (0.03, 0.02), (-0.01, 0.05), (-0.04, 0.09)] {
        let mut points = Points::default();
        points.reset(8);
        let ends = [[Vec3::NEG_X, Vec3::X], [Vec3::NEG_Z, Vec3::Z].map(|end| end + Vec3::Y * height)];
        for (place, at) in ends.into_iter().flatten().enumerate() {
            points.put(place, at + noise3(place) * 1e-3, Vec3::ZERO);
            points.inverse_mass[place] = 1.0 + 0.2 * place as f32;
            let motion = if place > 1 { Vec3::new(0.001, -fall, 0.0) } else { Vec3::ZERO };
            points.set_motion(place, motion);
        }
        let masses = points.inverse_mass.clone();
        let momentum = |points: &Points| -> Vec3 { (0..4).map(|k| points.motion(k) / masses[k]).sum() };
        let middle = |points: &Points| -> Vec3 { (0..4).map(|k| points.at(k) / masses[k]).sum() };
        let turned = |points: &Points| -> Vec3 {
            (0..4).map(|k| points.begun_at(k).cross(points.motion(k)) / masses[k]).sum()
        };
        let (before, place, turn) = (momentum(&points), middle(&points), turned(&points));
        let mut couples = Couples::default();
        let couple = couples.number([0, 1]);
        let near = Near { a: [0, 1], b: [2, 3], distance: 0.05, friction: 0.0, couple };
        near.part(&mut points.slices(), f32::MAX, &mut couples);
        // Without friction contacts are central.
        assert!((turned(&points) - turn).length() < 1e-7, "{height}, {fall}");
        let now = [[0, 1], [2, 3]].map(|ends| ends.map(|k| points.at(k)));
        let shares = nearest_shares(now[0], now[1]).map(f64::from);
        let apart = gap(now[0], now[1], shares);
        assert!((apart - 0.05).abs() < 1e-4, "{height}, {fall}: {apart} m apart");
        assert!(now[1][0].y + now[1][1].y > now[0][0].y + now[0][1].y, "the one from above stays above");
        assert!((momentum(&points) - before).length() < 1e-6);
        assert!((middle(&points) - place).length() < 1e-6);
    }
}
