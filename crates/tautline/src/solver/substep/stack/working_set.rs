//! Finding which contacts bear, stick and slide.
//!
//! With a guess of the rows that are held, the equations give the multipliers that hold them. If some would pull, the
//! stack goes towards that solution only until the first of them is zero, lets it go, and solves anew: the impulses never
//! pull, and what they leave undone gets smaller each time (active sets; Nocedal & Wright, Numerical Optimization, 16.5).
//! Friction that would leave Coulomb's cone slides: it is led along with the normal multiplier from one solution to the
//! next. At rest the first guess, what bore in the last substep, is the solution.

use super::super::contact::Softness;
use super::super::elimination::Part;
use super::contact::{Contact, Hold, Point, dot};
use super::{Aim, Stack};

/// The most solutions in a row. What is not done by then is left to the passes.
const MOST_ITERATIONS: usize = 24;

/// A point that does not bear yet is held if it approaches its target by more than this share of gravity's kick; at
/// first also if it moves apart by no more than that.
const NOTHING: f64 = 1e-3;

/// Of that share, what is none for a point that bears.
const SETTLED: f64 = 0.01;

/// Friction is found once it does not change by more than this share of the normal multiplier.
const FRICTION: f64 = 1e-4;
/// What has to do if there is no time left.
const ROUGH: f64 = 0.05;

/// Faster than what so many substeps of gravity's friction stop slides from the beginning.
const FAST: f64 = 2.0;

/// How fast depth is undone in a substep, summed over a stack, as a share of gravity's kick.
const LIFT: f64 = 0.5;

/// What is left of a multiplier that is zero.
const ROUNDING: f64 = 1e-6;

/// How far beyond the cone friction has to be to slide.
const CONE: f64 = 1.0001;

impl Stack {
    /// Finds the impulses of all contacts in a substep. Tells whether it has.
    pub(super) fn solve(&mut self, aim: Aim) -> bool {
        let Softness { bias, drift_rate, limit, .. } = aim.softness;
        let [bias, drift_rate, limit] = if aim.is_biased { [bias, drift_rate, limit] } else { [0.0; 3] };
        // Slower than gravity takes up what is lifted, or a stack would be thrown up.
        let limit = f64::from(limit).min(LIFT * aim.kick / self.system.solved() as f64);
        for contact in &mut self.contacts {
            contact.aim([bias, drift_rate].map(f64::from), limit);
        }
        if self.is_settled(NOTHING * aim.kick) {
            return true;
        }
        self.let_slide(FAST * aim.kick);
        for iteration in 0..MOST_ITERATIONS {
            let slack = if iteration == 0 { NOTHING } else { -0.1 * NOTHING };
            self.guess(slack * aim.kick);
            self.system.factor(&self.contacts);
            let change = self.change();
            let share = self.longest_share(&change);
            let is_last = iteration + 1 == MOST_ITERATIONS;
            let is_done = self.take(&change, share, if is_last { ROUGH } else { FRICTION });
            if is_done && (is_last || self.parts_the_rest(NOTHING * aim.kick)) {
                return true;
            }
        }
        false
    }

    /// Whether impulses are as they should be already: what bears leads to its targets, and the rest does not come near.
    fn is_settled(&self, slack: f64) -> bool {
        self.contacts.iter().all(|contact| {
            contact.points.iter().all(|point| {
                let off = |k: usize| contact.speed(&point.lines[k], &self.velocities) - point.targets[k];
                match point.multipliers[0] > 0.0 {
                    true => (0..3).all(|k| off(k).abs() <= SETTLED * slack),
                    false => off(0) >= -slack,
                }
            })
        })
    }

    /// Whether what is not held does not come nearer, unless it has let go.
    fn parts_the_rest(&self, slack: f64) -> bool {
        self.contacts.iter().all(|contact| {
            contact.points.iter().all(|point| {
                let off = || contact.speed(&point.lines[0], &self.velocities) - point.targets[0];
                point.hold != Hold::Off || point.has_let_go || off() >= -slack
            })
        })
    }

    /// Has friction oppose the motion where it is too fast to be stopped in a substep.
    fn let_slide(&mut self, speed: f64) {
        for contact in &mut self.contacts {
            for k in 0..contact.points.len() {
                let [p, q] = [1, 2].map(|j| contact.speed(&contact.points[k].lines[j], &self.velocities));
                let slip = (p * p + q * q).sqrt();
                if slip > speed * contact.friction {
                    contact.points[k].slides = Some([-p / slip, -q / slip]);
                }
            }
        }
    }

    /// Holds what bears, and what would go into each other.
    fn guess(&mut self, slack: f64) {
        for contact in &mut self.contacts {
            for k in 0..contact.points.len() {
                let opening = contact.speed(&contact.points[k].lines[0], &self.velocities);
                let point = &mut contact.points[k];
                let bears = point.multipliers[0] > 0.0 || opening - point.targets[0] <= slack;
                point.hold = match (bears && !point.has_let_go, point.slides.is_some()) {
                    (false, _) => Hold::Off,
                    (true, true) => Hold::Slides,
                    (true, false) => Hold::Sticks,
                };
            }
            contact.reconcile();
        }
    }

    /// How velocities have to change for all that is held to lead to its target.
    fn change(&self) -> Vec<Part> {
        let mut vector = vec![[0.0; 6]; self.places.len()];
        for contact in &self.contacts {
            for point in &contact.points {
                for (line, target) in point.held_rows() {
                    let push = contact.stiffness * (target - contact.speed(line, &self.velocities));
                    for (end, side) in contact.ends.iter().zip(line) {
                        let part = &mut vector[*end as usize];
                        part.iter_mut().zip(side).for_each(|(number, side)| *number += push * side);
                    }
                }
            }
        }
        self.system.solve(&mut vector);
        vector[self.system.solved()..].fill([0.0; 6]);
        vector
    }

    /// Up to which share of the change no normal multiplier would get below zero.
    fn longest_share(&self, change: &[Part]) -> f64 {
        let mut share = 1.0f64;
        for contact in &self.contacts {
            for point in &contact.points {
                let old = point.multipliers[0];
                let gain = contact.gains(point, &self.velocities, change)[0];
                if old + gain < 0.0 {
                    share = share.min(old / -gain);
                }
            }
        }
        share
    }

    /// Makes a share of a change. Tells whether that was all there is to do; `enough` is by what share of the normal
    /// multiplier friction may still change.
    fn take(&mut self, change: &[Part], share: f64, enough: f64) -> bool {
        let Self { contacts, velocities, .. } = self;
        let gains = |contact: &Contact| {
            let of_point = |point: &Point| contact.gains(point, velocities, change);
            contact.points.iter().map(of_point).collect::<Vec<_>>()
        };
        // All before any is made: they are told from velocities.
        let gains: Vec<Vec<[f64; 3]>> = contacts.iter().map(gains).collect();
        for (velocity, change) in velocities.iter_mut().zip(change) {
            velocity.iter_mut().zip(change).for_each(|(number, change)| *number += share * change);
        }
        let mut is_done = true;
        for (index, gains) in gains.iter().enumerate() {
            for (k, gain) in gains.iter().enumerate() {
                let Contact { friction, points, .. } = &mut self.contacts[index];
                let point = &mut points[k];
                let reached = [0, 1, 2].map(|k| point.multipliers[k] + share * gain[k]);
                let lets_go = point.multipliers[0] + gain[0] < 0.0
                    && reached[0] <= ROUNDING * point.multipliers[0].max(gain[0].abs());
                let kept = point.settle(reached, lets_go, *friction);
                let cut = (kept[1] - reached[1]).abs().max((kept[2] - reached[2]).abs());
                is_done &= !lets_go && cut <= enough * kept[0];
                point.multipliers = kept;
                self.push(index, k, [0, 1, 2].map(|k| kept[k] - reached[k]));
            }
        }
        is_done
    }

    /// Applies impulses along the rows of a point.
    fn push(&mut self, contact: usize, point: usize, impulses: [f64; 3]) {
        let Contact { ends, points, .. } = &self.contacts[contact];
        for (line, impulse) in points[point].lines.iter().zip(impulses).filter(|(_, impulse)| *impulse != 0.0)
        {
            for (end, side) in ends.iter().zip(line) {
                let (velocity, inverse) =
                    (&mut self.velocities[*end as usize], self.system.inverse_mass(*end));
                for ((number, side), inverse) in velocity.iter_mut().zip(side).zip(inverse) {
                    *number += impulse * side * inverse;
                }
            }
        }
    }
}

impl Contact {
    /// By how much the multipliers of a point change with the velocities.
    fn gains(&self, point: &Point, velocities: &[Part], change: &[Part]) -> [f64; 3] {
        let mut gains = [0.0; 3];
        let [a, b] = self.ends.map(|end| &change[end as usize]);
        for (gain, (line, target)) in gains.iter_mut().zip(point.held_rows()) {
            let speed = self.speed(line, velocities) + (dot(&line[0], a) + dot(&line[1], b));
            *gain = self.stiffness * (target - speed);
        }
        gains
    }
}

impl Point {
    /// What is left of multipliers: none of what has let go, and friction within its cone; on its edge once it slides.
    fn settle(&mut self, [normal, p, q]: [f64; 3], lets_go: bool, friction: f64) -> [f64; 3] {
        self.has_let_go |= lets_go;
        let normal = if lets_go { 0.0 } else { normal.max(0.0) };
        let (size, limit) = ((p * p + q * q).sqrt(), friction * normal);
        if self.slides.is_none() && size > limit * CONE {
            self.slides = Some([p / size, q / size]);
        }
        self.slides.map_or([normal, p, q], |[along_p, along_q]| [normal, along_p * limit, along_q * limit])
    }
}
