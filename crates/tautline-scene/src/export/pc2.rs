//! A recording as a point cache, PC2: what Blender's modifier *Mesh Cache* reads.
//!
//! The file holds positions only. The mesh that they move is written beside it, as `.obj` of the same name: one object with
//! its vertices in order, which is imported and given the modifier.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::atomic::{io_error, write_atomically};
use super::joined::{positions_at, vertex_count};
use super::sequence::{ObjFrame, write_obj_frame};
use crate::Error;
use crate::recording::Recording;

/// Twelve bytes: eleven letters and a zero.
const MAGIC: &[u8; 12] = b"POINTCACHE2\0";
/// Of the format.
const VERSION: i32 = 1;

/// Writes the positions of all vertices at every frame, in m, track after track, and beside them the mesh at the first
/// frame, as `.obj`. The header, little-endian: 12 letters, version, count of vertices, first frame, frames between two
/// samples, count of samples. `progress` is told (frames done, frames to do).
///
/// # Errors
/// [`Error::Io`] if a file cannot be written, [`Error::Recording`] if the recording contradicts itself,
/// [`Error::Unsupported`] if it has more vertices or frames than the format can count.
pub fn write_pc2(
    recording: &Recording,
    path: &Path,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), Error> {
    recording.check()?;
    let frames = recording.frame_count();
    let too_many = |what: &str| Error::Unsupported {
        option: "pc2",
        problem: format!("the recording has more {what} than the format can count"),
    };
    let samples = i32::try_from(frames).map_err(|_| too_many("frames"))?;
    let points = i32::try_from(vertex_count(recording)).map_err(|_| too_many("vertices"))?;
    write_atomically(path, |out| {
        let mut put = |bytes: &[u8]| out.write_all(bytes).map_err(|error| io_error(path, error));
        put(MAGIC)?;
        put(&VERSION.to_le_bytes())?;
        put(&points.to_le_bytes())?;
        put(&0.0_f32.to_le_bytes())?;
        put(&1.0_f32.to_le_bytes())?;
        put(&samples.to_le_bytes())?;
        for frame in 0..frames {
            for position in positions_at(recording, frame) {
                put(position.to_array().map(f32::to_le_bytes).as_flattened())?;
            }
            progress(frame + 1, frames);
        }
        Ok(())
    })?;
    write_obj_frame(&ObjFrame::in_one(recording, 0), &mesh_path(path))
}

/// The file beside a point cache that holds the mesh.
pub fn mesh_path(path: &Path) -> PathBuf {
    path.with_extension("obj")
}
