//! Arrays that look into a world's own memory, without a copy.
//!
//! # Why this is sound
//!
//! A view is a NumPy array over `World::positions` or a body's inverse masses. Its base is a [`Viewer`], which has an
//! `Arc` of the world's [`Keep`]. Those vectors stay at one address until a body is added or removed or the world is
//! replaced: the engine says so, and steps and setters write in place. Whoever is about to do one of these goes through
//! `World::restructure`: while there is a viewer, it works on a clone, and what the viewers see is moved, with its
//! buffers where they are, into the keep that they hold. So the memory lives as long as the last view. A view also holds
//! its world, so that the world cannot go first.
//!
//! Views are read-only: NumPy refuses to make them writeable, since their base offers no buffer that could be written to.
//! While a step runs in another thread, a view shows what the step writes at that moment: numbers, of no defined time.
#![allow(unsafe_code)]

use std::sync::{Arc, OnceLock};

use numpy::ndarray::{ArrayView1, ArrayView2};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use tautline::Vec3;
use tautline_scene::build::BuiltScene;

use crate::world::World;

/// Where a world goes that views look at when the world moves on.
pub(crate) type Keep = OnceLock<BuiltScene>;

/// What holds the memory that a view looks into.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Viewer {
    _world: Py<World>,
    _keep: Arc<Keep>,
}

/// Numbers in a world's memory, found while the world was locked.
pub(crate) struct Sight<T> {
    start: *const T,
    length: usize,
    keep: Arc<Keep>,
}

impl<T> Sight<T> {
    /// Of a slice of the world that has this keep.
    pub(crate) fn new(slice: &[T], keep: &Arc<Keep>) -> Self {
        Self { start: slice.as_ptr(), length: slice.len(), keep: Arc::clone(keep) }
    }

    fn viewer<'py>(&self, world: &Bound<'py, World>) -> PyResult<Bound<'py, PyAny>> {
        let viewer = Viewer { _world: world.clone().unbind(), _keep: Arc::clone(&self.keep) };
        Ok(Bound::new(world.py(), viewer)?.into_any())
    }
}

/// A read-only array of the shape (n, 3).
pub(crate) fn of_vectors<'py>(
    world: &Bound<'py, World>,
    sight: &Sight<Vec3>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let viewer = sight.viewer(world)?;
    // SAFETY: a `Vec3` is three `f32` in a row (`repr(C)`, see the assertion below), and the slice had this many. The
    // keep in `sight` has kept the memory since the world was locked, and the viewer goes on keeping it.
    let array = unsafe {
        let rows = ArrayView2::from_shape_ptr((sight.length, 3), sight.start.cast::<f32>());
        PyArray2::borrow_from_array(&rows, viewer)
    };
    array.readwrite().make_nonwriteable();
    Ok(array)
}

/// A read-only array of the shape (n,).
pub(crate) fn of_numbers<'py>(
    world: &Bound<'py, World>,
    sight: &Sight<f32>,
) -> PyResult<Bound<'py, PyArray1<f32>>> {
    let viewer = sight.viewer(world)?;
    // SAFETY: as in `of_vectors`.
    let array = unsafe {
        let numbers = ArrayView1::from_shape_ptr(sight.length, sight.start);
        PyArray1::borrow_from_array(&numbers, viewer)
    };
    array.readwrite().make_nonwriteable();
    Ok(array)
}

const _: () = assert!(size_of::<Vec3>() == 3 * size_of::<f32>() && align_of::<Vec3>() == align_of::<f32>());
