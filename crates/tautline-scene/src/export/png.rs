//! One frame as a PNG picture.

use std::path::Path;

use super::atomic::{io_error, write_atomically};
use crate::Error;
use crate::render::Image;

/// Writes a picture.
///
/// # Errors
/// [`Error::Io`] if the file cannot be written.
pub fn write_png(image: &Image, path: &Path) -> Result<(), Error> {
    write_atomically(path, |out| {
        let mut encoder = png::Encoder::new(out, image.width as u32, image.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let write = |mut encoder: png::Writer<_>| {
            encoder.write_image_data(image.pixels.as_flattened())?;
            encoder.finish()
        };
        encoder.write_header().and_then(write).map_err(|source| io_error(path, source))
    })
}
