//! One function on several threads.

use std::sync::Mutex;

/// Runs `work` once on each of `num_threads` threads (at least one), of which the calling thread is the first, and returns
/// the results in the order of the thread numbers, which `work` receives. If `work` panics on any thread, the panic
/// resumes in the caller, so that a missing result is never taken for a success.
pub(crate) fn run_on_threads<T: Send>(num_threads: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let work = &work;
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..num_threads).map(|thread| scope.spawn(move || work(thread))).collect();
        let mut results = vec![work(0)];
        for other in others {
            match other.join() {
                Ok(result) => results.push(result),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        results
    })
}

/// `work` of every item, on `num_threads` threads (at least one) that take the next item when they have none. The results are
/// in the order of the items. A panic of `work` resumes in the caller.
pub(crate) fn map_on_threads<I: Send, T: Send>(
    num_threads: usize,
    items: Vec<I>,
    work: impl Fn(I) -> T + Sync,
) -> Vec<T> {
    let items = Mutex::new(items.into_iter().enumerate());
    // A panic elsewhere leaves the items as they are.
    let next = || items.lock().unwrap_or_else(std::sync::PoisonError::into_inner).next();
    let on_thread = |_thread: usize| {
        let mut results = Vec::new();
        while let Some((idx, item)) = next() {
            results.push((idx, work(item)));
        }
        results
    };
    let mut results: Vec<(usize, T)> = run_on_threads(num_threads, on_thread).into_iter().flatten().collect();
    results.sort_by_key(|(idx, _)| *idx);
    results.into_iter().map(|(_, result)| result).collect()
}
