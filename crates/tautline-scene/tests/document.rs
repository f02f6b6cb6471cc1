//! The scene document: three notations, defaults, and refusals that name the field.

mod worked;

use proptest::prelude::*;
use tautline_scene::Error;
use tautline_scene::document::{
    Body, Bounds, Camera, Cloth, Color, Creep, Format, Pin, Rigid, Rope, RopeEnd, Rotation, Scene, Settings,
    Shape, SheetPlace, Sleep, Solver, Surface, Thread, json_schema, parse,
};
use worked::worked;

fn json(text: &str) -> Scene {
    parse(text, Format::Json).unwrap()
}

/// The problems of a scene with these bodies, one string each.
fn problems_of(bodies: &str) -> Vec<String> {
    let scene = parse(&format!(r#"{{tautline: 1, bodies: {bodies}}}"#), Format::Json5).unwrap();
    scene.problems().iter().map(ToString::to_string).collect()
}

#[test]
fn everything_but_the_version_has_a_default() {
    let scene = json(
        r#"{"tautline": 1, "bodies": [{"cloth": {}}, {"rope": {}}, {"rigid": {}}, {"half_space": {}}, {"room": {}}]}"#,
    );
    assert_eq!(scene.bodies[0], Body::Cloth(Cloth::default()));
    assert_eq!(scene.bodies.len(), 5);
    assert_eq!(scene.problems(), []);
    assert_eq!(json(r#"{"tautline": 1}"#), Scene::default());
}

#[test]
fn the_three_notations_say_the_same() {
    let expected = Scene {
        name: "drop".into(),
        seconds: 2.0,
        settings: Settings {
            solver: Solver::Paper,
            sleep: Some(Sleep::After { speed: 0.1, seconds: 1.0 }),
            ..Settings::default()
        },
        bodies: vec![
            Body::Rigid(Rigid {
                shape: Shape::Icosahedron { radius: 0.5 },
                position: [0.0, 2.0, 0.0],
                rotation: Rotation::AxisAngle(tautline_scene::document::AxisAngle {
                    axis: [1.0, 0.0, 0.0],
                    degrees: 30.0,
                }),
                mass: Some(2.0),
                color: Some(Color([0x30, 0x70, 0xb0])),
                ..Rigid::default()
            }),
            Body::Rope(Rope { pins: vec![Pin::Place(RopeEnd::First), Pin::Index(7)], ..Rope::default() }),
        ],
        camera: Some(Camera { fov: 50.0, ..Camera::default() }),
        bounds: Some(Bounds { min: [-1.0; 3], max: [1.0; 3] }),
        ..Scene::default()
    };
    let as_json = r##"{"tautline": 1, "name": "drop", "seconds": 2,
        "settings": {"solver": "paper", "sleep": {"after": {"speed": 0.1, "seconds": 1}}},
        "bodies": [
            {"rigid": {"shape": {"icosahedron": {"radius": 0.5}}, "position": [0, 2, 0],
                "rotation": {"axis": [1, 0, 0], "degrees": 30}, "mass": 2, "color": "#3070b0"}},
            {"rope": {"pins": ["first", 7]}}],
        "camera": {"fov": 50}, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}}"##;
    let as_json5 = r"// a comment
        {tautline: 1, name: 'drop', seconds: 2,
        settings: {solver: 'paper', sleep: {after: {speed: .1, seconds: 1}}},
        bodies: [
            {rigid: {shape: {icosahedron: {radius: 0.5}}, position: [0, +2, 0x0],
                rotation: {axis: [1, 0, 0], degrees: 30}, mass: 2, color: '#3070B0'}},
            {rope: {pins: ['first', 7]}},],
        camera: {fov: 50}, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}";
    let as_toml = r##"tautline = 1
        name = "drop"
        seconds = 2
        camera = { fov = 50 }
        bounds = { min = [-1, -1, -1], max = [1, 1, 1] }
        [settings]
        solver = "paper"
        sleep = { after = { speed = 0.1, seconds = 1 } }
        [[bodies]]
        [bodies.rigid]
        shape = { icosahedron = { radius = 0.5 } }
        position = [0, 2, 0]
        rotation = { axis = [1, 0, 0], degrees = 30 }
        mass = 2
        color = "#3070b0"
        [[bodies]]
        [bodies.rope]
        pins = ["first", 7]
        "##;
    assert_eq!(parse(as_json, Format::Json).unwrap(), expected);
    assert_eq!(parse(as_json5, Format::Json5).unwrap(), expected);
    assert_eq!(parse(as_toml, Format::Toml).unwrap(), expected);
    assert_eq!(json(&serde_json::to_string(&expected).unwrap()), expected);
}

#[test]
fn every_body_survives_being_written_and_read() {
    let shapes = [
        Shape::Box { size: [1.0, 2.0, 3.0] },
        Shape::Icosphere { radius: 0.1, subdivisions: 2 },
        Shape::Torus { radius: 1.0, tube_radius: 0.3, segments: 12, tube_segments: 6 },
        Shape::Hull { points: vec![[0.1; 3]; 4] },
    ];
    let mut bodies: Vec<Body> =
        shapes.map(|shape| Body::Rigid(Rigid { shape, density: Some(700.0), ..Rigid::default() })).into();
    bodies.push(Body::Cloth(Cloth {
        surface: Surface::Grid { columns: 3, rows: 4, width: 0.3, depth: 0.7 },
        pins: vec![Pin::Place(SheetPlace::BackLeft), Pin::Index(11)],
        bending: Some(1e-3),
        ..Cloth::default()
    }));
    bodies.push(Body::Cloth(Cloth {
        surface: Surface::Grid { columns: 2, rows: 3, width: 0.3, depth: 0.7 },
        masses: vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
        bending_stiffness: Some(1e-5),
        compliance: Some(1e-4),
        shear_compliance: Some(1e-3),
        strain_limit: Some(0.05),
        tear_at: Some(0.04),
        creep: Some(Creep { yield_strain: 0.01, rate: 0.5 }),
        drag: Some(1.2),
        lift: Some(0.5),
        seams: vec![[0, 5]],
        ..Cloth::default()
    }));
    bodies.push(Body::Rope(Rope { path: Thread::Points(vec![[0.0; 3], [1.0; 3]]), ..Rope::default() }));
    let scene = Scene { bodies, ..Scene::default() };
    assert_eq!(scene.problems(), []);
    assert_eq!(json(&serde_json::to_string(&scene).unwrap()), scene);
    assert_eq!(parse(&toml::to_string(&scene).unwrap(), Format::Toml).unwrap(), scene);
    assert_eq!(parse(&json5::to_string(&scene).unwrap(), Format::Json5).unwrap(), scene);
}

#[test]
fn what_cannot_be_read_is_refused_with_its_place_and_path() {
    let cases = [
        (
            Format::Json,
            "{\"tautline\": 1,\n \"bodies\": [{\"cloth\": {\"mass\": \"heavy\"}}]}",
            2,
            "bodies[0].cloth.mass",
        ),
        (Format::Json5, "{tautline: 1,\n bodies: [{cloth: {mass: 'heavy'}}]}", 2, "bodies[0].cloth.mass"),
        (
            Format::Toml,
            "tautline = 1\n[[bodies]]\n[bodies.cloth]\nmass = \"heavy\"",
            4,
            "bodies[0].cloth.mass",
        ),
        (
            Format::Json,
            "{\"tautline\": 1,\n\n \"bodies\": [{\"cloth\": {\"colour\": 1}}]}",
            3,
            "bodies[0].cloth.colour",
        ),
        (Format::Json, "{\"tautline\": 2, \"new\": 1}", 1, "tautline"),
        (Format::Json, "{\"seconds\": 2}", 1, ""),
        (Format::Json, "{\"tautline\": 1} x", 1, ""),
        (Format::Json5, "{tautline: 1}\n x", 2, ""),
        (Format::Json5, "\n{tautline: 1,\n\n", 2, ""),
        (Format::Json5, "\n\n", 3, ""),
        (Format::Toml, "tautline = 1\nseconds = = 2", 2, ""),
        (
            Format::Json,
            "{\"tautline\": 1, \"bodies\": [{\"rope\": {\"pins\": [-1]}}]}",
            1,
            "bodies[0].rope.pins[0]",
        ),
        (Format::Toml, "tautline = 1\n[[bodies]]\nrope = { pins = [-1] }", 3, "bodies[0].rope.pins[0]"),
        (
            Format::Json,
            "{\"tautline\": 1, \"bodies\": [{\"rope\": {\"pins\": [\"middle\"]}}]}",
            1,
            "bodies[0].rope.pins[0]",
        ),
        (
            Format::Json,
            "{\"tautline\": 1, \"bodies\": [{\"rigid\": {\"rotation\": [0, 0, 1]}}]}",
            1,
            "bodies[0].rigid.rotation",
        ),
        (
            Format::Json,
            "{\"tautline\": 1, \"bodies\": [{\"rigid\": {\"color\": \"#12345é\"}}]}",
            1,
            "bodies[0].rigid.color",
        ),
    ];
    for (format, text, line, field) in cases {
        match parse(text, format) {
            Err(Error::Parse(error)) => {
                assert_eq!((error.line, error.field.as_str()), (line, field), "{text}: {error}");
                assert!(error.column >= 1 && !error.message.contains(" at line "), "{text}: {error}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn messages_quote_little_and_nothing_that_a_terminal_obeys() {
    let long = "Ä".repeat(1 << 16);
    for (text, part) in [
        ("{\"tautline\": 1, \"X\": 1}", "`bounds`"),
        ("{\"tautline\": 1, \"bodies\": [{\"rope\": {\"X\": 1}}]}", "unknown field"),
        ("{\"tautline\": 1, \"seconds\": \"X\"}", "expected"),
        (
            "{\"tautline\": 1, \"joints\": [{\"body\": \"X\", \"kind\": {\"ball\": {}}}]}",
            "no body has the name",
        ),
    ] {
        for name in [&*long, "\\u001b[2J\\u0007"] {
            let text = text.replace('X', name);
            let message = parse(&text, Format::Json5)
                .and_then(|scene| scene.check())
                .map_or_else(|e| e.to_string(), |()| String::new());
            let is_legible = message.chars().count() < 1000 && !message.contains(char::is_control);
            assert!(is_legible && message.contains(part), "{message:?}");
        }
    }
}

#[test]
fn problems_carry_the_path_of_their_field() {
    let cases = [
        (
            "[{cloth: {}}, {cloth: {mass: -1}}]",
            "bodies[1].cloth.mass: -1 is not a finite number above 0, up to 1e12",
        ),
        (
            "[{rope: {radius: NaN}}]",
            "bodies[0].rope.radius: NaN is not a finite number above 0, up to 1000000",
        ),
        (
            "[{rigid: {position: [0, -Infinity, 0]}}]",
            "bodies[0].rigid.position[1]: -inf is not a finite number",
        ),
        ("[{rigid: {friction: 1e99}}]", "bodies[0].rigid.friction: inf is not a finite number, at least 0"),
        (
            "[{rigid: {rotation: [0, 0, 0, 0]}}]",
            "bodies[0].rigid.rotation: [0.0, 0.0, 0.0, 0.0] gives no direction",
        ),
        ("[{rigid: {rotation: {axis: [0, 0, 0], degrees: 1}}}]", "bodies[0].rigid.rotation.axis: "),
        ("[{rigid: {mass: 1, density: 1}}]", "bodies[0].rigid.density: "),
        ("[{rigid: {shape: {box: {size: [1, 0, 1]}}}}]", "bodies[0].rigid.shape.box.size[1]: 0 is not "),
        (
            "[{rigid: {shape: {uv_sphere: {radius: 1, segments: 2, rings: 2}}}}]",
            "bodies[0].rigid.shape.uv_sphere.segments: 2",
        ),
        ("[{rigid: {shape: {hull: {points: [[0, 0, 0]]}}}}]", "bodies[0].rigid.shape.hull.points: 1 points"),
        (
            "[{rigid: {shape: {mesh: {positions: [], triangles: []}}}}]",
            "bodies[0].rigid.shape.mesh.triangles: there are none",
        ),
        (
            "[{cloth: {surface: {mesh: {positions: [[0, 0, 0]], triangles: [[0, 0, 1]]}}}}]",
            "bodies[0].cloth.surface.mesh.triangles[0][2]: 1 is",
        ),
        (
            "[{cloth: {pins: [400]}}]",
            "bodies[0].cloth.pins[0]: 400 is the index of no particle: there are 400",
        ),
        ("[{rope: {path: {points: [[0, 0, 0]]}}}]", "bodies[0].rope.path.points: 1 points make no rope"),
        ("[{rope: {path: {points: [[0, 0, 0], [0, 0, 0]]}}}]", "bodies[0].rope.path.points[1]: "),
        ("[{half_space: {normal: [0, 0, 0]}}]", "bodies[0].half_space.normal: "),
        ("[{room: {min: [0, 0, 0], max: [1, 0, 1]}}]", "bodies[0].room.max[1]: 0 is not above min[1], 0"),
        (
            "[{rope: {name: 'a'}}, {cloth: {name: 'a'}}]",
            "bodies[1].cloth.name: \"a\" is the name of bodies[0] too",
        ),
    ];
    each_has_its_problem(&cases);
}

#[test]
fn problems_of_what_fabric_is_made_of_carry_the_path_of_their_field() {
    each_has_its_problem(&[
        ("[{cloth: {density: -1}}]", "bodies[0].cloth.density: -1 is not a finite number above 0"),
        ("[{cloth: {masses: [1, 2]}}]", "bodies[0].cloth.masses: 2 masses are not one for each of 400"),
        (
            "[{cloth: {bending: 1, bending_stiffness: 1}}]",
            "bodies[0].cloth.bending_stiffness: there is bending",
        ),
        ("[{cloth: {sag: -1}}]", "bodies[0].cloth.sag: -1 is not a finite number from 0"),
        (
            "[{cloth: {sag: 1, surface: {mesh: {positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, 2]]}}}}]",
            "bodies[0].cloth.sag: only a grid",
        ),
        ("[{cloth: {shear_compliance: 1}}]", "bodies[0].cloth.shear_compliance: it is of no use"),
        ("[{cloth: {strain_limit: -0.1}}]", "bodies[0].cloth.strain_limit: -0.1 is not a number from 0"),
        ("[{cloth: {tear_at: 0.1}}]", "bodies[0].cloth.tear_at: it is of no use without a compliance"),
        ("[{cloth: {compliance: 1, tear_at: 0}}]", "bodies[0].cloth.tear_at: 0 is not a number from 1e-6"),
        (
            "[{cloth: {compliance: 1, tear_at: 0.1, strain_limit: 0.1}}]",
            "bodies[0].cloth.tear_at: it is never reached",
        ),
        (
            "[{cloth: {compliance: 1, creep: {yield_strain: -1, rate: 1}}}]",
            "bodies[0].cloth.creep.yield_strain: -1 is not",
        ),
        (
            "[{cloth: {compliance: 1, creep: {yield_strain: 0, rate: -1}}}]",
            "bodies[0].cloth.creep.rate: -1 is not a number from 0",
        ),
        ("[{cloth: {drag: -1}}]", "bodies[0].cloth.drag: -1 is not"),
        ("[{cloth: {pressure: NaN}}]", "bodies[0].cloth.pressure: NaN is not"),
        ("[{cloth: {seams: [[0, 400]]}}]", "bodies[0].cloth.seams[0][1]: 400 is the index of no particle"),
        ("[{cloth: {seams: [[7, 7]]}}]", "bodies[0].cloth.seams[0]: it sews a particle to itself"),
        (
            "[{rope: {bending: 1, bending_stiffness: 1}}]",
            "bodies[0].rope.bending_stiffness: there is bending",
        ),
        ("[{rope: {compliance: -1}}]", "bodies[0].rope.compliance: -1 is not a number from 0 to 1e12"),
    ]);
}

/// Bodies with one problem each, and how it begins.
fn each_has_its_problem(cases: &[(&str, &str)]) {
    for (bodies, expected) in cases {
        let problems = problems_of(bodies);
        assert_eq!(problems.len(), 1, "{bodies}: {problems:?}");
        assert!(problems[0].starts_with(expected), "{bodies}: {}", problems[0]);
    }
}

#[test]
fn all_problems_are_found_in_the_order_of_the_document() {
    let text = r#"{"tautline": 1, "name": "../x", "seconds": 0, "dt": -1, "record_every": 0,
        "settings": {"gravity": [0, 1e9, 0], "substeps": 0, "sweeps": 0, "tolerance": 1, "damping": -1,
            "wind": [0, 1e9, 0], "air_density": -1,
            "sleep": {"after": {"speed": 0, "seconds": -1}}},
        "bodies": [{"cloth": {"mass": 0, "friction": -1}}],
        "camera": {"eye": [0, 0, 0], "target": [0, 0, 0], "fov": 180}, "bounds": {"min": [0, 0, 0], "max": [0, 1, 1]}}"#;
    let paths: Vec<String> = json(text).problems().into_iter().map(|problem| problem.path).collect();
    let expected = [
        "name",
        "seconds",
        "dt",
        "record_every",
        "settings.gravity[1]",
        "settings.substeps",
        "settings.sweeps",
        "settings.tolerance",
        "settings.damping",
        "settings.wind[1]",
        "settings.air_density",
        "settings.sleep.after.speed",
        "settings.sleep.after.seconds",
        "bodies[0].cloth.mass",
        "bodies[0].cloth.friction",
        "camera.fov",
        "camera.target",
        "bounds.max[0]",
    ];
    assert_eq!(paths, expected);
}

#[test]
fn what_only_small_steps_know_is_refused_for_the_paper() {
    let text =
        "{tautline: 1, settings: {solver: 'paper'}, bodies: [{cloth: {bending_stiffness: 1, compliance: 1,
        shear_compliance: 1, strain_limit: 1, tear_at: 0.5, creep: {yield_strain: 0, rate: 1}, drag: 1, lift: 1,
        pressure: 1, seams: [[0, 1]], density: 1}},
        {rope: {bending_stiffness: 1, compliance: 1}}]}";
    let problems = parse(text, Format::Json5).unwrap().problems();
    let fields: Vec<&str> = problems.iter().filter_map(|problem| problem.path.rsplit('.').next()).collect();
    let of_both = ["bending_stiffness", "compliance"];
    let of_cloth =
        ["shear_compliance", "strain_limit", "tear_at", "creep", "drag", "lift", "pressure", "seams"];
    assert_eq!(fields, [&of_both[..], &of_cloth, &of_both].concat());
    assert!(problems.iter().all(|problem| problem.message.contains("only the solver \"default\"")));
}

#[test]
fn many_problems_are_counted_rather_than_listed() {
    let problems = problems_of(&format!("[{}]", "{rope: {mass: 0}},".repeat(250)));
    assert_eq!(problems.len(), 101);
    assert!(problems[100].contains("150 more"), "{}", problems[100]);
}

/// Runs what must take next to no time.
fn at_once(what: &str, run: impl Fn() -> String) -> String {
    let start = worked();
    let outcome = run();
    let took = worked() - start;
    assert!(took < 0.1, "{what}: {took} s");
    outcome
}

fn refused_at_once(what: &str, refuse: impl Fn() -> String) {
    let message = at_once(what, refuse);
    assert!(message.contains("more than") || message.contains("whole number"), "{what}: {message}");
}

#[test]
fn what_is_too_large_is_refused_without_being_built() {
    let error = |text: &str, format| {
        parse(text, format).map(|scene| scene.check()).map_or_else(|e| e, |c| c.unwrap_err())
    };
    let too_many = format!("{{\"tautline\": 1, \"bodies\": [{}", "{\"rope\":{}},".repeat(100_000));
    refused_at_once("bodies", || error(&too_many, Format::Json).to_string());
    let long = " ".repeat(120 << 20);
    refused_at_once("bytes", || error(&long, Format::Json).to_string());
    let grid = "{tautline: 1, bodies: [{cloth: {surface: {grid: {columns: 1000000, rows: 1000000, width: 1, depth: 1}}}}]}";
    refused_at_once("grid", || error(grid, Format::Json5).to_string());
    let rope = "{tautline: 1, bodies: [{rope: {path: {line: {from: [0, 0, 0], to: [1, 0, 0], segments: 4294967295}}}}]}";
    refused_at_once("rope", || error(rope, Format::Json5).to_string());
    let cloths = format!("{{tautline: 1, bodies: [{}]}}", "{cloth: {}},".repeat(2501));
    refused_at_once("particles", || error(&cloths, Format::Json5).to_string());
    let bodies = "tautline = 1\n".to_owned() + &"[[bodies]]\nrope={}\n".repeat(60_000);
    refused_at_once("bodies in TOML", || error(&bodies, Format::Toml).to_string());
    let scene = Scene { bodies: vec![Body::HalfSpace(Default::default()); 50_001], ..Scene::default() };
    refused_at_once("list", || scene.check().unwrap_err().to_string());
}

#[test]
fn long_texts_of_little_are_read_or_refused_at_once() {
    for (line, expected) in [
        ("#\n", "0 bodies"),
        ("[[bodies]]\n", "line 2, column 3: bodies[0]: expected value"),
        ("a.a=1\n", "line 3, column 3: there is something of this name already"),
        ("a={}\n", "line 3, column 1: there is something of this name already"),
    ] {
        let text = "tautline = 1\n".to_owned() + &line.repeat(200_000);
        let read = || parse(&text, Format::Toml);
        let outcome = at_once(line, || {
            read().map_or_else(|e| e.to_string(), |scene| format!("{} bodies", scene.bodies.len()))
        });
        assert_eq!(outcome, expected);
    }
}

#[test]
fn deep_nesting_is_refused_without_overflowing_the_stack() {
    for open in ["[", "{\"a\":", "{a:", "a=[", "a={a="] {
        let deep = open.repeat(1_000_000);
        for format in [Format::Json, Format::Json5, Format::Toml] {
            for text in [
                deep.clone(),
                format!("{{\"tautline\":1,\"bodies\":{deep}"),
                format!("tautline=1\nbodies={deep}"),
            ] {
                assert!(parse(&text, format).is_err(), "{open} {format:?}");
            }
        }
    }
    let dotted = format!("tautline = 1\nbodies{} = 1", ".a".repeat(100_000));
    assert!(parse(&dotted, Format::Toml).is_err());
}

/// The schema is written by `UPDATE_SCHEMA=1 cargo test -p tautline-scene --test document`.
#[test]
fn the_schema_that_is_checked_in_is_up_to_date() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/scene.schema.json");
    let schema = json_schema();
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::write(path, &schema).unwrap();
    }
    assert!(std::fs::read_to_string(path).unwrap() == schema, "{path} is not what the document's types say");
}

#[test]
fn every_field_of_the_schema_is_described() {
    fn visit(path: &str, value: &serde_json::Value) {
        if let Some(properties) = value.get("properties").and_then(|p| p.as_object()) {
            for (name, property) in properties {
                let is_tag =
                    value.get("additionalProperties").is_some_and(|a| a == false) && properties.len() == 1;
                let described =
                    property.get("description").is_some() || value.get("description").is_some() && is_tag;
                assert!(described, "{path}.{name}");
            }
        }
        for (name, child) in value.as_object().into_iter().flatten() {
            visit(&format!("{path}.{name}"), child);
        }
        for (i, child) in value.as_array().into_iter().flatten().enumerate() {
            visit(&format!("{path}[{i}]"), child);
        }
    }
    visit("", &serde_json::from_str(&json_schema()).unwrap());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_text_breaks_a_parser(text in r#"[\[\]{}:,'"\\/*# \n=.a-c0-9eEINx+-]{0,60}"#) {
        for format in [Format::Json, Format::Json5, Format::Toml] {
            let _ = parse(&text, format);
        }
    }

    #[test]
    fn a_document_cut_short_is_refused(cut in 0usize..100) {
        let text = serde_json::to_string(&Scene { bodies: vec![Body::Rope(Rope::default())], ..Scene::default() }).unwrap();
        let cut = cut * (text.len() - 1) / 100;
        prop_assert!(parse(&text[..cut], Format::Json).is_err());
        prop_assert!(parse(&text[..cut], Format::Json5).is_err());
    }
}
