//! Files by their paths: regular, not too large, inside a folder.

use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use super::Refusal;
use crate::error::Error;

/// The folder that a file is in.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The file's true path, once it is known to lie in the folder.
pub(super) fn inside(folder: &Path, path: &str) -> Result<PathBuf, Error> {
    let refusal = |message: &str| Error::Mesh { path: path.into(), refusal: Refusal::new(message) };
    let plain = |component| matches!(component, Component::Normal(_) | Component::CurDir);
    if path.is_empty() || !Path::new(path).components().all(plain) {
        return Err(refusal("not a path inside the folder: it must be relative and without `..`"));
    }
    let joined = folder.join(path);
    let file = joined.canonicalize().map_err(|source| Error::io(&joined, source))?;
    let folder = folder.canonicalize().map_err(|source| Error::io(folder, source))?;
    if !file.starts_with(&folder) {
        return Err(refusal("a link that leads out of the folder"));
    }
    Ok(file)
}

/// The bytes of a regular file of at most so many.
pub(crate) fn read_limited(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    let (file, length) = open_limited(path, most)?;
    let mut bytes = Vec::with_capacity(length as usize);
    file.take(most).read_to_end(&mut bytes).map_err(|source| Error::io(path, source))?;
    Ok(bytes)
}

/// A regular file of at most so many bytes, and how many it has.
pub(super) fn open_limited(path: &Path, most: u64) -> Result<(File, u64), Error> {
    let io = |source| Error::io(path, source);
    // Asked before it is opened: opening a pipe would wait for its writer.
    let metadata = std::fs::metadata(path).map_err(io)?;
    if !metadata.is_file() {
        return Err(io(std::io::Error::other("not a regular file")));
    }
    if metadata.len() > most {
        let message = format!("{} bytes are more than {most}", metadata.len());
        return Err(io(std::io::Error::new(std::io::ErrorKind::FileTooLarge, message)));
    }
    Ok((File::open(path).map_err(io)?, metadata.len()))
}
