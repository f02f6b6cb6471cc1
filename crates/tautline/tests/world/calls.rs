//! Random sequences of calls: whatever the order, the world stays whole.

use proptest::prelude::*;
use tautline::{BodyHandle, Cloth, HalfSpace, Rope, Settings, TrussBody, Vec3, World};

use crate::{DT, cube, icosahedron};

#[derive(Debug, Clone)]
enum Call {
    AddTruss { position: Vec3, velocity: Vec3, round: bool, fixed: bool },
    AddCloth { position: Vec3 },
    AddRope { start: Vec3, end: Vec3 },
    AddWall { normal: Vec3 },
    Remove(usize),
    Step(f32),
    Pin(usize, u32),
    Unpin(usize, u32),
    Force(usize, Vec3),
    Place(usize, u32, Vec3),
    Mass(usize, u32, f32),
    Velocity(usize, Vec3),
    Settings(bool),
    Restore,
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-size..size).prop_map(Vec3::from)
}

fn call() -> impl Strategy<Value = Call> {
    let particle = || (0usize..8, 0u32..30);
    prop_oneof![
        4 => (vector(1.5), vector(9.0), any::<bool>(), prop::bool::weighted(0.2)).prop_map(
            |(position, velocity, round, fixed)| Call::AddTruss { position, velocity, round, fixed }
        ),
        1 => vector(1.5).prop_map(|position| Call::AddCloth { position }),
        1 => (vector(1.5), vector(1.5)).prop_map(|(start, end)| Call::AddRope { start, end }),
        1 => vector(1.0).prop_map(|normal| Call::AddWall { normal }),
        2 => (0usize..8).prop_map(Call::Remove),
        12 => prop_oneof![Just(DT), 1e-4f32..0.1].prop_map(Call::Step),
        1 => particle().prop_map(|(body, i)| Call::Pin(body, i)),
        1 => particle().prop_map(|(body, i)| Call::Unpin(body, i)),
        1 => (0usize..8, vector(1e4)).prop_map(|(body, force)| Call::Force(body, force)),
        1 => (particle(), vector(2.0)).prop_map(|((body, i), x)| Call::Place(body, i, x)),
        1 => (particle(), 1e-3f32..1e3).prop_map(|((body, i), m)| Call::Mass(body, i, m)),
        1 => (0usize..8, vector(20.0)).prop_map(|(body, v)| Call::Velocity(body, v)),
        1 => any::<bool>().prop_map(Call::Settings),
        1 => Just(Call::Restore),
    ]
}

/// Makes the call; one that is refused must leave no trace.
fn make(world: &mut World, alive: &mut Vec<BodyHandle>, removed: &mut Vec<BodyHandle>, call: &Call) {
    let before = world.snapshot();
    let pick = |k: usize| alive.get(k % alive.len().max(1)).or(removed.first()).copied();
    let done = match call.clone() {
        Call::AddTruss { position, velocity, round, fixed } => {
            let shape = if round { icosahedron(0.3) } else { cube(0.5) };
            let body = TrussBody::new(&shape).position(position).velocity(velocity);
            world.add(if fixed { body.fixed() } else { body }).map(|body| alive.push(body))
        }
        Call::AddCloth { position } => {
            world.add(Cloth::grid(4, 4, 0.8, 0.8).position(position)).map(|body| alive.push(body))
        }
        Call::AddRope { start, end } => {
            world.add(Rope::straight(start, end, 6).self_collision(true)).map(|body| alive.push(body))
        }
        Call::AddWall { normal } => world.add(HalfSpace::new(normal, -1.5)).map(|body| alive.push(body)),
        Call::Remove(k) => pick(k).map_or(Ok(()), |body| {
            world.remove(body).map(|()| {
                alive.retain(|&other| other != body);
                removed.push(body);
            })
        }),
        Call::Step(dt) => world.step(dt).map(|_| ()),
        Call::Pin(k, i) => pick(k).map_or(Ok(()), |body| world.pin(body, i)),
        Call::Unpin(k, i) => pick(k).map_or(Ok(()), |body| world.unpin(body, i)),
        Call::Force(k, force) => pick(k).map_or(Ok(()), |body| world.apply_force(body, force)),
        Call::Place(k, i, x) => pick(k).map_or(Ok(()), |body| world.set_particle_position(body, i, x)),
        Call::Mass(k, i, mass) => pick(k).map_or(Ok(()), |body| world.set_particle_mass(body, i, mass)),
        Call::Velocity(k, v) => pick(k).map_or(Ok(()), |body| world.set_velocity(body, v)),
        Call::Settings(paper) => {
            world.set_settings(if paper { Settings::paper() } else { Settings::default() })
        }
        Call::Restore => World::restore(&before).map(|restored| *world = restored),
    };
    if done.is_err() {
        assert!(world.snapshot() == before, "refused, but not without a trace: {call:?}");
    }
}

fn check(world: &World, alive: &[BodyHandle], removed: &[BodyHandle]) {
    assert_eq!(world.bodies().collect::<Vec<_>>(), alive);
    assert!(removed.iter().all(|&body| world.body(body).is_err()));
    let mut particles = 0;
    for &body in alive {
        let view = world.body(body).unwrap();
        particles += view.positions().len();
        assert!(view.positions().iter().all(|x| x.is_finite()) && view.velocity().is_finite());
        assert!(view.inverse_masses().iter().all(|w| w.is_finite() && *w >= 0.0));
        assert!(view.sticks().iter().all(|s| (s.a.max(s.b) as usize) < view.positions().len()));
    }
    assert_eq!(particles, world.positions().len());
    assert!(world.kinetic_energy().is_finite() && world.momentum().is_finite());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]
    #[test]
    fn any_sequence_of_calls_leaves_the_world_whole(calls in prop::collection::vec(call(), 1..60)) {
        let mut world = World::new(Settings::default()).unwrap();
        let (mut alive, mut removed) = (Vec::new(), Vec::new());
        for call in &calls {
            make(&mut world, &mut alive, &mut removed, call);
            check(&world, &alive, &removed);
        }
    }
}
