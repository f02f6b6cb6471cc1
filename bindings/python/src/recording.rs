//! `Recording`: what a run looked like, and its figures over time.

use std::ffi::OsString;
use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tautline_scene::export::{self, Format, Options};
use tautline_scene::recording::{Motion, Track};
use tautline_scene::render::{self, Camera};

use crate::arrays;
use crate::errors::{Failure, Outcome};
use crate::threads;

/// Figures at the start, at every frame and at the end.
#[derive(Default)]
pub(crate) struct Series {
    times: Vec<f64>,
    kinetic: Vec<f64>,
    potential: Vec<f64>,
    contacts: Vec<u64>,
    strains: Vec<f32>,
    pub(crate) relaxations: Vec<u64>,
    pub(crate) faults: usize,
    /// What the engine took for all steps, in s.
    pub(crate) engine_seconds: f64,
}

impl Series {
    pub(crate) fn note(&mut self, world: &tautline::World, contacts: usize) {
        self.times.push(world.time());
        self.kinetic.push(world.kinetic_energy());
        self.potential.push(world.potential_energy());
        self.contacts.push(contacts as u64);
        self.strains.push(world.strain().max);
    }
}

/// What a run looked like, and its figures over time.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Recording {
    motion: Option<tautline_scene::recording::Recording>,
    series: Series,
    camera: Option<Camera>,
    name: String,
    state_hash: String,
    steps: u64,
}

impl Recording {
    pub(crate) fn new(
        motion: Option<tautline_scene::recording::Recording>,
        series: Series,
        camera: Option<Camera>,
        name: String,
        state_hash: String,
        steps: u64,
    ) -> Self {
        Self { motion, series, camera, name, state_hash, steps }
    }

    fn motion(&self) -> Outcome<&tautline_scene::recording::Recording> {
        let problem = "the run was not recorded: run it with record=True";
        self.motion.as_ref().ok_or_else(|| Failure::invalid("record", problem))
    }

    fn track(&self, name: &str) -> Outcome<&Track> {
        let motion = self.motion()?;
        let known = || motion.tracks.iter().map(|track| track.name.as_str());
        let found = motion.tracks.iter().find(|track| track.name == name);
        found.ok_or_else(|| {
            let names = known().collect::<Vec<_>>().join(", ");
            Failure::invalid("track", format!("there is no track {name:?}; there are: {names}"))
        })
    }

    fn options(&self, size: Option<(u32, u32)>, frame: Option<usize>, frame_rate: f32) -> Options {
        let (width, height) = size.unwrap_or((640, 480));
        let picture = render::Settings { width, height, camera: self.camera, ..render::Settings::default() };
        Options { picture, gif_frame_rate: frame_rate, png_frame: frame }
    }
}

#[pymethods]
impl Recording {
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// Of the world at the end of the run.
    #[getter]
    fn state_hash(&self) -> &str {
        &self.state_hash
    }

    /// How many the run took.
    #[getter]
    fn steps(&self) -> u64 {
        self.steps
    }

    /// What the engine took for all steps, in s.
    #[getter]
    fn engine_seconds(&self) -> f64 {
        self.series.engine_seconds
    }

    /// How many bodies turned non-finite and were frozen.
    #[getter]
    fn faults(&self) -> usize {
        self.series.faults
    }

    /// Frames in a second.
    #[getter]
    fn frame_rate(&self) -> Outcome<f32> {
        Ok(self.motion()?.frame_rate)
    }

    #[getter]
    fn frame_count(&self) -> usize {
        self.motion.as_ref().map_or(0, |motion| motion.frame_count())
    }

    /// The names of what there is to see.
    #[getter]
    fn tracks(&self) -> Outcome<Vec<&str>> {
        Ok(self.motion()?.tracks.iter().map(|track| track.name.as_str()).collect())
    }

    /// World positions of a track's vertices, in m: (frames, v, 3); one frame of what never moves.
    fn positions<'py>(&self, py: Python<'py>, track: &str) -> Outcome<Bound<'py, PyArray3<f32>>> {
        let track = self.track(track)?;
        let frames = match &track.motion {
            Motion::Still => 1,
            _ => self.frame_count(),
        };
        let flat: Vec<f32> = (0..frames)
            .flat_map(|frame| track.positions_at(frame).into_owned())
            .flat_map(|position| position.to_array())
            .collect();
        Ok(PyArray1::from_vec(py, flat).reshape([frames, track.mesh.positions.len(), 3])?)
    }

    /// Position (m) and quaternion x, y, z, w of a rigid track: (frames, 7); None of other tracks.
    fn poses<'py>(&self, py: Python<'py>, track: &str) -> Outcome<Option<Bound<'py, PyArray2<f32>>>> {
        let Motion::Rigid(poses) = &self.track(track)?.motion else { return Ok(None) };
        let flat: Vec<f32> = poses
            .iter()
            .flat_map(|(position, rotation)| position.to_array().into_iter().chain(rotation.to_array()))
            .collect();
        Ok(Some(PyArray1::from_vec(py, flat).reshape([poses.len(), 7])?))
    }

    /// The vertices of a track's mesh, in m: of a rigid one in its own frame, of others at the first frame.
    fn vertices<'py>(&self, py: Python<'py>, track: &str) -> Outcome<Bound<'py, PyArray2<f32>>> {
        arrays::vectors(py, &self.track(track)?.mesh.positions)
    }

    /// The triangles of a track's mesh: (t, 3).
    fn triangles<'py>(&self, py: Python<'py>, track: &str) -> Outcome<Bound<'py, PyArray2<u32>>> {
        arrays::corners(py, &self.track(track)?.mesh.triangles)
    }

    /// sRGB, 0 to 255.
    fn color(&self, track: &str) -> Outcome<(u8, u8, u8)> {
        let [red, green, blue] = self.track(track)?.color;
        Ok((red, green, blue))
    }

    /// Whether a track is seen from both sides.
    fn is_sheet(&self, track: &str) -> Outcome<bool> {
        Ok(self.track(track)?.surface == tautline_scene::recording::Surface::Sheet)
    }

    /// Figures at the start, at every frame and at the end, by name.
    #[getter]
    fn series<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let Series { times, kinetic, potential, contacts, strains, relaxations, .. } = &self.series;
        let series = PyDict::new(py);
        series.set_item("time", PyArray1::from_slice(py, times))?;
        series.set_item("kinetic_energy", PyArray1::from_slice(py, kinetic))?;
        series.set_item("potential_energy", PyArray1::from_slice(py, potential))?;
        series.set_item("contacts", PyArray1::from_slice(py, contacts))?;
        series.set_item("max_strain", PyArray1::from_slice(py, strains))?;
        series.set_item("relaxations", PyArray1::from_slice(py, relaxations))?;
        Ok(series)
    }

    /// Writes what the engine writes by itself; `ffmpeg` is the program for `.mp4`.
    #[pyo3(signature = (path, *, size=None, frame=None, frame_rate=30.0, ffmpeg=None))]
    fn _write(
        &self,
        py: Python<'_>,
        path: PathBuf,
        size: Option<(u32, u32)>,
        frame: Option<usize>,
        frame_rate: f32,
        ffmpeg: Option<OsString>,
    ) -> Outcome<()> {
        let motion = self.motion()?;
        let options = self.options(size, frame, frame_rate);
        let write = || match (Format::of(&path)?, ffmpeg) {
            (Format::Mp4, Some(program)) => {
                export::write_mp4(motion, &path, options.picture, &program, &mut |_, _| {})
            }
            _ => export::write(motion, &path, &options, &mut |_, _| {}),
        };
        Ok(py.detach(|| threads::run(write))?)
    }

    /// Writes it in the format that the extension names.
    ///
    /// Args:
    ///     path: ``.gif``, ``.mp4``, ``.png``: pictures; ``.glb``, ``.usd``, ``.usda``, ``.usdc``: scenes with motion;
    ///         ``.html``: a page that plays it, in itself;
    ///         ``.pc2``: a point cache, with its mesh as ``.obj`` beside it; ``.obj``, ``.ply``: a mesh for each frame;
    ///         ``.npz``: arrays.
    ///     size: Width and height of pictures, in pixels; (640, 480) if absent.
    ///     frame: Of a ``.png``; the last if absent.
    ///     frame_rate: The most pictures a second in a ``.gif``, 1 to 50.
    #[pyo3(signature = (path, **options))]
    fn save(slf: &Bound<'_, Self>, path: PathBuf, options: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        slf.py().import("tautline._save")?.call_method("save", (slf, path), options)?;
        Ok(())
    }

    /// Energy, contacts and strain over time, as a figure of Matplotlib.
    fn plot<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("tautline._plot")?.call_method1("plot", (slf,))
    }

    /// What a notebook shows.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("tautline._show")?.call_method1("html", (slf,))
    }

    fn __repr__(&self) -> String {
        let frames = self.frame_count();
        format!("<tautline.Recording {:?}: {} steps, {frames} frames>", self.name, self.steps)
    }
}
