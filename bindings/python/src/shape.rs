//! `Shape`: what rigid bodies are, and what queries are asked with.

use std::sync::Arc;

use numpy::PyArray2;
use pyo3::prelude::*;
use tautline::shape::Decomposition;

use crate::args::{self, Rotation, V3};
use crate::arrays;
use crate::errors::Outcome;

/// The shape of a rigid body, in its own frame; many bodies share one.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Shape {
    pub(crate) shape: Arc<tautline::Shape>,
    /// Whether it is drawn without edges.
    pub(crate) is_round: bool,
}

impl Shape {
    fn new(shape: tautline::Shape, is_round: bool) -> Self {
        Self { shape: Arc::new(shape), is_round }
    }
}

#[pymethods]
impl Shape {
    #[staticmethod]
    fn sphere(radius: f32) -> Outcome<Self> {
        Ok(Self::new(tautline::Shape::sphere(radius)?, true))
    }

    /// From half its edges, in m.
    #[staticmethod]
    fn cuboid(half_extents: V3) -> Outcome<Self> {
        Ok(Self::new(tautline::Shape::cuboid(half_extents.0)?, false))
    }

    /// Along y; ``half_height`` is that of the part between the two hemispheres, in m.
    #[staticmethod]
    fn capsule(radius: f32, half_height: f32) -> Outcome<Self> {
        Ok(Self::new(tautline::Shape::capsule(radius, half_height)?, true))
    }

    #[staticmethod]
    fn cylinder(radius: f32, half_height: f32) -> Outcome<Self> {
        Ok(Self::new(tautline::Shape::cylinder(radius, half_height)?, false))
    }

    /// Of points (n, 3), in m.
    #[staticmethod]
    fn convex_hull(points: &Bound<'_, PyAny>) -> Outcome<Self> {
        Ok(Self::new(tautline::Shape::convex_hull(&args::points("points", points)?)?, false))
    }

    /// A closed mesh of positions (n, 3) in m and triangles (m, 3); a concave one becomes a union of at most ``max_parts``
    /// convex parts that are off by about ``tolerance`` (m).
    #[staticmethod]
    #[pyo3(signature = (positions, triangles, *, max_parts=None, tolerance=None))]
    fn from_mesh(
        py: Python<'_>,
        positions: &Bound<'_, PyAny>,
        triangles: &Bound<'_, PyAny>,
        max_parts: Option<u32>,
        tolerance: Option<f32>,
    ) -> Outcome<Self> {
        let mesh = args::mesh(positions, triangles)?;
        let mut decomposition = Decomposition::default();
        if let Some(parts) = max_parts {
            decomposition = decomposition.max_parts(parts);
        }
        if let Some(tolerance) = tolerance {
            decomposition = decomposition.tolerance(tolerance);
        }
        let shape = py.detach(|| tautline::Shape::decomposed(&mesh, &decomposition))?;
        Ok(Self::new(shape, false))
    }

    /// A surface without an inside, for what is fixed or kinematic.
    #[staticmethod]
    fn triangle_mesh(positions: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>) -> Outcome<Self> {
        Ok(Self::new(tautline::Shape::triangle_mesh(&args::mesh(positions, triangles)?)?, false))
    }

    /// Several shapes as one, each with its position (m) and its rotation (x, y, z, w).
    #[staticmethod]
    fn compound(parts: Vec<(PyRef<'_, Self>, V3, Rotation)>) -> Outcome<Self> {
        let parts: Vec<_> =
            parts.iter().map(|(shape, place, turn)| (&*shape.shape, place.0, turn.0)).collect();
        Ok(Self::new(tautline::Shape::compound(&parts)?, false))
    }

    /// In m³; 0 for a surface.
    #[getter]
    fn volume(&self) -> f32 {
        self.shape.volume()
    }

    #[getter]
    fn is_solid(&self) -> bool {
        self.shape.is_solid()
    }

    #[getter]
    fn center_of_mass(&self) -> [f32; 3] {
        self.shape.center_of_mass().to_array()
    }

    /// How many convex parts it has.
    #[getter]
    fn part_count(&self) -> usize {
        self.shape.part_count()
    }

    /// Vertices of its surface, in m: (n, 3).
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<f32>>> {
        arrays::vectors(py, self.shape.positions())
    }

    /// Triangles of its surface: (m, 3).
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<u32>>> {
        arrays::corners(py, self.shape.triangles())
    }

    fn __repr__(&self) -> String {
        format!("Shape(volume={}, part_count={})", self.volume(), self.part_count())
    }
}
