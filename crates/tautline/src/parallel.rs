//! Spreading independent work over the rayon pool that a step is called from. Results do not depend on how
//! many threads there are: every item is worked on by itself, and results are put together in order.

/// Whether work on so many items should be spread: there are more threads than one, and `least` items.
pub(crate) fn is_worthwhile(count: usize, least: usize) -> bool {
    #[cfg(feature = "parallel")]
    let threads = rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    let threads = 1;
    count >= least && threads > 1
}

/// Calls `work` on every item, side by side if `worthwhile` and there are several: waking threads costs some ten
/// microseconds.
pub(crate) fn for_each<T: Send>(items: &mut [T], worthwhile: bool, work: impl Fn(&mut T) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if worthwhile && items.len() > 1 && rayon::current_num_threads() > 1 {
        use rayon::prelude::*;
        items.par_iter_mut().for_each(&work);
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
    work: impl Fn(&mut S, &mut T) -> Option<R> + Sync,
) {
    #[cfg(feature = "parallel")]
    if worthwhile && rayon::current_num_threads() > 1 {
        use rayon::prelude::*;
        let chunk_results: Vec<Vec<R>> = items
            .par_chunks_mut(CHUNK)
            .map(|chunk| {
                let mut scratch = S::default();
                chunk.iter_mut().filter_map(|item| work(&mut scratch, item)).collect()
            })
            .collect();
        out.extend(chunk_results.into_iter().flatten());
        return;
    }
    let _ = worthwhile;
    out.extend(items.iter_mut().filter_map(|item| work(scratch, item)));
}

/// Items that a thread takes at a time: enough work to be worth fetching.
#[cfg(feature = "parallel")]
const CHUNK: usize = 64;
