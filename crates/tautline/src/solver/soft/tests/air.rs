use super::*;

/// F = ½ ρ C A |n·u| u, and across it ½ ρ C A (n·u)|u|(n − û (n·û)), of an area with its normal at 30° to the wind.
#[test]
fn an_area_feels_the_air_by_its_angle() {
    let (sine, cosine) = (0.5_f32, 0.75_f32.sqrt());
    for side in [1.0, -1.0] {
        let (front, lift) = exposure(Vec3::new(sine, cosine, 0.0) * side, 2.0, Vec3::X * 3.0);
        assert!((front - 2.0 * 3.0 * sine).abs() < 1e-6);
        let expected = Vec3::Y * (2.0 * 9.0 * sine * cosine);
        assert!(lift.distance(expected) < 1e-5, "{lift} instead of {expected}, on either side");
    }
}

#[test]
fn drag_slows_and_never_turns_round_and_lift_only_turns() {
    let against = Vec3::new(0.3, -0.1, 0.2);
    for slowed in [0.0, 1e-3, 1.0, 1e6] {
        let left = against - change(against, slowed, Vec3::ZERO);
        assert!(left.distance(against / (1.0 + slowed)) < 1e-6);
        for push in [1e-3, 0.5, 1e4] {
            let turned = against - change(against, slowed, against.any_orthonormal_vector() * push);
            assert!((turned.length() - left.length()).abs() < 1e-6, "{turned} and {left}");
            assert!(turned.dot(against) > 0.0, "it is not blown back");
        }
    }
}
