//! A scene that is changed while it runs: bodies come and go, it begins anew, goes back to a snapshot, and is recorded
//! meanwhile. What has a screen and hands works with it.
//!
//! Bodies, joints and attachments have numbers, which are never used twice; a document's bodies have the first ones, in
//! their order.

mod change;
mod numbers;
mod part;

use std::collections::BTreeMap;

use tautline::{AttachmentHandle, BodyHandle, JointHandle, StepReport, World};

use crate::build::{Builder, Cue, Part, cue};
use crate::document::Scene;
use crate::error::Error;
use crate::export;
use crate::run::Recorder;

pub use numbers::{Numbered, Numbers};

/// Positions that a recording holds at most, over all frames: 12 bytes each.
const MOST_POSITIONS: u64 = 10_000_000;

/// A scene that is changed while it runs.
///
/// ```
/// use tautline_scene::document::{Body, Rigid};
/// use tautline_scene::{live::LiveScene, registry};
///
/// let tower = registry::find("tower")?;
/// let mut scene = LiveScene::new(tower.document(&tower.defaults()))?;
/// let added = scene.add(Body::Rigid(Rigid { position: [3.0, 2.0, 0.0], ..Rigid::default() }))?;
/// scene.step(scene.dt(), &mut || 0.0)?;
/// scene.remove(added)?;
/// assert!(scene.remove(added).is_err());
/// scene.reset()?;
/// assert_eq!(scene.world().time(), 0.0);
/// # Ok::<(), tautline_scene::Error>(())
/// ```
#[derive(Debug)]
pub struct LiveScene {
    /// The document; behind its own bodies come those added since.
    scene: Scene,
    /// How many bodies are the document's own.
    own: usize,
    builder: Builder,
    cues: Vec<Cue>,
    bodies: Numbers<BodyHandle>,
    joints: Numbers<JointHandle>,
    attachments: Numbers<AttachmentHandle>,
    /// Which of the builder's parts a body is, also of one that was removed: a snapshot may have it.
    part_of: BTreeMap<BodyHandle, usize>,
    steps: u64,
    recorder: Option<Recorder>,
}

impl LiveScene {
    /// Builds a scene.
    ///
    /// # Errors
    /// As [`Scene::build`].
    pub fn new(scene: Scene) -> Result<Self, Error> {
        let (builder, cues) = scene.start()?;
        let mut live = Self {
            own: scene.bodies.len(),
            scene,
            builder,
            cues,
            bodies: Numbers::default(),
            joints: Numbers::default(),
            attachments: Numbers::default(),
            part_of: BTreeMap::new(),
            steps: 0,
            recorder: None,
        };
        live.number_all();
        Ok(live)
    }

    /// Everything as it was built. What was added since is gone, and its numbers with it; a recording begins anew.
    ///
    /// # Errors
    /// None: what could be built once can be built again.
    pub fn reset(&mut self) -> Result<(), Error> {
        self.scene.bodies.truncate(self.own);
        let (builder, cues) = self.scene.start()?;
        (self.builder, self.cues) = (builder, cues);
        self.bodies.forget_all();
        self.joints.forget_all();
        self.attachments.forget_all();
        self.part_of.clear();
        self.steps = 0;
        self.number_all();
        if self.recorder.is_some() {
            self.start_recording()?;
        }
        Ok(())
    }

    /// Gives numbers to all of a scene that has just been built: the same ones every time.
    fn number_all(&mut self) {
        let Self { builder, bodies, joints, attachments, .. } = self;
        bodies.assign(builder.world.bodies());
        joints.assign(builder.world.joints());
        attachments.assign(builder.world.attachments());
        builder.renumber(|body| bodies.number(body));
        self.part_of.clear();
        self.part_of.extend(builder.parts.iter().enumerate().map(|(index, part)| (part.body, index)));
    }

    /// One step of `dt` seconds; `clock` tells the time, in s. Cues of the document are followed in steps as long as its
    /// own.
    ///
    /// # Errors
    /// [`Error::Engine`] for a time step that is out of range.
    pub fn step(&mut self, dt: f32, clock: &mut dyn FnMut() -> f64) -> Result<StepReport, Error> {
        cue::follow(&self.cues, &mut self.builder.world, dt)?;
        let report = self.builder.world.step_with_clock(dt, clock)?;
        self.steps += 1;
        let is_due = self.steps.is_multiple_of(u64::from(self.scene.record_every));
        if let Some(recorder) = self.recorder.as_mut().filter(|_| is_due)
            && recorder.positions_per_frame().saturating_mul(recorder.frame_count()) < MOST_POSITIONS
        {
            recorder.record(&self.builder.world)?;
        }
        Ok(report)
    }

    /// Its document; what was added since is behind the bodies of the document.
    pub fn document(&self) -> &Scene {
        &self.scene
    }

    /// Time step of the document, in s.
    pub fn dt(&self) -> f32 {
        self.scene.dt
    }

    /// How many steps have been taken since it was built.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The world.
    pub fn world(&self) -> &World {
        &self.builder.world
    }

    /// The world, to be changed otherwise than by adding and removing, which are [`LiveScene::add`] and
    /// [`LiveScene::remove`] and their like.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.builder.world
    }

    /// The numbers of bodies.
    pub fn bodies(&self) -> &Numbers<BodyHandle> {
        &self.bodies
    }

    /// The numbers of joints.
    pub fn joints(&self) -> &Numbers<JointHandle> {
        &self.joints
    }

    /// The numbers of attachments.
    pub fn attachments(&self) -> &Numbers<AttachmentHandle> {
        &self.attachments
    }

    /// How a body of the world is named and drawn.
    pub fn part(&self, body: BodyHandle) -> Option<&Part> {
        self.part_of.get(&body).and_then(|&index| self.builder.parts.get(index))
    }

    /// Begins a recording, with the present as its first frame. One that is under way is thrown away.
    ///
    /// # Errors
    /// None: every body of the world has its part.
    pub fn start_recording(&mut self) -> Result<(), Error> {
        self.recorder = Some(self.recorder_of_now()?);
        Ok(())
    }

    fn recorder_of_now(&self) -> Result<Recorder, Error> {
        let frame_rate = 1.0 / (self.scene.dt * self.scene.record_every as f32);
        let world = &self.builder.world;
        let parts = world.bodies().filter_map(|body| self.part(body));
        let mut recorder = Recorder::new(&self.scene.name, frame_rate, parts, world)?;
        recorder.record(world)?;
        Ok(recorder)
    }

    /// How many frames have been recorded; `None` = it is not recorded.
    pub fn recorded_frames(&self) -> Option<u64> {
        self.recorder.as_ref().map(Recorder::frame_count)
    }

    /// The recording so far as a GLB file, or the present if there is none.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if it is too large for the format.
    pub fn glb(&self) -> Result<Vec<u8>, Error> {
        let recorder = self.recorder.clone().map_or_else(|| self.recorder_of_now(), Ok)?;
        export::glb_bytes(&recorder.finish())
    }
}
