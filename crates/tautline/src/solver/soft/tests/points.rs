use super::*;
use crate::simd::Kernel;
use crate::solver::soft::tests::{noise3, on_all};

const PLACES: usize = 24;

struct Integrate<'a>(&'a Points, SmallStep, usize);

impl Kernel for Integrate<'_> {
    type Output = (Points, f32);

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let (mut points, mut fastest) = (self.0.clone(), 0.0);
        for _ in 0..self.2 {
            fastest = points.integrate::<L>(0..PLACES, self.1);
        }
        (points, fastest)
    }
}

fn falling() -> Points {
    let mut points = Points::default();
    points.reset(PLACES);
    for place in (0..PLACES).filter(|place| place % 6 != 5) {
        points.put(place, noise3(place), Vec3::ZERO);
        points.set_motion(place, noise3(place + 100) * 1e-3);
        points.inverse_mass[place] = if place % 6 == 0 { 0.0 } else { 1.0 };
        points.presence[place] = 1.0;
    }
    points
}

fn step(limit: f32) -> SmallStep {
    let calming = Calming { share: 0.0, lively: 1.0 };
    SmallStep { keep: 1.0, fall: Vec3::new(0.0, -1e-5, 2e-6), limit, calming }
}

/// After n steps with the displacement d and what gravity adds, g: n d + g n (n + 1)/2.
#[test]
fn particles_fall_on_parabolas() {
    let start = falling();
    let (points, fastest) = on_all(|| Integrate(&start, step(1.0), 100));
    let mut most = 0.0_f32;
    for place in 0..PLACES {
        let (moved, d) = (points.at(place) - start.at(place), start.motion(place));
        let is_free = start.inverse_mass[place] > 0.0;
        let expected = if is_free { d * 100.0 + step(1.0).fall * 5050.0 } else { Vec3::ZERO };
        assert!(moved.distance(expected) < 5e-6, "{place}: {moved} instead of {expected}");
        let motion = if is_free { d + step(1.0).fall * 100.0 } else { Vec3::ZERO };
        assert!(points.motion(place).distance(motion) < 1e-8);
        most = most.max(motion.length());
    }
    assert!((fastest - most).abs() < 1e-8);
}

#[test]
fn none_goes_further_than_the_limit_and_all_keep_their_direction() {
    let start = falling();
    let (points, fastest) = on_all(|| Integrate(&start, step(5e-4), 1));
    let mut limited = 0;
    for place in (0..PLACES).filter(|&place| start.inverse_mass[place] > 0.0) {
        let wanted = start.motion(place) + step(1.0).fall;
        let expected = wanted.clamp_length_max(5e-4);
        limited += usize::from(wanted.length() > 5e-4);
        assert!(points.motion(place).distance(expected) < 1e-9);
    }
    assert!(limited > 5 && (fastest - 5e-4).abs() < 1e-9);
}

/// What constraints did becomes motion, a part of it is lost, forces add to it; what is at rest is calmed, what is lively
/// is not.
#[test]
fn shifts_become_motion() {
    let (before, mut start) = (falling(), falling());
    for place in 0..PLACES {
        start.shift(place, noise3(place + 200) * 1e-3);
        start.carry(place, noise3(place + 300) * 1e-2);
    }
    for (axis, kick) in start.kick.iter_mut().enumerate() {
        *kick = (0..start.inverse_mass.len()).map(|place| noise3(place + 400)[axis] * 1e-4).collect();
    }
    let calming = Calming { share: 0.25, lively: 1e-3 };
    let given = SmallStep { keep: 0.5, calming, ..step(1.0) };
    let (points, _) = on_all(|| Integrate(&start, given, 1));
    for place in (0..PLACES).filter(|&place| start.inverse_mass[place] > 0.0) {
        let moved = before.motion(place) + noise3(place + 200) * 1e-3;
        let motion = moved * 0.5 + given.fall + noise3(place + 400) * 1e-4;
        let lost = 0.25 * (1.0 - motion.length() / 1e-3).max(0.0);
        assert!(points.motion(place).distance(motion * (1.0 - lost)) < 1e-9, "{place}");
    }
}

#[test]
fn a_led_particle_moves_as_told() {
    let start = falling();
    let (mut points, _) = on_all(|| Integrate(&start, step(1.0), 1));
    let motion = Vec3::new(0.25, 0.0, -0.5);
    points.lead(0, motion);
    assert!(points.at(0).distance(start.at(0) + motion) < 1e-7);
    assert_eq!(points.motion(0), motion);
}

/// 100 m from the origin, numbers are 8 µm apart.
#[test]
fn what_is_slow_and_far_from_the_origin_moves_on() {
    let mut start = falling();
    let (place, from, motion) = (1, Vec3::splat(100.0), Vec3::new(1e-6, -2e-7, 3e-8));
    start.put(place, from, motion);
    let still = SmallStep { fall: Vec3::ZERO, ..step(1.0) };
    let (points, _) = on_all(|| Integrate(&start, still, 1000));
    assert!((points.at(place) - from).distance(motion * 1000.0) < 1e-5);
    assert!(points.motion(place).distance(motion) < 1e-11);
}
