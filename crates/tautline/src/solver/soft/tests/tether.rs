use glam::Vec3;

use super::*;
use crate::simd::Kernel;
use crate::solver::soft::tests::{noise, noise3, on_all};

/// Sticks of some length between some of 40 particles; the last five hang on nothing.
fn net() -> Vec<Stick> {
    let stick = |k: usize| {
        let number = |k: usize| ((noise(k) + 1.0) * 17.49) as u32;
        Stick { a: number(2 * k), b: number(2 * k + 1), rest_length: 0.3 + 0.2 * noise(k + 1000) }
    };
    (0..70).map(stick).filter(|stick| stick.a != stick.b).collect()
}

#[test]
fn distances_are_those_of_the_shortest_ways() {
    let sticks = net();
    for from in [0, 7, 34, 39] {
        // Bellman and Ford.
        let mut expected = [f64::INFINITY; 40];
        expected[from as usize] = 0.0;
        for _ in 0..40 {
            for stick in &sticks {
                let (a, b, length) = (stick.a as usize, stick.b as usize, f64::from(stick.rest_length));
                expected[a] = expected[a].min(expected[b] + length);
                expected[b] = expected[b].min(expected[a] + length);
            }
        }
        for (found, expected) in distances_along(&sticks, 40, from).into_iter().zip(expected) {
            let found = f64::from(found);
            assert!(found == expected || (found - expected).abs() < 1e-5, "{found} instead of {expected}");
        }
    }
    assert!(distances_along(&sticks, 40, 0)[39].is_infinite());
}

struct Tighten<'a>(&'a Tethers, &'a Points);

impl Kernel for Tighten<'_> {
    type Output = Points;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Points {
        let mut points = self.1.clone();
        self.0.tighten::<L>(&mut points);
        points
    }
}

/// Particles around a held one: those too far off come in along the line to it, no others move.
#[test]
fn what_is_too_far_off_is_drawn_in_straight() {
    let (count, held) = (21, 13);
    let mut points = Points::default();
    points.reset(32);
    for particle in 0..count {
        points.put(8 + particle, noise3(particle), Vec3::ZERO);
        points.inverse_mass[8 + particle] = if particle == held { 0.0 } else { 1.0 };
    }
    let length = |particle: usize| if particle == held { 0.0 } else { 0.9 + 0.4 * noise(particle + 50) };
    let distances = |_| (0..count).map(length).collect();
    let tethers = Tethers::new(&[held as u32], count, distances, |particle| 8 + particle);
    let tight = on_all(|| Tighten(&tethers, &points));
    let (from, mut drawn) = (points.at(8 + held), 0);
    for place in 0..points.inverse_mass.len() {
        let (before, after) = (points.at(place), tight.at(place));
        let particle = place.wrapping_sub(8);
        let is_taut = particle < count && before.distance(from) > length(particle) && particle != held;
        if is_taut {
            drawn += 1;
            let expected = from + (before - from).normalize() * length(particle);
            assert!(after.distance(expected) < 1e-6, "{after} instead of {expected}");
        } else {
            assert_eq!(after, before, "particle {particle} has moved");
        }
    }
    assert!((5..18).contains(&drawn), "{drawn} are drawn in");
}

/// Each is tied to the four nearest held ones, nearest first, those of lower number before others as near.
#[test]
fn particles_are_tied_to_the_four_nearest_held() {
    let held = [0_u32, 3, 5, 8, 9];
    let distances = |from: u32| (0..10).map(|k: u32| k.abs_diff(from) as f32).collect();
    let tethers = Tethers::new(&held, 10, distances, |particle| particle);
    let tied = |particle: usize| -> Vec<(u32, f32)> {
        let own = |tied: &&Tied| tied.place as usize == particle / LANES * LANES;
        let lane = particle % LANES;
        let entry = |tied: &Tied| (tied.held[lane], tied.length.0[lane]);
        tethers.tied.iter().filter(own).map(entry).filter(|entry| entry.1 < 1e9).collect()
    };
    assert_eq!(tied(4), [(3, 1.0), (5, 1.0), (0, 4.0), (8, 4.0)]);
    assert_eq!(tied(7), [(8, 1.0), (5, 2.0), (9, 2.0), (3, 4.0)]);
    assert_eq!(tied(9), [(8, 1.0), (5, 4.0), (3, 6.0), (0, 9.0)]);
}
