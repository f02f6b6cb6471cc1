//! Nets: what they catch, what falls through them, and which are refused.

use tautline::{BodyHandle, Error, QueryFilter, Rope, Settings, Shape, Vec3, World};

use super::{center, run, solid, stretch};

const KNOTS: u32 = 12;
/// Between knots, in m.
const MESH: f32 = 0.3;

/// A square net at a height of 2 m, pinned at its rim; `inner` particles on each strand between two knots.
fn net(inner: u32) -> Rope {
    let at = |row: f32, column: f32| {
        let middle = 0.5 * (KNOTS - 1) as f32;
        Vec3::new((column - middle) * MESH, 2.0, (row - middle) * MESH)
    };
    let knot = |row: u32, column: u32| row * KNOTS + column;
    let mut points: Vec<Vec3> =
        (0..KNOTS * KNOTS).map(|k| at((k / KNOTS) as f32, (k % KNOTS) as f32)).collect();
    let mut segments = Vec::new();
    for row in 0..KNOTS {
        for column in 0..KNOTS {
            for (down, right) in [(0, 1), (1, 0)] {
                if row + down == KNOTS || column + right == KNOTS {
                    continue;
                }
                let (from, to) = (knot(row, column), knot(row + down, column + right));
                let mut last = from;
                for k in 1..=inner {
                    let share = k as f32 / (inner + 1) as f32;
                    points.push(points[from as usize].lerp(points[to as usize], share));
                    segments.push([last, points.len() as u32 - 1]);
                    last = points.len() as u32 - 1;
                }
                segments.push([last, to]);
            }
        }
    }
    let rim = (0..KNOTS * KNOTS).filter(|k| {
        let (row, column) = (k / KNOTS, k % KNOTS);
        row.min(column) == 0 || row.max(column) == KNOTS - 1
    });
    rim.fold(Rope::network(points, segments).mass(4.0).radius(0.02), Rope::pin)
}

fn drop_on(inner: u32, shape: Shape, mass: f32) -> (World, BodyHandle, BodyHandle) {
    let mut world = World::new(Settings { damping: 1.0, ..Settings::default() }).unwrap();
    let net = world.add(net(inner)).unwrap();
    let body = world.add(solid(shape).mass(mass).position(Vec3::new(0.05, 2.8, 0.08))).unwrap();
    run(&mut world, 6.0);
    (world, net, body)
}

#[test]
fn a_net_catches_what_is_larger_than_its_mesh() {
    let icosahedron = tautline::mesh::primitives::icosahedron(0.5).unwrap();
    for shape in [Shape::convex_hull(&icosahedron.positions).unwrap(), Shape::sphere(0.5).unwrap()] {
        let (world, net, body) = drop_on(1, shape, 30.0);
        let at = center(&world, body);
        let speed = world.body(body).unwrap().velocity().length();
        assert!(at.y > 1.0 && at.y < 2.6, "it is at {at}");
        assert!(speed < 0.5, "it moves at {speed} m/s");
        assert!(stretch(&world, net) < 0.08, "{}", stretch(&world, net));
    }
}

#[test]
fn what_is_smaller_falls_through() {
    let (world, net, body) = drop_on(1, Shape::sphere(0.06).unwrap(), 0.5);
    assert!(center(&world, body).y < 0.0, "{}", center(&world, body));
    assert!(stretch(&world, net) < 0.02);
}

#[test]
fn a_cloth_lies_on_a_net_and_rays_find_it() {
    let mut world = World::new(Settings::default()).unwrap();
    let net = world.add(net(2)).unwrap();
    let cloth = tautline::Cloth::grid(24, 24, 1.2, 1.2).mass(0.5).position(Vec3::Y * 2.3);
    let cloth = world.add(cloth).unwrap();
    let hit = world.ray_cast(Vec3::new(0.15, 0.0, 0.05), Vec3::Y, 2.1, QueryFilter::default()).unwrap();
    assert_eq!(hit.map(|hit| hit.body), Some(net));
    run(&mut world, 3.0);
    let lowest = super::positions(&world, cloth).iter().map(|at| at.y).fold(f32::INFINITY, f32::min);
    assert!(lowest > 1.0, "the lowest of the cloth is at {lowest}");
    assert!(center(&world, cloth).y < 2.2);
}

#[test]
fn a_branching_rope_hangs_from_its_ends() {
    let mut world = World::new(Settings { damping: 1.0, ..Settings::default() }).unwrap();
    let points = vec![Vec3::NEG_X, Vec3::X, Vec3::ZERO, Vec3::NEG_Y];
    let fork = Rope::network(points, vec![[0, 2], [1, 2], [2, 3]]).pin(0).pin(1).mass(4.0);
    let fork = world.add(fork).unwrap();
    run(&mut world, 5.0);
    let at = super::positions(&world, fork);
    assert!(stretch(&world, fork) < 2e-3, "{}", stretch(&world, fork));
    assert!((at[2].y - at[3].y - 1.0).abs() < 3e-3 && at[3].x.abs() < 1e-3, "{at:?}");
}

#[test]
fn what_is_no_net_is_refused() {
    let mut world = World::new(Settings::default()).unwrap();
    let mut field = |points: usize, segments: Vec<[u32; 2]>| {
        let points = (0..points).map(|k| Vec3::new(k as f32, 0.0, 0.0)).collect();
        match world.add(Rope::network(points, segments)).unwrap_err() {
            Error::Invalid { field, .. } => field,
            other => panic!("{other}"),
        }
    };
    assert_eq!(field(3, vec![]), "segments");
    assert_eq!(field(3, vec![[0, 1], [1, 3]]), "segments[1]");
    assert_eq!(field(3, vec![[0, 1]]), "points[2]");
    assert_eq!(field(2, vec![[0, 1], [1, 0]]), "segments");
    assert_eq!(field(2, vec![[0, 1], [1, 1]]), "points[1]");
}
