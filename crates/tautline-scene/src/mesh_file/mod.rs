//! Mesh files: OBJ and STL to triangles over shared vertices.
//!
//! Read here rather than by a library because a solid needs what a picture does not: one vertex per place
//! across groups, seams and facets, so that its surface closes; and the line of what is wrong.

mod obj;
mod polygon;
mod stl;

use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use tautline::mesh::TriMesh;

use crate::document::limits;
use crate::error::Error;

/// What is wrong with a mesh file, and at which line, from 1, if it has lines.
#[derive(Debug, PartialEq)]
struct Defect {
    line: Option<usize>,
    message: String,
}

impl Defect {
    fn new(message: impl Into<String>) -> Self {
        Self { line: None, message: message.into() }
    }

    fn at(line: usize, message: impl Into<String>) -> Self {
        Self { line: Some(line), message: message.into() }
    }
}

/// Reads an OBJ or STL file, told apart by its extension. Nothing is known of the surface but that its
/// coordinates are finite and its indices are those of its vertices.
///
/// # Errors
/// [`Error::Io`], or [`Error::Mesh`] for a file that is malformed, empty, too large or of another kind.
pub fn read(path: &Path) -> Result<TriMesh, Error> {
    parse(&read_limited(path)?, path)
}

/// As [`read`], of the bytes of a file that is called so.
///
/// # Errors
/// [`Error::Mesh`].
pub fn parse(bytes: &[u8], path: &Path) -> Result<TriMesh, Error> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let mesh = match extension.to_ascii_lowercase().as_str() {
        "obj" => obj::parse(&String::from_utf8_lossy(bytes)),
        "stl" => stl::parse(bytes),
        other => Err(Defect::new(format!(
            "{other:?} is the extension of no mesh file that can be read: obj or stl"
        ))),
    };
    mesh.map_err(|Defect { line, message }| Error::Mesh { path: path.to_owned(), line, message })
}

/// Reads the mesh file at a path that a scene gives, which must lie in the scene's folder.
///
/// # Errors
/// Those of [`read`]; [`Error::Mesh`] for a path that leads out of the folder, by itself or by a link.
pub fn read_inside(folder: &Path, path: &str) -> Result<TriMesh, Error> {
    read(&inside(folder, path)?)
}

/// The file's true path, once it is known to lie in the folder.
fn inside(folder: &Path, path: &str) -> Result<PathBuf, Error> {
    let refusal = |message: &str| Error::Mesh { path: path.into(), line: None, message: message.to_owned() };
    let plain = |component| matches!(component, Component::Normal(_) | Component::CurDir);
    if path.is_empty() || !Path::new(path).components().all(plain) {
        return Err(refusal("not a path inside the scene's folder: it must be relative and without `..`"));
    }
    let joined = folder.join(path);
    let file = joined.canonicalize().map_err(|source| Error::io(&joined, source))?;
    let folder = folder.canonicalize().map_err(|source| Error::io(folder, source))?;
    if !file.starts_with(&folder) {
        return Err(refusal("a link that leads out of the scene's folder"));
    }
    Ok(file)
}

/// The bytes of a regular file that is not too large.
pub(crate) fn read_limited(path: &Path) -> Result<Vec<u8>, Error> {
    let io = |source| Error::io(path, source);
    // Asked before it is opened: opening a pipe would wait for its writer.
    let metadata = std::fs::metadata(path).map_err(io)?;
    if !metadata.is_file() {
        return Err(io(std::io::Error::other("not a regular file")));
    }
    if metadata.len() > limits::FILE_BYTES {
        let message = format!("{} bytes are more than {}", metadata.len(), limits::FILE_BYTES);
        return Err(io(std::io::Error::new(std::io::ErrorKind::FileTooLarge, message)));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(limits::FILE_BYTES).read_to_end(&mut bytes)).map_err(io)?;
    Ok(bytes)
}

/// A coordinate as text; one that is not finite is none.
fn coordinate(word: &str) -> Option<f32> {
    word.parse().ok().filter(|value: &f32| value.is_finite())
}
