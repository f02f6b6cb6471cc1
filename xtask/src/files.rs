//! The project's own text files, and the code in them.

use std::fs;
use std::path::{Path, PathBuf};

/// What is made, not written.
const MADE: &[&str] =
    &["target", "out", "node_modules", ".git", "dist", "corpus", "artifacts", "test-results", "replay.html"];

/// A file of the project that is text.
pub(crate) struct TextFile {
    /// From the workspace's folder, with `/` between names.
    pub(crate) path: String,
    pub(crate) text: String,
}

/// All text files under `root`, in the order of their paths.
pub(crate) fn text_files(root: &Path) -> Result<Vec<TextFile>, String> {
    let mut files = Vec::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        let explain = |error| format!("{}: {error}", folder.display());
        for entry in fs::read_dir(&folder).map_err(explain)? {
            let entry = entry.map_err(explain)?;
            if MADE.iter().any(|name| entry.file_name() == *name) {
                continue;
            }
            let path = entry.path();
            if entry.file_type().map_err(explain)?.is_dir() {
                folders.push(path);
            } else if let Some(text) = fs::read(&path).ok().and_then(|bytes| String::from_utf8(bytes).ok()) {
                files.push(TextFile { path: relative(root, path), text });
            }
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

fn relative(root: &Path, path: PathBuf) -> String {
    let inside = path.strip_prefix(root).unwrap_or(&path);
    inside.components().map(|name| name.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// Numbered lines of Rust code, without comments, and without the tests at the file's end.
pub(crate) fn library_code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let numbered = text.lines().enumerate().map(|(index, line)| (index + 1, line));
    let library = numbered.take_while(|(_, line)| line.trim() != "#[cfg(test)]");
    library.map(|(number, line)| (number, line.split("//").next().unwrap_or(line)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_tests_are_not_library_code() {
        let text = "/// A doc.\nlet a = 1; // one\n#[cfg(test)]\nmod tests {}\n";
        let code: Vec<_> = library_code(text).collect();
        assert_eq!(code, [(1, ""), (2, "let a = 1; ")]);
    }
}
