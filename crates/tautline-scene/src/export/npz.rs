//! A recording as NumPy's `.npz`: a zip of arrays, without loss.

use std::io::{self, Write};
use std::path::Path;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::atomic::{io_error, write_atomically};
use crate::Error;
use crate::recording::{Motion, Recording, Track};

/// Writes arrays that `numpy.load` reads: `times` (frames) in s, `names` (tracks), and for each track by its name
/// `NAME/vertices` (v, 3) in m and `NAME/triangles` (t, 3); of a rigid motion `NAME/poses` (frames, 7), position in m and
/// quaternion x, y, z, w from the vertices' frame to the world; of a deforming one `NAME/positions` (frames, v, 3) in m.
///
/// # Errors
/// [`Error::Io`] if the file cannot be written, [`Error::Recording`] if the recording contradicts itself.
pub fn write_npz(recording: &Recording, path: &Path) -> Result<(), Error> {
    recording.check()?;
    write_atomically(path, |out| {
        let archive = Archive(ZipWriter::new_stream(out));
        archive.put_recording(recording).map_err(|error| io_error(path, error))
    })
}

/// A zip in the making.
struct Archive<W: Write>(ZipWriter<zip::write::StreamWriter<W>>);

impl<W: Write> Archive<W> {
    fn put_recording(mut self, recording: &Recording) -> io::Result<()> {
        let frames = recording.frame_count();
        let times = (0..frames).map(|frame| recording.time_of(frame).to_le_bytes());
        self.put("times", "<f4", &[frames], times)?;
        self.put_names(recording)?;
        for track in &recording.tracks {
            self.put_track(track)?;
        }
        self.0.finish()?;
        Ok(())
    }

    /// Names as NumPy keeps texts: UTF-32, all of the length of the longest.
    fn put_names(&mut self, recording: &Recording) -> io::Result<()> {
        let names = recording.tracks.iter().map(|track| track.name.chars());
        let longest = names.clone().map(Iterator::count).max().unwrap_or(0).max(1);
        let padded = names.flat_map(|name| name.chain(std::iter::repeat('\0')).take(longest));
        let letters = padded.map(|letter| u32::from(letter).to_le_bytes());
        self.put("names", &format!("<U{longest}"), &[recording.tracks.len()], letters)
    }

    fn put_track(&mut self, track: &Track) -> io::Result<()> {
        let name = |array: &str| format!("{}/{array}", track.name);
        let mesh = &track.mesh;
        let vertices = mesh.positions.iter().flat_map(|position| position.to_array());
        self.put(&name("vertices"), "<f4", &[mesh.positions.len(), 3], vertices.map(f32::to_le_bytes))?;
        let corners = mesh.triangles.iter().flatten();
        let shape = [mesh.triangles.len(), 3];
        self.put(&name("triangles"), "<u4", &shape, corners.map(|corner| corner.to_le_bytes()))?;
        match &track.motion {
            Motion::Still => Ok(()),
            Motion::Rigid(poses) => {
                let numbers = poses.iter().flat_map(|(position, rotation)| {
                    position.to_array().into_iter().chain(rotation.to_array())
                });
                self.put(&name("poses"), "<f4", &[poses.len(), 7], numbers.map(f32::to_le_bytes))
            }
            Motion::Deforming(shapes) => {
                let numbers = shapes.iter().flatten().flat_map(|position| position.to_array());
                let shape = [shapes.len(), mesh.positions.len(), 3];
                self.put(&name("positions"), "<f4", &shape, numbers.map(f32::to_le_bytes))
            }
        }
    }

    /// An array in the format of `.npy` files, version 1.0: what it is, as a Python literal, then its numbers.
    fn put(
        &mut self,
        name: &str,
        kind: &str,
        shape: &[usize],
        numbers: impl Iterator<Item = [u8; 4]>,
    ) -> io::Result<()> {
        // Arrays beyond 4 GiB are allowed for; dates are not kept, so that the same recording gives the same bytes.
        let stored = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(true)
            .last_modified_time(zip::DateTime::default());
        self.0.start_file(format!("{name}.npy"), stored)?;
        let extents: String = shape.iter().map(|extent| format!("{extent},")).collect();
        let text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({extents}), }}");
        // The numbers begin at a multiple of 64 bytes: ten come before the text, a line end after it.
        let padding = (64 - (10 + text.len() + 1) % 64) % 64;
        self.0.write_all(b"\x93NUMPY\x01\x00")?;
        self.0.write_all(&((text.len() + padding + 1) as u16).to_le_bytes())?;
        writeln!(self.0, "{text}{}", " ".repeat(padding))?;
        let mut buffer = Vec::with_capacity(BUFFER + 4);
        for number in numbers {
            buffer.extend(number);
            if buffer.len() >= BUFFER {
                self.0.write_all(&buffer)?;
                buffer.clear();
            }
        }
        self.0.write_all(&buffer)
    }
}

/// Bytes that are handed on at a time.
const BUFFER: usize = 1 << 16;
