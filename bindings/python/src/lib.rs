//! The Python package `tautline`: its compiled half, `tautline._engine`. It computes nothing: arguments become calls of
//! the engine, and what the engine says becomes Python's.
//!
//! A world is behind a lock, which is never held while Python runs, and Python is not held while a world steps.

mod args;
mod arrays;
mod bodies;
mod body;
mod errors;
mod joints;
mod queries;
mod recording;
mod scene;
mod settings;
mod shape;
mod steps;
mod threads;
mod validate;
mod views;
mod world;

use pyo3::prelude::*;

#[pymodule]
fn _engine(module: &Bound<'_, PyModule>) -> PyResult<()> {
    threads::note_process();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<settings::Settings>()?;
    module.add_class::<shape::Shape>()?;
    module.add_class::<bodies::HalfSpace>()?;
    module.add_class::<bodies::RigidBody>()?;
    module.add_class::<bodies::Grid>()?;
    module.add_class::<bodies::Cloth>()?;
    module.add_class::<bodies::Rope>()?;
    module.add_class::<bodies::Lattice>()?;
    module.add_class::<bodies::SoftSolid>()?;
    module.add_class::<world::World>()?;
    module.add_class::<body::Body>()?;
    module.add_class::<joints::Joint>()?;
    module.add_class::<joints::Anchor>()?;
    module.add_class::<joints::Attachment>()?;
    module.add_class::<joints::Grab>()?;
    module.add_class::<queries::Hit>()?;
    module.add_class::<queries::Distance>()?;
    module.add_class::<steps::StepReport>()?;
    module.add_class::<steps::ContactEvent>()?;
    module.add_class::<steps::Batch>()?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<recording::Recording>()?;
    module.add_function(wrap_pyfunction!(queries::hull_distance, module)?)?;
    module.add_function(wrap_pyfunction!(scene::scenes, module)?)?;
    module.add_function(wrap_pyfunction!(scene::read_mesh, module)?)?;
    module.add_function(wrap_pyfunction!(validate::validate_json, module)?)?;
    module.add_function(wrap_pyfunction!(threads::set_threads, module)?)?;
    Ok(())
}
