//! Shapes of a document to trusses and sheets.

use std::collections::BTreeMap;
use std::sync::Arc;

use tautline::mesh::{MassProperties, TriMesh, convex_hull, primitives};
use tautline::{Error, Truss, Vec3};

use crate::document::{MeshSource, Shape};

/// A shape made ready for bodies.
#[derive(Debug, Clone)]
pub(super) struct Solid {
    pub(super) truss: Arc<Truss>,
    /// The surface in the truss's frame, to be drawn.
    pub(super) surface: Arc<TriMesh>,
    /// Where the truss's frame is in the document's, in m.
    pub(super) origin: Vec3,
    /// In m³.
    pub(super) volume: f64,
}

impl Solid {
    fn new(shape: &Shape) -> Result<Self, Error> {
        let mesh = mesh_of(shape)?;
        let truss = Truss::from_mesh(&mesh)?;
        let rest = truss.rest_positions();
        // A truss lies about the mean of its particles, which keep the order of the mesh's vertices.
        let origin = mesh.positions[0] - rest[0];
        let positions = rest[..truss.surface().vertex_count()].to_vec();
        let surface = Arc::new(TriMesh { positions, triangles: truss.triangles().to_vec() });
        let volume = MassProperties::of(&mesh, 1.0)?.volume;
        Ok(Self { truss: Arc::new(truss), surface, origin, volume })
    }
}

/// The solids of a scene, each distinct shape once: also those that are refused.
#[derive(Debug, Default)]
pub(super) struct Solids(BTreeMap<String, Result<Solid, Error>>);

impl Solids {
    /// The solid of a shape.
    pub(super) fn get(&mut self, shape: &Shape) -> Result<Solid, Error> {
        // Shapes of the same numbers have the same text, since numbers are written exactly.
        let key = serde_json::to_string(shape).unwrap_or_default();
        self.0.entry(key).or_insert_with(|| Solid::new(shape)).clone()
    }
}

fn mesh_of(shape: &Shape) -> Result<TriMesh, Error> {
    match *shape {
        Shape::Box { size } => primitives::cuboid(Vec3::from(size) / 2.0),
        Shape::Tetrahedron { radius } => primitives::tetrahedron(radius),
        Shape::Octahedron { radius } => primitives::octahedron(radius),
        Shape::Dodecahedron { radius } => primitives::dodecahedron(radius),
        Shape::Icosahedron { radius } => primitives::icosahedron(radius),
        Shape::Icosphere { radius, subdivisions } => primitives::icosphere(radius, subdivisions),
        Shape::UvSphere { radius, segments, rings } => primitives::uv_sphere(radius, segments, rings),
        Shape::Capsule { radius, height, segments, rings } => {
            primitives::capsule(radius, height / 2.0, segments, rings)
        }
        Shape::Cylinder { radius, height, segments } => primitives::cylinder(radius, height / 2.0, segments),
        Shape::Torus { radius, tube_radius, segments, tube_segments } => {
            primitives::torus(radius, tube_radius, segments, tube_segments)
        }
        Shape::Hull { ref points } => {
            let points: Vec<Vec3> = points.iter().copied().map(Vec3::from).collect();
            convex_hull(&points).map(|hull| hull.mesh)
        }
        Shape::Mesh(ref mesh) => Ok(triangles(mesh)),
        Shape::File(_) => Err(unread()),
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
