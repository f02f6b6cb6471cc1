//! What pictures show.

mod recordings;

use tautline::Vec3;
use tautline::mesh::TriMesh;
use tautline_scene::Error;
use tautline_scene::recording::{Motion, Recording, Surface, Track};
use tautline_scene::render::{Camera, Image, Renderer, Settings};

fn small() -> Settings {
    Settings { width: 160, height: 120, ..Settings::default() }
}

fn still(color: [u8; 3], surface: Surface, mesh: TriMesh) -> Recording {
    let name = "thing".into();
    let track = Track { name, color, surface, mesh, motion: Motion::Still };
    Recording { name: "test".into(), frame_rate: 30.0, tracks: vec![track] }
}

fn picture(recording: &Recording, settings: Settings) -> Image {
    Renderer::new(recording, settings).unwrap().frame(0)
}

fn at(image: &Image, x: usize, y: usize) -> [i32; 3] {
    image.pixels[y * image.width + x].map(i32::from)
}

/// Rows and columns that differ from an empty picture of the same size.
fn extent(image: &Image, empty: &Image) -> [usize; 4] {
    let changed = (0..image.pixels.len()).filter(|&i| image.pixels[i] != empty.pixels[i]);
    changed.fold([usize::MAX, usize::MAX, 0, 0], |[l, t, r, b], i| {
        let (x, y) = (i % image.width, i / image.width);
        [l.min(x), t.min(y), r.max(x), b.max(y)]
    })
}

#[test]
fn the_picture_frames_the_whole_motion() {
    let empty = picture(&Recording { name: String::new(), frame_rate: 1.0, tracks: vec![] }, small());
    for half in
        [Vec3::splat(0.5), Vec3::new(20.0, 0.1, 0.1), Vec3::new(0.1, 3.0, 0.1), Vec3::new(5.0, 0.01, 9.0)]
    {
        let mut recording = still([200, 60, 60], Surface::Solid, recordings::cuboid(half));
        for track in &mut recording.tracks {
            track.mesh.positions.iter_mut().for_each(|p| *p += Vec3::new(100.0, -7.0, 3.0));
        }
        let [left, top, right, bottom] = extent(&picture(&recording, small()), &empty);
        assert!(left > 0 && top > 0 && right < 159 && bottom < 119, "{half}: it is cut off");
        let share = ((right - left) as f32 / 160.0).max((bottom - top) as f32 / 120.0);
        assert!((0.84..0.92).contains(&share), "{half}: it fills {share} of the picture");
    }
}

#[test]
fn a_track_has_its_colour_and_the_corners_are_background() {
    let image = picture(&still([40, 70, 200], Surface::Solid, recordings::cuboid(Vec3::ONE)), small());
    let [r, g, b] = at(&image, 80, 60);
    assert!(b > g + 40 && g > r, "the middle is {r} {g} {b}");
    let [r, g, b] = at(&image, 0, 0);
    assert!(r > 200 && (b - r).abs() < 30 && (g - r).abs() < 30, "the corner is {r} {g} {b}");
}

#[test]
fn walls_are_seen_only_from_the_front() {
    let mut room = recordings::icosahedra(32, 1);
    let inside = picture(&room, small());
    // Turned inside out, the near walls hide everything.
    for track in room.tracks.iter_mut().filter(|track| track.surface == Surface::Wall) {
        track.mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    }
    let outside = picture(&room, small());
    let bluest =
        |image: &Image| image.pixels.iter().map(|p| i32::from(p[2]) - i32::from(p[0])).max().unwrap();
    assert!(bluest(&inside) > 60, "the bodies are in the room");
    assert!(bluest(&outside) < 40, "the bodies are behind walls");
}

#[test]
fn walls_cast_no_shadow() {
    let mut recording = recordings::sheet_and_tube(10, 1);
    let open = picture(&recording, small());
    // A ceiling is not seen from above, and does not keep the sun out.
    let mut ceiling = recording.tracks[0].clone();
    ceiling.mesh.positions.iter_mut().for_each(|p| p.y = 3.0);
    ceiling.mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    recording.tracks.push(ceiling);
    assert!(picture(&recording, small()) == open);
}

#[test]
fn things_cast_shadows_on_the_floor() {
    let mut recording = recordings::sheet_and_tube(10, 1);
    let camera = Some(Camera { eye: Vec3::new(0.0, 12.0, 0.1), target: Vec3::ZERO, vertical_fov: 0.6 });
    let settings = Settings { camera, ..small() };
    recording.tracks.truncate(2);
    let with_cube = picture(&recording, settings);
    recording.tracks.truncate(1);
    let floor_only = picture(&recording, settings);
    let darker = with_cube.pixels.iter().zip(&floor_only.pixels);
    let shadow = darker.filter(|(a, b)| (0..3).all(|c| i32::from(b[c]) - i32::from(a[c]) > 40)).count();
    // The sun is about 55° high: the shadow of a cube of 1 m is 0.7 m long at least.
    let metre = 120.0 / (2.0 * 12.0 * 0.3_f32.tan());
    assert!(shadow as f32 > 0.4 * metre * metre, "{shadow} pixels of shadow, a metre is {metre}");
}

#[test]
fn more_samples_smooth_edges_but_keep_the_picture() {
    let recording = recordings::icosahedra(20, 3);
    let [coarse, fine] =
        [1, 4].map(|supersampling| picture(&recording, Settings { supersampling, ..small() }));
    let difference = coarse.pixels.iter().flatten().zip(fine.pixels.iter().flatten());
    let mean = difference.map(|(&a, &b)| f64::from(a.abs_diff(b))).sum::<f64>() / fine.pixels.len() as f64;
    assert!(mean > 0.5 && mean < 15.0, "mean difference {mean}");
}

#[test]
fn degenerate_recordings_make_pictures_too() {
    let point = TriMesh { positions: vec![Vec3::ONE; 3], triangles: vec![[0, 1, 2]] };
    let line = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 0.5], triangles: vec![[0, 1, 2]] };
    let huge = recordings::cuboid(Vec3::splat(1e12));
    let tiny = recordings::cuboid(Vec3::splat(1e-12));
    for mesh in [point, line, huge, tiny] {
        for surface in [Surface::Solid, Surface::Sheet, Surface::Round, Surface::Wall] {
            let image = picture(&still([9, 9, 9], surface, mesh.clone()), small());
            assert_eq!(image.pixels.len(), 160 * 120);
        }
    }
}

#[test]
fn a_camera_inside_a_thing_sees_past_its_near_plane() {
    let recording = still([200, 30, 30], Surface::Sheet, recordings::cuboid(Vec3::ONE));
    let camera = Some(Camera { eye: Vec3::ZERO, target: Vec3::new(0.3, 0.2, -1.0), vertical_fov: 1.2 });
    let image = picture(&recording, Settings { camera, ..small() });
    let red = image.pixels.iter().filter(|p| i32::from(p[0]) > i32::from(p[2]) + 20).count();
    assert_eq!(red, image.pixels.len(), "a closed surface leaves no gap");
}

#[test]
fn impossible_settings_are_refused() {
    let recording = still([0; 3], Surface::Solid, recordings::cuboid(Vec3::ONE));
    let camera = |eye, vertical_fov| Some(Camera { eye, target: Vec3::ZERO, vertical_fov });
    for (settings, expected) in [
        (Settings { width: 0, ..small() }, "width"),
        (Settings { height: 9000, ..small() }, "height"),
        (Settings { supersampling: 5, ..small() }, "supersampling"),
        (Settings { camera: camera(Vec3::ZERO, 1.0), ..small() }, "camera"),
        (Settings { camera: camera(Vec3::NAN, 1.0), ..small() }, "camera"),
        (Settings { camera: camera(Vec3::ONE, f32::NAN), ..small() }, "camera"),
    ] {
        match Renderer::new(&recording, settings) {
            Err(Error::Unsupported { option, .. }) => assert_eq!(option, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
}

#[test]
fn recordings_that_contradict_themselves_are_refused() {
    type Spoil = fn(&mut Recording);
    let spoils: [(&str, Spoil); 6] = [
        ("frame rate", |r| r.frame_rate = 0.0),
        ("no triangles", |r| r.tracks[2].mesh.triangles.clear()),
        ("beyond", |r| r.tracks[2].mesh.triangles[0][1] = 99_999),
        ("another track has", |r| r.tracks[2].motion = Motion::Deforming(vec![])),
        ("positions for", |r| r.tracks[2].motion = Motion::Deforming(vec![vec![]; 3])),
        ("not finite", |r| r.tracks[1].mesh.positions[4].y = f32::INFINITY),
    ];
    assert!(recordings::sheet_and_tube(4, 3).check().is_ok());
    for (expected, spoil) in spoils {
        let mut recording = recordings::sheet_and_tube(4, 3);
        spoil(&mut recording);
        let problem = recording.check().unwrap_err().to_string();
        assert!(problem.contains(expected), "{problem}");
    }
}
