//! The memory that a run can have: what the machine has left, within the limits of a container and of the process.

use std::fs;

use asperity_contact_framework::Plan;
use asperity_contact_framework::input::{InputError, Source};

/// Bytes; 0 where they are not known.
pub fn available_memory() -> u128 {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    // Not what its processes hold: `free_memory` would count the cache of files as taken.
    let container = system.cgroup_limits().map(|limits| limits.total_memory.saturating_sub(limits.rss));
    let process = fs::read_to_string("/proc/self/limits")
        .ok()
        .zip(fs::read_to_string("/proc/self/status").ok())
        .and_then(|(limits, status)| left_of_address_space(&limits, &status));
    let all = [Some(system.available_memory()), container, process];
    all.into_iter().flatten().min().map_or(0, u128::from)
}

/// Refuses what memory cannot hold, before anything is allocated.
pub fn check(plan: &dyn Plan, source: &Source) -> Result<(), InputError> {
    let available = available_memory();
    let needed = plan.memory();
    // Without a known limit nothing is refused.
    if available == 0 || needed.bytes <= available {
        return Ok(());
    }
    let message = format!(
        "this needs about {:.1} GB of memory; available: {:.1} GB. Allowed: fewer asperities, a smaller map, where it compares models \
         on a measured map, robustness = false, or [tiled], which sums a surface of any size at given separations",
        needed.bytes as f64 / 1e9,
        available as f64 / 1e9
    );
    Err(match needed.key {
        Some(key) => source.error_at(key, message),
        None => InputError::file(&source.path, message),
    })
}

/// What is left of the address space that `ulimit -v` allows, by the texts of `/proc/self/limits` and `/proc/self/status`;
/// `None` without a limit.
fn left_of_address_space(limits: &str, status: &str) -> Option<u64> {
    let after = |text: &str, name: &str| {
        let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
        rest.split_whitespace().next()?.parse::<u64>().ok()
    };
    let limit = after(limits, "Max address space")?;
    Some(limit.saturating_sub(1024 * after(status, "VmSize:")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_of_the_address_space_leaves_what_is_not_taken() {
        let limits = |soft: &str| {
            format!(
                "Limit  Soft Limit  Hard Limit  Units\nMax address space         {soft}   unlimited   bytes\n"
            )
        };
        let status = "Name:\texperiment\nVmPeak:\t 9000 kB\nVmSize:\t    1000 kB\n";
        assert_eq!(left_of_address_space(&limits("5120000"), status), Some(4_096_000));
        assert_eq!(left_of_address_space(&limits("1000"), status), Some(0));
        assert_eq!(left_of_address_space(&limits("unlimited"), status), None);
        assert!(available_memory() > 0);
    }
}
