//! What cloth and rope are made of in documents: every field is the engine's.

use tautline::{Cloth, Rope, Settings, Vec3, World};
use tautline_scene::document::{Format, parse};

const WIND: Vec3 = Vec3::new(3.0, 1.0, 0.0);

/// The hash after a tenth of a second in the wind.
fn hash(mut world: World) -> u64 {
    for _ in 0..6 {
        world.step(1.0 / 60.0).unwrap();
    }
    world.state_hash()
}

fn of_document(body: &str) -> u64 {
    let text = format!("{{tautline: 1, settings: {{wind: [3, 1, 0]}}, bodies: [{body}]}}");
    hash(parse(&text, Format::Json5).unwrap().build().unwrap().world)
}

fn empty() -> World {
    World::new(Settings { wind: WIND, ..Settings::default() }).unwrap()
}

fn of_cloth(cloth: Cloth) -> u64 {
    let mut world = empty();
    world.add(cloth).unwrap();
    hash(world)
}

/// A square that is pinned at a corner.
fn square() -> Cloth {
    Cloth::grid(4, 4, 0.3, 0.3).pin(0)
}

type Change<T> = (&'static str, fn(T) -> T);

#[test]
fn every_field_of_a_cloth_is_the_engines() {
    let changes: [Change<Cloth>; 13] = [
        ("sag: 0.1", |cloth| cloth.sag(0.1)),
        ("density: 0.4", |cloth| cloth.density(0.4)),
        ("masses: [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16]", |cloth| {
            cloth.masses((1..=16u8).map(f32::from).collect())
        }),
        ("bending_stiffness: 0.01", |cloth| cloth.bending_stiffness(0.01)),
        ("compliance: 0.01", |cloth| cloth.compliance(0.01)),
        ("compliance: 0.01, shear_compliance: 0.1", |cloth| cloth.compliance(0.01).shear_compliance(0.1)),
        ("strain_limit: 0.2", |cloth| cloth.strain_limit(0.2)),
        ("compliance: 0.1, tear_at: 1e-3", |cloth| cloth.compliance(0.1).tear_at(1e-3)),
        ("compliance: 0.1, creep: {yield_strain: 1e-4, rate: 50}", |cloth| {
            cloth.compliance(0.1).creep(1e-4, 50.0)
        }),
        ("drag: 1.2", |cloth| cloth.drag(1.2)),
        ("lift: 1.2", |cloth| cloth.lift(1.2)),
        ("drag: 1.2, lift: 1.2", |cloth| cloth.drag(1.2).lift(1.2)),
        ("seams: [[0, 3], [12, 15]]", |cloth| cloth.seam(0, 3).seam(12, 15)),
    ];
    let plain = of_cloth(square());
    for (text, change) in changes {
        let grid = "surface: {grid: {columns: 4, rows: 4, width: 0.3, depth: 0.3}}, pins: [0]";
        let built = of_document(&format!("{{cloth: {{{grid}, {text}}}}}"));
        assert_eq!(built, of_cloth(change(square())), "{text}");
        assert_ne!(built, plain, "{text}");
    }
}

#[test]
fn a_closed_mesh_is_filled_with_gas() {
    let text = "{cloth: {surface: {mesh: {positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
        triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}}, pressure: 250}}";
    let scene = parse(&format!("{{tautline: 1, bodies: [{text}]}}"), Format::Json5).unwrap();
    let built = scene.build().unwrap();
    let pressure = built.world.body(built.parts[0].body).unwrap().pressure().unwrap();
    assert!((pressure - 250.0).abs() < 0.01, "{pressure}");
}

#[test]
fn every_field_of_a_rope_is_the_engines() {
    let laid = || Rope::straight(Vec3::ZERO, Vec3::X, 8).radius(0.01).pin(0);
    let of_rope = |rope: Rope| {
        let mut world = empty();
        world.add(rope).unwrap();
        hash(world)
    };
    let changes: [Change<Rope>; 2] = [
        ("bending_stiffness: 0.1", |rope| rope.bending_stiffness(0.1)),
        ("compliance: 0.01", |rope| rope.compliance(0.01)),
    ];
    for (text, change) in changes {
        let line = "path: {line: {from: [0, 0, 0], to: [1, 0, 0], segments: 8}}, pins: ['first']";
        let built = of_document(&format!("{{rope: {{{line}, {text}}}}}"));
        assert_eq!(built, of_rope(change(laid())), "{text}");
        assert_ne!(built, of_rope(laid()), "{text}");
    }
}
