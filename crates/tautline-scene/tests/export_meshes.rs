//! Point caches, arrays and meshes for each frame: read back as their own readers do.

mod recordings;

use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;

use tautline::Vec3;
use tautline_scene::Error;
use tautline_scene::export::{self, Options, frame_path, mesh_path};
use tautline_scene::recording::{Motion, Recording};

fn write(recording: &Recording, path: &Path) -> Result<(), Error> {
    export::write(recording, path, &Options::default(), &mut |_, _| {})
}

/// Something rigid, something that deforms and something that stays, in a folder of its own.
fn recording() -> (Recording, tempfile::TempDir) {
    let mut recording = recordings::icosahedra(2, 5);
    recording.tracks.extend(recordings::sheet_and_tube(6, 5).tracks.into_iter().map(|mut track| {
        track.name += " of another";
        track
    }));
    recording.check().unwrap();
    assert!(recording.tracks.iter().any(|track| matches!(track.motion, Motion::Deforming(_))));
    assert!(recording.tracks.iter().any(|track| matches!(track.motion, Motion::Rigid(_))));
    (recording, tempfile::tempdir().unwrap())
}

fn positions(recording: &Recording, frame: usize) -> Vec<Vec3> {
    recording.tracks.iter().flat_map(|track| track.positions_at(frame).into_owned()).collect()
}

fn i32_at(bytes: &[u8], at: usize) -> i32 {
    i32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn f32_at(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn vec3_at(bytes: &[u8], at: usize) -> Vec3 {
    Vec3::new(f32_at(bytes, at), f32_at(bytes, at + 4), f32_at(bytes, at + 8))
}

/// The vertices and triangles of an OBJ, objects in a row.
fn read_obj(path: &Path) -> (Vec<Vec3>, Vec<u32>) {
    let (objects, _) = tobj::load_obj(path, &tobj::LoadOptions::default()).unwrap();
    let mut all = (Vec::new(), Vec::new());
    for object in objects {
        // The reader counts each object's vertices from 0, and drops none: all of ours are used.
        let first = all.0.len() as u32;
        all.0.extend(object.mesh.positions.chunks(3).map(Vec3::from_slice));
        all.1.extend(object.mesh.indices.iter().map(|index| first + index));
    }
    all
}

#[test]
fn a_point_cache_has_the_layout_that_blender_reads_and_its_mesh_beside_it() {
    let (recording, folder) = recording();
    let path = folder.path().join("a.pc2");
    write(&recording, &path).unwrap();
    let bytes = fs::read(&path).unwrap();
    let count = positions(&recording, 0).len();
    // '<12siiffi' in Python's notation.
    assert_eq!(&bytes[..12], b"POINTCACHE2\0");
    assert_eq!([i32_at(&bytes, 12), i32_at(&bytes, 16)], [1, count as i32]);
    assert_eq!([f32_at(&bytes, 20), f32_at(&bytes, 24)], [0.0, 1.0]);
    assert_eq!(i32_at(&bytes, 28), 5);
    assert_eq!(bytes.len(), 32 + 5 * count * 12);
    for frame in 0..5 {
        for (i, expected) in positions(&recording, frame).into_iter().enumerate() {
            assert_eq!(vec3_at(&bytes, 32 + (frame * count + i) * 12), expected);
        }
    }
    let text = fs::read_to_string(mesh_path(&path)).unwrap();
    assert_eq!(text.lines().filter(|line| line.starts_with("v ")).count(), count);
    assert!(
        !text.contains("\no ") && !text.starts_with("o "),
        "one object, of as many vertices as the cache"
    );
}

#[test]
fn an_obj_for_each_frame_reads_back_to_the_bit() {
    let (recording, folder) = recording();
    let path = folder.path().join("a.obj");
    let mut calls = Vec::new();
    export::write(&recording, &path, &Options::default(), &mut |done, total| calls.push((done, total)))
        .unwrap();
    assert_eq!(calls, [(1, 5), (2, 5), (3, 5), (4, 5), (5, 5)]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 5);
    let corners = |positions: &[Vec3], indices: &[u32]| -> Vec<Vec3> {
        indices.iter().map(|&index| positions[index as usize]).collect()
    };
    let mut first = 0;
    let mut indices = Vec::new();
    for track in &recording.tracks {
        indices.extend(track.mesh.triangles.iter().flatten().map(|corner| first + corner));
        first += track.mesh.positions.len() as u32;
    }
    for frame in 0..5 {
        let (read, read_indices) = read_obj(&frame_path(&path, frame, 5));
        // Readers number vertices as they please; what the triangles' corners are is no matter of taste.
        assert_eq!(corners(&read, &read_indices), corners(&positions(&recording, frame), &indices));
    }
}

#[test]
fn a_ply_for_each_frame_reads_back_to_the_bit() {
    let (recording, folder) = recording();
    let path = folder.path().join("a.ply");
    write(&recording, &path).unwrap();
    for frame in 0..5 {
        let bytes = fs::read(frame_path(&path, frame, 5)).unwrap();
        let end = bytes.windows(11).position(|word| word == b"end_header\n").unwrap() + 11;
        let header = std::str::from_utf8(&bytes[..end]).unwrap();
        let expected = positions(&recording, frame);
        let faces: usize = recording.tracks.iter().map(|track| track.mesh.triangles.len()).sum();
        assert!(header.starts_with("ply\nformat binary_little_endian 1.0\n"));
        assert!(header.contains(&format!("element vertex {}\n", expected.len())), "{header}");
        assert!(header.contains(&format!("element face {faces}\n")), "{header}");
        for (i, &position) in expected.iter().enumerate() {
            assert_eq!(vec3_at(&bytes, end + 15 * i), position);
        }
        let lists = end + 15 * expected.len();
        assert_eq!(bytes.len(), lists + 13 * faces);
        let first = recording.tracks[0].mesh.triangles[0].map(|corner| corner as i32);
        assert_eq!(bytes[lists], 3);
        assert_eq!([1, 5, 9].map(|at| i32_at(&bytes, lists + at)), first);
        let last = expected.len() as i32;
        let within = |face: usize| [1, 5, 9].iter().all(|at| i32_at(&bytes, lists + 13 * face + at) < last);
        assert!((0..faces).all(within));
    }
}

/// The header's text and the numbers of an array in an archive.
fn array(archive: &mut zip::ZipArchive<Cursor<Vec<u8>>>, name: &str) -> (String, Vec<u8>) {
    let mut bytes = Vec::new();
    archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!((start % 64, bytes[start - 1]), (0, b'\n'));
    (String::from_utf8(bytes[10..start].to_vec()).unwrap(), bytes.split_off(start))
}

#[test]
fn an_npz_holds_every_motion_to_the_bit() {
    let (recording, folder) = recording();
    let path = folder.path().join("a.npz");
    write(&recording, &path).unwrap();
    let mut archive = zip::ZipArchive::new(Cursor::new(fs::read(&path).unwrap())).unwrap();
    let (header, times) = array(&mut archive, "times");
    assert!(header.contains("'<f4'") && header.contains("(5,)"), "{header}");
    assert_eq!(f32_at(&times, 16), recording.time_of(4));
    for track in &recording.tracks {
        let (header, triangles) = array(&mut archive, &format!("{}/triangles", track.name));
        assert!(header.contains(&format!("({},3,)", track.mesh.triangles.len())), "{header}");
        assert_eq!(triangles.len(), 12 * track.mesh.triangles.len());
        match &track.motion {
            Motion::Still => {}
            Motion::Rigid(poses) => {
                let (header, numbers) = array(&mut archive, &format!("{}/poses", track.name));
                assert!(header.contains("(5,7,)"), "{header}");
                assert_eq!(vec3_at(&numbers, 4 * 28), poses[4].0);
                assert_eq!(f32_at(&numbers, 4 * 28 + 24), poses[4].1.w);
            }
            Motion::Deforming(shapes) => {
                let (header, numbers) = array(&mut archive, &format!("{}/positions", track.name));
                assert!(header.contains(&format!("(5,{},3,)", shapes[0].len())), "{header}");
                let all: Vec<Vec3> = numbers.chunks(12).map(|bytes| vec3_at(bytes, 0)).collect();
                assert_eq!(all, shapes.concat());
            }
        }
    }
    let again = folder.path().join("b.npz");
    write(&recording, &again).unwrap();
    assert_eq!(fs::read(&path).unwrap(), fs::read(again).unwrap(), "the same recording, the same bytes");
}

#[test]
fn without_ffmpeg_a_film_is_refused_and_what_was_there_stays() {
    let (recording, folder) = recording();
    let path = folder.path().join("a.mp4");
    fs::write(&path, "kept").unwrap();
    let absent = folder.path().join("no-such-program");
    let picture = Options::default().picture;
    let refusal = export::write_mp4(&recording, &path, picture, absent.as_os_str(), &mut |_, _| {});
    let message = refusal.unwrap_err().to_string();
    assert!(message.contains("ffmpeg") && message.contains("does not start"), "{message}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "kept");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
}

#[test]
#[cfg(unix)]
fn an_encoder_that_refuses_is_quoted() {
    use std::os::unix::fs::PermissionsExt;
    let (recording, folder) = recording();
    let program = folder.path().join("ffmpeg");
    fs::write(&program, "#!/bin/sh\necho 'Unknown encoder libx264' >&2\nexit 1\n").unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let path = folder.path().join("a.mp4");
    let picture = Options::default().picture;
    let refusal = export::write_mp4(&recording, &path, picture, program.as_os_str(), &mut |_, _| {});
    let message = refusal.unwrap_err().to_string();
    assert!(message.contains("Unknown encoder libx264"), "{message}");
    assert!(!path.exists());
}
