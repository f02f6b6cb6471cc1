//! The solver of rigid bodies: substeps, each with one pass over soft contacts and one that relaxes them; joints, and
//! the contacts of stacks, are solved exactly.
//!
//! A step reads the four particles of every body once, finds contacts once, makes its substeps on centres, axes and
//! velocities, and writes the particles back. Small steps with one pass converge better than one step with many
//! (Macklin et al. 2019, Small steps in physics simulation).

mod batch;
mod block;
mod bounce;
mod boxes;
mod contact;
mod crew;
mod detect;
mod elimination;
mod finish;
mod flight;
mod foresee;
mod group;
mod held;
mod island;
mod joint;
mod keep;
mod kick;
mod lineup;
mod listen;
mod look;
mod meet;
mod outside;
mod pairs;
mod prepare;
mod pull;
mod read;
mod rigidity;
mod rolling;
mod search;
mod stack;
mod sweep;
mod tangents;
mod way;

use serde::{Deserialize, Serialize};

use crate::body::{Body, Frame, Motion, Substance};
use crate::geometry::manifold;
use crate::joint::{Joints, State as JointState};
use crate::norm::Norm;
use crate::parallel;
use crate::particles::Particles;
use crate::settings::Settings;
use crate::simd::{LANES, run};

use contact::{Pass, Softness};
use crew::{Crew, Timing, Track};
use detect::{Detect, Scene};
use flight::Flights;
use group::Groups;
use joint::JointSolver;
use lineup::{Entry, Lineup, NOBODY, Role};
use listen::Listener;
use pairs::Pairs;
use search::BoxSearch;
use stack::{Aim, Stacks};

pub(crate) use listen::Press;
pub(crate) use outside::{Change, rotation};

/// What a snapshot keeps: all that the next step depends on and that is not in the particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Kept {
    lineup: Lineup,
    tracks: Vec<Track>,
    pairs: Pairs,
    versions: Vec<u32>,
    flights: Flights,
    is_stale: bool,
}

/// The rigid bodies of a world, as they are kept from step to step.
#[derive(Debug, Clone, Default)]
pub(crate) struct RigidSolver {
    lineup: Lineup,
    crew: Crew,
    pairs: Pairs,
    /// Of each body of the world, raised when it has moved.
    versions: Vec<u32>,
    flights: Flights,
    /// Whether bodies have come, gone, fallen asleep or changed their kind since the lineup was made.
    is_stale: bool,
    /// Whether what never moves has been read.
    is_read: bool,
    groups: Groups,
    stacks: Stacks,
    joints: JointSolver,
    /// Of places that are solved for, the number of the assembly that joints make of their body and others.
    assembly_of: Vec<u32>,
    /// Whether contacts are found anew in every substep of this step.
    is_hasty: bool,
    listener: Listener,
    /// Pairs of bodies that do not collide since a joint connects them, sorted.
    separated: Vec<[u32; 2]>,
    softness: Softness,
    search: BoxSearch,
    scratch: manifold::Scratch,
}

/// Contacts are looked for this far apart at least, in m.
const MARGIN: f32 = 0.005;

/// A body that has left all reach, and its first particle that has.
pub(crate) struct Lost {
    pub(crate) body: usize,
    pub(crate) particle: u32,
}

impl RigidSolver {
    /// Has the lineup made anew before the next step.
    pub(crate) fn invalidate(&mut self) {
        self.is_stale = true;
    }

    /// Has the contacts of a body found anew before the next step, as if it had just come.
    pub(crate) fn forget_contacts(&mut self, body: usize) {
        self.pairs.forget(body as u32);
        self.is_stale = true;
    }

    /// Forgets a body that is removed; those behind it move down.
    pub(crate) fn remove_body(&mut self, body: usize) {
        self.pairs.remove_body(body as u32);
        self.flights.remove_body(body as u32);
        if body < self.versions.len() {
            self.versions.remove(body);
        }
        if body < self.lineup.place_of.len() {
            self.lineup.place_of.remove(body);
            self.lineup.forget(body as u32);
        }
        self.is_stale = true;
    }

    pub(crate) fn kept(&self) -> Kept {
        Kept {
            lineup: self.lineup.clone(),
            tracks: self.crew.tracks.clone(),
            pairs: self.pairs.clone(),
            versions: self.versions.clone(),
            flights: self.flights.clone(),
            is_stale: self.is_stale,
        }
    }

    /// Goes on from what was kept, which comes from untrusted bytes.
    pub(crate) fn restore(kept: Kept, bodies: &[Body], joints: &Joints) -> Option<Self> {
        let Kept { lineup, tracks, pairs, versions, flights, is_stale } = kept;
        let is_sound = lineup.is_valid(bodies.len())
            && tracks.len() * LANES == lineup.places.len()
            && (versions.len() == bodies.len() || is_stale)
            && pairs.is_valid(bodies)
            && flights.is_valid(bodies);
        if !is_sound {
            return None;
        }
        let groups = Groups::new(&lineup);
        let mut solver = Self { groups, pairs, versions, flights, is_stale, ..Self::default() };
        if !lineup.places.is_empty() {
            solver.crew = Crew::new(&lineup, bodies);
            solver.crew.tracks = tracks;
            solver.joints.assemble(joints, &lineup);
            solver.assembly_of = solver.joints.assembly_of(lineup.solved);
            solver.separated = joints.separated();
            solver.listener = Listener::new(bodies);
        }
        solver.lineup = lineup;
        Some(solver)
    }

    /// How many pairs of parts are near each other.
    pub(crate) fn pair_count(&self) -> usize {
        self.pairs.pairs.len()
    }

    /// Whether there is so much to do in a substep that it is cut into parts.
    pub(crate) fn is_wide(&self) -> bool {
        self.lineup.stripes.len() > 1
    }

    /// Forgets what concerns the last step alone.
    pub(crate) fn begin_step(&mut self) {
        self.is_hasty = false;
        self.listener.begin_step();
    }

    /// Whether bodies that touch or soon may are in such a haste that contacts are to be found anew in every substep.
    pub(crate) fn is_hasty(&self) -> bool {
        self.is_hasty
    }

    fn assembly_of(&self, place: usize) -> u32 {
        self.assembly_of.get(place).copied().unwrap_or(NOBODY)
    }

    /// Finds that out, once contacts have been found for the whole step.
    ///
    /// A contact is a plane and some points, true where the step begins. What goes several times its length until the
    /// step ends, or turns by more than a radian, meets others elsewhere and with other points, and its inertia there
    /// and then is another: impulses would give it energy. Bodies that joints hold turn with what holds them.
    pub(crate) fn note_haste(&mut self) -> bool {
        let bit = |body: u32, lanes: fn(&Track) -> u32| {
            let place = self.lineup.place_of.get(body as usize).map_or(NOBODY, |&place| place) as usize;
            self.crew.tracks.get(place / LANES).is_some_and(|track| lanes(track) >> (place % LANES) & 1 == 1)
        };
        let is_held = |body: u32| self.assembly_of(self.lineup.place_of[body as usize] as usize) != NOBODY;
        let is_hasty = |body: u32| bit(body, |track| track.rushing) || bit(body, |track| track.turning);
        self.is_hasty = self.crew.tracks.iter().any(|track| (track.rushing | track.turning) != 0)
            && self.pairs.pairs.iter().filter(|pair| pair.points > 0).any(|pair| {
                let both = [pair.a, pair.b];
                let rushes = both.into_iter().any(|body| bit(body, |track| track.rushing));
                rushes || !both.into_iter().any(is_held) && both.into_iter().any(is_hasty)
            });
        if self.is_hasty {
            // Theirs were found for all of the step.
            for (body, version) in (0..).zip(&mut self.versions) {
                *version = version.wrapping_add(u32::from(is_hasty(body)));
            }
        }
        self.is_hasty
    }

    /// Reads the bodies and finds out who may meet whom.
    pub(crate) fn begin(
        &mut self,
        (bodies, particles, joints): (&[Body], &Particles, &Joints),
        settings: &Settings,
        h: f32,
    ) {
        let timing = self.timing(settings, h);
        let is_first = std::mem::take(&mut self.is_stale) || self.lineup.places.is_empty();
        if is_first {
            self.line_up(bodies, particles);
            self.joints.assemble(joints, &self.lineup);
            self.assembly_of = self.joints.assembly_of(self.lineup.solved);
            self.separated = joints.separated();
        }
        self.joints.begin(joints);
        let is_unread = is_first || !std::mem::replace(&mut self.is_read, true);
        self.crew.read(&self.lineup, (bodies, particles), &timing, is_unread);
        let leavers = self.crew.count_versions(&self.lineup, &mut self.versions);
        self.find_pairs(bodies, settings, leavers, is_first);
    }

    /// Puts all rigid bodies in their places.
    fn line_up(&mut self, bodies: &[Body], particles: &Particles) {
        let role = |body: &Body| match &body.substance {
            Substance::Rigid(rigid) => Some(match rigid.traits.motion {
                Motion::Dynamic if body.is_awake() => Role::Free,
                Motion::Kinematic => Role::Driven,
                Motion::Dynamic | Motion::Fixed => Role::Still,
            }),
            _ => None,
        };
        let entry = |(index, body): (usize, &Body)| {
            let center = Frame::of_particles(particles.position.get(body.particles.clone())?).center;
            Some(Entry { body: index as u32, role: role(body)?, center })
        };
        let is_rigid = |(_, body): &(usize, &Body)| matches!(body.substance, Substance::Rigid(_));
        let entries = bodies.iter().enumerate().filter(is_rigid).filter_map(entry).collect();
        let old = std::mem::replace(&mut self.lineup, Lineup::new(entries, bodies.len()));
        let old_crew = std::mem::replace(&mut self.crew, Crew::new(&self.lineup, bodies));
        for (body, &place) in self.lineup.place_of.iter().enumerate() {
            let before = old.place_of.get(body).copied().unwrap_or(NOBODY);
            if place != NOBODY && before != NOBODY {
                self.crew.recall(place as usize, &old_crew.memory(before as usize));
            }
        }
        self.versions.resize(bodies.len(), 0);
        self.groups = Groups::new(&self.lineup);
        self.listener = Listener::new(bodies);
    }

    /// Brings the contacts of all pairs up to date. Returns how many points they have.
    pub(crate) fn find_contacts(&mut self, bodies: &[Body], settings: &Settings, h: f32) -> usize {
        let timing = self.timing(settings, h);
        let Pairs { pairs, details } = &mut self.pairs;
        let scene = scene((&self.lineup, &self.crew, &self.versions, &self.assembly_of), bodies, &timing);
        if parallel::is_worthwhile(pairs.len(), WORTHWHILE) {
            let mut chunks: Vec<_> = pairs.chunks_mut(CHUNK).zip(details.chunks_mut(CHUNK)).collect();
            parallel::for_each(&mut chunks, true, |(pairs, details)| {
                let scratch = &mut manifold::Scratch::default();
                run(settings.instructions, Detect { scene, pairs, details, scratch });
            });
        } else {
            run(settings.instructions, Detect { scene, pairs, details, scratch: &mut self.scratch });
        }
        self.pairs.pairs.iter().map(|pair| pair.points as usize).sum()
    }

    /// Makes the solver's rows.
    pub(crate) fn prepare(&mut self, bodies: &[Body], settings: &Settings, h: f32) {
        self.softness = Softness::new(h, settings.separation_speed.unwrap_or(f32::INFINITY));
        let timing = self.timing(settings, h);
        self.groups.sort_in(&self.pairs, &self.lineup);
        let standing = (&self.lineup, &self.crew, &timing);
        let found = stack::find((&self.groups, &self.pairs), standing, &self.assembly_of);
        self.groups.mark_stacks(&found, self.pairs.pairs.len());
        let (poses, ground) = (&self.crew.poses, self.lineup.ground());
        self.groups.prepare(&self.pairs, poses, ground, &mut self.crew.accumulated, settings.instructions);
        if self.groups.has_bounces() {
            self.crew.write_kicks(&timing);
        }
        self.listener.begin(&self.groups, &self.pairs, bodies, &self.lineup);
        self.stacks.begin(&found, &self.groups, &self.crew);
    }

    /// One substep: forces, stacks and contacts, joints, motion, stacks and contacts without bias.
    pub(crate) fn substep(&mut self, settings: &Settings, h: f32, is_first: bool) {
        let (timing, instructions) = (self.timing(settings, h), settings.instructions);
        self.listener.approach(&self.groups, &self.crew.velocities, h);
        self.groups.meet(&mut self.crew, h, instructions);
        self.crew.kick(&self.lineup, &timing, is_first);
        self.joints.warm_start(&mut self.crew);
        let aim = Aim {
            softness: self.softness,
            is_biased: true,
            kick: f64::from(settings.gravity.norm() * h * h),
        };
        self.stacks.solve(aim, &mut self.groups, &mut self.crew);
        self.groups.pass(Pass::Biased, &self.softness, &mut self.crew.velocities, instructions);
        self.groups.land(&self.softness, &mut self.crew.velocities, instructions);
        self.joints.solve(&mut self.crew, settings, h);
        self.stacks.look_ahead(&self.crew);
        self.crew.advance(&self.lineup, &timing);
        self.joints.take_back(&mut self.crew);
        self.stacks.solve(Aim { is_biased: false, ..aim }, &mut self.groups, &mut self.crew);
        self.groups.pass(Pass::Relaxing, &self.softness, &mut self.crew.velocities, instructions);
        self.groups.part(&mut self.crew.velocities, instructions);
        self.groups.resist_rolling(&mut self.crew.velocities, instructions);
        self.listener.listen(&self.groups, &self.pairs, &self.crew, h);
    }

    /// What the step has made of the joints, by their index.
    pub(crate) fn finish_joints(&self, settings: &Settings, h: f32) -> Vec<(u32, JointState)> {
        self.joints.finish(settings, h)
    }

    fn timing(&self, settings: &Settings, h: f32) -> Timing {
        let substeps = if self.is_hasty { 1.0 } else { settings.substeps as f32 };
        let step = h * substeps;
        Timing {
            h,
            substeps,
            gravity: settings.gravity,
            damping: settings.damping,
            margin: MARGIN + settings.gravity.norm() * step * step,
            instructions: settings.instructions,
        }
    }
}

/// From so many pairs on it pays to look at them side by side, …
const WORTHWHILE: usize = 1024;
/// … so many at a time.
const CHUNK: usize = 256;

/// What there is to collide, as it is when the step begins.
fn scene<'a>(
    (lineup, crew, versions, assembly_of): (&'a Lineup, &'a Crew, &'a [u32], &'a [u32]),
    bodies: &'a [Body],
    timing: &Timing,
) -> Scene<'a> {
    let step = timing.h * timing.substeps;
    Scene {
        bodies,
        versions,
        place_of: &lineup.place_of,
        assembly_of,
        shapes: &crew.shapes,
        poses: &crew.poses,
        velocities: &crew.velocities,
        substeps: timing.substeps,
        has_fast: crew.has_fast(timing.substeps),
        margin: timing.margin,
        fall: timing.gravity * (0.5 * step * (step + timing.h)),
    }
}
