//! Points lie on the surfaces, and the mirrored pair gives the mirrored manifold.

use glam::{Quat, Vec3};

use super::distances::{place, zoo};
use super::oracle::{separation, signed_distance};
use super::shapes::*;
use super::*;

/// How far a point of a body's own frame is outside its surface.
fn height(convex: &Convex, point: Vec3) -> f64 {
    signed_distance(convex, &ball(0.0), &placed(Quat::IDENTITY, point))
}

fn check(a: &Convex, b: &Convex, b_in_a: &Placement, margin: f32) -> Result<(), String> {
    let manifold = collide_new(a, b, b_in_a, margin);
    let expected = signed_distance(a, b, b_in_a);
    if (manifold.count == 0) != (expected > f64::from(margin)) {
        return Err(format!("{} points at {expected}", manifold.count));
    }
    let along = separation(a, b, b_in_a, manifold.normal);
    // The nearest points are among them, or are of an axis at most 3° off.
    if manifold.count > 0 && (f64::from(manifold.deepest()) - expected).abs() > 0.012 {
        return Err(format!("the deepest of {manifold:?}, expected {expected}, along the normal {along}"));
    }
    let mut keys = manifold.keys();
    keys.dedup();
    if keys.len() != manifold.count {
        return Err(format!("keys {keys:?}"));
    }
    for point in manifold.used() {
        let apart = b_in_a.point(point.on_b) - point.on_a;
        if (apart - manifold.normal * point.separation).length() > 2e-6 {
            return Err(format!("{apart} is not {} along {}", point.separation, manifold.normal));
        }
        if point.separation > margin {
            return Err(format!("{} is beyond the margin", point.separation));
        }
        // A rounded edge at an angle to the normal counts with its core: the surface is a little further out there.
        let core_a = point.on_a - manifold.normal * a.radius;
        let core_b = b_in_a.point(point.on_b) + manifold.normal * b.radius;
        let heights = [
            height(a, core_a) + f64::from(a.radius),
            height(b, b_in_a.point_inside(core_b)) + f64::from(b.radius),
        ];
        // The nearest points of an axis off the face's, when they stand beside those of the face.
        let off_axis = 0.055 * f64::from(point.separation.abs() + a.radius + b.radius);
        if heights.iter().any(|height| height.abs() > 1e-4 + off_axis) {
            return Err(format!("{heights:?} off the surfaces, of {manifold:?}"));
        }
    }
    Ok(())
}

#[test]
fn points_lie_on_both_surfaces_apart_along_the_normal() {
    let (zoo, mut random) = (zoo(), Random(2));
    let mut failures = Vec::new();
    for (i, a) in zoo.iter().enumerate() {
        for (j, b) in zoo.iter().enumerate() {
            for gap in [-0.1, -0.01, -0.001, 0.0, 0.001, 0.01, 0.019, 0.021, 0.1] {
                for _ in 0..2 {
                    let placement = place(&mut random, a, b, gap);
                    if let Err(problem) = check(a, b, &placement, 0.02) {
                        failures.push(format!("{i} {j} at {gap}: {problem}"));
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}:\n{}", failures.len(), failures[..failures.len().min(30)].join("\n"));
}

#[test]
fn the_mirrored_pair_has_the_mirrored_manifold() {
    let (zoo, mut random) = (zoo(), Random(3));
    for a in &zoo {
        for b in &zoo {
            for gap in [-0.05, -0.001, 0.0, 0.005, 0.1] {
                let b_in_a = place(&mut random, a, b, gap);
                let a_in_b = inverse(&b_in_a);
                let (forth, back) = (collide_new(a, b, &b_in_a, 1.0), collide_new(b, a, &a_in_b, 1.0));
                assert!((forth.deepest() - back.deepest()).abs() < 2e-3, "{forth:?} {back:?}");
                if gap > 0.0 {
                    // Where both bodies have a face near the normal, it is of one or the other.
                    let turned = -(b_in_a.rotation * back.normal);
                    assert!(forth.normal.dot(turned) > 0.9985, "{forth:?} {back:?}");
                }
            }
        }
    }
}
