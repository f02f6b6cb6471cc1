//! Joints between rigid bodies. What they did in the last substep is given to the bodies before contacts are solved,
//! and they are solved after those: what contacts did to single bodies is shared out before anything moves.
//!
//! Bodies that joints hold together make an assembly; no two assemblies share a body, so that they are solved side by
//! side, each exactly and by itself.

mod assembly;
mod mover;
mod rows;
mod stop;
mod work;

use std::collections::BTreeMap;

use crate::joint::{Joint, Joints, State};
use crate::order::PutInOrder;
use crate::parallel;
use crate::settings::Settings;

use super::crew::Crew;
use super::lineup::{Lineup, NOBODY, Region};
use assembly::{Assembly, Pace};
use mover::Mover;
use work::Work;

/// From so many joints on it pays to solve assemblies side by side.
const WORTHWHILE: usize = 32;

/// The joints of a world while steps are made.
#[derive(Debug, Clone, Default)]
pub(crate) struct JointSolver {
    assemblies: Vec<Assembly>,
    joint_count: usize,
}

impl JointSolver {
    /// Finds out which bodies hang together. Joints that hold nothing awake are left out.
    pub(super) fn assemble(&mut self, joints: &Joints, lineup: &Lineup) {
        let place = |body: u32| lineup.place_of.get(body as usize).copied().unwrap_or(NOBODY);
        let is_solved = |body: u32| (place(body) as usize) < lineup.solved;
        let solved =
            |joint: &Joint| [joint.base, Some(joint.body)].map(|body| body.filter(|&body| is_solved(body)));
        let mut sets = Sets::new(lineup.place_of.len());
        for (_, joint) in joints.holding() {
            if let [Some(base), Some(body)] = solved(joint) {
                sets.join(base, body);
            }
        }
        let mut members: BTreeMap<u32, Vec<(usize, &Joint)>> = BTreeMap::new();
        for (index, joint) in joints.holding() {
            if let Some(body) = solved(joint).into_iter().flatten().next() {
                members.entry(sets.root(body)).or_default().push((index, joint));
            }
        }
        // What is still is looked at where it stands; what is driven where its velocity is.
        let mover = |body: u32| match place(body) {
            place if lineup.is_driven(place) => Mover::at(lineup.velocity_place(Region::Stripe(0), place)),
            place => Mover::at(place),
        };
        self.joint_count = members.values().map(Vec::len).sum();
        self.assemblies = members.values().map(|members| assembly(members, is_solved, mover)).collect();
    }

    /// Of each place the number of the assembly that its body is in, or `NOBODY`.
    pub(super) fn assembly_of(&self, place_count: usize) -> Vec<u32> {
        let mut assembly_of = vec![NOBODY; place_count];
        for number in 0..self.assemblies.len() as u32 {
            self.members(number).for_each(|place| assembly_of[place as usize] = number);
        }
        assembly_of
    }

    /// The places of an assembly's bodies, but for those that move as they are told.
    pub(super) fn members(&self, assembly: u32) -> impl Iterator<Item = u32> + '_ {
        let assembly = &self.assemblies[assembly as usize];
        assembly.movers[..assembly.solved].iter().map(|mover| mover.place)
    }

    /// Takes over what has been set since the last step.
    pub(super) fn begin(&mut self, joints: &Joints) {
        for assembly in &mut self.assemblies {
            assembly.movers.iter_mut().for_each(Mover::begin_step);
            for work in &mut assembly.works {
                work.begin(&joints.items[work.index as usize]);
            }
        }
    }

    /// Gives all bodies what the joints did in the last substep.
    pub(super) fn warm_start(&mut self, crew: &mut Crew) {
        self.for_each(crew, |assembly, crew| {
            assembly.read(crew);
            assembly.warm_start();
        });
    }

    /// Solves for all joints in a substep of `h` (s).
    pub(super) fn solve(&mut self, crew: &mut Crew, settings: &Settings, h: f32) {
        let pace = Pace { h, limit: settings.separation_speed.map_or(f32::INFINITY, |speed| speed * h) };
        self.for_each(crew, |assembly, crew| {
            assembly.read_motions(crew);
            assembly.solve(&pace);
        });
    }

    /// Takes back from bodies that have moved what undid errors.
    pub(super) fn take_back(&self, crew: &mut Crew) {
        for assembly in &self.assemblies {
            assembly.take_back(crew);
        }
    }

    /// Does `work` on all assemblies side by side, and then gives the bodies the motions that it left.
    fn for_each(&mut self, crew: &mut Crew, work: impl Fn(&mut Assembly, &Crew) + Send + Sync) {
        let worthwhile = self.joint_count >= WORTHWHILE && self.assemblies.len() > 1;
        let shared = &*crew;
        parallel::for_each(&mut self.assemblies, worthwhile, |assembly| work(assembly, shared));
        for assembly in &mut self.assemblies {
            assembly.write_motions(crew);
        }
    }

    /// What the step has made of the joints, in substeps of `h` (s).
    pub(super) fn finish(&self, settings: &Settings, h: f32) -> Vec<(u32, State)> {
        let scale = 1.0 / (h * h * settings.substeps as f32);
        let works = self.assemblies.iter().flat_map(|assembly| &assembly.works);
        let state = |work: &Work| {
            let state = work.joint.state;
            (work.index, State { force: state.force * scale, torque: state.torque * scale, ..state })
        };
        let mut states: Vec<(u32, State)> = works.map(state).collect();
        states.put_in_order_by_key(|(index, _)| *index);
        states
    }
}

/// The joints of one set of bodies with those bodies.
fn assembly(
    members: &[(usize, &Joint)],
    is_solved: impl Fn(u32) -> bool,
    mover: impl Fn(u32) -> Mover,
) -> Assembly {
    let ends = members.iter().flat_map(|(_, joint)| [joint.base, Some(joint.body)]).flatten();
    let mut bodies: Vec<u32> = ends.collect();
    bodies.put_in_order_by_key(|&body| (!is_solved(body), body));
    bodies.dedup();
    let solved = bodies.partition_point(|&body| is_solved(body));
    let rank = |body: u32| (!is_solved(body), body);
    let number =
        |body: u32| bodies.binary_search_by_key(&rank(body), |&other| rank(other)).ok().map(|i| i as u32);
    let work = |&(index, joint): &(usize, &Joint)| {
        let base = joint.base.and_then(number);
        Some(Work::new(index, joint, number(joint.body)?, base))
    };
    let works: Vec<Work> = members.iter().filter_map(work).collect();
    let movers = bodies.iter().map(|&body| mover(body)).collect();
    Assembly::new(movers, solved, works)
}

/// Disjoint sets of bodies (Tarjan 1975); a set is named by its lowest body.
pub(super) struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    pub(super) fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    pub(super) fn root(&mut self, mut body: u32) -> u32 {
        loop {
            let parent = self.parent[body as usize];
            let next = self.parent[parent as usize];
            if next == parent {
                return parent;
            }
            self.parent[body as usize] = next;
            body = next;
        }
    }

    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
