//! Scene files with mesh files beside them.

use std::path::PathBuf;

use tautline_scene::document::{Body, Shape, Surface};
use tautline_scene::{Error, load};
use tempfile::TempDir;

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn folder(files: &[(&str, &str)]) -> (TempDir, impl Fn(&str) -> PathBuf + use<>) {
    let folder = TempDir::new().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let path = folder.path().to_owned();
    (folder, move |name| path.join(name))
}

fn problems(error: Error) -> Vec<String> {
    match error {
        Error::Invalid(problems) => problems.iter().map(ToString::to_string).collect(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn mesh_files_are_put_in_the_place_of_their_names() {
    let scene = "tautline = 1\n[[bodies]]\nrigid = { shape = { file = { path = 't.obj', scale = 0.5 } } }\n\
        [[bodies]]\ncloth = { surface = { file = { path = 't.obj' } }, pins = [3] }\n";
    let (_folder, path) = folder(&[("scene.toml", scene), ("t.obj", TETRAHEDRON)]);
    let scene = load(&path("scene.toml")).unwrap();
    match (&scene.bodies[0], &scene.bodies[1]) {
        (Body::Rigid(rigid), Body::Cloth(cloth)) => {
            let (Shape::Mesh(solid), Surface::Mesh(sheet)) = (&rigid.shape, &cloth.surface) else {
                panic!("{scene:?}")
            };
            assert_eq!(solid.positions[1], [0.5, 0.0, 0.0]);
            assert_eq!(sheet.positions[1], [1.0, 0.0, 0.0]);
            assert_eq!((solid.triangles.len(), sheet.triangles.len()), (4, 4));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn problems_of_values_and_of_mesh_files_are_reported_together() {
    let scene = r#"{tautline: 1, bodies: [
        {rigid: {friction: -1, shape: {file: {path: 'bad.obj'}}}},
        {cloth: {surface: {file: {path: '../t.obj'}}}},
        {rigid: {shape: {file: {path: 'none.stl'}}}}]}"#;
    let (_folder, path) = folder(&[("scene.json5", scene), ("bad.obj", "v 0 0 0\nf 1 2 3\n")]);
    let problems = problems(load(&path("scene.json5")).unwrap_err());
    let starts = [
        "bodies[0].rigid.friction: -1 is not",
        "bodies[0].rigid.shape.file.path: ",
        "bodies[1].cloth.surface.file.path: ",
        "bodies[2].rigid.shape.file.path: ",
    ];
    assert_eq!(problems.len(), starts.len(), "{problems:?}");
    for (problem, start) in problems.iter().zip(starts) {
        assert!(problem.starts_with(start), "{problem}");
    }
    assert!(problems[1].contains("bad.obj:2: ") && problems[1].contains("names vertex 2"), "{}", problems[1]);
}

#[test]
fn what_a_mesh_file_brings_is_checked_too() {
    let scene = "{tautline: 1, bodies: [{cloth: {surface: {file: {path: 't.obj'}}, pins: [4, 'corners']}}]}";
    let (_folder, path) = folder(&[("scene.json5", scene), ("t.obj", TETRAHEDRON)]);
    let error = problems(load(&path("scene.json5")).unwrap_err());
    assert!(error.iter().any(|problem| problem.starts_with("bodies[0].cloth.pins[1]")), "{error:?}");
    let scene = "{tautline: 1, bodies: [{cloth: {surface: {file: {path: 't.obj'}}, pins: [4]}}]}";
    std::fs::write(path("scene.json5"), scene).unwrap();
    let error = problems(load(&path("scene.json5")).unwrap_err());
    assert_eq!(error, ["bodies[0].cloth.pins[0]: 4 is the index of no particle: there are 4"]);
    let scene =
        "{tautline: 1, bodies: [{rigid: {shape: {file: {path: 't.obj', scale: 1e6}}, position: [0, 0, 0]}}]}";
    std::fs::write(path("scene.json5"), scene).unwrap();
    assert!(load(&path("scene.json5")).is_ok());
    std::fs::write(path("t.obj"), TETRAHEDRON.replace('1', "11")).unwrap();
    assert!(load(&path("scene.json5")).is_err());
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let (_folder, path) =
        folder(&[("a.json", "{"), ("a.yaml", ""), ("bom.json", "\u{feff}{\"tautline\": 1}")]);
    assert!(load(&path("bom.json")).is_ok());
    std::fs::write(path("latin.json"), b"{\"name\":\n \"\xe9\"}").unwrap();
    std::fs::write(path("utf16.json"), b"\xff\xfe{\0}\0").unwrap();
    let error = load(&path("a.yaml")).unwrap_err();
    assert!(matches!(error, Error::UnsupportedFormat { supported: ".json, .json5, .toml", .. }), "{error}");
    assert!(error.to_string().contains("a.yaml: no known format"), "{error}");
    for (name, expected) in [
        ("a.json", "a.json:1:1: EOF"),
        ("latin.json", "latin.json:2:3: it is not UTF-8"),
        ("utf16.json", "UTF-16"),
    ] {
        let error = load(&path(name)).unwrap_err();
        assert!(matches!(error, Error::Parse(_)) && error.to_string().contains(expected), "{error}");
    }
    for name in ["none.json", "folder.json"] {
        std::fs::create_dir_all(path("folder.json")).unwrap();
        assert!(matches!(load(&path(name)), Err(Error::Io { .. })), "{name}");
    }
    let big = std::fs::File::create(path("big.json")).unwrap();
    big.set_len(10 << 30).unwrap();
    assert!(matches!(load(&path("big.json")), Err(Error::Io { .. })));
}

#[test]
fn a_mesh_named_often_is_refused_before_it_fills_the_memory() {
    let mut mesh = TETRAHEDRON.to_owned();
    mesh += &"f 1 3 2\n".repeat(1_000_000);
    let mut scene = "{tautline: 1, bodies: [".to_owned();
    scene += &"{rigid: {shape: {file: {path: 'many.obj'}}}},".repeat(40_000);
    scene += "]}";
    let (_folder, path) = folder(&[("scene.json5", &scene), ("many.obj", &mesh)]);
    let problems = problems(load(&path("scene.json5")).unwrap_err());
    assert_eq!(problems, ["bodies: they have 4000016 triangles, more than 4000000"]);
}
