//! What is wrong with a mesh file, what repair makes of it, and a picture of both.

use std::path::Path;

use serde_json::{Value, json};
use tautline::Vec3;
use tautline::mesh::TriMesh;
use tautline::mesh::doctor::{Defect, RepairOptions, Repaired, Report, diagnose, repair};
use tautline_scene::Error;
use tautline_scene::export::{Format as PictureFormat, check_writable, write_png};
use tautline_scene::marks::{LEGEND, marked};
use tautline_scene::mesh_file::{Limits, MeshFile, read_mesh, writable, write_mesh};
use tautline_scene::render::{Camera, Image, Renderer, Settings};

use super::table;
use crate::args::Check;
use crate::failure::Failure;
use crate::output::{make_folder_of, print, print_json};

pub(super) fn check(arguments: &Check) -> Result<(), Failure> {
    check_outputs(arguments)?;
    let file = match read_mesh(&arguments.file, &Limits::default()) {
        Ok(file) => file,
        Err(error @ Error::Mesh { .. }) if arguments.json => return report_refusal(arguments, &error),
        Err(error) => return Err(error.into()),
    };
    let report = diagnose(&file.mesh);
    let repaired = arguments.repair.as_ref().map(|_| repair(&file.mesh, &RepairOptions::default()));
    if let Some(path) = &arguments.picture {
        draw(&file.mesh, &report, path)?;
    }
    if let (Some(path), Some(repaired)) = (&arguments.repair, &repaired) {
        write_mesh(&repaired.mesh, path)?;
    }
    if arguments.json {
        print_json(&as_json(arguments, &file, &report, repaired.as_ref()))?;
    } else {
        print(&table::examination(&arguments.file, &file, &report))?;
        if let (Some(path), Some(repaired)) = (&arguments.repair, &repaired) {
            print(&table::treatment(path, repaired))?;
        }
        if let Some(path) = &arguments.picture {
            print(&format!("\n{}: {LEGEND}\n", path.display()))?;
        }
    }
    let verdict = repaired.as_ref().map_or(&report, |repaired| &repaired.report);
    if verdict.is_clean() { Ok(()) } else { Err(Failure::Reported) }
}

/// What could not be written is refused before anything is read.
fn check_outputs(arguments: &Check) -> Result<(), Failure> {
    if let Some(path) = &arguments.repair {
        writable(path)?;
    }
    if let Some(path) = &arguments.picture
        && PictureFormat::of(path)? != PictureFormat::Png
    {
        return Err(Error::UnsupportedFormat { path: path.clone(), supported: ".png" }.into());
    }
    for path in [&arguments.repair, &arguments.picture].into_iter().flatten() {
        make_folder_of(path)?;
        check_writable(path)?;
    }
    Ok(())
}

/// From the front and from behind, side by side: what one view hides, the other shows.
fn draw(mesh: &TriMesh, report: &Report, path: &Path) -> Result<(), Failure> {
    let recording = marked(mesh, report);
    let (width, height) = (960, 720);
    let view = |direction: Vec3| {
        let points = recording.tracks.iter().flat_map(|track| track.mesh.positions.iter().copied());
        let camera = Some(Camera::framing(points, direction, width as f32 / height as f32));
        Renderer::new(&recording, Settings { width, height, supersampling: 3, camera })
    };
    let front = Camera::three_quarter();
    let behind = Vec3::new(-front.x, front.y, -front.z);
    Ok(write_png(&beside(&view(front)?.frame(0), &view(behind)?.frame(0)), path)?)
}

/// Two pictures of one size as one.
fn beside(left: &Image, right: &Image) -> Image {
    let rows = left.pixels.chunks(left.width).zip(right.pixels.chunks(right.width));
    let pixels = rows.flat_map(|(left, right)| left.iter().chain(right)).copied().collect();
    Image { width: left.width + right.width, height: left.height, pixels }
}

fn report_refusal(arguments: &Check, error: &Error) -> Result<(), Failure> {
    print_json(&json!({
        "file": arguments.file.display().to_string(), "ok": false, "problems": [{ "path": "", "message": error.to_string() }],
    }))?;
    Err(Failure::Reported)
}

fn as_json(arguments: &Check, file: &MeshFile, report: &Report, repaired: Option<&Repaired>) -> Value {
    let notes: Vec<String> = file.notes.iter().map(ToString::to_string).collect();
    let mut value = json!({
        "file": arguments.file.display().to_string(),
        "ok": report.is_clean(),
        "notes": notes,
        "report": examined(&file.mesh, report),
    });
    if let (Some(repaired), Some(path)) = (repaired, &arguments.repair) {
        value["repaired"] = json!({
            "file": path.display().to_string(),
            "ok": repaired.report.is_clean(),
            "actions": repaired.actions,
            "report": examined(&repaired.mesh, &repaired.report),
        });
    }
    value
}

/// A report, with the place of every defect.
fn examined(mesh: &TriMesh, report: &Report) -> Value {
    let told = |defect: &Defect| {
        json!({
            "what": defect.to_string(), "place": defect.place(mesh).to_array(), "advice": defect.advice(), "defect": defect,
        })
    };
    let defects: Vec<Value> = report.defects.iter().map(told).collect();
    json!({
        "vertices": report.vertices, "triangles": report.triangles, "components": report.components,
        "has_all_crossings": report.has_all_crossings, "defects": defects,
    })
}
