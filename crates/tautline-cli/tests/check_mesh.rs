//! `tautline check` on mesh files: what it says, writes and draws, and with which exit code.

mod program;

use std::fs;
use std::io::BufReader;
use std::path::Path;

use program::{errors, printed, tautline, texts};
use serde_json::Value;
use tempfile::tempdir;

/// A cube with edges of 2 m, of squares.
const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// What a call prints that finds defects.
fn printed_with_defects(folder: &Path, arguments: &[&str]) -> String {
    let output = tautline(folder, arguments);
    let (stdout, stderr) = texts(&output);
    assert_eq!((output.status.code(), stderr.as_str()), (Some(1), ""), "{arguments:?}");
    stdout
}

#[test]
fn a_sound_mesh_has_no_defects() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("Würfel.obj"), format!("mtllib a.mtl\n{CUBE}")).unwrap();
    let text = printed(folder.path(), &["check", "Würfel.obj"]);
    assert!(text.contains("8 vertices, 12 triangles") && text.contains("volume 8.0000"), "{text}");
    assert!(text.contains("passed over: 1 lines about materials"), "{text}");
    assert!(text.ends_with("no defects: a closed surface, which bounds a solid\n"), "{text}");
}

#[test]
fn defects_are_named_with_their_place_and_advice() {
    let folder = tempdir().unwrap();
    // The square above is turned, that in front is missing, and a vertex is no one's.
    let broken = CUBE.replace("f 3 4 8 7\n", "f 7 8 4 3\n").replace("f 5 6 7 8\n", "") + "v 9 9 9\n";
    fs::write(folder.path().join("a.obj"), broken).unwrap();
    let text = printed_with_defects(folder.path(), &["check", "a.obj"]);
    for part in
        ["isolated vertices: 1", "vertex 8 is in no triangle", "flipped triangles: 2", "a rim of 4 edges"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    let line = text.lines().find(|line| line.contains("vertex 8")).unwrap();
    assert_eq!(line.split_whitespace().rev().take(3).collect::<Vec<_>>(), ["9.0000"; 3], "{line}");
    assert!(text.contains("→ repair turns them round"), "{text}");

    let json = printed_with_defects(folder.path(), &["check", "a.obj", "--json"]);
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["ok"], false);
    let defects = json["report"]["defects"].as_array().unwrap();
    let kinds: Vec<&str> = defects.iter().map(|defect| defect["defect"]["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["isolated", "flipped", "flipped", "open"]);
    assert_eq!(defects[0]["place"], serde_json::json!([9.0, 9.0, 9.0]));
}

#[test]
fn repair_writes_a_mesh_that_passes_and_says_what_it_did() {
    let folder = tempdir().unwrap();
    let broken = CUBE.replace("f 3 4 8 7\n", "f 7 8 4 3\n").replace("f 5 6 7 8\n", "");
    fs::write(folder.path().join("a.obj"), broken).unwrap();
    for (out, vertices) in [("out/b.obj", 8), ("b.ply", 8), ("b.stl", 8)] {
        let text = printed(folder.path(), &["check", "a.obj", "--repair", out]);
        assert!(
            text.contains("turned 2 triangles round") && text.contains("filled a hole of 4 edges"),
            "{text}"
        );
        let text = printed(folder.path(), &["check", out]);
        assert!(
            text.contains(&format!("{vertices} vertices, 12 triangles")) && text.contains("no defects"),
            "{text}"
        );
    }
    let json = printed(folder.path(), &["check", "a.obj", "--json", "--repair", "c.ply"]);
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!((&json["ok"], &json["repaired"]["ok"]), (&Value::Bool(false), &Value::Bool(true)));
    assert_eq!(json["repaired"]["actions"][0]["kind"], "turned");
}

#[test]
fn what_cannot_be_repaired_says_why() {
    let folder = tempdir().unwrap();
    let shifted: String = CUBE
        .lines()
        .filter(|line| line.starts_with('v'))
        .map(|line| {
            let numbers: Vec<f32> =
                line.split(' ').skip(1).map(|word| word.parse::<f32>().unwrap() + 0.9).collect();
            format!("v {} {} {}\n", numbers[0], numbers[1], numbers[2])
        })
        .collect();
    let faces = CUBE.lines().filter(|line| line.starts_with('f'));
    let second: String = faces
        .map(|line| {
            let corners: Vec<String> =
                line.split(' ').skip(1).map(|word| (word.parse::<u32>().unwrap() + 8).to_string()).collect();
            format!("f {}\n", corners.join(" "))
        })
        .collect();
    fs::write(folder.path().join("a.obj"), CUBE.to_owned() + &shifted + &second).unwrap();
    let text = printed_with_defects(folder.path(), &["check", "a.obj", "--repair", "b.obj"]);
    assert!(text.contains("crossing triangles") && text.contains("unite the solids"), "{text}");
    assert!(text.contains("there was nothing that it could do"), "{text}");
}

#[test]
fn the_picture_shows_defects_in_colour() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("a.obj"), CUBE.replace("f 5 6 7 8\n", "")).unwrap();
    let text = printed_with_defects(folder.path(), &["check", "a.obj", "--picture", "a.png"]);
    assert!(text.contains("orange: open edges"), "{text}");
    let file = BufReader::new(fs::File::open(folder.path().join("a.png")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let picture = reader.next_frame(&mut bytes).unwrap();
    // From the front and from behind.
    let is_orange = |pixel: &&[u8]| pixel[0] > 180 && (90..190).contains(&pixel[1]) && pixel[2] < 90;
    let mut orange = [0; 2];
    for row in bytes.chunks(picture.line_size) {
        let (left, right) = row.split_at(row.len() / 2);
        orange[0] += left.chunks(3).filter(is_orange).count();
        orange[1] += right.chunks(3).filter(is_orange).count();
    }
    assert!(orange.iter().all(|&pixels| pixels > 100), "{orange:?}");
}

#[test]
fn a_malformed_file_is_refused_with_its_line() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("a.obj"), "v 0 0 0\nf 1 2 3\n").unwrap();
    let lines = errors(folder.path(), &["check", "a.obj"], 1);
    assert!(lines[0].starts_with("error: a.obj:2: "), "{lines:?}");
    let json = printed_with_defects(folder.path(), &["check", "a.obj", "--json"]);
    assert!(serde_json::from_str::<Value>(&json).unwrap()["problems"][0]["message"].is_string());
}

#[test]
fn outputs_of_other_kinds_are_usage_errors() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("a.obj"), CUBE).unwrap();
    fs::write(folder.path().join("a.json"), "{}").unwrap();
    for (arguments, part) in [
        (["a.obj", "--repair", "b.glb"], ".obj, .stl, .ply"),
        (["a.obj", "--picture", "b.gif"], ".png"),
        (["a.json", "--repair", "b.obj"], "--repair is for mesh files"),
        (["a.json", "--picture", "b.png"], "--picture is for mesh files"),
    ] {
        let lines = errors(folder.path(), &[&["check"][..], &arguments].concat(), 2);
        assert!(lines[0].contains(part), "{lines:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is written");
}
