//! Animated glTF: read back by a small reader, and judged by the Khronos validator.

mod recordings;

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use serde_json::Value;
use tautline::{Quat, Vec3};
use tautline_scene::export::write_glb;
use tautline_scene::recording::{Motion, Recording};

/// A GLB file, taken apart.
struct Glb {
    json: Value,
    binary: Vec<u8>,
}

impl Glb {
    fn of(recording: &Recording) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.glb");
        write_glb(recording, &path).unwrap();
        let bytes = fs::read(path).unwrap();
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
        let json_end = 20 + number(12);
        assert_eq!((&bytes[16..20], &bytes[json_end + 4..json_end + 8]), (&b"JSON"[..], &b"BIN\0"[..]));
        assert_eq!(json_end + 8 + number(json_end), bytes.len());
        let json = serde_json::from_slice(&bytes[20..json_end]).unwrap();
        Self { json, binary: bytes[json_end + 8..].to_vec() }
    }

    fn floats(&self, accessor: &Value) -> Vec<f32> {
        let accessor = &self.json["accessors"][index(accessor)];
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            _ => 4,
        };
        let start = index(&self.json["bufferViews"][index(&accessor["bufferView"])]["byteOffset"]);
        let bytes = &self.binary[start..start + 4 * width * index(&accessor["count"])];
        bytes.chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn vec3s(&self, accessor: &Value) -> Vec<Vec3> {
        self.floats(accessor).chunks(3).map(Vec3::from_slice).collect()
    }

    fn primitive(&self, node: &Value) -> &Value {
        &self.json["meshes"][index(&node["mesh"])]["primitives"][0]
    }

    /// Times and values of an animated property of a node.
    fn channel(&self, node: usize, property: &str) -> (Vec<f32>, &Value) {
        let animation = &self.json["animations"][0];
        let channels = animation["channels"].as_array().unwrap().iter();
        let mut ours = channels.filter(|c| c["target"]["node"] == node && c["target"]["path"] == property);
        let sampler = &animation["samplers"][index(&ours.next().unwrap()["sampler"])];
        (self.floats(&sampler["input"]), &sampler["output"])
    }
}

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

#[test]
fn rigid_motion_reads_back_to_the_bit() {
    let recording = recordings::icosahedra(50, 40);
    let glb = Glb::of(&recording);
    for (node, track) in recording.tracks.iter().enumerate() {
        let value = &glb.json["nodes"][node];
        assert_eq!(value["name"], track.name);
        assert_eq!(glb.vec3s(&glb.primitive(value)["attributes"]["POSITION"]), track.mesh.positions);
        let Motion::Rigid(poses) = &track.motion else { continue };
        let (times, output) = glb.channel(node, "translation");
        assert_eq!(times, (0..40).map(|f| recording.time_of(f)).collect::<Vec<_>>());
        assert_eq!(glb.vec3s(output), poses.iter().map(|p| p.0).collect::<Vec<_>>());
        let (_, output) = glb.channel(node, "rotation");
        let rotations: Vec<Quat> = glb.floats(output).chunks(4).map(Quat::from_slice).collect();
        assert!(rotations.iter().zip(poses).all(|(&q, &(_, p))| q == p || q == -p));
        assert!(rotations.windows(2).all(|pair| pair[0].dot(pair[1]) >= 0.0));
    }
}

#[test]
fn bodies_that_look_the_same_share_what_they_can() {
    let glb = Glb::of(&recordings::icosahedra(50, 3));
    let bodies: Vec<&Value> = glb.json["nodes"].as_array().unwrap()[6..].iter().collect();
    let geometry = &glb.primitive(bodies[0])["attributes"];
    assert!(bodies.iter().all(|body| &glb.primitive(body)["attributes"] == geometry));
    // Six walls, and icosahedra in six colours.
    assert_eq!(glb.json["meshes"].as_array().unwrap().len(), 6 + 6);
    assert_eq!(glb.json["materials"].as_array().unwrap().len(), 1 + 6);
}

#[test]
fn deforming_motion_reads_back_at_every_key_and_ends_on_the_last_frame() {
    let recording = recordings::sheet_and_tube(12, 50);
    let glb = Glb::of(&recording);
    for (node, track) in recording.tracks.iter().enumerate() {
        let Motion::Deforming(shapes) = &track.motion else { continue };
        let primitive = glb.primitive(&glb.json["nodes"][node]);
        let first = glb.vec3s(&primitive["attributes"]["POSITION"]);
        assert_eq!(first, shapes[0]);
        let targets = primitive["targets"].as_array().unwrap();
        let (times, output) = glb.channel(node, "weights");
        let weights = glb.floats(output);
        assert_eq!(times[times.len() - 1], recording.time_of(49));
        assert!(targets.len() < 60 && weights.len() == times.len() * targets.len());
        for (key, (time, weights)) in times.iter().zip(weights.chunks(targets.len())).enumerate() {
            let mut place = first.clone();
            for (target, &weight) in targets.iter().zip(weights) {
                let moved = glb.vec3s(&target["POSITION"]);
                place.iter_mut().zip(moved).for_each(|(p, d)| *p += d * weight);
            }
            let frame = (time * recording.frame_rate).round() as usize;
            // One rounding of a sum of coordinates of at most 4 m.
            assert!(place.iter().zip(&shapes[frame]).all(|(a, b)| a.distance(*b) < 1e-6), "key {key}");
        }
    }
}

#[test]
fn sheets_and_tubes_have_unit_normals_and_solids_none() {
    let glb = Glb::of(&recordings::sheet_and_tube(8, 5));
    let nodes = glb.json["nodes"].as_array().unwrap();
    assert!(nodes[..2].iter().all(|node| glb.primitive(node)["attributes"]["NORMAL"].is_null()));
    for node in &nodes[2..] {
        let normals = glb.vec3s(&glb.primitive(node)["attributes"]["NORMAL"]);
        assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
    }
}

#[test]
fn the_khronos_validator_has_no_complaints() {
    let folder = tempfile::tempdir().unwrap();
    let nothing = Recording { name: "nothing".into(), frame_rate: 25.0, tracks: vec![] };
    let spun = {
        // Quaternions as an engine might leave them: not quite unit, and one that is none.
        let mut spun = recordings::icosahedra(2, 4);
        if let Some(Motion::Rigid(poses)) = spun.tracks.last_mut().map(|track| &mut track.motion) {
            poses[1].1 *= 1.3;
            poses[2].1 = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        }
        spun
    };
    let all = [
        nothing,
        spun,
        recordings::icosahedra(50, 30),
        recordings::icosahedra(3, 1),
        recordings::sheet_and_tube(10, 90),
        recordings::sheet_and_tube(10, 1),
    ];
    let paths = all.iter().enumerate().map(|(i, recording)| {
        let path = folder.path().join(format!("{i}.glb"));
        write_glb(recording, &path).unwrap();
        path
    });
    let paths: Vec<_> = paths.collect();

    let validator = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/gltf-validator");
    let installed = validator.join("node_modules/gltf-validator").is_dir();
    let node = Command::new("node").arg("--version").output().is_ok_and(|out| out.status.success());
    if !(installed && node) {
        assert!(
            env::var_os("CI").is_none_or(|ci| ci != "true"),
            "CI needs node and `npm ci` in {validator:?}"
        );
        eprintln!("left out: the Khronos validator (it needs node, and `npm ci` in tests/gltf-validator)");
        return;
    }
    let report = Command::new("node").arg(validator.join("validate.mjs")).args(&paths).output().unwrap();
    let messages =
        String::from_utf8_lossy(&report.stdout).into_owned() + &String::from_utf8_lossy(&report.stderr);
    assert!(report.status.success(), "{messages}");
}
