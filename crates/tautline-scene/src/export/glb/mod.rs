//! A recording as animated binary glTF 2.0, one node per track.
//!
//! Rigid motion moves the node, frame by frame. Deforming motion is a morph target per key frame, with linear
//! interpolation between neighbouring keys; see [`keys`] for how they are chosen. Solids and walls carry no
//! normals, which in glTF means flat shading; sheets and tubes carry smooth ones.

mod buffer;
mod keys;

use std::io::Write;
use std::path::Path;

use serde_json::{Map, Value, json};
use tautline::mesh::TriMesh;
use tautline::{Quat, Vec3};

use super::atomic::{io_error, write_atomically};
use crate::Error;
use crate::recording::{Motion, Recording, Surface, Track};
use crate::render::{linear_color, smooth_normals};
use buffer::{Buffer, Use};

/// Writes the recording. At frame 0 and at every key frame the file's positions are the recording's, but for the
/// rounding of one addition where a vertex is displaced from its place at the first frame.
///
/// # Errors
/// [`Error::Io`] if the file cannot be written, [`Error::Recording`] if the recording contradicts itself,
/// [`Error::Unsupported`] if the file would exceed the 4 GiB that the format can count.
pub fn write_glb(recording: &Recording, path: &Path) -> Result<(), Error> {
    let bytes = glb_bytes(recording)?;
    write_atomically(path, |out| out.write_all(&bytes).map_err(|e| io_error(path, e)))
}

/// What [`write_glb`] writes.
///
/// # Errors
/// As [`write_glb`], but for files.
pub fn glb_bytes(recording: &Recording) -> Result<Vec<u8>, Error> {
    recording.check()?;
    Document::new(recording).into_glb()
}

/// The parts of a glTF document, in the making.
struct Document<'a> {
    recording: &'a Recording,
    buffer: Buffer,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
    /// Meshes without morph targets so far, to be shared by tracks that look the same.
    shared: Vec<(&'a Track, usize)>,
    /// The colour and whether it is seen from both sides, of each material.
    looks: Vec<([u8; 3], bool)>,
    /// Accessor of the times of all frames, once there is one.
    frame_times: Option<usize>,
}

impl<'a> Document<'a> {
    fn new(recording: &'a Recording) -> Self {
        let mut document = Document {
            recording,
            buffer: Buffer::default(),
            nodes: Vec::new(),
            meshes: Vec::new(),
            materials: Vec::new(),
            samplers: Vec::new(),
            channels: Vec::new(),
            shared: Vec::new(),
            looks: Vec::new(),
            frame_times: None,
        };
        for track in &recording.tracks {
            document.add_track(track);
        }
        document
    }

    fn add_track(&mut self, track: &'a Track) {
        let node = self.nodes.len();
        match &track.motion {
            Motion::Still => {
                let mesh = self.shared_mesh(track);
                self.nodes.push(json!({ "name": track.name, "mesh": mesh }));
            }
            Motion::Rigid(poses) => {
                let mesh = self.shared_mesh(track);
                self.add_rigid(track, mesh, poses);
            }
            Motion::Deforming(shapes) => {
                let keys = keys::choose(shapes);
                let mesh = self.morphing_mesh(track, shapes, &keys);
                self.nodes.push(json!({ "name": track.name, "mesh": mesh }));
                if keys.len() > 1 {
                    self.animate_weights(node, &keys);
                }
            }
        }
    }

    fn add_rigid(&mut self, track: &Track, mesh: usize, poses: &[(Vec3, Quat)]) {
        let node = self.nodes.len();
        let translations: Vec<Vec3> = poses.iter().map(|pose| pose.0).collect();
        let rotations = continuous(poses.iter().map(|pose| pose.1));
        let mut value = json!({ "name": track.name, "mesh": mesh });
        if let (Some(translation), Some(rotation)) = (translations.first(), rotations.first()) {
            value["translation"] = json!(translation.to_array());
            value["rotation"] = json!(rotation.to_array());
        }
        self.nodes.push(value);
        if poses.windows(2).any(|pair| pair[0] != pair[1]) {
            let input = self.frame_times();
            let output = self.buffer.vec3s(&translations, Use::Animation);
            self.add_channel(node, "translation", input, output);
            let output = self.buffer.quats(&rotations);
            self.add_channel(node, "rotation", input, output);
        }
    }

    /// Weights that are 1 at their own key and 0 at all others; the first key is the mesh itself.
    fn animate_weights(&mut self, node: usize, keys: &[usize]) {
        let targets = keys.len() - 1;
        let times: Vec<f32> = keys.iter().map(|&frame| self.recording.time_of(frame)).collect();
        let mut weights = vec![0.0; keys.len() * targets];
        for key in 1..keys.len() {
            weights[key * targets + key - 1] = 1.0;
        }
        let input = self.buffer.scalars(&times);
        let output = self.buffer.scalars(&weights);
        self.add_channel(node, "weights", input, output);
    }

    fn add_channel(&mut self, node: usize, property: &str, input: usize, output: usize) {
        let sampler = self.samplers.len();
        self.samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
        self.channels.push(json!({ "sampler": sampler, "target": { "node": node, "path": property } }));
    }

    fn frame_times(&mut self) -> usize {
        if let Some(accessor) = self.frame_times {
            return accessor;
        }
        let times: Vec<f32> = (0..self.recording.frame_count()).map(|f| self.recording.time_of(f)).collect();
        let accessor = self.buffer.scalars(&times);
        self.frame_times = Some(accessor);
        accessor
    }

    fn shared_mesh(&mut self, track: &'a Track) -> usize {
        let looks_the_same = |other: &Track| {
            other.mesh == track.mesh && other.surface == track.surface && other.color == track.color
        };
        if let Some(&(_, mesh)) = self.shared.iter().find(|(other, _)| looks_the_same(other)) {
            return mesh;
        }
        // Another colour still shares the geometry.
        let alike = |other: &Track| other.mesh == track.mesh && is_smooth(other) == is_smooth(track);
        let geometry = self.shared.iter().find(|(other, _)| alike(other)).map(|&(_, mesh)| mesh);
        let material = self.material(track);
        let primitive = match geometry {
            Some(mesh) => {
                let mut primitive = self.meshes[mesh]["primitives"][0].clone();
                primitive["material"] = json!(material);
                primitive
            }
            None => self.primitive(&track.mesh, &track.mesh.positions, is_smooth(track), material),
        };
        let mesh = self.push_mesh(json!({ "name": track.name, "primitives": [primitive] }));
        self.shared.push((track, mesh));
        mesh
    }

    fn morphing_mesh(&mut self, track: &Track, shapes: &[Vec<Vec3>], keys: &[usize]) -> usize {
        let material = self.material(track);
        let smooth = is_smooth(track);
        let first = shapes.first().unwrap_or(&track.mesh.positions);
        let mut primitive = self.primitive(&track.mesh, first, smooth, material);
        let first_normals = smooth_normals(first, &track.mesh.triangles);
        let targets: Vec<Value> = keys
            .iter()
            .skip(1)
            .map(|&key| {
                let moved = self.buffer.vec3s(&differences(&shapes[key], first), Use::Vertex);
                let mut target = json!({ "POSITION": moved });
                if smooth {
                    let normals = smooth_normals(&shapes[key], &track.mesh.triangles);
                    target["NORMAL"] =
                        json!(self.buffer.vec3s(&differences(&normals, &first_normals), Use::Vertex));
                }
                target
            })
            .collect();
        if targets.is_empty() {
            return self.push_mesh(json!({ "name": track.name, "primitives": [primitive] }));
        }
        let weights = vec![0.0; targets.len()];
        primitive["targets"] = Value::Array(targets);
        self.push_mesh(json!({ "name": track.name, "primitives": [primitive], "weights": weights }))
    }

    fn push_mesh(&mut self, mesh: Value) -> usize {
        self.meshes.push(mesh);
        self.meshes.len() - 1
    }

    fn primitive(&mut self, mesh: &TriMesh, positions: &[Vec3], smooth: bool, material: usize) -> Value {
        let mut attributes = Map::new();
        attributes.insert("POSITION".into(), json!(self.buffer.vec3s(positions, Use::Vertex)));
        if smooth {
            let normals = smooth_normals(positions, &mesh.triangles);
            attributes.insert("NORMAL".into(), json!(self.buffer.vec3s(&normals, Use::Vertex)));
        }
        let indices = self.buffer.indices(&mesh.triangles);
        json!({ "attributes": attributes, "indices": indices, "material": material })
    }

    fn material(&mut self, track: &Track) -> usize {
        let look = (track.color, track.surface == Surface::Sheet);
        if let Some(material) = self.looks.iter().position(|&known| known == look) {
            return material;
        }
        let [r, g, b] = linear_color(track.color).to_array();
        self.looks.push(look);
        self.materials.push(json!({
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.7,
            },
            "doubleSided": look.1,
        }));
        self.materials.len() - 1
    }

    /// The whole file.
    fn into_glb(self) -> Result<Vec<u8>, Error> {
        let mut root = json!({
            "asset": {
                "version": "2.0",
                "generator": concat!("tautline ", env!("CARGO_PKG_VERSION")),
            },
            "scene": 0,
            "scenes": [{ "name": self.recording.name }],
        });
        let all_nodes: Vec<usize> = (0..self.nodes.len()).collect();
        if !all_nodes.is_empty() {
            root["scenes"][0]["nodes"] = json!(all_nodes);
        }
        if !self.channels.is_empty() {
            let (channels, samplers) = (self.channels, self.samplers);
            root["animations"] =
                json!([{ "name": self.recording.name, "channels": channels, "samplers": samplers }]);
        }
        // glTF allows no empty lists.
        for (key, list) in [("nodes", self.nodes), ("meshes", self.meshes), ("materials", self.materials)] {
            if !list.is_empty() {
                root[key] = Value::Array(list);
            }
        }
        self.buffer.into_glb(root)
    }
}

fn is_smooth(track: &Track) -> bool {
    matches!(track.surface, Surface::Sheet | Surface::Round)
}

fn differences(to: &[Vec3], from: &[Vec3]) -> Vec<Vec3> {
    to.iter().zip(from).map(|(&to, &from)| to - from).collect()
}

/// The same rotations as unit quaternions, each in the hemisphere of the one before, so that interpolation takes
/// the short way round. Those that are unit up to rounding keep their bits.
fn continuous(rotations: impl Iterator<Item = Quat>) -> Vec<Quat> {
    let mut before = Quat::IDENTITY;
    rotations
        .map(|q| {
            let length_squared = q.length_squared();
            let unit = match length_squared {
                _ if (length_squared - 1.0).abs() < 1e-5 => q,
                _ if length_squared > 1e-20 => q.normalize(),
                _ => before,
            };
            before = if unit.dot(before) < 0.0 { -unit } else { unit };
            before
        })
        .collect()
}
