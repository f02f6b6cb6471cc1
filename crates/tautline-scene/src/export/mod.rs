//! Recordings out: pictures, films, animations, meshes and arrays.

mod atomic;
mod gif;
mod glb;
mod html;
mod joined;
mod mp4;
mod npz;
mod palette;
mod pc2;
mod png;
mod sequence;

use std::ffi::OsStr;
use std::path::Path;

use crate::Error;
use crate::recording::Recording;
use crate::render::{Renderer, Settings};

pub use atomic::{check_writable, write_atomically};
pub use gif::write_gif;
pub use glb::{glb_bytes, write_glb};
pub use html::{html, write_html};
pub use mp4::write_mp4;
pub use npz::write_npz;
pub use pc2::{mesh_path, write_pc2};
pub use png::write_png;
pub use sequence::{frame_path, write_obj, write_ply};

/// The extensions that [`write()`] knows.
pub const FORMATS: &str = ".gif, .glb, .html, .mp4, .npz, .obj, .pc2, .ply, .png";

/// A format that recordings are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Moving pictures.
    Gif,
    /// Animated glTF.
    Glb,
    /// A page that plays it.
    Html,
    /// A film, by ffmpeg.
    Mp4,
    /// NumPy's arrays.
    Npz,
    /// Wavefront OBJ, one file for each frame.
    Obj,
    /// A point cache, with its mesh as OBJ beside it.
    Pc2,
    /// Binary PLY, one file for each frame.
    Ply,
    /// One picture.
    Png,
}

impl Format {
    /// The format that the extension of a path names, in small or capital letters.
    ///
    /// # Errors
    /// [`Error::UnsupportedFormat`] for another extension, or none.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        match extension.as_str() {
            "gif" => Ok(Self::Gif),
            "glb" => Ok(Self::Glb),
            "html" => Ok(Self::Html),
            "mp4" => Ok(Self::Mp4),
            "npz" => Ok(Self::Npz),
            "obj" => Ok(Self::Obj),
            "pc2" => Ok(Self::Pc2),
            "ply" => Ok(Self::Ply),
            "png" => Ok(Self::Png),
            _ => Err(Error::UnsupportedFormat { path: path.to_owned(), supported: FORMATS }),
        }
    }
}

/// How a recording is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Size, smoothness and camera of pictures.
    pub picture: Settings,
    /// The most pictures a second in a GIF, 1 to 50.
    pub gif_frame_rate: f32,
    /// The frame of a PNG; `None` is the last.
    pub png_frame: Option<usize>,
}

impl Default for Options {
    fn default() -> Self {
        Self { picture: Settings::default(), gif_frame_rate: 30.0, png_frame: None }
    }
}

/// Writes a recording in the format that the extension of `path` names: `.glb` (animated glTF), `.gif`, `.html` (a
/// page that plays it), `.mp4` (by the ffmpeg that is found where programs are), `.png` (one frame), `.pc2` (and its mesh as
/// `.obj`), `.npz`, or one `.obj` or `.ply` for each frame. `progress` is told (steps done, steps to do).
///
/// # Errors
/// [`Error::UnsupportedFormat`] for another extension; otherwise those of [`write_glb`], [`write_gif`],
/// [`write_html`], [`write_mp4`], [`write_npz`], [`write_pc2`], [`write_obj`], [`Renderer::new`] and [`write_png`].
pub fn write(
    recording: &Recording,
    path: &Path,
    options: &Options,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), Error> {
    match Format::of(path)? {
        Format::Gif => return write_gif(recording, path, options.picture, options.gif_frame_rate, progress),
        Format::Mp4 => {
            return write_mp4(recording, path, options.picture, OsStr::new("ffmpeg"), progress);
        }
        Format::Obj => return write_obj(recording, path, progress),
        Format::Pc2 => return write_pc2(recording, path, progress),
        Format::Ply => return write_ply(recording, path, progress),
        Format::Glb => write_glb(recording, path)?,
        Format::Html => write_html(recording, options.picture.camera, path)?,
        Format::Npz => write_npz(recording, path)?,
        Format::Png => write_frame(recording, path, options)?,
    }
    progress(1, 1);
    Ok(())
}

fn write_frame(recording: &Recording, path: &Path, options: &Options) -> Result<(), Error> {
    let last = recording.frame_count() - 1;
    let frame = options.png_frame.unwrap_or(last);
    if frame > last {
        let problem = format!("there is no frame {frame}: the last is {last}");
        return Err(Error::Unsupported { option: "png_frame", problem });
    }
    write_png(&Renderer::new(recording, options.picture)?.frame(frame), path)
}
