//! `Scene`: scene documents and the named scenes.

use std::path::PathBuf;

use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use tautline_scene::document::{self, Format};
use tautline_scene::mesh_file::{self, Limits};
use tautline_scene::{load, registry};

use crate::arrays;
use crate::errors::{Failure, Outcome};
use crate::world::World;

/// A scene document, whose values have been judged.
///
/// Args:
///     document: A dict as the document's JSON has it; NumPy's numbers and arrays will do.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Scene(document::Scene);

impl Scene {
    fn json(&self) -> Outcome<String> {
        let text = serde_json::to_string(&self.0).map_err(|error| Failure::invalid("scene", error))?;
        Ok(text)
    }
}

#[pymethods]
impl Scene {
    /// From a dict as the document's JSON has it. Values are judged at once.
    #[new]
    fn new(document: &Bound<'_, PyAny>) -> Outcome<Self> {
        let dumps = document.py().import("tautline._documents")?.getattr("dumps")?;
        Self::from_json(&dumps.call1((document,))?.extract::<String>()?)
    }

    #[staticmethod]
    fn from_json(text: &str) -> Outcome<Self> {
        let scene = document::parse(text, Format::Json)?;
        scene.check()?;
        Ok(Self(scene))
    }

    /// From a file: .json, .json5 or .toml, with the mesh files it names.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> Outcome<Self> {
        Ok(Self(py.detach(|| load(&path))?))
    }

    /// A named scene, see ``scenes``, with its parameters.
    #[staticmethod]
    #[pyo3(signature = (name, /, **parameters))]
    fn named(name: &str, parameters: Option<&Bound<'_, PyDict>>) -> Outcome<Self> {
        let named = registry::find(name)?;
        let mut values = named.defaults();
        for (key, value) in parameters.into_iter().flatten() {
            let key = key.extract::<String>()?;
            let value: f64 =
                value.extract().map_err(|_: PyErr| Failure::invalid(&key, "expected a number"))?;
            values.set(&key, value)?;
        }
        Ok(Self(named.document(&values)))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// How long it runs, in s.
    #[getter]
    fn seconds(&self) -> f32 {
        self.0.seconds
    }

    fn to_json(&self) -> Outcome<String> {
        self.json()
    }

    /// The document as a dict, to be edited and given to ``Scene``.
    fn to_dict<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyAny>> {
        Ok(py.import("json")?.call_method1("loads", (self.json()?,))?)
    }

    /// Makes the world that it describes.
    fn build(&self, py: Python<'_>) -> Outcome<World> {
        Ok(World::around(py.detach(|| self.0.build())?))
    }

    /// Makes its world and runs that: see ``World.run``.
    #[pyo3(signature = (seconds=None, **options))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        seconds: Option<f32>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        Bound::new(py, self.build(py)?)?.call_method("run", (seconds,), options)
    }

    /// Pickled as JSON.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Outcome<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let make = slf.get_type().getattr("from_json")?;
        Ok((make, PyTuple::new(slf.py(), [slf.get().json()?])?))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __repr__(&self) -> String {
        format!("<tautline.Scene {:?}: {} bodies, {} s>", self.0.name, self.0.bodies.len(), self.0.seconds)
    }
}

/// The named scenes.
#[pyfunction]
pub(crate) fn scenes(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let describe = |scene: &registry::NamedScene| {
        let parameters = PyDict::new(py);
        for parameter in scene.parameters {
            let about = PyDict::new(py);
            about.set_item("description", parameter.description)?;
            about.set_item("default", parameter.default)?;
            about.set_item("min", parameter.min)?;
            about.set_item("max", parameter.max)?;
            parameters.set_item(parameter.name, about)?;
        }
        let about = PyDict::new(py);
        about.set_item("name", scene.name)?;
        about.set_item("description", scene.description)?;
        about.set_item("parameters", parameters)?;
        Ok(about)
    };
    registry::scenes().iter().map(describe).collect()
}

type MeshArrays<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray2<u32>>);

/// The positions (n, 3) in m and triangles (m, 3) of a mesh file: ``.obj``, ``.stl``, ``.ply``, ``.gltf`` or ``.glb``.
#[pyfunction]
pub(crate) fn read_mesh(py: Python<'_>, path: PathBuf) -> Outcome<MeshArrays<'_>> {
    let file = py.detach(|| mesh_file::read_mesh(&path, &Limits::default()))?;
    let mesh = file.without_unused_vertices();
    Ok((arrays::vectors(py, &mesh.positions)?, arrays::corners(py, &mesh.triangles)?))
}
