//! `validate`: what it prints and writes.

mod program;

use std::fs;

use program::{errors, printed, tautline, texts};
use serde_json::Value;
use tempfile::tempdir;

#[test]
fn cases_are_told_of_in_full_and_written() {
    let folder = tempdir().unwrap();
    let arguments = ["validate", "1", "9", "--json", "new/v.json", "--chart", "new/v.svg"];
    let output = tautline(folder.path(), &arguments);
    let (stdout, stderr) = texts(&output);
    assert_eq!(stderr, "");
    for part in ["free fall for 2 s", "from 1 km above", "1.0e-4 m", "of 2 cases pass", "wrote new/v.json"] {
        assert!(stdout.contains(part), "{stdout}");
    }
    let results: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("new/v.json")).unwrap()).unwrap();
    let cases = results["cases"].as_array().unwrap();
    assert_eq!(cases.iter().map(|case| case["id"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 9]);
    for case in cases {
        for key in ["measured", "expected", "error", "demand"] {
            assert!(case[key].is_number() && case["parts"][0][key].is_number(), "{key}: {case}");
        }
        assert!(case["name"].is_string() && case["note"].is_string() && case["pass"].is_boolean(), "{case}");
    }
    let all_pass = cases.iter().all(|case| case["pass"] == true);
    assert_eq!(output.status.code(), Some(if all_pass { 0 } else { 1 }));
    let chart = fs::read_to_string(folder.path().join("new/v.svg")).unwrap();
    assert!(chart.starts_with("<svg") && chart.contains("rapier3d"));
}

#[test]
fn a_case_that_passes_is_exit_code_0() {
    let folder = tempdir().unwrap();
    let text = printed(folder.path(), &["validate", "1"]);
    assert!(text.contains("\n1 of 1 cases pass\n"), "{text}");
}

#[test]
fn a_case_that_is_off_is_exit_code_1() {
    let folder = tempdir().unwrap();
    // One substep a step is too few for a tower.
    let output = tautline(folder.path(), &["validate", "13", "--substeps", "1"]);
    let (stdout, _) = texts(&output);
    assert_eq!(output.status.code(), Some(1), "{stdout}");
    assert!(stdout.contains("FAIL") && stdout.contains("0 of 1 cases pass"), "{stdout}");
}

#[test]
fn what_there_is_not_is_refused_before_anything_is_run() {
    let folder = tempdir().unwrap();
    for (arguments, part) in [
        (&["validate", "99"][..], "there is no case 99; there are: 1, 2, "),
        (&["validate", "--chart", "v.gif"], "the extension must be one of .png, .svg"),
    ] {
        let errors = errors(folder.path(), arguments, 2);
        assert!(errors.len() == 1 && errors[0].contains(part), "{errors:?}");
    }
    for arguments in [&["validate", "one"][..], &["validate", "--substeps", "0"]] {
        errors(folder.path(), arguments, 2);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is written");
}
