//! Normals and depths.

use glam::{Quat, Vec3};

use super::oracle::{separation, signed_distance};
use super::shapes::*;
use super::*;

/// One of each, about a metre in size.
pub(super) fn zoo() -> Vec<Convex> {
    let mut random = Random(7);
    vec![
        cuboid(Vec3::splat(0.5)),
        cuboid(Vec3::new(0.7, 0.007, 0.7)),
        cuboid(Vec3::new(0.05, 1.5, 0.05)),
        icosahedron(0.6),
        tetrahedron(0.4),
        random_hull(&mut random, 10),
        random_hull(&mut random, 30),
        prism(16, 0.4, 0.3),
        ball(0.5),
        ball(0.02),
        capsule(0.2, 0.4),
        capsule(0.05, 1.0),
        triangle([Vec3::new(0.5, 0.1, 0.0), Vec3::new(-0.4, 0.3, 0.2), Vec3::new(0.0, -0.6, 0.1)]),
    ]
}

/// A placement at which B is `gap` away, along a random direction from where the centres meet; if they are less deep
/// in each other there, they meet.
pub(super) fn place(random: &mut Random, a: &Convex, b: &Convex, gap: f32) -> Placement {
    let rotation = random.rotation();
    let direction = random.direction();
    let (mut near, mut far) = (0.0, 4.0);
    for _ in 0..26 {
        let middle = 0.5 * (near + far);
        let is_near = signed_distance(a, b, &placed(rotation, direction * middle)) < f64::from(gap);
        (near, far) = if is_near { (middle, far) } else { (near, middle) };
    }
    placed(rotation, direction * near)
}

/// What must hold of any manifold: the normal separates, and nothing is missed. `exact`: the depth must be the least.
fn check(a: &Convex, b: &Convex, b_in_a: &Placement, memory: &mut Memory, exact: bool) -> Result<(), String> {
    let expected = signed_distance(a, b, b_in_a);
    let margin = 10.0;
    let manifold = collide_with(a, b, b_in_a, memory, margin);
    if manifold.count == 0 {
        return Err(format!("nothing found, expected {expected}"));
    }
    if (manifold.normal.length() - 1.0).abs() > 1e-5 {
        return Err(format!("normal {}", manifold.normal));
    }
    let along = separation(a, b, b_in_a, memory.axis);
    // Remembered faces may be a little off the direction of the distance, and remembered ways out a little longer.
    let tolerance = match (exact, expected > 0.005) {
        (true, true) => 2e-5,
        (true, false) | (false, true) => 2e-3,
        (false, false) => 0.04,
    };
    if (along - expected).abs() > tolerance {
        return Err(format!("separation {along}, expected {expected}"));
    }
    Ok(())
}

fn check_all(gaps: &[f32], stale: bool) {
    let (zoo, mut random) = (zoo(), Random(1));
    let mut failures = Vec::new();
    let mut count = 0;
    for (i, a) in zoo.iter().enumerate() {
        for (j, b) in zoo.iter().enumerate() {
            for &gap in gaps {
                for _ in 0..4 {
                    let placement = place(&mut random, a, b, gap);
                    let mut memory = Memory::default();
                    if stale {
                        let gap = random.between(-0.1, 0.1);
                        let other = place(&mut random, a, b, gap);
                        collide_with(a, b, &other, &mut memory, 10.0);
                    }
                    count += 1;
                    if let Err(problem) = check(a, b, &placement, &mut memory, !stale) {
                        failures.push(format!("{i} {j} at {gap}: {problem}"));
                    }
                }
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} of {count}:\n{}",
        failures.len(),
        failures[..failures.len().min(40)].join("\n")
    );
}

#[test]
fn separations_and_depths_are_those_of_brute_force() {
    check_all(&[-0.3, -0.1, -0.03, -0.01, -0.001, 0.0, 1e-4, 0.001, 0.01, 0.1, 0.3], false);
}

#[test]
fn stale_memory_leads_to_a_way_out_about_as_short() {
    check_all(&[-0.3, -0.1, -0.03, -0.01, -0.001, 0.0, 1e-4, 0.001, 0.01, 0.1, 0.3], true);
}

#[test]
fn coincident_bodies_have_a_normal() {
    for a in zoo() {
        let manifold = collide_new(&a, &a, &placed(Quat::IDENTITY, Vec3::ZERO), 1e-6);
        assert!(manifold.count > 0 && (manifold.normal.length() - 1.0).abs() < 1e-5);
    }
}
