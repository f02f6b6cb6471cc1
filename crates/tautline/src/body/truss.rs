//! Rigid bodies as trusses: particles at the vertices of a closed mesh, held by sticks (paper, 4).

use std::borrow::Cow;
use std::sync::Arc;

use glam::{Mat3, Quat, Vec3};
use serde::{Deserialize, Serialize};

use crate::constraint::{OrderedLists, Stick};
use crate::error::{Error, MeshDefect, all_coordinates, coordinates, positive, within};
use crate::geometry::sphere_tree::{Feature, WrappedTree};
use crate::mesh::{HalfEdgeMesh, TriMesh, tetrahedralise};
use crate::norm::Norm;

/// The shape of a truss body: made once, shared by all bodies that look alike.
///
/// A convex mesh that is its own mirror image through its centre gets the paper's sticks: its edges and its main
/// diagonals (cube: 18 + 4, icosahedron: 30 + 6). Any other closed mesh is divided into tetrahedra that keep its
/// surface, and all their edges become sticks.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Truss {
    /// Rest positions about their mean: the surface's vertices, then interior points.
    rest: Vec<Vec3>,
    surface: HalfEdgeMesh,
    triangles: Vec<[u32; 3]>,
    convex: bool,
    sticks: Vec<Stick>,
    lists: OrderedLists,
    tree: WrappedTree,
}

impl Truss {
    /// The truss of a closed triangle mesh, in m.
    ///
    /// # Errors
    /// [`Error::Mesh`] with the first defect: open, non-manifold, flipped, inside out, without volume, or
    /// impossible to divide into tetrahedra. [`Error::OutOfRange`] if a coordinate is beyond ±1e9 m.
    pub fn from_mesh(mesh: &TriMesh) -> Result<Self, Error> {
        let surface = HalfEdgeMesh::from_mesh(mesh)?;
        surface.require_closed()?;
        all_coordinates("positions", &mesh.positions)?;
        let volume = signed_volume(mesh);
        if volume <= 0.0 {
            return Err(MeshDefect::NotPositiveVolume { volume }.into());
        }
        let convex = is_convex(mesh);
        let (mut rest, edges) = match main_diagonals(mesh).filter(|_| convex) {
            Some(diagonals) => (mesh.positions.clone(), surface.edges().chain(diagonals).collect::<Vec<_>>()),
            None => {
                let tetrahedra = tetrahedralise(mesh)?;
                let edges = tetrahedra.edges();
                (tetrahedra.points, edges)
            }
        };
        let center = mean(&rest);
        rest.iter_mut().for_each(|point| *point -= center);
        let sticks: Vec<Stick> = edges.iter().map(|&[a, b]| Stick::at_rest(a, b, &rest)).collect();
        Stick::check_all(&sticks, "mesh")?;
        let lists = OrderedLists::new(rest.len(), &sticks);
        let features: Vec<Feature> = mesh.triangles.iter().map(|&t| Feature::Triangle(t)).collect();
        let tree = WrappedTree::new(&features, &rest, TREE_PADDING)?;
        Ok(Self { rest, surface, triangles: mesh.triangles.clone(), convex, sticks, lists, tree })
    }

    /// Rest positions, in m, about their mean: vertices of the surface first, then interior points.
    pub fn rest_positions(&self) -> &[Vec3] {
        &self.rest
    }

    /// The surface.
    pub fn surface(&self) -> &HalfEdgeMesh {
        &self.surface
    }

    /// The surface's triangles, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The sticks that hold the body together.
    pub fn sticks(&self) -> &[Stick] {
        &self.sticks
    }

    /// The paper's list C_v of a particle v: indices into [`Truss::sticks`]; empty if there is no such particle.
    pub fn ordered_list(&self, particle: usize) -> Cow<'_, [u32]> {
        self.lists.list(particle, self.rest.len(), &self.sticks)
    }

    /// How many particles lie inside the surface, because no division into tetrahedra does without.
    pub fn interior_particle_count(&self) -> usize {
        self.rest.len() - self.surface.vertex_count()
    }

    /// Whether no vertex lies outside the plane of any face. Trusses that are not convex meet other trusses
    /// with their convex hull, and cloth and rope with their true surface.
    pub fn is_convex(&self) -> bool {
        self.convex
    }

    pub(crate) fn tree(&self) -> &WrappedTree {
        &self.tree
    }

    /// The rotation that best carries the rest shape into `positions`, and the mean of `positions`.
    pub(crate) fn pose(&self, positions: &[Vec3]) -> (Vec3, Quat) {
        let center = mean(positions);
        (center, super::pose::best_rotation(&self.rest, positions, center))
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        let count = self.rest.len();
        let in_range = |index: u32| (index as usize) < count;
        self.surface.validate()?;
        self.tree.validate(count)?;
        let sound = self.surface.vertex_count() <= count
            && self.triangles.iter().flatten().all(|&v| (v as usize) < self.surface.vertex_count())
            && self.sticks.iter().all(|s| in_range(s.a) && in_range(s.b) && s.is_sound())
            && self.lists.is_valid(count, self.sticks.len())
            && self.rest.iter().all(|point| point.is_finite());
        let refusal = || Error::Invalid { field: "truss".into(), problem: "its parts disagree".into() };
        if sound { Ok(()) } else { Err(refusal()) }
    }
}

/// A truss body to be added to a world.
#[derive(Debug, Clone, PartialEq)]
pub struct TrussBody {
    pub(crate) truss: Arc<Truss>,
    pub(crate) position: Vec3,
    pub(crate) rotation: Quat,
    pub(crate) velocity: Vec3,
    pub(crate) angular_velocity: Vec3,
    pub(crate) mass: f32,
    pub(crate) friction: f32,
    pub(crate) fixed: bool,
}

impl TrussBody {
    /// A body of 1 kg at the origin, at rest, friction 0.5.
    pub fn new(truss: &Arc<Truss>) -> Self {
        Self {
            truss: Arc::clone(truss),
            position: Vec3::ZERO,
            rotation: Quat::IDENTITY,
            velocity: Vec3::ZERO,
            angular_velocity: Vec3::ZERO,
            mass: 1.0,
            friction: 0.5,
            fixed: false,
        }
    }

    /// Where the mean of its particles is, in m.
    pub fn position(self, position: Vec3) -> Self {
        Self { position, ..self }
    }

    /// Rotation from the shape's frame to the world; normalised when added.
    pub fn rotation(self, rotation: Quat) -> Self {
        Self { rotation, ..self }
    }

    /// Velocity, in m/s.
    pub fn velocity(self, velocity: Vec3) -> Self {
        Self { velocity, ..self }
    }

    /// Angular velocity, in rad/s, in the world's frame.
    pub fn angular_velocity(self, angular_velocity: Vec3) -> Self {
        Self { angular_velocity, ..self }
    }

    /// Mass, in kg, shared equally by its particles.
    pub fn mass(self, mass: f32) -> Self {
        Self { mass, ..self }
    }

    /// Coulomb's coefficient of friction; a contact uses the geometric mean of both bodies' own.
    pub fn friction(self, friction: f32) -> Self {
        Self { friction, ..self }
    }

    /// Never moves: its particles have infinite mass.
    pub fn fixed(self) -> Self {
        Self { fixed: true, ..self }
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        coordinates("position", self.position)?;
        coordinates("velocity", self.velocity)?;
        coordinates("angular_velocity", self.angular_velocity)?;
        positive("mass", self.mass)?;
        within("friction", self.friction, 0.0, 1e6, "a number from 0 to 1e6")?;
        let length_squared = self.rotation.length_squared();
        within("rotation", length_squared, 1e-6, 1e6, "a quaternion with a length near 1")?;
        if self.truss.rest.is_empty() {
            return Err(Error::Mesh(MeshDefect::Empty));
        }
        // It may have been read from bytes.
        self.truss.validate()
    }

    pub(crate) fn positions(&self) -> Vec<Vec3> {
        let rotation = Mat3::from_quat(self.rotation.normalize());
        self.truss.rest.iter().map(|&point| self.position + rotation * point).collect()
    }
}

/// By which share the spheres of a truss are enlarged: twice the 1 % that its sticks may be off.
const TREE_PADDING: f32 = 0.02;

fn mean(points: &[Vec3]) -> Vec3 {
    points.iter().sum::<Vec3>() / points.len() as f32
}

/// In m³; about the first vertex, so that it is accurate far from the origin.
fn signed_volume(mesh: &TriMesh) -> f64 {
    let origin = mesh.positions[0].as_dvec3();
    let corner = |v: u32| mesh.positions[v as usize].as_dvec3() - origin;
    let six = |&[a, b, c]: &[u32; 3]| corner(a).dot(corner(b).cross(corner(c)));
    mesh.triangles.iter().map(six).sum::<f64>() / 6.0
}

fn extent(mesh: &TriMesh) -> f32 {
    let (low, high) = mesh
        .positions
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    (high - low).max_element()
}

/// No vertex more than 1e-5 of the mesh's size outside the plane of any triangle.
fn is_convex(mesh: &TriMesh) -> bool {
    let tolerance = 1e-5 * extent(mesh);
    mesh.triangles.iter().all(|&[a, b, c]| {
        let [a, b, c] = [a, b, c].map(|v| mesh.positions[v as usize]);
        let normal = (b - a).cross(c - a).unit_or_zero();
        mesh.positions.iter().all(|&p| normal.dot(p - a) <= tolerance)
    })
}

/// The segments between opposite vertices, if every vertex has its mirror image through the mean.
fn main_diagonals(mesh: &TriMesh) -> Option<Vec<[u32; 2]>> {
    let center = mean(&mesh.positions);
    let tolerance = 1e-5 * extent(mesh);
    let opposite = |p: Vec3| {
        let mirrored = center * 2.0 - p;
        mesh.positions.iter().position(|q| (*q - mirrored).abs().max_element() <= tolerance)
    };
    let partners: Option<Vec<usize>> = mesh.positions.iter().map(|&p| opposite(p)).collect();
    let pairs = partners?.into_iter().enumerate().filter(|&(v, partner)| v < partner);
    Some(pairs.map(|(v, partner)| [v as u32, partner as u32]).collect())
}
