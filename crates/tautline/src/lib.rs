//! Rigid bodies, cloth and rope in one world.

pub mod body;
pub mod collision;
pub mod constraint;
mod error;
pub mod geometry;
pub mod mesh;
mod particles;
mod settings;
mod solver;
mod step;
mod world;

pub use error::{Error, MeshDefect};
pub use glam::{DVec3, Mat3, Quat, Vec3};
