//! Which threads the engine works on.
//!
//! A process that is forked has none of its parent's threads: work given to a pool made before would wait for ever. So
//! each process that is not the one that imported the package gets a pool of its own when it first steps.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors::{Failure, Outcome};

/// The process that imported the package; rayon's own pool is its.
static FIRST: OnceLock<u32> = OnceLock::new();
/// A pool that is used instead of rayon's own, and the process that made it.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

pub(crate) fn note_process() {
    FIRST.get_or_init(std::process::id);
}

/// Does something where parallel work is spread over the right threads.
pub(crate) fn run<T: Send>(task: impl FnOnce() -> T + Send) -> T {
    match pool() {
        Some(pool) => pool.install(task),
        None => task(),
    }
}

fn pool() -> Option<Arc<ThreadPool>> {
    let own = std::process::id();
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    match &*pool {
        Some((process, pool)) if *process == own => return Some(Arc::clone(pool)),
        None if FIRST.get() == Some(&own) => return None,
        _ => {}
    }
    let made = Arc::new(ThreadPoolBuilder::new().build().ok()?);
    // That of the parent is forgotten, not dropped: dropping it would wait for threads that are not there.
    std::mem::forget(pool.replace((own, Arc::clone(&made))));
    Some(made)
}

/// How many threads steps of this process are spread over, from the next on. Results do not depend on it.
#[pyfunction]
pub(crate) fn set_threads(count: usize) -> Outcome<()> {
    if !(1..=256).contains(&count) {
        return Err(Failure::invalid("count", format!("{count} is not a whole number from 1 to 256")));
    }
    let made = ThreadPoolBuilder::new().num_threads(count).build();
    let made = made.map_err(|error| Failure::invalid("count", error))?;
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    std::mem::forget(pool.replace((std::process::id(), Arc::new(made))));
    Ok(())
}
