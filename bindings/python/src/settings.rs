//! `Settings`.

use pyo3::prelude::*;
use tautline::{ClothSolver, Sleep};

use crate::args::V3;
use crate::errors::Outcome;

/// How a world is simulated.
///
/// Args:
///     gravity: In m/s²; (0, -9.81, 0) if absent.
///     substeps: In a step, 1 to 1000.
///     separation_speed: At most so fast overlapping bodies are moved apart, in m/s; 3 if absent, None: at once.
///     damping: Rate at which free motion dies out, in 1/s.
///     wind: Velocity of the air, in m/s; it acts on cloth with ``drag``.
///     air_density: In kg/m³.
///     sleep: A body slower than so many m/s for so many s falls asleep; (0.03, 0.5) if absent, None: never.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Settings(pub(crate) tautline::Settings);

#[pymethods]
impl Settings {
    #[new]
    #[pyo3(signature = (*, gravity=None, substeps=8, separation_speed=Some(3.0), damping=0.0, wind=None, air_density=1.2, sleep=Some((0.03, 0.5))))]
    fn new(
        gravity: Option<V3>,
        substeps: u32,
        separation_speed: Option<f32>,
        damping: f32,
        wind: Option<V3>,
        air_density: f32,
        sleep: Option<(f32, f32)>,
    ) -> Outcome<Self> {
        let default = tautline::Settings::default();
        let settings = tautline::Settings {
            gravity: gravity.map_or(default.gravity, |gravity| gravity.0),
            substeps,
            separation_speed,
            damping,
            wind: wind.map_or(default.wind, |wind| wind.0),
            air_density,
            sleep: sleep.map(|(speed, seconds)| Sleep { speed, seconds }),
            ..default
        };
        settings.validate()?;
        Ok(Self(settings))
    }

    /// The published system's own: one substep, ten sweeps, a tolerance of 1 %.
    #[staticmethod]
    fn paper() -> Self {
        Self(tautline::Settings::paper())
    }

    #[getter]
    fn gravity(&self) -> [f32; 3] {
        self.0.gravity.to_array()
    }

    #[getter]
    fn substeps(&self) -> u32 {
        self.0.substeps
    }

    #[getter]
    fn separation_speed(&self) -> Option<f32> {
        self.0.separation_speed
    }

    #[getter]
    fn damping(&self) -> f32 {
        self.0.damping
    }

    #[getter]
    fn wind(&self) -> [f32; 3] {
        self.0.wind.to_array()
    }

    #[getter]
    fn air_density(&self) -> f32 {
        self.0.air_density
    }

    #[getter]
    fn sleep(&self) -> Option<(f32, f32)> {
        self.0.sleep.map(|sleep| (sleep.speed, sleep.seconds))
    }

    /// Whether cloth and rope are moved by the paper's solver.
    #[getter]
    fn is_paper(&self) -> bool {
        self.0.cloth == ClothSolver::Paper
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __repr__(&self) -> String {
        let (gravity, substeps) = (self.gravity(), self.0.substeps);
        format!("Settings(gravity={gravity:?}, substeps={substeps}, …)")
    }
}
