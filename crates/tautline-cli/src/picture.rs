//! Charts as files: drawn once, written as SVG or as PNG.

use std::error::Error;
use std::path::Path;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use tautline_scene::export::write_png;
use tautline_scene::render::Image;

use crate::failure::Failure;
use crate::output::write_text;

/// What can be drawn.
pub(crate) trait Drawing {
    /// Width and height of the SVG, in px.
    fn size(&self) -> (u32, u32);

    /// Draws it `scale` times as large as its size, on white.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
    where
        B::ErrorType: 'static;
}

pub(crate) type Drawn = Result<(), Box<dyn Error>>;

/// Of lines and letters.
pub(crate) const INK: RGBColor = RGBColor(40, 44, 52);

/// A PNG has so many times the pixels of the SVG, so that it is sharp on any screen. It is drawn `SAMPLES` times
/// larger still and averaged: its lines and letters have smooth edges.
const PNG_SCALE: u32 = 2;
const SAMPLES: u32 = 2;

/// Refuses a file that is neither `.svg` nor `.png`.
pub(crate) fn check_extension(path: &Path) -> Result<(), Failure> {
    if is_svg(path) || has_extension(path, "png") {
        return Ok(());
    }
    Err(Failure::Usage(format!("{}: the extension must be one of .png, .svg", path.display())))
}

fn is_svg(path: &Path) -> bool {
    has_extension(path, "svg")
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

/// Writes a drawing: `.svg` as SVG, anything else as PNG.
pub(crate) fn write(drawing: &impl Drawing, path: &Path) -> Result<(), Failure> {
    let failed = |error: Box<dyn Error>| Failure::Usage(format!("{}: {error}", path.display()));
    if is_svg(path) {
        return write_text(path, &svg(drawing).map_err(failed)?);
    }
    Ok(write_png(&image(drawing).map_err(failed)?, path)?)
}

/// A drawing as the text of an SVG.
pub(crate) fn svg(drawing: &impl Drawing) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    draw(drawing, &SVGBackend::with_string(&mut text, drawing.size()).into_drawing_area(), 1)?;
    Ok(text)
}

/// A drawing as pixels.
pub(crate) fn image(drawing: &impl Drawing) -> Result<Image, Box<dyn Error>> {
    let scale = PNG_SCALE * SAMPLES;
    let (width, height) = drawing.size();
    let (width, height) = (width * scale, height * scale);
    let mut bytes = vec![0; (width * height * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut bytes, (width, height)).into_drawing_area();
    draw(drawing, &area, scale)?;
    drop(area);
    Ok(averaged(&bytes, width as usize, SAMPLES as usize))
}

fn draw<B: DrawingBackend>(drawing: &impl Drawing, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
where
    B::ErrorType: 'static,
{
    register_font_once();
    area.fill(&WHITE)?;
    drawing.draw(area, scale)?;
    area.present()?;
    Ok(())
}

/// Takes the mean of every `samples` × `samples` pixels. In sRGB, not in light: dark text on white stays dark.
fn averaged(bytes: &[u8], row: usize, samples: usize) -> Image {
    let (width, height) = (row / samples, bytes.len() / (3 * row * samples));
    let mean = |x: usize, y: usize, channel: usize| {
        let at = |i: usize| ((y * samples + i / samples) * row + x * samples + i % samples) * 3 + channel;
        let sum: usize = (0..samples * samples).map(|i| usize::from(bytes[at(i)])).sum();
        (sum / (samples * samples)) as u8
    };
    let pixels = (0..width * height).map(|i| [0, 1, 2].map(|channel| mean(i % width, i / width, channel)));
    Image { width, height, pixels: pixels.collect() }
}

/// Text of this size, in px.
pub(crate) fn font(size: u32, scale: u32) -> TextStyle<'static> {
    ("sans-serif", size * scale).into_font().color(&INK)
}

/// A picture needs a font of its own: not every machine has one, and none the same.
fn register_font_once() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // It fails only for bytes that are no font; drawing would then say that there is none.
        let _ = register_font("sans-serif", FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    });
}
