//! What is wrong with a mesh, and where; and what can be done about it.
//!
//! Engines ask for a closed, oriented, manifold surface that does not cross itself, and scans and exports seldom are
//! one. [`diagnose`] names every defect with its place; [`repair`] welds, drops, turns, parts and fills (after Attene
//! 2010, A lightweight approach to repairing digitized polygon meshes, and Guéziec et al. 2001, Cutting and stitching)
//! and says what it did. Both take any numbers whatever, and their answers depend on nothing else.
//!
//! Signs of areas and volumes are exact: a triangle is degenerate if its corners lie on one line to the last bit, and
//! surfaces cross if they share a point that is no common corner or edge, however small the overlap.

mod crossing;
mod diagnose;
mod edges;
mod groups;
mod loops;
mod nesting;
mod orient;
mod repair;
mod report;
mod surface;

pub use diagnose::diagnose;
pub use repair::{Action, RepairOptions, Repaired, Why, repair};
pub use report::{Component, Defect, Report};
