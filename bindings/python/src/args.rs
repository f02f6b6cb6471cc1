//! What Python gives, as the engine takes it. Values are judged by the engine; here only kinds and shapes are.

use numpy::{PyArray2, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tautline::mesh::TriMesh;
use tautline::{Quat, Vec3};

use crate::errors::{Failure, Outcome};

/// Three numbers, of any sequence or array.
#[derive(Clone, Copy)]
pub(crate) struct V3(pub(crate) Vec3);

impl<'py> FromPyObject<'_, 'py> for V3 {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let [x, y, z] = numbers(&value, "three numbers (x, y, z)")?;
        Ok(Self(Vec3::new(x, y, z)))
    }
}

/// A quaternion x, y, z, w.
#[derive(Clone, Copy)]
pub(crate) struct Rotation(pub(crate) Quat);

impl<'py> FromPyObject<'_, 'py> for Rotation {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let [x, y, z, w] = numbers(&value, "a quaternion of four numbers (x, y, z, w)")?;
        Ok(Self(Quat::from_xyzw(x, y, z, w)))
    }
}

fn numbers<const N: usize>(value: &Borrowed<'_, '_, PyAny>, expected: &str) -> PyResult<[f32; N]> {
    let numbers: [f64; N] = value.extract().map_err(|_: PyErr| {
        let given = value.repr().map_or_else(|_| "something else".to_owned(), |text| text.to_string());
        PyTypeError::new_err(format!("expected {expected}, not {given}"))
    })?;
    Ok(numbers.map(|number| number as f32))
}

/// Points from anything that NumPy makes an array of, of the shape (n, 3).
pub(crate) fn points(field: &str, value: &Bound<'_, PyAny>) -> Outcome<Vec<Vec3>> {
    let array = as_array::<f32>(field, value, "float32")?;
    let rows = array.readonly();
    let rows = rows.as_array();
    if rows.ncols() != 3 {
        return Err(Failure::invalid(field, format!("expected shape (n, 3), not {:?}", rows.dim())));
    }
    Ok(rows.rows().into_iter().map(|row| Vec3::new(row[0], row[1], row[2])).collect())
}

/// Rows of `N` indices from anything that NumPy makes an array of, of the shape (n, N).
pub(crate) fn indices<const N: usize>(field: &str, value: &Bound<'_, PyAny>) -> Outcome<Vec<[u32; N]>> {
    let array = as_array::<i64>(field, value, "int64")?;
    let rows = array.readonly();
    let rows = rows.as_array();
    if rows.ncols() != N {
        return Err(Failure::invalid(field, format!("expected shape (n, {N}), not {:?}", rows.dim())));
    }
    let mut indices = Vec::with_capacity(rows.nrows());
    for (i, row) in rows.rows().into_iter().enumerate() {
        let mut corners = [0; N];
        for (corner, &index) in corners.iter_mut().zip(row) {
            *corner = u32::try_from(index)
                .map_err(|_| Failure::invalid(&format!("{field}[{i}]"), format!("{index} is no index")))?;
        }
        indices.push(corners);
    }
    Ok(indices)
}

/// A mesh of points (n, 3) and triangles (m, 3).
pub(crate) fn mesh(positions: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>) -> Outcome<TriMesh> {
    Ok(TriMesh { positions: points("positions", positions)?, triangles: indices("triangles", triangles)? })
}

fn as_array<'py, T: numpy::Element>(
    field: &str,
    value: &Bound<'py, PyAny>,
    kind: &str,
) -> Outcome<Bound<'py, PyArray2<T>>> {
    let py = value.py();
    let options = PyDict::new(py);
    options.set_item("dtype", kind)?;
    options.set_item("order", "C")?;
    let numpy = py.import("numpy")?;
    // Not `asarray(value, dtype)` at once: 1.5 as an index is a mistake, not 1.
    let given = numpy.call_method1("asarray", (value,)).map_err(|error| Failure::invalid(field, error))?;
    let is_whole = given.getattr("dtype")?.getattr("kind")?.extract::<String>()?;
    let fits = match kind {
        "int64" => matches!(is_whole.as_str(), "i" | "u") || given.getattr("size")?.extract::<usize>()? == 0,
        _ => matches!(is_whole.as_str(), "i" | "u" | "f"),
    };
    if !fits {
        let found = given.getattr("dtype")?;
        return Err(Failure::invalid(field, format!("expected numbers as {kind}, not dtype {found}")));
    }
    let array = numpy.call_method("asarray", (given,), Some(&options))?;
    let shape = array.getattr("shape")?;
    array.cast_into::<PyArray2<T>>().map_err(|_| {
        Failure::invalid(field, format!("expected an array of two dimensions, not of shape {shape}"))
    })
}

/// Points of an array that has to be just as the engine's own are, so that nothing is converted unnoticed: float32,
/// C-contiguous, of the shape (n, 3), finite.
pub(crate) fn exact_points(field: &str, value: &Bound<'_, PyAny>, count: usize) -> Outcome<Vec<Vec3>> {
    let refuse = |problem: String| Failure::invalid(field, problem);
    let array = value.cast::<PyUntypedArray>().map_err(|_| {
        let kind = value.get_type();
        refuse(format!("expected a numpy.ndarray, not {kind}"))
    })?;
    let shape = array.shape();
    if shape != [count, 3] {
        return Err(refuse(format!("expected shape ({count}, 3), not {shape:?}")));
    }
    let Ok(array) = array.cast::<PyArray2<f32>>() else {
        let found = value.getattr("dtype")?;
        return Err(refuse(format!("expected dtype float32, not {found}: use .astype(numpy.float32)")));
    };
    if !array.is_c_contiguous() {
        return Err(refuse("expected a C-contiguous array: use numpy.ascontiguousarray".into()));
    }
    let rows = array.readonly();
    let rows = rows.as_array();
    let points: Vec<Vec3> = rows.rows().into_iter().map(|row| Vec3::new(row[0], row[1], row[2])).collect();
    match points.iter().position(|point| !point.is_finite()) {
        Some(index) => Err(Failure::invalid(
            &format!("{field}[{index}]"),
            format!("{:?} is not finite", points[index].to_array()),
        )),
        None => Ok(points),
    }
}

/// A colour: three whole numbers from 0 to 255, sRGB.
pub(crate) type Color = [u8; 3];
