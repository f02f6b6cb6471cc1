//! Scene documents, the registry of named scenes, mesh files in and recordings out.

pub mod build;
pub mod document;
mod error;
mod load;
pub mod mesh_file;
pub mod recording;
pub mod registry;
pub mod run;

pub use error::{Error, ParseError, Problem};
pub use load::load;
