//! A recording as one mesh file for each frame: Wavefront OBJ or binary PLY.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tautline::Vec3;

use super::atomic::{io_error, write_atomically};
use super::joined::{first_vertices, positions_at, triangle_count, vertex_count};
use crate::Error;
use crate::recording::Recording;

/// The file of a frame: `out/cloth.obj` becomes `out/cloth_0007.obj`, with more digits where there are more frames.
pub fn frame_path(path: &Path, frame: usize, frame_count: usize) -> PathBuf {
    let digits = (frame_count.max(1) - 1).to_string().len().max(4);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_{frame:0digits$}.{extension}"))
}

/// Writes a Wavefront OBJ for every frame, each track an object of its name; see [`frame_path`] for the names. Vertices
/// are in m, Y up, in the same order in every file. `progress` is told (frames done, frames to do).
///
/// # Errors
/// [`Error::Io`] if a file cannot be written, [`Error::Recording`] if the recording contradicts itself.
pub fn write_obj(
    recording: &Recording,
    path: &Path,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), Error> {
    write_frames(recording, path, progress, |frame, file| {
        write_obj_frame(&ObjFrame::new(recording, frame), file)
    })
}

/// Writes a binary little-endian PLY for every frame, with a colour for each vertex; otherwise as [`write_obj`].
///
/// # Errors
/// As [`write_obj`].
pub fn write_ply(
    recording: &Recording,
    path: &Path,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), Error> {
    write_frames(recording, path, progress, |frame, file| {
        write_atomically(file, |out| ply_frame(recording, frame, out).map_err(|error| io_error(file, error)))
    })
}

fn write_frames(
    recording: &Recording,
    path: &Path,
    progress: &mut dyn FnMut(usize, usize),
    write: impl Fn(usize, &Path) -> Result<(), Error>,
) -> Result<(), Error> {
    recording.check()?;
    let frames = recording.frame_count();
    for frame in 0..frames {
        write(frame, &frame_path(path, frame, frames))?;
        progress(frame + 1, frames);
    }
    Ok(())
}

/// A frame as it is written to an OBJ file.
pub(super) struct ObjFrame<'a> {
    recording: &'a Recording,
    positions: Vec<Vec3>,
    /// What a track is: an object, or a group of faces of the one object.
    part: char,
}

impl<'a> ObjFrame<'a> {
    pub(super) fn new(recording: &'a Recording, frame: usize) -> Self {
        Self { recording, positions: positions_at(recording, frame), part: 'o' }
    }

    /// As one object: importers make as many meshes as there are objects.
    pub(super) fn in_one(recording: &'a Recording, frame: usize) -> Self {
        Self { part: 'g', ..Self::new(recording, frame) }
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        for (track, first) in first_vertices(self.recording) {
            // A line break in a name would begin another statement.
            let name: String = track.name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
            writeln!(out, "{} {name}", self.part)?;
            let end = first + track.mesh.positions.len();
            // The shortest decimals that read back as the same numbers.
            for Vec3 { x, y, z } in &self.positions[first..end] {
                writeln!(out, "v {x} {y} {z}")?;
            }
            for corners in &track.mesh.triangles {
                let [a, b, c] = corners.map(|corner| first + corner as usize + 1);
                writeln!(out, "f {a} {b} {c}")?;
            }
        }
        Ok(())
    }
}

pub(super) fn write_obj_frame(frame: &ObjFrame<'_>, path: &Path) -> Result<(), Error> {
    write_atomically(path, |out| frame.write(out).map_err(|error| io_error(path, error)))
}

fn ply_frame(recording: &Recording, frame: usize, out: &mut impl Write) -> io::Result<()> {
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\ncomment seconds {}\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        recording.time_of(frame),
        vertex_count(recording),
        triangle_count(recording),
    )?;
    for track in &recording.tracks {
        for position in track.positions_at(frame).iter() {
            out.write_all(position.to_array().map(f32::to_le_bytes).as_flattened())?;
            out.write_all(&track.color)?;
        }
    }
    for (track, first) in first_vertices(recording) {
        for corners in &track.mesh.triangles {
            out.write_all(&[3])?;
            let corners = corners.map(|corner| (first as u32 + corner).to_le_bytes());
            out.write_all(corners.as_flattened())?;
        }
    }
    Ok(())
}
