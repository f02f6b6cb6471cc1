//! Files that are there whole or not at all.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use crate::Error;

/// Writes a file beside `path` and moves it there once it is complete. On any failure what was at `path` before
/// is untouched.
///
/// # Errors
/// Whatever `write` returns, and [`Error::Io`] with `path` if the folder is not there, the disk is full and so on.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), Error>,
) -> Result<(), Error> {
    let at_path = |source: io::Error| io_error(path, source);
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tautline-");
    // A temporary file is its owner's alone; this one shall be as any other that the user makes.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder).map_err(at_path)?;
    let mut buffer = BufWriter::new(file.as_file());
    write(&mut buffer)?;
    buffer.flush().map_err(at_path)?;
    drop(buffer);
    file.persist(path).map_err(|failure| at_path(failure.error))?;
    Ok(())
}

/// An error of the file system at a path.
pub(super) fn io_error(path: &Path, source: impl Into<io::Error>) -> Error {
    Error::Io { path: path.to_owned(), source: source.into() }
}
