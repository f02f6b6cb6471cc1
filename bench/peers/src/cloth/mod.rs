//! Cloth that falls on a cube (E2) and on a rope (E3): time, stretch, and what passes through what.

mod chart;
mod compare;
mod engine;
mod judge;
mod measure;
mod ours;
mod rapier;
mod report;
mod scene;

pub(crate) use chart::chart;
pub(crate) use compare::{Plan, compare};
pub(crate) use engine::{Contender, Make};
pub(crate) use report::{json_rows, table};
pub(crate) use scene::Support;
