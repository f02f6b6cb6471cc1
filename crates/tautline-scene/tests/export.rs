//! Files: written whole, read back equal.

mod recordings;

use std::fs;
use std::path::Path;

use tautline_scene::Error;
use tautline_scene::export::{self, Options};
use tautline_scene::recording::Recording;
use tautline_scene::render::{Image, Renderer, Settings};

fn options() -> Options {
    Options { picture: Settings { width: 120, height: 90, ..Settings::default() }, ..Options::default() }
}

fn write(recording: &Recording, path: &Path) -> Result<(), Error> {
    export::write(recording, path, &options(), &mut |_, _| {})
}

fn last_picture(recording: &Recording) -> Image {
    Renderer::new(recording, options().picture).unwrap().frame(recording.frame_count() - 1)
}

/// Delays (hundredths of a second) of all frames, and the picture on show at the end (sRGB).
fn play(path: &Path) -> (Vec<u16>, Vec<[u8; 3]>) {
    let mut reader = gif::DecodeOptions::new().read_info(fs::File::open(path).unwrap()).unwrap();
    let palette = reader.global_palette().unwrap().to_vec();
    let width = usize::from(reader.width());
    let mut shown = vec![[0; 3]; width * usize::from(reader.height())];
    let mut delays = Vec::new();
    while let Some(frame) = reader.read_next_frame().unwrap() {
        delays.push(frame.delay);
        for (i, &index) in
            frame.buffer.iter().enumerate().filter(|&(_, &index)| Some(index) != frame.transparent)
        {
            let (x, y) = (i % usize::from(frame.width), i / usize::from(frame.width));
            let color = &palette[3 * usize::from(index)..][..3];
            shown[(y + usize::from(frame.top)) * width + x + usize::from(frame.left)].copy_from_slice(color);
        }
    }
    (delays, shown)
}

#[test]
fn a_gif_plays_in_real_time_and_ends_on_the_last_frame() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    let recording = recordings::icosahedra(10, 61);
    let mut calls = Vec::new();
    export::write(&recording, &path, &options(), &mut |done, total| calls.push((done, total))).unwrap();
    assert_eq!((calls[0], calls[calls.len() - 1]), ((0, 61), (61, 61)));

    let (delays, shown) = play(&path);
    assert_eq!(delays.len(), 61);
    // 60 steps of 1/30 s, and the pause at the end.
    assert_eq!(delays.iter().map(|&d| u32::from(d)).sum::<u32>(), 200 + 100);
    let expected = last_picture(&recording);
    let errors = shown.iter().flatten().zip(expected.pixels.iter().flatten());
    let (sum, worst) = errors
        .fold((0.0, 0), |(sum, worst), (&a, &b)| (sum + f64::from(a.abs_diff(b)), worst.max(a.abs_diff(b))));
    let mean = sum / (3.0 * shown.len() as f64);
    assert!(mean < 4.0 && worst < 60, "mean error {mean}, worst {worst}");
}

#[test]
fn a_gif_at_a_lower_rate_has_fewer_frames_and_the_same_length() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    let slow = Options { gif_frame_rate: 12.0, ..options() };
    export::write(&recordings::icosahedra(2, 61), &path, &slow, &mut |_, _| {}).unwrap();
    let (delays, _) = play(&path);
    assert_eq!((delays.len(), delays.iter().map(|&d| u32::from(d)).sum::<u32>()), (25, 300));
}

#[test]
fn a_gif_does_not_depend_on_the_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recordings::sheet_and_tube(12, 20);
    let [one, three] = [1, 3].map(|threads| {
        let path = folder.path().join(format!("{threads}.gif"));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| write(&recording, &path)).unwrap();
        fs::read(path).unwrap()
    });
    assert!(one == three);
}

#[test]
fn a_png_is_the_last_frame_unless_another_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recordings::icosahedra(5, 30);
    let renderer = Renderer::new(&recording, options().picture).unwrap();
    for (png_frame, expected) in [(None, 29), (Some(3), 3)] {
        let path = folder.path().join("a.PNG");
        export::write(&recording, &path, &Options { png_frame, ..options() }, &mut |_, _| {}).unwrap();
        let mut reader =
            png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).unwrap())).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert!(pixels == renderer.frame(expected).pixels.as_flattened());
    }
}

#[test]
fn other_extensions_and_options_are_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recordings::icosahedra(2, 4);
    for name in ["a.avi", "a", "gif"] {
        let problem = write(&recording, &folder.path().join(name)).unwrap_err();
        assert!(matches!(&problem, Error::UnsupportedFormat { .. }), "{problem}");
        assert!(problem.to_string().contains(".gif, .glb, .html, .mp4"), "{problem}");
    }
    for (name, options) in [
        ("a.gif", Options { gif_frame_rate: 0.0, ..options() }),
        ("a.gif", Options { gif_frame_rate: f32::NAN, ..options() }),
        ("a.png", Options { png_frame: Some(4), ..options() }),
    ] {
        let problem =
            export::write(&recording, &folder.path().join(name), &options, &mut |_, _| {}).unwrap_err();
        assert!(matches!(&problem, Error::Unsupported { .. }), "{problem}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_failure_half_way_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, b"old").unwrap();
    let result = export::write_atomically(&path, |out| {
        std::io::Write::write_all(out, b"new").unwrap();
        Err(Error::Unsupported { option: "test", problem: "stop here".into() })
    });
    assert!(matches!(result, Err(Error::Unsupported { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn an_error_of_the_file_system_names_the_file() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.glb", "a.gif", "a.png"] {
        let path = folder.path().join("missing").join(name);
        let problem = write(&recordings::icosahedra(1, 2), &path).unwrap_err();
        assert!(matches!(&problem, Error::Io { path: at, .. } if *at == path), "{problem}");
    }
}
