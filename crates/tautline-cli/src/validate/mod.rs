//! `tautline validate`: cases with a known answer to a table, JSON and a chart.

mod chart;
mod table;

use std::sync::atomic::{AtomicU64, Ordering};

use serde::Serialize;
use tautline_scene::validate::{self, Case, Conditions, Outcome};

use crate::args::Validate;
use crate::failure::Failure;
use crate::output::{json, print, write_text};
use crate::picture;
use crate::progress::{bar, tell};
use crate::run::{describe_file, prepare};

/// The file that `--json` asks for.
#[derive(Serialize)]
struct Results<'a> {
    cases: &'a [Outcome],
}

pub(crate) fn validate(arguments: &Validate) -> Result<(), Failure> {
    let cases = chosen(&arguments.cases)?;
    if let Some(path) = &arguments.chart {
        picture::check_extension(path)?;
    }
    let files = arguments.json.iter().chain(&arguments.chart);
    prepare(&[], files.clone())?;
    let mut conditions = Conditions::default();
    if let Some(substeps) = arguments.substeps {
        conditions.settings.substeps = substeps;
    }
    let outcomes = perform(&cases, &conditions)?;
    if let Some(path) = &arguments.json {
        write_text(path, &json(&Results { cases: &outcomes })?)?;
    }
    if let Some(path) = &arguments.chart {
        picture::write(&chart::Chart::new(&outcomes), path)?;
    }
    let text = table::table(&outcomes, !arguments.cases.is_empty());
    print(&(text + &files.map(|path| describe_file(path)).collect::<String>()))?;
    if outcomes.iter().all(|outcome| outcome.pass) { Ok(()) } else { Err(Failure::Reported) }
}

/// The cases with these numbers, or all.
fn chosen(numbers: &[u32]) -> Result<Vec<Case>, Failure> {
    let mut cases = validate::cases();
    if let Some(unknown) = numbers.iter().find(|&&number| cases.iter().all(|case| case.id != number)) {
        let known: Vec<String> = cases.iter().map(|case| case.id.to_string()).collect();
        let known = known.join(", ");
        return Err(Failure::Usage(format!("there is no case {unknown}; there are: {known}")));
    }
    cases.retain(|case| numbers.is_empty() || numbers.contains(&case.id));
    Ok(cases)
}

fn perform(cases: &[Case], conditions: &Conditions) -> Result<Vec<Outcome>, Failure> {
    let bar = bar("validation");
    let (done, total) = (AtomicU64::new(0), validate::trial_count(cases) as u64);
    let outcomes = validate::run(cases, conditions, || {
        tell(&bar, done.fetch_add(1, Ordering::Relaxed) + 1, total);
    })?;
    bar.finish_and_clear();
    Ok(outcomes)
}
