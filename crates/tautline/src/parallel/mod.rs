//! Spreading independent work over the rayon pool that a step is called from. Results do not depend on how
//! many threads there are: every item is worked on by itself, and results are put together in order.

#[cfg(feature = "parallel")]
mod team;

/// How many threads may work side by side.
pub(crate) fn threads() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    return 1;
}

/// Whether work on so many items should be spread: there are more threads than one, and `least` items.
pub(crate) fn is_worthwhile(count: usize, least: usize) -> bool {
    count >= least && threads() > 1
}

/// Does `work`, in which many short pieces are spread one after another: meanwhile threads of the pool stay awake and
/// wait for them, since to wake one takes longer than many a piece.
pub(crate) fn as_team<R>(worthwhile: bool, work: impl FnOnce() -> R) -> R {
    #[cfg(feature = "parallel")]
    if worthwhile && threads() > 1 {
        return team::gathered(work);
    }
    let _ = worthwhile;
    work()
}

/// Calls `work` on every item, side by side if `worthwhile` and there are several: waking threads costs some ten
/// microseconds, handing something to a team less than one.
pub(crate) fn for_each<T: Send>(items: &mut [T], worthwhile: bool, work: impl Fn(&mut T) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if worthwhile && items.len() > 1 && threads() > 1 {
        team::for_each(items, work);
        return;
    }
    let _ = worthwhile;
    items.iter_mut().for_each(work);
}

/// Appends to `out` what `work` makes of every item, in order. Each thread has a `scratch` of its own.
pub(crate) fn filter_map<T: Send, S: Default, R: Send>(
    items: &mut [T],
    worthwhile: bool,
    scratch: &mut S,
    out: &mut Vec<R>,
    work: impl Fn(&mut S, &mut T) -> Option<R> + Send + Sync,
) {
    if !worthwhile {
        out.extend(items.iter_mut().filter_map(|item| work(scratch, item)));
        return;
    }
    let chunk = chunk_of(items.len());
    let mut tasks: Vec<(&mut [T], Vec<R>)> =
        items.chunks_mut(chunk).map(|items| (items, Vec::new())).collect();
    for_each(&mut tasks, true, |(items, results)| {
        let mut scratch = S::default();
        results.reserve_exact(items.len());
        results.extend(items.iter_mut().filter_map(|item| work(&mut scratch, item)));
    });
    tasks.into_iter().for_each(|(_, mut results)| out.append(&mut results));
}

/// What `work` makes of every item, which it is told the number of, in order.
pub(crate) fn collect<T: Sync, R: Send>(
    items: &[T],
    worthwhile: bool,
    work: impl Fn(usize, &T) -> Option<R> + Send + Sync,
) -> Vec<R> {
    let of = |first: usize, items: &[T]| -> Vec<R> {
        (first..).zip(items).filter_map(|(number, item)| work(number, item)).collect()
    };
    if !worthwhile {
        return of(0, items);
    }
    let chunk = chunk_of(items.len());
    let mut tasks: Vec<_> =
        (0..).step_by(chunk).zip(items.chunks(chunk)).map(|task| (task, Vec::new())).collect();
    for_each(&mut tasks, true, |((first, items), results)| *results = of(*first, items));
    tasks.into_iter().flat_map(|(_, results)| results).collect()
}

/// So many of all items a thread takes at a time: enough work to be worth fetching, and some pieces for each.
fn chunk_of(count: usize) -> usize {
    const LEAST: usize = 64;
    const PIECES: usize = 8;
    (count / (PIECES * threads())).max(LEAST)
}
