//! `World`: what is in it, how it is changed, and its state as a whole.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::{PyBytes, PyTuple, PyType};
use tautline::BodyHandle;
use tautline_scene::build::BuiltScene;

use crate::args::{Color, V3};
use crate::bodies::Addition;
use crate::body::Body;
use crate::errors::{Failure, Outcome};
use crate::settings::Settings;
use crate::views::{self, Keep, Sight};

/// Everything that is simulated together.
///
/// Args:
///     settings: How.
///     name: What its recordings are called.
///     dt: The time of a step, in s.
#[pyclass(frozen, weakref, module = "tautline")]
pub(crate) struct World {
    state: Mutex<State>,
}

/// What a lock guards.
pub(crate) struct State {
    pub(crate) scene: BuiltScene,
    /// Where the scene goes if a view looks at it when it is restructured.
    keep: Arc<Keep>,
}

impl World {
    pub(crate) fn around(scene: BuiltScene) -> Self {
        Self { state: Mutex::new(State { scene, keep: Arc::default() }) }
    }

    /// Its state, when no other thread has it. Nothing of Python may be called while it is held.
    pub(crate) fn lock(&self, py: Python<'_>) -> MutexGuard<'_, State> {
        self.state.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner)
    }

    /// The same where Python is not held.
    pub(crate) fn lock_detached(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Looks at the scene.
    pub(crate) fn look<T>(&self, py: Python<'_>, at: impl FnOnce(&BuiltScene) -> T) -> T {
        at(&self.lock(py).scene)
    }

    /// Changes the scene, but for what views look at: no body comes or goes.
    pub(crate) fn change<T>(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut tautline::World) -> Result<T, tautline::Error>,
    ) -> Outcome<T> {
        let changed = change(&mut self.lock(py).scene.world);
        Ok(changed?)
    }

    /// Changes which bodies there are. What views look at stays as it is, where it is: see [`crate::views`].
    fn restructure<T>(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut BuiltScene) -> Result<T, tautline::Error>,
    ) -> Outcome<T> {
        let mut guard = self.lock(py);
        let state = &mut *guard;
        if Arc::strong_count(&state.keep) == 1 {
            let changed = change(&mut state.scene);
            drop(guard);
            return Ok(changed?);
        }
        let mut fresh = state.scene.clone();
        let changed = change(&mut fresh);
        if changed.is_ok() {
            let seen = std::mem::replace(&mut state.scene, fresh);
            // Empty until now: a keep is filled once, and left to its viewers.
            let _ = std::mem::take(&mut state.keep).set(seen);
        }
        drop(guard);
        Ok(changed?)
    }

    /// What a view of a part of the world's memory needs.
    pub(crate) fn sight<S>(
        &self,
        py: Python<'_>,
        of: impl FnOnce(&tautline::World) -> Result<&[S], tautline::Error>,
    ) -> Outcome<Sight<S>> {
        let state = self.lock(py);
        let sight = of(&state.scene.world).map(|slice| Sight::new(slice, &state.keep));
        drop(state);
        Ok(sight?)
    }
}

#[pymethods]
impl World {
    #[new]
    #[pyo3(signature = (settings=None, *, name="world".to_owned(), dt=1.0 / 60.0))]
    fn new(settings: Option<PyRef<'_, Settings>>, name: String, dt: f32) -> Outcome<Self> {
        let settings = settings.map_or_else(tautline::Settings::default, |settings| settings.0.clone());
        if !(1e-7..=1.0).contains(&dt) {
            return Err(Failure::invalid("dt", format!("{dt} is not a time from 1e-7 to 1 (s)")));
        }
        let mut scene = BuiltScene::around(tautline::World::new(settings)?)?;
        (scene.name, scene.dt) = (name, dt);
        Ok(Self::around(scene))
    }

    /// Adds a body; its name is made up if absent, its colour (sRGB, 0 to 255) chosen.
    #[pyo3(signature = (body, *, name=None, color=None))]
    fn add(
        slf: &Bound<'_, Self>,
        body: &Bound<'_, PyAny>,
        name: Option<String>,
        color: Option<Color>,
    ) -> Outcome<Body> {
        let Addition { body, look } = Addition::of(body)?;
        let handle = slf.get().restructure(slf.py(), |scene| {
            if let Some(name) = &name
                && scene.parts.iter().any(|part| part.name == *name)
            {
                let problem = format!("{name:?} is the name of another body");
                return Err(tautline::Error::Invalid { field: "name".into(), problem });
            }
            let handle = scene.world.add(body)?;
            scene.add_part(handle, name, color, Some(look))?;
            Ok(handle)
        })?;
        Ok(Body::new(slf, handle))
    }

    /// Removes a body with its joints and attachments.
    fn remove(slf: &Bound<'_, Self>, body: PyRef<'_, Body>) -> Outcome<()> {
        let handle = body.handle_in(slf)?;
        slf.get().restructure(slf.py(), |scene| {
            scene.world.remove(handle)?;
            scene.cues.retain(|cue| cue.body != handle);
            scene.parts.retain(|part| part.body != handle);
            Ok(())
        })
    }

    /// All bodies, in the order they were added.
    #[getter]
    fn bodies(slf: &Bound<'_, Self>) -> Vec<Body> {
        let handles: Vec<BodyHandle> = slf.get().look(slf.py(), |scene| scene.world.bodies().collect());
        handles.into_iter().map(|handle| Body::new(slf, handle)).collect()
    }

    /// A body by its name.
    fn __getitem__(slf: &Bound<'_, Self>, name: &str) -> Outcome<Body> {
        let find =
            |scene: &BuiltScene| scene.parts.iter().find(|part| part.name == name).map(|part| part.body);
        let found = slf.get().look(slf.py(), find);
        let missing = || pyo3::exceptions::PyKeyError::new_err(name.to_owned());
        Ok(Body::new(slf, found.ok_or_else(missing)?))
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.look(py, |scene| scene.world.bodies().len())
    }

    #[getter]
    fn settings(&self, py: Python<'_>) -> Settings {
        self.look(py, |scene| Settings(scene.world.settings().clone()))
    }

    #[setter]
    fn set_settings(&self, py: Python<'_>, settings: PyRef<'_, Settings>) -> Outcome<()> {
        let settings = settings.0.clone();
        self.change(py, |world| world.set_settings(settings))
    }

    /// Velocity of the air, in m/s, from the next step on.
    fn set_wind(&self, py: Python<'_>, wind: V3) -> Outcome<()> {
        self.change(py, |world| world.set_wind(wind.0))
    }

    #[getter]
    fn name(&self, py: Python<'_>) -> String {
        self.look(py, |scene| scene.name.clone())
    }

    /// The simulated time, in s.
    #[getter]
    fn time(&self, py: Python<'_>) -> f64 {
        self.look(py, |scene| scene.world.time())
    }

    /// The time of a step, in s, unless told otherwise.
    #[getter]
    fn dt(&self, py: Python<'_>) -> f32 {
        self.look(py, |scene| scene.dt)
    }

    /// Positions of all particles, in m: a read-only view (n, 3) of the engine's memory, which changes with every step.
    ///
    /// When a body is added or removed, or the world restored, views from before stay as they were: ask again.
    #[getter]
    fn positions<'py>(slf: &Bound<'py, Self>) -> Outcome<Bound<'py, PyArray2<f32>>> {
        let sight = slf.get().sight(slf.py(), |world| Ok(world.positions()))?;
        Ok(views::of_vectors(slf, &sight)?)
    }

    /// Where the engine has the positions.
    #[getter]
    fn _positions_address(&self, py: Python<'_>) -> usize {
        self.look(py, |scene| scene.world.positions().as_ptr() as usize)
    }

    /// A hash of everything that moves, 16 hexadecimal digits: equal states have equal hashes, on every platform.
    #[getter]
    fn state_hash(&self, py: Python<'_>) -> String {
        format!("{:016x}", self.look(py, |scene| scene.world.state_hash()))
    }

    /// In J.
    #[getter]
    fn kinetic_energy(&self, py: Python<'_>) -> f64 {
        self.look(py, |scene| scene.world.kinetic_energy())
    }

    /// In J, 0 at the origin.
    #[getter]
    fn potential_energy(&self, py: Python<'_>) -> f64 {
        self.look(py, |scene| scene.world.potential_energy())
    }

    /// In kg m/s.
    #[getter]
    fn momentum(&self, py: Python<'_>) -> [f64; 3] {
        self.look(py, |scene| scene.world.momentum().to_array())
    }

    /// About the origin, in kg m²/s.
    #[getter]
    fn angular_momentum(&self, py: Python<'_>) -> [f64; 3] {
        self.look(py, |scene| scene.world.angular_momentum().to_array())
    }

    /// How far sticks are off their lengths, as shares: (largest, mean).
    #[getter]
    fn strain(&self, py: Python<'_>) -> (f32, f32) {
        let strain = self.look(py, |scene| scene.world.strain());
        (strain.max, strain.mean)
    }

    /// How deep bodies are in each other, in m: (deepest, mean over the pairs that penetrate, how many those are).
    #[getter]
    fn penetration(&self, py: Python<'_>) -> (f32, f32, usize) {
        let depth = self.look(py, |scene| scene.world.penetration());
        (depth.max, depth.mean, depth.count)
    }

    /// The whole world as bytes: it goes on from them with the same bits, on any platform.
    fn snapshot<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let bytes = self.look(py, |scene| scene.world.snapshot());
        PyBytes::new(py, &bytes)
    }

    /// Becomes the world that a snapshot was taken of. Bodies that both have keep their names and looks.
    fn restore(&self, py: Python<'_>, snapshot: &[u8]) -> Outcome<()> {
        let restored = tautline::World::restore(snapshot)?;
        self.restructure(py, |scene| {
            scene.world = restored;
            scene.sort_parts()
        })
    }

    /// A world from a snapshot.
    #[classmethod]
    #[pyo3(signature = (snapshot, *, dt=1.0 / 60.0))]
    fn from_snapshot(_class: &Bound<'_, PyType>, snapshot: &[u8], dt: f32) -> Outcome<Self> {
        let mut scene = BuiltScene::around(tautline::World::restore(snapshot)?)?;
        scene.dt = dt;
        Ok(Self::around(scene))
    }

    /// Another world in the same state.
    fn copy(&self, py: Python<'_>) -> Self {
        Self::around(self.look(py, Clone::clone))
    }

    fn __copy__(&self, py: Python<'_>) -> Self {
        self.copy(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyAny>) -> Self {
        self.copy(py)
    }

    /// Pickled as a snapshot: names and looks are made anew.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let restore = slf.get_type().getattr("from_snapshot")?;
        Ok((restore, PyTuple::new(py, [slf.get().snapshot(py)])?))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        self.look(py, |scene| {
            let (bodies, particles) = (scene.world.bodies().len(), scene.world.positions().len());
            let time = scene.world.time();
            format!("<tautline.World: {bodies} bodies, {particles} particles, {time:.3} s>")
        })
    }
}
