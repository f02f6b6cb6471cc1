//! What the tests share: contacts that are made by hand.

mod find;
mod matrix;
mod working_set;

use super::super::elimination::Part;
use super::contact::{Contact, Hold, Point};

/// All ways to hold a point.
const HOLDS: [Hold; 3] = [Hold::Off, Hold::Slides, Hold::Sticks];

/// A row that moves b along a direction and a against it, and that turns neither.
fn level([x, y, z]: [f64; 3]) -> [Part; 2] {
    [[-x, -y, -z, 0.0, 0.0, 0.0], [x, y, z, 0.0, 0.0, 0.0]]
}

fn point(lines: [[Part; 2]; 3]) -> Point {
    let mut point = Point::default();
    point.lines = lines;
    point
}

/// A contact of bodies a and b at these points.
fn contact([a, b]: [u32; 2], friction: f64, points: Vec<Point>) -> Contact {
    let mut contact = Contact::default();
    (contact.ends, contact.friction, contact.points) = ([a, b], friction, points);
    contact
}
