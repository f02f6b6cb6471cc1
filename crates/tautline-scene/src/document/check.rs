//! Collects what is wrong with a document, each thing with its path.

use std::fmt::Display;

use super::limits;
use crate::error::{Problem, legible};

/// What a number must satisfy, and how that is said.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    holds: fn(f32) -> bool,
    expected: &'static str,
}

/// A coordinate, in m, or a component of a velocity.
pub(super) const COORDINATE: Rule =
    Rule { holds: |x| x.abs() <= limits::REACH, expected: "a finite number between -1000000 and 1000000" };
/// A length, in m.
pub(super) const LENGTH: Rule =
    Rule { holds: |x| x > 0.0 && x <= limits::REACH, expected: "a finite number above 0, up to 1000000" };
/// A length that may be nothing, in m.
pub(super) const THICKNESS: Rule =
    Rule { holds: |x| (0.0..=limits::REACH).contains(&x), expected: "a finite number from 0 to 1000000" };
/// A mass or a density.
pub(super) const MASS: Rule =
    Rule { holds: |x| x > 0.0 && x <= limits::MASS, expected: "a finite number above 0, up to 1e12" };
/// Any positive number.
pub(super) const POSITIVE: Rule =
    Rule { holds: |x| x > 0.0 && x.is_finite(), expected: "a finite number above 0" };
/// Any number that is not negative.
pub(super) const NOT_NEGATIVE: Rule =
    Rule { holds: |x| x >= 0.0 && x.is_finite(), expected: "a finite number, at least 0" };
/// A time step, in s.
pub(super) const STEP: Rule =
    Rule { holds: |x| x > 0.0 && x <= 1.0, expected: "a finite number above 0, up to 1 second" };
/// A share of a length that a stick may be off.
pub(super) const TOLERANCE: Rule =
    Rule { holds: |x| (0.0..=0.5).contains(&x), expected: "a number from 0 to 0.5" };
/// A rate, in 1/s.
pub(super) const RATE: Rule =
    Rule { holds: |x| (0.0..=1e6).contains(&x), expected: "a number from 0 to 1000000" };
/// A part of a whole.
pub(super) const SHARE: Rule = Rule { holds: |x| (0.0..=1.0).contains(&x), expected: "a number from 0 to 1" };
/// How many times something acts.
pub(super) const FACTOR: Rule =
    Rule { holds: |x| x.abs() <= 1e6, expected: "a finite number between -1000000 and 1000000" };
/// An angle between two segments, in degrees.
pub(super) const ANGLE: Rule =
    Rule { holds: |x| (0.0..=180.0).contains(&x), expected: "a number of degrees from 0 to 180" };
/// An opening angle, in degrees.
pub(super) const OPENING: Rule =
    Rule { holds: |x| x > 0.0 && x < 180.0, expected: "a number of degrees between 0 and 180" };
/// Young's modulus, in Pa.
pub(super) const MODULUS: Rule =
    Rule { holds: |x| (1e-6..=1e15).contains(&x), expected: "a number from 1e-6 to 1e15" };
/// How much narrower than longer a soft solid gets.
pub(super) const POISSON_RATIO: Rule =
    Rule { holds: |x| (0.0..=0.49).contains(&x), expected: "a number from 0 to 0.49" };
/// A compliance, or the strength of a motor.
pub(super) const UP_TO_HUGE: Rule =
    Rule { holds: |x| (0.0..=1e20).contains(&x), expected: "a number from 0 to 1e20" };
/// A coefficient of the air's, or its density.
pub(super) const COEFFICIENT: Rule =
    Rule { holds: |x| (0.0..=1e6).contains(&x), expected: "a number from 0 to 1000000" };
/// What fabric gives per force, or the pressure in it.
pub(super) const UP_TO_LARGE: Rule =
    Rule { holds: |x| (0.0..=1e12).contains(&x), expected: "a number from 0 to 1e12" };
/// A resistance to bending.
pub(super) const STIFFNESS: Rule =
    Rule { holds: |x| (1e-20..=1e12).contains(&x), expected: "a number from 1e-20 to 1e12" };
/// A share of its length that something stretches by.
pub(super) const STRAIN: Rule =
    Rule { holds: |x| (0.0..=1e3).contains(&x), expected: "a number from 0 to 1000" };
/// A strain at which something happens.
pub(super) const SOME_STRAIN: Rule =
    Rule { holds: |x| (1e-6..=1e3).contains(&x), expected: "a number from 1e-6 to 1000" };
/// A turn to either side, in degrees.
pub(super) const HALF_TURN: Rule =
    Rule { holds: |x| x.abs() <= 180.0, expected: "a number of degrees from -180 to 180" };
/// A frequency, in Hz.
pub(super) const FREQUENCY: Rule =
    Rule { holds: |x| (1e-6..=1e6).contains(&x), expected: "a number from 1e-6 to 1000000" };
/// Any finite number.
pub(super) const FINITE: Rule = Rule { holds: f32::is_finite, expected: "a finite number" };

/// The problems so far, and the path of what is being looked at.
#[derive(Default)]
pub(super) struct Checker {
    path: String,
    problems: Vec<Problem>,
    unlisted: usize,
}

impl Checker {
    /// Checks inside a field of what is being looked at.
    pub(super) fn within(&mut self, field: impl Display, check: impl FnOnce(&mut Self)) {
        let length = self.path.len();
        self.path = joined(&self.path, field);
        check(self);
        self.path.truncate(length);
    }

    /// Notes that `field` is wrong.
    pub(super) fn problem(&mut self, field: impl Display, message: impl Into<String>) {
        if self.problems.len() < limits::PROBLEMS {
            let path = joined(&self.path, field);
            self.problems.push(Problem { path, message: legible(message) });
        } else {
            self.unlisted += 1;
        }
    }

    /// Notes `field` unless `holds`.
    pub(super) fn require(&mut self, holds: bool, field: impl Display, message: impl FnOnce() -> String) {
        if !holds {
            self.problem(field, message());
        }
    }

    /// One number.
    pub(super) fn number(&mut self, field: impl Display, value: f32, rule: Rule) {
        self.require((rule.holds)(value), field, || format!("{value} is not {}", rule.expected));
    }

    /// A number that may be absent.
    pub(super) fn optional(&mut self, field: impl Display, value: Option<f32>, rule: Rule) {
        if let Some(value) = value {
            self.number(field, value, rule);
        }
    }

    /// A whole number within a range.
    pub(super) fn count(&mut self, field: impl Display, value: u32, least: u32, most: u32) {
        self.require((least..=most).contains(&value), field, || {
            format!("{value} is not a whole number from {least} to {most}")
        });
    }

    /// A whole number that may be absent.
    pub(super) fn optional_count(&mut self, field: impl Display, value: Option<u32>, least: u32, most: u32) {
        if let Some(value) = value {
            self.count(field, value, least, most);
        }
    }

    /// Every component of a vector.
    pub(super) fn vector(&mut self, field: &str, value: &[f32], rule: Rule) {
        for (k, &component) in value.iter().enumerate() {
            self.number(format_args!("{field}[{k}]"), component, rule);
        }
    }

    /// A least and a greatest number, if there are any.
    pub(super) fn optional_range(&mut self, field: &str, range: Option<[f32; 2]>, rule: Rule) {
        let Some([least, most]) = range else { return };
        self.vector(field, &[least, most], rule);
        self.require(least <= most || least.is_nan() || most.is_nan(), format_args!("{field}[1]"), || {
            format!("{most} is less than {field}[0], {least}")
        });
    }

    /// A vector that names a direction: finite, not zero, and not so short or long that its length is.
    pub(super) fn direction(&mut self, field: &str, value: &[f32]) {
        self.vector(field, value, FINITE);
        let squared: f32 = value.iter().map(|x| x * x).sum();
        if value.iter().all(|x| x.is_finite()) {
            self.require(squared > f32::MIN_POSITIVE && squared.is_finite(), field, || {
                format!("{value:?} gives no direction: its length must be above 0, and neither tiny nor huge")
            });
        }
    }

    /// Every coordinate of a list of points.
    pub(super) fn points(&mut self, field: &str, points: &[[f32; 3]]) {
        for (i, point) in points.iter().enumerate() {
            for (k, &coordinate) in point.iter().enumerate() {
                self.number(format_args!("{field}[{i}][{k}]"), coordinate, COORDINATE);
            }
        }
    }

    /// What was found.
    pub(super) fn into_problems(mut self) -> Vec<Problem> {
        if self.unlisted > 0 {
            let message = format!("{} more problems are not listed", self.unlisted);
            self.problems.push(Problem { path: "…".to_owned(), message });
        }
        self.problems
    }
}

/// `path.field`, or `path[3]` for a field that begins with a bracket.
fn joined(path: &str, field: impl Display) -> String {
    let field = field.to_string();
    if path.is_empty() || field.starts_with('[') {
        format!("{path}{field}")
    } else {
        format!("{path}.{field}")
    }
}
