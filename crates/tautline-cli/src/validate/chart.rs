//! Errors of all cases against what is demanded and against the peers', on one logarithmic scale.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use tautline_scene::validate::{Outcome, PEERS, figures};

use crate::picture::{Drawing, Drawn, INK, font};

/// A row of dots for each case.
pub(super) struct Chart {
    rows: Vec<Row>,
}

struct Row {
    id: u32,
    name: &'static str,
    /// In units of the demand.
    ours: f64,
    peers: [Option<f64>; 2],
}

impl Chart {
    pub(super) fn new(outcomes: &[Outcome]) -> Self {
        let row = |outcome: &Outcome| {
            let figure = figures().iter().find(|figure| figure.id == outcome.id);
            let peers = figure.map_or([None; 2], |figure| figure.ratios());
            Row { id: outcome.id, name: outcome.name, ours: outcome.ratio(), peers }
        };
        Self { rows: outcomes.iter().map(row).collect() }
    }
}

const WIDTH: u32 = 900;
const ROW: u32 = 25;
/// Above the rows: title and legend.
const TOP: u32 = 84;
/// Below them: the scale.
const BOTTOM: u32 = 56;
/// Where the scale begins and ends, in px.
const LEFT: u32 = 330;
const RIGHT: u32 = 874;
/// Powers of ten at the ends of the scale; what is beyond is put on the end.
const DECADES: [i32; 2] = [-4, 4];

/// Blue can be told from orange and grey by everybody.
const OURS: RGBColor = RGBColor(31, 95, 191);
const PEER_COLORS: [RGBColor; 2] = [RGBColor(224, 122, 32), RGBColor(138, 143, 152)];
const FAINT: RGBColor = RGBColor(118, 124, 134);
const GRID: RGBColor = RGBColor(226, 228, 232);
/// What is within the demand.
const GOOD: RGBColor = RGBColor(235, 244, 238);

/// Where an error, in units of the demand, is on the scale, in px; and whether it is beyond the scale's end.
fn place(ratio: f64) -> (i32, bool) {
    let [low, high] = DECADES.map(f64::from);
    let decade = if ratio > 0.0 { libm::log10(ratio) } else { f64::NEG_INFINITY };
    let share = (decade.clamp(low, high) - low) / (high - low);
    let x = f64::from(LEFT) + share * f64::from(RIGHT - LEFT);
    (x.round() as i32, decade < low || decade > high)
}

impl Drawing for Chart {
    fn size(&self) -> (u32, u32) {
        (WIDTH, TOP + ROW * self.rows.len() as u32 + BOTTOM)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let pen = Pen { area, scale };
        pen.text(
            "Errors against closed forms, in multiples of what is demanded",
            (24, 16),
            19,
            INK,
            HPos::Left,
        )?;
        draw_legend(&pen)?;
        let bottom = (TOP + ROW * self.rows.len() as u32) as i32;
        draw_scale(&pen, bottom)?;
        for (index, row) in self.rows.iter().enumerate() {
            draw_row(&pen, row, TOP as i32 + ROW as i32 * index as i32 + ROW as i32 / 2)?;
        }
        Ok(())
    }
}

/// Draws in px of the SVG.
struct Pen<'a, B: DrawingBackend> {
    area: &'a DrawingArea<B, Shift>,
    scale: u32,
}

impl<B: DrawingBackend> Pen<'_, B>
where
    B::ErrorType: 'static,
{
    fn at(&self, (x, y): (i32, i32)) -> (i32, i32) {
        (x * self.scale as i32, y * self.scale as i32)
    }

    /// `place` is the left end, the middle or the right end of its height.
    fn text(&self, what: &str, place: (i32, i32), size: u32, color: RGBColor, anchor: HPos) -> Drawn {
        let style = font(size, self.scale).color(&color).pos(Pos::new(anchor, VPos::Center));
        Ok(self.area.draw(&Text::new(what.to_owned(), self.at(place), style))?)
    }

    fn width(&self, what: &str, size: u32) -> Result<i32, Box<dyn std::error::Error>> {
        let (width, _) = self.area.estimate_text_size(what, &font(size, self.scale))?;
        Ok((width / self.scale) as i32)
    }

    fn line(&self, from: (i32, i32), to: (i32, i32), style: ShapeStyle) -> Drawn {
        let style = ShapeStyle { stroke_width: style.stroke_width * self.scale, ..style };
        Ok(self.area.draw(&PathElement::new([self.at(from), self.at(to)], style))?)
    }

    fn rectangle(&self, from: (i32, i32), to: (i32, i32), color: RGBColor) -> Drawn {
        Ok(self.area.draw(&Rectangle::new([self.at(from), self.at(to)], color.filled()))?)
    }

    /// Filled; a ring for what is beyond the scale.
    fn dot(&self, place: (i32, i32), radius: u32, color: RGBColor, is_beyond: bool) -> Drawn {
        let place = self.at(place);
        let fill = if is_beyond { WHITE } else { color };
        self.area.draw(&Circle::new(place, radius * self.scale, fill.filled()))?;
        self.area.draw(&Circle::new(place, radius * self.scale, color.stroke_width(2 * self.scale)))?;
        Ok(())
    }
}

fn draw_legend<B: DrawingBackend>(pen: &Pen<'_, B>) -> Drawn
where
    B::ErrorType: 'static,
{
    let mut x = 30;
    let ours = [("tautline".to_owned(), OURS)];
    let peers =
        PEERS.iter().zip(PEER_COLORS).map(|(peer, color)| (format!("{} {}", peer.name, peer.version), color));
    for (label, color) in ours.into_iter().chain(peers) {
        pen.dot((x, 56), 5, color, false)?;
        pen.text(&label, (x + 12, 55), 14, INK, HPos::Left)?;
        x += 12 + pen.width(&label, 14)? + 28;
    }
    pen.dot((x, 56), 5, FAINT, true)?;
    pen.text("beyond the scale", (x + 12, 55), 14, FAINT, HPos::Left)
}

/// The ground that counts as good, a line for each power of ten, and what they are.
fn draw_scale<B: DrawingBackend>(pen: &Pen<'_, B>, bottom: i32) -> Drawn
where
    B::ErrorType: 'static,
{
    let top = TOP as i32 - 4;
    let (demand, _) = place(1.0);
    pen.rectangle((LEFT as i32 - 14, top), (demand, bottom), GOOD)?;
    for decade in DECADES[0]..=DECADES[1] {
        let value = libm::exp10(f64::from(decade));
        let (x, _) = place(value);
        pen.line((x, top), (x, bottom), GRID.stroke_width(1))?;
        let label =
            if decade < 0 { format!("1/{}", libm::exp10(f64::from(-decade))) } else { value.to_string() };
        pen.text(&label, (x, bottom + 14), 13, INK, HPos::Center)?;
    }
    pen.line((demand, top), (demand, bottom), INK.stroke_width(2))?;
    pen.text("within the demand", (demand - 10, bottom + 36), 13, FAINT, HPos::Right)?;
    pen.text("beyond it", (demand + 10, bottom + 36), 13, FAINT, HPos::Left)
}

fn draw_row<B: DrawingBackend>(pen: &Pen<'_, B>, row: &Row, y: i32) -> Drawn
where
    B::ErrorType: 'static,
{
    pen.text(&row.id.to_string(), (48, y - 1), 13, FAINT, HPos::Right)?;
    pen.text(row.name, (58, y - 1), 13, INK, HPos::Left)?;
    pen.line((LEFT as i32 - 14, y), (RIGHT as i32 + 8, y), GRID.stroke_width(1))?;
    for (ratio, color) in row.peers.iter().zip(PEER_COLORS) {
        if let Some(ratio) = ratio {
            let (x, is_beyond) = place(*ratio);
            pen.dot((x, y), 5, color, is_beyond)?;
        }
    }
    // Ours last, so that no other hides it.
    let (x, is_beyond) = place(row.ours);
    pen.dot((x, y), 6, OURS, is_beyond)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::svg;

    #[test]
    fn the_scale_is_logarithmic_and_ends() {
        let (demand, is_beyond) = place(1.0);
        assert_eq!((demand as u32, is_beyond), ((LEFT + RIGHT) / 2, false));
        assert_eq!(place(10.0).0 - demand, demand - place(0.1).0);
        assert_eq!(place(f64::INFINITY), (RIGHT as i32, true));
        assert_eq!(place(0.0), (LEFT as i32, true));
    }

    #[test]
    fn the_chart_names_what_it_shows() {
        let row = Row { id: 13, name: "tower of cubes", ours: 0.5, peers: [Some(20.0), None] };
        let text = svg(&Chart { rows: vec![row] }).unwrap();
        for part in
            ["tower of cubes", "tautline", "rapier3d 0.36.1", "MuJoCo 4.0.0", "1/1000", "within the demand"]
        {
            assert!(text.contains(part), "{part} is not in the SVG");
        }
        // A dot and its rim for ours and for one peer, in the row and in the legend.
        assert_eq!(text.matches("#E07A20").count(), 4, "{text}");
    }
}
