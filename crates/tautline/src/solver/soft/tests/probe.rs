use proptest::prelude::*;

use super::*;
use crate::geometry::query::closest_to_triangle;
use crate::shape::Shape;
use crate::simd::Kernel;
use crate::solver::soft::tests::on_all;

const TOLERANCE: f64 = 1e-5;

struct Ask<'a>(Form<'a>, &'a [Vec3; LANES], f32);

impl Kernel for Ask<'_> {
    type Output = [(f32, Vec3); LANES];

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        answers(self.0.probe::<L>(lanes_of(self.1), self.2))
    }
}

struct AskTriangles<'a>(&'a [Facet], &'a [Vec3; LANES], f32);

impl Kernel for AskTriangles<'_> {
    type Output = [(f32, Vec3); LANES];

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        answers(probe_triangles::<L>(lanes_of(self.1), self.0, self.2))
    }
}

#[inline(always)]
fn lanes_of<L: Lanes>(points: &[Vec3; LANES]) -> Vec3x8<L> {
    let row = |axis: usize| Row(std::array::from_fn(|lane| points[lane][axis]));
    Vec3x8::load(&[row(0), row(1), row(2)])
}

#[inline(always)]
fn answers<L: Lanes>(probe: Probe<L>) -> [(f32, Vec3); LANES] {
    let (mut distances, mut normals) = (Row::ZERO, [Row::ZERO; 3]);
    probe.distance.store(&mut distances);
    probe.normal.store(&mut normals);
    let normal = |lane: usize| Vec3::new(normals[0].0[lane], normals[1].0[lane], normals[2].0[lane]);
    std::array::from_fn(|lane| (distances.0[lane], normal(lane)))
}

fn size() -> impl Strategy<Value = f32> {
    prop_oneof![Just(0.02_f32), 0.1_f32..1.0]
}

fn vector(reach: f32) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(prop_oneof![4 => -reach..reach, 1 => Just(0.0)]).prop_map(Vec3::from)
}

fn eight_points() -> impl Strategy<Value = [Vec3; LANES]> {
    [vector(1.5), vector(1.5), vector(1.5), vector(0.5), vector(0.5), vector(0.1), vector(0.1), vector(0.02)]
}

/// Balls, capsules, boxes, cylinders and hulls.
fn parts() -> impl Strategy<Value = Convex> {
    let hull = prop::collection::vec(vector(1.0), 8..24).prop_map(|points| Shape::convex_hull(&points));
    let shape = prop_oneof![
        size().prop_map(Shape::sphere),
        (size(), size()).prop_map(|(radius, half)| Shape::capsule(radius, half)),
        (size(), size()).prop_map(|(radius, half)| Shape::cylinder(radius, half)),
        prop::array::uniform3(size()).prop_map(|half| Shape::cuboid(half.into())),
        hull,
    ];
    shape.prop_filter_map("no shape", |shape| Some(shape.ok()?.parts()[0].convex.clone()))
}

fn turned(part: &Convex, turn: glam::Quat, shift: Vec3) -> Convex {
    let faces = part.faces.iter().map(|face| {
        let normal = turn * face.normal;
        Face { normal, offset: face.offset + normal.dot(shift), ..*face }
    });
    let vertices = part.vertices.iter().map(|&vertex| turn * vertex + shift).collect();
    Convex::new(vertices, faces.collect(), part.loops.clone(), part.radius)
}

proptest! {
    /// The place that distance and normal point back to is on the surface, and no other is nearer.
    #[test]
    fn distances_and_normals_are_those_of_the_closest_place(
        part in parts(),
        points in eight_points(),
        turn in vector(3.0),
        shift in vector(0.3),
    ) {
        let part = turned(&part, glam::Quat::from_scaled_axis(turn), shift);
        for (point, (distance, normal)) in points.into_iter().zip(on_all(|| Ask(Form::of(&part), &points, 9.0))) {
            let point = point.as_dvec3();
            let radius = f64::from(part.radius);
            let expected = closest_to_convex(point, &part).distance + radius;
            prop_assert!((f64::from(distance) - expected).abs() < TOLERANCE, "{distance}, not {expected}");
            prop_assert!((normal.length() - 1.0).abs() < 1e-5, "{normal}");
            let on_core = point - normal.as_dvec3() * f64::from(distance);
            let off = closest_to_convex(on_core, &part).distance + radius;
            prop_assert!(off.abs() < TOLERANCE, "{normal} leads {off} m off");
        }
    }

    #[test]
    fn beyond_its_reach_a_distance_is_no_more_than_it_is(
        part in parts(),
        points in eight_points(),
        reach in 0.0_f32..0.5,
    ) {
        for (point, (distance, _)) in points.into_iter().zip(on_all(|| Ask(Form::of(&part), &points, reach))) {
            let expected = closest_to_convex(point.as_dvec3(), &part).distance + f64::from(part.radius);
            let distance = f64::from(distance);
            prop_assert!(distance < expected + TOLERANCE);
            prop_assert!(distance > f64::from(reach) || (distance - expected).abs() < TOLERANCE);
        }
    }

    #[test]
    fn the_nearest_triangle_is_found(
        triangles in prop::collection::vec(prop::array::uniform3(vector(1.0)), 1..6),
        points in eight_points(),
        reach in prop_oneof![Just(9.0_f32), 0.0_f32..0.5],
    ) {
        // What has no area to speak of has no normal.
        let area = |[a, b, c]: &[Vec3; 3]| (*b - *a).cross(*c - *a).length();
        prop_assume!(triangles.iter().all(|corners| area(corners) > 0.02));
        let facets: Vec<Facet> = triangles.iter().copied().map(Facet::new).collect();
        let found = on_all(|| AskTriangles(&facets, &points, reach));
        for (point, (distance, normal)) in points.into_iter().zip(found) {
            let least = |at: DVec3| {
                let distance = |&corners: &[Vec3; 3]| closest_to_triangle(at, corners).distance;
                triangles.iter().map(distance).fold(f64::INFINITY, f64::min)
            };
            let expected = least(point.as_dvec3());
            if expected > f64::from(reach) {
                prop_assert!(f64::from(distance) > expected - TOLERANCE, "{distance}, not {expected}");
                continue;
            }
            prop_assert!((f64::from(distance) - expected).abs() < TOLERANCE, "{distance}, not {expected}");
            let on_it = point.as_dvec3() - normal.as_dvec3() * f64::from(distance);
            prop_assert!(least(on_it) < TOLERANCE, "{normal} leads {} m off", least(on_it));
        }
    }
}

#[test]
fn parts_are_told_by_what_they_are() {
    let form = |shape: Shape| format!("{:?}", Form::of(&shape.parts()[0].convex));
    assert!(form(Shape::sphere(1.0).unwrap()).starts_with("Point"));
    assert!(form(Shape::capsule(0.5, 1.0).unwrap()).starts_with("Segment"));
    assert!(form(Shape::cuboid(Vec3::new(0.1, 0.4, 0.2)).unwrap()).starts_with("Cuboid"));
    let wedge = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(1.0, 1.0, 0.0), Vec3::new(1.0, 0.0, 1.0)];
    assert!(form(Shape::convex_hull(&wedge).unwrap()).starts_with("Polytope"));
    let slanted = wedge.map(|p| p + Vec3::Z * p.x * 0.5);
    let frustum: Vec<Vec3> =
        slanted.into_iter().chain([Vec3::new(0.0, 1.0, 1.0), Vec3::new(1.2, 1.0, 1.5)]).collect();
    assert!(form(Shape::convex_hull(&frustum).unwrap()).starts_with("Polytope"));
    let far = AskTriangles(&[], &[Vec3::ZERO; LANES], 9.0);
    assert!(crate::simd::run(crate::simd::Instructions::Baseline, far)[0].0 > 1e30);
}
