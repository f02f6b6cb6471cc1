//! What being stretched does to cloth for good: it tears and creeps.

use tautline::mesh::primitives;
use tautline::{Anchor, Attachment, BodyHandle, Cloth, ClothSolver, Error, Grip, Settings, Vec3, World};

use super::{DT, center, positions, run, stretch, weightless};

const COLUMNS: u32 = 15;
const ROWS: u32 = 5;
/// Between neighbours, in m.
const EDGE: f32 = 0.05;
/// What a width of strip bears, in N/m: strain over compliance.
const STRENGTH: f32 = 0.1 / COMPLIANCE;
const COMPLIANCE: f32 = 0.01;

/// A strip along x that tears at 10 %.
fn strip() -> Cloth {
    let [length, width] = [COLUMNS - 1, ROWS - 1].map(|cells| cells as f32 * EDGE);
    Cloth::grid(COLUMNS, ROWS, length, width).mass(0.2).compliance(COMPLIANCE).tear_at(0.1)
}

/// Pulls for a step at both ends of the strip with so much tension (N/m).
fn pull(world: &mut World, strip: BodyHandle, tension: f32) {
    for row in 0..ROWS {
        let share = if row == 0 || row == ROWS - 1 { 0.5 } else { 1.0 };
        let force = Vec3::X * (tension * EDGE * share);
        world.apply_force_at(strip, row * COLUMNS, -force).unwrap();
        world.apply_force_at(strip, (row + 1) * COLUMNS - 1, force).unwrap();
    }
    world.step(DT).unwrap();
}

/// Which particles hang together with one by sticks.
fn connected(world: &World, body: BodyHandle, from: u32) -> Vec<bool> {
    let view = world.body(body).unwrap();
    let mut found = vec![false; view.positions().len()];
    found[from as usize] = true;
    let mut has_grown = true;
    while has_grown {
        has_grown = false;
        for stick in view.sticks() {
            let ends = [stick.a, stick.b].map(|end| end as usize);
            if found[ends[0]] != found[ends[1]] {
                ends.iter().for_each(|&end| found[end] = true);
                has_grown = true;
            }
        }
    }
    found
}

/// Pulls ever harder until it is in two.
fn tear_apart(world: &mut World, strip: BodyHandle) {
    for step in 0..120 {
        pull(world, strip, STRENGTH * (step as f32 / 60.0));
        if !connected(world, strip, 0)[COLUMNS as usize - 1] {
            return;
        }
    }
    panic!("it holds");
}

#[test]
fn a_strip_that_is_pulled_apart_tears_in_two() {
    let mut world = World::new(weightless()).unwrap();
    let strip = world.add(strip().self_collision(false)).unwrap();
    let whole = world.body(strip).unwrap().triangles().len();
    tear_apart(&mut world, strip);
    let left = world.body(strip).unwrap().triangles().len();
    assert!(left < whole && left > whole * 2 / 3, "{left} of {whole} triangles are left");
    let halves = [0, COLUMNS - 1].map(|corner| connected(&world, strip, corner));
    let middle = |world: &World, half: usize| {
        let at = positions(world, strip);
        let of_half = || at.iter().zip(&halves[half]).filter(|(_, is_in)| **is_in).map(|(at, _)| *at);
        of_half().sum::<Vec3>() / of_half().count() as f32
    };
    let apart = |world: &World| middle(world, 1).x - middle(world, 0).x;
    let (before, momentum, turn) = (apart(&world), world.momentum(), world.angular_momentum());
    let center = center(&world, strip);
    run(&mut world, 0.5);
    let after = apart(&world);
    assert!(after > before + 0.05, "they move apart, {before} to {after} m");
    // What a half has.
    let scale = 0.1 * f64::from(after - before) / 2.0 / 0.5;
    assert!(momentum.length() < 1e-5 * scale + 1e-6, "{momentum}");
    assert!((world.momentum() - momentum).length() < 1e-5 * scale, "{} of {scale}", world.momentum());
    // A tear moves nothing, but ends that snap back vibrate, and small steps keep the turn of what vibrates less well.
    let of_turn = scale * f64::from(EDGE * ROWS as f32);
    let turned = (world.angular_momentum() - turn).length();
    assert!(turned < 0.02 * of_turn, "{turned} of {of_turn} kg m²/s");
    assert!(center.distance(super::center(&world, strip)) < 1e-4);
}

/// What is drawn and what holds are the same, and what is stored is sound.
#[test]
fn what_is_left_hangs_together_by_its_triangles() {
    let mut world = World::new(weightless()).unwrap();
    let strip = world.add(strip().bending_stiffness(1e-4).seam(0, COLUMNS)).unwrap();
    tear_apart(&mut world, strip);
    let view = world.body(strip).unwrap();
    let sorted = |a: u32, b: u32| [a.min(b), a.max(b)];
    let mut edges: Vec<[u32; 2]> =
        view.triangles().iter().flat_map(|&[a, b, c]| [sorted(a, b), sorted(b, c), sorted(c, a)]).collect();
    edges.sort_unstable();
    edges.dedup();
    let mut sticks: Vec<[u32; 2]> = view.sticks().iter().map(|stick| sorted(stick.a, stick.b)).collect();
    sticks.sort_unstable();
    assert_eq!(sticks, edges);
    assert_eq!(view.positions().len() as u32, COLUMNS * ROWS);
    assert!(World::restore(&world.snapshot()).is_ok());
}

#[test]
fn below_its_strength_it_holds_and_is_as_long_as_it_should_be() {
    let mut world = World::new(Settings { damping: 5.0, ..weightless() }).unwrap();
    let strip = world.add(strip()).unwrap();
    let whole = world.body(strip).unwrap().triangles().len();
    for step in 0..180 {
        pull(&mut world, strip, 0.7 * STRENGTH * (step as f32 / 90.0).min(1.0));
    }
    assert_eq!(world.body(strip).unwrap().triangles().len(), whole);
    let strain = stretch(&world, strip);
    assert!(strain > 0.06 && strain < 0.1, "{strain}");
}

#[test]
fn a_particle_that_has_torn_off_is_held_by_what_held_it() {
    let mut world = World::new(Settings { sleep: None, ..Settings::default() }).unwrap();
    let sheet = world.add(strip().pin(7).position(Vec3::Y)).unwrap();
    let corner = world.body(sheet).unwrap().positions()[0];
    world.attach(Anchor::particle(sheet, 0), Anchor::world(corner), Attachment::default()).unwrap();
    let end = world.body(sheet).unwrap().positions()[COLUMNS as usize - 1];
    let grab = world.grab(sheet, end, Grip::default()).unwrap();
    // Its own weight tears it off.
    for particle in 0..COLUMNS * ROWS {
        world.set_particle_mass(sheet, particle, 0.5).unwrap();
    }
    run(&mut world, 1.0);
    assert!(world.body(sheet).unwrap().triangles().len() < 100);
    let at = positions(&world, sheet);
    assert!(at[0].distance(corner) < 1e-3, "the attachment holds: {}", at[0] - corner);
    assert_eq!(at[7], Vec3::new(0.0, 1.0, -0.1), "the pin holds");
    let [held, target] = world.grab_ends(grab).unwrap();
    assert!(held.distance(target) < 0.1, "the grab holds: {held} {target}");
    assert!(at.iter().any(|at| at.y < -1.0), "the rest falls");
}

#[test]
fn gas_escapes_through_a_tear() {
    let mut world = World::new(weightless()).unwrap();
    let ball = Cloth::from_mesh(primitives::icosphere(0.3, 2).unwrap()).mass(0.3);
    let balloon = world.add(ball.compliance(1e-3).tear_at(0.05).pressure(2000.0)).unwrap();
    let view = world.body(balloon).unwrap();
    assert!(view.pressure().is_some());
    let whole = view.triangles().len();
    run(&mut world, 0.5);
    let view = world.body(balloon).unwrap();
    assert!(view.triangles().len() < whole && view.pressure().is_none());
}

#[test]
fn it_tears_with_the_same_bits_on_any_thread_and_after_a_snapshot() {
    let tear = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = World::new(weightless()).unwrap();
            let strip = world.add(strip().creep(0.02, 3.0)).unwrap();
            let mut copy = world.clone();
            for step in 0..90 {
                if step % 20 == 10 {
                    copy = World::restore(&world.snapshot()).unwrap();
                }
                for world in [&mut world, &mut copy] {
                    pull(world, strip, STRENGTH * (step as f32 / 45.0));
                }
                assert_eq!(world.state_hash(), copy.state_hash(), "step {step}");
            }
            assert!(world.body(strip).unwrap().triangles().len() < 112);
            world.state_hash()
        })
    };
    assert_eq!(tear(1), tear(2));
}

/// Held at a fixed length l, with the length at rest d → l/(1 + y) − (l/(1 + y) − d) e^(−r t).
#[test]
fn creep_at_a_fixed_length_follows_its_closed_form() {
    let (rate, yielding, strain) = (1.5, 0.02, 0.3);
    let mut world = World::new(weightless()).unwrap();
    let mut cloth = Cloth::grid(3, 3, 0.2, 0.2).compliance(0.01).creep(yielding, rate);
    for particle in (0..9).filter(|&particle| particle != 4) {
        cloth = cloth.pin(particle);
    }
    let cloth = world.add(cloth).unwrap();
    let before = world.body(cloth).unwrap().sticks().to_vec();
    for (particle, at) in (0..).zip(positions(&world, cloth)) {
        world.set_particle_position(cloth, particle, Vec3::new(at.x * (1.0 + strain), at.y, at.z)).unwrap();
    }
    for step in 1..=120 {
        world.step(DT).unwrap();
        let left = f64::from(-rate * DT * step as f32).exp();
        for (stick, before) in world.body(cloth).unwrap().sticks().iter().zip(&before) {
            let at = positions(&world, cloth);
            let length = f64::from(at[stick.a as usize].distance(at[stick.b as usize]));
            let (d, aim) = (f64::from(before.rest_length), length / (1.0 + f64::from(yielding)));
            let expected = if aim > d { aim - (aim - d) * left } else { d };
            let found = f64::from(stick.rest_length);
            // The particle in the middle is free to move a little.
            assert!((found / expected - 1.0).abs() < 2e-3, "step {step}: {found} instead of {expected} m");
        }
    }
}

#[test]
fn below_the_yield_strain_nothing_creeps_and_nothing_gets_shorter() {
    let mut world = World::new(Settings { damping: 5.0, ..weightless() }).unwrap();
    let strip = world.add(strip().tear_at(10.0).creep(0.08, 20.0)).unwrap();
    let lengths = |world: &World| -> Vec<f32> {
        world.body(strip).unwrap().sticks().iter().map(|stick| stick.rest_length).collect()
    };
    let before = lengths(&world);
    for step in 0..120 {
        pull(&mut world, strip, 0.5 * STRENGTH * (step as f32 / 90.0).min(1.0));
    }
    assert_eq!(lengths(&world), before);
    for _ in 0..30 {
        pull(&mut world, strip, 1.5 * STRENGTH);
    }
    let after = lengths(&world);
    assert!(after.iter().zip(&before).all(|(after, before)| after >= before) && after != before);
    run(&mut world, 1.0);
    assert!(lengths(&world).iter().zip(&after).all(|(later, after)| later >= after));
}

#[test]
fn tears_and_creep_that_could_not_be_are_refused() {
    let cloth = || Cloth::grid(3, 3, 1.0, 1.0);
    let refused = [
        (cloth().tear_at(0.1), "tear_at"),
        (cloth().compliance(0.0).tear_at(0.1), "tear_at"),
        (cloth().compliance(0.1).tear_at(0.0), "tear_at"),
        (cloth().compliance(0.1).tear_at(f32::NAN), "tear_at"),
        (cloth().compliance(0.1).strain_limit(0.1).tear_at(0.1), "tear_at"),
        (cloth().creep(0.1, 1.0), "creep"),
        (cloth().compliance(0.1).creep(-0.1, 1.0), "creep.yield_strain"),
        (cloth().compliance(0.1).creep(0.1, f32::INFINITY), "creep.rate"),
    ];
    for (cloth, expected) in refused {
        let mut world = World::new(weightless()).unwrap();
        let (Error::Invalid { field, .. } | Error::OutOfRange { field, .. }) = world.add(cloth).unwrap_err()
        else {
            panic!("{expected}")
        };
        assert_eq!(field, expected);
    }
    let mut paper = World::new(Settings { cloth: ClothSolver::Paper, ..Settings::default() }).unwrap();
    assert!(paper.add(cloth().compliance(0.1).tear_at(0.1)).is_err());
}
