//! Attachments and nets in documents.

use tautline::{Quat, Vec3};
use tautline_scene::build::BuiltScene;
use tautline_scene::document::{Format, Scene, parse};

fn scene(bodies: &str, attachments: &str) -> Scene {
    let text = format!("{{tautline: 1, bodies: [{bodies}], attachments: [{attachments}]}}");
    parse(&text, Format::Json5).unwrap()
}

fn problems(bodies: &str, attachments: &str) -> Vec<String> {
    scene(bodies, attachments).problems().iter().map(ToString::to_string).collect()
}

fn ends(built: &BuiltScene) -> Vec<[Vec3; 2]> {
    built.world.attachments().map(|handle| built.world.attachment(handle).unwrap().ends()).collect()
}

const BODIES: &str = "{room: {min: [-9, -9, -9], max: [9, 9, 9]}},
    {rope: {name: 'rope', path: {line: {from: [0, 3, 0], to: [0, 1, 0], segments: 10}}}},
    {cloth: {name: 'sheet', surface: {grid: {columns: 3, rows: 3, width: 2, depth: 2}}, position: [0, 5, 0]}},
    {rigid: {name: 'load', shape: {box: {size: [1, 1, 1]}}, position: [0, 0.5, 0], mass: 4,
        rotation: {axis: [0, 0, 1], degrees: 90}}}";

#[test]
fn anchors_are_where_the_document_says() {
    let attachments = "{a: {body: 'rope', at: {end: 'last'}}, b: {body: 'load', at: {point: [0.2, 1, 0]}}},
        {a: {body: 1, at: {particle: 0}}, b: {at: {point: [0, 3, 0]}}},
        {a: {body: 'sheet', at: {corner: 'front-right'}}, b: {body: 'rope', at: {segment: {number: 2, fraction: 0.5}}}},
        {a: {body: 'sheet', at: {triangle: {number: 0}}}, b: {at: {point: [1, 2, 3]}}, break_force: 9, compliance: 0.1}";
    let built = scene(BODIES, attachments).build().unwrap();
    let ends = ends(&built);
    let near = |a: Vec3, b: Vec3| assert!(a.distance(b) < 1e-5, "{a} is not {b}");
    near(ends[0][0], Vec3::Y);
    near(ends[0][1], Vec3::new(0.2, 1.0, 0.0));
    near(ends[1][0], Vec3::Y * 3.0);
    near(ends[1][1], Vec3::Y * 3.0);
    near(ends[2][0], Vec3::new(1.0, 5.0, 1.0));
    near(ends[2][1], Vec3::Y * 2.5);
    near(ends[3][1], Vec3::new(1.0, 2.0, 3.0));
    assert!((ends[3][0].y - 5.0).abs() < 1e-5 && ends[3][0].x < 0.0, "{}", ends[3][0]);
    // A room makes six bodies of the world.
    let load = built.parts.iter().find(|part| part.name == "load").unwrap().body;
    let turned = built.world.body(load).unwrap().pose().unwrap().1;
    assert!(turned.dot(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2)).abs() > 0.999);
}

#[test]
fn a_document_is_the_same_when_it_is_written_and_read() {
    let attachments = "{a: {body: 'rope', at: {end: 'last'}}, b: {body: 3, at: {point: [0, 1, 0]}}, compliance: 0.5},
        {a: {body: 'sheet', at: {triangle: {number: 3, weights: [1, 0, 0]}}}, b: {body: 'rope', at: {particle: 3}}}";
    let net =
        "{rope: {path: {network: {points: [[0, 0, 0], [1, 0, 0], [2, 0, 1]], segments: [[0, 1], [1, 2]]}}}}";
    let written = scene(&format!("{BODIES}, {net}"), attachments);
    let read = parse(&serde_json::to_string(&written).unwrap(), Format::Json5).unwrap();
    assert_eq!(written, read);
    assert_eq!(written.problems(), []);
}

#[test]
fn what_is_wrong_is_told_by_its_path() {
    let rope = "a: {body: 'rope', at: {end: 'first'}}";
    let told = |attachment: &str| {
        let problems = problems(BODIES, attachment);
        assert_eq!(problems.len(), 1, "{problems:?}");
        problems[0].clone()
    };
    let begins = |attachment: &str, path: &str| {
        let told = told(attachment);
        assert!(told.starts_with(&format!("attachments[0].{path}: ")), "{told}");
    };
    begins(&format!("{{{rope}, b: {{body: 'nobody', at: {{point: [0, 0, 0]}}}}}}"), "b.body");
    begins(&format!("{{{rope}, b: {{body: 'load', at: {{particle: 0}}}}}}"), "b.at.particle");
    begins(&format!("{{{rope}, b: {{body: 'sheet', at: {{particle: 9}}}}}}"), "b.at.particle");
    begins(&format!("{{{rope}, b: {{body: 'sheet', at: {{corner: 'corners'}}}}}}"), "b.at.corner");
    begins(&format!("{{{rope}, b: {{body: 'sheet', at: {{end: 'last'}}}}}}"), "b.at.end");
    begins(&format!("{{{rope}, b: {{body: 0, at: {{point: [0, 0, 0]}}}}}}"), "b.at.point");
    begins(&format!("{{{rope}, b: {{at: {{point: [0, 0, 1e9]}}}}}}"), "b.at.point[2]");
    begins(&format!("{{{rope}, b: {{at: {{point: [0, 0, 0]}}}}, compliance: -1}}"), "compliance");
    begins(&format!("{{{rope}, b: {{at: {{point: [0, 0, 0]}}}}, break_force: 0}}"), "break_force");
    let weights = "{triangle: {number: 0, weights: [2, 0, 0]}}";
    begins(&format!("{{{rope}, b: {{body: 'sheet', at: {weights}}}}}"), "b.at.triangle.weights[0]");
    begins("{a: {body: 'load', at: {point: [0, 0, 0]}}, b: {at: {point: [0, 0, 0]}}}", "b");
    let paper = "{tautline: 1, settings: {solver: 'paper'}, bodies: [{rope: {}}],
        attachments: [{a: {body: 0, at: {particle: 0}}, b: {at: {point: [0, 0, 0]}}}]}";
    let problems = parse(paper, Format::Json5).unwrap().problems();
    assert!(problems.iter().any(|problem| problem.path == "attachments"), "{problems:?}");
    // What only the engine knows.
    let triangle = format!("{{{rope}, b: {{body: 'sheet', at: {{triangle: {{number: 99}}}}}}}}");
    let refused = scene(BODIES, &triangle).build().unwrap_err().to_string();
    assert!(refused.contains("attachments[0]"), "{refused}");
    let net = "{rope: {path: {network: {points: [[0, 0, 0], [1, 0, 0]], segments: [[0, 5]]}}}}";
    let problems = scene(net, "").problems();
    assert_eq!(problems[0].path, "bodies[0].rope.path.network.segments[0][1]");
}

#[test]
fn a_load_hangs_from_a_net() {
    let bodies = "{rope: {path: {network: {points: [[-1, 2, 0], [1, 2, 0], [0, 2, 0], [0, 1, 0]],
            segments: [[0, 2], [1, 2], [2, 3]]}}, pins: [0, 1], name: 'fork'}},
        {rigid: {name: 'load', shape: {sphere: {radius: 0.2}}, mass: 2, position: [0, 0.8, 0]}}";
    let attachment = "{a: {body: 'fork', at: {particle: 3}}, b: {body: 'load', at: {point: [0, 1, 0]}}}";
    let mut built = scene(bodies, attachment).build().unwrap();
    for _ in 0..120 {
        assert_eq!(built.world.step(1.0 / 60.0).unwrap().faults, []);
    }
    let [a, b] = ends(&built)[0];
    assert!(a.distance(b) < 1e-3 && a.y > 0.8, "{a} {b}");
}
