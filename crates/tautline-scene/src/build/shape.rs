//! Shapes of a document to shapes and trusses of the engine.

use std::collections::BTreeMap;
use std::sync::Arc;

use tautline::mesh::{MassProperties, TriMesh, convex_hull, primitives};
use tautline::{Error, Quat, Truss, Vec3};

use super::body::quaternion;
use crate::document::{Body, MeshSource, Motion, PartOfCompound, Rigid, Scene, Shape, Surface};
use crate::error::Error as SceneError;

/// A shape made ready for bodies.
#[derive(Debug, Clone)]
pub(super) struct Solid {
    pub(super) make: Make,
    /// The surface in the frame of a body's pose, to be drawn.
    pub(super) surface: Arc<TriMesh>,
    /// Whether it is round, and drawn smooth.
    pub(super) is_round: bool,
}

/// What its bodies are made of.
#[derive(Debug, Clone)]
pub(super) enum Make {
    /// Four particles.
    Rigid(Arc<tautline::Shape>),
    /// Sticks.
    Truss {
        truss: Arc<Truss>,
        /// Where the truss's frame is in the document's, in m.
        origin: Vec3,
        /// In m³.
        volume: f64,
    },
}

impl Solid {
    fn rigid(shape: &Shape) -> Result<Self, Error> {
        let is_round = is_round(shape);
        let shape = shape_of(shape)?;
        let surface =
            TriMesh { positions: shape.positions().to_vec(), triangles: shape.triangles().to_vec() };
        Ok(Self { make: Make::Rigid(Arc::new(shape)), surface: Arc::new(surface), is_round })
    }

    fn truss(shape: &Shape) -> Result<Self, Error> {
        let mesh = mesh_of(shape)?;
        let truss = Truss::from_mesh(&mesh)?;
        let rest = truss.rest_positions();
        // A truss lies about the mean of its particles, which keep the order of the mesh's vertices.
        let origin = mesh.positions[0] - rest[0];
        let positions = rest[..truss.surface().vertex_count()].to_vec();
        let surface = Arc::new(TriMesh { positions, triangles: truss.triangles().to_vec() });
        let volume = MassProperties::of(&mesh, 1.0)?.volume;
        let make = Make::Truss { truss: Arc::new(truss), origin, volume };
        Ok(Self { make, surface, is_round: is_round(shape) })
    }
}

impl Shape {
    /// The engine's shape, of a shape that is no file, by itself.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] with every value that is wrong; [`SceneError::Engine`] for what makes no shape.
    pub fn build(&self) -> Result<tautline::Shape, SceneError> {
        let motion = if self.is_solid() { Motion::Dynamic } else { Motion::Fixed };
        let body = Body::Rigid(Rigid { shape: self.clone(), motion: Some(motion), ..Rigid::default() });
        let problems = Scene { bodies: vec![body], ..Scene::default() }.problems();
        if !problems.is_empty() {
            let problems = problems.into_iter().map(|problem| problem.without("bodies[0].rigid."));
            return Err(SceneError::Invalid(problems.collect()));
        }
        Ok(shape_of(self)?)
    }
}

/// The solids of a scene, each distinct shape once: also those that are refused.
#[derive(Debug)]
pub(super) struct Solids {
    are_trusses: bool,
    made: BTreeMap<String, Result<Solid, Error>>,
}

impl Solids {
    pub(super) fn new(are_trusses: bool) -> Self {
        Self { are_trusses, made: BTreeMap::new() }
    }

    pub(super) fn get(&mut self, shape: &Shape) -> Result<Solid, Error> {
        // Shapes of the same numbers have the same text, since numbers are written exactly.
        let key = serde_json::to_string(shape).unwrap_or_default();
        let make = if self.are_trusses { Solid::truss } else { Solid::rigid };
        self.made.entry(key).or_insert_with(|| make(shape)).clone()
    }
}

/// Whether it has no edges.
fn is_round(shape: &Shape) -> bool {
    match shape {
        Shape::Sphere { .. } => true,
        Shape::Capsule { segments, rings, .. } => segments.or(*rings).is_none(),
        _ => false,
    }
}

/// What a body of four particles collides as: exact where no facets are asked for.
fn shape_of(shape: &Shape) -> Result<tautline::Shape, Error> {
    match *shape {
        Shape::Box { size } => tautline::Shape::cuboid(Vec3::from(size) / 2.0),
        Shape::Sphere { radius } => tautline::Shape::sphere(radius),
        Shape::Capsule { radius, height, segments: None, rings: None } => {
            tautline::Shape::capsule(radius, height / 2.0)
        }
        Shape::Cylinder { radius, height, segments: None } => tautline::Shape::cylinder(radius, height / 2.0),
        Shape::Torus { .. } | Shape::Mesh(_) | Shape::File(_) => tautline::Shape::from_mesh(&mesh_of(shape)?),
        Shape::Compound { ref parts } => compound(parts),
        Shape::Surface(ref surface) => tautline::Shape::triangle_mesh(&sheet_of(surface)?),
        Shape::HeightField { columns, rows, cell_size, ref heights } => {
            tautline::Shape::height_field(columns, rows, cell_size, heights)
        }
        Shape::Tetrahedron { .. }
        | Shape::Octahedron { .. }
        | Shape::Dodecahedron { .. }
        | Shape::Icosahedron { .. }
        | Shape::Icosphere { .. }
        | Shape::UvSphere { .. }
        | Shape::Capsule { .. }
        | Shape::Cylinder { .. }
        | Shape::Hull { .. } => tautline::Shape::convex_hull(&mesh_of(shape)?.positions),
    }
}

fn compound(parts: &[PartOfCompound]) -> Result<tautline::Shape, Error> {
    let shapes: Vec<tautline::Shape> =
        parts.iter().map(|part| shape_of(&part.shape)).collect::<Result<_, _>>()?;
    let places = parts.iter().map(|part| (Vec3::from(part.position), quaternion(part.rotation)));
    let placed: Vec<(&tautline::Shape, Vec3, Quat)> =
        shapes.iter().zip(places).map(|(shape, (position, rotation))| (shape, position, rotation)).collect();
    tautline::Shape::compound(&placed)
}

/// The surface of a solid; faceted where it is round.
pub(super) fn mesh_of(shape: &Shape) -> Result<TriMesh, Error> {
    match *shape {
        Shape::Box { size } => primitives::cuboid(Vec3::from(size) / 2.0),
        Shape::Tetrahedron { radius } => primitives::tetrahedron(radius),
        Shape::Octahedron { radius } => primitives::octahedron(radius),
        Shape::Dodecahedron { radius } => primitives::dodecahedron(radius),
        Shape::Icosahedron { radius } => primitives::icosahedron(radius),
        Shape::Sphere { radius } => primitives::icosphere(radius, Shape::SPHERE_SUBDIVISIONS),
        Shape::Icosphere { radius, subdivisions } => primitives::icosphere(radius, subdivisions),
        Shape::UvSphere { radius, segments, rings } => primitives::uv_sphere(radius, segments, rings),
        Shape::Capsule { radius, height, segments, rings } => {
            let segments = segments.unwrap_or(Shape::CAPSULE_SEGMENTS);
            primitives::capsule(radius, height / 2.0, segments, rings.unwrap_or(Shape::CAPSULE_RINGS))
        }
        Shape::Cylinder { radius, height, segments } => {
            primitives::cylinder(radius, height / 2.0, segments.unwrap_or(Shape::CYLINDER_SEGMENTS))
        }
        Shape::Torus { radius, tube_radius, segments, tube_segments } => {
            primitives::torus(radius, tube_radius, segments, tube_segments)
        }
        Shape::Hull { ref points } => {
            let points: Vec<Vec3> = points.iter().copied().map(Vec3::from).collect();
            convex_hull(&points).map(|hull| hull.mesh)
        }
        Shape::Mesh(ref mesh) => Ok(triangles(mesh)),
        Shape::File(_) => Err(unread()),
        Shape::Compound { .. } | Shape::Surface(_) | Shape::HeightField { .. } => {
            let problem = "it cannot be a truss".to_owned();
            Err(Error::Invalid { field: "shape".to_owned(), problem })
        }
    }
}

fn sheet_of(surface: &Surface) -> Result<TriMesh, Error> {
    match *surface {
        Surface::Grid { columns, rows, width, depth } => primitives::grid(columns, rows, width, depth),
        Surface::Mesh(ref mesh) => Ok(triangles(mesh)),
        Surface::File(_) => Err(unread()),
    }
}

/// Triangles of a document to triangles of the engine.
pub(super) fn triangles(mesh: &MeshSource) -> TriMesh {
    TriMesh {
        positions: mesh.positions.iter().copied().map(Vec3::from).collect(),
        triangles: mesh.triangles.clone(),
    }
}

/// A mesh file's name where its contents should be.
pub(super) fn unread() -> Error {
    let problem = "its mesh has not been read: that is done where a scene is read from a file".to_owned();
    Error::Invalid { field: "file".to_owned(), problem }
}
