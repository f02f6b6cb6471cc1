//! Cloth that falls and folds is free of itself at the end, and nearly so all the way; the short form. The long one is
//! `cargo bench -p tautline-scene --bench cloth_trials`.

use tautline::Settings;
use tautline_scene::cloth_trials::Trial;

const N: u32 = 20;
const SEEDS: std::ops::Range<u64> = 0..3;

fn check(trial: Trial) {
    for seed in SEEDS {
        let found = trial.run(N, seed, Settings::default()).unwrap();
        assert!(found.at_end == 0 && found.worst <= 2, "{}, seed {seed}: {found:?}", trial.name());
        assert!(found.mean_speed < 0.1, "{}, seed {seed}: {found:?}", trial.name());
    }
}

/// It rolled up, and rolled away over the floor, faster and faster.
#[test]
fn a_roll_of_cloth_lies_still() {
    let found = Trial::Heap.run(N, 8, Settings::default()).unwrap();
    assert!(found.mean_speed < 0.01, "{found:?}");
}

/// Its corner was carried down into a fold, and it flew about for ever, tangled.
#[test]
fn a_fold_that_a_corner_is_carried_into_does_not_blow_up() {
    let found = Trial::Fold.run(40, 1, Settings::default()).unwrap();
    assert!(found.at_end == 0 && found.mean_speed < 0.01, "{found:?}");
}

#[test]
fn on_a_cube() {
    check(Trial::Cube);
}

#[test]
fn in_a_heap() {
    check(Trial::Heap);
}

#[test]
fn folded() {
    check(Trial::Fold);
}

#[test]
fn settled() {
    check(Trial::Settle);
}

#[test]
fn two_of_them() {
    check(Trial::Pair);
}
