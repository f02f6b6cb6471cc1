//! Rigid bodies in documents: of four particles under the default solver, of sticks under the paper's and beside cloth
//! and rope.

use tautline::{BodyKind, Vec3};
use tautline_scene::build::{BuiltScene, Look};
use tautline_scene::document::{Format, Scene, Solver, parse};
use tautline_scene::load;
use tautline_scene::run::{Run, RunOptions};

fn scene(bodies: &str) -> Scene {
    parse(&format!("{{tautline: 1, bodies: [{bodies}]}}"), Format::Json5).unwrap()
}

fn after(bodies: &str, seconds: f32) -> BuiltScene {
    let mut built = scene(bodies).build().unwrap();
    for _ in 0..(60.0 * seconds) as u32 {
        assert_eq!(built.world.step(1.0 / 60.0).unwrap().faults, []);
    }
    built
}

fn center(built: &BuiltScene, part: usize) -> Vec3 {
    built.world.body(built.parts[part].body).unwrap().center_of_mass()
}

fn problems(scene: &Scene) -> Vec<String> {
    scene.problems().iter().map(ToString::to_string).collect()
}

const SOLIDS: [&str; 12] = [
    "{box: {size: [1, 0.8, 0.6]}}",
    "{tetrahedron: {radius: 0.5}}",
    "{octahedron: {radius: 0.5}}",
    "{dodecahedron: {radius: 0.5}}",
    "{icosahedron: {radius: 0.5}}",
    "{sphere: {radius: 0.5}}",
    "{icosphere: {radius: 0.5, subdivisions: 1}}",
    "{uv_sphere: {radius: 0.5, segments: 8, rings: 6}}",
    "{capsule: {radius: 0.3, height: 0.4}}",
    "{cylinder: {radius: 0.4, height: 0.5}}",
    "{torus: {radius: 0.5, tube_radius: 0.2, segments: 10, tube_segments: 6}}",
    "{hull: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}}",
];

#[test]
fn every_solid_is_a_body_of_both_solvers() {
    for shape in SOLIDS {
        let mut scene = scene(&format!("{{rigid: {{shape: {shape}, mass: 3}}}}"));
        for (solver, kind) in [(Solver::Default, BodyKind::Rigid), (Solver::Paper, BodyKind::Truss)] {
            scene.settings.use_solver(solver);
            let built = scene.build().unwrap();
            let body = built.world.body(built.parts[0].body).unwrap();
            assert_eq!(body.kind(), kind, "{shape}");
            assert!((body.mass() - 3.0).abs() < 1e-5, "{shape}");
        }
    }
}

#[test]
fn what_is_round_is_exact_unless_facets_are_asked_for() {
    let mass = |shape: &str| {
        let built = scene(&format!("{{rigid: {{shape: {shape}, density: 1}}}}")).build().unwrap();
        (built.world.body(built.parts[0].body).unwrap().mass(), matches!(built.parts[0].look, Look::Round(_)))
    };
    let pi = std::f32::consts::PI;
    for (shape, volume, is_round) in [
        ("{sphere: {radius: 1}}", 4.0 / 3.0 * pi, true),
        ("{capsule: {radius: 1, height: 3}}", 4.0 / 3.0 * pi + 3.0 * pi, true),
        ("{cylinder: {radius: 1, height: 3}}", 3.0 * pi, false),
    ] {
        let (mass, look) = mass(shape);
        assert!((mass / volume - 1.0).abs() < 1e-5 && look == is_round, "{shape}: {mass}");
    }
    for (shape, volume) in [
        ("{capsule: {radius: 1, height: 3, segments: 6}}", 13.6),
        ("{capsule: {radius: 1, height: 3, rings: 2}}", 13.6),
        // A prism over a regular hexagon.
        ("{cylinder: {radius: 1, height: 3, segments: 6}}", 7.795),
    ] {
        let (mass, look) = mass(shape);
        assert!(mass < volume && !look, "{shape}: {mass}");
    }
}

#[test]
fn rigid_bodies_are_trusses_under_the_papers_solver_only() {
    for (solver, kind) in [(Solver::Default, BodyKind::Rigid), (Solver::Paper, BodyKind::Truss)] {
        let mut scene = scene("{rigid: {}}, {cloth: {}}, {rope: {}}");
        scene.settings.use_solver(solver);
        let built = scene.build().unwrap();
        assert_eq!(built.world.body(built.parts[0].body).unwrap().kind(), kind);
    }
}

#[test]
fn what_a_truss_does_not_know_is_refused_by_name() {
    let fields = [
        ("restitution: 0.5", "restitution"),
        ("rolling_friction: 0.01", "rolling_friction"),
        ("gravity_scale: 0", "gravity_scale"),
        ("damping: {linear: 1}", "damping"),
        ("groups: {}", "groups"),
        ("motion: 'kinematic'", "motion"),
        ("shape: {compound: {parts: [{}]}}", "shape.compound"),
        ("fixed: true, shape: {surface: {grid: {columns: 2, rows: 2, width: 1, depth: 1}}}", "shape.surface"),
        (
            "fixed: true, shape: {height_field: {columns: 2, rows: 2, cell_size: 1, heights: [0, 0, 0, 0]}}",
            "shape.height_field",
        ),
    ];
    let reason = "only the solver \"default\" knows it";
    for (text, field) in fields {
        let rigid = format!("{{rigid: {{{text}}}}}");
        assert_eq!(problems(&scene(&rigid)), [""; 0], "{text}");
        let mut for_paper = scene(&rigid);
        for_paper.settings.use_solver(Solver::Paper);
        assert_eq!(problems(&for_paper), [format!("bodies[0].rigid.{field}: {reason}")], "{text}");
    }
    for wall in ["half_space", "room"] {
        for field in ["restitution", "rolling_friction"] {
            let mut for_paper = scene(&format!("{{{wall}: {{{field}: 0.5}}}}, {{cloth: {{}}}}"));
            for_paper.settings.use_solver(Solver::Paper);
            assert_eq!(problems(&for_paper), [format!("bodies[0].{wall}.{field}: {reason}")]);
        }
    }
}

#[test]
fn wrong_values_are_named_by_their_path() {
    let cases = [
        ("restitution: 1.5", "restitution: 1.5 is not a number from 0 to 1"),
        ("restitution: NaN", "restitution: NaN is not a number from 0 to 1"),
        ("rolling_friction: -1", "rolling_friction: -1 is not a finite number from 0"),
        ("gravity_scale: Infinity", "gravity_scale: inf is not a finite number"),
        ("damping: {angular: -1}", "damping.angular: -1 is not a number from 0"),
        ("groups: {filter: [0, 32]}", "groups.filter[1]: 32 is not a whole number from 0 to 31"),
        ("fixed: true, motion: 'dynamic'", "motion: the body is fixed already"),
        ("shape: {sphere: {radius: 0}}", "shape.sphere.radius: 0 is not"),
        ("shape: {capsule: {radius: 1, height: 1, rings: 0}}", "shape.capsule.rings: 0 is not"),
        ("shape: {compound: {parts: []}}", "shape.compound.parts: there are none"),
        (
            "shape: {compound: {parts: [{}, {shape: {box: {size: [1, -1, 1]}}}]}}",
            "shape.compound.parts[1].shape.box.size[1]: -1 is not",
        ),
        (
            "shape: {compound: {parts: [{shape: {surface: {grid: {columns: 2, rows: 2, width: 1, depth: 1}}}}]}}",
            "shape.compound.parts[0].shape: it has no inside",
        ),
        (
            "shape: {surface: {grid: {columns: 2, rows: 2, width: 1, depth: 1}}}",
            "shape: it has no inside, and so no mass",
        ),
        (
            "fixed: true, shape: {height_field: {columns: 2, rows: 3, cell_size: 1, heights: [1, 2]}}",
            "shape.height_field.heights: there are 2, and 2 columns of 3 rows are 6",
        ),
        (
            "fixed: true, shape: {height_field: {columns: 1, rows: 2, cell_size: 1, heights: [1, 2]}}",
            "shape.height_field.columns: 1 is not a whole number from 2 to 2049",
        ),
    ];
    for (text, expected) in cases {
        let found = problems(&scene(&format!("{{rigid: {{{text}}}}}")));
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        assert!(found[0].starts_with(&format!("bodies[0].rigid.{expected}")), "{text}: {}", found[0]);
    }
    let found = problems(&scene("{half_space: {restitution: -1}}, {room: {restitution: 2}}"));
    assert!(found[0].starts_with("bodies[0].half_space.restitution: -1") && found.len() == 2, "{found:?}");
}

#[test]
fn every_field_changes_the_motion_as_it_says() {
    let floor = "{half_space: {}}";
    let ball = |fields: &str| format!("{floor}, {{rigid: {{shape: {{sphere: {{radius: 0.5}}}}, {fields}}}}}");
    let height = |fields: &str, seconds: f32| center(&after(&ball(fields), seconds), 1).y;
    // From 2 m above the floor it takes 0.64 s, and as long again to the top.
    assert!((height("position: [0, 2.5, 0]", 1.28) - 0.5).abs() < 0.01);
    let bounced = height("position: [0, 2.5, 0], restitution: 1", 1.28);
    assert!((2.4..2.51).contains(&bounced), "{bounced}");
    assert!((height("position: [0, 2.5, 0], gravity_scale: 0", 1.0) - 2.5).abs() < 1e-4);
    let fallen = 50.0 - height("position: [0, 50, 0], damping: {linear: 10}", 2.0);
    // g t/c − g/c² (1 − e^(−c t))
    assert!((fallen - 1.864).abs() < 0.05, "{fallen}");
    assert!(height("position: [0, 2, 0], groups: {filter: []}", 2.0) < -10.0);
    let driven = after(&ball("position: [0, 2, 0], motion: 'kinematic', velocity: [0, -1, 0]"), 3.0);
    assert!((center(&driven, 1).y + 1.0).abs() < 1e-3);
    let rolled = |rolling: &str| {
        let ball = "shape: {sphere: {radius: 0.5}}, position: [0, 0.5, 0], velocity: [2, 0, 0]";
        let bodies = format!("{{half_space: {{{rolling}}}}}, {{rigid: {{{ball}, {rolling}}}}}");
        center(&after(&bodies, 4.0), 1).x
    };
    assert!(rolled("") > 5.0 && rolled("rolling_friction: 0.05") < 3.0);
    let wall =
        "{half_space: {restitution: 1}}, {rigid: {shape: {sphere: {radius: 0.5}}, position: [0, 2.5, 0]}}";
    assert!(center(&after(wall, 1.28), 1).y > 2.4);
}

#[test]
fn a_compound_moves_as_one_with_the_mass_of_its_parts() {
    let dumbbell =
        "{rigid: {shape: {compound: {parts: [{shape: {sphere: {radius: 0.5}}, position: [-1, 0, 0]},
        {shape: {box: {size: [1, 1, 1]}}, position: [1, 0, 0], rotation: {axis: [0, 1, 0], degrees: 45}}]}},
        position: [0, 3, 0], density: 2}}";
    let built = after(&format!("{{half_space: {{}}}}, {dumbbell}"), 3.0);
    let body = built.world.body(built.parts[1].body).unwrap();
    let expected = 2.0 * (1.0 + std::f32::consts::PI / 6.0);
    assert!((body.mass() / expected - 1.0).abs() < 1e-5, "{}", body.mass());
    assert!((body.center_of_mass().y - 0.5).abs() < 0.01, "{}", body.center_of_mass());
}

#[test]
fn mesh_files_are_found_inside_compounds_and_surfaces() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("scene.json5");
    let file = "{file: {path: 't.obj', scale: 2}}";
    let scene = format!(
        "{{tautline: 1, bodies: [{{rigid: {{shape: {{compound: {{parts: [{{shape: {file}}}]}}}}, density: 3}}}},
            {{rigid: {{shape: {{surface: {file}}}, fixed: true}}}}]}}"
    );
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::write(&path, scene).unwrap();
    let error = load(&path).unwrap_err().to_string();
    assert!(error.contains("bodies[0].rigid.shape.compound.parts[0].shape.file.path: "), "{error}");
    assert!(error.contains("bodies[1].rigid.shape.surface.file.path: "), "{error}");
    std::fs::write(folder.path().join("t.obj"), obj).unwrap();
    let built = load(&path).unwrap().build().unwrap();
    let mass = built.world.body(built.parts[0].body).unwrap().mass();
    assert!((mass - 3.0 * 8.0 / 6.0).abs() < 1e-5, "{mass}");
}

#[test]
fn a_recording_draws_bodies_where_they_are() {
    let built = scene(
        "{rigid: {shape: {sphere: {radius: 0.5}}, velocity: [1, 0, 0], gravity_scale: 0,
        position: [0, 1, 0], angular_velocity: [0, 0, 3]}}",
    )
    .build()
    .unwrap();
    let options = RunOptions { seconds: Some(1.0), record: true };
    let recording = Run::new(built, options).unwrap().complete(&mut |_, _| ()).unwrap().recording.unwrap();
    recording.check().unwrap();
    for frame in [0, 30, 60] {
        let middle = Vec3::new(frame as f32 / 60.0, 1.0, 0.0);
        for corner in recording.tracks[0].positions_at(frame).iter() {
            assert!((corner.distance(middle) - 0.5).abs() < 1e-4, "frame {frame}: {corner}");
        }
    }
}
