//! Ctrl-C and SIGTERM: one line that says what became of the run, exit code 130 or 143, and no report that is half written.

use std::io::{self, IsTerminal, Seek, SeekFrom, Write};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use asperity::topography::write::Out;

/// Held while a report is written: an interruption waits for it.
static WRITING: Mutex<()> = Mutex::new(());

static HAS_COME: AtomicBool = AtomicBool::new(false);

static WRITTEN: AtomicUsize = AtomicUsize::new(0);

/// Whether the variations of a sweep are run, of which those that are complete are kept.
static IS_SWEEP: AtomicBool = AtomicBool::new(false);

static IS_WORKBENCH: AtomicBool = AtomicBool::new(false);

/// Added to the number of a signal, the exit code of a program that it ends.
const OF_SIGNAL: i32 = 128;

/// Ends the program at Ctrl-C and, where there are signals, at SIGTERM. Where no handler can be set, the system ends it without a
/// word.
#[cfg(unix)]
pub fn handle() {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    // Set by the thread that waits: without it a signal does what the system has it do.
    let wait = || {
        let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
        if let Some(signal) = signals.forever().next() {
            end(OF_SIGNAL + signal);
        }
    };
    let _ = std::thread::Builder::new().spawn(wait);
}

#[cfg(not(unix))]
pub fn handle() {
    const SIGINT: i32 = 2;
    let _ = ctrlc::set_handler(|| end(OF_SIGNAL + SIGINT));
}

/// Ends the program with one line, once a report that is being written is whole.
fn end(code: i32) {
    HAS_COME.store(true, Ordering::Relaxed);
    let _whole = begin_writing();
    let mut to = std::io::stderr();
    // Below the bar of progress.
    let start = if to.is_terminal() { "\n" } else { "" };
    if IS_WORKBENCH.load(Ordering::Relaxed) {
        let _ = writeln!(
            to,
            "{start}the workbench has ended; the address works again after the next `experiment serve`"
        );
        std::process::exit(0);
    }
    let line = line(WRITTEN.load(Ordering::Relaxed), IS_SWEEP.load(Ordering::Relaxed));
    let _ = writeln!(to, "{start}{line}");
    std::process::exit(code);
}

/// Says whether a sweep is run.
pub fn of_sweep(is_run: bool) {
    IS_SWEEP.store(is_run, Ordering::Relaxed);
}

/// Says that the workbench is served, which Ctrl-C ends.
#[cfg(feature = "serve")]
pub fn of_workbench() {
    IS_WORKBENCH.store(true, Ordering::Relaxed);
}

/// Begins to write a report; an interruption waits until the guard is dropped.
pub fn begin_writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Whether a signal has come that ends the program.
pub fn has_come() -> bool {
    HAS_COME.load(Ordering::Relaxed)
}

/// Waits for the end of the program, of which another thread takes care once nothing is being written.
pub fn wait_for_the_end(writing: MutexGuard<'static, ()>) -> ! {
    drop(writing);
    loop {
        std::thread::park();
    }
}

/// A file that may be large: writing fails once a signal has come, so that its writer gives it up and nobody waits for it.
pub struct GivenUp<'a> {
    out: &'a mut dyn Out,
    has_failed: bool,
}

impl<'a> GivenUp<'a> {
    /// What is written to `out`.
    pub fn new(out: &'a mut dyn Out) -> Self {
        Self { out, has_failed: false }
    }
}

impl Write for GivenUp<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Once: the end of an archive, which is written in any case, is no second error.
        if has_come() && !self.has_failed {
            self.has_failed = true;
            return Err(io::Error::other("interrupted"));
        }
        self.out.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

impl Seek for GivenUp<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.out.seek(to)
    }
}

/// Counts a report that was written.
pub fn count_written() {
    WRITTEN.fetch_add(1, Ordering::Relaxed);
}

fn line(written: usize, is_sweep: bool) -> String {
    match (written, is_sweep) {
        (_, true) => "interrupted; what is complete is kept, run the same command to continue".to_owned(),
        (0, false) => "interrupted; nothing was written".to_owned(),
        (1, false) => "interrupted; 1 report was written before, the one under way was not".to_owned(),
        (count, false) => {
            format!("interrupted; {count} reports were written before, the one under way was not")
        }
    }
}
