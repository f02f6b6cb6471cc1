//! Stepping worlds: one step, a run that is recorded, and many worlds at once. Python goes on meanwhile.

use std::time::{Duration, Instant};

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;
use tautline::{BodyHandle, ContactEventKind};
use tautline_scene::build::BuiltScene;
use tautline_scene::run::Recorder;

use crate::body::Body;
use crate::errors::{Failure, Outcome};
use crate::joints::Joint;
use crate::recording::{Recording, Series};
use crate::threads;
use crate::world::World;

/// How long steps are taken before Python is asked for signals and told how far it is.
const TURN: Duration = Duration::from_millis(50);

/// What a step did.
#[pyclass(frozen, get_all, module = "tautline")]
pub(crate) struct StepReport {
    /// Pairs of bodies whose boxes overlapped.
    pairs: usize,
    contacts: usize,
    /// Sticks looked at.
    visits: u64,
    /// Sticks relaxed.
    relaxations: u64,
    awake_bodies: usize,
    /// Bodies that turned non-finite and have been frozen.
    faults: Vec<Py<Body>>,
    /// What the engine took, in s.
    seconds: f64,
}

/// A step of a scene, with its cues.
fn step_scene(scene: &mut BuiltScene, dt: f32) -> Result<tautline::StepReport, tautline_scene::Error> {
    if !scene.cues.is_empty() {
        scene.follow_cues()?;
    }
    Ok(scene.world.step(dt)?)
}

/// How two bodies touched in the last step.
#[pyclass(frozen, get_all, module = "tautline")]
pub(crate) struct ContactEvent {
    /// "began", "persists" or "ended".
    kind: &'static str,
    /// The one that was added first comes first.
    bodies: (Py<Body>, Py<Body>),
    /// Unit, from the first to the second.
    normal: [f32; 3],
    /// In m.
    point: [f32; 3],
    /// Of the whole step, in N s.
    impulse: f32,
    /// In m/s, if they began to touch.
    approach_speed: f32,
}

#[pymethods]
impl World {
    /// Advances by ``dt`` seconds, or by its own. Other threads of Python go on meanwhile. A scene's cues are followed where
    /// steps are as long as its own.
    #[pyo3(signature = (dt=None))]
    fn step(slf: &Bound<'_, Self>, dt: Option<f32>) -> Outcome<StepReport> {
        let (py, world) = (slf.py(), slf.get());
        let (report, seconds) = py.detach(|| {
            threads::run(|| {
                let mut state = world.lock_detached();
                let dt = dt.unwrap_or(state.scene.dt);
                let start = Instant::now();
                let report = step_scene(&mut state.scene, dt);
                (report, start.elapsed().as_secs_f64())
            })
        });
        let report = report?;
        let faults = report.faults.iter().map(|fault| Py::new(py, Body::new(slf, fault.body)));
        Ok(StepReport {
            pairs: report.pairs,
            contacts: report.contacts,
            visits: report.visits,
            relaxations: report.relaxations,
            awake_bodies: report.awake_bodies,
            faults: faults.collect::<PyResult<_>>()?,
            seconds,
        })
    }

    /// Takes steps for so many seconds, or as long as the scene says. Ctrl-C stops it; the world is then where it came to.
    ///
    /// Args:
    ///     seconds: How long, in s.
    ///     dt: The time of a step, in s, if it is not the world's.
    ///     record: Whether what there is to see is kept, or figures only.
    ///     every: Keep one step in so many.
    ///     progress: True for a bar of tqdm, or a function of (steps done, steps).
    #[pyo3(signature = (seconds=None, *, dt=None, record=true, every=None, progress=None))]
    fn run(
        slf: &Bound<'_, Self>,
        seconds: Option<f32>,
        dt: Option<f32>,
        record: bool,
        every: Option<u32>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> Outcome<Recording> {
        let (py, world) = (slf.py(), slf.get());
        let plan = Plan::new(world, py, seconds, dt, every)?;
        let mut tape = Tape::new(world, py, &plan, record)?;
        let progress = match progress {
            Some(progress) => py.import("tautline._progress")?.call_method1("reporter", (progress,))?,
            None => py.None().into_bound(py),
        };
        while tape.steps < plan.steps {
            py.detach(|| threads::run(|| tape.turn(world, &plan)))?;
            py.check_signals()?;
            if !progress.is_none() {
                progress.call1((tape.steps, plan.steps))?;
            }
        }
        Ok(tape.finish(world, py))
    }

    /// What it looks like now: a recording of one frame.
    fn look_now(slf: &Bound<'_, Self>) -> Outcome<Recording> {
        let (py, world) = (slf.py(), slf.get());
        let (dt, every) = world.look(py, |scene| (scene.dt, scene.record_every));
        Ok(Tape::new(world, py, &Plan { dt, steps: 0, every }, true)?.finish(world, py))
    }

    /// What a notebook shows.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("tautline._show")?.call_method1("html", (Self::look_now(slf)?,))
    }

    /// Which bodies touched in the last step, out of the pairs of which one reports its contacts.
    #[getter]
    fn contact_events(slf: &Bound<'_, Self>) -> Outcome<Vec<ContactEvent>> {
        let py = slf.py();
        let events = slf.get().look(py, |scene| scene.world.contact_events().to_vec());
        let body = |handle: BodyHandle| Py::new(py, Body::new(slf, handle));
        let told = events.into_iter().map(|event| {
            let kind = match event.kind {
                ContactEventKind::Began => "began",
                ContactEventKind::Persists => "persists",
                ContactEventKind::Ended => "ended",
            };
            let [a, b] = event.bodies;
            Ok(ContactEvent {
                kind,
                bodies: (body(a)?, body(b)?),
                normal: event.normal.to_array(),
                point: event.point.to_array(),
                impulse: event.impulse,
                approach_speed: event.approach_speed,
            })
        });
        told.collect()
    }

    /// The joints that broke in the last step.
    #[getter]
    fn broken_joints(slf: &Bound<'_, Self>) -> Vec<Joint> {
        let events = slf.get().look(slf.py(), |scene| scene.world.joint_events().to_vec());
        let broke = |event| match event {
            tautline::JointEvent::Broke { joint } => Some(Joint::new(slf, joint)),
            _ => None,
        };
        events.into_iter().filter_map(broke).collect()
    }
}

/// How a run goes.
struct Plan {
    dt: f32,
    steps: u64,
    /// A frame is kept after so many steps.
    every: u32,
}

impl Plan {
    fn new(
        world: &World,
        py: Python<'_>,
        seconds: Option<f32>,
        dt: Option<f32>,
        every: Option<u32>,
    ) -> Outcome<Self> {
        let own = world.look(py, |scene| (scene.seconds, scene.dt, scene.record_every));
        let (seconds, dt, every) = (seconds.unwrap_or(own.0), dt.unwrap_or(own.1), every.unwrap_or(own.2));
        if !(1e-7..=1.0).contains(&dt) {
            return Err(Failure::invalid("dt", format!("{dt} is not a time from 1e-7 to 1 (s)")));
        }
        let steps = (seconds / dt).round();
        if !(seconds > 0.0 && steps <= MOST_STEPS) {
            let problem = format!("{seconds} is not a time above 0 (s) of at most {MOST_STEPS} steps");
            return Err(Failure::invalid("seconds", problem));
        }
        if every == 0 {
            return Err(Failure::invalid("every", "0 is not a whole number above 0"));
        }
        Ok(Self { dt, steps: (steps as u64).max(1), every })
    }
}

/// As many as a scene document may ask for.
const MOST_STEPS: f32 = tautline_scene::document::limits::STEPS;

/// What is kept of a run.
struct Tape {
    steps: u64,
    recorder: Option<Recorder>,
    series: Series,
}

impl Tape {
    fn new(world: &World, py: Python<'_>, plan: &Plan, record: bool) -> Outcome<Self> {
        let mut state = world.lock(py);
        let scene = &mut state.scene;
        scene.draw_walls();
        let frame_rate = 1.0 / (plan.dt * plan.every as f32);
        let recorder =
            record.then(|| Recorder::new(&scene.name, frame_rate, &scene.parts, &scene.world)).transpose();
        drop(state);
        let mut tape = Self { steps: 0, recorder: recorder?, series: Series::default() };
        let noted = tape.note(&world.lock(py).scene, 0);
        noted?;
        Ok(tape)
    }

    /// Takes steps for a while.
    fn turn(&mut self, world: &World, plan: &Plan) -> Result<(), tautline_scene::Error> {
        let start = Instant::now();
        let mut state = world.lock_detached();
        while self.steps < plan.steps && start.elapsed() < TURN {
            let begin = Instant::now();
            let report = step_scene(&mut state.scene, plan.dt)?;
            self.series.engine_seconds += begin.elapsed().as_secs_f64();
            self.steps += 1;
            self.series.faults += report.faults.len();
            if self.steps.is_multiple_of(u64::from(plan.every)) || self.steps == plan.steps {
                self.series.relaxations.push(report.relaxations);
                let is_frame = self.steps.is_multiple_of(u64::from(plan.every));
                self.keep(&state.scene, report.contacts, is_frame)?;
            }
        }
        Ok(())
    }

    fn note(&mut self, scene: &BuiltScene, contacts: usize) -> Result<(), tautline_scene::Error> {
        self.series.relaxations.push(0);
        self.keep(scene, contacts, true)
    }

    fn keep(
        &mut self,
        scene: &BuiltScene,
        contacts: usize,
        is_frame: bool,
    ) -> Result<(), tautline_scene::Error> {
        if let (Some(recorder), true) = (&mut self.recorder, is_frame) {
            recorder.record(&scene.world)?;
        }
        self.series.note(&scene.world, contacts);
        Ok(())
    }

    fn finish(self, world: &World, py: Python<'_>) -> Recording {
        let state = world.lock(py);
        let scene = &state.scene;
        let (camera, name) = (scene.camera, scene.name.clone());
        let hash = format!("{:016x}", scene.world.state_hash());
        drop(state);
        Recording::new(self.recorder.map(Recorder::finish), self.series, camera, name, hash, self.steps)
    }
}

/// Many worlds that are stepped at once, on all cores. What they are stacked from must be of equal size.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Batch {
    worlds: Vec<Py<World>>,
}

impl Batch {
    /// Does something with all worlds, side by side. They are locked in the order of their addresses, so that two
    /// batches never wait for each other.
    fn all<T: Send>(&self, py: Python<'_>, task: impl Fn(&mut BuiltScene) -> T + Send + Sync) -> Vec<T> {
        let worlds: Vec<&World> = self.worlds.iter().map(Py::get).collect();
        py.detach(|| {
            let mut order: Vec<usize> = (0..worlds.len()).collect();
            order.sort_by_key(|&i| std::ptr::from_ref(worlds[i]) as usize);
            let mut guards: Vec<_> = order.iter().map(|&i| (i, worlds[i].lock_detached())).collect();
            guards.sort_by_key(|(i, _)| *i);
            let mut scenes: Vec<&mut BuiltScene> =
                guards.iter_mut().map(|(_, state)| &mut state.scene).collect();
            threads::run(|| scenes.par_iter_mut().with_max_len(1).map(|scene| task(scene)).collect())
        })
    }

    /// Rows of equally many vectors for each world, stacked.
    fn stacked<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&tautline::World) -> Vec<tautline::Vec3> + Send + Sync,
    ) -> Outcome<Bound<'py, PyArray3<f32>>> {
        let rows = self.all(py, |scene| of(&scene.world));
        let count = rows.first().map_or(0, Vec::len);
        if let Some((i, row)) = rows.iter().enumerate().find(|(_, row)| row.len() != count) {
            let problem = format!("it has {} where the first has {count}: they do not stack", row.len());
            return Err(Failure::invalid(&format!("worlds[{i}]"), problem));
        }
        let flat: Vec<f32> = rows.iter().flatten().flat_map(|vector| vector.to_array()).collect();
        Ok(PyArray1::from_vec(py, flat).reshape([rows.len(), count, 3])?)
    }
}

#[pymethods]
impl Batch {
    #[new]
    fn new(worlds: Vec<Py<World>>) -> Outcome<Self> {
        for (i, world) in worlds.iter().enumerate() {
            if worlds[..i].iter().any(|other| other.is(world)) {
                let problem = "it is in the batch already: give a copy";
                return Err(Failure::invalid(&format!("worlds[{i}]"), problem));
            }
        }
        Ok(Self { worlds })
    }

    #[getter]
    fn worlds(&self, py: Python<'_>) -> Vec<Py<World>> {
        self.worlds.iter().map(|world| world.clone_ref(py)).collect()
    }

    fn __len__(&self) -> usize {
        self.worlds.len()
    }

    /// Advances all worlds by ``count`` steps.
    #[pyo3(signature = (count=1, *, dt=None))]
    fn step(&self, py: Python<'_>, count: u64, dt: Option<f32>) -> Outcome<()> {
        for _ in 0..count {
            let stepped = self.all(py, |scene| step_scene(scene, dt.unwrap_or(scene.dt)).map(drop));
            stepped.into_iter().collect::<Result<Vec<()>, _>>()?;
            py.check_signals()?;
        }
        Ok(())
    }

    /// Of all particles, in m: (worlds, particles, 3).
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray3<f32>>> {
        self.stacked(py, |world| world.positions().to_vec())
    }

    /// Centres of mass of all bodies, in m: (worlds, bodies, 3).
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray3<f32>>> {
        self.stacked(py, |world| of_bodies(world, |body| body.center_of_mass()))
    }

    /// Of all bodies, in m/s: (worlds, bodies, 3).
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray3<f32>>> {
        self.stacked(py, |world| of_bodies(world, |body| body.velocity()))
    }

    /// Kinetic and potential energy, in J: (worlds, 2).
    #[getter]
    fn energies<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<f64>>> {
        let energies = self.all(py, |scene| [scene.world.kinetic_energy(), scene.world.potential_energy()]);
        Ok(PyArray1::from_slice(py, energies.as_flattened()).reshape([energies.len(), 2])?)
    }

    /// The hash of each world.
    #[getter]
    fn state_hashes(&self, py: Python<'_>) -> Vec<String> {
        self.all(py, |scene| format!("{:016x}", scene.world.state_hash()))
    }
}

fn of_bodies(
    world: &tautline::World,
    of: impl Fn(tautline::BodyView<'_>) -> tautline::Vec3,
) -> Vec<tautline::Vec3> {
    world.bodies().filter_map(|handle| world.body(handle).ok().map(&of)).collect()
}
