//! The signed distance of convex sets against brute force, and what its answer promises about itself.

mod cases;
mod exact;
mod features;
mod table;

use cases::{CASES, Random, moved, solid};
use tautline::geometry::distance::{Distance, contact, distance};
use tautline::geometry::epa::Epa;
use tautline::geometry::gjk::{self, Proximity};
use tautline::geometry::support::Points;
use tautline::{Error, Vec3};

use table::{broken_promise, scale};

/// A set and itself have no mirror image to compare with.
#[test]
fn swapping_the_sets_mirrors_every_bit() {
    for (case, (name, generate)) in CASES.into_iter().enumerate() {
        let mut random = Random(100 + case as u64);
        for (a, b) in (0..50).map(|_| generate(&mut random)).filter(|(a, b)| a != b) {
            let (there, back) = (distance(&a, &b).unwrap(), distance(&b, &a).unwrap());
            let mirrored = Distance {
                normal: -back.normal,
                point_a: back.point_b,
                point_b: back.point_a,
                feature_a: back.feature_b,
                feature_b: back.feature_a,
                ..back
            };
            // The debug form tells −0 from 0.
            assert_eq!(format!("{there:?}"), format!("{mirrored:?}"), "{name}");
        }
    }
}

#[test]
fn contact_agrees_with_distance() {
    let mut epa = Epa::default();
    for (case, (name, generate)) in CASES.into_iter().enumerate() {
        let mut random = Random(200 + case as u64);
        for _ in 0..200 {
            let (a, b) = generate(&mut random);
            let found = distance(&a, &b).unwrap();
            let mut axis = Vec3::ZERO;
            let contact = contact(&Points(&a), &Points(&b), &mut axis, &mut epa);
            assert!(contact.converged && contact.iterations <= 64, "{name}: {contact:?}");
            match contact.features {
                None => assert!(found.distance > -1e-7, "{name}: {found:?}"),
                Some(features) => {
                    let apart = f64::from(features.depth + found.distance) / scale(&(a, b));
                    assert!(apart.abs() < 1e-6 && found.distance < 1e-6, "{name}: {features:?} {found:?}");
                }
            }
        }
    }
}

#[test]
fn the_cached_axis_settles_the_next_frame_at_once() {
    let mut random = Random(7);
    let (mut cold, mut cached, mut pairs) = (0, 0, 0);
    while pairs < 1000 {
        let (a, b) = (solid(&mut random), moved(solid(&mut random), random.point(2.0)));
        let mut axis = Vec3::ZERO;
        let first = gjk::intersect(&Points(&a), &Points(&b), &mut axis);
        if first.proximity == Proximity::Separated {
            let next = moved(b, random.point(0.002));
            let second = gjk::intersect(&Points(&a), &Points(&next), &mut axis);
            cold += first.iterations;
            cached += second.iterations;
            pairs += 1;
        }
    }
    assert!(cached * 100 < 105 * pairs, "{cached} iterations for {pairs} pairs");
    assert!(cold > 2 * pairs, "{cold} iterations without a cache");
}

#[test]
fn a_stale_or_broken_axis_changes_nothing() {
    let mut random = Random(8);
    let mut epa = Epa::default();
    for _ in 0..500 {
        let (a, b) = (solid(&mut random), moved(solid(&mut random), random.point(1.0)));
        let depth = |axis: Vec3, epa: &mut Epa| {
            let mut axis = axis;
            contact(&Points(&a), &Points(&b), &mut axis, epa).features.map(|features| features.depth)
        };
        let expected = depth(Vec3::ZERO, &mut epa);
        for axis in [Vec3::NAN, Vec3::INFINITY, random.point(1e38), random.point(1e-40), random.point(1.0)] {
            match (depth(axis, &mut epa), expected) {
                (Some(found), Some(expected)) => assert!((found - expected).abs() < 1e-6, "{axis}"),
                (found, expected) => assert_eq!(found, expected, "{axis}"),
            }
        }
    }
}

#[test]
fn coordinates_of_any_size_give_finite_answers() {
    let sizes = [f32::MAX, 1e30, 1.0, 1e-30, f32::MIN_POSITIVE, 1e-45, 0.0];
    let mut random = Random(9);
    for (size, other) in sizes.into_iter().flat_map(|size| sizes.map(|other| (size, other))) {
        for _ in 0..20 {
            let [a, b] = [size, other].map(|by| (0..6).map(|_| random.point(1.0) * by).collect::<Vec<_>>());
            let found = distance(&a, &b).unwrap();
            assert!(found.distance.is_finite() && found.point_a.is_finite() && found.point_b.is_finite());
            assert!((found.normal.length() - 1.0).abs() < 1e-5 && found.iterations <= 64, "{found:?}");
        }
    }
}

/// The origin lies so near an edge of A ⊖ B, for its size, that rounding puts it under no face.
#[test]
fn sets_that_are_deep_in_each_other_do_not_just_touch_whatever_their_sizes() {
    let a = [
        Vec3::new(1000.0, 1.5777218e-30, 1.7509618e-30),
        Vec3::new(1.096e-42, 0.0, 1.7509592e-30),
        Vec3::new(1.7509618e-30, 1.7509618e-30, 1100.0),
        Vec3::new(2.1743272e10, 1.3979697e10, 1.3979697e10),
        Vec3::new(1.24895894e33, 1.24971455e33, 1.24971455e33),
        Vec3::new(1.24971455e33, 1.24971455e33, 1.24971455e33),
        Vec3::new(1.24971455e33, 50.1, 1100.001),
        Vec3::new(1.0161487e33, 6.089953e-39, -1.9187476e33),
    ];
    let b = [
        Vec3::new(-3.9133117e31, 2.2959e-41, -4.2618373e37),
        Vec3::new(-131072.0, 2.3700494e-30, 2.2903477e23),
        Vec3::new(0.0029641031, 6.294144e-39, 2.2936682e23),
        Vec3::new(1.6851347e-16, 2.3203006e23, 2.2936865e23),
        Vec3::new(0.0029645204, 2.2959e-41, 1.6617473e35),
        Vec3::new(9.5e-44, 0.0, 1032.0),
        Vec3::new(50.0, -1.601611e-38, 1.3323083e7),
    ];
    let found = distance(&a, &b).unwrap();
    let normal = found.normal.as_dvec3();
    let highest = a.iter().map(|p| p.as_dvec3().dot(normal)).fold(f64::NEG_INFINITY, f64::max);
    let lowest = b.iter().map(|p| p.as_dvec3().dot(normal)).fold(f64::INFINITY, f64::min);
    assert!(
        f64::from(found.distance) - (lowest - highest) <= 1e-6 * 4.3e37,
        "{found:?}: {lowest} over {highest}"
    );
}

/// Two concentric balls: every face of A ⊖ B is about as near as any other, the worst there is for EPA.
#[test]
fn many_points_end_in_time_and_own_up_to_it() {
    let ball = |count: usize, reach: f32| -> Vec<Vec3> {
        let mut random = Random(count as u64);
        (0..count).map(|_| random.point(1.0).normalize() * reach).collect()
    };
    for (count, apart) in [(100, 0.0), (100, 1.0), (400, 0.0), (400, 0.5), (400, 1.9)] {
        let pair = (ball(count, 1.0), moved(ball(count + 1, 1.0), Vec3::new(0.48, 0.6, 0.64) * apart));
        let found = distance(&pair.0, &pair.1).unwrap();
        let depth = -found.distance;
        println!("{count} points, {apart} apart: {depth} in {}, {}", found.iterations, found.converged);
        assert!(found.iterations <= 64);
        assert!(broken_promise(&pair, &found) < 1e-6, "{found:?}");
        assert!(f64::from(found.distance + 2.0 - apart).abs() < 0.3, "{found:?}");
    }
}

#[test]
fn bad_input_is_refused_by_name() {
    let good = [Vec3::ZERO, Vec3::X];
    let refusal = |a: &[Vec3], b: &[Vec3]| match distance(a, b) {
        Err(Error::OutOfRange { field, .. } | Error::Invalid { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    assert_eq!(refusal(&[], &good), "a");
    assert_eq!(refusal(&good, &[]), "b");
    assert_eq!(refusal(&good, &[Vec3::new(0.0, f32::NAN, 0.0)]), "b[0]");
    assert_eq!(refusal(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z * f32::NEG_INFINITY], &good), "a[3]");
}
