//! Arrays that are Python's own: copies of what the engine says.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use tautline::Vec3;

use crate::errors::Outcome;

/// Of the shape (n, 3).
pub(crate) fn vectors<'py>(py: Python<'py>, vectors: &[Vec3]) -> Outcome<Bound<'py, PyArray2<f32>>> {
    let flat: Vec<f32> = vectors.iter().flat_map(|vector| vector.to_array()).collect();
    Ok(PyArray1::from_vec(py, flat).reshape([vectors.len(), 3])?)
}

/// Of the shape (n, 3).
pub(crate) fn corners<'py>(py: Python<'py>, triangles: &[[u32; 3]]) -> Outcome<Bound<'py, PyArray2<u32>>> {
    Ok(PyArray1::from_slice(py, triangles.as_flattened()).reshape([triangles.len(), 3])?)
}
