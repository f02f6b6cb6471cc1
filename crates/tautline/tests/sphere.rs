//! Spheres around points and spheres, against brute force in f64.

use glam::{DVec3, Quat, Vec3};
use proptest::prelude::*;
use tautline::geometry::{Sphere, circumsphere, smallest_enclosing_sphere};

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-10.0_f32..10.0).prop_map(Vec3::from)
}

/// Points of a small lattice: full of duplicates, lines, planes and common spheres.
fn lattice_point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-2_i8..3).prop_map(|[x, y, z]| Vec3::new(x.into(), y.into(), z.into()))
}

fn distance(a: Vec3, b: Vec3) -> f64 {
    a.as_dvec3().distance(b.as_dvec3())
}

fn contains(sphere: Sphere, point: Vec3) -> bool {
    distance(sphere.center, point) <= f64::from(sphere.radius)
}

/// The centre of the circle through a, b and 0.
fn circumcenter(a: DVec3, b: DVec3) -> Option<DVec3> {
    let normal = a.cross(b);
    let square = normal.length_squared();
    let offset = (a.length_squared() * b - b.length_squared() * a).cross(normal) / (2.0 * square);
    (square > 1e-12).then_some(offset)
}

/// The centre of the sphere through a, b, c and 0.
fn circumcenter_of_four(a: DVec3, b: DVec3, c: DVec3) -> Option<DVec3> {
    let volume = a.dot(b.cross(c));
    let offset =
        a.length_squared() * b.cross(c) + b.length_squared() * c.cross(a) + c.length_squared() * a.cross(b);
    (volume.abs() > 1e-9).then_some(offset / (2.0 * volume))
}

/// The radius of the smallest sphere by trying the sphere through every point, pair, triple and quadruple.
fn brute_force_radius(points: &[Vec3]) -> f64 {
    let points: Vec<DVec3> = points.iter().map(|point| point.as_dvec3()).collect();
    let mut best = f64::INFINITY;
    let mut offer = |corner: DVec3, offset: DVec3| {
        let radius = offset.length();
        let inside = |p: &DVec3| p.distance(corner + offset) <= radius * (1.0 + 1e-9) + 1e-12;
        if radius < best && points.iter().all(inside) {
            best = radius;
        }
    };
    for (i, &p) in points.iter().enumerate() {
        offer(p, DVec3::ZERO);
        for (j, &q) in points.iter().enumerate().skip(i + 1) {
            offer(p, (q - p) / 2.0);
            for (k, &r) in points.iter().enumerate().skip(j + 1) {
                if let Some(offset) = circumcenter(q - p, r - p) {
                    offer(p, offset);
                }
                for &s in &points[k + 1..] {
                    if let Some(offset) = circumcenter_of_four(q - p, r - p, s - p) {
                        offer(p, offset);
                    }
                }
            }
        }
    }
    best
}

fn check_smallest(points: &[Vec3]) -> Result<(), TestCaseError> {
    let found = smallest_enclosing_sphere(points).unwrap();
    prop_assert!(points.iter().all(|&p| contains(found.sphere, p)));
    let (radius, expected) = (f64::from(found.sphere.radius), brute_force_radius(points));
    prop_assert!((radius - expected).abs() <= 2e-6 * expected + 1e-12, "{radius} is not {expected}");
    let support = found.support;
    let weight_sum: f32 = support.weights.iter().sum();
    prop_assert!((weight_sum - 1.0).abs() < 1e-6 && support.weights.iter().all(|&w| w >= 0.0));
    prop_assert!(support.weights[support.count as usize..].iter().all(|&w| w == 0.0));
    let tolerance = 1e-5 * (1.0 + expected);
    let mut mean = DVec3::ZERO;
    for (&index, &weight) in support.points.iter().zip(&support.weights) {
        let point = points[index as usize];
        prop_assert!((distance(found.sphere.center, point) - expected).abs() < tolerance);
        mean += point.as_dvec3() * f64::from(weight);
    }
    prop_assert!(mean.distance(found.sphere.center.as_dvec3()) < tolerance);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn smallest_sphere_of_random_points(points in prop::collection::vec(point(), 1..13)) {
        check_smallest(&points)?;
    }

    #[test]
    fn smallest_sphere_of_degenerate_points(points in prop::collection::vec(lattice_point(), 1..13)) {
        check_smallest(&points)?;
    }

    #[test]
    fn smallest_sphere_far_from_the_origin(points in prop::collection::vec(lattice_point(), 1..10)) {
        let far = Vec3::new(4096.0, -2048.0, 1024.0);
        let moved: Vec<Vec3> = points.iter().map(|&p| p * 0.125 + far).collect();
        let found = smallest_enclosing_sphere(&moved).unwrap().sphere;
        prop_assert!(moved.iter().all(|&p| contains(found, p)));
        // The centre is rounded to f32, here to 2⁻¹² m.
        prop_assert!(f64::from(found.radius) <= brute_force_radius(&points) * 0.125 + 5e-4);
    }

    #[test]
    fn smallest_sphere_of_cospherical_points(
        turn in prop::array::uniform4(-1.0_f32..1.0),
        radius in 0.01_f32..100.0,
    ) {
        prop_assume!(Vec3::new(turn[0], turn[1], turn[2]).length() > 0.1);
        let turn = Quat::from_array(turn).normalize();
        let sign = |i: u8, bit: u8| f32::from(i >> bit & 1) * 2.0 - 1.0;
        let corner = |i: u8| turn * Vec3::new(sign(i, 0), sign(i, 1), sign(i, 2)) * radius;
        let corners: Vec<Vec3> = (0..8).map(corner).collect();
        let found = smallest_enclosing_sphere(&corners).unwrap().sphere;
        prop_assert!((found.radius / (radius * 3.0_f32.sqrt()) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn triangle_spheres_are_smallest(corners in prop::array::uniform3(point())) {
        let sphere = Sphere::around_triangle(corners[0], corners[1], corners[2]);
        prop_assert!(corners.iter().all(|&p| contains(sphere, p)));
        prop_assert!(f64::from(sphere.radius) <= brute_force_radius(&corners) * 1.0001 + 1e-6);
    }

    #[test]
    fn degenerate_triangle_spheres_are_smallest(corners in prop::array::uniform3(lattice_point())) {
        let sphere = Sphere::around_triangle(corners[0], corners[1], corners[2]);
        prop_assert!(corners.iter().all(|&p| contains(sphere, p)));
        prop_assert!(f64::from(sphere.radius) <= brute_force_radius(&corners) * 1.00001);
    }

    #[test]
    fn quad_spheres_are_nearly_smallest(corners in prop::array::uniform4(point())) {
        let [a, b, c, d] = corners;
        let sphere = Sphere::around_quad(a, b, c, d);
        prop_assert!(corners.iter().all(|&p| contains(sphere, p)));
        prop_assert!(f64::from(sphere.radius) <= brute_force_radius(&corners) * 1.0101);
    }

    #[test]
    fn degenerate_quad_spheres_are_nearly_smallest(corners in prop::array::uniform4(lattice_point())) {
        let [a, b, c, d] = corners;
        let sphere = Sphere::around_quad(a, b, c, d);
        prop_assert!(corners.iter().all(|&p| contains(sphere, p)));
        prop_assert!(f64::from(sphere.radius) <= brute_force_radius(&corners) * 1.0101);
    }

    #[test]
    fn around_two_contains_both_and_is_smallest(
        centers in prop::array::uniform2(point()),
        radii in prop::array::uniform2(0.0_f32..8.0),
        offset in -2000.0_f32..2000.0,
    ) {
        let [a, b] = [0, 1].map(|i| Sphere { center: centers[i] + offset, radius: radii[i] });
        let sphere = Sphere::around_two(a, b);
        for part in [a, b] {
            let needed = distance(sphere.center, part.center) + f64::from(part.radius);
            prop_assert!(needed <= f64::from(sphere.radius));
        }
        let (ra, rb) = (f64::from(a.radius), f64::from(b.radius));
        let expected = (0.5 * (distance(a.center, b.center) + ra + rb)).max(ra).max(rb);
        let rounding = 1e-6 * (f64::from(offset.abs()) + 10.0);
        prop_assert!(f64::from(sphere.radius) <= expected * 1.000_001 + rounding);
    }
}

#[test]
fn around_two_with_equal_centers_is_the_larger() {
    let small = Sphere { center: Vec3::ONE, radius: 1.0 };
    let large = Sphere { center: Vec3::ONE, radius: 2.0 };
    for sphere in [Sphere::around_two(small, large), Sphere::around_two(large, small)] {
        assert_eq!(sphere.center, Vec3::ONE);
        assert!((sphere.radius - 2.0).abs() < 1e-5);
    }
    let point = Sphere { center: Vec3::ZERO, radius: 0.0 };
    assert_eq!(Sphere::around_two(point, point), point);
}

#[test]
fn tiny_triangles_are_contained() {
    // So small that the barycentric weights underflow to 0.
    let corners = [Vec3::ZERO, Vec3::X * 1e-13, Vec3::new(0.5e-13, 0.866e-13, 0.0)];
    let sphere = Sphere::around_triangle(corners[0], corners[1], corners[2]);
    assert!(corners.iter().all(|&p| contains(sphere, p)));
}

#[test]
fn circumsphere_passes_through_its_points() {
    let points = [Vec3::ZERO, Vec3::X, Vec3::Y * 2.0, Vec3::Z * 3.0];
    for count in 1..=4 {
        let sphere = circumsphere(&points[..count]).unwrap();
        for &point in &points[..count] {
            assert!((distance(sphere.center, point) - f64::from(sphere.radius)).abs() < 1e-6);
        }
    }
    assert_eq!(circumsphere(&points).unwrap().center, Vec3::new(0.5, 1.0, 1.5));
}

#[test]
fn circumsphere_refuses_what_has_none() {
    assert_eq!(circumsphere(&[]), None);
    assert_eq!(circumsphere(&[Vec3::ONE; 2]), None);
    assert_eq!(circumsphere(&[Vec3::ZERO, Vec3::X, Vec3::X * 2.0]), None);
    assert_eq!(circumsphere(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X + Vec3::Y]), None);
    assert_eq!(circumsphere(&[Vec3::ZERO, Vec3::X, Vec3::NAN]), None);
    assert_eq!(circumsphere(&[Vec3::ZERO; 5]), None);
}

#[test]
fn smallest_sphere_refuses_nothing_and_nan() {
    assert_eq!(smallest_enclosing_sphere(&[]), None);
    assert_eq!(smallest_enclosing_sphere(&[Vec3::ZERO, Vec3::NAN]), None);
    assert_eq!(smallest_enclosing_sphere(&[Vec3::INFINITY]), None);
}

#[test]
fn overlap_and_containment_at_the_border() {
    let a = Sphere { center: Vec3::ZERO, radius: 1.0 };
    let touching = Sphere { center: Vec3::X * 3.0, radius: 2.0 };
    assert!(a.overlaps(&touching));
    assert!(!a.overlaps(&Sphere { radius: 1.999, ..touching }));
    assert!(!a.overlaps(&Sphere { center: Vec3::NAN, radius: 1.0 }));
    assert!(a.contains_point(Vec3::X * 1.5, 0.5) && !a.contains_point(Vec3::X * 1.5, 0.49));
    assert!(!a.contains_point(Vec3::ZERO, -1.5));
}
