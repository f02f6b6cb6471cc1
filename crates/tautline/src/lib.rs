//! Rigid bodies, cloth and rope in one world, deterministic to the bit.
//!
//! Everything that moves is made of particles. A [`RigidBody`] is four of them, placed so that its mass, centre and
//! inertia are exact; pose, velocity and angular velocity are read from them. A [`Cloth`] is a sheet of particles, a
//! [`Rope`] a line, and a [`SoftSolid`] a body of tetrahedra. A [`TrussBody`] is the rigid body of the paper that the
//! engine reproduces: particles held by sticks.
//!
//! Rigid bodies of four particles move in substeps, with soft contacts and exact joints. The particles of cloth and rope
//! move in small steps by Verlet integration; errors such as a penetration or a stick of the wrong length are then
//! corrected by moving particles. They all collide with each other, and cloth with itself. Trusses collide only with each
//! other and with half-spaces, unless the paper's solver also moves cloth and rope: see [`Settings::cloth`].
//!
//! ```
//! use std::sync::Arc;
//! use tautline::{HalfSpace, QueryFilter, RigidBody, Settings, Shape, Vec3, World};
//!
//! let mut world = World::new(Settings::default())?;
//! world.add(HalfSpace::floor(0.0))?;
//! let shape = Arc::new(Shape::cuboid(Vec3::splat(0.5))?);
//! let lower = world.add(RigidBody::new(&shape).mass(2.0).position(Vec3::Y * 0.5))?;
//! let upper = world.add(RigidBody::new(&shape).mass(2.0).position(Vec3::new(0.2, 1.6, 0.0)))?;
//! for _ in 0..120 {
//!     let report = world.step(1.0 / 60.0)?;
//!     assert!(report.faults.is_empty());
//! }
//! let (position, _) = world.body(upper)?.pose().expect("it is rigid");
//! assert!((position.y - 1.5).abs() < 0.01, "it rests on the other");
//! let hit = world.ray_cast(Vec3::new(0.0, 0.5, 5.0), Vec3::NEG_Z, 10.0, QueryFilter::default())?;
//! assert_eq!(hit.map(|hit| hit.body), Some(lower));
//! # Ok::<(), tautline::Error>(())
//! ```
//!
//! A cloth over a cube:
//!
//! ```
//! use std::sync::Arc;
//! use tautline::{Cloth, HalfSpace, RigidBody, Settings, Shape, Vec3, World};
//!
//! let mut world = World::new(Settings::default())?;
//! world.add(HalfSpace::floor(0.0))?;
//! let cube = Arc::new(Shape::cuboid(Vec3::splat(0.5))?);
//! world.add(RigidBody::new(&cube).position(Vec3::Y * 0.5).fixed())?;
//! let cloth = world.add(Cloth::grid(12, 12, 2.0, 2.0).position(Vec3::Y * 1.2))?;
//! for _ in 0..60 {
//!     world.step(1.0 / 60.0)?;
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
//! 1. A [`Shape`] is made from numbers, points or a [`TriMesh`](mesh::TriMesh), either from [`mesh::primitives`] or your
//!    own. For a truss, [`Truss::from_mesh`] takes the mesh. Many bodies can share one.
//! 2. A builder ([`RigidBody`], [`TrussBody`], [`Cloth`], [`Rope`], [`SoftSolid`], [`HalfSpace`]) says where a body starts
//!    and what it is made of. [`World::add`] checks it and returns a [`BodyHandle`]. [`World::add_joint`] connects rigid
//!    bodies, [`World::attach`] attaches cloth and rope to anything.
//! 3. [`World::step`] moves everything. For rigid bodies it finds contacts once a step, or once a substep if some are very
//!    fast, and solves joints and contacts in each substep. Cloth and rope move in small steps within each substep; for
//!    trusses it integrates, finds contacts, separates and relaxes in each substep. A [`StepReport`] says what that took.
//!    Between steps you can set forces, impulses, poses and velocities, and pick up a body: [`World::apply_force`],
//!    [`World::set_pose`], [`World::grab`].
//! 4. [`World::body`] shows a body as it is now: a surface to draw, a pose, velocities. [`World::ray_cast`],
//!    [`World::shape_cast`], [`World::overlap`] and [`World::closest_point`] query what is where. [`World::strain`],
//!    [`World::penetration`] and the energies measure the whole world.
//! 5. [`World::snapshot`] turns everything into bytes, [`World::restore`] turns them back.
//!
//! The geometry can be used without a world: [`geometry::distance::distance`] between two convex hulls,
//! [`geometry::swept`], [`geometry::sphere_tree`], [`mesh::HalfEdgeMesh`], [`mesh::convex_hull`], [`mesh::decimate`],
//! [`mesh::tetrahedralise`], [`mesh::Embedding`], [`mesh::MassProperties`].
//!
//! # What is promised
//!
//! - **The same bits.** The same calls in the same order give the same [`World::state_hash`] on every platform,
//!   with and without optimisation, on any number of threads and with any [`Instructions`].
//! - **No panic.** A wrong call returns an [`Error`] that names the field, and leaves the world as it was. If a particle
//!   becomes non-finite, its body is frozen and the step's report says so.
//! - **No surprises.** The engine reads no clock and no files, draws no random numbers and prints nothing.
#![cfg_attr(
    not(test),
    warn(
        clippy::disallowed_methods,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::print_stdout,
        clippy::print_stderr
    )
)]

mod attachment;
pub mod body;
mod collision;
pub mod constraint;
mod error;
mod events;
pub mod geometry;
pub mod inspect;
mod joint;
mod measure;
pub mod mesh;
mod norm;
mod order;
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

pub use attachment::{Anchor, Attachment, AttachmentHandle, AttachmentView};
pub use body::{
    BodyKind, Cloth, CollisionGroups, Combine, HalfSpace, Motion, RigidBody, Rope, SoftSolid, Surface, Truss,
    TrussBody,
};
pub use error::{Error, MeshDefect};
pub use events::{ContactEvent, ContactEventKind};
pub use glam::{DVec3, Mat3, Quat, Vec3};
pub use joint::{
    BallJoint, DistanceJoint, FixedJoint, HingeJoint, JointDescription, JointEvent, JointHandle, JointKind,
    JointView, Motor, SliderJoint,
};
pub use measure::{Penetration, Strain};
pub use query::{CastHit, PointHit, QueryFilter, RayHit};
pub use report::{Fault, PhaseSeconds, StepReport};
pub use settings::{BroadPhase, ClothSolver, Ordering, Relaxation, Settings, Sleep, SquareRoot};
pub use shape::Shape;
pub use simd::Instructions;
pub use view::BodyView;
pub use world::{BodyHandle, GrabHandle, Grip, World};
