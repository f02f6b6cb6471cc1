//! Files to documents: a scene and the mesh files it names.

use std::collections::BTreeMap;
use std::path::Path;

use tautline::mesh::TriMesh;

use crate::document::{
    Body, Format, MeshFile, MeshSource, Scene, Shape, Surface, limits, line_and_column, parse,
};
use crate::error::{Error, ParseError, Problem, legible};
use crate::mesh_file::{self, Limits};

/// Reads a scene file (JSON, JSON5 or TOML, by its extension), puts its mesh files in the place of their names
/// and checks every value, so that what comes after needs no files.
///
/// # Errors
/// [`Error::Io`] and [`Error::Parse`] for the scene file itself; [`Error::Invalid`] with every problem of its
/// values and of its mesh files.
pub fn load(path: &Path) -> Result<Scene, Error> {
    let mut scene = read_document(path)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut problems = scene.problems();
    problems.extend(inline_mesh_files(&mut scene, folder));
    if problems.is_empty() {
        // The meshes are known only now: their number of particles counts too.
        problems = scene.problems();
    }
    if problems.is_empty() { Ok(scene) } else { Err(Error::Invalid(problems)) }
}

fn read_document(path: &Path) -> Result<Scene, Error> {
    let refusal = |line, column, message: &str| {
        let (file, field) = (Some(path.to_owned()), String::new());
        Error::Parse(Box::new(ParseError { file, field, line, column, message: message.to_owned() }))
    };
    let unknown = || Error::UnsupportedFormat { path: path.to_owned(), supported: ".json, .json5, .toml" };
    let format = Format::of_path(path).ok_or_else(unknown)?;
    let bytes = mesh_file::read_limited(path, limits::FILE_BYTES)?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let (bytes, valid) = (error.as_bytes(), error.utf8_error().valid_up_to());
        let (line, column) = line_and_column(&String::from_utf8_lossy(&bytes[..valid]), valid);
        refusal(line, column, mesh_file::unmasked(bytes).unwrap_or("it is not UTF-8 text"))
    })?;
    // Some editors begin a text with a byte order mark.
    parse(text.strip_prefix('\u{feff}').unwrap_or(&text), format).map_err(|error| match error {
        Error::Parse(mut error) => {
            error.file = Some(path.to_owned());
            Error::Parse(error)
        }
        other => other,
    })
}

/// Replaces the names of mesh files by what is in them; returns what is wrong with those that stay. Stops where
/// the scene is sure to be refused: the rest would only take time and memory.
fn inline_mesh_files(scene: &mut Scene, folder: &Path) -> Vec<Problem> {
    let mut files = BTreeMap::new();
    let mut problems = Vec::new();
    let (mut vertices, mut triangles) = (0, 0);
    let bodies = scene.bodies.iter_mut().enumerate();
    for (i, field, place) in bodies.flat_map(|(i, body)| places_in(body).map(move |(f, p)| (i, f, p))) {
        let Some(file) = place.file() else { continue };
        let read = files
            .entry(file.path.clone())
            .or_insert_with(|| read_mesh(folder, &file.path).map_err(|error| error.to_string()));
        match read {
            Ok(mesh) => {
                vertices += mesh.positions.len() as u64;
                triangles += mesh.triangles.len() as u64;
                let mesh = scaled(mesh, file.scale);
                place.put(mesh);
            }
            Err(message) => {
                let path = format!("bodies[{i}].{field}.file.path");
                problems.push(Problem { path, message: legible(&**message) });
            }
        }
        if vertices > limits::PARTICLES || triangles > limits::TRIANGLES || problems.len() == limits::PROBLEMS
        {
            break;
        }
    }
    problems
}

fn read_mesh(folder: &Path, path: &str) -> Result<TriMesh, Error> {
    Ok(mesh_file::read_inside(folder, path, &Limits::default())?.without_unused_vertices())
}

/// Where a document can name a mesh file.
enum Place<'a> {
    Shape(&'a mut Shape),
    Surface(&'a mut Surface),
}

impl Place<'_> {
    fn file(&self) -> Option<&MeshFile> {
        match self {
            Self::Shape(Shape::File(file)) | Self::Surface(Surface::File(file)) => Some(file),
            Self::Shape(_) | Self::Surface(_) => None,
        }
    }

    fn put(self, mesh: MeshSource) {
        match self {
            Self::Shape(shape) => *shape = Shape::Mesh(mesh),
            Self::Surface(surface) => *surface = Surface::Mesh(mesh),
        }
    }
}

/// The places of a body, and the fields they are.
fn places_in(body: &mut Body) -> impl Iterator<Item = (String, Place<'_>)> {
    let mut places = Vec::new();
    match body {
        Body::Rigid(rigid) => add_places("rigid.shape".to_owned(), &mut rigid.shape, &mut places),
        Body::Cloth(cloth) => places.push(("cloth.surface".to_owned(), Place::Surface(&mut cloth.surface))),
        Body::SoftSolid(solid) => add_places("soft_solid.shape".to_owned(), &mut solid.shape, &mut places),
        Body::Rope(_) | Body::HalfSpace(_) | Body::Room(_) => {}
    }
    places.into_iter()
}

fn add_places<'a>(field: String, shape: &'a mut Shape, places: &mut Vec<(String, Place<'a>)>) {
    match shape {
        Shape::Compound { parts } => {
            for (k, part) in parts.iter_mut().enumerate() {
                add_places(format!("{field}.compound.parts[{k}].shape"), &mut part.shape, places);
            }
        }
        Shape::Surface(surface) => places.push((format!("{field}.surface"), Place::Surface(surface))),
        other => places.push((field, Place::Shape(other))),
    }
}

fn scaled(mesh: &TriMesh, scale: f32) -> MeshSource {
    let positions = mesh.positions.iter().map(|&position| (position * scale).to_array()).collect();
    MeshSource { positions, triangles: mesh.triangles.clone() }
}
