//! A recording as one page of HTML that plays it: it needs nothing but a browser, and asks for nothing.
//!
//! The page is a template with the player in it, made from `playground/src/replay` by `cargo xtask web`. The recording
//! goes into it as two blocks of data: a description in JSON, and the numbers ([`numbers`]).

mod numbers;

use std::io::Write;
use std::path::Path;

use serde_json::{Value, json};

use super::atomic::{io_error, write_atomically};
use crate::Error;
use crate::recording::{Motion, Recording, Surface, Track};
use crate::render::Camera;
use numbers::Numbers;

/// The page around the recording.
const TEMPLATE: &str = include_str!("replay.html");
/// Where the recording goes.
const PLACE: &str = "<!--recording-->";

/// Writes the recording as a page. Seen from `camera`; a view of everything if there is none. Coordinates are rounded to
/// 1/65535 of the extent of each motion, rotations to 1/32767.
///
/// # Errors
/// [`Error::Io`] if the file cannot be written, [`Error::Recording`] if the recording contradicts itself.
pub fn write_html(recording: &Recording, camera: Option<Camera>, path: &Path) -> Result<(), Error> {
    let page = html(recording, camera)?;
    write_atomically(path, |out| out.write_all(page.as_bytes()).map_err(|e| io_error(path, e)))
}

/// The page that [`write_html`] writes.
///
/// # Errors
/// [`Error::Recording`] if the recording contradicts itself.
pub fn html(recording: &Recording, camera: Option<Camera>) -> Result<String, Error> {
    recording.check()?;
    let mut numbers = Numbers::default();
    let description = describe(recording, camera, &mut numbers);
    let (before, after) = TEMPLATE.split_once(PLACE).unwrap_or((TEMPLATE, ""));
    let description = without_markup(&description.to_string());
    let numbers = numbers.into_base64();
    let description = format!("<script type=\"application/json\" id=\"recording\">{description}</script>");
    let numbers = format!("<script type=\"application/octet-stream\" id=\"numbers\">{numbers}</script>");
    Ok([before, &description, "\n", &numbers, after].concat())
}

/// JSON in which nothing can be taken for a tag, whatever a scene is called.
fn without_markup(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// What there is, in the order in which its numbers follow.
fn describe(recording: &Recording, camera: Option<Camera>, numbers: &mut Numbers) -> Value {
    let (mut meshes, mut tracks) = (Meshes::default(), Vec::new());
    let places: Vec<usize> = recording.tracks.iter().map(|track| meshes.add(track, numbers)).collect();
    for (track, mesh) in recording.tracks.iter().zip(places) {
        let motion = match &track.motion {
            Motion::Still => json!("still"),
            Motion::Rigid(poses) => json!({ "rigid": numbers.poses(poses) }),
            Motion::Deforming(shapes) => json!({ "deforming": numbers.shapes(shapes) }),
        };
        let [r, g, b] = track.color.map(u32::from);
        tracks.push(json!({
            "name": track.name, "color": r << 16 | g << 8 | b, "surface": surface(track), "mesh": mesh, "motion": motion,
        }));
    }
    let camera = camera.map(|Camera { eye, target, vertical_fov }| {
        json!({ "eye": eye.to_array(), "target": target.to_array(), "fov": vertical_fov.to_degrees() })
    });
    json!({
        "name": recording.name, "frameRate": recording.frame_rate, "frames": recording.frame_count(), "camera": camera,
        "meshes": meshes.sizes, "tracks": tracks,
    })
}

/// Meshes, each once.
#[derive(Default)]
struct Meshes<'a> {
    known: Vec<&'a Track>,
    /// Vertices and triangles of each.
    sizes: Vec<[usize; 2]>,
}

impl<'a> Meshes<'a> {
    /// The number of a track's mesh, whose numbers are added if it is another one than all before.
    fn add(&mut self, track: &'a Track, numbers: &mut Numbers) -> usize {
        if let Some(place) = self.known.iter().position(|known| known.mesh == track.mesh) {
            return place;
        }
        numbers.mesh(&track.mesh);
        self.known.push(track);
        self.sizes.push([track.mesh.positions.len(), track.mesh.triangles.len()]);
        self.sizes.len() - 1
    }
}

fn surface(track: &Track) -> &'static str {
    match track.surface {
        Surface::Solid => "solid",
        Surface::Sheet => "sheet",
        Surface::Round => "round",
        Surface::Wall => "wall",
    }
}
