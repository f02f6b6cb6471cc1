//! Soft solids that are drawn finer than they are simulated.

use tautline_scene::document::{Body, Scene, Shape, SoftSolid};
use tautline_scene::recording::Motion;
use tautline_scene::run::{Run, RunOptions};

fn ball(coarse_triangles: Option<u32>) -> Scene {
    let shape = Shape::Icosphere { radius: 0.5, subdivisions: 3 };
    let solid = SoftSolid { shape, coarse_triangles, position: [0.0, 2.0, 0.0], ..SoftSolid::default() };
    Scene { bodies: vec![Body::SoftSolid(solid)], ..Scene::default() }
}

#[test]
fn the_fine_surface_falls_with_the_coarse_one() {
    let built = ball(Some(100)).build().unwrap();
    let particles = built.world.positions().len();
    assert!(particles < 80, "{particles} particles");
    let options = RunOptions { seconds: Some(0.5), record: true };
    let done = Run::new(built, options).unwrap().complete(&mut |_, _| ()).unwrap();
    let track = &done.recording.unwrap().tracks[0];
    assert_eq!((track.mesh.positions.len(), track.mesh.triangles.len()), (642, 1280));
    let Motion::Deforming(frames) = &track.motion else { panic!("it is soft") };
    let last = frames.last().unwrap();
    let fallen = 0.5 * 9.81 * 0.25;
    for (end, start) in last.iter().zip(&track.mesh.positions) {
        assert!((start.y - end.y - fallen).abs() < 0.05, "{start} fell to {end}");
        assert!((start.distance(tautline::Vec3::Y * 2.0) - 0.5).abs() < 1e-4, "{start} is on the ball");
    }
}

#[test]
fn what_makes_no_sense_is_refused_by_its_path() {
    let refusal = |change: fn(&mut SoftSolid)| {
        let mut scene = ball(Some(100));
        let Body::SoftSolid(solid) = &mut scene.bodies[0] else { panic!() };
        change(solid);
        scene.build().unwrap_err().to_string()
    };
    let text = refusal(|solid| solid.coarse_triangles = Some(3));
    assert!(text.contains("bodies[0].soft_solid.coarse_triangles"), "{text}");
    let text = refusal(|solid| solid.shape = Shape::Box { size: [1.0; 3] });
    assert!(text.contains("bodies[0].soft_solid.coarse_triangles: a box is divided in cells"), "{text}");
}
