//! Runs the program as a user does: arguments in; exit code, text and files out.

use std::path::Path;
use std::process::{Command, Output};

/// Runs it in `folder`.
pub(crate) fn tautline(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tautline")).args(arguments).current_dir(folder).output().unwrap()
}

/// What a call that succeeds prints; nothing may be said on standard error.
pub(crate) fn printed(folder: &Path, arguments: &[&str]) -> String {
    let output = tautline(folder, arguments);
    let (stdout, stderr) = texts(&output);
    assert!(output.status.success(), "{arguments:?}: {stderr}");
    assert_eq!(stderr, "", "{arguments:?}");
    stdout
}

/// The errors of a call that fails with this exit code, without a word on standard output.
pub(crate) fn errors(folder: &Path, arguments: &[&str], code: i32) -> Vec<String> {
    let output = tautline(folder, arguments);
    let (stdout, stderr) = texts(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {stderr}");
    assert_eq!(stdout, "", "{arguments:?}");
    assert!(!stderr.contains("panicked"), "{arguments:?}: {stderr}");
    stderr.lines().map(str::to_owned).collect()
}

pub(crate) fn texts(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (text(&output.stdout), text(&output.stderr))
}
