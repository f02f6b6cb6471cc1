//! Files that are there whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::Error;

/// Writes a file beside `path` and moves it there once it is complete. On any failure what was at `path` before
/// is untouched.
///
/// A link stays, and the file it leads to is replaced. What is no file, such as a pipe or a device, is written to as
/// it is: there is nothing to preserve, and it must not be replaced. A process that is killed while it writes
/// leaves a `.tautline-` file behind.
///
/// # Errors
/// Whatever `write` returns, and [`Error::Io`] with `path` if it is a folder or may not be written to, its folder is
/// not there, the disk is full and so on.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), Error>,
) -> Result<(), Error> {
    let at_path = |source: io::Error| io_error(path, source);
    match destination(path).map_err(at_path)? {
        Destination::Stream => {
            let stream = File::options().write(true).open(path).map_err(at_path)?;
            write_all(path, &stream, write)
        }
        Destination::File(target) => {
            let file = temporary_beside(&target).map_err(at_path)?;
            write_all(path, file.as_file(), write)?;
            file.persist(&target).map_err(|failure| at_path(failure.error))?;
            Ok(())
        }
    }
}

/// As [`write_atomically`], for what another program writes: it gets the path of an empty file beside `path`.
///
/// # Errors
/// As [`write_atomically`]; a pipe or a device is refused.
pub(super) fn write_beside(path: &Path, write: impl FnOnce(&Path) -> Result<(), Error>) -> Result<(), Error> {
    let at_path = |source: io::Error| io_error(path, source);
    let Destination::File(target) = destination(path).map_err(at_path)? else {
        let problem = "only a file can hold it: a pipe or a device cannot be rewound";
        return Err(at_path(io::Error::new(io::ErrorKind::NotSeekable, problem)));
    };
    let file = temporary_beside(&target).map_err(at_path)?;
    write(file.path())?;
    file.persist(&target).map_err(|failure| at_path(failure.error))?;
    Ok(())
}

/// Whether [`write_atomically`] could write to `path` now, found out without leaving a trace.
///
/// # Errors
/// [`Error::Io`] as [`write_atomically`].
pub fn check_writable(path: &Path) -> Result<(), Error> {
    let at_path = |source: io::Error| io_error(path, source);
    match destination(path).map_err(at_path)? {
        Destination::Stream => Ok(()),
        Destination::File(target) => temporary_beside(&target).map(drop).map_err(at_path),
    }
}

/// Where what is written to a path goes.
enum Destination {
    /// A file, there already or not.
    File(PathBuf),
    /// A pipe, a terminal or another device.
    Stream,
}

fn destination(path: &Path) -> io::Result<Destination> {
    let known = match fs::metadata(path) {
        Ok(known) => known,
        // A link to nothing is an error; a path without anything at it is not.
        Err(error) if error.kind() != io::ErrorKind::NotFound || path.is_symlink() => return Err(error),
        Err(_) => return Ok(Destination::File(path.to_owned())),
    };
    if known.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !known.is_file() {
        return Ok(Destination::Stream);
    }
    if known.permissions().readonly() {
        return Err(io::ErrorKind::PermissionDenied.into());
    }
    Ok(Destination::File(if path.is_symlink() { fs::canonicalize(path)? } else { path.to_owned() }))
}

fn temporary_beside(target: &Path) -> io::Result<tempfile::NamedTempFile> {
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tautline-");
    // A temporary file is its owner's alone; this one shall be as any other that the user makes.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

fn write_all(
    path: &Path,
    file: &File,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut buffer = BufWriter::new(file);
    write(&mut buffer)?;
    buffer.flush().map_err(|source| io_error(path, source))
}

/// An error of the file system at a path.
pub(super) fn io_error(path: &Path, source: impl Into<io::Error>) -> Error {
    Error::Io { path: path.to_owned(), source: source.into() }
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::os::unix::fs::{FileTypeExt, symlink};

    use super::*;

    fn write_text(path: &Path, text: &str) -> Result<(), Error> {
        write_atomically(path, |out| out.write_all(text.as_bytes()).map_err(|source| io_error(path, source)))
    }

    #[test]
    fn a_link_stays_and_its_target_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let (target, link) = (folder.path().join("target"), folder.path().join("link"));
        fs::write(&target, "old").unwrap();
        symlink(&target, &link).unwrap();
        check_writable(&link).unwrap();
        assert_eq!(fs::read_to_string(&target).unwrap(), "old");
        write_text(&link, "new").unwrap();
        assert!(link.is_symlink());
        assert_eq!(fs::read_to_string(&target).unwrap(), "new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing else is left");
    }

    #[test]
    fn a_device_is_written_to_and_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("null");
        symlink("/dev/null", &link).unwrap();
        write_text(&link, "text").unwrap();
        assert!(link.is_symlink());
        assert!(fs::metadata(&link).unwrap().file_type().is_char_device());
    }

    #[test]
    fn folders_dangling_links_and_read_only_files_are_refused_and_stay() {
        let folder = tempfile::tempdir().unwrap();
        let (locked, dangling) = (folder.path().join("locked"), folder.path().join("dangling"));
        fs::write(&locked, "kept").unwrap();
        let mut permissions = fs::metadata(&locked).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&locked, permissions).unwrap();
        symlink(folder.path().join("nothing"), &dangling).unwrap();
        for path in [folder.path(), &locked, &dangling] {
            assert!(check_writable(path).is_err(), "{}", path.display());
            assert!(matches!(write_text(path, "new"), Err(Error::Io { .. })), "{}", path.display());
        }
        assert_eq!(fs::read_to_string(&locked).unwrap(), "kept");
        assert!(dangling.is_symlink());
    }
}
