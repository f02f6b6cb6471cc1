use super::*;

/// The root solves the equation, from gas that a step hardly moves to gas that it moves far.
#[test]
fn the_volume_after_a_push_is_that_of_its_pressure() {
    for (volume, give) in [(0.5, 1e-12), (0.45, 1e-7), (0.6, 1e-2), (1e-3, 1.0), (0.5, 1e4)] {
        let after = volume_after(volume, give);
        assert!(after > volume && (after - volume - give / after).abs() < 1e-14 * after, "{after}");
    }
}
