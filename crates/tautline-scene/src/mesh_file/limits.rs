//! How large a mesh file may be, in every respect that costs memory or time.

use super::Refusal;
use crate::document;

/// What a mesh file must not exceed. Checked before memory is taken for it: what a header claims is not believed.
/// The defaults are those of files in scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the file, and of the buffers that a glTF file names.
    pub file_bytes: u64,
    /// Vertices, as the file counts them.
    pub vertices: usize,
    /// Triangles, once faces of more corners are divided.
    pub triangles: usize,
    /// Nodes of a glTF file below each other.
    pub nesting: usize,
}

impl Default for Limits {
    fn default() -> Self {
        let triangles = document::limits::TRIANGLES as usize;
        Self {
            file_bytes: document::limits::FILE_BYTES,
            vertices: triangles,
            triangles,
            nesting: document::limits::NESTING,
        }
    }
}

impl Limits {
    pub(super) fn check_vertices(&self, count: usize) -> Result<(), Refusal> {
        check("vertices", count, self.vertices)
    }

    pub(super) fn check_triangles(&self, count: usize) -> Result<(), Refusal> {
        check("triangles", count, self.triangles)
    }
}

/// Bytes of vertices and triangles that any file may have, however small.
const FREE: usize = 1 << 20;

/// Refuses what takes more than five times the memory of its file: lists of corners that are one byte each, or meshes
/// that a file repeats.
pub(super) fn check_growth(file_bytes: usize, vertices_and_triangles: usize) -> Result<(), Refusal> {
    let needed = vertices_and_triangles.saturating_mul(size_of::<[u32; 3]>());
    if needed <= file_bytes.saturating_mul(5).saturating_add(FREE) {
        return Ok(());
    }
    Err(Refusal::new(format!(
        "what {file_bytes} bytes describe would take {needed}: write repeated meshes and large faces as triangles"
    )))
}

fn check(what: &str, count: usize, most: usize) -> Result<(), Refusal> {
    if count > most { Err(Refusal::new(too_many(what, count as u64, most as u64))) } else { Ok(()) }
}

pub(super) fn too_many(what: &str, count: u64, most: u64) -> String {
    format!("{count} {what} are more than {most}")
}
