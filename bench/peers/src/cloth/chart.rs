//! Time per step of all engines, as bars on a logarithmic axis, with the largest stretch above each: one panel per
//! scene, one group per resolution.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::compare::Series;
use super::engine::{Contender, Make};
use super::scene::Support;
use crate::canvas::{Drawn, FAINT, INK, OURS, Picture, RAPIER, RAPIER_LIGHT, draw_legend, relative, text};

/// The whole chart.
pub(crate) struct Chart(Vec<Panel>);

/// Bars of one scene.
struct Panel {
    support: Support,
    groups: Vec<Group>,
}

/// Bars of one resolution.
struct Group {
    n: u32,
    bars: Vec<Bar>,
}

struct Bar {
    contender: Contender,
    /// Per step.
    milliseconds: f64,
    /// In %; `None` if the cloth fell off, where it is not stretched.
    stretch: Option<f64>,
}

/// What the results look like.
pub(crate) fn chart(all: &[Series]) -> Chart {
    let bar = |series: &Series| {
        let summary = series.summary();
        let stretch = summary.is_held.then_some(summary.max_stretch);
        Bar { contender: series.contender, milliseconds: summary.milliseconds, stretch }
    };
    let group = |scene: &[Series]| Group { n: scene[0].n, bars: scene.iter().map(bar).collect() };
    let panel = |scenes: &[Series]| {
        let groups = scenes.chunk_by(|a, b| a.n == b.n).map(group);
        Panel { support: scenes[0].support, groups: groups.collect() }
    };
    Chart(all.chunk_by(|a, b| a.support == b.support).map(panel).collect())
}

impl Picture for Chart {
    const SIZE: (u32, u32) = (980, 420);

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
    where
        B::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        let s = scale as i32;
        let title = "CPU time per step, in ms (each line ten times the one below), and largest stretch: less is better";
        area.draw(&text(title, (24 * s, 18 * s), 19, INK, HPos::Left, scale))?;
        let bars = || self.0.iter().flat_map(|panel| &panel.groups).flat_map(|group| &group.bars);
        let mut names: Vec<(String, RGBColor)> = Vec::new();
        for entry in bars().map(|bar| (bar.contender.label(), color(bar.contender))) {
            if !names.contains(&entry) {
                names.push(entry);
            }
        }
        draw_legend(&names, area, scale)?;
        let times = || bars().map(|bar| bar.milliseconds.max(1e-3).log10());
        let range = [times().fold(0.0, f64::min).floor(), times().fold(1.0, f64::max)];
        let body = area.margin(72 * s, 8 * s, 16 * s, 16 * s);
        for (panel, area) in self.0.iter().zip(body.split_evenly((1, self.0.len().max(1)))) {
            draw_panel(panel, range, &area, scale)?;
        }
        area.present()?;
        Ok(())
    }
}

/// `range`: the decades shown, as logarithms.
fn draw_panel<B: DrawingBackend>(
    panel: &Panel,
    [low, high]: [f64; 2],
    area: &DrawingArea<B, Shift>,
    scale: u32,
) -> Drawn
where
    B::ErrorType: 'static,
{
    let s = scale as i32;
    let count = panel.groups.len() as f64;
    let mut axes = ChartBuilder::on(area)
        .margin(8 * scale)
        .x_label_area_size(44 * scale)
        .y_label_area_size(0)
        .build_cartesian_2d(-0.5..count - 0.5, low..high + 0.15 * (high - low))?;
    for decade in low as i32..=high as i32 {
        let height = f64::from(decade);
        let line = [(-0.5, height), (count - 0.5, height)];
        axes.draw_series([PathElement::new(line, FAINT.mix(0.25).stroke_width(scale))])?;
    }
    for (place, group) in panel.groups.iter().enumerate() {
        let width = 0.9 / group.bars.len() as f64;
        for (i, bar) in group.bars.iter().enumerate() {
            let left = place as f64 - 0.45 + i as f64 * width;
            let top = bar.milliseconds.max(1e-3).log10();
            let corners = [(left + 0.05 * width, low), (left + 0.95 * width, top)];
            axes.draw_series([Rectangle::new(corners, color(bar.contender).filled())])?;
            let (x, y) = axes.backend_coord(&(left + 0.5 * width, top));
            let label = |what: &str, up: i32, ink: RGBColor| {
                area.draw(&text(what, relative(area, (x, y - up * s)), 11, ink, HPos::Center, scale))
            };
            label(&three_digits(bar.milliseconds), 27, INK)?;
            let below = bar.stretch.map_or("fell".into(), |stretch| format!("{} %", two_digits(stretch)));
            label(&below, 14, FAINT)?;
        }
        let (x, y) = axes.backend_coord(&(place as f64, low));
        let label = format!("{0} × {0}", group.n);
        area.draw(&text(&label, relative(area, (x, y + 6 * s)), 13, INK, HPos::Center, scale))?;
    }
    let (x, y) = axes.backend_coord(&(0.5 * count - 0.5, low));
    let title = match panel.support {
        Support::Cube => "Cloth falls on a cube",
        Support::Rope => "Cloth falls on a rope",
    };
    area.draw(&text(title, relative(area, (x, y + 28 * s)), 14, FAINT, HPos::Center, scale))?;
    axes.draw_series([PathElement::new([(-0.5, low), (count - 0.5, low)], FAINT.stroke_width(scale))])?;
    Ok(())
}

fn color(contender: Contender) -> RGBColor {
    match (contender.make, contender.self_collision) {
        (Make::Ours, true) => OURS[0],
        (Make::Ours, false) => OURS[1],
        (Make::Rapier, true) => RAPIER,
        (Make::Rapier, false) => RAPIER_LIGHT,
    }
}

fn three_digits(value: f64) -> String {
    format!("{value:.*}", if value < 1.0 { 2 } else { usize::from(value < 100.0) })
}

fn two_digits(value: f64) -> String {
    format!("{value:.*}", usize::from(value < 10.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::{image, svg};

    fn bars() -> Chart {
        let contenders =
            [(Make::Ours, true), (Make::Ours, false), (Make::Rapier, true), (Make::Rapier, false)];
        let group = |n: u32| {
            let bars =
                contenders.iter().zip([0.1, 1.0, 10.0, 10.0]).map(|(&(make, self_collision), time)| Bar {
                    contender: Contender { make, self_collision },
                    milliseconds: time,
                    stretch: (time > 0.1).then_some(12.34),
                });
            Group { n, bars: bars.collect() }
        };
        let panel = |support: Support| Panel { support, groups: [20, 100].map(group).into() };
        Chart(vec![panel(Support::Cube), panel(Support::Rope)])
    }

    #[test]
    fn the_chart_names_what_it_shows() {
        let svg = svg(&bars()).unwrap();
        for text in
            ["less is better", "on a cube", "on a rope", "100 × 100", "rapier", "10.0", "12 %", "fell"]
        {
            assert!(svg.contains(text), "{text} is not in the SVG");
        }
    }

    #[test]
    fn ten_times_the_time_is_one_unit_higher() {
        let image = image(&bars()).unwrap();
        let area = |color: RGBColor| {
            image.pixels.iter().filter(|&&p| p == [color.0, color.1, color.2]).count() as f64
        };
        // 0.1 ms is the foot of the axis; a legend's square is left there.
        let [nothing, one, two] = [OURS[0], OURS[1], RAPIER].map(area);
        assert!(((two - nothing) / (one - nothing) - 2.0).abs() < 0.1, "{nothing} {one} {two}");
    }

    #[test]
    fn numbers_are_as_long_as_they_need_to_be() {
        assert_eq!([0.0512, 4.25, 357.2].map(three_digits), ["0.05", "4.2", "357"]);
        assert_eq!([1.94, 67.2].map(two_digits), ["1.9", "67"]);
    }
}
