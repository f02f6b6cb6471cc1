//! Every instruction set gives the same bits, and any memory is safe.

use glam::Vec3;

use super::distances::{place, zoo};
use super::shapes::*;
use super::*;

#[test]
fn all_instruction_sets_give_the_same_bits() {
    let (zoo, mut random) = (zoo(), Random(41));
    for a in &zoo {
        for b in &zoo {
            let gap = random.between(-0.1, 0.03);
            let b_in_a = place(&mut random, a, b, gap);
            let results = [Instructions::Scalar, Instructions::Baseline, Instructions::Widest].map(|set| {
                let mut memory = Memory::default();
                let mut manifolds = Vec::new();
                for call in 0..3 {
                    let step = Vec3::splat(call as f32 * 1e-4);
                    let b_in_a = Placement { translation: b_in_a.translation + step, ..b_in_a };
                    let kernel = Collide { a, b, b_in_a: &b_in_a, memory: &mut memory, margin: 0.02 };
                    manifolds.push(run(set, kernel));
                }
                format!("{manifolds:?} {memory:?}")
            });
            assert_eq!(results[1], results[0]);
            assert_eq!(results[2], results[0]);
        }
    }
}

#[test]
fn foreign_and_broken_memory_costs_time_only() {
    let zoo = zoo();
    let cube = cuboid(Vec3::splat(0.5));
    let broken = [
        Memory { axis: Vec3::NAN, ..Memory::default() },
        Memory { axis: Vec3::splat(1e30), ..Memory::default() },
        Memory { axis: Vec3::X, pairs: [[u16::MAX - 1; 2]; 3] },
        Memory { axis: Vec3::X, pairs: [NO_CORNERS, [0; 2], [u16::MAX - 1; 2]] },
        Memory { axis: Vec3::X, pairs: [[0; 2]; 3] },
    ];
    let mut random = Random(42);
    for a in &zoo {
        let b_in_a = place(&mut random, a, &cube, 0.01);
        let expected = collide_new(a, &cube, &b_in_a, 0.1);
        for mut memory in broken {
            let manifold = collide_with(a, &cube, &b_in_a, &mut memory, 0.1);
            assert!((manifold.deepest() - expected.deepest()).abs() < 2e-3, "{manifold:?} {expected:?}");
        }
    }
    let nowhere = Placement { translation: Vec3::NAN, ..place(&mut random, &cube, &cube, 0.0) };
    assert_eq!(collide_new(&cube, &cube, &nowhere, 0.1).count, 0);
}

#[test]
fn memory_is_small() {
    assert!(size_of::<Memory>() <= 24);
}
