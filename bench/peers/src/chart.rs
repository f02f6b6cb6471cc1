//! Time per body and step of all engines, as bars: one panel per phase, one group per number of bodies.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use tautline_scene::render::Image;

use crate::Failure;
use crate::compare::{FLYING, Phase, SETTLED, Series};
use crate::engine::Contender;

/// Bars of one phase.
pub(crate) struct Panel {
    title: String,
    groups: Vec<Group>,
}

/// Bars of one number of bodies.
struct Group {
    n: usize,
    bars: Vec<Bar>,
}

/// In µs per body and step: what a linear axis can show for 200 and for 4 000 bodies.
struct Bar {
    contender: Contender,
    microseconds: f64,
}

/// In px of the SVG; the PNG has `PNG_SCALE` times as many, so that it is sharp on any screen.
const SIZE: (u32, u32) = (860, 400);
const PNG_SCALE: u32 = 2;

const INK: RGBColor = RGBColor(40, 44, 52);
const FAINT: RGBColor = RGBColor(118, 124, 134);
/// Ours, by order of substeps: blue, which everybody can tell from orange and grey.
const OURS: [RGBColor; 3] = [RGBColor(31, 95, 191), RGBColor(122, 168, 232), RGBColor(186, 210, 243)];
const RAPIER: RGBColor = RGBColor(224, 122, 32);
const BOX3D: RGBColor = RGBColor(150, 155, 164);

/// Where the chart goes: `file` as SVG and as PNG.
pub(crate) fn files(file: &Path) -> [PathBuf; 2] {
    ["svg", "png"].map(|extension| file.with_extension(extension))
}

/// The phases worth a picture.
pub(crate) fn panels(all: &[Series]) -> Vec<Panel> {
    let panel = |phase: Phase, what: &str| {
        let [begin, end] = phase.steps();
        let groups = all.chunk_by(|a, b| a.n == b.n).map(|scene| group(scene, phase));
        Panel { title: format!("{what} (steps {begin}–{end})"), groups: groups.collect() }
    };
    vec![panel(FLYING, "Flying and colliding"), panel(SETTLED, "Settled pile")]
}

fn group(scene: &[Series], phase: Phase) -> Group {
    let bars = scene.iter().map(|series| Bar {
        contender: series.contender,
        microseconds: 1e3 * series.summary(phase).milliseconds / series.n as f64,
    });
    Group { n: scene.first().map_or(0, |series| series.n), bars: bars.collect() }
}

/// The chart as text.
pub(crate) fn svg(panels: &[Panel]) -> Result<String, Failure> {
    let mut text = String::new();
    draw(panels, &SVGBackend::with_string(&mut text, SIZE).into_drawing_area(), 1).map_err(plain)?;
    Ok(text)
}

/// Writes the chart as a picture.
pub(crate) fn write_png(panels: &[Panel], file: &Path) -> Result<(), Failure> {
    Ok(tautline_scene::export::write_png(&image(panels)?, file)?)
}

fn image(panels: &[Panel]) -> Result<Image, Failure> {
    let (width, height) = (SIZE.0 * PNG_SCALE, SIZE.1 * PNG_SCALE);
    let mut bytes = vec![0; (width * height * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut bytes, (width, height)).into_drawing_area();
    draw(panels, &area, PNG_SCALE).map_err(plain)?;
    drop(area);
    let (pixels, _) = bytes.as_chunks();
    Ok(Image { width: width as usize, height: height as usize, pixels: pixels.to_vec() })
}

fn plain(error: Box<dyn Error>) -> Failure {
    format!("chart: {error}").into()
}

type Drawn = Result<(), Box<dyn Error>>;

/// Draws the chart `scale` times as large as [`SIZE`].
fn draw<B: DrawingBackend>(panels: &[Panel], area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
where
    B::ErrorType: 'static,
{
    register_font_once();
    area.fill(&WHITE)?;
    let s = scale as i32;
    area.draw(&text(
        "CPU time per body and step, in µs, one thread: less is better",
        (24 * s, 18 * s),
        19,
        INK,
        HPos::Left,
        scale,
    ))?;
    draw_legend(panels, area, scale)?;
    let body = area.margin(72 * s, 8 * s, 16 * s, 16 * s);
    let tallest = panels.iter().flat_map(|panel| &panel.groups).flat_map(|group| &group.bars);
    let tallest = tallest.map(|bar| bar.microseconds).fold(1e-6, f64::max);
    for (panel, area) in panels.iter().zip(body.split_evenly((1, panels.len()))) {
        draw_panel(panel, tallest, &area, scale)?;
    }
    area.present()?;
    Ok(())
}

/// A square and a name for each engine, in one line.
fn draw_legend<B: DrawingBackend>(panels: &[Panel], area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
where
    B::ErrorType: 'static,
{
    let s = scale as i32;
    let mut x = 24 * s;
    let bars = panels.iter().flat_map(|panel| &panel.groups).next().map_or(&[][..], |group| &group.bars);
    for (bar, color) in bars.iter().zip(colors(bars)) {
        let square = [(x, 49 * s), (x + 12 * s, 61 * s)];
        area.draw(&Rectangle::new(square, color.filled()))?;
        let label = bar.contender.label();
        area.draw(&text(&label, (x + 18 * s, 49 * s), 14, INK, HPos::Left, scale))?;
        let (width, _) = area.estimate_text_size(&label, &font(14, INK, scale))?;
        x += 18 * s + width as i32 + 26 * s;
    }
    Ok(())
}

fn draw_panel<B: DrawingBackend>(
    panel: &Panel,
    tallest: f64,
    area: &DrawingArea<B, Shift>,
    scale: u32,
) -> Drawn
where
    B::ErrorType: 'static,
{
    let s = scale as i32;
    let mut axes = ChartBuilder::on(area)
        .margin(8 * scale)
        .x_label_area_size(44 * scale)
        .y_label_area_size(0)
        .build_cartesian_2d(-0.5..panel.groups.len() as f64 - 0.5, 0.0..tallest * 1.1)?;
    for (place, group) in panel.groups.iter().enumerate() {
        let width = 0.84 / group.bars.len() as f64;
        for (i, (bar, color)) in group.bars.iter().zip(colors(&group.bars)).enumerate() {
            let left = place as f64 - 0.42 + i as f64 * width;
            let corners = [(left + 0.05 * width, 0.0), (left + 0.95 * width, bar.microseconds)];
            axes.draw_series([Rectangle::new(corners, color.filled())])?;
            let (x, y) = axes.backend_coord(&(left + 0.5 * width, bar.microseconds));
            let label = format!("{:.2}", bar.microseconds);
            area.draw(&text(&label, relative(area, (x, y - 15 * s)), 12, INK, HPos::Center, scale))?;
        }
        let (x, y) = axes.backend_coord(&(place as f64, 0.0));
        let label = format!("{} bodies", grouped(group.n));
        area.draw(&text(&label, relative(area, (x, y + 6 * s)), 13, INK, HPos::Center, scale))?;
    }
    let (x, y) = axes.backend_coord(&(0.5 * panel.groups.len() as f64 - 0.5, 0.0));
    area.draw(&text(&panel.title, relative(area, (x, y + 28 * s)), 14, FAINT, HPos::Center, scale))?;
    let base = [(0.0 - 0.5, 0.0), (panel.groups.len() as f64 - 0.5, 0.0)];
    axes.draw_series([PathElement::new(base, FAINT.stroke_width(scale))])?;
    Ok(())
}

/// Bars keep their engine's colour, whichever others are there.
fn colors(bars: &[Bar]) -> Vec<RGBColor> {
    let mut ours = OURS.into_iter().cycle();
    let color = |bar: &Bar| match bar.contender {
        Contender::Ours { .. } => ours.next().unwrap_or(OURS[0]),
        Contender::Rapier => RAPIER,
        Contender::Box3d => BOX3D,
    };
    bars.iter().map(color).collect()
}

/// From the coordinates of the whole picture to those of a part of it.
fn relative<B: DrawingBackend>(area: &DrawingArea<B, Shift>, (x, y): (i32, i32)) -> (i32, i32) {
    let (left, top) = area.get_base_pixel();
    (x - left, y - top)
}

/// A line of text; `place` is the middle or the left end of its upper edge.
fn text(
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

/// 4000 → "4 000".
fn grouped(n: usize) -> String {
    if n < 1000 { n.to_string() } else { format!("{} {:03}", grouped(n / 1000), n % 1000) }
}

/// A picture needs a font of its own: not every machine has one, and none the same.
fn register_font_once() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // It fails only for bytes that are no font; drawing would then say that there is none.
        let _ = register_font("sans-serif", FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bars() -> Vec<Panel> {
        let contenders = [
            Contender::Ours { substeps: 8 },
            Contender::Ours { substeps: 4 },
            Contender::Rapier,
            Contender::Box3d,
        ];
        let group = |n: usize| Group {
            n,
            bars: contenders
                .iter()
                .zip(1..)
                .map(|(&contender, i)| Bar { contender, microseconds: f64::from(i) })
                .collect(),
        };
        let panel = |title: &str| Panel { title: title.into(), groups: [200, 4000].map(group).into() };
        vec![panel("Flying"), panel("Settled")]
    }

    #[test]
    fn the_chart_names_what_it_shows() {
        let svg = svg(&bars()).unwrap();
        let texts = [
            "less is better",
            "Flying",
            "Settled",
            "200 bodies",
            "4 000 bodies",
            "8 substeps",
            "rapier",
            "Box3D",
            "3.00",
        ];
        for text in texts {
            assert!(svg.contains(text), "{text} is not in the SVG");
        }
    }

    #[test]
    fn bars_are_as_high_as_their_values() {
        let image = image(&bars()).unwrap();
        let area = |color: RGBColor| {
            image.pixels.iter().filter(|&&p| p == [color.0, color.1, color.2]).count() as f64
        };
        // The legend's squares and the baseline make a small difference.
        let unit = area(OURS[0]);
        for (color, height) in [(OURS[1], 2.0), (RAPIER, 3.0), (BOX3D, 4.0)] {
            assert!((area(color) / unit / height - 1.0).abs() < 0.05, "{color:?}: {}", area(color) / unit);
        }
    }

    #[test]
    fn thousands_are_set_apart() {
        assert_eq!([200, 4000, 16_050, 1_000_000].map(grouped), ["200", "4 000", "16 050", "1 000 000"]);
    }
}
