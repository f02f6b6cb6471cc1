//! Meshes that other people made: examined, repaired, and let fall if they are solids then. They are not a part of this
//! project: `cargo xtask test --only meshes` fetches them and runs this; what it finds stands in `docs/meshes.md`.

mod worked;

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tautline::mesh::doctor::{Defect, RepairOptions, Repaired, Report, diagnose, repair};
use tautline::mesh::{TriMesh, decimate};
use tautline::{BodyHandle, Error, HalfSpace, RigidBody, Settings, Shape, Truss, TrussBody, Vec3, World};
use tautline_scene::mesh_file::{Limits, read_mesh};
use worked::worked;

/// Where `xtask` puts the files.
const FOLDER: &str = "TAUTLINE_MESHES";
/// Set to write the table anew.
const UPDATE: &str = "UPDATE_MESHES";
/// Triangles of what is divided into convex parts in seconds; what has more is decimated.
const MOST_PARTED: usize = 2_000;
/// Triangles of what is filled with tetrahedra, and steps, in seconds; what has more is decimated.
const MOST_FILLED: usize = 5_000;
/// What is slower is at rest, in m/s.
const QUIET: f64 = 0.02;
/// Not at rest after 20 s as a rigid body: a ball of 840 facets, each of which takes but a thirtieth of its energy when it
/// rolls over an edge. Everything else has to be, and every truss.
const ROLLS_ON: &str = "sphere.ply";

#[test]
#[ignore = "`cargo xtask test --only meshes` fetches the meshes"]
fn real_meshes_are_examined_repaired_and_come_to_rest() {
    let folder = PathBuf::from(std::env::var_os(FOLDER).expect("run by `cargo xtask test --only meshes`"));
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() >= 10, "{paths:?}");
    let mut table = "| mesh | vertices | triangles | found | done | left | as a rigid body | as a truss |\n\
         |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let mut fallen = [0; 2];
    for path in &paths {
        let name = path.file_name().unwrap().to_string_lossy();
        let start = worked();
        let row = match read_mesh(path, &Limits::default()) {
            Ok(file) => {
                let (report, repaired) =
                    (diagnose(&file.mesh), repair(&file.mesh, &RepairOptions::default()));
                let seconds = worked() - start;
                let bar = 5.0 * (report.triangles as f64 / 1e5).max(1.0);
                println!("{}: {} triangles, {seconds:.2} s of {bar:.0}", path.display(), report.triangles);
                assert!(seconds < bar, "{seconds} s");
                let [rigid, truss] = falls(&repaired);
                assert_eq!(rigid.contains("still"), name == ROLLS_ON, "{rigid}");
                assert!(!truss.contains("still"), "{truss}");
                fallen[0] += usize::from(rigid.contains("rests"));
                fallen[1] += usize::from(truss.contains("rests"));
                format!(
                    "{} | {} | {} | {} | {} | {rigid} | {truss}",
                    report.vertices,
                    report.triangles,
                    found(&report),
                    done(&repaired),
                    found(&repaired.report)
                )
            }
            Err(error) => format!(" | | refused: {error} | | | | "),
        };
        writeln!(table, "| {name} | {row} |").unwrap();
    }
    assert!(fallen[0] >= 3 && fallen[1] >= 3, "{table}");
    compare(&table);
}

/// How many defects there are of each kind.
fn found(report: &Report) -> String {
    if report.is_clean() {
        return "nothing".into();
    }
    let kinds = report.defects.chunk_by(|a, b| a.name() == b.name());
    let told = |kind: &[Defect]| {
        let more =
            if matches!(kind[0], Defect::Crossing { .. }) && !report.has_all_crossings { "≥ " } else { "" };
        format!("{more}{} {}", kind.len(), kind[0].name())
    };
    kinds.map(told).collect::<Vec<_>>().join(", ")
}

fn done(repaired: &Repaired) -> String {
    let (fillings, others): (Vec<String>, Vec<String>) =
        repaired.actions.iter().map(ToString::to_string).partition(|action| action.starts_with("filled"));
    let mut told = others;
    match fillings.len() {
        0 => {}
        1 => told.push("filled 1 hole".into()),
        count => told.push(format!("filled {count} holes")),
    }
    if told.is_empty() { "nothing".into() } else { told.join(", ") }
}

/// What a solid does that is dropped from a hand above the floor, half a metre in size: as a rigid body, and as a truss.
fn falls(repaired: &Repaired) -> [String; 2] {
    if !repaired.report.is_clean() {
        return ["is no solid", "is no solid"].map(String::from);
    }
    let mesh = half_a_metre(&repaired.mesh);
    let tried = |most: usize, add: fn(&mut World, &TriMesh) -> Result<BodyHandle, Error>| {
        if mesh.triangles.len() <= most {
            return comes_to_rest(&mesh, add);
        }
        match decimate(&mesh, most) {
            Ok(coarse) => {
                format!("of {} triangles: {}", coarse.mesh.triangles.len(), comes_to_rest(&coarse.mesh, add))
            }
            Err(error) => error.to_string(),
        }
    };
    [tried(MOST_PARTED, add_rigid), tried(MOST_FILLED, add_truss)]
}

fn add_rigid(world: &mut World, mesh: &TriMesh) -> Result<BodyHandle, Error> {
    let shape = Arc::new(Shape::from_mesh(mesh)?);
    let body = RigidBody::new(&shape).position(Vec3::Y * (shape.reach() + 0.1)).mass(1.0);
    world.add(body)
}

fn add_truss(world: &mut World, mesh: &TriMesh) -> Result<BodyHandle, Error> {
    let truss = Arc::new(Truss::from_mesh(mesh)?);
    let reach = truss.rest_positions().iter().map(|point| point.length()).fold(0.0, f32::max);
    world.add(TrussBody::new(&truss).position(Vec3::Y * (reach + 0.1)).mass(1.0))
}

/// Lets a body of 1 kg fall on a floor, and says when it came to rest and how it lies at the end.
fn comes_to_rest(mesh: &TriMesh, add: fn(&mut World, &TriMesh) -> Result<BodyHandle, Error>) -> String {
    let start = worked();
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let body = match add(&mut world, mesh) {
        Ok(body) => body,
        Err(error) => return error.to_string(),
    };
    let made = worked() - start;
    let mut moved = 0.0;
    for _ in 0..1200 {
        world.step(1.0 / 60.0).unwrap();
        if speed(&world) > QUIET {
            moved = world.time();
        }
    }
    let seen = world.body(body).unwrap();
    let lowest = seen.surface_positions().iter().map(|position| position.y).fold(f32::INFINITY, f32::min);
    let end = speed(&world);
    let told = if end < QUIET {
        format!("rests after {moved:.1} s, at {:.1} mm/s", end * 1e3)
    } else {
        format!("still moves at {:.0} mm/s", end * 1e3)
    };
    println!("  made in {made:.2} s, all in {:.2} s; {told}", worked() - start);
    assert!(lowest > -0.02 && seen.center_of_mass().y < 0.5, "{lowest} m, {} m", seen.center_of_mass());
    told
}

/// How fast the one body of 1 kg in a world moves, turns and shakes: the root of the mean square over its mass, in m/s.
fn speed(world: &World) -> f64 {
    (2.0 * world.kinetic_energy()).sqrt()
}

/// The mesh with a diagonal of half a metre.
fn half_a_metre(mesh: &TriMesh) -> TriMesh {
    let (low, high) = mesh
        .positions
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    let fit = |&p: &Vec3| (p - (low + high) / 2.0) * (0.5 / low.distance(high));
    TriMesh { positions: mesh.positions.iter().map(fit).collect(), triangles: mesh.triangles.clone() }
}

/// The table in the docs is the one that was found.
fn compare(table: &str) {
    println!("{table}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/meshes.md");
    let text = fs::read_to_string(&path).unwrap();
    let (before, old) = text.split_at(text.find("| mesh |").unwrap());
    if std::env::var_os(UPDATE).is_some() {
        fs::write(&path, format!("{before}{table}")).unwrap();
    } else {
        assert_eq!(old, table, "docs/meshes.md is out of date: {UPDATE}=1 cargo xtask test --only meshes");
    }
}
