//! Running a scene: its steps, what they look like, and what came of them.

mod recorder;
mod summary;
mod tears;
mod tube;
mod tubes;

use std::time::Instant;

use tautline::{StepReport, World};

use crate::build::BuiltScene;
use crate::document::limits;
use crate::error::{Error, Problem};
use crate::recording::Recording;
use crate::render::Camera;
use summary::Tally;

pub use recorder::Recorder;
pub use summary::{PhaseMilliseconds, RunSummary};

/// How a scene is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunOptions {
    /// For how long, in s of the scene's time; `None` = as long as the scene says.
    pub seconds: Option<f32>,
    /// Whether its motion is recorded.
    pub record: bool,
}

impl Default for RunOptions {
    /// As long as the scene says, recorded.
    fn default() -> Self {
        Self { seconds: None, record: true }
    }
}

/// A scene that is being run.
///
/// ```
/// use tautline_scene::registry;
/// use tautline_scene::run::{Run, RunOptions};
///
/// let tower = registry::find("tower")?;
/// let options = RunOptions { seconds: Some(0.5), record: false };
/// let outcome = Run::new(tower.document(&tower.defaults()).build()?, options)?.complete(&mut |_, _| ())?;
/// assert_eq!((outcome.summary.steps, outcome.summary.escaped), (30, 0));
/// # Ok::<(), tautline_scene::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Run {
    scene: BuiltScene,
    step_count: u64,
    tally: Tally,
    recorder: Option<Recorder>,
}

/// What came of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Figures.
    pub summary: RunSummary,
    /// The motion, if it was recorded.
    pub recording: Option<Recording>,
    /// Where the scene wants to be seen from.
    pub camera: Option<Camera>,
}

impl Run {
    /// A run that has not begun. The first frame of its recording is the scene as it was built.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a time that is not positive or takes too many steps, or if the recording would
    /// be too large.
    pub fn new(scene: BuiltScene, options: RunOptions) -> Result<Self, Error> {
        let seconds = options.seconds.unwrap_or(scene.seconds);
        let steps = (seconds / scene.dt).round();
        if !(steps <= limits::STEPS && seconds > 0.0) {
            return Err(refusal(
                "seconds",
                format!("{seconds} is not a time of at most {} steps", limits::STEPS),
            ));
        }
        let step_count = (steps as u64).max(1);
        let frames = step_count / u64::from(scene.record_every) + 1;
        let recorder = if options.record {
            let mut recorder = Recorder::new(&scene.name, scene.frame_rate(), &scene.parts, &scene.world)?;
            let positions = frames.saturating_mul(recorder.positions_per_frame());
            if positions > limits::RECORDED_POSITIONS {
                let most = limits::RECORDED_POSITIONS;
                let message = format!("{frames} frames have {positions} positions, more than {most}");
                return Err(refusal("record_every", message));
            }
            recorder.record(&scene.world)?;
            Some(recorder)
        } else {
            None
        };
        Ok(Self { scene, step_count, tally: Tally::default(), recorder })
    }

    /// How many steps it takes.
    pub fn step_count(&self) -> u64 {
        self.step_count
    }

    /// How many have been taken.
    pub fn steps_done(&self) -> u64 {
        self.tally.steps
    }

    /// The world as it is now.
    pub fn world(&self) -> &World {
        &self.scene.world
    }

    /// Takes a step, also beyond the last one.
    ///
    /// # Errors
    /// [`Error::Engine`] if the scene's time step is refused.
    pub fn step(&mut self) -> Result<StepReport, Error> {
        let start = Instant::now();
        let mut clock = || start.elapsed().as_secs_f64();
        self.scene.follow_cues()?;
        let report = self.scene.world.step_with_clock(self.scene.dt, &mut clock)?;
        self.tally.add(&report, start.elapsed());
        if let Some(recorder) = &mut self.recorder
            && self.tally.steps.is_multiple_of(u64::from(self.scene.record_every))
        {
            recorder.record(&self.scene.world)?;
        }
        Ok(report)
    }

    /// Takes all steps that are left. `progress` is told how many are done, and of how many.
    ///
    /// # Errors
    /// As [`Run::step`].
    pub fn complete(mut self, progress: &mut dyn FnMut(u64, u64)) -> Result<Outcome, Error> {
        while self.steps_done() < self.step_count {
            self.step()?;
            progress(self.steps_done(), self.step_count);
        }
        self.finish()
    }

    /// Ends the run where it is.
    ///
    /// # Errors
    /// [`Error::Engine`] if bodies of the scene have been removed.
    pub fn finish(self) -> Result<Outcome, Error> {
        let summary = self.tally.summary(&self.scene)?;
        let recording = self.recorder.map(|recorder| recorder.finish());
        Ok(Outcome { summary, recording, camera: self.scene.camera })
    }
}

fn refusal(path: &str, message: String) -> Error {
    Error::Invalid(vec![Problem { path: path.to_owned(), message }])
}
