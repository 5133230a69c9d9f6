//! One function on several threads.

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
