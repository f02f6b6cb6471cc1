//! Line charts, drawn once and written as SVG and as PNG.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::failure::Failure;
use crate::picture::{self, Drawing, Drawn, INK, font};

/// A chart: panels side by side under one title.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chart {
    /// File name without extension.
    pub(super) file: &'static str,
    /// What it shows.
    pub(super) title: String,
    /// From left to right.
    pub(super) panels: Vec<Panel>,
}

/// Lines over common axes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panel {
    /// What is counted along the horizontal axis.
    pub(super) x_label: &'static str,
    /// What the lines show.
    pub(super) y_label: &'static str,
    /// How the vertical axis is divided.
    pub(super) scale: Scale,
    /// The lines, at most as many as there are colours.
    pub(super) lines: Vec<Line>,
}

/// How a vertical axis is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// Evenly, from 0.
    Linear,
    /// By powers of ten; all values are above 0.
    Logarithmic,
}

impl Scale {
    /// Where a value is along the axis.
    fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Logarithmic => libm::log10(value),
        }
    }

    /// Which value is there.
    fn value(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Logarithmic => libm::exp10(place),
        }
    }
}

/// One line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    /// Its name in the legend.
    pub(super) name: &'static str,
    /// (x, y), x ascending.
    pub(super) points: Vec<(f64, f64)>,
}

/// In px.
const SIZE: (u32, u32) = (760, 460);

/// Blue and orange can be told apart by everybody.
const COLORS: [RGBColor; 2] = [RGBColor(31, 95, 191), RGBColor(217, 108, 0)];
const GRID: RGBColor = RGBColor(226, 228, 232);

/// Writes a chart into a folder, as `.svg` and as `.png`.
pub(super) fn write(chart: &Chart, folder: &Path) -> Result<(), Failure> {
    let path = folder.join(chart.file);
    picture::write(chart, &path.with_extension("svg"))?;
    picture::write(chart, &path.with_extension("png"))
}

impl Drawing for Chart {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let margin = 6 * scale;
        let area = area.margin(2 * margin, margin, margin, margin).titled(&self.title, font(20, scale))?;
        for (panel, area) in self.panels.iter().zip(area.split_evenly((1, self.panels.len()))) {
            draw_panel(panel, &area, scale)?;
        }
        Ok(())
    }
}

fn draw_panel<B: DrawingBackend>(panel: &Panel, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
where
    B::ErrorType: 'static,
{
    let places = |line: &Line| -> Vec<(f64, f64)> {
        line.points.iter().map(|&(x, y)| (x, panel.scale.place(y))).collect()
    };
    let all: Vec<(f64, f64)> = panel.lines.iter().flat_map(places).collect();
    let x_last = all.iter().map(|p| p.0).fold(1.0, f64::max);
    // From 0, unless that would leave half of the chart empty.
    let x_least = all.iter().map(|p| p.0).fold(x_last, f64::min);
    let x_first = if x_least > 0.4 * x_last { x_least - 0.04 * x_last } else { 0.0 };
    let y_last = all.iter().map(|p| p.1).fold(1.0, f64::max);
    let y_first = match panel.scale {
        Scale::Linear => 0.0,
        Scale::Logarithmic => all.iter().map(|p| p.1).fold(y_last, f64::min).floor(),
    };
    let mut axes = ChartBuilder::on(area)
        .margin(8 * scale)
        .x_label_area_size(38 * scale)
        .y_label_area_size(62 * scale)
        .build_cartesian_2d(x_first..x_last * 1.04, y_first..y_last * 1.12)?;
    axes.configure_mesh()
        .bold_line_style(GRID.stroke_width(scale))
        .light_line_style(TRANSPARENT)
        .axis_style(INK.stroke_width(scale))
        .label_style(font(13, scale))
        .axis_desc_style(font(14, scale))
        .set_all_tick_mark_size(4 * scale)
        .x_labels(6)
        .y_labels(6)
        .x_label_formatter(&|x| number(*x))
        .y_label_formatter(&|y| number(panel.scale.value(*y)))
        .x_desc(panel.x_label)
        .y_desc(panel.y_label)
        .draw()?;
    for (line, color) in panel.lines.iter().zip(COLORS) {
        let style = color.stroke_width(2 * scale);
        let dots = places(line).into_iter().map(|point| Circle::new(point, 4 * scale, color.filled()));
        axes.draw_series(LineSeries::new(places(line), style))?
            .label(line.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16 * scale as i32, y)], style));
        axes.draw_series(dots)?;
    }
    if panel.lines.len() > 1 {
        axes.configure_series_labels()
            .position(legend_position(&panel.lines))
            .legend_area_size(22 * scale)
            .margin(10 * scale)
            .background_style(WHITE.mix(0.85))
            .label_font(font(14, scale))
            .draw()?;
    }
    Ok(())
}

/// The upper corner that the lines leave free.
fn legend_position(lines: &[Line]) -> SeriesLabelPosition {
    match lines.first().map(|line| line.points.as_slice()) {
        Some([first, .., last]) if first.1 > last.1 => SeriesLabelPosition::UpperRight,
        _ => SeriesLabelPosition::UpperLeft,
    }
}

/// 12500 → "12 500": digits in groups of three.
pub(super) fn number(value: f64) -> String {
    let digits = format!("{value:.0}");
    let (sign, digits) = digits.strip_prefix('-').map_or(("", digits.as_str()), |rest| ("-", rest));
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().filter_map(|g| str::from_utf8(g).ok()).collect();
    format!("{sign}{}", groups.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{image, svg};

    fn chart() -> Chart {
        let rising = Line { name: "rising", points: vec![(5.0, 10.0), (50.0, 12_500.0)] };
        let falling = Line { name: "falling", points: vec![(5.0, 9000.0), (50.0, 20.0)] };
        let panel = Panel {
            x_label: "bodies",
            y_label: "per step",
            scale: Scale::Linear,
            lines: vec![rising, falling],
        };
        let logarithmic = Panel { scale: Scale::Logarithmic, ..panel.clone() };
        Chart { file: "test", title: "A chart".into(), panels: vec![panel, logarithmic] }
    }

    #[test]
    fn both_formats_show_title_axes_and_lines() {
        let svg = svg(&chart()).unwrap();
        for text in ["A chart", "bodies", "per step", "rising", "falling", "10 000", "100"] {
            assert!(svg.contains(text), "{text} is not in the SVG");
        }
        let image = image(&chart()).unwrap();
        assert_eq!(image.pixels.len(), image.width * image.height);
        for color in COLORS {
            let drawn = image.pixels.iter().filter(|&&pixel| pixel == [color.0, color.1, color.2]).count();
            assert!(drawn > 1000, "{color:?} is drawn on {drawn} pixels");
        }
    }

    #[test]
    fn numbers_are_grouped() {
        let texts = [0.0, 999.0, 1000.0, -12_500.0, 1e6].map(number);
        assert_eq!(texts, ["0", "999", "1 000", "-12 500", "1 000 000"]);
    }
}
