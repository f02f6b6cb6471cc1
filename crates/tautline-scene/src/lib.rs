//! Scene documents, the registry of named scenes, mesh files in and recordings out.

pub mod document;
mod error;
pub mod recording;

pub use error::{Error, ParseError, Problem};
