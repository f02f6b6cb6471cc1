//! Rigid bodies, cloth and rope in one world, deterministic to the bit.
//!
//! Everything is a particle. A rigid body is a truss of particles held by sticks, a cloth a sheet of them, a rope
//! a line; Verlet's integrator moves them, GJK and sphere trees find where they touch, and whatever is wrong then,
//! a penetration or a stick of the wrong length, is mended by moving particles. Nothing stores an orientation, a
//! torque or an inertia tensor.
//!
//! ```
//! use std::sync::Arc;
//! use tautline::mesh::primitives;
//! use tautline::{Cloth, HalfSpace, Settings, Truss, TrussBody, Vec3, World};
//!
//! let mut world = World::new(Settings::default())?;
//! world.add(HalfSpace::floor(0.0))?;
//! let cube = Arc::new(Truss::from_mesh(&primitives::cube(1.0)?)?);
//! world.add(TrussBody::new(&cube).position(Vec3::Y * 0.5).fixed())?;
//! let cloth = world.add(Cloth::grid(12, 12, 2.0, 2.0).position(Vec3::Y * 1.2))?;
//! for _ in 0..60 {
//!     let report = world.step(1.0 / 60.0)?;
//!     assert!(report.faults.is_empty());
//! }
//! let middle = world.body(cloth)?.center_of_mass();
//! assert!(middle.y > 0.5 && middle.y < 1.2, "it lies on the cube and hangs down its sides");
//! # Ok::<(), tautline::Error>(())
//! ```
//!
//! # Units and axes
//!
//! Metres, kilograms, seconds and radians. Right-handed, Y up; gravity is −9.81 m/s² along Y unless
//! [`Settings::gravity`] says otherwise. Quaternions are in the order x, y, z, w. Triangles run counter-clockwise
//! seen from outside. Normals between two bodies point from A to B.
//!
//! # From a mesh to a picture
//!
//! Data flows one way:
//!
//! 1. A [`TriMesh`](mesh::TriMesh), from [`mesh::primitives`] or your own triangles, becomes a shape:
//!    [`Truss::from_mesh`]. Many bodies share one.
//! 2. A builder ([`TrussBody`], [`Cloth`], [`Rope`], [`HalfSpace`]) says where a body starts and what it is made
//!    of. [`World::add`] checks it and gives a [`BodyHandle`].
//! 3. [`World::step`] moves everything: in each substep it integrates, finds the pairs whose boxes overlap, finds
//!    where those touch, separates them, and relaxes the sticks. A [`StepReport`] says what that took.
//! 4. [`World::body`] shows a body as it is now: positions to draw, a pose, velocities. [`World::strain`],
//!    [`World::penetration`] and the energies measure the whole.
//! 5. [`World::snapshot`] turns everything into bytes, [`World::restore`] turns them back.
//!
//! The geometry below can be used without a world: [`geometry::distance::distance`] of two convex hulls,
//! [`geometry::sphere_tree`], [`mesh::HalfEdgeMesh`], [`mesh::convex_hull`], [`mesh::tetrahedralise`],
//! [`mesh::MassProperties`].
//!
//! # What is promised
//!
//! - **The same bits.** The same calls in the same order give the same [`World::state_hash`] on every platform,
//!   with and without optimisation, on any number of threads.
//! - **No panic.** What is wrong with a call is an [`Error`] that names the field, and the world is as it was
//!   before. A particle that turns non-finite freezes its body, and the step's report says so.
//! - **No surprises.** The engine reads no clock and no files, draws no random numbers and prints nothing.
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

pub mod body;
mod collision;
pub mod constraint;
mod error;
pub mod geometry;
mod joint;
mod measure;
pub mod mesh;
mod parallel;
mod particles;
mod query;
mod report;
mod rest;
mod settings;
pub mod shape;
mod simd;
mod slots;
mod snapshot;
mod solver;
mod step;
mod view;
mod world;

pub use body::{
    BodyKind, Cloth, CollisionGroups, Combine, HalfSpace, Motion, RigidBody, Rope, Surface, Truss, TrussBody,
};
pub use error::{Error, MeshDefect};
pub use glam::{DVec3, Mat3, Quat, Vec3};
pub use joint::{
    BallJoint, DistanceJoint, FixedJoint, HingeJoint, JointDescription, JointEvent, JointHandle, JointKind,
    JointView, Motor, SliderJoint,
};
pub use measure::{Penetration, Strain};
pub use query::{CastHit, PointHit, QueryFilter, RayHit};
pub use report::{Fault, PhaseSeconds, StepReport};
pub use settings::{BroadPhase, Ordering, Relaxation, Settings, Sleep, SquareRoot};
pub use shape::Shape;
pub use simd::Instructions;
pub use view::BodyView;
pub use world::{BodyHandle, GrabHandle, Grip, World};
