//! Memory for large arrays.

use rayon::prelude::*;

/// Bytes of a huge page on common processors.
#[cfg(target_os = "linux")]
const HUGE: usize = 2 << 20;

/// A list of `count` zeros, in huge pages where [`advise`] gets them.
pub fn zeros<T: Copy + Default>(count: usize) -> Vec<T> {
    let list = vec![T::default(); count];
    advise(&list);
    list
}

/// A list of `count` equal values, in huge pages where [`advise`] gets them.
pub fn filled<T: Clone>(count: usize, value: T) -> Vec<T> {
    let mut list = Vec::new();
    reserve(&mut list, count);
    list.resize(count, value);
    list
}

/// Reserves a total capacity of `count` values, in huge pages where [`advise`] gets them.
pub fn reserve<T>(list: &mut Vec<T>, count: usize) {
    list.reserve_exact(count.saturating_sub(list.len()));
    advise(list);
}

/// The values of an iterator in their order, on all threads, in huge pages where [`advise`] gets them.
pub fn collected<T: Send>(values: impl IndexedParallelIterator<Item = T>) -> Vec<T> {
    let mut list = Vec::new();
    reserve(&mut list, values.len());
    values.collect_into_vec(&mut list);
    list
}

/// Requests huge pages from Linux, which reduces the page faults of the first access and of column-wise access. Does
/// nothing on other systems and for small arrays.
#[cfg(target_os = "linux")]
fn advise<T>(list: &Vec<T>) {
    use rustix::mm::{Advice, madvise};
    let begin = list.as_ptr().addr();
    let end = (begin + list.capacity() * size_of::<T>()) / HUGE * HUGE;
    let begin = begin.next_multiple_of(HUGE);
    if begin < end {
        let place = list.as_ptr().with_addr(begin).cast_mut().cast();
        // SAFETY: the range lies in the list's own allocation, and this advice changes no value there.
        #[allow(unsafe_code)]
        let advised = unsafe { madvise(place, end - begin, Advice::LinuxHugepage) };
        // A kernel without huge pages returns an error, which does no harm.
        let _ = advised;
    }
}

#[cfg(not(target_os = "linux"))]
fn advise<T>(_: &Vec<T>) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_what_they_would_be_without_advice() {
        for count in [0, 1, 1000, HUGE_LIST] {
            assert_eq!(zeros::<f64>(count), vec![0.0; count]);
            assert_eq!(filled(count, 2.5), vec![2.5; count]);
            let mut list = vec![1.0, 2.0];
            reserve(&mut list, count);
            assert!(list == [1.0, 2.0] && list.capacity() >= count.max(2));
            assert!(collected((0..count).into_par_iter()).into_iter().eq(0..count));
        }
    }

    /// Several huge pages.
    const HUGE_LIST: usize = 1_000_003;
}
