//! Opening an address in the browser, where there is one.

use std::process::{Command, Stdio};

/// Asks the system to open an address. Where that does not work the address has been printed.
pub(super) fn open(address: &str) {
    if cfg!(target_os = "linux") && !has_display() {
        return;
    }
    let program = match std::env::consts::OS {
        "macos" => "open",
        "windows" => "explorer",
        _ => "xdg-open",
    };
    let mut command = Command::new(program);
    command.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    // It runs beside this program, and how it ends does not matter.
    drop(command.spawn());
}

fn has_display() -> bool {
    ["DISPLAY", "WAYLAND_DISPLAY"].iter().any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()))
}
