//! Bodies that fall, fly, swing, slide and rest, against closed forms.

use tautline::mesh::primitives;
use tautline::{BodyHandle, ClothSolver, HalfSpace, Relaxation, Rope, Settings, TrussBody, Vec3, World};

use crate::{DT, cube, icosahedron, run, truss, weightless};

const G: f64 = 9.81;

fn sleepless(settings: Settings) -> Settings {
    Settings { sleep: None, ..settings }
}

fn center(world: &World, body: BodyHandle) -> Vec3 {
    world.body(body).unwrap().center_of_mass()
}

/// y = y₀ − ½ g t²: Verlet is exact for constant acceleration.
#[test]
fn free_fall_is_exact_with_any_number_of_substeps() {
    for (origin, tolerance) in [(Vec3::ZERO, 1e-4), (Vec3::new(1000.0, 0.0, -1000.0), 5e-3)] {
        for substeps in [1, 8, 32] {
            let settings = Settings { substeps, ..sleepless(Settings::default()) };
            let mut world = World::new(settings).unwrap();
            let body = world.add(TrussBody::new(&icosahedron(0.5)).position(origin)).unwrap();
            run(&mut world, 120);
            let expected = -0.5 * G * world.time() * world.time();
            let error = (f64::from(center(&world, body).y) - expected).abs();
            assert!(error < tolerance, "{error} m after {} s, {substeps} substeps, {origin}", world.time());
            assert!((center(&world, body) - origin).with_y(0.0).length() < tolerance as f32);
        }
    }
}

/// x = v_x t, y = v_y t − ½ g t², with the centre of mass of a spinning body.
#[test]
fn a_spinning_projectile_follows_its_parabola() {
    let mut world = World::new(sleepless(Settings::default())).unwrap();
    let velocity = Vec3::new(3.0, 8.0, -2.0);
    let body = TrussBody::new(&cube(0.5)).velocity(velocity).angular_velocity(Vec3::new(2.0, 5.0, -1.0));
    let body = world.add(body).unwrap();
    run(&mut world, 90);
    let t = world.time();
    let expected = velocity.as_dvec3() * t + tautline::DVec3::Y * (-0.5 * G * t * t);
    let error = (center(&world, body).as_dvec3() - expected).length();
    assert!(error < 2e-4, "{error} m");
}

/// Constant acceleration stays exact when the step changes (time-corrected Verlet).
#[test]
fn a_changing_step_does_not_change_the_fall() {
    let mut world = World::new(sleepless(Settings::default())).unwrap();
    let body = world.add(TrussBody::new(&cube(0.5)).velocity(Vec3::X)).unwrap();
    for step in 0..150u32 {
        world.step([0.004, 0.02, 0.0111, 0.0005][step as usize % 4]).unwrap();
    }
    let t = world.time();
    let fallen = f64::from(center(&world, body).y) + 0.5 * G * t * t;
    assert!(fallen.abs() < 1e-4 && (f64::from(center(&world, body).x) - t).abs() < 1e-4, "{fallen}");
}

/// v after n substeps is v₀ (1 + c h)⁻ⁿ, and the way Σ v h.
#[test]
fn damping_follows_its_law() {
    let settings = Settings { damping: 1.5, substeps: 4, ..weightless() };
    let mut world = World::new(settings).unwrap();
    let body = world.add(TrussBody::new(&cube(0.5)).velocity(Vec3::X * 2.0)).unwrap();
    run(&mut world, 60);
    let h = f64::from(DT) / 4.0;
    let factor = 1.0 / (1.0 + 1.5 * h);
    let way: f64 = (1..=240).map(|n| 2.0 * factor.powi(n) * h).sum();
    let view = world.body(body).unwrap();
    assert!((f64::from(view.velocity().x) - 2.0 * factor.powi(240)).abs() < 1e-5);
    assert!((f64::from(view.center_of_mass().x) - way).abs() < 1e-5);
}

/// Verlet is reversible: with all velocities turned round, a flight runs back to its start.
#[test]
fn a_reversed_flight_returns() {
    let settings = Settings { substeps: 1, ..sleepless(Settings::default()) };
    let mut world = World::new(settings).unwrap();
    let body = world.add(TrussBody::new(&cube(0.5)).velocity(Vec3::new(1.0, 4.0, 0.5))).unwrap();
    let start = world.positions().to_vec();
    run(&mut world, 60);
    // The view's velocity is that of half a substep ago.
    let now = world.body(body).unwrap().velocity() - Vec3::Y * (9.81 * DT / 2.0);
    world.set_velocity(body, -now).unwrap();
    run(&mut world, 60);
    let error = world.positions().iter().zip(&start).map(|(x, y)| x.distance(*y)).fold(0.0, f32::max);
    assert!(error < 1e-5, "{error} m from where it started");
}

/// A particle on a taut stick, without gravity: x + d projected onto the circle turns by θ' = atan(sin θ/(2 − cos θ))
/// after a turn of θ, and by atan(ω h) in its first step. (So spin dies out as dω/dt = −ω³h.)
#[test]
fn a_particle_on_a_stick_circles_as_projection_predicts() {
    let relaxation = Relaxation { tolerance: 0.0, ..Settings::paper().relaxation };
    let settings = Settings { substeps: 1, relaxation, cloth: ClothSolver::Paper, ..weightless() };
    let mut world = World::new(settings).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 1).velocity(Vec3::Z * -3.0).pin(0)).unwrap();
    let mut turn = (3.0 * f64::from(DT)).atan();
    let mut angle = 0.0f64;
    for step in 0..300 {
        run(&mut world, 1);
        angle += turn;
        turn = (turn.sin() / (2.0 - turn.cos())).atan();
        let expected = tautline::DVec3::new(angle.cos(), 0.0, -angle.sin());
        let error = (world.body(rope).unwrap().positions()[1].as_dvec3() - expected).length();
        assert!(error < 1e-4, "{error} m off at step {step}");
    }
}

/// T = 2π √(L/g) (1 + θ²/16) for a particle on a stick of length L and an amplitude of θ. The paper's stick pulls along
/// where it is after the substep of h, not before: of its pull g the part g·θ'h brakes, and the amplitude falls as
/// exp(−g h t/2L). That of the default solver pulls along where it was, and takes nothing.
#[test]
fn a_pendulum_keeps_its_period_and_loses_what_projection_takes() {
    check_pendulum(ClothSolver::Paper, DT / 8.0);
    check_pendulum(ClothSolver::SmallSteps, 0.0);
}

/// With a swing that dies out as that of projection in substeps of `h` (s).
fn check_pendulum(cloth: ClothSolver, h: f32) {
    let settings = Settings { cloth, ..Settings::default() };
    let mut world = World::new(sleepless(settings)).unwrap();
    let amplitude = 0.2f32;
    let end = Vec3::new(amplitude.sin(), -amplitude.cos(), 0.0);
    let rope = world.add(Rope::straight(Vec3::ZERO, end, 1).pin(0)).unwrap();
    let (mut crossings, mut last, mut greatest) = (Vec::new(), end.x, (0.0f32, 0.0));
    while world.time() < 21.0 {
        run(&mut world, 1);
        let x = world.body(rope).unwrap().positions()[1].x;
        if last < 0.0 && x >= 0.0 {
            crossings.push(world.time() - f64::from(DT * x / (x - last)));
        }
        if world.time() > 18.0 && x.abs() > greatest.0 {
            greatest = (x.abs(), world.time());
        }
        last = x;
    }
    let period = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    let expected = std::f64::consts::TAU / G.sqrt() * (1.0 + f64::from(amplitude).powi(2) / 16.0);
    assert!((period / expected - 1.0).abs() < 0.002, "period {period} s, expected {expected}");
    let kept = f64::from(greatest.0 / end.x);
    let expected = (-G * f64::from(h) * greatest.1 / 2.0).exp();
    assert!((kept / expected - 1.0).abs() < 0.01, "kept {kept} of its swing, expected {expected}");
}

/// Coulomb: on a plane inclined by θ a box stays while tan θ < μ, and else slides with a = g (sin θ − μ cos θ).
/// The plane is level and gravity inclined. A box that should stay creeps at some g sin θ h: that is what gravity gives
/// all particles in a substep, while friction takes it only from those in contact.
#[test]
fn a_box_on_a_slope_sticks_below_the_angle_of_friction_and_slides_above() {
    let shape = truss(primitives::cuboid(Vec3::new(0.5, 0.15, 0.5)).unwrap());
    let friction = 0.5f32;
    for (name, settings) in [("default", Settings::default()), ("paper", Settings::paper())] {
        let h = DT / settings.substeps as f32;
        // The way slid after 1, 2 and 3 s.
        let slid = |steepness: f32| {
            let slope = (friction * steepness).atan();
            let gravity = Vec3::new(slope.sin(), -slope.cos(), 0.0) * 9.81;
            let mut world = World::new(Settings { gravity, ..sleepless(settings.clone()) }).unwrap();
            world.add(HalfSpace::floor(0.0).friction(friction)).unwrap();
            let body = TrussBody::new(&shape).position(Vec3::Y * 0.15).friction(friction);
            let body = world.add(body).unwrap();
            let ways = [1, 2, 3].map(|_| {
                run(&mut world, 60);
                center(&world, body).x
            });
            (ways, 9.81 * slope.sin(), 9.81 * friction * slope.cos())
        };
        let (below, pull, _) = slid(0.8);
        let ([first, second, third], steeper_pull, hold) = slid(1.25);
        let acceleration = steeper_pull - hold;
        println!("{name}: below {below:?}; above {:?} of {acceleration}", [first, second, third]);
        let creep = (below[2] - below[0]) / 2.0;
        assert!(creep < 6.0 * pull * h, "{name}: creeps at {creep} m/s down a slope it should stick to");
        let measured = third - 2.0 * second + first;
        assert!((measured / acceleration - 1.0).abs() < 0.1, "{name}: {measured} of {acceleration} m/s²");
    }
}

/// A cube of side s rests with its centre at s/2; the paper's solver lets gravity push it in by g h² each step and
/// its sticks be 1 % short.
#[test]
fn a_cube_rests_on_the_floor_at_half_its_side() {
    for (settings, tolerance) in [(Settings::default(), 5e-4), (Settings::paper(), 9.81 * DT * DT + 0.0025)] {
        let mut world = World::new(settings).unwrap();
        world.add(HalfSpace::floor(-0.3)).unwrap();
        let body = world.add(TrussBody::new(&cube(0.5)).position(Vec3::Y * 0.3)).unwrap();
        run(&mut world, 180);
        let y = center(&world, body).y;
        println!("rests {} m off", y + 0.05);
        assert!((y + 0.05).abs() < tolerance, "rests at {y}, expected -0.05");
    }
}
