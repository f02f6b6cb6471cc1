//! Runs: their recordings and their figures.

use tautline::mesh::{HalfEdgeMesh, MassProperties, TriMesh};
use tautline::{Quat, Vec3};
use tautline_scene::Error;
use tautline_scene::build::BuiltScene;
use tautline_scene::document::{Format, parse};
use tautline_scene::recording::{Motion, Recording, Surface};
use tautline_scene::run::{Outcome, Run, RunOptions, RunSummary};

fn build(fields: &str) -> BuiltScene {
    parse(&format!("{{tautline: 1, {fields}}}"), Format::Json5).unwrap().build().unwrap()
}

fn run(fields: &str, seconds: f32) -> Outcome {
    let options = RunOptions { seconds: Some(seconds), record: true };
    Run::new(build(fields), options).unwrap().complete(&mut |_, _| ()).unwrap()
}

fn recording(fields: &str, seconds: f32) -> Recording {
    let recording = run(fields, seconds).recording.unwrap();
    recording.check().unwrap();
    recording
}

fn summary(fields: &str, seconds: f32) -> RunSummary {
    run(fields, seconds).summary
}

const ONE_OF_EACH: &str = "name: 'all', record_every: 3, bodies: [{rigid: {position: [0, 3, 0]}},
    {rigid: {fixed: true, position: [3, 3, 0]}}, {cloth: {position: [0, 5, 0]}}, {rope: {pins: ['first']}},
    {half_space: {offset: -1}}]";

fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f32 {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| positions[corner as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    triangles.iter().map(area).sum()
}

/// It hangs by its back edge, too heavy for what it bears, and so falls off.
#[test]
fn what_tears_is_seen_no_more() {
    let scene =
        "bodies: [{cloth: {surface: {grid: {columns: 7, rows: 7, width: 0.6, depth: 0.6}}, pins: ['back'],
        compliance: 1e-3, tear_at: 0.002}}]";
    let outcome = run(scene, 1.0);
    let recording = outcome.recording.unwrap();
    recording.check().unwrap();
    let mut world = build(scene).world;
    let sheet = world.bodies().next().unwrap();
    let whole = world.body(sheet).unwrap().triangles().len();
    let track = &recording.tracks[0];
    for frame in 0..recording.frame_count() {
        let body = world.body(sheet).unwrap();
        let expected = area(body.positions(), body.triangles());
        let found = area(&track.positions_at(frame), &track.mesh.triangles);
        assert!((found / expected - 1.0).abs() < 1e-4, "frame {frame}: {found} instead of {expected} m²");
        world.step(1.0 / 60.0).unwrap();
    }
    assert!(world.body(sheet).unwrap().triangles().len() < whole && track.mesh.triangles.len() == whole);
    let folder = tempfile::tempdir().unwrap();
    tautline_scene::export::write_glb(&recording, &folder.path().join("torn.glb")).unwrap();
}

#[test]
fn every_body_has_a_track_with_a_frame_for_every_third_step_and_the_first() {
    let recording = recording(ONE_OF_EACH, 1.0);
    let surfaces: Vec<Surface> = recording.tracks.iter().map(|track| track.surface).collect();
    let expected = [Surface::Solid, Surface::Solid, Surface::Sheet, Surface::Round, Surface::Wall];
    assert_eq!(surfaces, expected);
    assert!((recording.frame_rate - 20.0).abs() < 1e-4 && recording.name == "all");
    assert_eq!(recording.frame_count(), 21);
    assert!(recording.tracks.iter().enumerate().all(|(i, track)| {
        matches!(
            (&track.motion, i),
            (Motion::Rigid(_), 0) | (Motion::Still, 1 | 4) | (Motion::Deforming(_), 2 | 3)
        )
    }));
}

#[test]
fn tracks_are_where_the_bodies_are() {
    let mut run = Run::new(build(ONE_OF_EACH), RunOptions { seconds: Some(0.3), record: true }).unwrap();
    for _ in 0..run.step_count() {
        run.step().unwrap();
    }
    let world = run.world().clone();
    let bodies: Vec<_> = world.bodies().collect();
    let recording = run.finish().unwrap().recording.unwrap();
    let last = recording.frame_count() - 1;
    for (track, body) in recording.tracks.iter().zip(bodies).take(3) {
        let drawn = track.positions_at(last);
        let simulated = world.body(body).unwrap().surface_positions();
        assert_eq!(drawn.len(), simulated.len(), "{}", track.name);
        for (drawn, simulated) in drawn.iter().zip(&*simulated) {
            assert!(drawn.distance(*simulated) < 1e-3, "{}: {drawn} {simulated}", track.name);
        }
    }
}

#[test]
fn a_rope_is_drawn_as_a_closed_tube_of_its_radius() {
    let recording = recording(
        "bodies: [{rope: {path: {line: {from: [0, 2, 0], to: [3, 2, 0], segments: 30}}, radius: 0.05, pins: ['first']}}]",
        1.0,
    );
    let track = &recording.tracks[0];
    for frame in 0..recording.frame_count() {
        let mesh = TriMesh {
            positions: track.positions_at(frame).to_vec(),
            triangles: track.mesh.triangles.clone(),
        };
        HalfEdgeMesh::from_mesh(&mesh).unwrap().require_closed().unwrap();
        // A regular octagon of radius r has area 2√2 r².
        let volume = MassProperties::of(&mesh, 1.0).unwrap().volume;
        let expected = 2.0 * 2.0_f64.sqrt() * 0.05_f64.powi(2) * 3.0;
        assert!((volume / expected - 1.0).abs() < 0.03, "frame {frame}: {volume} {expected}");
    }
}

#[test]
fn a_tube_does_not_turn_around_its_rope_from_frame_to_frame() {
    let recording = recording(
        "bodies: [{rope: {path: {points: [[0, 2, 0], [0.7, 2, 0.7], [1.4, 2, 0], [2, 2, 1]]}, radius: 0.05,
            pins: ['first'], velocity: [0, 0, 3]}}]",
        2.0,
    );
    let track = &recording.tracks[0];
    for frame in 1..recording.frame_count() {
        let [before, after] = [frame - 1, frame].map(|frame| track.positions_at(frame));
        // The first ring about the pinned end.
        for corner in 0..8 {
            let moved = before[corner].distance(after[corner]);
            assert!(moved < 0.03, "frame {frame}, corner {corner}: {moved} m");
        }
    }
}

#[test]
fn a_fixed_body_stands_still_where_it_was_put() {
    let recording = recording(
        "bodies: [{rigid: {fixed: true, position: [3, 0, 1], rotation: {axis: [0, 1, 0], degrees: 45}}}]",
        0.1,
    );
    let track = &recording.tracks[0];
    assert_eq!(track.motion, Motion::Still);
    let corner = Vec3::new(3.0, 0.0, 1.0) + Quat::from_rotation_y(45f32.to_radians()) * Vec3::splat(0.5);
    assert!(track.mesh.positions.iter().any(|p| p.distance(corner) < 1e-5));
}

#[test]
fn a_summary_counts_and_measures() {
    let summary = summary(
        "name: 'fall', settings: {damping: 0}, bodies: [{half_space: {offset: -100}}, {rigid: {mass: 2}}, {rope: {}}]",
        0.5,
    );
    assert_eq!((&*summary.scene, summary.bodies, summary.steps), ("fall", 2, 30));
    assert_eq!((summary.particles, summary.escaped, summary.nonfinite), (4 + 51, 0, 0));
    assert!((summary.seconds - 0.5).abs() < 1e-6 && summary.ms_per_step > 0.0);
    // ½ m (g t)², with the velocity in the middle of the last of 30 steps of 8 substeps.
    let speed = 9.81 * (0.5 - 0.25 / (30.0 * 8.0));
    assert!(
        (summary.kinetic_energy / (1.5 * speed * speed) - 1.0).abs() < 2e-3,
        "{}",
        summary.kinetic_energy
    );
}

#[test]
fn a_summary_is_json_with_the_names_users_rely_on() {
    let summary = serde_json::to_value(summary("bodies: [{rope: {}}]", 0.1)).unwrap();
    for name in [
        "ms_per_step",
        "escaped",
        "nonfinite",
        "max_penetration_mm",
        "mean_penetration_mm",
        "max_stick_strain",
        "mean_stick_strain",
        "kinetic_energy",
    ] {
        assert!(summary[name].is_number(), "{name}");
    }
    let hash = summary["state_hash"].as_str().unwrap();
    assert!(hash.len() == 16 && hash.bytes().all(|b| b.is_ascii_hexdigit()), "{hash}");
}

#[test]
fn bodies_behind_a_plane_or_outside_the_bounds_have_escaped() {
    let bodies = "bodies: [{rigid: {position: [0, 5, 0]}}, {rigid: {position: [9, 5, 0]}},
        {rigid: {position: [-9, 5, 0], fixed: true}}]";
    assert_eq!(summary(bodies, 0.01).escaped, 0);
    assert_eq!(summary(&format!("bounds: {{min: [-5, 0, -5], max: [5, 9, 5]}}, {bodies}"), 0.01).escaped, 1);
    // Pinned all over, so that the plane cannot push it out.
    let behind =
        "bodies: [{half_space: {normal: [1, 0, 0]}}, {cloth: {position: [-20, 0, 0], pins: ['corners'],
        surface: {grid: {columns: 2, rows: 2, width: 1, depth: 1}}}}]";
    assert_eq!(summary(behind, 0.01).escaped, 1);
}

#[test]
fn progress_is_told_of_every_step() {
    let mut told = Vec::new();
    let run = Run::new(build("bodies: []"), RunOptions { seconds: Some(0.1), record: false }).unwrap();
    let outcome = run.complete(&mut |done, total| told.push((done, total))).unwrap();
    assert_eq!(told, (1..=6).map(|done| (done, 6)).collect::<Vec<_>>());
    assert_eq!(outcome.recording, None);
}

#[test]
fn impossible_times_and_endless_recordings_are_refused() {
    for seconds in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e9] {
        let error =
            Run::new(build("bodies: []"), RunOptions { seconds: Some(seconds), record: true }).unwrap_err();
        assert!(matches!(&error, Error::Invalid(problems) if problems[0].path == "seconds"), "{error}");
    }
    let cloth = "record_every: 1, bodies: [{cloth: {surface: {grid: {columns: 100, rows: 100, width: 1, depth: 1}}}}]";
    let long = |record| Run::new(build(cloth), RunOptions { seconds: Some(1000.0), record });
    assert!(matches!(long(true), Err(Error::Invalid(problems)) if problems[0].path == "record_every"));
    assert_eq!(long(false).unwrap().step_count(), 60_000);
}

#[test]
fn a_recording_counts_the_corners_of_a_tube_and_not_the_particles_of_its_rope() {
    // 2 101 particles over 6 001 frames are 13 million positions; as a tube of 8 sides, 101 million.
    let rope =
        "record_every: 1, bodies: [{rope: {path: {line: {from: [0, 1, 0], to: [9, 1, 0], segments: 2100}}}}]";
    let error = Run::new(build(rope), RunOptions { seconds: Some(100.0), record: true }).unwrap_err();
    assert!(matches!(&error, Error::Invalid(problems) if problems[0].path == "record_every"), "{error}");
}

#[test]
fn the_camera_goes_along() {
    let outcome = run("camera: {eye: [1, 2, 3], target: [0, 1, 0], fov: 90}, bodies: [{rope: {}}]", 0.1);
    let camera = outcome.camera.unwrap();
    assert_eq!((camera.eye, camera.target), (Vec3::new(1.0, 2.0, 3.0), Vec3::Y));
    assert!((camera.vertical_fov - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    assert_eq!(run("bodies: [{rope: {}}]", 0.1).camera, None);
}
