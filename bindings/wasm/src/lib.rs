//! The engine in WebAssembly. The package in `npm/` gives it its types, handles and views; nothing else calls it, so
//! that what crosses the border is plain: numbers, flat arrays, and texts in JSON.
//!
//! A refusal is thrown as a text in JSON, see `failure.rs`. No panic is meant to happen; if one does, or memory runs out,
//! the instance traps and the package says that it can no longer be used.
// What is public here is exported to JavaScript; the package's own types describe it to people.
#![allow(missing_docs, unreachable_pub)]

mod bodies;
mod contacts;
mod failure;
mod hands;
mod inspect;
mod links;
mod mesh_files;
mod questions;
mod scenes;
mod session;
mod shapes;

pub use session::Session;
