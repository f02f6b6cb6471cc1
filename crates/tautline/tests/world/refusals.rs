//! Wrong numbers and stale handles: each is refused by the name of its field, and nothing changes.

use tautline::mesh::TriMesh;
use tautline::{
    BodyHandle, Cloth, Error, HalfSpace, MeshDefect, Quat, Relaxation, Rope, Settings, Sleep, Truss,
    TrussBody, Vec3, World,
};

use crate::{cube, mixed_scene, run};

const NOT_NUMBERS: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

fn field(error: &Error) -> &str {
    match error {
        Error::OutOfRange { field, .. } | Error::Invalid { field, .. } => field,
        Error::Mesh(_) => "mesh",
        _ => "",
    }
}

/// Calls `act` with every value and checks that it is refused by `name` and the world is as it was.
fn refused<T: Copy + std::fmt::Debug, R>(
    world: &mut World,
    name: &str,
    values: &[T],
    act: impl Fn(&mut World, T) -> Result<R, Error>,
) {
    let before = world.snapshot();
    for &value in values {
        match act(world, value) {
            Err(error) => assert_eq!(field(&error), name, "{value:?}: {error}"),
            Ok(_) => panic!("{name} = {value:?} was not refused"),
        }
        assert!(world.snapshot() == before, "{name} = {value:?} changed the world");
    }
}

fn with(bad: &[f32]) -> Vec<f32> {
    [&NOT_NUMBERS, bad].concat()
}

/// `name`.x, .y and .z in turn.
fn vector_refused<R>(
    world: &mut World,
    name: &str,
    bad: &[f32],
    act: impl Fn(&mut World, Vec3) -> Result<R, Error>,
) {
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let values: Vec<Vec3> = with(bad)
            .into_iter()
            .map(|value| {
                let mut vector = Vec3::ONE;
                vector[axis] = value;
                vector
            })
            .collect();
        refused(world, &format!("{name}.{letter}"), &values, &act);
    }
}

#[test]
fn wrong_builder_fields_are_refused() {
    let mut world = mixed_scene(Settings::default());
    let w = &mut world;
    let shape = cube(0.5);
    let body = || TrussBody::new(&shape);
    let cloth = || Cloth::grid(3, 3, 1.0, 1.0);
    let rope = || Rope::straight(Vec3::ZERO, Vec3::X, 4);
    let far = [1.1e9, -f32::MAX];
    vector_refused(w, "position", &far, |w, x| w.add(body().position(x)));
    vector_refused(w, "velocity", &far, |w, x| w.add(body().velocity(x)));
    vector_refused(w, "angular_velocity", &far, |w, x| w.add(body().angular_velocity(x)));
    vector_refused(w, "position", &far, |w, x| w.add(cloth().position(x)));
    vector_refused(w, "velocity", &far, |w, x| w.add(cloth().velocity(x)));
    vector_refused(w, "velocity", &far, |w, x| w.add(rope().velocity(x)));
    vector_refused(w, "points[0]", &far, |w, x| w.add(Rope::through(vec![x, Vec3::ZERO])));
    vector_refused(w, "points[1]", &far, |w, x| w.add(Rope::through(vec![Vec3::ZERO, x])));
    vector_refused(w, "normal", &far, |w, x| w.add(HalfSpace::new(x, 0.0)));
    let mass = with(&[0.0, -0.0, -1.0, 1e-35, 1e33]);
    refused(w, "mass", &mass, |w, m| w.add(body().mass(m)));
    refused(w, "mass", &mass, |w, m| w.add(cloth().mass(m)));
    refused(w, "mass", &mass, |w, m| w.add(rope().mass(m)));
    let friction = with(&[-0.1, 1e7]);
    refused(w, "friction", &friction, |w, f| w.add(body().friction(f)));
    refused(w, "friction", &friction, |w, f| w.add(cloth().friction(f)));
    refused(w, "friction", &friction, |w, f| w.add(rope().friction(f)));
    refused(w, "friction", &friction, |w, f| w.add(HalfSpace::floor(0.0).friction(f)));
    refused(w, "offset", &with(&[2e9]), |w, y| w.add(HalfSpace::floor(y)));
    refused(w, "thickness", &with(&[-0.1, 1e7]), |w, t| w.add(cloth().thickness(t)));
    refused(w, "bending_compliance", &with(&[-1.0, 1e13]), |w, c| w.add(cloth().bending(c)));
    refused(w, "bending_compliance", &with(&[-1.0, 1e13]), |w, c| w.add(rope().bending(c)));
    refused(w, "least_angle", &with(&[-0.1, 3.2]), |w, a| w.add(rope().bend_limit(a)));
    refused(w, "radius", &with(&[0.0, -1.0, 1e10]), |w, r| w.add(rope().radius(r)));
    refused(w, "length", &with(&[0.0, -1.0, 1e10]), |w, l| w.add(rope().length(l)));
    refused(w, "width", &with(&[0.0, -1.0]), |w, x| w.add(Cloth::grid(3, 3, x, 1.0)));
    refused(w, "depth", &with(&[0.0, -1.0]), |w, x| w.add(Cloth::grid(3, 3, 1.0, x)));
    refused(w, "columns", &[0, 1, 5000, u32::MAX], |w, n| w.add(Cloth::grid(n, 3, 1.0, 1.0)));
    refused(w, "rows", &[0, 1, 5000, u32::MAX], |w, n| w.add(Cloth::grid(3, n, 1.0, 1.0)));
    refused(w, "points", &[0, u32::MAX], |w, n| w.add(Rope::straight(Vec3::ZERO, Vec3::X, n)));
    refused(w, "pins", &[9, u32::MAX], |w, pin| w.add(cloth().pin(pin)));
    refused(w, "pins", &[5, u32::MAX], |w, pin| w.add(rope().pin(pin)));
    let turns = with(&[0.0, 1e-4, 1e4]).into_iter().map(|x| Quat::from_xyzw(0.0, x, 0.0, 0.0));
    let turns: Vec<Quat> = turns.collect();
    refused(w, "rotation", &turns, |w, q| w.add(body().rotation(q)));
    refused(w, "rotation", &turns, |w, q| w.add(cloth().rotation(q)));
    refused(w, "normal", &[Vec3::ZERO], |w, n| w.add(HalfSpace::new(n, 0.0)));
    run(w, 2);
}

#[test]
fn degenerate_shapes_are_refused() {
    let mut world = World::new(Settings::default()).unwrap();
    let w = &mut world;
    assert_eq!(Truss::from_mesh(&TriMesh::default()), Err(Error::Mesh(MeshDefect::Empty)));
    refused(w, "mesh", &[()], |w, ()| w.add(Cloth::from_mesh(TriMesh::default())));
    refused(w, "mesh", &[()], |w, ()| w.add(TrussBody::new(&std::sync::Arc::default())));
    refused(w, "points", &[()], |w, ()| w.add(Rope::through(Vec::new())));
    refused(w, "points[1]", &[()], |w, ()| w.add(Rope::through(vec![Vec3::ONE, Vec3::ONE])));
    let index = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Z], triangles: vec![[0, 1, 3]] };
    refused(w, "mesh", &[()], |w, ()| w.add(Cloth::from_mesh(index.clone())));
    for value in NOT_NUMBERS {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::new(0.0, value, 1.0)];
        let mesh = TriMesh { positions, triangles: vec![[0, 1, 2]] };
        refused(w, "mesh", &[()], |w, ()| w.add(Cloth::from_mesh(mesh.clone())));
    }
}

/// Distances that f32 rounds to 0 or infinity are no lengths for sticks.
#[test]
fn lengths_beyond_f32_are_refused_or_harmless() {
    let mut world = World::new(Settings::default()).unwrap();
    let tiny = Vec3::X * 1e-25;
    refused(&mut world, "points[1]", &[()], |w, ()| w.add(Rope::through(vec![Vec3::ZERO, tiny])));
    for size in [1e-25f32, 1e-12, 1e12, 1e25, 1e38] {
        let _ = world.add(Cloth::grid(3, 3, size, size));
        let mesh = TriMesh {
            positions: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|x| x * size).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        };
        if let Ok(shape) = Truss::from_mesh(&mesh) {
            let _ = world.add(TrussBody::new(&std::sync::Arc::new(shape)));
        }
        let _ = world.add(Cloth::from_mesh(mesh));
        let _ = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 2).length(size));
    }
    for normal in [1e-22f32, 1e-20, 1e9] {
        let wall = world.add(HalfSpace::new(Vec3::Y * normal, -5.0)).unwrap();
        assert_eq!(world.body(wall).unwrap().plane(), Some((Vec3::Y, -5.0)), "normal of {normal}");
    }
    World::restore(&world.snapshot()).expect("what was accepted can be restored");
    run(&mut world, 10);
    assert!(world.positions().iter().all(|x| x.is_finite()));
    World::restore(&world.snapshot()).expect("and still can after some steps");
}

#[test]
fn wrong_settings_are_refused() {
    let mut world = mixed_scene(Settings::default());
    let w = &mut world;
    let base = Settings::default();
    let set = |w: &mut World, settings: Settings| {
        let refused = w.set_settings(settings.clone());
        let message = |result: Result<(), Error>| result.map_err(|error| error.to_string());
        assert_eq!(message(World::new(settings).map(|_| ())), message(refused.clone()));
        refused
    };
    vector_refused(w, "settings.gravity", &[2e6], |w, gravity| set(w, Settings { gravity, ..base.clone() }));
    refused(w, "settings.substeps", &[0, 1001, u32::MAX], |w, substeps| {
        set(w, Settings { substeps, ..base.clone() })
    });
    refused(w, "settings.features_per_pair", &[0, 17, u32::MAX], |w, features_per_pair| {
        set(w, Settings { features_per_pair, ..base.clone() })
    });
    refused(w, "settings.relaxation.sweeps", &[0, 10_001], |w, sweeps| {
        set(w, Settings { relaxation: Relaxation { sweeps, ..base.relaxation }, ..base.clone() })
    });
    refused(w, "settings.relaxation.tolerance", &with(&[-0.01, 0.51]), |w, tolerance| {
        set(w, Settings { relaxation: Relaxation { tolerance, ..base.relaxation }, ..base.clone() })
    });
    refused(w, "settings.damping", &with(&[-1.0, 1e7]), |w, damping| {
        set(w, Settings { damping, ..base.clone() })
    });
    refused(w, "settings.separation_speed", &with(&[0.0, -1.0]), |w, speed| {
        set(w, Settings { separation_speed: Some(speed), ..base.clone() })
    });
    refused(w, "settings.sleep.speed", &with(&[0.0, -1.0]), |w, speed| {
        set(w, Settings { sleep: Some(Sleep { speed, seconds: 0.5 }), ..base.clone() })
    });
    refused(w, "settings.sleep.seconds", &with(&[0.0, -1.0]), |w, seconds| {
        set(w, Settings { sleep: Some(Sleep { speed: 0.1, seconds }), ..base.clone() })
    });
}

#[test]
fn wrong_calls_are_refused() {
    let mut world = mixed_scene(Settings::default());
    let handles: Vec<BodyHandle> = world.bodies().collect();
    let (floor, body) = (handles[0], handles[1]);
    run(&mut world, 3);
    let w = &mut world;
    let far = [1.1e9];
    vector_refused(w, "velocity", &far, |w, x| w.set_velocity(body, x));
    vector_refused(w, "force", &far, |w, x| w.apply_force(body, x));
    vector_refused(w, "force", &far, |w, x| w.apply_force_at(body, 0, x));
    vector_refused(w, "position", &far, |w, x| w.set_particle_position(body, 0, x));
    vector_refused(w, "velocity", &far, |w, x| w.set_particle_velocity(body, 0, x));
    refused(w, "velocities", &[7, 9], |w, n| w.set_particle_velocities(body, &vec![Vec3::X; n]));
    refused(w, "mass", &with(&[0.0, -1.0, 1e-31, 1e31]), |w, m| w.set_particle_mass(body, 0, m));
    refused(w, "dt", &with(&[0.0, -0.0, -DT, 1e-8, 1.001, 1e9]), |w, dt| w.step(dt));
    const DT: f32 = crate::DT;
    for (owner, wrong) in [(body, 8), (body, u32::MAX), (floor, 0)] {
        refused(w, "particle", &[wrong], |w, i| w.pin(owner, i));
        refused(w, "particle", &[wrong], |w, i| w.unpin(owner, i));
        refused(w, "particle", &[wrong], |w, i| w.apply_force_at(owner, i, Vec3::X));
        refused(w, "particle", &[wrong], |w, i| w.set_particle_position(owner, i, Vec3::X));
        refused(w, "particle", &[wrong], |w, i| w.set_particle_velocity(owner, i, Vec3::X));
        refused(w, "particle", &[wrong], |w, i| w.set_particle_mass(owner, i, 1.0));
    }
}

#[test]
fn stale_handles_are_refused_by_every_call() {
    let mut world = mixed_scene(Settings::default());
    let stale = world.bodies().nth(2).unwrap();
    world.remove(stale).unwrap();
    world.add(HalfSpace::floor(-1.0)).unwrap(); // in the same slot
    let before = world.snapshot();
    let calls = [
        world.remove(stale),
        world.body(stale).map(|_| ()),
        world.set_velocity(stale, Vec3::X),
        world.apply_force(stale, Vec3::X),
        world.apply_force_at(stale, 0, Vec3::X),
        world.pin(stale, 0),
        world.unpin(stale, 0),
        world.set_particle_position(stale, 0, Vec3::X),
        world.set_particle_velocity(stale, 0, Vec3::X),
        world.set_particle_velocities(stale, &[]),
        world.set_particle_mass(stale, 0, 1.0),
        world.wake(stale),
    ];
    assert!(calls.iter().all(|call| *call == Err(Error::StaleHandle)), "{calls:?}");
    assert!(world.snapshot() == before);
}
