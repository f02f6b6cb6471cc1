//! Meshes as files: OBJ, STL and PLY.

use std::io::{self, Write};
use std::path::Path;

use tautline::mesh::TriMesh;

use super::Format;
use crate::error::Error;
use crate::export::write_atomically;

/// Writes a mesh as the extension of the path says: `.obj` (text), `.stl` or `.ply` (binary). Its triangles must name
/// vertices that are there.
///
/// # Errors
/// [`Error::UnsupportedFormat`] for another extension; [`Error::Io`] if the file cannot be written.
pub fn write_mesh(mesh: &TriMesh, path: &Path) -> Result<(), Error> {
    let write = match Format::of(path) {
        Some(Format::Obj) => write_obj,
        Some(Format::Stl) => write_stl,
        Some(Format::Ply) => write_ply,
        Some(Format::Gltf) | None => {
            return Err(Error::UnsupportedFormat { path: path.to_owned(), supported: ".obj, .stl, .ply" });
        }
    };
    write_atomically(path, |out| write(mesh, out).map_err(|source| Error::io(path, source)))
}

fn write_obj(mesh: &TriMesh, out: &mut dyn Write) -> io::Result<()> {
    // As short as can be so that it is read back to the bit.
    for p in &mesh.positions {
        writeln!(out, "v {} {} {}", p.x, p.y, p.z)?;
    }
    mesh.triangles.iter().try_for_each(|&[a, b, c]| writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1))
}

fn write_stl(mesh: &TriMesh, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(&[0; 80])?;
    out.write_all(&(mesh.triangles.len() as u32).to_le_bytes())?;
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for number in [normal, a, b, c].iter().flat_map(|point| point.to_array()) {
            out.write_all(&number.to_le_bytes())?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

fn write_ply(mesh: &TriMesh, out: &mut dyn Write) -> io::Result<()> {
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len()
    )?;
    for number in mesh.positions.iter().flat_map(|position| position.to_array()) {
        out.write_all(&number.to_le_bytes())?;
    }
    for triangle in &mesh.triangles {
        out.write_all(&[3])?;
        triangle.iter().try_for_each(|index| out.write_all(&index.to_le_bytes()))?;
    }
    Ok(())
}
