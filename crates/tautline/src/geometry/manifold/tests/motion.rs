//! Pairs that move little by little, with memory, at any size and far from the origin.

use glam::{Quat, Vec3};

use super::distances::{place, zoo};
use super::oracle::{separation, signed_distance};
use super::shapes::*;
use super::*;

fn scaled(convex: &Convex, factor: f32, offset: Vec3) -> Convex {
    let faces = convex
        .faces
        .iter()
        .map(|&face| Face { offset: face.offset * factor + face.normal.dot(offset), ..face });
    let vertices = convex.vertices.iter().map(|&v| v * factor + offset).collect();
    Convex::new(vertices, faces.collect(), convex.loops.clone(), convex.radius * factor)
}

/// The largest error of the separation along the remembered axis, and of the deepest point, as parts of the size, of
/// pairs at most about 2 % apart or deep that turn and slide.
fn errors(factor: f32, offset: Vec3) -> (f64, f64) {
    let (zoo, mut random) = (zoo(), Random(51));
    let (mut of_axis, mut of_point) = (0.0_f64, 0.0_f64);
    for (i, a) in zoo.iter().enumerate() {
        for b in &zoo[i..] {
            let start = place(&mut random, a, b, 0.01);
            let (a, b) = (scaled(a, factor, offset), scaled(b, factor, offset));
            let (turn, slide) = (random.vector() * 0.01, random.vector() * 0.002);
            let mut memory = Memory::default();
            for step in 0..20 {
                let rotation = Quat::from_scaled_axis(turn * step as f32) * Quat::from_mat3(&start.rotation);
                let center = (start.translation + slide * step as f32) * factor;
                let b_in_a = placed(rotation, center + offset - rotation * offset);
                let expected = signed_distance(&a, &b, &b_in_a) / f64::from(factor);
                let manifold = collide_with(&a, &b, &b_in_a, &mut memory, 0.02 * factor);
                let along = separation(&a, &b, &b_in_a, memory.axis) / f64::from(factor);
                if expected.abs() < 0.02 && along < 0.02 {
                    of_axis = of_axis.max((along - expected).abs());
                    let deepest = f64::from(manifold.deepest() / factor);
                    of_point = of_point.max((deepest - expected).abs());
                }
            }
        }
    }
    (of_axis, of_point)
}

// A remembered face may be a little off the direction of the distance; the deepest point is right all the same.
#[test]
fn motion_is_followed_at_any_size_and_place() {
    for (factor, offset) in
        [(1.0, Vec3::ZERO), (0.01, Vec3::ZERO), (100.0, Vec3::ZERO), (1.0, Vec3::new(30.0, -20.0, 10.0))]
    {
        let (of_axis, of_point) = errors(factor, offset);
        assert!(of_axis < 4e-3 && of_point < 6e-4, "{factor} {offset}: {of_axis} {of_point}");
    }
}
