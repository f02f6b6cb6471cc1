//! Where things are, and what kind of run this is.

use std::path::{Path, PathBuf};

pub(crate) struct Project {
    /// The folder of the workspace.
    pub(crate) root: PathBuf,
    /// Where Cargo puts what it builds.
    pub(crate) target: PathBuf,
    /// Whether a check that is left out counts as failed.
    pub(crate) ci: bool,
}

impl Project {
    pub(crate) fn find() -> Result<Self, String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_owned);
        // This program is `target/debug/xtask`.
        let program = std::env::current_exe().map_err(|error| format!("where is this program? {error}"))?;
        let target = program.ancestors().nth(2).map(Path::to_owned);
        let ci = std::env::var("CI").is_ok_and(|value| value == "true" || value == "1");
        match (root, target) {
            (Some(root), Some(target)) if root.join("Cargo.toml").exists() => Ok(Self { root, target, ci }),
            _ => Err("the workspace has moved since this program was built; run `cargo clean`".into()),
        }
    }

    /// The command line, as `cargo build` makes it for a profile.
    pub(crate) fn tautline(&self, profile_folder: &str) -> PathBuf {
        self.target.join(profile_folder).join(format!("tautline{}", std::env::consts::EXE_SUFFIX))
    }
}
