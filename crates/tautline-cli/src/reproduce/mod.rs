//! `tautline reproduce`: the paper's experiments to tables, charts and a report.

mod charts;
mod experiments;
mod report;
mod solid;
mod study;
mod tables;

use crate::args::Reproduce;
use crate::failure::Failure;
use crate::output::{json, make_folder, print, write_text};
use crate::progress::{bar, tell};
use experiments::{Plan, Results};
use report::Circumstances;
use study::{Effort, Row};

pub(crate) fn reproduce(arguments: &Reproduce) -> Result<(), Failure> {
    // A folder that cannot be made should not come to light after minutes.
    make_folder(&arguments.out)?;
    let (plan, effort) = match arguments.quick {
        true => (Plan::quick(), Effort::QUICK),
        false => (Plan::paper(), Effort::FULL),
    };
    let (results, study) = measure(&plan, effort)?;
    let circumstances = Circumstances {
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        steps: plan.steps,
        quick: arguments.quick,
    };
    write(arguments, &results, &study, circumstances)
}

fn measure(plan: &Plan, effort: Effort) -> Result<(Results, Vec<Row>), Failure> {
    let bar = bar("experiments");
    let (mut done, total) = (0, experiments::point_count(plan));
    let results = experiments::run(plan, &mut || {
        done += 1;
        tell(&bar, done, total);
    })?;
    let cases = study::cases();
    bar.set_message("study of the ordering");
    let mut rows = Vec::new();
    for (done, case) in cases.iter().enumerate() {
        tell(&bar, done as u64, cases.len() as u64);
        rows.push(study::measure(case, effort)?);
    }
    bar.finish_and_clear();
    Ok((results, rows))
}

fn write(
    arguments: &Reproduce,
    results: &Results,
    study: &[Row],
    circumstances: Circumstances,
) -> Result<(), Failure> {
    let folder = &arguments.out;
    for (name, text) in tables::csv_files(results, study) {
        write_text(&folder.join(name), &text)?;
    }
    for chart in tables::charts(results) {
        charts::write(&chart, folder)?;
    }
    write_text(&folder.join("summary.json"), &json(results)?)?;
    let report = folder.join("report.md");
    write_text(&report, &report::report(results, study, circumstances))?;
    print(&format!("wrote {}, with its charts, tables and summary.json beside it\n", report.display()))
}
