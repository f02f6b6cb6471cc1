//! Scenes that change while they run.

use tautline_scene::document::{
    Body, BodyRef, Cloth, HalfSpace, Joint, JointKind, Rigid, Room, Scene, Settings,
};
use tautline_scene::live::LiveScene;
use tautline_scene::{Error, registry};

fn ball(name: &str) -> Body {
    Body::Rigid(Rigid { name: Some(name.to_owned()), position: [0.0, 3.0, 0.0], ..Rigid::default() })
}

fn steps(scene: &mut LiveScene, count: u32) -> u64 {
    for _ in 0..count {
        scene.step(scene.dt(), &mut || 0.0).expect("the document's step");
    }
    scene.world().state_hash()
}

fn problems(result: Result<impl std::fmt::Debug, Error>) -> Vec<String> {
    match result {
        Err(Error::Invalid(problems)) => problems.into_iter().map(|problem| problem.path).collect(),
        other => panic!("{other:?} is no list of problems"),
    }
}

#[test]
fn every_named_scene_moves_as_its_run_does() {
    for named in registry::scenes() {
        let document = named.document(&named.defaults());
        let mut built = document.build().expect("named scenes are right");
        let mut live = LiveScene::new(document).expect("named scenes are right");
        for _ in 0..3 {
            built.follow_cues().expect("its bodies are there");
            built.world.step(built.dt).expect("the document's step");
        }
        assert_eq!(steps(&mut live, 3), built.world.state_hash(), "{}", named.name);
    }
}

#[test]
fn numbers_are_of_bodies_in_their_order_and_not_used_again() {
    let document = Scene { bodies: vec![Body::Room(Room::default()), ball("a")], ..Scene::default() };
    let mut scene = LiveScene::new(document).expect("it is right");
    let numbers: Vec<_> = scene.world().bodies().map(|body| scene.bodies().number(body)).collect();
    assert_eq!(numbers, (0..7).map(Some).collect::<Vec<_>>());
    let added = scene.add(ball("b")).expect("it is right");
    assert_eq!(added, 7);
    scene.remove(added).expect("it is there");
    // Its handle stays known, since a snapshot may bring it back.
    let handle = scene.bodies().handle(added).expect("it was given");
    assert!(scene.remove(added).is_err() && scene.world().body(handle).is_err());
    assert_eq!(scene.add(ball("b")).expect("the name is free again"), 8);
    scene.reset().expect("it could be built before");
    assert!(scene.bodies().handle(8).is_err(), "what was added is gone");
    assert!(scene.bodies().handle(6).is_ok(), "the document's own is not");
    assert_eq!(scene.add(ball("b")).expect("it is right"), 9);
}

#[test]
fn bodies_are_judged_as_those_of_documents() {
    let mut scene =
        LiveScene::new(Scene { bodies: vec![ball("a")], ..Scene::default() }).expect("it is right");
    let wrong = Rigid { mass: Some(-1.0), friction: f32::NAN, ..Rigid::default() };
    assert_eq!(problems(scene.add(Body::Rigid(wrong))), ["rigid.mass", "rigid.friction"]);
    assert_eq!(problems(scene.add(ball("a"))), ["rigid.name"]);
    assert_eq!(scene.world().bodies().len(), 1);
    let paper = Settings { solver: tautline_scene::document::Solver::Paper, ..Settings::default() };
    assert_eq!(problems(scene.set_settings(paper)), ["settings.solver"]);
}

#[test]
fn joints_name_bodies_by_number_or_name() {
    let document = Scene { bodies: vec![Body::Room(Room::default()), ball("a")], ..Scene::default() };
    let mut scene = LiveScene::new(document).expect("it is right");
    let other =
        scene.add(Body::Rigid(Rigid { position: [1.5, 3.0, 0.0], ..Rigid::default() })).expect("it is right");
    let joint = |body: u32| Joint {
        body: BodyRef::Index(body),
        base: Some(BodyRef::Name("a".to_owned())),
        kind: JointKind::Fixed {},
        anchor: None,
        base_anchor: None,
        compliance: 0.0,
        angular_compliance: None,
        break_force: None,
        break_torque: None,
        collide_connected: false,
    };
    let number = scene.add_joint(&joint(other)).expect("both are rigid");
    let handle = scene.joints().handle(number).expect("it is there");
    assert_eq!(scene.bodies().number(scene.world().joint(handle).expect("it is there").body()), Some(other));
    assert!(scene.add_joint(&joint(0)).is_err(), "a wall of a room cannot be held");
    scene.remove(other).expect("it is there");
    assert!(scene.remove_joint(number).is_err(), "its joint went with it");
}

#[test]
fn a_snapshot_goes_on_with_the_same_bits_and_names() {
    let named = registry::find("hammock").expect("it is named");
    let mut scene = LiveScene::new(named.document(&named.defaults())).expect("it is right");
    steps(&mut scene, 5);
    let added = scene.add(ball("late")).expect("it is right");
    let snapshot = scene.world().snapshot();
    let end = steps(&mut scene, 5);
    scene.remove(added).expect("it is there");
    scene.restore(&snapshot).expect("it is a snapshot");
    let body = scene.bodies().handle(added).expect("it is back");
    assert_eq!(scene.part(body).map(|part| part.name.as_str()), Some("late"));
    assert_eq!(steps(&mut scene, 5), end);
    assert!(scene.restore(&snapshot[..50]).is_err());
    assert_eq!(scene.world().state_hash(), end, "nothing has changed");
}

#[test]
fn a_snapshot_of_another_scene_is_drawn_as_what_it_is() {
    let cloth = Scene { bodies: vec![Body::Cloth(Cloth::default()), ball("a")], ..Scene::default() };
    let other = LiveScene::new(cloth).expect("it is right");
    let floor = Scene { bodies: vec![Body::HalfSpace(HalfSpace::default())], ..Scene::default() };
    let mut scene = LiveScene::new(floor).expect("it is right");
    scene.restore(&other.world().snapshot()).expect("it is a snapshot");
    let glb = scene.glb().expect("all of it can be drawn");
    assert_eq!(&glb[..4], b"glTF");
}

#[test]
fn a_recording_has_what_came_and_keeps_what_went() {
    let mut scene =
        LiveScene::new(Scene { bodies: vec![ball("a")], ..Scene::default() }).expect("it is right");
    scene.start_recording().expect("all of it can be drawn");
    steps(&mut scene, 3);
    let added = scene.add(Body::Cloth(Cloth::default())).expect("it is right");
    steps(&mut scene, 2);
    scene.remove(added).expect("it is there");
    steps(&mut scene, 2);
    assert_eq!(scene.recorded_frames(), Some(8));
    let glb = scene.glb().expect("frames of all tracks are as many");
    assert_eq!(&glb[..4], b"glTF");
}
