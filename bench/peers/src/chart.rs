//! Time per body and step of all engines, as bars: one panel per phase, one group per number of bodies.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::canvas::{BOX3D, Drawn, FAINT, INK, OURS, Picture, RAPIER, draw_legend, relative, text};
use crate::compare::{FLYING, Phase, SETTLED, Series};
use crate::engine::Contender;

/// The whole chart.
pub(crate) struct Chart(Vec<Panel>);

/// Bars of one phase.
struct Panel {
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

/// The phases worth a picture.
pub(crate) fn chart(all: &[Series]) -> Chart {
    let panel = |phase: Phase, what: &str| {
        let [begin, end] = phase.steps();
        let groups = all.chunk_by(|a, b| a.n == b.n).map(|scene| group(scene, phase));
        Panel { title: format!("{what} (steps {begin}–{end})"), groups: groups.collect() }
    };
    Chart(vec![panel(FLYING, "Flying and colliding"), panel(SETTLED, "Settled pile")])
}

fn group(scene: &[Series], phase: Phase) -> Group {
    let bars = scene.iter().map(|series| Bar {
        contender: series.contender,
        microseconds: 1e3 * series.summary(phase).milliseconds / series.n as f64,
    });
    Group { n: scene.first().map_or(0, |series| series.n), bars: bars.collect() }
}

impl Picture for Chart {
    const SIZE: (u32, u32) = (860, 400);

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
    where
        B::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        let s = scale as i32;
        let title = "CPU time per body and step, in µs, one thread: less is better";
        area.draw(&text(title, (24 * s, 18 * s), 19, INK, HPos::Left, scale))?;
        let groups = || self.0.iter().flat_map(|panel| &panel.groups);
        let bars = groups().next().map_or(&[][..], |group| &group.bars);
        let names = bars.iter().map(|bar| bar.contender.label()).zip(colors(bars));
        draw_legend(&names.collect::<Vec<_>>(), area, scale)?;
        let body = area.margin(72 * s, 8 * s, 16 * s, 16 * s);
        let tallest = groups().flat_map(|group| &group.bars).map(|bar| bar.microseconds).fold(1e-6, f64::max);
        for (panel, area) in self.0.iter().zip(body.split_evenly((1, self.0.len()))) {
            draw_panel(panel, tallest, &area, scale)?;
        }
        area.present()?;
        Ok(())
    }
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

/// 4000 → "4 000".
fn grouped(n: usize) -> String {
    if n < 1000 { n.to_string() } else { format!("{} {:03}", grouped(n / 1000), n % 1000) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::{image, svg};

    fn bars() -> Chart {
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
        Chart(vec![panel("Flying"), panel("Settled")])
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
