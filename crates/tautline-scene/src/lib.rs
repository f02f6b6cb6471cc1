//! Scene documents, the registry of named scenes, mesh files in and recordings out.

mod error;
pub mod export;
pub mod recording;
pub mod render;

pub use error::Error;
