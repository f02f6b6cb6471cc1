//! Rigid bodies, cloth and rope in one world.

pub mod body;
mod collision;
pub mod constraint;
mod error;
pub mod geometry;
mod measure;
pub mod mesh;
mod parallel;
mod particles;
mod report;
mod rest;
mod settings;
mod slots;
mod snapshot;
mod solver;
mod step;
mod view;
mod world;

pub use body::{BodyKind, Cloth, HalfSpace, Rope, Truss, TrussBody};
pub use error::{Error, MeshDefect};
pub use glam::{DVec3, Mat3, Quat, Vec3};
pub use measure::{Penetration, Strain};
pub use report::{Fault, PhaseSeconds, StepReport};
pub use settings::{BroadPhase, Ordering, Relaxation, Settings, Sleep, SquareRoot};
pub use view::BodyView;
pub use world::{BodyHandle, World};
