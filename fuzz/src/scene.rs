//! Random scene documents.

use tautline_scene::document::{Format, parse};

/// The first byte says which format the rest is in.
pub(crate) fn run(bytes: &[u8]) {
    let Some((&format, text)) = bytes.split_first() else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    let format = [Format::Json, Format::Json5, Format::Toml][usize::from(format) % 3];
    let Ok(scene) = parse(text, format) else { return };
    // What is sound is written and read back to the same.
    if scene.check().is_ok() {
        let json = serde_json::to_string(&scene).expect("a scene is JSON");
        assert_eq!(parse(&json, Format::Json).ok().as_ref(), Some(&scene));
    }
}
