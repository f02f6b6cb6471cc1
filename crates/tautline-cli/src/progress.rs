//! Progress bars on standard error: none where nobody looks at a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar that is told in steps how far its task is.
pub(crate) fn bar(task: &str) -> ProgressBar {
    with_style(ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr()), task)
}

/// A bar that is never drawn.
pub(crate) fn no_bar() -> ProgressBar {
    ProgressBar::hidden()
}

/// Gives a bar its looks and the name of its task.
pub(crate) fn with_style(bar: ProgressBar, task: &str) -> ProgressBar {
    // The template is fixed: if it were wrong, the bar would look plainer.
    let style = ProgressStyle::with_template("{msg:36} {bar:32} {percent:>3} %  {elapsed}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.with_style(style).with_message(task.to_owned())
}

/// Begins another task on a bar.
pub(crate) fn begin(bar: &ProgressBar, task: String) {
    bar.set_message(task);
    bar.set_position(0);
}

/// Tells a bar that `done` of `total` steps are done.
pub(crate) fn tell(bar: &ProgressBar, done: u64, total: u64) {
    bar.set_length(total);
    bar.set_position(done);
}
