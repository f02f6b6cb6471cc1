//! Recordings out: pictures and animations.

mod atomic;
mod gif;
mod glb;
mod html;
mod palette;
mod png;

use std::path::Path;

use crate::Error;
use crate::recording::Recording;
use crate::render::{Renderer, Settings};

pub use atomic::{check_writable, write_atomically};
pub use gif::write_gif;
pub use glb::{glb_bytes, write_glb};
pub use html::{html, write_html};
pub use png::write_png;

/// The extensions that [`write()`] knows.
pub const FORMATS: &str = ".gif, .glb, .html, .png";

/// A format that recordings are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Moving pictures.
    Gif,
    /// Animated glTF.
    Glb,
    /// A page that plays it.
    Html,
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

/// Writes a recording in the format that the extension of `path` names: `.glb` (animated glTF), `.gif`,
/// `.html` (a page that plays it) or `.png` (one frame). `progress` is told (steps done, steps to do).
///
/// # Errors
/// [`Error::UnsupportedFormat`] for another extension; otherwise those of [`write_glb`], [`write_gif`],
/// [`write_html`], [`Renderer::new`] and [`write_png`].
pub fn write(
    recording: &Recording,
    path: &Path,
    options: &Options,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), Error> {
    match Format::of(path)? {
        Format::Gif => return write_gif(recording, path, options.picture, options.gif_frame_rate, progress),
        Format::Glb => write_glb(recording, path)?,
        Format::Html => write_html(recording, options.picture.camera, path)?,
        Format::Png => {
            let last = recording.frame_count() - 1;
            let frame = options.png_frame.unwrap_or(last);
            if frame > last {
                let problem = format!("there is no frame {frame}: the last is {last}");
                return Err(Error::Unsupported { option: "png_frame", problem });
            }
            write_png(&Renderer::new(recording, options.picture)?.frame(frame), path)?;
        }
    }
    progress(1, 1);
    Ok(())
}
