//! How much memory some work takes.

/// Memory of this process while some work was done, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Peak {
    /// Just before.
    pub before: u64,
    /// The most.
    pub highest: u64,
}

/// Runs `work` and reports the memory of this process, mapped files included; `None` where the system does not
/// report it. Memory taken by other threads meanwhile is included.
pub fn peak_of<T>(work: impl FnOnce() -> T) -> (T, Option<Peak>) {
    let before = forget_peak();
    let value = work();
    let peak = before.and_then(|before| Some(Peak { before, highest: status("VmHWM:")? }));
    (value, peak)
}

/// Makes the memory of now the most that there was (proc(5), clear_refs), bytes.
fn forget_peak() -> Option<u64> {
    std::fs::write("/proc/self/clear_refs", "5").ok()?;
    status("VmRSS:")
}

/// Bytes that Linux reports for this process.
fn status(key: &str) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    let kilobytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kilobytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What was freed before does not count.
    #[test]
    #[cfg(target_os = "linux")]
    fn the_peak_is_that_of_the_work() {
        const BYTES: u64 = 200 << 20;
        let touch = |bytes: u64| drop(std::hint::black_box(vec![1u8; bytes as usize]));
        touch(4 * BYTES);
        let (value, peak) = peak_of(|| {
            touch(BYTES);
            7
        });
        let Peak { before, highest } = peak.unwrap();
        assert_eq!(value, 7);
        // Linux counts pages in batches.
        assert!((BYTES / 10 * 9..2 * BYTES).contains(&(highest - before)), "{before} {highest}");
    }
}
