//! Bodies that stand on one another, solved as a whole.
//!
//! A pass over contacts lets a body feel only what touches it. The multipliers that are kept from substep to substep
//! make up for that while loads stay the same, but they act as springs: in a tower of n bodies the slowest sway has a
//! damping that falls with n⁻⁴. What damps it is the softness of contacts, and then the tower sinks and leans. So the
//! contacts of a stack are not soft, and are solved exactly, for velocities with bias and for those without: towers of
//! forty stand, and one on a thousand, and come to rest. The passes leave them alone unless no solution was found.
//!
//! It costs more than a pass by far, and pays where loads go through many bodies or from heavy to light ones: see
//! `find` for what counts as a stack.

mod contact;
mod find;
mod matrix;
mod working_set;

use crate::order::PutInOrder;
use crate::parallel;

use super::contact::Softness;
use super::crew::Crew;
use super::elimination::Part;
use super::group::{Groups, Lane};

use contact::{Contact, Point};
pub(super) use find::{Found, find};
use matrix::System;

/// From so many contacts on it pays to solve stacks side by side.
const WORTHWHILE: usize = 64;

/// How many times faster than by gravity's kick bodies may become that were held.
const ALLOWED: f64 = 2.0;

/// What is deeper in each other than this is moved apart by soft contacts, in m: they are faster at it.
const DEEP: f64 = 0.01;

/// The stacks of a step.
#[derive(Debug, Clone, Default)]
pub(super) struct Stacks {
    stacks: Vec<Stack>,
}

/// One stack.
#[derive(Debug, Clone)]
struct Stack {
    /// Where the velocities of bodies are: first of those that are solved for, then of what these touch.
    places: Vec<u32>,
    contacts: Vec<Contact>,
    /// By place, in the variables of `block`.
    velocities: Vec<Part>,
    system: System,
}

/// What the exact solution is for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aim {
    pub(super) softness: Softness,
    /// Whether bodies are to be moved apart, not only to stop.
    pub(super) is_biased: bool,
    /// What gravity gives a body in a substep, in m.
    pub(super) kick: f64,
}

impl Stacks {
    /// Takes the rows of the stacks' contacts from the groups that hold them.
    pub(super) fn begin(&mut self, found: &[Found], groups: &Groups, crew: &Crew) {
        self.stacks.clear();
        if found.is_empty() {
            return;
        }
        let mut lanes: Vec<(u32, Lane)> = Vec::new();
        groups.for_each_lane(|batch| batch.stacked, |pair, lane| lanes.push((pair, lane)));
        lanes.put_in_order_by_key(|(pair, _)| *pair);
        let stacks = found.iter().map(|found| Stack::new(found, &lanes, groups, crew));
        self.stacks.extend(stacks.filter(|stack| stack.points().all(|point| point.depth() <= DEEP)));
    }

    /// Solves all contacts of all stacks, and hands the rows and velocities back. A stack for which no solution is found
    /// is left to soft contacts for the rest of the step.
    pub(super) fn solve(&mut self, aim: Aim, groups: &mut Groups, crew: &mut Crew) {
        let contact_count: usize = self.stacks.iter().map(|stack| stack.contacts.len()).sum();
        let worthwhile = self.stacks.len() > 1 && contact_count >= WORTHWHILE;
        let (shared, rows) = (&*crew, &*groups);
        let mut tasks: Vec<(&mut Stack, bool)> = self.stacks.iter_mut().map(|stack| (stack, false)).collect();
        parallel::for_each(&mut tasks, worthwhile, |(stack, is_solved)| {
            stack.read(rows, shared);
            *is_solved = stack.try_to_solve(aim);
        });
        let mut is_solved = tasks.into_iter().map(|(_, is_solved)| is_solved).collect::<Vec<_>>().into_iter();
        self.stacks.retain_mut(|stack| {
            let is_solved = is_solved.next() == Some(true);
            if is_solved {
                stack.write(groups, crew)
            } else {
                stack.give_up(groups, !aim.is_biased)
            }
            is_solved
        });
    }

    /// Before bodies are moved: finds where that leaves the surfaces. The passes do that for all contacts, but with
    /// velocities that are being changed.
    pub(super) fn look_ahead(&mut self, crew: &Crew) {
        for stack in &mut self.stacks {
            stack.read_velocities(crew);
            for contact in &mut stack.contacts {
                contact.advance(&stack.velocities);
            }
        }
    }
}

impl Stack {
    fn new(found: &Found, lanes: &[(u32, Lane)], groups: &Groups, crew: &Crew) -> Self {
        let lane = |pair: &u32| lanes.binary_search_by_key(pair, |(pair, _)| *pair).ok();
        let contact = |pair: &u32| Some(Contact::new(lanes[lane(pair)?].1, groups));
        let mut contacts: Vec<Contact> = found.pairs.iter().filter_map(contact).collect();
        let mut places = found.places.clone();
        let mut others: Vec<u32> = contacts.iter().flat_map(|contact| contact.places(groups)).collect();
        others.retain(|place| found.places.binary_search(place).is_err());
        others.sort_unstable();
        others.dedup();
        places.extend(&others);
        let solved = found.places.len();
        let index = |place: u32| match found.places.binary_search(&place) {
            Ok(index) => index,
            Err(_) => solved + others.partition_point(|&other| other < place),
        };
        for contact in &mut contacts {
            contact.ends = contact.places(groups).map(|place| index(place) as u32);
        }
        let inverse_mass = |&place: &u32| f64::from(crew.velocities[place as usize].0[3]);
        let inverse_masses: Vec<f64> = places.iter().map(inverse_mass).collect();
        for contact in &mut contacts {
            contact.weigh(&inverse_masses);
        }
        let velocities = vec![[0.0; 6]; places.len()];
        let system = System::new(inverse_masses, solved, &contacts);
        Self { places, contacts, velocities, system }
    }

    fn read_velocities(&mut self, crew: &Crew) {
        for (velocity, &place) in self.velocities.iter_mut().zip(&self.places) {
            let [x, y, z, _, p, q, r, _] = crew.velocities[place as usize].0.map(f64::from);
            *velocity = [x, y, z, p, q, r];
        }
    }

    fn read(&mut self, groups: &Groups, crew: &Crew) {
        self.read_velocities(crew);
        for contact in &mut self.contacts {
            contact.read(groups);
        }
    }

    /// Solves it, and tells whether that will do; else multipliers are as they were. Friction can jam so that no impulses
    /// are enough (Painlevé 1895); what looks like a solution then gives energy.
    fn try_to_solve(&mut self, aim: Aim) -> bool {
        let multipliers: Vec<[f64; 3]> = self.points().map(|point| point.multipliers).collect();
        let most = self.energy() + self.allowance(aim);
        if self.solve(aim) && self.energy() <= most {
            return true;
        }
        let points = self.contacts.iter_mut().flat_map(|contact| &mut contact.points);
        points.zip(multipliers).for_each(|(point, before)| point.multipliers = before);
        false
    }

    fn points(&self) -> impl Iterator<Item = &Point> {
        self.contacts.iter().flat_map(|contact| &contact.points)
    }

    /// Twice the kinetic energy, in kg m² a substep squared.
    fn energy(&self) -> f64 {
        let places = self.velocities.iter().zip(self.system.masses());
        places
            .map(|([x, y, z, turn @ ..], mass)| {
                mass * (x * x + y * y + z * z) + turn.iter().map(|w| w * w).sum::<f64>()
            })
            .sum()
    }

    /// By how much the energy may grow: what bodies have that gravity or correction moves, and that were held before.
    fn allowance(&self, aim: Aim) -> f64 {
        let deepest = self.points().map(Point::depth).fold(0.0, f64::max);
        let correction = if aim.is_biased { f64::from(aim.softness.bias) * deepest } else { 0.0 };
        let speed = ALLOWED * (aim.kick + correction);
        self.system.masses().sum::<f64>() * speed * speed
    }

    fn write(&mut self, groups: &mut Groups, crew: &mut Crew) {
        for (velocity, &place) in self.velocities.iter().zip(&self.places[..self.system.solved()]) {
            let row = &mut crew.velocities[place as usize].0;
            let [x, y, z, p, q, r] = velocity.map(|number| number as f32);
            [row[0], row[1], row[2]] = [x, y, z];
            [row[4], row[5], row[6]] = [p, q, r];
        }
        self.contacts.iter_mut().for_each(|contact| contact.write(groups));
    }

    fn give_up(&self, groups: &mut Groups, has_moved: bool) {
        self.contacts.iter().for_each(|contact| contact.give_up(groups, has_moved));
    }
}

#[cfg(test)]
mod tests;
