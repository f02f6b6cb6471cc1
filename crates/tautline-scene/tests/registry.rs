//! Every named scene: its document, its parameters, what becomes of it, and its hash.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use tautline_scene::document::{Format, Scene, Solver, parse};
use tautline_scene::registry::{NamedScene, find, scenes};
use tautline_scene::run::{Run, RunOptions, RunSummary};
use tautline_scene::{Error, build::Look};

fn default_document(scene: &NamedScene) -> Scene {
    scene.document(&scene.defaults())
}

fn with(name: &str, assignments: &[&str]) -> Scene {
    let scene = find(name).unwrap();
    let mut parameters = scene.defaults();
    assignments.iter().for_each(|assignment| parameters.assign(assignment).unwrap());
    scene.document(&parameters)
}

/// The scenes with what the paper does not have.
const NOT_FOR_PAPER: [&str; 15] = [
    "bullets",
    "mixed-pile",
    "chain",
    "ragdoll",
    "jelly",
    "tablecloth",
    "curtains",
    "bridge",
    "marbles",
    "trampoline",
    "knot",
    "mesh-drop",
    "scan-drape",
    "flag",
    "tear",
];

/// A scene's document for each solver that it is for.
fn documents(scene: &NamedScene) -> Vec<Scene> {
    let is_for = |solver: &Solver| *solver == Solver::Default || !NOT_FOR_PAPER.contains(&scene.name);
    let document = |solver: Solver| {
        let mut document = default_document(scene);
        document.settings.use_solver(solver);
        document
    };
    [Solver::Default, Solver::Paper].into_iter().filter(is_for).map(document).collect()
}

fn run(scene: &Scene, steps: u32) -> RunSummary {
    // Half a step less, for the rounding of a product.
    let seconds = Some((steps as f32 - 0.25) * scene.dt);
    let run = Run::new(scene.build().unwrap(), RunOptions { seconds, record: false }).unwrap();
    assert_eq!(run.step_count(), u64::from(steps));
    run.complete(&mut |_, _| ()).unwrap().summary
}

#[test]
fn documents_are_right_and_the_same_in_every_notation() {
    for scene in scenes() {
        let document = default_document(scene);
        assert_eq!(document.problems(), [], "{}", scene.name);
        assert_eq!((&*document.name, &*document.description), (scene.name, scene.description));
        let json = serde_json::to_string(&document).unwrap();
        let toml = toml::to_string(&document).unwrap();
        for (text, format) in [(&json, Format::Json), (&json, Format::Json5), (&toml, Format::Toml)] {
            assert!(parse(text, format).unwrap() == document, "{} as {format:?}", scene.name);
        }
    }
}

#[test]
fn names_are_plain_and_found_and_others_are_refused_with_a_list() {
    for scene in scenes() {
        assert!(scene.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{}", scene.name);
        assert_eq!(find(scene.name).unwrap().name, scene.name);
        assert!(scene.description.ends_with('.'), "{}", scene.name);
    }
    let error = find("icosahedron").unwrap_err();
    assert!(matches!(&error, Error::UnknownScene { known, .. } if known.len() == scenes().len()));
    assert!(error.to_string().contains("icosahedra, cloth-on-cube"), "{error}");
}

#[test]
fn scenes_build_at_both_ends_of_their_parameters() {
    for scene in scenes() {
        for parameter in scene.parameters {
            for value in [parameter.min, parameter.max] {
                let mut parameters = scene.defaults();
                parameters.set(parameter.name, value).unwrap();
                let document = scene.document(&parameters);
                assert_eq!(document.problems(), [], "{} {} = {value}", scene.name, parameter.name);
                let mut built = document.build().unwrap();
                let report = built.world.step(built.dt).unwrap();
                assert_eq!(report.faults, [], "{} {} = {value}", scene.name, parameter.name);
            }
        }
    }
}

#[test]
fn parameters_are_set_from_text_and_refused_by_name() {
    let scene = find("icosahedra").unwrap();
    let mut parameters = scene.defaults();
    parameters.assign(" n = 7 ").unwrap();
    assert_eq!((parameters.get("n"), parameters.get("seed")), (Some(7.0), Some(1.0)));
    let refusals = [
        ("m=7", "the scene icosahedra has no parameter named \"m\"; it has: n, seed"),
        ("n=0", "n: \"0\" is not a whole number from 1 to 5000"),
        ("n=2.5", "n: \"2.5\" is not a whole number"),
        ("n=NaN", "n: \"NaN\" is not"),
        ("n=many", "n: \"many\" is not"),
        ("n=", "n: \"\" is not"),
        ("n", "n: \"\" is not"),
        ("seed=-1", "seed: \"-1\" is not"),
    ];
    for (assignment, expected) in refusals {
        let error = parameters.assign(assignment).unwrap_err().to_string();
        assert!(error.starts_with(expected), "{error}");
    }
    assert_eq!(parameters.get("n"), Some(7.0));
}

#[test]
fn a_seed_makes_another_scene_of_the_same_kind() {
    let [one, same, other] = ["seed=5", "seed=5", "seed=6"].map(|seed| with("icosahedra", &[seed]));
    assert!(one == same && one != other && one.bodies.len() == other.bodies.len());
}

#[test]
fn thrown_bodies_begin_apart_and_inside_the_room() {
    for n in ["n=1", "n=9", "n=28", "n=50", "n=200"] {
        let summary = run(&with("icosahedra", &[n]), 1);
        // In a step at 5 m/s they move 8 cm.
        assert!(summary.escaped == 0 && summary.max_penetration_mm < 85.0, "{n}: {summary:?}");
        let built = with("icosahedra", &[n]).build().unwrap();
        assert_eq!(built.world.penetration().count, 0, "{n}");
    }
}

#[test]
fn scenes_run_without_fault() {
    for document in scenes().iter().flat_map(documents) {
        let (name, solver) = (&document.name, document.settings.solver);
        let summary = run(&document, 60);
        assert_eq!((summary.nonfinite, summary.escaped), (0, 0), "{name} {solver:?}");
        assert!(summary.kinetic_energy.is_finite(), "{name} {solver:?}");
    }
}

#[test]
fn the_papers_solver_refuses_the_scenes_that_are_not_for_it() {
    for name in NOT_FOR_PAPER {
        let mut document = with(name, &[]);
        document.settings.use_solver(Solver::Paper);
        let problems = document.problems();
        assert!(problems.iter().any(|problem| problem.message.contains("\"default\"")), "{name}");
    }
}

/// What a user sees at the end.
#[test]
fn cloth_stays_on_what_it_falls_on() {
    for (name, lowest) in [("cloth-on-cube", 0.7), ("cloth-on-rope", 1.0)] {
        for solver in [Solver::Default, Solver::Paper] {
            let mut document = with(name, &["n=20"]);
            document.settings.use_solver(solver);
            let built = document.build().unwrap();
            let cloth = built.parts.iter().find(|part| part.look == Look::Sheet).unwrap().body;
            let mut run = Run::new(built, RunOptions { seconds: Some(4.0), record: false }).unwrap();
            for _ in 0..run.step_count() {
                run.step().unwrap();
            }
            let cloth = run.world().body(cloth).unwrap();
            let height = cloth.center_of_mass().y;
            assert!(height > lowest, "{name} {solver:?}: at {height} m");
            let inside = |x: &tautline::Vec3| x.x.abs().max(x.z.abs()).max((x.y - 0.5).abs()) < 0.49;
            let pierced = name == "cloth-on-cube" && cloth.positions().iter().any(inside);
            assert!(
                !pierced && run.world().strain().max < 0.1,
                "{name} {solver:?}: {:?}",
                run.world().strain()
            );
        }
    }
}

/// How far the particle moved that moved furthest in a time.
fn furthest(document: &Scene, seconds: f32) -> f32 {
    let mut built = document.build().unwrap();
    let before = built.world.positions().to_vec();
    for _ in 0..(seconds / built.dt).round() as u32 {
        built.world.step(built.dt).unwrap();
    }
    let moved = built.world.positions().iter().zip(&before).map(|(a, b)| a.distance(*b));
    moved.fold(0.0, f32::max)
}

#[test]
fn stacks_stand() {
    let mut moving = Vec::new();
    for (name, parameters, most) in [
        ("tower", &["n=10"][..], 0.02),
        ("tower", &["n=20"], 0.02),
        ("pyramid", &["n=20"], 0.1),
        ("mass-ratio", &[], 0.01),
        ("arch", &[], 0.02),
        ("card-house", &[], 0.02),
    ] {
        let moved = furthest(&with(name, parameters), 10.0);
        if moved.is_nan() || moved > most {
            moving.push(format!("{name} {parameters:?}: by {moved} m"));
        }
    }
    assert!(moving.is_empty(), "{moving:#?}");
}

#[test]
fn stacks_of_sticks_stand() {
    for (name, parameter) in [("tower", "n=10"), ("pyramid", "n=6")] {
        // A rope beside them, which for now makes trusses of them.
        let mut document = with(name, &[parameter]);
        let rope = "{\"rope\": {\"path\": {\"line\": {\"from\": [90, 9, 0], \"to\": [91, 9, 0], \"segments\": 1}}, \"pins\": [0, 1]}}";
        document.bodies.push(serde_json::from_str(rope).unwrap());
        let moved = furthest(&document, 5.0);
        assert!(moved < 0.02, "{name}: by {moved} m");
    }
}

#[test]
fn dominoes_all_fall() {
    let document = with("dominoes", &[]);
    let built = document.build().unwrap();
    let options = RunOptions { seconds: None, record: false };
    let mut run = Run::new(built.clone(), options).unwrap();
    for _ in 0..run.step_count() {
        run.step().unwrap();
    }
    let mut standing = Vec::new();
    for part in &built.parts {
        let pose = run.world().body(part.body).unwrap().pose();
        if pose.is_some_and(|(_, rotation)| (rotation * tautline::Vec3::Y).y > 0.6) {
            standing.push(&part.name);
        }
    }
    assert!(standing.is_empty(), "{standing:?} still stand");
}

#[test]
fn nothing_leaves_the_bowl_or_gets_through_the_wall() {
    let outcome = |name: &str| {
        let document = with(name, &[]);
        let summary = run(&document, (document.seconds / document.dt) as u32);
        (summary.escaped, summary.nonfinite)
    };
    assert_eq!(outcome("mixed-pile"), (0, 0));
    assert_eq!(outcome("bullets"), (0, 0));
}

/// How far the sides of a joint that holds points together are apart in a run, at most, in m.
fn greatest_gap(name: &str, parameters: &[&str]) -> (f32, RunSummary) {
    let run_of =
        Run::new(with(name, parameters).build().unwrap(), RunOptions { seconds: None, record: false });
    let mut run = run_of.unwrap();
    let mut greatest = 0.0f32;
    for _ in 0..run.step_count() {
        run.step().unwrap();
        for joint in run.world().joints() {
            let [on_body, on_base] = run.world().joint(joint).unwrap().anchors();
            greatest = greatest.max(on_body.distance(on_base));
        }
    }
    (greatest, run.complete(&mut |_, _| ()).unwrap().summary)
}

#[test]
fn chains_hold_whatever_hangs_from_them() {
    for parameters in [&[][..], &["ratio=1000"], &["links=100"]] {
        let (gap, summary) = greatest_gap("chain", parameters);
        println!("chain {parameters:?}: {gap} m");
        assert!(gap < 0.02 && summary.escaped + summary.nonfinite == 0, "{parameters:?}: {gap} m");
    }
}

#[test]
fn ragdolls_keep_their_limbs() {
    for parameters in [&[][..], &["seed=2"], &["n=20"]] {
        let (gap, summary) = greatest_gap("ragdoll", parameters);
        println!("ragdoll {parameters:?}: {gap} m");
        assert!(gap < 0.01 && summary.escaped + summary.nonfinite == 0, "{parameters:?}: {gap} m");
    }
}

/// The hash of a scene after 120 steps, and why it last changed.
#[derive(Debug, Serialize, Deserialize)]
struct Golden {
    hash: String,
    because: String,
}

fn hash_in_pool(document: &Scene, threads: usize) -> String {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| run(document, 120).state_hash)
}

/// Guards against drift and against threads. Where a change of the engine means to change motion,
/// `UPDATE_GOLDEN_HASHES="the reason" cargo test -p tautline-scene --test registry` writes what is new.
#[test]
fn hashes_are_the_golden_ones_on_any_number_of_threads() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden_hashes.json");
    let reason = std::env::var("UPDATE_GOLDEN_HASHES").ok();
    let mut golden: BTreeMap<String, Golden> =
        std::fs::read(path).ok().map(|bytes| serde_json::from_slice(&bytes).unwrap()).unwrap_or_default();
    let mut found = BTreeMap::new();
    for document in scenes().iter().flat_map(documents) {
        let name = format!("{} {:?}", document.name, document.settings.solver).to_lowercase();
        let [one, two] = [1, 2].map(|threads| hash_in_pool(&document, threads));
        assert_eq!(one, two, "{name} on one thread and on two");
        found.insert(name, one);
    }
    if let Some(because) = reason {
        golden.retain(|name, _| found.contains_key(name));
        for (name, hash) in &found {
            if golden.get(name).is_none_or(|golden| golden.hash != *hash) {
                golden.insert(name.clone(), Golden { hash: hash.clone(), because: because.clone() });
            }
        }
        let text = serde_json::to_string_pretty(&golden).unwrap() + "\n";
        std::fs::write(path, text).unwrap();
    }
    let golden: BTreeMap<String, String> =
        golden.into_iter().map(|(name, golden)| (name, golden.hash)).collect();
    assert_eq!(found, golden);
}
