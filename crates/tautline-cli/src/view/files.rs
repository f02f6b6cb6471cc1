//! The files that are served: those of a folder, listed once, so that no request can name any other.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Files by the path that they are asked for, such as `assets/x.js`.
pub(super) struct Files {
    known: BTreeMap<String, Content>,
}

enum Content {
    File(PathBuf),
    Bytes(Vec<u8>),
}

/// What is answered to a request.
pub(super) struct Served {
    pub(super) bytes: Vec<u8>,
    /// Its MIME type.
    pub(super) kind: &'static str,
}

impl Files {
    /// All files in a folder and the folders in it.
    pub(super) fn of(root: &Path) -> Result<Self, Failure> {
        let mut files = Self { known: BTreeMap::new() };
        let mut folders = vec![(root.to_owned(), String::new())];
        while let Some((folder, prefix)) = folders.pop() {
            let failed = |error| Failure::file(&folder, &error);
            for entry in fs::read_dir(&folder).map_err(failed)? {
                let entry = entry.map_err(failed)?;
                let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
                let kind = entry.file_type().map_err(failed)?;
                if kind.is_dir() {
                    folders.push((entry.path(), name + "/"));
                } else if kind.is_file() {
                    files.known.insert(name, Content::File(entry.path()));
                }
            }
        }
        Ok(files)
    }

    /// Adds a file that is in no folder.
    pub(super) fn add(&mut self, name: &str, bytes: Vec<u8>) {
        self.known.insert(name.to_owned(), Content::Bytes(bytes));
    }

    /// The file that a request's address names, if there is one.
    pub(super) fn get(&self, address: &str) -> Option<Served> {
        let path = address.split(['?', '#']).next()?.strip_prefix('/')?;
        let name = if path.is_empty() { "index.html" } else { path };
        let bytes = match self.known.get(name)? {
            Content::File(path) => fs::read(path).ok()?,
            Content::Bytes(bytes) => bytes.clone(),
        };
        Some(Served { bytes, kind: kind_of(name) })
    }
}

fn kind_of(name: &str) -> &'static str {
    match name.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" => "application/json",
        "svg" => "image/svg+xml",
        "wasm" => "application/wasm",
        "webp" => "image/webp",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_the_folder_are_served() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("dist");
        fs::create_dir_all(root.join("assets")).unwrap();
        fs::write(root.join("index.html"), "page").unwrap();
        fs::write(root.join("assets/a.js"), "code").unwrap();
        fs::write(folder.path().join("secret"), "secret").unwrap();
        let mut files = Files::of(&root).unwrap();
        files.add("scene.json", b"{}".to_vec());
        let bytes = |address| files.get(address).map(|served| served.bytes);
        assert_eq!(bytes("/").as_deref(), Some(&b"page"[..]));
        assert_eq!(bytes("/assets/a.js?v=1").as_deref(), Some(&b"code"[..]));
        assert_eq!(bytes("/scene.json").as_deref(), Some(&b"{}"[..]));
        for address in ["/../secret", "//secret", "/assets/../../secret", "/%2e%2e/secret", "", "/assets", "secret"] {
            assert!(files.get(address).is_none(), "{address}");
        }
        assert_eq!(files.get("/assets/a.js").unwrap().kind, "text/javascript; charset=utf-8");
    }
}
