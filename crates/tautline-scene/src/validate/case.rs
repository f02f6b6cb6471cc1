//! What a case is, and what comes of it.

use serde::Serialize;
use tautline::{Error, Settings, World};

/// A case with a known answer: one or more trials, each compared in one or more parts.
pub struct Case {
    /// Its number.
    pub id: u32,
    /// Cases of one kind.
    pub group: &'static str,
    /// What happens in it.
    pub name: &'static str,
    /// The answer, or what has to hold.
    pub formula: &'static str,
    /// What the scene is, where the name does not say it.
    pub note: &'static str,
    pub(super) trials: Vec<Trial>,
}

/// One scene of a case. Trials share nothing: they can run side by side.
pub(super) struct Trial(pub(super) Box<Measure>);

type Measure = dyn Fn(&Conditions) -> Result<Vec<Part>, Error> + Send + Sync;

impl Trial {
    pub(super) fn new(
        measure: impl Fn(&Conditions) -> Result<Vec<Part>, Error> + Send + Sync + 'static,
    ) -> Self {
        Self(Box::new(measure))
    }

    /// A trial that is compared in one figure.
    pub(super) fn one(measure: impl Fn(&Conditions) -> Result<Part, Error> + Send + Sync + 'static) -> Self {
        Self::new(move |conditions| measure(conditions).map(|part| vec![part]))
    }
}

/// How the worlds of all cases are simulated.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// The settings of every world, but for its gravity.
    pub settings: Settings,
}

impl Default for Conditions {
    /// The default solver; nothing is put to sleep, so that creep shows.
    fn default() -> Self {
        Self { settings: Settings { sleep: None, ..Settings::default() } }
    }
}

impl Conditions {
    /// An empty world on Earth.
    pub(super) fn world(&self) -> Result<World, Error> {
        World::new(self.settings.clone())
    }

    /// An empty world without gravity.
    pub(super) fn weightless(&self) -> Result<World, Error> {
        World::new(Settings { gravity: tautline::Vec3::ZERO, ..self.settings.clone() })
    }
}

/// One comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Part {
    /// Which one.
    pub name: String,
    /// What was compared.
    #[serde(flatten)]
    pub figures: Figures,
    /// Whether the error is within the demand. One that is not a number is not.
    pub pass: bool,
}

/// What was measured, and what was demanded.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Figures {
    /// What the engine gave, in `unit`.
    pub measured: f64,
    /// What it should be, in `unit`.
    pub expected: f64,
    /// How far it is off, in the unit of the demand.
    pub error: f64,
    /// How far it may be off.
    pub demand: f64,
    /// Unit of `measured` and `expected`; empty for a ratio or a count.
    pub unit: &'static str,
    /// Unit of `error` and `demand`; empty for a share.
    pub error_unit: &'static str,
}

impl Part {
    /// Off by |measured − expected|.
    pub(super) fn absolute(
        name: impl Into<String>,
        [measured, expected]: [f64; 2],
        demand: f64,
        unit: &'static str,
    ) -> Self {
        let error = (measured - expected).abs();
        Self::new(name.into(), [measured, expected], [error, demand], [unit, unit])
    }

    /// Off by |measured/expected − 1|.
    pub(super) fn relative(
        name: impl Into<String>,
        [measured, expected]: [f64; 2],
        demand: f64,
        unit: &'static str,
    ) -> Self {
        let error = (measured / expected - 1.0).abs();
        Self::new(name.into(), [measured, expected], [error, demand], [unit, ""])
    }

    /// Should be nothing, and may be so much.
    pub(super) fn at_most(name: impl Into<String>, measured: f64, demand: f64, unit: &'static str) -> Self {
        Self::new(name.into(), [measured, 0.0], [measured, demand], [unit, unit])
    }

    /// Should be `expected` and not less than this share below it; more is no error here.
    pub(super) fn at_least(
        name: impl Into<String>,
        [measured, expected]: [f64; 2],
        demand: f64,
        unit: &'static str,
    ) -> Self {
        let error = 1.0 - measured / expected;
        // `max` would take a NaN for 0.
        let error = if error < 0.0 { 0.0 } else { error };
        Self::new(name.into(), [measured, expected], [error, demand], [unit, ""])
    }

    fn new(
        name: String,
        [measured, expected]: [f64; 2],
        [error, demand]: [f64; 2],
        [unit, error_unit]: [&'static str; 2],
    ) -> Self {
        let figures = Figures { measured, expected, error, demand, unit, error_unit };
        Self { name, figures, pass: error <= demand }
    }

    /// The error in units of the demand; infinite if there is no number.
    pub fn ratio(&self) -> f64 {
        let Figures { error, demand, .. } = self.figures;
        match error {
            error if !error.is_finite() => f64::INFINITY,
            error if demand > 0.0 => error / demand,
            error if error > 0.0 => f64::INFINITY,
            _ => 0.0,
        }
    }
}

/// What came of a case: its worst part, and all of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outcome {
    /// The case's number.
    pub id: u32,
    /// Cases of one kind.
    pub group: &'static str,
    /// The case's name.
    pub name: &'static str,
    /// The answer, or what has to hold.
    pub formula: &'static str,
    /// The name of the part that comes nearest to its demand, or is furthest beyond it.
    pub part: String,
    /// What was compared in it.
    #[serde(flatten)]
    pub figures: Figures,
    /// Whether all parts are within their demands.
    pub pass: bool,
    /// What there is to know about the case.
    pub note: &'static str,
    /// All comparisons, in the order of the trials.
    pub parts: Vec<Part>,
}

impl Outcome {
    pub(super) fn new(case: &Case, parts: Vec<Part>) -> Self {
        // Of equal ones the first.
        let worst = parts.iter().rev().max_by(|a, b| a.ratio().total_cmp(&b.ratio()));
        let none = Part::at_most("", f64::NAN, 0.0, "");
        let worst = worst.unwrap_or(&none);
        let pass = worst.pass && parts.iter().all(|part| part.pass);
        Self {
            id: case.id,
            group: case.group,
            name: case.name,
            formula: case.formula,
            part: worst.name.clone(),
            figures: worst.figures,
            pass,
            note: case.note,
            parts,
        }
    }

    /// The largest error of a part in units of its demand.
    pub fn ratio(&self) -> f64 {
        self.parts.iter().map(Part::ratio).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_fails() {
        for measured in [f64::NAN, f64::INFINITY] {
            let parts = [
                Part::absolute("", [measured, 1.0], 1.0, ""),
                Part::relative("", [measured, 1.0], 1.0, ""),
                Part::at_most("", measured, 1.0, ""),
            ];
            assert!(parts.iter().all(|part| !part.pass && part.ratio() == f64::INFINITY), "{parts:?}");
        }
        let part = Part::at_least("", [f64::NAN, 1.0], 1.0, "");
        assert!(!part.pass && part.ratio() == f64::INFINITY);
    }

    #[test]
    fn the_worst_part_is_the_one_furthest_beyond_its_demand() {
        let case = Case { id: 7, group: "", name: "", formula: "", note: "", trials: vec![] };
        let parts = vec![
            Part::absolute("near", [1.0, 1.5], 1.0, "m"),
            Part::relative("beyond", [1.02, 1.0], 0.01, ""),
            Part::at_most("none", 0.0, 0.0, ""),
        ];
        let outcome = Outcome::new(&case, parts);
        assert_eq!((outcome.part.as_str(), outcome.pass), ("beyond", false));
        assert!((outcome.ratio() - 2.0).abs() < 1e-9);
    }
}
