//! Cues in documents.

use tautline::Vec3;
use tautline_scene::document::{Format, Scene, parse};
use tautline_scene::run::{Run, RunOptions};

fn scene(cues: &str) -> Scene {
    let bodies = "{rigid: {name: 'led', motion: 'kinematic'}}, {rigid: {name: 'post', fixed: true, position: [5, 0, 0]}},
        {rope: {name: 'rope', path: {line: {from: [0, 8, 0], to: [1, 8, 0], segments: 4}}}}";
    parse(&format!("{{tautline: 1, bodies: [{bodies}], cues: [{cues}]}}"), Format::Json5).unwrap()
}

/// Where the led body is after a time.
fn place(cues: &str, seconds: f32) -> Vec3 {
    let built = scene(cues).build().unwrap();
    let led = built.parts[0].body;
    let mut run = Run::new(built, RunOptions { seconds: Some(seconds), record: false }).unwrap();
    for _ in 0..run.step_count() {
        run.step().unwrap();
    }
    run.world().body(led).unwrap().center_of_mass()
}

#[test]
fn bodies_go_where_their_cues_lead_them() {
    let cues = "{at: 0.5, body: 'led', velocity: [2, 0, 0], angular_velocity: [0, 3, 0]},
        {at: 1, body: 0, velocity: [0, 1, 0]}, {at: 1.5, body: 'led'}";
    for (seconds, expected) in [
        (0.5, Vec3::ZERO),
        (1.0, Vec3::X),
        (1.25, Vec3::new(1.0, 0.25, 0.0)),
        (3.0, Vec3::new(1.0, 0.5, 0.0)),
    ] {
        let found = place(cues, seconds);
        assert!(found.distance(expected) < 1e-4, "after {seconds} s: {found}");
    }
}

#[test]
fn a_document_is_the_same_when_it_is_written_and_read() {
    let written = scene("{at: 0, body: 'led', angular_velocity: [0, 1, 0]}, {at: 2, body: 0}");
    let read = parse(&serde_json::to_string(&written).unwrap(), Format::Json5).unwrap();
    assert_eq!(written, read);
    assert_eq!(written.problems(), []);
}

#[test]
fn wrong_cues_are_refused_by_path() {
    for (cue, expected) in [
        ("{at: -1, body: 'led'}", "cues[0].at: "),
        ("{at: 1, body: 'nobody'}", "cues[0].body: no body has the name \"nobody\""),
        ("{at: 1, body: 'post'}", "cues[0].body: it is fixed"),
        ("{at: 1, body: 'rope'}", "cues[0].body: bodies[2] is a rope: a cue is for a rigid body"),
        ("{at: 1, body: 'led', velocity: [0, 1e9, 0]}", "cues[0].velocity[1]: "),
    ] {
        let problems: Vec<String> = scene(cue).problems().iter().map(ToString::to_string).collect();
        assert!(problems.len() == 1 && problems[0].starts_with(expected), "{cue}: {problems:?}");
    }
    let text = "{tautline: 1, settings: {solver: 'paper'}, bodies: [{rigid: {}}], cues: [{at: 1, body: 0}]}";
    let problems = parse(text, Format::Json5).unwrap().problems();
    assert!(problems.iter().any(|problem| problem.path == "cues"), "{problems:?}");
}
