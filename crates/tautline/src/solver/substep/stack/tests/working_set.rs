//! Small contact problems whose solutions are known.

use proptest::prelude::*;

use super::super::super::contact::Softness;
use super::super::matrix::System;
use super::super::{Aim, Stack};
use super::*;

/// In s; what gravity gives a body in it, in m.
const H: f64 = 1.0 / 480.0;
const KICK: f64 = 9.81 * H * H;

/// A solution holds what the one before it pushed together, often a single point more: for six points, so many in a row.
const SOLUTIONS: usize = 7;

const UP: [f64; 3] = [0.0, 1.0, 0.0];
const FALLING: Part = [0.0, -KICK, 0.0, 0.0, 0.0, 0.0];

/// A point right below or above the centres of bodies, so that it turns neither.
fn below() -> Point {
    point([UP, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(level))
}

/// A point without friction at this lever, beside the centre of b and below it: its normal turns b about z.
fn beside(lever: f64) -> Point {
    let mut normal = level(UP);
    normal[1][5] = lever;
    point([normal, [[0.0; 6]; 2], [[0.0; 6]; 2]])
}

/// Bodies of these masses (kg) and velocities (m a substep), on a floor that stands behind them.
fn stack(masses: &[f64], velocities: &[Part], mut contacts: Vec<Contact>) -> Stack {
    let mut inverse_masses: Vec<f64> = masses.iter().map(|mass| 1.0 / mass).collect();
    inverse_masses.push(0.0);
    contacts.iter_mut().for_each(|contact| contact.weigh(&inverse_masses));
    let mut velocities = velocities.to_vec();
    velocities.push([0.0; 6]);
    let system = System::new(inverse_masses, masses.len(), &contacts);
    Stack { places: (0..=masses.len() as u32).collect(), contacts, velocities, system }
}

fn aim(is_biased: bool) -> Aim {
    Aim { softness: Softness::new(H as f32, 3.0), is_biased, kick: KICK }
}

/// Contacts give way by a ten-thousandth of what they bear: a second solution takes out what the first left of that.
fn solved(mut stack: Stack) -> Stack {
    assert!(stack.solve(aim(false)), "no solution");
    assert!(stack.solve(aim(false)), "no second solution");
    stack
}

fn assert_near(number: f64, expected: f64, tolerance: f64) {
    assert!((number - expected).abs() <= tolerance, "{number} and not {expected}");
}

#[test]
fn a_contact_of_a_tower_bears_all_that_is_above_it() {
    let masses = [3.0, 1.0, 4.0, 1.0, 5.0];
    let contacts = (0..5).map(|k| contact([if k == 0 { 5 } else { k - 1 }, k], 0.5, vec![below()]));
    let tower = solved(stack(&masses, &[FALLING; 5], contacts.collect()));
    for (k, contact) in tower.contacts.iter().enumerate() {
        let above: f64 = masses[k..].iter().sum();
        assert_near(contact.points[0].multipliers[0], above * KICK, 1e-4 * above * KICK);
        assert_near(tower.velocities[k][1], 0.0, 1e-4 * KICK);
    }
}

/// A dumbbell, I = 2 m l², whose left end comes down at a tenth of the speed of its right: it lands on its right, and that
/// lifts its left. With u = 1/m and v = l²/I, the multiplier that stops the right alone is 1/(u + v).
#[test]
fn a_point_that_would_pull_lets_go() {
    let lever = 0.5_f64.sqrt();
    let velocity = [0.0, -0.55 * KICK, 0.0, 0.0, 0.0, -0.45 * KICK / lever];
    let points = vec![beside(-lever), beside(lever)];
    let dumbbell = solved(stack(&[1.0], &[velocity], vec![contact([1, 0], 0.5, points)]));
    let [left, right] = [0, 1].map(|k| &dumbbell.contacts[0].points[k]);
    assert_eq!((left.multipliers[0], left.hold), (0.0, Hold::Off));
    assert_near(right.multipliers[0], KICK / 1.5, 1e-4 * KICK);
    let opening = dumbbell.contacts[0].speed(&left.lines[0], &dumbbell.velocities);
    assert_near(opening, (0.5 / 1.5 - 0.1) * KICK, 1e-4 * KICK);
}

/// Blocks of 2 kg that fall and slide on a floor with a friction of 0.5, at shares of the kick: what is too slow sticks, what
/// is faster than friction can stop keeps the rest of its speed.
#[test]
fn friction_stops_what_its_cone_can_and_slows_the_rest() {
    for (speed, left) in [(0.3, 0.0), (0.49, 0.0), (0.8, 0.3), (10.0, 9.5)] {
        let mut velocity = FALLING;
        (velocity[0], velocity[2]) = (0.6 * speed * KICK, -0.8 * speed * KICK);
        let mut block = stack(&[2.0], &[velocity], vec![contact([1, 0], 0.5, vec![below()])]);
        assert!(block.solve(aim(false)));
        let tolerance = 2e-4 * KICK;
        let [x, y, z, ..] = block.velocities[0];
        assert_near(x, 0.6 * left * KICK, tolerance);
        assert_near(y, 0.0, tolerance);
        assert_near(z, -0.8 * left * KICK, tolerance);
        let [normal, p, q] = block.contacts[0].points[0].multipliers;
        assert_near(normal, 2.0 * KICK, 2.0 * tolerance);
        assert_near((p * p + q * q).sqrt(), 2.0 * (speed - left) * KICK, 2.0 * tolerance);
    }
}

#[test]
fn what_flies_apart_is_left_alone() {
    let rising = [0.0, KICK, 0.0, 0.0, 0.0, 0.0];
    let body = solved(stack(&[1.0], &[rising], vec![contact([1, 0], 0.5, vec![below()])]));
    assert_eq!(body.velocities[0], rising);
    assert_eq!(body.contacts[0].points[0].multipliers, [0.0; 3]);
}

/// The slop aside, depth is undone by the share that soft contacts undo, but no faster than half of gravity's kick.
#[test]
fn depth_is_undone_slower_than_gravity_takes_up_what_is_lifted() {
    let share = f64::from(aim(true).softness.bias);
    for (depth, speed) in [(5e-6, 0.0), (1e-4, share * 9e-5), (1e-3, 0.5 * KICK)] {
        let mut lying = contact([1, 0], 0.5, vec![below()]);
        lying.advance(&[[0.0, -depth, 0.0, 0.0, 0.0, 0.0], [0.0; 6]]);
        let mut body = stack(&[1.0], &[FALLING], vec![lying]);
        assert!(body.solve(aim(true)));
        assert_near(body.velocities[0][1], speed, 2e-4 * KICK);
    }
}

/// A body at rest between one that falls to the floor and one that falls on it. All three come to rest.
#[test]
fn what_a_solution_pushes_together_is_held_by_it() {
    let velocities = [2.0, 0.0, 1.0].map(|kicks: f64| FALLING.map(|kick| kicks * kick));
    let contacts = (0..3).map(|k| contact([if k == 0 { 3 } else { k - 1 }, k], 0.5, vec![below()]));
    let mut bodies = stack(&[1.0, 2.0, 0.5], &velocities, contacts.collect());
    assert!(bodies.solve(aim(false)));
    for (k, load) in [2.5, 0.5, 0.5].into_iter().enumerate() {
        assert_near(bodies.velocities[k][1], 0.0, 0.01 * KICK);
        assert_near(bodies.contacts[k].points[0].multipliers[0], load * KICK, 0.01 * KICK);
    }
}

/// Solves it once more, as the next pass of a substep does.
fn solve_anew(bodies: &mut Stack) -> bool {
    for point in bodies.contacts.iter_mut().flat_map(|contact| &mut contact.points) {
        (point.has_let_go, point.slides) = (false, None);
    }
    bodies.solve(aim(false))
}

/// Of every point its multiplier and how fast it opens, in kicks.
fn loads_and_openings(bodies: &Stack) -> impl Iterator<Item = [f64; 2]> {
    bodies.contacts.iter().flat_map(|contact| {
        contact.points.iter().map(|point| {
            let opening = contact.speed(&point.lines[0], &bodies.velocities);
            [point.multipliers[0] / KICK, opening / KICK]
        })
    })
}

proptest! {
    /// Bodies on a floor and on each other, without friction. A solution never pulls, and what bears stays together; after
    /// some in a row nothing that touches comes nearer any more.
    #[test]
    fn loads_and_openings_become_complementary(
        levers in prop::collection::vec(prop::array::uniform2(0.1..2.0_f64), 3),
        velocities in prop::collection::vec((-2.0..0.5_f64, -1.0..1.0_f64), 3),
    ) {
        let contacts = levers.iter().zip(0..).map(|([left, right], k)| {
            let below = if k == 0 { 3 } else { k - 1 };
            contact([below, k], 0.5, vec![beside(-left), beside(*right)])
        });
        let velocity = |&(y, turn): &(f64, f64)| [0.0, y * KICK, 0.0, 0.0, 0.0, turn * KICK];
        let velocities: Vec<Part> = velocities.iter().map(velocity).collect();
        let mut bodies = stack(&[1.0, 2.0, 0.5], &velocities, contacts.collect());
        for _ in 0..SOLUTIONS {
            prop_assert!(solve_anew(&mut bodies), "no solution");
            for [load, opening] in loads_and_openings(&bodies) {
                prop_assert!(load >= 0.0, "it pulls by {load}");
                prop_assert!(load == 0.0 || opening.abs() <= 0.01, "it bears {load} and opens by {opening}");
            }
        }
        for [_, opening] in loads_and_openings(&bodies) {
            prop_assert!(opening >= -0.01, "it still comes nearer by {}", -opening);
        }
    }
}
