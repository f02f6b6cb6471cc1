//! Threads that wait awake for what is next to be done.
//!
//! A step of rigid bodies has a hundred phases of some ten microseconds each. To put a thread of a pool to sleep and
//! wake it takes as long, so for the length of a step some of them serve its team: they watch the board for jobs. What
//! a member did in the last job it begins with in the next, so that it finds in its cache what it left there.

// One lifetime is hidden from the compiler: see `Board::post`. Miri passes over the tests below.
#![allow(unsafe_code)]

use std::any::Any;
use std::cell::{Cell, RefCell, UnsafeCell};
use std::hint::spin_loop;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering::SeqCst};
use std::sync::{Arc, Mutex};

use rayon::prelude::*;

/// What a member is to do; it is told its number.
type Job<'a> = dyn Fn(usize) + Sync + 'a;

/// Where a team finds its jobs, one at a time.
struct Board {
    /// Twice the number of the last job, and one more while members may take part in it; `DISMISSED` at last.
    state: AtomicUsize,
    /// How many members may be looking at the job.
    inside: AtomicUsize,
    /// Written while nobody is inside and the job is not open.
    job: UnsafeCell<Option<&'static Job<'static>>>,
    /// What a member panicked with.
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

/// SAFETY: `job` is all that is not `Sync`. The team's owner alone writes it, as [`Board::post`] says, when no member
/// reads it; a job may be shared between threads.
unsafe impl Sync for Board {}

const DISMISSED: usize = usize::MAX;

/// So often a member looks for a job before it offers its processor to others between looks: some fifty microseconds.
const PATIENCE: u32 = 2000;

/// How many teams there are. Who serves one goes to where it may be of more use when there are others.
static TEAMS: AtomicUsize = AtomicUsize::new(0);

thread_local! {
    /// The team of what this thread is doing.
    static OWN: RefCell<Option<Arc<Board>>> = const { RefCell::new(None) };
    /// Whether it is in the midst of a job. There it waits for nobody: the pool might hand it a service in its own team
    /// meanwhile, which ends only when the job does.
    static IS_BUSY: Cell<bool> = const { Cell::new(false) };
}

/// Does its part of a job, and returns what it panicked with.
fn take_part(job: &Job<'_>, number: usize) -> Result<(), Box<dyn Any + Send>> {
    IS_BUSY.set(true);
    let outcome = catch_unwind(AssertUnwindSafe(|| job(number)));
    IS_BUSY.set(false);
    outcome
}

impl Board {
    fn new() -> Self {
        Self {
            state: AtomicUsize::new(0),
            inside: AtomicUsize::new(0),
            job: UnsafeCell::new(None),
            panic: Mutex::new(None),
        }
    }

    /// Does a job, as member 0, together with all who come by until that is done; returns when all are. Only the
    /// owner of the team may call it, and not from within a job.
    fn post(&self, job: &Job<'_>) {
        // SAFETY: the lifetime of `job` ends after this function does. A member looks at it between counting itself
        // in and out, and only if it found the job open in between. Below, the job is closed, and then nobody is
        // inside: whoever counts itself in after that finds it closed (all these are sequentially consistent).
        // Not even a panic leads out before.
        let job_of_any_time = unsafe { std::mem::transmute::<&Job<'_>, &'static Job<'static>>(job) };
        // SAFETY: the last job is closed, and nobody was inside after that (or there was none).
        unsafe { *self.job.get() = Some(job_of_any_time) };
        self.state.fetch_add(1, SeqCst);
        let own = take_part(job, 0);
        self.state.fetch_add(1, SeqCst);
        while self.inside.load(SeqCst) > 0 {
            spin_loop();
        }
        let theirs = self.panic.lock().map_or(None, |mut panic| panic.take());
        if let Some(panic) = own.err().or(theirs) {
            resume_unwind(panic);
        }
    }

    /// Does `work` on every item with a team of this size.
    fn share<T: Send>(&self, items: &mut [T], size: usize, work: impl Fn(&mut T) + Sync) {
        let items: Vec<Mutex<Option<&mut T>>> = items.iter_mut().map(|item| Mutex::new(Some(item))).collect();
        let job = |number: usize| {
            let first = number * items.len() / size;
            for item in items[first..].iter().chain(&items[..first]) {
                let own = item.try_lock().ok().and_then(|mut item| item.take());
                if let Some(item) = own {
                    work(item);
                }
            }
        };
        self.post(&job);
    }

    /// Takes part in all jobs until the team is dismissed or this member is of more use elsewhere.
    fn serve(&self, number: usize, is_wanted: impl Fn() -> bool) {
        let (mut last, mut looks) = (0, 0_u32);
        loop {
            let state = self.state.load(SeqCst);
            if state == DISMISSED || !is_wanted() {
                return;
            }
            if state % 2 == 1 && state != last {
                self.inside.fetch_add(1, SeqCst);
                if self.state.load(SeqCst) == state {
                    // SAFETY: this job was open when this member had counted itself in, so it is neither written nor
                    // gone before it has counted itself out.
                    let job = unsafe { *self.job.get() };
                    if let Some(job) = job
                        && let Err(panic) = take_part(job, number)
                        && let Ok(mut first) = self.panic.lock()
                    {
                        first.get_or_insert(panic);
                    }
                }
                self.inside.fetch_sub(1, SeqCst);
                (last, looks) = (state, 0);
            } else if looks < PATIENCE {
                looks += 1;
                spin_loop();
            } else {
                std::thread::yield_now();
            }
        }
    }
}

/// Dismisses a team, also if its work panics.
struct Gathering(Arc<Board>);

impl Drop for Gathering {
    fn drop(&mut self) {
        OWN.set(None);
        self.0.state.store(DISMISSED, SeqCst);
        TEAMS.fetch_sub(1, SeqCst);
    }
}

/// Does `work` with a team of threads of the pool that wait for what [`for_each`] hands out.
pub(super) fn gathered<R>(work: impl FnOnce() -> R) -> R {
    if IS_BUSY.get() || OWN.with_borrow(Option::is_some) {
        return work();
    }
    let board = Arc::new(Board::new());
    let gathering = Gathering(Arc::clone(&board));
    // A thread that waits for others of its pool may be handed what it has itself put there.
    let owner = rayon::current_thread_index();
    let is_alone = TEAMS.fetch_add(1, SeqCst) == 0;
    if is_alone {
        for number in 1..rayon::current_num_threads() {
            let board = Arc::clone(&board);
            rayon::spawn(move || {
                if owner.is_none() || rayon::current_thread_index() != owner {
                    board.serve(number, || TEAMS.load(SeqCst) == 1);
                }
            });
        }
        OWN.set(Some(board));
    }
    let result = work();
    drop(gathering);
    result
}

/// Calls `work` on every item: with the team if there is one, else with the pool; within a job by itself.
pub(super) fn for_each<T: Send>(items: &mut [T], work: impl Fn(&mut T) + Send + Sync) {
    if IS_BUSY.get() {
        items.iter_mut().for_each(work);
        return;
    }
    match OWN.with_borrow(Option::clone) {
        Some(board) => board.share(items, rayon::current_num_threads(), work),
        None => items.par_iter_mut().for_each(work),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Does `work` with a team of threads of its own.
    fn with_members(size: usize, work: impl FnOnce(&Board)) {
        let board = Arc::new(Board::new());
        let gathering = Gathering(Arc::clone(&board));
        TEAMS.fetch_add(1, SeqCst);
        std::thread::scope(|scope| {
            for number in 1..size {
                let board = &board;
                scope.spawn(move || board.serve(number, || true));
            }
            // Dismissed before they are waited for, also if the work panics.
            let _gathering = gathering;
            work(&board);
        });
    }

    #[test]
    fn every_item_is_worked_on_once() {
        for size in [1, 2, 3] {
            with_members(size, |board| {
                let mut items: Vec<(usize, String)> = (0..7).map(|i| (i, String::new())).collect();
                let suffix = String::from("x");
                for _ in 0..20 {
                    board.share(&mut items, size, |(_, text)| text.push_str(&suffix));
                }
                for (i, (number, text)) in items.iter().enumerate() {
                    assert_eq!((i, 20), (*number, text.len()));
                }
            });
        }
    }

    #[test]
    fn members_take_part() {
        with_members(2, |board| {
            let mut workers = [None, None];
            // Both are at work at the same time, or this would never end.
            let started = AtomicUsize::new(0);
            board.share(&mut workers, 2, |worker| {
                started.fetch_add(1, SeqCst);
                while started.load(SeqCst) < 2 {
                    std::thread::yield_now();
                }
                *worker = Some(std::thread::current().id());
            });
            assert_ne!(workers[0], workers[1]);
        });
    }

    #[test]
    fn a_panic_reaches_the_owner_when_all_are_done() {
        let caught = catch_unwind(|| {
            with_members(2, |board| {
                let mut items = [0, 1, 2, 3];
                board.share(&mut items, 2, |item| assert_ne!(2, *item, "this one panics"));
            });
        });
        assert!(caught.is_err());
    }

    #[test]
    #[cfg_attr(miri, ignore = "rayon itself breaks rules that Miri checks")]
    fn work_within_a_job_is_done_on_the_spot() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
        let mut sums = [0; 5];
        pool.install(|| {
            gathered(|| {
                for_each(&mut sums, |sum| {
                    let mut inner = [1; 10];
                    for_each(&mut inner, |one| *one += 1);
                    *sum = inner.iter().sum();
                });
                gathered(|| for_each(&mut sums, |sum| *sum += 1));
            });
        });
        assert_eq!([21; 5], sums);
    }

    #[test]
    #[cfg_attr(miri, ignore = "rayon itself breaks rules that Miri checks")]
    fn teams_side_by_side_get_their_work_done() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let mut worlds = vec![vec![0; 100]; 4];
        pool.install(|| {
            worlds.par_iter_mut().for_each(|world| {
                for _ in 0..50 {
                    gathered(|| for_each(world, |item| *item += 1));
                }
            });
        });
        assert!(worlds.iter().flatten().all(|&item| item == 50));
    }
}
