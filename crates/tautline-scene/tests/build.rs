//! Documents to worlds: what reaches the engine, and what it refuses.

use tautline::{BodyKind, Vec3};
use tautline_scene::build::{BuiltScene, Look};
use tautline_scene::document::{Format, Solver, parse};
use tautline_scene::{Error, load};

fn build(bodies: &str) -> BuiltScene {
    parse(&format!("{{tautline: 1, bodies: [{bodies}]}}"), Format::Json5).unwrap().build().unwrap()
}

fn build_for_paper(bodies: &str) -> BuiltScene {
    let text = format!("{{tautline: 1, settings: {{solver: 'paper'}}, bodies: [{bodies}]}}");
    parse(&text, Format::Json5).unwrap().build().unwrap()
}

fn problems(bodies: &str) -> Vec<String> {
    let scene = parse(&format!("{{tautline: 1, bodies: [{bodies}]}}"), Format::Json5).unwrap();
    match scene.build().unwrap_err() {
        Error::Invalid(problems) => problems.iter().map(ToString::to_string).collect(),
        other => panic!("{other:?}"),
    }
}

/// A tetrahedron whose frame is at a corner.
const CORNER: &str = "{mesh: {positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}}";

#[test]
fn a_body_is_where_its_frame_is_put() {
    let document = format!(
        "{{rigid: {{shape: {CORNER}, position: [1, 2, 3], rotation: {{axis: [0, 2, 0], degrees: 90}}}}}}"
    );
    let expected = [[1.0, 2.0, 3.0], [1.0, 2.0, 2.0], [1.0, 3.0, 3.0], [2.0, 2.0, 3.0]].map(Vec3::from);
    for built in [build(&document), build_for_paper(&document)] {
        let body = built.world.body(built.parts[0].body).unwrap();
        let (Look::Solid(surface), Some((center, rotation))) = (&built.parts[0].look, body.pose()) else {
            panic!("{:?}", built.parts[0])
        };
        for (&corner, expected) in surface.positions.iter().zip(expected) {
            assert!((center + rotation * corner).distance(expected) < 1e-6, "{corner} {expected}");
        }
        let mean = expected.iter().sum::<Vec3>() / 4.0;
        assert!(body.center_of_mass().distance(mean) < 1e-6);
    }
}

#[test]
fn mass_comes_from_density_and_volume_unless_it_is_given() {
    let rigid = "{rigid: {shape: {box: {size: [1, 2, 3]}}}},
        {rigid: {shape: {box: {size: [1, 2, 3]}}, density: 2}}, {rigid: {mass: 5}}";
    for bodies in [rigid.to_owned(), format!("{rigid}, {{cloth: {{mass: 7}}}}, {{rope: {{mass: 9}}}}")] {
        let built = build(&bodies);
        let masses: Vec<f32> =
            built.parts.iter().map(|part| built.world.body(part.body).unwrap().mass()).collect();
        for (mass, expected) in masses.iter().zip([6000.0, 12.0, 5.0, 7.0, 9.0]) {
            assert!((mass / expected - 1.0).abs() < 1e-5, "{masses:?}");
        }
    }
}

#[test]
fn equal_shapes_are_shared_and_others_are_not() {
    let ball = |radius: &str| format!("{{rigid: {{shape: {{icosahedron: {{radius: {radius}}}}}}}}}");
    let balls = [ball("0.5"), ball("0.25"), ball("0.50")].join(",");
    let built = build_for_paper(&balls);
    let truss = |i: usize| built.world.body(built.parts[i].body).unwrap().truss().unwrap() as *const _;
    assert!(truss(0) == truss(2) && truss(0) != truss(1));
    for built in [built, build(&balls)] {
        let shared = |i: usize, j: usize| {
            matches!((&built.parts[i].look, &built.parts[j].look),
                (Look::Solid(a), Look::Solid(b)) if std::sync::Arc::ptr_eq(a, b))
        };
        assert!(shared(0, 2) && !shared(0, 1));
    }
}

#[test]
fn every_field_of_a_body_reaches_it() {
    let built = build(
        "{rigid: {velocity: [1, 2, 3], angular_velocity: [0, 0, 1], friction: 0.25, fixed: false}},
         {rigid: {fixed: true, velocity: [1, 0, 0]}}, {half_space: {normal: [0, 3, 0], offset: -2, friction: 0.75}}",
    );
    let body = |i: usize| built.world.body(built.parts[i].body).unwrap();
    assert!(body(0).velocity().distance(Vec3::new(1.0, 2.0, 3.0)) < 1e-5);
    assert!(body(0).angular_velocity().distance(Vec3::Z) < 1e-5);
    assert_eq!((body(0).friction(), body(0).is_fixed()), (0.25, false));
    assert!(body(1).is_fixed());
    assert_eq!((body(2).plane(), body(2).friction()), (Some((Vec3::Y, -2.0)), 0.75));
}

#[test]
fn pins_and_weights_are_those_of_the_places_named() {
    let grid = "surface: {grid: {columns: 3, rows: 4, width: 2, depth: 3}}, mass: 12";
    let pinned = |pins: &str| -> Vec<usize> {
        let built = build(&format!("{{cloth: {{{grid}, position: [5, 0, 0], pins: {pins}}}}}"));
        let body = built.world.body(built.parts[0].body).unwrap();
        (0..12).filter(|&i| body.inverse_masses()[i] == 0.0).collect()
    };
    let cases = [
        ("['back-left']", vec![0]),
        ("['back-right']", vec![2]),
        ("['front-left']", vec![9]),
        ("['front-right', 4]", vec![4, 11]),
        ("['corners']", vec![0, 2, 9, 11]),
        ("['back']", vec![0, 1, 2]),
        ("['front']", vec![9, 10, 11]),
        ("['left']", vec![0, 3, 6, 9]),
        ("['right']", vec![2, 5, 8, 11]),
    ];
    for (pins, expected) in cases {
        assert_eq!(pinned(pins), expected, "{pins}");
    }
    let built = build(&format!(
        "{{cloth: {{{grid}, weights: [{{at: 'back', mass: 4}}, {{at: 5, mass: 0.5}}]}}}},
         {{rope: {{path: {{line: {{from: [0, 1, 0], to: [4, 1, 0], segments: 4}}}}, mass: 5, pins: ['first'],
            weights: [{{at: 'last', mass: 2}}]}}}}"
    ));
    let body = |i: usize| built.world.body(built.parts[i].body).unwrap();
    assert_eq!(body(0).inverse_masses()[..6], [0.25, 0.25, 0.25, 1.0, 1.0, 2.0]);
    assert_eq!(body(1).inverse_masses(), [0.0, 1.0, 1.0, 1.0, 0.5]);
    // Places are as seen from above: left is −X, back −Z.
    assert_eq!(body(0).positions()[0], Vec3::new(-1.0, 0.0, -1.5));
}

#[test]
fn a_rope_has_the_length_it_is_given() {
    let line = "path: {line: {from: [0, 1, 0], to: [4, 1, 0], segments: 8}}";
    let built = build(&format!("{{rope: {{{line}}}}}, {{rope: {{{line}, length: 6}}}}"));
    let length = |i: usize| {
        let sticks = built.world.body(built.parts[i].body).unwrap().sticks();
        sticks.iter().map(|stick| stick.rest_length).sum::<f32>()
    };
    assert!((length(0) - 4.0).abs() < 1e-5 && (length(1) - 6.0).abs() < 1e-5);
}

#[test]
fn stiffness_thickness_and_self_collision_change_the_motion() {
    let hash = |body: &str| {
        let mut built = build(&format!("{{half_space: {{}}}}, {body}"));
        for _ in 0..60 {
            built.world.step(built.dt).unwrap();
        }
        built.world.state_hash()
    };
    let strip = "surface: {grid: {columns: 5, rows: 30, width: 0.2, depth: 1.5}}, position: [0, 0.8, 0],
        rotation: {axis: [1, 0, 0], degrees: 80}";
    let rope = "path: {line: {from: [0, 0.3, 0], to: [0.2, 1.8, 0], segments: 40}}";
    for (kind, base, changes) in [
        ("cloth", strip, ["self_collision: false", "thickness: 0.01", "bending: 0.1"]),
        ("rope", rope, ["self_collision: true", "least_angle_degrees: 150", "bending: 0.1"]),
    ] {
        let plain = hash(&format!("{{{kind}: {{{base}}}}}"));
        for change in changes {
            assert_ne!(plain, hash(&format!("{{{kind}: {{{base}, {change}}}}}")), "{change}");
        }
    }
}

#[test]
fn a_room_is_six_half_spaces_that_face_inwards() {
    let built = build("{room: {min: [0, 0, 0], max: [2, 4, 6]}}");
    assert_eq!(built.parts.len(), 6);
    for part in &built.parts {
        let body = built.world.body(part.body).unwrap();
        let (normal, offset) = body.plane().unwrap();
        assert_eq!(body.kind(), BodyKind::HalfSpace);
        assert!(normal.dot(Vec3::new(1.0, 2.0, 3.0)) > offset, "{}", part.name);
        let Look::Wall(mesh) = &part.look else { panic!("{part:?}") };
        assert!(mesh.positions.iter().all(|p| (normal.dot(*p) - offset).abs() < 1e-6), "{}", part.name);
    }
}

#[test]
fn names_are_unique_and_colours_those_given() {
    let built = build(
        "{rigid: {name: 'rigid 1', color: '#010203'}}, {rigid: {}}, {rigid: {}}, {rigid: {fixed: true}}, {rope: {}}",
    );
    let names: Vec<&str> = built.parts.iter().map(|part| &*part.name).collect();
    assert_eq!(names, ["rigid 1", "rigid 1'", "rigid 2", "rigid 3", "rope 4"]);
    let colors: Vec<[u8; 3]> = built.parts.iter().map(|part| part.color).collect();
    assert_eq!(colors[0], [1, 2, 3]);
    assert!(colors[1] != colors[2] && colors[2] != colors[4] && colors[1] != colors[3]);
}

#[test]
fn settings_are_the_solvers_own_unless_they_are_given() {
    let settings = |text: &str| {
        let scene = parse(&format!("{{tautline: 1, settings: {{{text}}}}}"), Format::Json5).unwrap();
        scene.build().unwrap().world.settings().clone()
    };
    assert_eq!(settings(""), tautline::Settings::default());
    assert_eq!(settings("solver: 'paper'"), tautline::Settings::paper());
    let given = settings(
        "gravity: [1, 2, 3], substeps: 3, features_per_pair: 2, separation_speed: 1.5, sweeps: 7, tolerance: 0.25,
         ordering: 'as-built', square_root: 'first-order', damping: 0.5, wind: [4, 5, 6], air_density: 1.5,
         broad_phase: 'all-pairs', sleep: 'never'",
    );
    let relaxation = tautline::Relaxation {
        sweeps: 7,
        tolerance: 0.25,
        ordering: tautline::Ordering::AsBuilt,
        square_root: tautline::SquareRoot::FirstOrder,
    };
    let expected = tautline::Settings {
        gravity: Vec3::new(1.0, 2.0, 3.0),
        substeps: 3,
        features_per_pair: 2,
        separation_speed: Some(1.5),
        relaxation,
        damping: 0.5,
        wind: Vec3::new(4.0, 5.0, 6.0),
        air_density: 1.5,
        broad_phase: tautline::BroadPhase::AllPairs,
        sleep: None,
        ..tautline::Settings::default()
    };
    assert_eq!(given, expected);
    let sleep = settings("sleep: {after: {speed: 0.5, seconds: 2}}").sleep;
    assert_eq!(sleep, Some(tautline::Sleep { speed: 0.5, seconds: 2.0 }));
}

#[test]
fn another_solver_comes_with_its_own_choices() {
    let mut scene =
        parse("{tautline: 1, settings: {substeps: 3, damping: 0.5, wind: [1, 0, 0], air_density: 2, gravity: [0, 0, 0]}}", Format::Json5)
            .unwrap();
    scene.settings.use_solver(Solver::Default);
    assert_eq!(scene.settings.substeps, Some(3));
    scene.settings.use_solver(Solver::Paper);
    let settings = scene.build().unwrap().world.settings().clone();
    let expected = tautline::Settings {
        gravity: Vec3::ZERO,
        damping: 0.5,
        wind: Vec3::X,
        air_density: 2.0,
        ..tautline::Settings::paper()
    };
    assert_eq!(settings, expected);
}

#[test]
fn what_the_engine_refuses_is_named_by_the_documents_path() {
    let open = "{mesh: {positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, 2]]}}";
    let flat = "{hull: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}}";
    let found = problems(&format!(
        "{{rope: {{}}}}, {{rigid: {{shape: {open}}}}}, {{rigid: {{shape: {flat}}}}}, {{cloth: {{friction: 1e7}}}},
         {{rigid: {{shape: {{file: {{path: 'a.obj'}}}}}}}}, {{cloth: {{surface: {{file: {{path: 'a.obj'}}}}}}}}"
    ));
    let starts = [
        "bodies[1].rigid.shape: mesh: edge (",
        "bodies[2].rigid.shape: mesh: its 4 points span no volume",
        "bodies[3].cloth: friction: 10000000 is not",
        "bodies[4].rigid.shape: file: its mesh has not been read",
        "bodies[5].cloth.surface: file: its mesh has not been read",
    ];
    assert_eq!(found.len(), starts.len(), "{found:#?}");
    for (problem, start) in found.iter().zip(starts) {
        assert!(problem.starts_with(start), "{problem}");
    }
    // A document with wrong values does not get that far.
    assert_eq!(problems("{rope: {mass: 0}}").len(), 1);
}

#[test]
fn a_scene_with_a_mesh_file_is_built_once_it_is_loaded() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("scene.toml");
    let scene = "tautline = 1\n[[bodies]]\nrigid = { shape = { file = { path = 't.obj', scale = 2 } }, density = 3 }\n";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::write(&path, scene).unwrap();
    std::fs::write(folder.path().join("t.obj"), obj).unwrap();
    let built = load(&path).unwrap().build().unwrap();
    let mass = built.world.body(built.parts[0].body).unwrap().mass();
    // A sixth of the cube of 2 m.
    assert!((mass - 3.0 * 8.0 / 6.0).abs() < 1e-5, "{mass}");
}
