//! Joints in documents.

use tautline::{JointKind, Vec3};
use tautline_scene::build::BuiltScene;
use tautline_scene::document::{Format, Scene, Solver, parse};

fn scene(bodies: &str, joints: &str) -> Scene {
    // What falls asleep stops a little before its rest.
    let settings = "settings: {sleep: 'never'}";
    let text = format!("{{tautline: 1, {settings}, bodies: [{bodies}], joints: [{joints}]}}");
    parse(&text, Format::Json5).unwrap()
}

fn problems(scene: &Scene) -> Vec<String> {
    scene.problems().iter().map(ToString::to_string).collect()
}

/// A fixed post, a weight of 1 kg beside it and one further on, with a floor before them.
const BODIES: &str = "{half_space: {offset: -9}},
    {rigid: {name: 'post', shape: {box: {size: [0.2, 2, 0.2]}}, fixed: true}},
    {rigid: {name: 'weight', shape: {sphere: {radius: 0.1}}, mass: 1, position: [1, 0, 0]}},
    {rigid: {name: 'end', shape: {box: {size: [0.2, 0.2, 0.2]}}, mass: 1, position: [2, 0, 0]}}";

fn after(joints: &str, seconds: f32) -> BuiltScene {
    let mut built = scene(BODIES, joints).build().unwrap();
    for _ in 0..(60.0 * seconds).round() as u32 {
        assert_eq!(built.world.step(1.0 / 60.0).unwrap().faults, []);
    }
    built
}

fn center(built: &BuiltScene, name: &str) -> Vec3 {
    let part = built.parts.iter().find(|part| part.name == name).unwrap();
    built.world.body(part.body).unwrap().center_of_mass()
}

#[test]
fn bodies_are_named_or_counted() {
    for (body, base) in [("'weight'", "'post'"), ("2", "1"), ("2", "'post'")] {
        let built = scene(BODIES, &format!("{{body: {body}, base: {base}}}")).build().unwrap();
        let joint = built.world.joint(built.world.joints().next().unwrap()).unwrap();
        let [post, weight] = [1, 2].map(|part: usize| built.parts[part].body);
        assert_eq!((joint.kind(), joint.body(), joint.base()), (JointKind::Ball, weight, Some(post)));
        assert_eq!(joint.anchors(), [Vec3::X; 2]);
    }
    // A room makes six bodies of the world.
    let joint = "{body: 1, kind: {fixed: {}}}";
    let built = scene("{room: {}}, {rigid: {}}", joint).build().unwrap();
    let joint = built.world.joint(built.world.joints().next().unwrap()).unwrap();
    assert_eq!((joint.kind(), joint.body(), joint.base()), (JointKind::Fixed, built.parts[6].body, None));
}

#[test]
fn every_kind_holds_what_it_says() {
    let built = after("{body: 'weight', base: 'post', anchor: [0, 0, 0]}", 3.0);
    assert!((center(&built, "weight").length() - 1.0).abs() < 1e-4);
    let built = after("{body: 'weight', kind: {fixed: {}}}", 2.0);
    assert!(center(&built, "weight").distance(Vec3::X) < 1e-4);
    let slider = "{body: 'weight', base: 'post', kind: {slider: {limits: [-0.5, 0]}}}";
    assert!(center(&after(slider, 2.0), "weight").distance(Vec3::new(1.0, -0.5, 0.0)) < 1e-3);
    let motor = "{body: 'weight', kind: {slider: {axis: [0, 0, 2], motor: {speed: 0.5, strength: 99}}}}";
    assert!(center(&after(motor, 2.0), "weight").distance(Vec3::new(1.0, 0.0, 1.0)) < 0.02);
    let rope = "{body: 'weight', base_anchor: [1, 0, 0], kind: {distance: {range: [0, 0.7]}}}";
    assert!(center(&after(rope, 2.0), "weight").distance(Vec3::new(1.0, -0.7, 0.0)) < 1e-3);
    // At rest it hangs g/(2π f)² below where it is sprung to.
    let spring = "{body: 'weight', base_anchor: [1, 1, 0],
        kind: {distance: {length: 1.5, spring: {frequency: 1, damping_ratio: 0.7}}}}";
    let expected = 1.0 - 1.5 - 9.81 / (2.0 * std::f32::consts::PI).powi(2);
    let height = center(&after(spring, 5.0), "weight").y;
    assert!((height - expected).abs() < 1e-3, "{height}, not {expected}");
}

#[test]
fn angles_are_in_degrees() {
    let angle = |fields: &str, seconds: f32| {
        let hinge = format!(
            "{{body: 'weight', base: 'post', anchor: [0, 0, 0], kind: {{hinge: {{axis: [0, 0, 1], {fields}}}}}}}"
        );
        let built = after(&hinge, seconds);
        built.world.joint(built.world.joints().next().unwrap()).unwrap().angle().unwrap().to_degrees()
    };
    // It swings down against the lower limit, and stays.
    assert!((angle("limits_degrees: [-30, 10]", 5.0) + 30.0).abs() < 0.1);
    assert!((angle("motor: {speed: 1, strength: 1000}", 1.0) - 57.3).abs() < 1.0);
    let cone = "{body: 'weight', base: 'post', anchor: [0, 0, 0], kind: {ball: {axis: [1, 0, 0],
        cone_degrees: 20, twist_degrees: [-5, 5]}}}";
    let built = after(cone, 5.0);
    let joint = built.world.joint(built.world.joints().next().unwrap()).unwrap();
    let [swing, twist] = joint.swing_and_twist().unwrap();
    assert!((swing.to_degrees() - 20.0).abs() < 0.1 && twist.abs() < 0.1, "{swing} {twist}");
}

#[test]
fn joints_give_way_break_and_let_collide_where_they_are_told_to() {
    let stretched = after("{body: 'weight', compliance: 0.001}", 10.0);
    let height = center(&stretched, "weight").y;
    assert!((height + 0.00981).abs() < 1e-4, "{height}");
    let is_broken = |fields: &str| {
        let joints = format!("{{body: 'weight', kind: {{fixed: {{}}}}, anchor: [0, 0, 0], {fields}}}");
        let built = after(&joints, 0.2);
        built.world.joint(built.world.joints().next().unwrap()).unwrap().is_broken()
    };
    // 9.81 N on an arm of 1 m.
    for (fields, expected) in [
        ("break_force: 9.7", true),
        ("break_force: 9.9", false),
        ("break_torque: 9.7", true),
        ("break_torque: 9.9", false),
    ] {
        assert_eq!(is_broken(fields), expected, "{fields}");
    }
    let bodies = "{rigid: {fixed: true}}, {rigid: {position: [0, 0.9, 0], mass: 1}}";
    for (fields, passes) in [("", true), ("collide_connected: true", false)] {
        let rope = format!("{{body: 1, base: 0, kind: {{distance: {{range: [0, 9]}}}}, {fields}}}");
        let mut built = scene(bodies, &rope).build().unwrap();
        for _ in 0..60 {
            built.world.step(1.0 / 60.0).unwrap();
        }
        let height = built.world.body(built.parts[1].body).unwrap().center_of_mass().y;
        assert_eq!(height < 0.5, passes, "{fields}: {height}");
    }
}

#[test]
fn what_is_wrong_is_named_by_its_path() {
    let cases = [
        ("{body: 'nobody'}", "joints[0].body: no body has the name \"nobody\""),
        ("{body: 4}", "joints[0].body: 4 is the index of no body: there are 4"),
        ("{body: 'weight', base: 0}", "joints[0].base: bodies[0] is a half_space: joints hold rigid bodies"),
        ("{body: 'weight', base: 2}", "joints[0].base: it is the body itself"),
        ("{body: 'post'}", "joints[0].body: neither it nor its base is dynamic"),
        ("{body: 2, anchor: [0, NaN, 0]}", "joints[0].anchor[1]: NaN is not"),
        ("{body: 2, base_anchor: [0, 0, -1e7]}", "joints[0].base_anchor[2]: -10000000 is not"),
        ("{body: 2, compliance: -1}", "joints[0].compliance: -1 is not a number from 0 to 1e20"),
        ("{body: 2, angular_compliance: Infinity}", "joints[0].angular_compliance: inf is not"),
        ("{body: 2, break_force: 0}", "joints[0].break_force: 0 is not a finite number above 0"),
        ("{body: 2, break_torque: -1}", "joints[0].break_torque: -1 is not a finite number above 0"),
        (
            "{body: 2, kind: {hinge: {axis: [0, 0, 0]}}}",
            "joints[0].kind.hinge.axis: [0.0, 0.0, 0.0] gives no direction",
        ),
        (
            "{body: 2}, {body: 2, kind: {hinge: {limits_degrees: [10, -10]}}}",
            "joints[1].kind.hinge.limits_degrees[1]: -10 is less than limits_degrees[0], 10",
        ),
        (
            "{body: 2, kind: {hinge: {motor: {speed: NaN, strength: 1}}}}",
            "joints[0].kind.hinge.motor.speed: NaN is not",
        ),
        (
            "{body: 2, kind: {slider: {motor: {speed: 1, strength: -1}}}}",
            "joints[0].kind.slider.motor.strength: -1 is not",
        ),
        ("{body: 2, kind: {slider: {limits: [0, NaN]}}}", "joints[0].kind.slider.limits[1]: NaN is not"),
        ("{body: 2, kind: {ball: {cone_degrees: 181}}}", "joints[0].kind.ball.cone_degrees: 181 is not"),
        (
            "{body: 2, kind: {ball: {twist_degrees: [-190, 0]}}}",
            "joints[0].kind.ball.twist_degrees[0]: -190 is not",
        ),
        ("{body: 2, kind: {distance: {length: -1}}}", "joints[0].kind.distance.length: -1 is not"),
        ("{body: 2, kind: {distance: {range: [-1, 1]}}}", "joints[0].kind.distance.range[0]: -1 is not"),
        (
            "{body: 2, kind: {distance: {spring: {frequency: 0}}}}",
            "joints[0].kind.distance.spring.frequency: 0 is not a number from 1e-6",
        ),
        (
            "{body: 2, kind: {distance: {spring: {frequency: 1, damping_ratio: -1}}}}",
            "joints[0].kind.distance.spring.damping_ratio: -1 is not",
        ),
        (
            "{body: 2, kind: {distance: {}}, break_torque: 1}",
            "joints[0].break_torque: a distance joint holds no rotation",
        ),
        (
            "{body: 2, kind: {distance: {}}, angular_compliance: 1}",
            "joints[0].angular_compliance: a distance joint holds no rotation",
        ),
    ];
    for (joints, expected) in cases {
        let found = problems(&scene(BODIES, joints));
        assert_eq!(found.len(), 1, "{joints}: {found:?}");
        assert!(found[0].starts_with(expected), "{joints}: {}", found[0]);
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_its_path() {
    for (joint, expected) in [
        ("{}", "joints[0]: missing field `body`"),
        (
            "{body: -1}",
            "joints[0].body: invalid value: integer `-1`, expected the index or the name of a body",
        ),
        (
            "{body: 0, axis: [0, 1, 0]}",
            "joints[0].axis: unknown field `axis`, expected one of `body`, `base`, `kind`",
        ),
        ("{body: 0, kind: {ball: {limits: [0, 1]}}}", "joints[0].kind.ball.limits: unknown field `limits`"),
        (
            "{body: 0, kind: {weld: {}}}",
            "unknown variant `weld`, expected one of `ball`, `hinge`, `fixed`, `slider`, `distance`",
        ),
    ] {
        let text = format!("{{tautline: 1, joints: [{joint}]}}");
        let error = parse(&text, Format::Json5).unwrap_err().to_string();
        assert!(error.contains(expected), "{joint}: {error}");
    }
}

#[test]
fn where_bodies_are_of_sticks_joints_are_refused_with_what_to_do() {
    let sentence = "joints: bodies of sticks have no joints: set settings.solver to \"default\"";
    let joint = "{body: 'weight', base: 'post'}";
    let mut for_paper = scene(BODIES, joint);
    for_paper.settings.use_solver(Solver::Paper);
    let found = problems(&for_paper);
    assert!(found.len() == 1 && found[0].starts_with(sentence), "{found:?}");
    assert_eq!(problems(&scene(&format!("{BODIES}, {{rope: {{}}}}"), joint)), [""; 0]);
}

#[test]
fn joints_survive_being_written_and_read() {
    let scene = scene(
        BODIES,
        "{body: 'weight', base: 1, anchor: [0, 1, 0], base_anchor: [0, 2, 0], compliance: 0.5, angular_compliance: 2,
            break_force: 3, break_torque: 4, collide_connected: true,
            kind: {hinge: {axis: [1, 0, 0], limits_degrees: [-1, 1], motor: {speed: 1, strength: 2}}}},
        {body: 2}, {body: 2, kind: {fixed: {}}}, {body: 2, kind: {slider: {limits: [0, 1]}}},
        {body: 2, kind: {ball: {cone_degrees: 1, twist_degrees: [0, 1]}}},
        {body: 2, kind: {distance: {length: 1, range: [0, 2], spring: {frequency: 2}}}}",
    );
    assert_eq!(problems(&scene), [""; 0]);
    let json = serde_json::to_string(&scene).unwrap();
    let toml = toml::to_string(&scene).unwrap();
    for (text, format) in [(&json, Format::Json), (&json, Format::Json5), (&toml, Format::Toml)] {
        assert!(parse(text, format).unwrap() == scene, "{format:?}");
    }
    let plain = Scene::default();
    assert!(!serde_json::to_string(&plain).unwrap().contains("joints"));
}
