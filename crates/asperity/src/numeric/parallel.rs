//! Parallel loops whose results do not depend on the number of threads. Tasks are called through a pointer, so that
//! rayon's loops are compiled once here and not for every task.

use std::sync::OnceLock;

use rayon::prelude::*;

/// Results of tasks in the order of the tasks, whatever the order in which these end.
pub(crate) struct Results<T>(Vec<OnceLock<T>>);

impl<T> Results<T> {
    pub fn new(count: usize) -> Self {
        Self((0..count).map(|_| OnceLock::new()).collect())
    }

    /// Keeps the result of task `k`; each has one.
    pub fn set(&self, k: usize, result: T) {
        // A second result would be the same as the first.
        let _ = self.0[k].set(result);
    }

    pub fn into_vec(self) -> Vec<T> {
        self.0.into_iter().filter_map(OnceLock::into_inner).collect()
    }
}

/// The results of `task(k)` for k in `0..count`, in the order of k. A single task runs on the thread that calls.
pub(crate) fn map<T: Send + Sync>(count: usize, task: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if count == 1 {
        return vec![task(0)];
    }
    let results = Results::new(count);
    for_each(count, &|k| results.set(k, task(k)));
    results.into_vec()
}

/// The value of a lock, made outside of it: a thread that waits for tasks of `make` may run another one that asks for the lock, and would
/// wait for itself inside. Threads that ask at the same time each make it.
pub(crate) fn once<T>(lock: &OnceLock<T>, make: impl FnOnce() -> T) -> &T {
    if let Some(known) = lock.get() {
        return known;
    }
    let made = make();
    lock.get_or_init(|| made)
}

fn for_each(count: usize, task: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(task);
}

/// `task(k, row)` for each row k of `values`, `length` to a row; the last one may be shorter.
pub(crate) fn for_each_row(values: &mut [f64], length: usize, task: &(dyn Fn(usize, &mut [f64]) + Sync)) {
    values.par_chunks_mut(length).enumerate().for_each(|(k, row)| task(k, row));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_tasks() {
        let squares: Vec<usize> = (0..1000).map(|k| k * k).collect();
        assert_eq!(map(1000, |k| k * k), squares);
        assert!(map(0, |k| k).is_empty());
        let mut values = vec![0.0; 10];
        for_each_row(&mut values, 4, &|k, row| row.fill((10 * k + row.len()) as f64));
        assert_eq!(values, [4.0, 4.0, 4.0, 4.0, 14.0, 14.0, 14.0, 14.0, 22.0, 22.0]);
    }
}
