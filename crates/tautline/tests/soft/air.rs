//! Cloth in the air.

use tautline::{BodyHandle, Cloth, ClothSolver, Error, HalfSpace, Quat, Settings, Vec3, World};

use super::{DT, center, positions, run, stretch, weightless};

const DENSITY: f32 = 1.2;

fn speed(world: &World, body: BodyHandle) -> Vec3 {
    world.body(body).unwrap().velocity()
}

/// Gives every particle a third of the mass of the triangles around it, so that air moves all of a flat sheet alike.
fn weigh_by_area(world: &mut World, sheet: BodyHandle, mass: f32) {
    let view = world.body(sheet).unwrap();
    let mut masses = vec![0.0; view.positions().len()];
    for triangle in view.triangles() {
        triangle
            .iter()
            .for_each(|&corner| masses[corner as usize] += mass / (3 * view.triangles().len()) as f32);
    }
    for (particle, mass) in (0..).zip(masses) {
        world.set_particle_mass(sheet, particle, mass).unwrap();
    }
}

/// m g = ½ ρ C A v².
#[test]
fn a_level_sheet_falls_at_its_terminal_speed() {
    for (mass, drag) in [(0.5, 1.2), (0.05, 0.7), (1e-4, 2.0)] {
        let mut world = World::new(Settings { sleep: None, ..Settings::default() }).unwrap();
        let sheet = world.add(Cloth::grid(12, 9, 1.5, 1.0).mass(mass).drag(drag)).unwrap();
        weigh_by_area(&mut world, sheet, mass);
        run(&mut world, 4.0);
        let expected = (2.0 * mass * 9.81 / (DENSITY * drag * 1.5)).sqrt();
        let fall = speed(&world, sheet);
        // Gravity has acted for a small step more than the air.
        let late = 0.5 * 9.81 / 1920.0;
        assert!(
            (fall.y + expected).abs() < 0.01 * expected + 1.1 * late,
            "{mass} kg: {fall}, not {expected} m/s"
        );
    }
}

/// Wind U takes a free sheet along with k (U − v)² = v', so that v = U − 1/(1/U + k t).
#[test]
fn wind_takes_a_sheet_along_and_no_faster() {
    let mut world = World::new(Settings { wind: Vec3::Y * 8.0, ..weightless() }).unwrap();
    let sheet = Cloth::grid(8, 8, 1.0, 1.0).mass(0.4).drag(1.2);
    let sheet = world.add(sheet).unwrap();
    weigh_by_area(&mut world, sheet, 0.4);
    for _ in 0..60 {
        run(&mut world, 2.0 * DT);
        let k = 0.5 * DENSITY * 1.2 / 0.4;
        let expected = 8.0 - 1.0 / (1.0 / 8.0 + k * world.time() as f32);
        let found = speed(&world, sheet);
        assert!((found.y - expected).abs() < 0.02 * expected, "{found} instead of {expected}");
        assert!(found.x.abs() + found.z.abs() < 1e-3);
    }
}

/// Air does not give energy: not to what moves in air at rest, neither by drag nor by lift.
#[test]
fn still_air_only_takes_energy() {
    let mut world = World::new(weightless()).unwrap();
    let sheet = Cloth::grid(10, 10, 1.0, 1.0).drag(0.3).lift(1.5).rotation(Quat::from_rotation_x(0.9));
    let sheet = world.add(sheet.velocity(Vec3::new(1.0, -6.0, 2.0)).mass(0.1)).unwrap();
    let mut energy = world.kinetic_energy();
    for _ in 0..120 {
        run(&mut world, DT);
        assert!(world.kinetic_energy() <= energy * 1.0001, "{} after {energy} J", world.kinetic_energy());
        energy = world.kinetic_energy();
    }
    assert!(speed(&world, sheet).length() < 3.0);
}

#[test]
fn lift_carries_a_sheet_across_the_wind() {
    let lifted = |lift: f32| {
        let mut world = World::new(Settings { wind: Vec3::X * 6.0, ..weightless() }).unwrap();
        let sheet = Cloth::grid(6, 6, 1.0, 1.0).rotation(Quat::from_rotation_z(-0.6)).drag(0.3).lift(lift);
        let sheet = world.add(sheet).unwrap();
        run(&mut world, 0.2);
        speed(&world, sheet).y
    };
    assert!(lifted(0.0).abs() < 0.01, "{}", lifted(0.0));
    assert!(lifted(1.0).abs() > 0.1, "{}", lifted(1.0));
}

#[test]
fn a_flag_streams_in_the_wind_and_hangs_without() {
    let mut world = World::new(Settings::default()).unwrap();
    let upright = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    let mut flag = Cloth::grid(24, 16, 1.2, 0.8).rotation(upright).mass(0.1).drag(0.4).lift(0.6);
    for row in 0..16 {
        flag = flag.pin(row * 24);
    }
    let flag = world.add(flag).unwrap();
    world.set_wind(Vec3::new(12.0, 0.0, 2.0)).unwrap();
    let mut mean = Vec3::ZERO;
    for frame in 0..240 {
        run(&mut world, DT);
        mean += if frame < 120 { Vec3::ZERO } else { center(&world, flag) / 120.0 };
        assert!(positions(&world, flag).iter().all(|at| at.length() < 2.0));
        assert!(stretch(&world, flag) < 0.1, "{}", stretch(&world, flag));
    }
    assert!(mean.x > -0.1 && mean.y > -0.2, "it streams: {mean}");
    world.set_wind(Vec3::ZERO).unwrap();
    run(&mut world, 4.0);
    let hung = center(&world, flag);
    assert!(hung.x < mean.x - 0.1 && hung.y < mean.y - 0.05, "it hangs at {hung}, after {mean}");
}

#[test]
fn a_gust_wakes_what_it_acts_on() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let [in_air, other] = [Some(1.0), None].map(|drag| {
        let sheet =
            Cloth::grid(6, 6, 0.5, 0.5).position(Vec3::new(if drag.is_some() { 2.0 } else { 0.0 }, 0.1, 0.0));
        world.add(drag.map_or(sheet.clone(), |drag| sheet.drag(drag))).unwrap()
    });
    run(&mut world, 4.0);
    let asleep = |world: &World| [in_air, other].map(|body| world.body(body).unwrap().is_asleep());
    assert_eq!(asleep(&world), [true, true]);
    world.set_wind(Vec3::Y * 20.0).unwrap();
    assert_eq!(asleep(&world), [false, true]);
    run(&mut world, 0.5);
    assert!(center(&world, in_air).y > 0.5);
}

#[test]
fn what_is_wrong_with_air_is_refused_by_name() {
    let field = |error: Error| match error {
        Error::OutOfRange { field, .. } | Error::Invalid { field, .. } => field,
        other => other.to_string(),
    };
    let mut world = World::new(Settings::default()).unwrap();
    let sheet = || Cloth::grid(3, 3, 1.0, 1.0);
    for wrong in [-1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(field(world.add(sheet().drag(wrong)).unwrap_err()), "drag");
        assert_eq!(field(world.add(sheet().lift(wrong)).unwrap_err()), "lift");
        let settings = Settings { air_density: wrong, ..Settings::default() };
        assert_eq!(field(World::new(settings).unwrap_err()), "settings.air_density");
    }
    assert_eq!(field(world.set_wind(Vec3::new(0.0, f32::NAN, 0.0)).unwrap_err()), "wind.y");
    let wind = Vec3::new(0.0, 0.0, f32::INFINITY);
    let wrong = World::new(Settings { wind, ..Settings::default() }).unwrap_err();
    assert_eq!(field(wrong), "settings.wind.z");
    let paper = Settings { cloth: ClothSolver::Paper, ..Settings::default() };
    assert_eq!(field(World::new(paper.clone()).unwrap().add(sheet().drag(1.0)).unwrap_err()), "drag");
    world.add(sheet().drag(1.0)).unwrap();
    assert_eq!(field(world.set_settings(paper).unwrap_err()), "drag");
}
