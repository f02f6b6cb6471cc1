//! Why a command ended early, and with which exit code.

use std::io;
use std::path::Path;
use std::process::ExitCode;

/// Why a command ended early.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The scene is wrong. Exit code 1.
    #[error("{0}")]
    Scene(String),
    /// The command asks for what there is not, or a file cannot be read or written. Exit code 2.
    #[error("{0}")]
    Usage(String),
    /// What had to be said has been printed. Exit code 1.
    #[error("the scene has problems")]
    Reported,
    /// Nobody reads the output any more, as in `tautline list | head -1`. Exit code 0.
    #[error("the output was closed")]
    OutputClosed,
}

impl Failure {
    /// A file that could not be written.
    pub(crate) fn file(path: &Path, source: &io::Error) -> Self {
        Self::Usage(format!("{}: {source}", path.display()))
    }

    /// Says what was wrong, a line for every problem, and gives the exit code.
    pub(crate) fn report(&self) -> ExitCode {
        match self {
            Self::Scene(message) => complain(message, 1),
            Self::Usage(message) => complain(message, 2),
            Self::Reported => ExitCode::from(1),
            Self::OutputClosed => ExitCode::SUCCESS,
        }
    }
}

fn complain(message: &str, code: u8) -> ExitCode {
    use io::Write;
    let mut stderr = io::stderr().lock();
    for line in message.lines() {
        // If not even this can be written, the exit code has to do.
        let _ = writeln!(stderr, "error: {line}");
    }
    ExitCode::from(code)
}

impl From<tautline_scene::Error> for Failure {
    fn from(error: tautline_scene::Error) -> Self {
        use tautline_scene::Error as E;
        let message = error.to_string();
        match error {
            E::Parse(_) | E::Invalid(_) | E::Mesh { .. } | E::Engine(_) => Self::Scene(message),
            _ => Self::Usage(message),
        }
    }
}

impl From<tautline::Error> for Failure {
    fn from(error: tautline::Error) -> Self {
        Self::Scene(error.to_string())
    }
}

/// Of standard output, the only thing written to without a path.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::OutputClosed,
            _ => Self::Usage(format!("standard output: {error}")),
        }
    }
}
