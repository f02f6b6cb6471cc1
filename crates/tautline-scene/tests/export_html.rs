//! Recordings as pages: what is in them is what was recorded, and none of it can become markup.

mod recordings;

use std::io::Read;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::read::DeflateDecoder;
use serde_json::Value;
use tautline::Vec3;
use tautline_scene::export::html;
use tautline_scene::recording::{Motion, Recording};
use tautline_scene::render::Camera;

/// The two blocks of a page: what is said of the recording, and its numbers.
fn blocks(page: &str) -> (Value, Vec<u8>) {
    let block = |id: &str| {
        let (_, after) = page.split_once(&format!("id=\"{id}\">")).unwrap();
        after.split_once("</script>").unwrap().0
    };
    let packed = BASE64_STANDARD.decode(block("numbers")).unwrap();
    let mut numbers = Vec::new();
    DeflateDecoder::new(&packed[..]).read_to_end(&mut numbers).unwrap();
    (serde_json::from_str(block("recording")).unwrap(), numbers)
}

/// Reads numbers one after the other, as the player does.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take(&mut self, count: usize) -> &[u8] {
        let (taken, rest) = self.0.split_at(count);
        self.0 = rest;
        taken
    }

    /// Frames of `width` numbers, each frame as differences to the one before.
    fn rows(&mut self, width: usize, count: usize) -> Vec<Vec<u16>> {
        let mut row = vec![0_u16; width];
        let rows = (0..count).map(|_| {
            let bytes = self.take(2 * width);
            let steps = (0..width).map(|k| u16::from_le_bytes([bytes[k], bytes[width + k]]));
            row = row.iter().zip(steps).map(|(value, step)| value.wrapping_add(step)).collect();
            row.clone()
        });
        rows.collect()
    }
}

/// A row's numbers from `first` on as a point of the box, in m.
fn point(row: &[u16], first: usize, bounds: &Value) -> Vec3 {
    let axis = |k: usize| {
        let part = |name: &str| bounds[name][k].as_f64().unwrap() as f32;
        part("low") + part("extent") * f32::from(row[first + k]) / 65535.0
    };
    Vec3::new(axis(0), axis(1), axis(2))
}

/// The farthest that anything in the page is from where it was recorded, in m.
fn greatest_error(recording: &Recording) -> f32 {
    let (description, numbers) = blocks(&html(recording, None).unwrap());
    let mut reader = Reader(&numbers);
    for mesh in description["meshes"].as_array().unwrap() {
        let count = |k: usize| mesh[k].as_u64().unwrap() as usize;
        reader.take(12 * (count(0) + count(1)));
    }
    let mut greatest = 0.0_f32;
    for (track, said) in recording.tracks.iter().zip(description["tracks"].as_array().unwrap()) {
        assert_eq!(said["name"], track.name);
        match &track.motion {
            Motion::Still => assert_eq!(said["motion"], "still"),
            Motion::Rigid(poses) => {
                for (row, &(position, rotation)) in reader.rows(7, poses.len()).iter().zip(poses) {
                    greatest = greatest.max(point(row, 0, &said["motion"]["rigid"]).distance(position));
                    for (k, component) in rotation.to_array().into_iter().enumerate() {
                        greatest = greatest.max((f32::from(row[3 + k] as i16) / 32767.0 - component).abs());
                    }
                }
            }
            Motion::Deforming(shapes) => {
                let width = 3 * track.mesh.positions.len();
                for (row, shape) in reader.rows(width, shapes.len()).iter().zip(shapes) {
                    for (k, &position) in shape.iter().enumerate() {
                        let found = point(row, 3 * k, &said["motion"]["deforming"]);
                        greatest = greatest.max(found.distance(position));
                    }
                }
            }
        }
    }
    assert!(reader.0.is_empty(), "nothing is left over");
    greatest
}

#[test]
fn everything_is_where_it_was_recorded() {
    for recording in [recordings::icosahedra(12, 20), recordings::sheet_and_tube(12, 10)] {
        let error = greatest_error(&recording);
        assert!(error < 2e-4, "{}: {error} m", recording.name);
    }
}

#[test]
fn bodies_of_one_shape_share_their_mesh() {
    let (description, _) = blocks(&html(&recordings::icosahedra(12, 2), None).unwrap());
    let meshes = description["meshes"].as_array().unwrap().len();
    assert!(meshes < 12, "{meshes} meshes");
}

#[test]
fn the_camera_is_passed_on() {
    let camera = Camera { eye: Vec3::new(1.0, 2.0, 3.0), target: Vec3::Y, vertical_fov: 0.5 };
    let (description, _) = blocks(&html(&recordings::icosahedra(1, 2), Some(camera)).unwrap());
    assert_eq!(description["camera"]["eye"], serde_json::json!([1.0, 2.0, 3.0]));
}

#[test]
fn no_name_becomes_markup() {
    let mut recording = recordings::icosahedra(1, 2);
    let hostile = "</script><script>alert(1)</script><!--recording-->&amp;";
    recording.name = hostile.into();
    recording.tracks[0].name = hostile.into();
    let page = html(&recording, None).unwrap();
    assert!(!page.contains("alert(1)</script>"));
    assert_eq!(page.matches("<!--recording-->").count(), 0);
    assert_eq!(blocks(&page).0["name"], hostile);
}
