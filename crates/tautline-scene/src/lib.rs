//! Scene documents, the registry of named scenes, mesh files in and recordings out.
#![cfg_attr(
    not(test),
    warn(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::print_stdout,
        clippy::print_stderr
    )
)]

pub mod build;
pub mod cloth_trials;
pub mod document;
mod error;
pub mod export;
pub mod judge;
pub mod live;
mod load;
pub mod mesh_file;
pub mod random;
pub mod recording;
pub mod registry;
pub mod render;
pub mod run;
pub mod validate;

pub use error::{Error, ParseError, Problem};
pub use load::load;
