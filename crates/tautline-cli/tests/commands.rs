//! Every command but `reproduce`: what it prints and writes, and how it refuses.

mod program;

use std::fs;
use std::path::Path;
use std::process::Command;

use program::{errors, printed, tautline, texts};
use serde_json::Value;
use tempfile::tempdir;

/// The JSON that a call that succeeds prints.
fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&printed(folder, arguments)).unwrap()
}

#[test]
fn list_names_every_scene_with_its_parameters() {
    let folder = tempdir().unwrap();
    let text = printed(folder.path(), &["list"]);
    let scenes = json(folder.path(), &["list", "--json"]);
    let names: Vec<&str> = scenes.as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    for name in ["icosahedra", "cloth-on-cube", "cloth-on-rope", "tower", "hung-cloth", "catenary"] {
        assert!(names.contains(&name), "{name}");
        assert!(text.contains(name), "{name}");
    }
    let parameter = &scenes[0]["parameters"][0];
    assert_eq!((parameter["name"].as_str(), parameter["default"].as_i64()), (Some("n"), Some(50)));
    assert!(text.contains("n = 50"), "{text}");
}

#[test]
fn run_prints_and_writes_the_same_statistics() {
    let folder = tempdir().unwrap();
    let arguments = ["run", "tower", "--set", "n=2", "--seconds", "0.5", "--json", "--stats", "new/s.json"];
    let printed = json(folder.path(), &arguments);
    let written: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("new/s.json")).unwrap()).unwrap();
    assert_eq!(printed, written);
    assert_eq!((printed["scene"].as_str(), printed["bodies"].as_u64()), (Some("tower"), Some(2)));
    assert_eq!((printed["particles"].as_u64(), printed["steps"].as_u64()), (Some(8), Some(30)));
    assert_eq!((printed["escaped"].as_u64(), printed["nonfinite"].as_u64()), (Some(0), Some(0)));
    for key in
        ["ms_per_step", "max_penetration_mm", "mean_penetration_mm", "max_stick_strain", "kinetic_energy"]
    {
        assert!(printed[key].is_number(), "{key}");
    }
    assert_eq!(printed["state_hash"].as_str().map(str::len), Some(16));
}

#[test]
fn run_writes_what_the_extension_says() {
    let folder = tempdir().unwrap();
    let files = [("a/tower.png", &b"\x89PNG"[..]), ("a/tower.gif", b"GIF8"), ("a/tower.glb", b"glTF")];
    let mut arguments = vec!["run", "tower", "--seconds", "0.1"];
    files.iter().for_each(|(file, _)| arguments.extend(["--out", file]));
    let text = printed(folder.path(), &arguments);
    for (file, magic) in files {
        assert!(fs::read(folder.path().join(file)).unwrap().starts_with(magic), "{file}");
        assert!(text.contains(&format!("wrote {file}")), "{text}");
    }
    assert_eq!(fs::read_dir(folder.path().join("a")).unwrap().count(), 3, "nothing else is left there");
}

#[test]
fn pictures_are_as_large_as_asked() {
    let folder = tempdir().unwrap();
    let run = ["run", "tower", "--seconds", "0.1", "--out", "a.png", "--out", "a.gif", "--size"];
    printed(folder.path(), &[&run[..], &["64x48"]].concat());
    let read = |file: &str| fs::read(folder.path().join(file)).unwrap();
    // Where PNG and GIF tell their size.
    assert_eq!(
        (&read("a.png")[16..24], &read("a.gif")[6..10]),
        (&[0, 0, 0, 64, 0, 0, 0, 48][..], &[64, 0, 48, 0][..])
    );
    for size in ["64", "64x", "0x48", "64x-1", "9000x48", "64x48x2", "NaNx48"] {
        let lines = errors(folder.path(), &[&run[..], &[size]].concat(), 2);
        assert!(lines.join("\n").contains("such as 1280x720"), "{lines:?}");
    }
}

#[test]
fn the_state_depends_on_the_solver_and_not_on_the_threads() {
    let folder = tempdir().unwrap();
    let hash = |extra: &[&str]| {
        let base = ["run", "icosahedra", "--set", "n=8", "--seconds", "1", "--json"];
        let summary = json(folder.path(), &[&base, extra].concat());
        summary["state_hash"].as_str().unwrap().to_owned()
    };
    let one = hash(&["--threads", "1"]);
    assert_eq!(one, hash(&["--threads", "2"]));
    assert_eq!(one, hash(&[]));
    assert_eq!(one, hash(&["--solver", "default"]));
    assert_ne!(one, hash(&["--solver", "paper"]));
    assert_ne!(one, hash(&["--set", "seed=2"]));
}

#[test]
fn bad_arguments_are_refused_with_code_2_and_one_line() {
    let folder = tempdir().unwrap();
    let cases: [(&[&str], &str); 8] = [
        (&["run", "nowhere"], "no scene named \"nowhere\""),
        (&["run", "tower", "--set", "m=1"], "no parameter named \"m\""),
        (&["run", "tower", "--set", "n=1e9"], "n: \"1e9\""),
        (&["run", "tower", "--set", "n=NaN"], "n: \"NaN\""),
        (&["run", "tower", "--out", "tower.avi"], ".gif, .glb, .html, .mp4"),
        (&["run", "missing.json"], "missing.json"),
        (&["check", "missing.json"], "missing.json"),
        (&["bench", "nowhere"], "no scene named \"nowhere\""),
    ];
    for (arguments, part) in cases {
        let errors = errors(folder.path(), arguments, 2);
        assert_eq!(errors.len(), 1, "{errors:?}");
        assert!(errors[0].starts_with("error: ") && errors[0].contains(part), "{errors:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is written");
    for arguments in [
        &["fly"][..],
        &["run", "tower", "--seconds", "0"],
        &["run", "tower", "--seconds", "NaN"],
        &["run", "tower", "--seconds", "1e9"],
        &["run", "tower", "--threads", "0"],
        &["run", "tower", "--solver", "magic"],
    ] {
        errors(folder.path(), arguments, 2);
    }
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("file"), "in the way").unwrap();
    let arguments = ["run", "tower", "--seconds", "0.05", "--stats", "file/s.json"];
    let errors = errors(folder.path(), &arguments, 2);
    assert!(errors[0].starts_with("error: file: "), "{errors:?}");
}

const SCENE: &str = r#"{ "tautline": 1, "name": "mine", "seconds": 0.1,
    "bodies": [{ "half_space": {} }, { "rigid": { "position": [0, 2, 0] } }] }"#;

#[test]
fn outputs_are_checked_before_the_run_and_none_is_written_when_one_cannot_be() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("file"), "").unwrap();
    std::fs::create_dir(folder.join("folder.gif")).unwrap();
    let run = |files: &[&str]| errors(folder, &[&["run", "tower", "--seconds", "0.1"], files].concat(), 2);
    for files in [
        ["--out", "good.png", "--out", "file/x.png"],
        ["--out", "good.png", "--out", "folder.gif"],
        ["--out", "good.png", "--stats", "file/x.json"],
        ["--out", "good.png", "--out", "good.png"],
        ["--out", "good.png", "--stats", "good.png"],
        ["--out", "good.png", "--out", ".gif"],
    ] {
        assert_eq!(run(&files).len(), 1, "{files:?}");
        assert!(!folder.join("good.png").exists(), "{files:?}");
    }
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), 2, "nothing is left behind");
}

#[test]
fn scene_files_are_run_and_checked() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("mine.json"), SCENE).unwrap();
    let summary = json(folder.path(), &["run", "mine.json", "--json"]);
    assert_eq!((summary["scene"].as_str(), summary["particles"].as_u64()), (Some("mine"), Some(4)));
    let refused = errors(folder.path(), &["run", "mine.json", "--set", "n=1"], 2);
    assert!(refused[0].contains("has no parameters"), "{refused:?}");
    let text = printed(folder.path(), &["check", "mine.json"]);
    assert_eq!(text, "mine.json: no problems; 2 bodies, 4 particles\n");
    let checked = json(folder.path(), &["check", "mine.json", "--json"]);
    assert_eq!((checked["ok"].as_bool(), checked["bodies"].as_u64()), (Some(true), Some(2)));
}

#[test]
fn what_is_no_scene_file_by_its_name_is_a_usage_error() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("a.yaml"), "").unwrap();
    for file in ["a.yaml", "."] {
        let errors = errors(folder.path(), &["check", file], 2);
        assert!(errors[0].contains("the extension must be one of .json, .json5, .toml"), "{errors:?}");
    }
}

#[test]
fn every_problem_of_a_scene_is_named_with_its_path() {
    let folder = tempdir().unwrap();
    let bad = r#"{ "tautline": 1, "dt": -1,
        "bodies": [{ "rigid": { "mass": 0 } }, { "cloth": { "mass": -1 } }] }"#;
    fs::write(folder.path().join("bad.json"), bad).unwrap();
    let lines = errors(folder.path(), &["check", "bad.json"], 1);
    for (line, path) in lines.iter().zip(["dt", "bodies[0].rigid.mass", "bodies[1].cloth.mass"]) {
        assert!(line.starts_with(&format!("error: bad.json: {path}: ")), "{line}");
    }
    assert_eq!(lines.len(), 3, "{lines:?}");
    assert_eq!(errors(folder.path(), &["run", "bad.json"], 1).len(), 3);

    let output = tautline(folder.path(), &["check", "bad.json", "--json"]);
    let (stdout, stderr) = texts(&output);
    assert_eq!((output.status.code(), stderr.as_str()), (Some(1), ""));
    let checked: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(checked["ok"].as_bool(), Some(false));
    assert_eq!(checked["problems"][2]["path"].as_str(), Some("bodies[1].cloth.mass"));
}

#[test]
fn text_that_is_no_document_is_named_by_line_and_column() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("torn.json"), "{ \"tautline\": 1,\n \"bodies\": [").unwrap();
    let errors = errors(folder.path(), &["check", "torn.json"], 1);
    assert!(errors[0].starts_with("error: torn.json: bodies: line 2, column 12: "), "{errors:?}");
}

#[test]
fn bench_gives_the_time_by_phase() {
    let folder = tempdir().unwrap();
    let rows = json(folder.path(), &["bench", "catenary", "chain", "--json"]);
    assert_eq!(rows.as_array().unwrap().len(), 2);
    let phases = rows[0]["ms_per_step_by_phase"].as_object().unwrap();
    let sum: f64 = phases.values().map(|ms| ms.as_f64().unwrap()).sum();
    assert!(sum > 0.0 && sum <= rows[0]["ms_per_step"].as_f64().unwrap() * 1.001, "{rows}");
    assert!(printed(folder.path(), &["bench", "catenary"]).contains("catenary"));
}

#[test]
fn a_closed_output_is_no_failure() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let program = env!("CARGO_BIN_EXE_tautline");
    let output = Command::new(program).arg("list").stdout(writer).output().unwrap();
    assert_eq!((output.status.code(), texts(&output).1.as_str()), (Some(0), ""));
}
