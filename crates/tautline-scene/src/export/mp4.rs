//! A recording as a film, by ffmpeg: it gets pictures through a pipe.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read, Seek, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use rayon::prelude::*;

use super::atomic::{io_error, write_beside};
use crate::Error;
use crate::recording::Recording;
use crate::render::{Renderer, Scratch, Settings};

/// Pictures drawn at once: bounds memory, and is enough to keep every core busy.
const BATCH: usize = 16;
/// The most that is told of what ffmpeg complains about, in bytes.
const COMPLAINT: u64 = 2000;

/// Writes a film (H.264) of every frame, in real time, by the program `ffmpeg`: a name that is looked for where programs
/// are, or a path. Sizes are made even, which the format demands. `progress` is told (pictures done, pictures to do).
///
/// # Errors
/// [`Error::Unsupported`] if there is no such program, it refuses, or a setting is out of its range; [`Error::Io`] if the
/// file cannot be written; [`Error::Recording`] if the recording contradicts itself.
pub fn write_mp4(
    recording: &Recording,
    path: &Path,
    settings: Settings,
    ffmpeg: &OsStr,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), Error> {
    let settings = Settings { width: settings.width & !1, height: settings.height & !1, ..settings };
    let renderer = Renderer::new(recording, settings)?;
    write_beside(path, |film| {
        // A file, not a pipe: a pipe that nobody reads in the meantime would fill up and halt the program.
        let complaints = tempfile::tempfile().map_err(|error| io_error(path, error))?;
        let stderr = complaints.try_clone().map_err(|error| io_error(path, error))?;
        let mut child = start(ffmpeg, recording.frame_rate, settings, film, stderr)?;
        let sent = send(&renderer, recording.frame_count(), &mut child, progress);
        finish(child, sent, complaints)
    })
}

/// Starts the program with the film's file as its output. Arguments are a list: no shell reads them.
fn start(
    ffmpeg: &OsStr,
    frame_rate: f32,
    settings: Settings,
    film: &Path,
    complaints: File,
) -> Result<Child, Error> {
    let size = format!("{}x{}", settings.width, settings.height);
    let program = Command::new(ffmpeg)
        .args(["-hide_banner", "-loglevel", "error", "-y"])
        .args(["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", &size, "-r", &frame_rate.to_string(), "-i", "-"])
        .args(["-an", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart"])
        .args(["-f", "mp4"])
        .arg(film)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(complaints)
        .spawn();
    program.map_err(|error| {
        refused(format!("films are written by ffmpeg, and {ffmpeg:?} does not start: {error}"))
    })
}

/// Draws all frames and hands them to the program.
fn send(
    renderer: &Renderer,
    frame_count: usize,
    child: &mut Child,
    progress: &mut dyn FnMut(usize, usize),
) -> io::Result<()> {
    // Closed at the end of this function: the program then ends the film.
    let Some(mut pipe) = child.stdin.take() else { return Ok(()) };
    progress(0, frame_count);
    for first in (0..frame_count).step_by(BATCH) {
        let end = frame_count.min(first + BATCH);
        let draw = |scratch: &mut Scratch, frame: usize| renderer.frame_with(frame, scratch);
        let pictures: Vec<_> = (first..end).into_par_iter().map_init(Scratch::default, draw).collect();
        pictures.iter().try_for_each(|picture| pipe.write_all(picture.pixels.as_flattened()))?;
        progress(end, frame_count);
    }
    Ok(())
}

/// Waits for the program; what it says of itself tells more than a broken pipe does.
fn finish(mut child: Child, sent: io::Result<()>, mut complaints: File) -> Result<(), Error> {
    let status = child.wait().map_err(|error| refused(format!("ffmpeg was lost: {error}")))?;
    if status.success() && sent.is_ok() {
        return Ok(());
    }
    let mut text = Vec::new();
    let read = complaints.rewind().and_then(|()| complaints.take(COMPLAINT).read_to_end(&mut text));
    let said = String::from_utf8_lossy(&text);
    match (read, sent) {
        (Ok(1..), _) => Err(refused(format!("ffmpeg refused: {}", said.trim()))),
        (_, Err(error)) => Err(refused(format!("ffmpeg took no more pictures: {error}"))),
        _ => Err(refused(format!("ffmpeg failed ({status})"))),
    }
}

fn refused(problem: String) -> Error {
    Error::Unsupported { option: "mp4", problem }
}
