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
mod group;
mod held;
mod island;
mod joint;
mod lineup;
mod pairs;
mod prepare;
mod pull;
mod read;
mod rigidity;
mod rolling;
mod search;
mod stack;

use serde::{Deserialize, Serialize};

use crate::body::{Body, Frame, Motion, Substance};
use crate::geometry::manifold;
use crate::joint::{Joints, State as JointState};
use crate::parallel;
use crate::particles::Particles;
use crate::settings::Settings;
use crate::simd::{LANES, run};

use contact::{Pass, Softness};
use crew::{Crew, Timing, Track};
use detect::{Detect, Scene};
use group::Groups;
use joint::JointSolver;
use lineup::{Entry, Lineup, NOBODY, Role};
use pairs::Pairs;
use search::BoxSearch;
use stack::{Aim, Stacks};

/// What a snapshot keeps: all that the next step depends on and that is not in the particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Kept {
    lineup: Lineup,
    tracks: Vec<Track>,
    pairs: Pairs,
    versions: Vec<u32>,
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
    /// Whether bodies have come, gone, fallen asleep or changed their kind since the lineup was made.
    is_stale: bool,
    /// Whether what never moves has been read.
    is_read: bool,
    groups: Groups,
    stacks: Stacks,
    joints: JointSolver,
    /// Pairs of bodies that do not collide since a joint connects them, sorted.
    separated: Vec<[u32; 2]>,
    softness: Softness,
    search: BoxSearch,
    scratch: manifold::Scratch,
}

/// Contacts are looked for this far apart at least, in m.
const MARGIN: f32 = 0.005;

/// A body that did not stay finite, and its first particle that did not.
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
        if body < self.versions.len() {
            self.versions.remove(body);
        }
        if body < self.lineup.place_of.len() {
            let place = self.lineup.place_of.remove(body);
            self.lineup.forget(body as u32, place);
        }
        self.is_stale = true;
    }

    pub(crate) fn kept(&self) -> Kept {
        Kept {
            lineup: self.lineup.clone(),
            tracks: self.crew.tracks.clone(),
            pairs: self.pairs.clone(),
            versions: self.versions.clone(),
            is_stale: self.is_stale,
        }
    }

    /// Goes on from what was kept, which comes from untrusted bytes.
    pub(crate) fn restore(kept: Kept, bodies: &[Body], joints: &Joints) -> Option<Self> {
        let Kept { lineup, tracks, pairs, versions, is_stale } = kept;
        let is_sound = lineup.is_valid(bodies.len())
            && tracks.len() * LANES == lineup.places.len()
            && (versions.len() == bodies.len() || is_stale)
            && pairs.is_valid(bodies);
        if !is_sound {
            return None;
        }
        let mut solver = Self { groups: Groups::new(&lineup), pairs, versions, is_stale, ..Self::default() };
        if !lineup.places.is_empty() {
            solver.crew = Crew::new(&lineup, bodies);
            solver.crew.tracks = tracks;
            solver.joints.assemble(joints, &lineup);
            solver.separated = joints.separated();
        }
        solver.lineup = lineup;
        Some(solver)
    }

    /// How many pairs of parts are near each other.
    pub(crate) fn pair_count(&self) -> usize {
        self.pairs.pairs.len()
    }

    /// Reads the bodies and finds out who may meet whom.
    pub(crate) fn begin(
        &mut self,
        (bodies, particles, joints): (&[Body], &Particles, &Joints),
        settings: &Settings,
        h: f32,
    ) {
        let timing = timing(settings, h);
        let is_first = std::mem::take(&mut self.is_stale) || self.lineup.places.is_empty();
        if is_first {
            self.line_up(bodies, particles);
            self.joints.assemble(joints, &self.lineup);
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
    }

    /// Brings the contacts of all pairs up to date. Returns how many points they have.
    pub(crate) fn find_contacts(&mut self, bodies: &[Body], settings: &Settings, h: f32) -> usize {
        let timing = timing(settings, h);
        let Pairs { pairs, details } = &mut self.pairs;
        let scene = scene((&self.lineup, &self.crew, &self.versions), bodies, &timing);
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
    pub(crate) fn prepare(&mut self, settings: &Settings, h: f32) {
        self.softness = Softness::new(h, settings.separation_speed.unwrap_or(f32::INFINITY));
        let found = stack::find(&self.pairs, (&self.lineup, &self.crew, &timing(settings, h)), &self.joints);
        let is_stacked = stack::marks(&found, self.pairs.pairs.len());
        self.groups.sort_in(&self.pairs, &self.lineup, &is_stacked);
        let (poses, ground) = (&self.crew.poses, self.lineup.ground());
        self.groups.prepare(&self.pairs, poses, ground, &mut self.crew.accumulated, settings.instructions);
        self.stacks.begin(&found, &self.groups, &self.crew);
    }

    /// One substep: forces, stacks and contacts, joints, motion, stacks and contacts without bias.
    pub(crate) fn substep(&mut self, settings: &Settings, h: f32, is_first: bool) {
        let (timing, instructions) = (timing(settings, h), settings.instructions);
        self.groups.meet(&mut self.crew, h, instructions);
        self.crew.kick(&self.lineup, is_first, instructions);
        self.joints.warm_start(&mut self.crew);
        let aim = Aim {
            softness: self.softness,
            is_biased: true,
            kick: f64::from(settings.gravity.length() * h * h),
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
    }

    /// What the step has made of the joints, by their index.
    pub(crate) fn finish_joints(&self, settings: &Settings, h: f32) -> Vec<(u32, JointState)> {
        self.joints.finish(settings, h)
    }
}

/// From so many pairs on it pays to look at them side by side, …
const WORTHWHILE: usize = 1024;
/// … so many at a time.
const CHUNK: usize = 256;

/// What there is to collide, as it is when the step begins.
fn scene<'a>(
    (lineup, crew, versions): (&'a Lineup, &'a Crew, &'a [u32]),
    bodies: &'a [Body],
    timing: &Timing,
) -> Scene<'a> {
    Scene {
        bodies,
        versions,
        place_of: &lineup.place_of,
        shapes: &crew.shapes,
        poses: &crew.poses,
        velocities: &crew.velocities,
        substeps: timing.substeps,
        margin: timing.margin,
    }
}

fn timing(settings: &Settings, h: f32) -> Timing {
    let substeps = settings.substeps as f32;
    let step = h * substeps;
    Timing {
        h,
        substeps,
        gravity: settings.gravity,
        damping: settings.damping,
        margin: MARGIN + settings.gravity.length() * step * step,
        instructions: settings.instructions,
    }
}
