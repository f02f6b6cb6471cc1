//! The one error type of this crate.

use std::io;
use std::path::PathBuf;

/// Why a file was not read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file in question.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file name whose extension names no format that can be written.
    #[error("{}: no known format; the extension must be one of {supported}", path.display())]
    UnsupportedFormat {
        /// The file asked for.
        path: PathBuf,
        /// The extensions that would do, such as ".gif, .glb, .png".
        supported: &'static str,
    },
    /// A picture of a size, rate or frame that cannot be made.
    #[error("{option}: {problem}")]
    Unsupported {
        /// The option in question, such as `width`.
        option: &'static str,
        /// What is wrong and what would be right.
        problem: String,
    },
    /// A recording that contradicts itself.
    #[error("recording, track \"{track}\": {problem}")]
    Recording {
        /// The track's name.
        track: String,
        /// What is wrong with it.
        problem: String,
    },
}
