//! Shapes of rigid bodies: what they collide with and how their mass is spread.

mod build;
mod convex;
mod decompose;
mod mass;
mod part;
mod polytope;
mod surface;
mod validate;

use std::sync::Arc;

use glam::{DVec3, Quat, Vec3};
use serde::{Deserialize, Serialize};

use crate::mesh::TriMesh;
use mass::Frame;

pub use decompose::Decomposition;

pub(crate) use convex::{Convex, Face};
pub(crate) use part::Part;
pub(crate) use surface::Surface;

/// The shape of a rigid body: made once, never changed, shared by all bodies that look alike.
///
/// A solid is a union of convex parts. Spheres and capsules are exact, not faceted. Its constructors describe it in
/// *its own frame*, in which its surface is given back too. What moves is the *principal frame*: its origin is the
/// centre of mass, its axes the principal ones, the longest extent of the mass first. [`Shape::center_of_mass`] and
/// [`Shape::principal_rotation`] lead from one to the other.
///
/// A triangle mesh or height field is a surface without inside or mass, for bodies that do not move by themselves. Its
/// principal frame is its own.
///
/// Lengths are from 1e-6 m to 1e9 m, and no solid is thinner than a 100 000th of its length.
///
/// ```
/// use tautline::{Shape, Vec3};
///
/// let plank = Shape::cuboid(Vec3::new(0.1, 0.02, 1.0))?;
/// assert_eq!(plank.volume(), 0.016);
/// // ∫ x² dV / V = h² / 3, the longest axis first.
/// assert!(plank.second_moments().distance(Vec3::new(1.0, 0.01, 0.0004) / 3.0) < 1e-7);
/// assert!((plank.principal_rotation() * Vec3::X).distance(Vec3::Z) < 1e-6);
/// # Ok::<(), tautline::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// In the principal frame.
    parts: Vec<Part>,
    /// In m³.
    volume: f64,
    /// Per volume, in m², along the principal axes.
    second_moments: DVec3,
    /// The principal frame in its own.
    frame: Frame,
    reach: f32,
    inner_radius: f32,
    hull_excess: f32,
    hull_shortfall: f32,
    /// The surface to draw, in its own frame; empty if there is `surface`.
    display: TriMesh,
    /// Instead of parts.
    surface: Option<Surface>,
}

impl Shape {
    /// Whether it has an inside, and so a mass. Triangle meshes and height fields have none: a body of theirs is
    /// fixed or kinematic.
    pub fn is_solid(&self) -> bool {
        self.surface.is_none()
    }

    /// The volume of its mass, in m³; 0 if it is not solid. Parts of a compound that overlap count twice.
    pub fn volume(&self) -> f32 {
        self.volume as f32
    }

    /// ∫ x_k² dm / m along each principal axis k, in m²: the first is the greatest. About axis k the moment of
    /// inertia is m times the sum of the other two. Axes whose second moments are equal to a millionth are in the
    /// order that turns the shape least. All 0 if it is not solid.
    pub fn second_moments(&self) -> Vec3 {
        self.second_moments.as_vec3()
    }

    /// In its own frame, in m; the origin if it is not solid.
    pub fn center_of_mass(&self) -> Vec3 {
        self.frame.center.as_vec3()
    }

    /// From the principal frame to its own: a point p there is `center_of_mass + principal_rotation * p` here.
    pub fn principal_rotation(&self) -> Quat {
        self.frame.rotation().as_quat()
    }

    /// The greatest distance of one of its points from the centre of mass, in m.
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// The radius of a ball that fits into each of its convex parts, in m; not the largest such ball. A body that
    /// moves less than this in a step goes through nothing. 0 if it is not solid.
    pub fn inner_radius(&self) -> f32 {
        self.inner_radius
    }

    /// Vertices of its surface, to draw it; in its own frame, in m. Round shapes are faceted here.
    pub fn positions(&self) -> &[Vec3] {
        &self.display().positions
    }

    /// Triangles over [`Shape::positions`], counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.display().triangles
    }

    /// Of how many convex parts it is the union; 0 if it is not solid.
    pub fn part_count(&self) -> usize {
        self.parts.len()
    }

    /// The volume by which its convex parts together exceed the concave meshes it was made from ([`Shape::from_mesh`]), as
    /// a share of its volume; 0 for other shapes. What sticks out counts also where another part covers it.
    pub fn hull_excess(&self) -> f32 {
        self.hull_excess
    }

    /// How far points of the concave meshes it was made from may lie outside its convex parts, in m: more than 0 only if
    /// these were given fewer corners ([`Decomposition::max_corners`]).
    pub fn hull_shortfall(&self) -> f32 {
        self.hull_shortfall
    }

    /// Without parts: until a snapshot's bodies are given their shapes.
    pub(crate) fn placeholder() -> Arc<Self> {
        Arc::new(Self {
            parts: Vec::new(),
            volume: 0.0,
            second_moments: DVec3::ZERO,
            frame: Frame::IDENTITY,
            reach: 0.0,
            inner_radius: 0.0,
            hull_excess: 0.0,
            hull_shortfall: 0.0,
            display: TriMesh::default(),
            surface: None,
        })
    }

    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The triangles of a shape that is not solid.
    pub(crate) fn surface(&self) -> Option<&Surface> {
        self.surface.as_ref()
    }

    fn display(&self) -> &TriMesh {
        self.surface.as_ref().map_or(&self.display, Surface::mesh)
    }
}
