//! Mesh files: OBJ, STL, PLY and glTF to triangles over shared vertices.
//!
//! Read here rather than by libraries because a solid needs what a picture does not: one vertex per place across
//! groups, seams and facets, so that its surface closes; the place of what is wrong; and memory in proportion to the
//! file, whatever its numbers claim.

mod disguise;
mod folder;
mod gltf;
mod limits;
mod notes;
mod obj;
mod ply;
mod polygon;
mod refusal;
mod stl;
mod weld;
mod words;
mod write;

use std::io::BufReader;
use std::path::Path;

use tautline::mesh::TriMesh;

use crate::error::Error;

pub(crate) use disguise::unmasked;
pub(crate) use folder::read_limited;
pub use limits::Limits;
pub use notes::Note;
pub use refusal::{Place, Refusal};
pub use write::{writable, write_mesh};

/// The extensions that [`Format::of`] knows.
pub const FORMATS: &str = ".obj, .stl, .ply, .gltf, .glb";

/// A kind of mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ, text.
    Obj,
    /// STL, text or binary.
    Stl,
    /// PLY, text or binary of either byte order.
    Ply,
    /// glTF 2.0 as JSON, or as one binary file.
    Gltf,
}

impl Format {
    /// The format that the extension of a path names, in small or capital letters; `None` for another extension.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }
}

/// What a mesh file holds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshFile {
    /// Vertices as the file counts them, in its units, and faces divided into triangles. Vertices of STL and glTF,
    /// which write one for every corner or seam, are one where they are equal to the bit. Nothing is known of the
    /// surface but that its coordinates are finite, its indices are those of its vertices, and it has a triangle.
    pub mesh: TriMesh,
    /// What the file says besides and was passed over.
    pub notes: Vec<Note>,
}

impl MeshFile {
    /// The mesh without the vertices that no triangle uses; the others keep their order.
    pub fn without_unused_vertices(self) -> TriMesh {
        weld::without_unused(self.mesh)
    }
}

/// Reads a mesh file, whose extension says what it is. A glTF file may name buffers beside it or in folders below; no
/// other file is opened.
///
/// # Errors
/// [`Error::Io`] for what is no regular file or is larger than the limit; [`Error::UnsupportedFormat`] for another
/// extension; [`Error::Mesh`] for a file that is malformed, beyond a limit or without a triangle.
pub fn read_mesh(path: &Path, limits: &Limits) -> Result<MeshFile, Error> {
    let unknown = || Error::UnsupportedFormat { path: path.to_owned(), supported: FORMATS };
    let format = Format::of(path).ok_or_else(unknown)?;
    let read = if format == Format::Stl {
        let (file, length) = folder::open_limited(path, limits.file_bytes)?;
        stl::read(BufReader::new(file), length, limits)
    } else {
        let bytes = read_limited(path, limits.file_bytes)?;
        parse_beside(&bytes, format, limits, Some(folder::folder_of(path)))
    };
    read.map_err(|refusal| Error::Mesh { path: path.to_owned(), refusal })
}

/// Reads the mesh file at a path that a scene gives, which must lie in the scene's folder.
///
/// # Errors
/// Those of [`read_mesh`]; [`Error::Mesh`] for a path that leads out of the folder, by itself or by a link.
pub fn read_inside(folder: &Path, path: &str, limits: &Limits) -> Result<MeshFile, Error> {
    read_mesh(&folder::inside(folder, path)?, limits)
}

/// Reads the bytes of a mesh file. A glTF file must hold its buffers itself.
///
/// # Errors
/// [`Refusal`] for bytes that are malformed, beyond a limit or without a triangle.
pub fn parse(bytes: &[u8], format: Format, limits: &Limits) -> Result<MeshFile, Refusal> {
    parse_beside(bytes, format, limits, None)
}

fn parse_beside(
    bytes: &[u8],
    format: Format,
    limits: &Limits,
    folder: Option<&Path>,
) -> Result<MeshFile, Refusal> {
    if bytes.len() as u64 > limits.file_bytes {
        return Err(Refusal::new(limits::too_many("bytes", bytes.len() as u64, limits.file_bytes)));
    }
    let read = match format {
        Format::Obj => obj::parse(&String::from_utf8_lossy(disguise::without_mark(bytes)), limits),
        Format::Stl => stl::parse(bytes, limits),
        Format::Ply => ply::parse(bytes, limits),
        Format::Gltf => gltf::parse(bytes, limits, folder),
    };
    read.map_err(|refusal| disguise::explain(bytes, refusal))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEEDS: [(Format, &[u8]); 9] = [
        (Format::Obj, include_bytes!("../../../../fuzz/seeds/obj/mixed.obj")),
        (Format::Obj, include_bytes!("../../../../fuzz/seeds/obj/concave.obj")),
        (Format::Stl, include_bytes!("../../../../fuzz/seeds/stl/text.stl")),
        (Format::Stl, include_bytes!("../../../../fuzz/seeds/stl/binary.stl")),
        (Format::Ply, include_bytes!("../../../../fuzz/seeds/ply/text.ply")),
        (Format::Ply, include_bytes!("../../../../fuzz/seeds/ply/little.ply")),
        (Format::Ply, include_bytes!("../../../../fuzz/seeds/ply/big.ply")),
        (Format::Gltf, include_bytes!("../../../../fuzz/seeds/gltf/binary.glb")),
        (Format::Gltf, include_bytes!("../../../../fuzz/seeds/gltf/text.gltf")),
    ];

    /// Miri runs this too, over fewer of them.
    #[test]
    fn seeds_with_a_byte_changed_or_cut_off_are_read_or_refused() {
        let stride = if cfg!(miri) { 61 } else { 1 };
        for (format, seed) in SEEDS {
            assert!(parse(seed, format, &Limits::default()).is_ok());
            for place in (0..seed.len()).step_by(stride) {
                let mut changed = seed.to_vec();
                changed[place] ^= 1 << (place % 8);
                for bytes in [&seed[..place], &changed] {
                    if let Ok(MeshFile { mesh, .. }) = parse(bytes, format, &Limits::default()) {
                        assert!(mesh.positions.iter().all(|position| position.is_finite()));
                        let count = mesh.positions.len();
                        assert!(
                            mesh.triangles.as_flattened().iter().all(|&vertex| (vertex as usize) < count)
                        );
                    }
                }
            }
        }
    }
}
