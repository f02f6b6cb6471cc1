//! `validate`: cases with a known answer.

use pyo3::prelude::*;
use tautline_scene::validate::{self, Conditions};

use crate::errors::{Failure, Outcome};
use crate::threads;

/// Runs cases with a known answer, by their numbers, or all of them, and returns what came of them as JSON.
#[pyfunction]
#[pyo3(signature = (numbers=None))]
pub(crate) fn validate_json(py: Python<'_>, numbers: Option<Vec<u32>>) -> Outcome<String> {
    let mut cases = validate::cases();
    if let Some(numbers) = &numbers {
        let known: Vec<u32> = cases.iter().map(|case| case.id).collect();
        if let Some(unknown) = numbers.iter().find(|number| !known.contains(number)) {
            return Err(Failure::invalid("cases", format!("there is no case {unknown}")));
        }
        cases.retain(|case| numbers.contains(&case.id));
    }
    let mut outcomes = Vec::new();
    // One by one: in between, Python can be interrupted.
    for case in &cases {
        let run = || validate::run(std::slice::from_ref(case), &Conditions::default(), || ());
        outcomes.extend(py.detach(|| threads::run(run))?);
        py.check_signals()?;
    }
    let json = serde_json::to_string(&outcomes).map_err(|error| Failure::invalid("cases", error))?;
    Ok(json)
}
