//! Rays, moving shapes, overlaps and closest points against brute force in f64.

use std::sync::Arc;

use proptest::prelude::*;
use tautline::geometry::distance::distance;
use tautline::mesh::{TriMesh, primitives};
use tautline::{
    BodyHandle, Cloth, CollisionGroups, DVec3, Error, HalfSpace, Quat, QueryFilter, RigidBody, Rope, Shape,
    Truss, TrussBody, Vec3, World,
};

use super::{DT, add, awake, cube, run, weightless};

/// A box or a ball, somewhere.
#[derive(Debug, Clone, Copy)]
struct Thing {
    /// Of a ball all the same.
    half: Vec3,
    is_ball: bool,
    position: Vec3,
    rotation: Quat,
}

impl Thing {
    fn shape(&self) -> Arc<Shape> {
        let shape = if self.is_ball { Shape::sphere(self.half.x) } else { Shape::cuboid(self.half) };
        Arc::new(shape.unwrap())
    }

    fn local(&self, point: DVec3) -> DVec3 {
        self.rotation.as_dquat().inverse() * (point - self.position.as_dvec3())
    }

    /// Signed distance of a point, by the closed forms.
    fn distance(&self, point: DVec3) -> f64 {
        let (point, half) = (self.local(point), self.half.as_dvec3());
        if self.is_ball {
            return point.length() - half.x;
        }
        let beyond = point.abs() - half;
        beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0)
    }

    /// Where a ray enters, by the closed forms.
    fn enter(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let (o, d) = (self.local(origin), self.rotation.as_dquat().inverse() * direction);
        let half = self.half.as_dvec3();
        if self.is_ball {
            let (b, c) = (o.dot(d), o.length_squared() - half.x * half.x);
            let root = b * b - c;
            return (root >= 0.0 && -b + root.sqrt() >= 0.0).then(|| (-b - root.sqrt()).max(0.0));
        }
        let (a, b) = ((-half - o) / d, (half - o) / d);
        let (enter, leave) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
        (enter <= leave).then_some(enter)
    }

    fn corners(&self) -> Vec<Vec3> {
        let signs = (0..8).map(|k| Vec3::new((k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32));
        signs.map(|s| self.position + self.rotation * ((s * 2.0 - 1.0) * self.half)).collect()
    }

    /// Of two things, by closed forms or, of two boxes, GJK on their corners.
    fn separation(&self, other: &Self) -> f64 {
        match (self.is_ball, other.is_ball) {
            (true, _) => other.distance(self.position.as_dvec3()) - f64::from(self.half.x),
            (_, true) => self.distance(other.position.as_dvec3()) - f64::from(other.half.x),
            _ => f64::from(distance(&self.corners(), &other.corners()).unwrap().distance),
        }
    }
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-size..size).prop_map(Vec3::from)
}

fn thing(room: f32) -> impl Strategy<Value = Thing> {
    let turn = (vector(1.0), -3.0_f32..3.0);
    let half = prop::array::uniform3(0.1_f32..0.8).prop_map(Vec3::from);
    (half, any::<bool>(), vector(room), turn).prop_map(|(half, is_ball, position, (axis, angle))| {
        let rotation = Quat::from_axis_angle(axis.try_normalize().unwrap_or(Vec3::X), angle);
        let half = if is_ball { Vec3::splat(half.x) } else { half };
        Thing { half, is_ball, position, rotation }
    })
}

fn things(most: usize) -> impl Strategy<Value = Vec<Thing>> {
    prop::collection::vec(thing(4.0), 1..most)
}

fn world_of(things: &[Thing]) -> (World, Vec<BodyHandle>) {
    let mut world = World::new(weightless()).unwrap();
    let put = |thing: &Thing| {
        let body = RigidBody::new(&thing.shape()).position(thing.position).rotation(thing.rotation);
        world.add(body).unwrap()
    };
    let bodies = things.iter().map(put).collect();
    (world, bodies)
}

const ALL: QueryFilter = QueryFilter {
    groups: CollisionGroups { memberships: u32::MAX, filter: u32::MAX },
    exclude: None,
    fixed: true,
    movable: true,
};
/// What poses in f32 may be off by, in m.
const ROUNDING: f64 = 1e-5;

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn rays_enter_where_the_closed_forms_say(things in things(40), origin in vector(6.0), target in vector(3.0)) {
        prop_assume!(origin.distance(target) > 0.1);
        let (world, bodies) = world_of(&things);
        let direction = (target - origin).as_dvec3().normalize();
        let enter = |thing: &Thing| thing.enter(origin.as_dvec3(), direction);
        let mut expected: Vec<(f64, BodyHandle)> =
            things.iter().zip(&bodies).filter_map(|(thing, body)| Some((enter(thing)?, *body))).collect();
        // Grazing rays may hit or miss.
        let along = |i: i32| origin.as_dvec3() + direction * (f64::from(i) * 0.01);
        let near = |thing: &Thing| {
            (0..2000).map(|i| thing.distance(along(i)).abs()).fold(f64::INFINITY, f64::min)
        };
        prop_assume!(things.iter().all(|thing| enter(thing).is_some() || near(thing) > 1e-3));
        expected.sort_by(|a, b| a.0.total_cmp(&b.0));
        let hits = world.ray_cast_all(origin, target - origin, 100.0, ALL).unwrap();
        prop_assert_eq!(hits.len(), expected.len());
        for (hit, (t, _)) in hits.iter().zip(&expected) {
            prop_assert!((f64::from(hit.distance) - t).abs() < 20.0 * ROUNDING, "{:?} {}", hit, t);
            let thing = &things[bodies.iter().position(|body| *body == hit.body).unwrap()];
            prop_assert!(*t == 0.0 || thing.distance(hit.point.as_dvec3()).abs() < ROUNDING);
            prop_assert!(*t == 0.0 || hit.normal.as_dvec3().dot(direction) < 1e-3);
        }
        prop_assert_eq!(world.ray_cast(origin, target - origin, 100.0, ALL).unwrap(), hits.first().copied());
        if let Some(first) = hits.first() {
            let short = world.ray_cast(origin, target - origin, first.distance * 0.999, ALL).unwrap();
            prop_assert_eq!(short.is_some(), first.distance == 0.0);
        }
    }

    #[test]
    fn the_closest_point_is_that_of_the_closed_forms(things in things(40), point in vector(6.0)) {
        let (world, _) = world_of(&things);
        let from = point.as_dvec3();
        let least = things.iter().map(|thing| thing.distance(from)).fold(f64::INFINITY, f64::min);
        let hit = world.closest_point(point, 100.0, ALL).unwrap().unwrap();
        prop_assert!((f64::from(hit.distance) - least).abs() < ROUNDING, "{:?} {}", hit, least);
        prop_assert!((hit.point + hit.normal * hit.distance).distance(point) < 1e-5);
        prop_assume!(least > 1e-3);
        prop_assert_eq!(world.closest_point(point, least as f32 * 0.999, ALL).unwrap(), None);
    }

    #[test]
    fn what_overlaps_is_what_has_no_distance(things in things(40), probe in thing(3.0)) {
        let (world, bodies) = world_of(&things);
        let separation = |thing: &Thing| probe.separation(thing);
        prop_assume!(things.iter().all(|thing| separation(thing).abs() > ROUNDING));
        let pairs = things.iter().zip(&bodies).filter(|(thing, _)| separation(thing) < 0.0);
        let expected: Vec<BodyHandle> = pairs.map(|(_, body)| *body).collect();
        let found = world.overlap(&probe.shape(), probe.position, probe.rotation, ALL).unwrap();
        prop_assert_eq!(found, expected);
    }

    #[test]
    fn a_shape_goes_until_it_touches(things in things(25), probe in thing(5.0), way in vector(8.0)) {
        let (world, bodies) = world_of(&things);
        let shape = probe.shape();
        let hit = world.shape_cast(&shape, probe.position, probe.rotation, way, ALL).unwrap();
        let at = |t: f32| Thing { position: probe.position + way * t, ..probe };
        let gap = |t: f32| things.iter().map(|thing| at(t).separation(thing)).fold(f64::INFINITY, f64::min);
        let end = hit.map_or(1.0, |hit| hit.fraction);
        for i in 0..50 {
            let t = end * i as f32 / 50.0;
            prop_assert!(end == 0.0 || gap(t) > -2.0 * ROUNDING, "at {} {}", t, gap(t));
        }
        if let Some(hit) = hit {
            let touched = &things[bodies.iter().position(|body| *body == hit.body).unwrap()];
            let left = at(hit.fraction).separation(touched);
            prop_assert!(left < 5.0 * ROUNDING, "{} left", left);
            let on_body = touched.distance(hit.point.as_dvec3());
            prop_assert!(end == 0.0 || on_body.abs() < 1e-3, "{} off", on_body);
        }
    }
}

/// Möller & Trumbore's test in f64, over triangles.
fn first_triangle(mesh: &TriMesh, origin: DVec3, direction: DVec3) -> Option<f64> {
    let hit = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| mesh.positions[v as usize].as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let p = direction.cross(ac);
        let (determinant, from) = (ab.dot(p), origin - a);
        let (u, q) = (from.dot(p) / determinant, from.cross(ab));
        let (v, t) = (direction.dot(q) / determinant, ac.dot(q) / determinant);
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0).then_some(t)
    };
    mesh.triangles.iter().filter_map(hit).min_by(f64::total_cmp)
}

#[test]
fn cloth_trusses_and_meshes_are_hit_on_their_triangles() {
    let mut world = World::new(awake()).unwrap();
    let truss = Arc::new(Truss::from_mesh(&primitives::icosahedron(0.6).unwrap()).unwrap());
    world.add(TrussBody::new(&truss).position(Vec3::X * 2.0)).unwrap();
    let cloth = Cloth::grid(9, 9, 2.0, 2.0).rotation(Quat::from_rotation_x(0.3));
    world.add(cloth.pin(0).pin(8)).unwrap();
    let hills = Arc::new(Shape::triangle_mesh(&primitives::icosphere(0.7, 2).unwrap()).unwrap());
    let turned = Quat::from_rotation_y(0.5);
    world.add(RigidBody::new(&hills).position(Vec3::X * -2.0).rotation(turned).fixed()).unwrap();
    run(&mut world, 0.3);
    let meshes: Vec<TriMesh> = world
        .bodies()
        .map(|body| {
            let view = world.body(body).unwrap();
            let (positions, triangles) = (view.surface_positions().into_owned(), view.triangles().to_vec());
            TriMesh { positions, triangles }
        })
        .collect();
    let mut found = [0, 0];
    for i in 0..2000 {
        let number = |k: usize| ((i * 7919 + k * 104_729) % 1009) as f32 / 1009.0 - 0.5;
        let origin = Vec3::new(number(1) * 8.0, 3.0, number(2) * 4.0);
        let direction = Vec3::new(number(3) * 2.0, -3.0, number(4) * 2.0) - Vec3::Y * 0.1;
        let (o, d) = (origin.as_dvec3(), direction.as_dvec3().normalize());
        let expected = meshes.iter().filter_map(|mesh| first_triangle(mesh, o, d)).min_by(f64::total_cmp);
        let hit = world.ray_cast(origin, direction, 100.0, ALL).unwrap();
        found[usize::from(hit.is_some())] += 1;
        match (hit, expected) {
            (Some(hit), Some(t)) => {
                assert!((f64::from(hit.distance) - t).abs() < 1e-4, "{hit:?} {t}");
                assert!(hit.normal.dot(direction) <= 1e-3);
            }
            (hit, expected) => assert_eq!(hit.map(|hit| f64::from(hit.distance)), expected, "ray {i}"),
        }
    }
    assert!(found[0] > 200 && found[1] > 500, "{found:?}");
}

#[test]
fn ropes_half_spaces_and_meshes_meet_shapes() {
    let mut world = World::new(weightless()).unwrap();
    let floor = world.add(HalfSpace::floor(-1.0)).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X * 2.0, 11).radius(0.05)).unwrap();
    let mesh = Arc::new(Shape::triangle_mesh(&primitives::grid(4, 4, 2.0, 2.0).unwrap()).unwrap());
    let ground = world.add(RigidBody::new(&mesh).position(Vec3::Z * 5.0).fixed()).unwrap();
    let truss = Arc::new(Truss::from_mesh(&primitives::cube(2.0).unwrap()).unwrap());
    let truss = world.add(TrussBody::new(&truss).position(Vec3::Z * -5.0)).unwrap();
    let down = |x: Vec3| world.ray_cast(x, Vec3::NEG_Y, 10.0, ALL).unwrap().unwrap();
    assert_eq!(down(Vec3::new(0.55, 1.0, 0.0)).body, rope);
    assert!((down(Vec3::new(0.55, 1.0, 0.03)).distance - 0.96).abs() < 1e-6);
    assert_eq!(down(Vec3::new(0.55, 1.0, 0.06)).body, floor);
    assert_eq!(down(Vec3::new(0.3, 1.0, 5.2)).body, ground);
    let ball = Shape::sphere(0.25).unwrap();
    let cast = |x: Vec3| world.shape_cast(&ball, x, Quat::IDENTITY, Vec3::NEG_Y * 2.0, ALL).unwrap().unwrap();
    for (x, body, fraction) in [
        (Vec3::new(1.0, 1.0, 0.0), rope, 0.35),
        (Vec3::new(-1.0, 1.0, 0.0), floor, 0.875),
        (Vec3::new(0.1, 1.0, 5.1), ground, 0.375),
        (Vec3::new(0.1, 2.0, -5.1), truss, 0.375),
    ] {
        let hit = cast(x);
        assert!(hit.body == body && (hit.fraction - fraction).abs() < 1e-5, "{hit:?}");
        assert!(hit.normal.distance(Vec3::Y) < 1e-5);
    }
    let overlap = |x: Vec3| world.overlap(&ball, x, Quat::IDENTITY, ALL).unwrap();
    assert_eq!(overlap(Vec3::new(1.0, 0.29, 0.0)), [rope]);
    assert_eq!(overlap(Vec3::new(1.0, 0.31, 0.0)), []);
    assert_eq!(overlap(Vec3::new(0.1, 0.2, 5.1)), [ground]);
    assert_eq!(overlap(Vec3::Z * -5.0), [truss], "also within it");
    assert_eq!(overlap(Vec3::new(1.0, -0.9, 0.0)), [floor]);
    let near = |x: Vec3| world.closest_point(x, 0.5, ALL).unwrap();
    assert!(near(Vec3::new(1.03, 0.3, 0.0)).is_some_and(|hit| (hit.distance - 0.25).abs() < 1e-6));
    assert!(near(Vec3::new(0.1, 0.2, 5.1)).is_some_and(|hit| hit.body == ground));
    assert_eq!(near(Vec3::new(0.0, 1.0, 2.5)), None);
}

#[test]
fn filters_choose_and_what_moves_is_found_where_it_is_now() {
    let mut world = World::new(weightless()).unwrap();
    let groups = |bit: u32| CollisionGroups { memberships: 1 << bit, filter: 1 << bit };
    let at = |x: f32| RigidBody::new(&cube(1.0)).position(Vec3::X * x);
    let fixed = add(&mut world, at(2.0).groups(groups(1)).fixed());
    let free = add(&mut world, at(4.0).groups(groups(2)).velocity(Vec3::Y * 10.0));
    let first = |world: &World, filter: QueryFilter| {
        world.ray_cast(Vec3::ZERO, Vec3::X, 10.0, filter).unwrap().map(|hit| hit.body)
    };
    assert_eq!(first(&world, ALL), Some(fixed));
    assert_eq!(first(&world, QueryFilter { exclude: Some(fixed), ..ALL }), Some(free));
    assert_eq!(first(&world, QueryFilter { fixed: false, ..ALL }), Some(free));
    assert_eq!(first(&world, QueryFilter { groups: groups(2), ..ALL }), Some(free));
    assert_eq!(first(&world, QueryFilter { groups: groups(3), ..ALL }), None);
    assert_eq!(first(&world, QueryFilter { movable: false, exclude: Some(fixed), ..ALL }), None);
    world.remove(fixed).unwrap();
    assert_eq!(first(&world, ALL), Some(free));
    let stale = QueryFilter { exclude: Some(fixed), ..ALL };
    assert_eq!(world.ray_cast(Vec3::ZERO, Vec3::X, 10.0, stale), Err(Error::StaleHandle));
    (0..12).for_each(|_| drop(world.step(DT).unwrap()));
    assert_eq!(first(&world, ALL), None, "it has flown away");
    world.set_pose(free, Vec3::X, Quat::IDENTITY).unwrap();
    assert_eq!(first(&world, ALL), Some(free));
}
