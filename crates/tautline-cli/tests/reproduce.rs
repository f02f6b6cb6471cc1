//! `reproduce`: which files it writes, and what is in them.

mod program;

use std::fs;

use program::{errors, printed};
use serde_json::Value;
use tempfile::tempdir;

#[test]
fn a_quick_run_writes_tables_charts_and_report() {
    let folder = tempdir().unwrap();
    let text = printed(folder.path(), &["reproduce", "--out", "paper/quick", "--quick"]);
    assert!(text.starts_with("wrote paper/quick/report.md"), "{text}");
    let read = |name: &str| fs::read(folder.path().join("paper/quick").join(name)).unwrap();
    let read_text = |name: &str| String::from_utf8(read(name)).unwrap();

    let summary: Value = serde_json::from_str(&read_text("summary.json")).unwrap();
    for (experiment, keys) in [
        (
            "experiment1",
            &[
                "n",
                "fps",
                "relaxations_ordered",
                "relaxations_unordered",
                "visits_ordered",
                "visits_unordered",
            ][..],
        ),
        ("experiment2", &["n", "fps"]),
        ("experiment3", &["n", "fps"]),
    ] {
        let points = summary[experiment].as_array().unwrap();
        assert!(points.len() >= 2, "{experiment}");
        for (point, key) in points.iter().flat_map(|point| keys.iter().map(move |key| (point, key))) {
            assert!(point[key].as_f64().is_some_and(|value| value > 0.0), "{experiment}.{key}: {point}");
        }
        let table = read_text(&format!("{experiment}.csv"));
        assert!(table.starts_with("n,fps,"), "{table}");
        assert_eq!(table.lines().count(), points.len() + 1, "{experiment}.csv");
    }
    let study = read_text("study.csv");
    let header = study.lines().next().unwrap().split(',').count();
    assert!(study.lines().all(|line| columns(line) == header), "{study}");

    let report = read_text("report.md");
    for chart in ["chart-9a", "chart-9b", "chart-9c"] {
        assert!(read(&format!("{chart}.png")).starts_with(b"\x89PNG"), "{chart}");
        let svg = read_text(&format!("{chart}.svg"));
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{chart}");
        assert!(report.contains(&format!("({chart}.png)")), "{chart}");
    }
    assert_eq!(fs::read_dir(folder.path().join("paper/quick")).unwrap().count(), 12, "nothing else is left");
}

/// How many columns a line has: commas in quotation marks separate nothing.
fn columns(line: &str) -> usize {
    line.split('"').step_by(2).map(|unquoted| unquoted.matches(',').count()).sum::<usize>() + 1
}

#[test]
fn a_folder_that_cannot_be_made_is_named_at_once() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("file"), "in the way").unwrap();
    let errors = errors(folder.path(), &["reproduce", "--out", "file/paper"], 2);
    assert!(errors.len() == 1 && errors[0].starts_with("error: file/paper: "), "{errors:?}");
}
