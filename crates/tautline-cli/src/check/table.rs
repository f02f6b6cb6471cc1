//! What the doctor says, for people.

use std::path::Path;

use tautline::mesh::TriMesh;
use tautline::mesh::doctor::{Action, Defect, Repaired, Report};
use tautline_scene::mesh_file::MeshFile;

use crate::output::{self, counted};

/// Defects of a kind that are named one by one.
const NAMED: usize = 5;

/// What the file holds, a table of what is wrong with it, and what it is good for.
pub(super) fn examination(path: &Path, file: &MeshFile, report: &Report) -> String {
    let mut text = format!("{}: {}\n", path.display(), summary(&file.mesh, report));
    if !file.notes.is_empty() {
        let notes: Vec<String> = file.notes.iter().map(ToString::to_string).collect();
        text += &format!("passed over: {}\n", notes.join(", "));
    }
    text += &defects(&file.mesh, report);
    text + &verdict(report)
}

/// What was done, and what remains.
pub(super) fn treatment(path: &Path, repaired: &Repaired) -> String {
    let mut text = "\nrepair\n".to_owned();
    let is_filling = |action: &&Action| matches!(action, Action::Filled { .. });
    let (fillings, others): (Vec<&Action>, Vec<&Action>) = repaired.actions.iter().partition(is_filling);
    for action in others.iter().chain(fillings.iter().take(NAMED)) {
        text += &format!("  {action}\n");
    }
    if fillings.len() > NAMED {
        text += &format!("  … and {} more holes\n", fillings.len() - NAMED);
    }
    if repaired.actions.is_empty() {
        text += "  there was nothing that it could do\n";
    }
    text += &format!("{}: {}\n", path.display(), summary(&repaired.mesh, &repaired.report));
    text += &defects(&repaired.mesh, &repaired.report);
    text + &verdict(&repaired.report)
}

fn summary(mesh: &TriMesh, report: &Report) -> String {
    let corners = mesh.triangles.as_flattened().iter().filter_map(|&v| mesh.positions.get(v as usize));
    let finite = corners.filter(|position| position.is_finite());
    let (low, high) = finite
        .fold((tautline::Vec3::INFINITY, tautline::Vec3::NEG_INFINITY), |(low, high), &p| {
            (low.min(p), high.max(p))
        });
    let size = if low.x <= high.x { high - low } else { tautline::Vec3::ZERO };
    let closed = report.components.iter().filter(|component| component.is_closed).count();
    let volume: f64 = report.components.iter().map(|component| component.volume).sum();
    format!(
        "{}, {}, {} × {} × {}; {}, {closed} closed, volume {}",
        counted(report.vertices, ["vertex", "vertices"]),
        counted(report.triangles, ["triangle", "triangles"]),
        number(size.x.into()),
        number(size.y.into()),
        number(size.z.into()),
        counted(report.components.len(), ["component", "components"]),
        number(volume),
    )
}

fn defects(mesh: &TriMesh, report: &Report) -> String {
    if report.is_clean() {
        return String::new();
    }
    let mut rows = Vec::new();
    for kind in report.defects.chunk_by(|a, b| a.name() == b.name()) {
        let more = if matches!(kind[0], Defect::Crossing { .. }) && !report.has_all_crossings {
            " or more"
        } else {
            ""
        };
        rows.push(vec![format!("{}: {}{more}", kind[0].name(), kind.len())]);
        for defect in kind.iter().take(NAMED) {
            let place = defect.place(mesh);
            let place = place.to_array().map(|coordinate| number(coordinate.into()));
            rows.push([&[format!("  {defect}")], &place[..]].concat());
        }
        if kind.len() > NAMED {
            rows.push(vec![format!("  … and {} more", kind.len() - NAMED)]);
        }
        rows.push(vec![format!("  → {}", kind[0].advice())]);
    }
    "\n".to_owned() + &table(&rows) + "\n"
}

/// A table whose widest sentences do not push the places away.
fn table(rows: &[Vec<String>]) -> String {
    let with_place: Vec<Vec<String>> = rows.iter().filter(|row| row.len() > 1).cloned().collect();
    let text = output::table(&["defect", "x", "y", "z"], &with_place);
    let mut lines = text.lines();
    let mut out = lines.next().map_or_else(String::new, |header| header.to_owned() + "\n");
    for row in rows {
        let line = if row.len() > 1 { lines.next() } else { row.first().map(String::as_str) };
        out += line.unwrap_or_default();
        out.push('\n');
    }
    out
}

fn verdict(report: &Report) -> String {
    let said = if report.is_clean() {
        "no defects: a closed surface, which bounds a solid"
    } else if report.is_clean_but_open() {
        "open: a cloth can be made of it, a solid cannot"
    } else if report.defects.iter().all(|defect| matches!(defect, Defect::Crossing { .. })) {
        "closed, but it crosses itself: a rigid body can be made of it, a truss or a soft solid cannot"
    } else {
        "neither a solid nor a cloth can be made of it as it is"
    };
    format!("{said}\n")
}

/// Five digits.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e5 => {
            let digits = 4
                - i32::from(value.abs() >= 10.0)
                - i32::from(value.abs() >= 100.0)
                - i32::from(value.abs() >= 1000.0);
            format!("{value:.*}", digits.max(0) as usize)
        }
        _ => format!("{value:.2e}"),
    }
}
