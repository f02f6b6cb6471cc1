//! Rigid bodies, cloth and rope in one world.

pub mod body;
mod collision;
pub mod constraint;
mod error;
pub mod geometry;
pub mod mesh;
mod particles;
mod report;
mod rest;
mod settings;
mod slots;
mod solver;
mod step;
mod world;

pub use body::{BodyKind, Cloth, HalfSpace, Rope, Truss, TrussBody};
pub use error::{Error, MeshDefect};
pub use glam::{DVec3, Mat3, Quat, Vec3};
pub use report::{Fault, PhaseSeconds, StepReport};
pub use settings::{BroadPhase, Ordering, Relaxation, Settings, Sleep, SquareRoot};
pub use world::{BodyHandle, World};
