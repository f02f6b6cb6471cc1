//! What cloth and rope are made of: how they bend and stretch, what they weigh, where they are sewn.

use std::f64::consts::FRAC_PI_2;

use tautline::mesh::primitives;
use tautline::{BodyHandle, Cloth, ClothSolver, Error, Rope, Settings, Vec3, World};

use super::{positions, run, stretch, weightless};

fn damped() -> World {
    World::new(Settings { damping: 4.0, sleep: None, ..Settings::default() }).unwrap()
}

/// How far the end of a heavy strip or rod that is clamped level reaches and hangs down (m), by its length (m) and weight
/// per length over stiffness (1/m³): B θ″ = −q (L − s) cos θ with θ(0) = 0 and θ′(L) = 0, by shooting.
fn elastica(length: f64, load: f64) -> [f64; 2] {
    let steps = 4000;
    let h = length / f64::from(steps);
    let shoot = |curvature: f64| {
        let (mut angle, mut bend, mut x, mut y) = (0.0_f64, curvature, 0.0, 0.0);
        for k in 0..steps {
            let s = (f64::from(k) + 0.5) * h;
            let half = angle + 0.5 * h * bend;
            x += h * half.cos();
            y += h * half.sin();
            bend -= h * load * (length - s) * half.cos();
            angle = half + 0.5 * h * bend;
        }
        (bend, [x, y])
    };
    let (mut low, mut high) = (0.0, load * length * length);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if shoot(middle).0 > 0.0 { high = middle } else { low = middle }
    }
    shoot(low).1
}

/// Compares where the end is with the elastica. What is clamped by its first two particles is so half way between them.
fn check_end(what: &str, end: Vec3, [edge, free]: [f32; 2], load: f32, tolerance: f64) {
    let [reach, droop] = elastica(f64::from(free + 0.5 * edge), f64::from(load));
    let found = [f64::from(end.x + 0.5 * edge), f64::from(-end.y)];
    for (name, found, expected) in [("reach", found[0], reach), ("droop", found[1], droop)] {
        assert!((found / expected - 1.0).abs() < tolerance, "{what}: {name} {found} instead of {expected} m");
    }
}

const FREE: f32 = 0.3;
const RIGIDITY: f32 = 0.05;

/// A strip that lies along x from −edge on, clamped there; its last particle in the middle of its width.
fn clamped_end(cells: u32, as_mesh: bool, [free, rigidity]: [f32; 2]) -> Vec3 {
    let edge = free / cells as f32;
    let (columns, rows) = (cells + 2, 5);
    let [length, width] = [columns - 1, rows - 1].map(|count| count as f32 * edge);
    let strip = if as_mesh {
        Cloth::from_mesh(primitives::grid(columns, rows, length, width).unwrap())
    } else {
        Cloth::grid(columns, rows, length, width)
    };
    let mut strip = strip.density(1.0).bending_stiffness(rigidity).self_collision(false);
    strip = strip.position(Vec3::X * (0.5 * length - edge));
    for row in 0..rows {
        strip = strip.pin(row * columns).pin(row * columns + 1);
    }
    let mut world = damped();
    let strip = world.add(strip).unwrap();
    run(&mut world, 5.0);
    positions(&world, strip)[(2 * columns + columns - 1) as usize]
}

#[test]
fn a_heavy_strip_clamped_level_hangs_as_an_elastica() {
    for cells in [8, 12, 14] {
        let end = clamped_end(cells, false, [FREE, RIGIDITY]);
        check_end(&format!("{cells} cells"), end, [FREE / cells as f32, FREE], 9.81 / RIGIDITY, 0.02);
    }
}

/// Hinges of halved squares bend and twist together, so that a narrow strip is softer than the plate it is cut from, by 1/6
/// where nothing keeps it from twisting.
#[test]
fn a_strip_of_a_mesh_bends_nearly_as_much() {
    let (free, rigidity, cells) = (1.0, 20.0, 8);
    let edge = free / cells as f32;
    let end = clamped_end(cells, true, [free, rigidity]);
    let [_, droop] = elastica(f64::from(free + 0.5 * edge), f64::from(9.81 / rigidity));
    let ratio = f64::from(-end.y) / droop;
    assert!(ratio > 1.0 && ratio < 1.2, "{ratio}");
}

#[test]
fn a_heavy_rod_clamped_level_hangs_as_an_elastica() {
    for segments in [10, 14] {
        let edge = FREE / segments as f32;
        let rod = Rope::straight(Vec3::X * -edge, Vec3::X * FREE, segments + 1);
        let rod = rod.mass(1.0).bending_stiffness(0.05).pin(0).pin(1);
        let mut world = damped();
        let rod = world.add(rod).unwrap();
        // One kilogram per metre, a half of the last segment's at the end.
        for particle in 0..segments + 2 {
            let share = if particle == segments + 1 { 0.5 } else { 1.0 };
            world.set_particle_mass(rod, particle, edge * share).unwrap();
        }
        run(&mut world, 5.0);
        let end = positions(&world, rod)[segments as usize + 1];
        check_end(&format!("{segments} segments"), end, [edge, FREE], 9.81 / 0.05, 0.02);
    }
}

/// A sheet hung by its upper edge: σ(y) = ρ g y, so that it is longer by α ρ g L²/2.
#[test]
fn a_hung_sheet_is_stretched_by_its_weight() {
    let (compliance, density, height) = (4e-3, 1.0, 1.0_f32);
    for (columns, rows) in [(7, 13), (9, 17)] {
        let upright = tautline::Quat::from_rotation_x(FRAC_PI_2 as f32);
        let width = (columns - 1) as f32 * height / (rows - 1) as f32;
        // Sheared cells would pull it askew.
        let sheet = Cloth::grid(columns, rows, width, height).rotation(upright).density(density);
        let sheet = sheet.compliance(compliance).shear_compliance(10.0).self_collision(false);
        let sheet = (0..columns).fold(sheet, Cloth::pin);
        let mut world = damped();
        let sheet = world.add(sheet).unwrap();
        run(&mut world, 5.0);
        let at = positions(&world, sheet);
        let [first, last] = [columns / 2, columns * (rows - 1) + columns / 2].map(|k| at[k as usize].y);
        let longer = first - last - height;
        let expected = compliance * density * 9.81 * height * height / 2.0;
        assert!((longer / expected - 1.0).abs() < 0.03, "{rows} rows: {longer} instead of {expected} m");
    }
}

#[test]
fn a_rope_gives_by_its_load() {
    for segments in [5, 20] {
        let mut world = damped();
        let rope = Rope::straight(Vec3::ZERO, Vec3::NEG_Y * 2.0, segments).mass(0.01).compliance(0.01).pin(0);
        let rope = world.add(rope).unwrap();
        world.set_particle_mass(rope, segments, 0.5).unwrap();
        run(&mut world, 6.0);
        let end = positions(&world, rope)[segments as usize].y;
        // The rope's own weight counts half.
        let expected = 2.0 * 0.01 * 9.81 * (0.5 + 0.005);
        assert!(
            (-end - 2.0 - expected).abs() < 0.02 * expected,
            "{segments}: {end}, not {expected} below −2"
        );
    }
}

/// It is free up to there; and soft up to there, if it has a compliance.
#[test]
fn a_strain_limit_holds() {
    for compliance in [None, Some(1.0)] {
        let upright = tautline::Quat::from_rotation_x(FRAC_PI_2 as f32);
        let sheet = Cloth::grid(9, 9, 0.8, 0.8).rotation(upright).strain_limit(0.1).mass(0.5);
        let sheet = compliance.into_iter().fold(sheet, Cloth::compliance);
        let sheet = (0..9).fold(sheet, Cloth::pin);
        let mut world = damped();
        let sheet = world.add(sheet).unwrap();
        run(&mut world, 4.0);
        let longest = stretch(&world, sheet);
        assert!(longest > 0.095 && longest < 0.12, "{compliance:?}: {longest}");
    }
}

#[test]
fn masses_are_those_given_or_follow_the_area() {
    let mut world = World::new(Settings::default()).unwrap();
    let mut masses = |cloth: Cloth| {
        let body = world.add(cloth).unwrap();
        let view = world.body(body).unwrap();
        view.inverse_masses().iter().map(|w| 1.0 / w).collect::<Vec<f32>>()
    };
    let given = [0.1, 0.2, 0.3, 0.4];
    let found = masses(Cloth::grid(2, 2, 1.0, 1.0).masses(given.to_vec()));
    assert!(found.iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?}");
    let mesh = primitives::icosphere(0.5, 3).unwrap();
    let total: f32 = masses(Cloth::from_mesh(mesh).density(0.2)).iter().sum();
    assert!((total - 0.2 * std::f32::consts::PI).abs() < 0.02 * total, "4 π r² ρ, nearly: {total}");
    let found = masses(Cloth::grid(3, 3, 2.0, 2.0).density(3.0));
    assert!((found[4] - 3.0).abs() < 1e-5 && (found[1] - 1.5).abs() < 1e-5, "{found:?}");
}

#[test]
fn a_sheet_laid_out_with_sag_is_at_rest_there() {
    let mut world = World::new(Settings { gravity: Vec3::ZERO, sleep: None, ..Settings::default() }).unwrap();
    let corners = [0, 8, 72, 80];
    let sheet = corners.into_iter().fold(Cloth::grid(9, 9, 2.0, 1.0).sag(0.5), Cloth::pin);
    let sheet = world.add(sheet).unwrap();
    let laid_out = positions(&world, sheet);
    let heights = [laid_out[0].y, laid_out[4].y, laid_out[40].y];
    assert!(
        heights.iter().zip([0.0, -0.25, -0.5]).all(|(y, wanted)| (y - wanted).abs() < 1e-6),
        "{heights:?}"
    );
    run(&mut world, 0.5);
    let moved =
        positions(&world, sheet).iter().zip(&laid_out).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    assert!(moved < 1e-6, "{moved}");
}

/// A panel that is bent to five sixths of a tube, and sewn up.
fn tube(world: &mut World) -> BodyHandle {
    let mut mesh = primitives::grid(16, 6, 1.5, 0.5).unwrap();
    for at in &mut mesh.positions {
        let (angle, radius) = (at.x / 1.5 * 5.236, 1.5 / 5.236);
        *at = Vec3::new(radius * angle.sin(), radius * (1.0 - angle.cos()), at.z);
    }
    let sheet = Cloth::from_mesh(mesh).mass(0.3);
    world.add((0..6).fold(sheet, |sheet, row| sheet.seam(row * 16, row * 16 + 15))).unwrap()
}

#[test]
fn seams_close_and_hold_and_keep_momentum() {
    let mut world = World::new(weightless()).unwrap();
    let sheet = tube(&mut world);
    let gap = |world: &World| {
        let at = positions(world, sheet);
        (0..6).map(|row| at[row * 16].distance(at[row * 16 + 15])).fold(0.0, f32::max)
    };
    let wide = gap(&world);
    run(&mut world, 0.1);
    let drawn = wide - gap(&world);
    assert!((drawn - 0.1).abs() < 0.02, "drawn together at 1 m/s: {drawn} m");
    let mut copy = World::restore(&world.snapshot()).unwrap();
    run(&mut world, 1.0);
    run(&mut copy, 1.0);
    assert_eq!(world.state_hash(), copy.state_hash());
    assert!(gap(&world) < 1e-3, "{}", gap(&world));
    assert!(world.momentum().length() < 1e-5 * 0.3, "{}", world.momentum());
    assert!(stretch(&world, sheet) < 0.05, "{}", stretch(&world, sheet));
}

fn field(error: Error) -> String {
    match error {
        Error::OutOfRange { field, .. } | Error::Invalid { field, .. } => field,
        other => other.to_string(),
    }
}

#[test]
fn what_is_wrong_with_fabric_is_refused_by_name() {
    let mut world = World::new(Settings::default()).unwrap();
    let cloth = || Cloth::grid(3, 3, 1.0, 1.0);
    let rope = || Rope::straight(Vec3::ZERO, Vec3::X, 4);
    for wrong in [-1.0, f32::NAN, f32::INFINITY] {
        for (name, cloth) in [
            ("bending_stiffness", cloth().bending_stiffness(wrong)),
            ("compliance", cloth().compliance(wrong)),
            ("shear_compliance", cloth().compliance(1.0).shear_compliance(wrong)),
            ("strain_limit", cloth().strain_limit(wrong)),
            ("density", cloth().density(wrong)),
            ("sag", cloth().sag(wrong)),
            ("masses[2]", cloth().masses(vec![1.0, 1.0, wrong, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])),
        ] {
            assert_eq!(field(world.add(cloth).unwrap_err()), name);
        }
        assert_eq!(field(world.add(rope().bending_stiffness(wrong)).unwrap_err()), "bending_stiffness");
        assert_eq!(field(world.add(rope().compliance(wrong)).unwrap_err()), "compliance");
    }
    for (name, cloth) in [
        ("masses", cloth().masses(vec![1.0; 8])),
        ("seams[1]", cloth().seam(0, 2).seam(3, 3)),
        ("seams[0]", cloth().seam(0, 9)),
        ("shear_compliance", cloth().shear_compliance(1.0)),
        ("bending_stiffness", cloth().bending(1.0).bending_stiffness(1.0)),
    ] {
        assert_eq!(field(world.add(cloth).unwrap_err()), name);
    }
    let paper = Settings { cloth: ClothSolver::Paper, ..Settings::default() };
    let mut world = World::new(paper).unwrap();
    for (name, cloth) in [
        ("bending_stiffness", cloth().bending_stiffness(1.0)),
        ("compliance", cloth().compliance(1.0)),
        ("strain_limit", cloth().strain_limit(1.0)),
        ("seams", cloth().seam(0, 2)),
    ] {
        assert_eq!(field(world.add(cloth).unwrap_err()), name);
    }
    assert_eq!(field(world.add(rope().compliance(1.0)).unwrap_err()), "compliance");
}
