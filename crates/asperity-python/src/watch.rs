//! Long work on a thread of its own, which Ctrl-C ends.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use asperity_contact_framework::progress::Progress;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Between two looks for a signal.
const PERIOD: Duration = Duration::from_millis(50);

/// Whether the work is still wanted. It unwinds at the next sign of progress where it is not.
#[derive(Clone, Default)]
pub struct Watch {
    is_cancelled: Arc<AtomicBool>,
}

/// Carried by the unwinding of work that is no longer wanted.
struct Cancelled;

impl Watch {
    fn check(&self) {
        if self.is_cancelled.load(Ordering::Relaxed) {
            // Without the message of a panic: this is no error of the program.
            resume_unwind(Box::new(Cancelled));
        }
    }
}

impl Progress for Watch {
    fn step(&self) {
        self.check();
    }

    fn stage(&self, _: &str, _: f64) {
        self.check();
    }

    fn advance(&self, _: f64) {
        self.check();
    }
}

fn internal(cause: &(dyn Any + Send)) -> PyErr {
    let text = cause.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("unknown");
    PyRuntimeError::new_err(format!("internal error of asperity, please report it: {text}"))
}

/// Short work without the interpreter's lock; a panic becomes an exception.
pub fn guarded<T: Send>(py: Python, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    py.detach(|| catch_unwind(AssertUnwindSafe(work))).map_err(|cause| internal(&*cause))
}

/// Long work without the interpreter's lock: a signal such as Ctrl-C raises its exception at once, and the work ends at its
/// next sign of progress.
pub fn interruptible<T: Send + 'static>(
    py: Python,
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<T> {
    let watch = Watch::default();
    let own = watch.clone();
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(|| work(&own)));
        // Nobody waits for cancelled work.
        let _ = sender.send(done);
    });
    // The lock is held for the look at signals alone.
    let receiver = std::sync::Mutex::new(receiver);
    loop {
        let next = py.detach(|| {
            let receiver = receiver.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            receiver.recv_timeout(PERIOD)
        });
        match next {
            Ok(done) => return done.map_err(|cause| internal(&*cause)),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(signal) = py.check_signals() {
                    watch.is_cancelled.store(true, Ordering::Relaxed);
                    return Err(signal);
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(
                    "internal error of asperity: its thread ended without a result",
                ));
            }
        }
    }
}
