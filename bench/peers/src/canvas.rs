//! What all charts share: a picture as SVG and as PNG, its font and its colours.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use tautline_scene::render::Image;

use crate::Failure;

pub(crate) const INK: RGBColor = RGBColor(40, 44, 52);
pub(crate) const FAINT: RGBColor = RGBColor(118, 124, 134);
/// Ours, the most important first: blue, which everybody can tell from orange and grey.
pub(crate) const OURS: [RGBColor; 3] =
    [RGBColor(31, 95, 191), RGBColor(122, 168, 232), RGBColor(186, 210, 243)];
pub(crate) const RAPIER: RGBColor = RGBColor(224, 122, 32);
pub(crate) const RAPIER_LIGHT: RGBColor = RGBColor(243, 190, 140);
pub(crate) const BOX3D: RGBColor = RGBColor(150, 155, 164);

/// A PNG has so many times as many px along each side as the SVG, so that it is sharp on any screen.
const PNG_SCALE: u32 = 2;

pub(crate) type Drawn = Result<(), Box<dyn Error>>;

/// Something that can be drawn.
pub(crate) trait Picture {
    /// In px of the SVG.
    const SIZE: (u32, u32);

    /// Draws it `scale` times as large as [`Picture::SIZE`].
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
    where
        B::ErrorType: 'static;
}

/// Where a chart goes: `file` as SVG and as PNG.
pub(crate) fn files(file: &Path) -> [PathBuf; 2] {
    ["svg", "png"].map(|extension| file.with_extension(extension))
}

/// A picture as text.
pub(crate) fn svg<P: Picture>(picture: &P) -> Result<String, Failure> {
    register_font_once();
    let mut text = String::new();
    picture.draw(&SVGBackend::with_string(&mut text, P::SIZE).into_drawing_area(), 1).map_err(plain)?;
    Ok(text)
}

/// Writes a picture as PNG.
pub(crate) fn write_png(picture: &impl Picture, file: &Path) -> Result<(), Failure> {
    Ok(tautline_scene::export::write_png(&image(picture)?, file)?)
}

pub(crate) fn image<P: Picture>(picture: &P) -> Result<Image, Failure> {
    register_font_once();
    let (width, height) = (P::SIZE.0 * PNG_SCALE, P::SIZE.1 * PNG_SCALE);
    let mut bytes = vec![0; (width * height * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut bytes, (width, height)).into_drawing_area();
    picture.draw(&area, PNG_SCALE).map_err(plain)?;
    drop(area);
    let (pixels, _) = bytes.as_chunks();
    Ok(Image { width: width as usize, height: height as usize, pixels: pixels.to_vec() })
}

fn plain(error: Box<dyn Error>) -> Failure {
    format!("chart: {error}").into()
}

/// A coloured square and a name for each entry, in one line from the left.
pub(crate) fn draw_legend<B: DrawingBackend>(
    entries: &[(String, RGBColor)],
    area: &DrawingArea<B, Shift>,
    scale: u32,
) -> Drawn
where
    B::ErrorType: 'static,
{
    let s = scale as i32;
    let mut x = 24 * s;
    for (label, color) in entries {
        let square = [(x, 49 * s), (x + 12 * s, 61 * s)];
        area.draw(&Rectangle::new(square, color.filled()))?;
        area.draw(&text(label, (x + 18 * s, 49 * s), 14, INK, HPos::Left, scale))?;
        let (width, _) = area.estimate_text_size(label, &font(14, INK, scale))?;
        x += 18 * s + width as i32 + 26 * s;
    }
    Ok(())
}

/// From the coordinates of the whole picture to those of a part of it.
pub(crate) fn relative<B: DrawingBackend>(area: &DrawingArea<B, Shift>, (x, y): (i32, i32)) -> (i32, i32) {
    let (left, top) = area.get_base_pixel();
    (x - left, y - top)
}

/// A line of text; `place` is the middle or the left end of its upper edge.
pub(crate) fn text(
    what: &str,
    place: (i32, i32),
    size: u32,
    color: RGBColor,
    anchor: HPos,
    scale: u32,
) -> Text<'static, (i32, i32), String> {
    Text::new(what.to_owned(), place, font(size, color, scale).pos(Pos::new(anchor, VPos::Top)))
}

fn font(size: u32, color: RGBColor, scale: u32) -> TextStyle<'static> {
    ("sans-serif", size * scale).into_font().color(&color)
}

/// A picture needs a font of its own: not every machine has one, and none the same.
fn register_font_once() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // It fails only for bytes that are no font; drawing would then say that there is none.
        let _ = register_font("sans-serif", FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    });
}
