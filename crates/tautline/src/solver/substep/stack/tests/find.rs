//! What counts as a stack, on pairs that are made by hand.

use glam::Vec3;

use super::super::super::crew::{Crew, Timing};
use super::super::super::group::Groups;
use super::super::super::held::{Held, HeldPoint, MOST_POINTS};
use super::super::super::lineup::{Entry, Lineup, NOBODY, Role};
use super::super::super::pairs::{Key, Pairs};
use super::super::{Found, find};
use crate::body::Touch;
use crate::simd::{Instructions, Row};

const FRICTION: f32 = 0.5;

/// Bodies of 1 kg at rest, and pairs of them that touch from above and below, without a load yet.
struct Scene {
    lineup: Lineup,
    crew: Crew,
    pairs: Pairs,
    timing: Timing,
    assembly_of: Vec<u32>,
}

impl Scene {
    /// Pairs are (lower, upper) or (body, floor), ascending; the floor is the body behind the others.
    fn new(count: u32, pairs: &[[u32; 2]]) -> Self {
        let entry = |body: u32| Entry { body, role: Role::Free, center: Vec3::Y * body as f32 };
        let lineup = Lineup::new((0..count).map(entry).collect(), count as usize + 1);
        let mut crew = Crew::new(&lineup, &[]);
        for body in 0..count {
            crew.velocities[lineup.place_of[body as usize] as usize].0[3] = 1.0;
        }
        let keys: Vec<Key> = pairs.iter().map(|&[a, b]| Key { a, b, part_a: 0, part_b: 0 }).collect();
        let mut pairs = Pairs::default();
        pairs.replace(&keys, &mut Pairs::default());
        let touch = Touch { friction: FRICTION, ..Touch::default() };
        for (pair, detail) in pairs.pairs.iter_mut().zip(&mut pairs.details) {
            pair.points = 1;
            let point = HeldPoint::new(Vec3::ZERO, Vec3::ZERO, 0);
            detail.held = Some(Held::new(Vec3::Y, touch, &[point]));
        }
        let timing = Timing {
            h: 1.0 / 480.0,
            substeps: 8.0,
            gravity: Vec3::NEG_Y * 9.81,
            damping: 0.0,
            margin: 0.005,
            instructions: Instructions::default(),
        };
        let assembly_of = vec![NOBODY; lineup.solved];
        Self { lineup, crew, pairs, timing, assembly_of }
    }

    /// Bodies on each other, the lowest on the floor.
    fn tower(count: u32) -> Self {
        Self::new(count, &tower(0..count, count))
    }

    /// Gives every contact a load, and friction that is this share of the greatest.
    fn loaded(mut self, share: f32) -> Self {
        for held in self.pairs.details.iter_mut().filter_map(|detail| detail.held.as_mut()) {
            let pull = share * FRICTION;
            for i in 0..MOST_POINTS / 2 {
                held.keep_two(i, [1.0; 2].into_iter(), Row([0.0, 0.0, pull, 0.0, 0.0, 0.0, pull, 0.0]));
            }
        }
        self
    }

    fn with_mass(mut self, body: u32, mass: f32) -> Self {
        let place = self.place(body);
        self.crew.velocities[place].0[3] = 1.0 / mass;
        self
    }

    /// In m/s.
    fn with_velocity(mut self, body: u32, velocity: Vec3) -> Self {
        let place = self.place(body);
        self.crew.velocities[place].0[..3].copy_from_slice(&(velocity * self.timing.h).to_array());
        self
    }

    fn place(&self, body: u32) -> usize {
        self.lineup.place_of[body as usize] as usize
    }

    fn find(&self) -> Vec<Found> {
        let mut groups = Groups::new(&self.lineup);
        groups.sort_in(&self.pairs, &self.lineup);
        find((&groups, &self.pairs), (&self.lineup, &self.crew, &self.timing), &self.assembly_of)
    }

    /// How many bodies the stacks have.
    fn sizes(&self) -> Vec<usize> {
        self.find().iter().map(|found| found.places.len()).collect()
    }
}

/// The pairs of a tower of these bodies.
fn tower(bodies: std::ops::Range<u32>, floor: u32) -> Vec<[u32; 2]> {
    let mut pairs = vec![[bodies.start, floor]];
    pairs.extend(bodies.clone().zip(bodies.skip(1)).map(|(lower, upper)| [lower, upper]));
    pairs.sort_unstable();
    pairs
}

#[test]
fn four_bodies_on_each_other_are_a_stack_and_three_that_rest_are_not() {
    let found = Scene::tower(4).loaded(0.0).find();
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].places.len(), 4);
    assert_eq!(found[0].pairs, [0, 1, 2, 3]);
    assert!(Scene::tower(3).loaded(0.0).find().is_empty());
}

#[test]
fn a_body_on_one_four_times_lighter_is_a_stack() {
    assert_eq!(Scene::tower(2).loaded(0.0).with_mass(1, 4.0).sizes(), [2]);
    assert!(Scene::tower(2).loaded(0.0).with_mass(1, 3.9).find().is_empty());
}

#[test]
fn few_bodies_are_a_stack_while_nothing_bears_them_or_when_they_are_about_to_slide() {
    assert_eq!(Scene::tower(1).sizes(), [1]);
    assert_eq!(Scene::tower(1).loaded(0.6).sizes(), [1]);
    assert!(Scene::tower(1).loaded(0.4).find().is_empty());
}

#[test]
fn a_heap_of_more_than_sixty_four_is_none() {
    assert_eq!(Scene::tower(64).loaded(0.0).sizes(), [64]);
    assert!(Scene::tower(65).loaded(0.0).find().is_empty());
}

#[test]
fn what_moves_apart_fast_is_none_and_what_slides_is_one() {
    let tower = || Scene::tower(4).loaded(0.0);
    assert_eq!(tower().with_velocity(3, Vec3::Y * 0.04).sizes(), [4]);
    assert!(tower().with_velocity(3, Vec3::Y * 0.06).find().is_empty());
    assert!(tower().with_velocity(3, Vec3::NEG_Y * 0.06).find().is_empty());
    assert_eq!(tower().with_velocity(3, Vec3::X).sizes(), [4]);
}

#[test]
fn what_floats_leans_on_nothing() {
    let floating: Vec<[u32; 2]> = tower(0..5, 5).into_iter().filter(|pair| pair[1] != 5).collect();
    assert!(Scene::new(5, &floating).loaded(0.0).find().is_empty());
    let mut weightless = Scene::tower(5).loaded(0.0);
    weightless.timing.gravity = Vec3::ZERO;
    assert!(weightless.find().is_empty());
}

#[test]
fn a_body_that_a_joint_holds_makes_none_of_all_that_it_touches() {
    let mut jointed = Scene::tower(5).loaded(0.0);
    let place = jointed.place(4);
    jointed.assembly_of[place] = 0;
    assert!(jointed.find().is_empty());
}

#[test]
fn towers_side_by_side_are_stacks_of_their_own_up_to_512_bodies() {
    let mut pairs: Vec<[u32; 2]> = (0..9).flat_map(|k| tower(60 * k..60 * (k + 1), 540)).collect();
    pairs.sort_unstable();
    let found = Scene::new(540, &pairs).loaded(0.0).find();
    assert_eq!(found.iter().map(|found| found.places.len()).collect::<Vec<_>>(), [60; 8]);
    assert!(found.is_sorted_by_key(|found| found.places[0]));
    assert!(found.iter().all(|found| found.pairs.len() == 60 && found.pairs.is_sorted()));
}
