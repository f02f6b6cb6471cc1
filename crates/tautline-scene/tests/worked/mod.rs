//! How long a thread works, for tests that ask how much work something is.

use std::fs;
use std::time::{SystemTime, UNIX_EPOCH};

/// What this thread has worked, in s: what other programs do on the machine does not count. Where that is not known, the
/// time of day.
pub(crate) fn worked() -> f64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds: Option<f64> = text.split_whitespace().next().and_then(|word| word.parse().ok());
    let time_of_day = || SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs_f64();
    nanoseconds.map_or_else(time_of_day, |nanoseconds| nanoseconds * 1e-9)
}
