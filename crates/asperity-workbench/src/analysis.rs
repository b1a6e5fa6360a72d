//! Work on threads of its own, whose progress the page sees as server-sent events. It ends where nobody waits for it any more, where it
//! takes too long, and where it fails; the server goes on.

use std::any::Any;
use std::convert::Infallible;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use asperity_contact_framework::progress::Progress;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use serde_json::{Value, json};
use tokio::sync::mpsc::{UnboundedSender, unbounded_channel};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::engine::Refused;
use crate::limits;

const PERIOD: Duration = Duration::from_millis(100);

/// Memory is given out in units of so many bytes.
const UNIT: u64 = 1 << 20;

pub struct Budget {
    units: u32,
    free: Arc<Semaphore>,
}

impl Budget {
    pub fn new(bytes: u64) -> Self {
        let units = u32::try_from(bytes / UNIT)
            .unwrap_or(u32::MAX)
            .min(Semaphore::MAX_PERMITS.try_into().unwrap_or(u32::MAX));
        Self { units, free: Arc::new(Semaphore::new(units as usize)) }
    }

    pub async fn take(&self, bytes: u128) -> Result<OwnedSemaphorePermit, Refused> {
        let units = u32::try_from(bytes.div_ceil(u128::from(UNIT))).unwrap_or(u32::MAX).max(1);
        if units > self.units {
            let gigabytes = |bytes: f64| bytes / 1e9;
            return Err(Refused::new(format!(
                "this needs about {:.1} GB of memory; the workbench uses at most {:.1} GB. Allowed: fewer asperities, a smaller map, \
                 robustness = false, or `experiment run`",
                gigabytes(bytes as f64),
                gigabytes(f64::from(self.units) * UNIT as f64)
            )));
        }
        Arc::clone(&self.free)
            .acquire_many_owned(units)
            .await
            .map_err(|error| Refused::new(error.to_string()))
    }
}

/// Why work ended before its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ended {
    Unwanted,
    TooLong,
}

/// Whether work is still wanted, and where its progress is told.
pub struct Watch {
    is_unwanted: Arc<AtomicBool>,
    start: Instant,
    longest: Duration,
    events: UnboundedSender<Event>,
    /// ms since the start.
    told: AtomicU64,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    stage: String,
    total: f64,
    done: f64,
    steps: [u64; 2],
}

impl Watch {
    /// Sends an event to the page.
    pub fn tell(&self, name: &str, value: &Value) {
        self.check();
        // A page that is gone is found at the next check.
        let _ = self.events.send(Event::default().event(name).data(value.to_string()));
    }

    pub fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    fn check(&self) {
        let ended = if self.is_unwanted.load(Ordering::Relaxed) {
            Ended::Unwanted
        } else if self.start.elapsed() > self.longest {
            Ended::TooLong
        } else {
            return;
        };
        // Without the message of a panic: this is no error of the program.
        resume_unwind(Box::new(ended));
    }

    fn state(&self) -> std::sync::MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn show(&self, is_new: bool) {
        self.check();
        let now = self.start.elapsed().as_millis() as u64;
        let told = self.told.load(Ordering::Relaxed);
        if !is_new && now < told + PERIOD.as_millis() as u64
            || self.told.compare_exchange(told, now, Ordering::Relaxed, Ordering::Relaxed).is_err()
        {
            return;
        }
        let value = {
            let State { stage, total, done, steps } = &*self.state();
            json!({ "stage": stage, "done": (done / total).clamp(0.0, 1.0), "steps": steps })
        };
        self.tell("progress", &value);
    }
}

impl Progress for Watch {
    fn steps(&self, count: u64) {
        self.state().steps = [count, 0];
    }

    fn step(&self) {
        self.state().steps[1] += 1;
        self.show(false);
    }

    fn stage(&self, name: &str, total: f64) {
        {
            let mut state = self.state();
            name.clone_into(&mut state.stage);
            (state.total, state.done) = (total.max(f64::MIN_POSITIVE), 0.0);
        }
        self.show(false);
    }

    fn advance(&self, work: f64) {
        self.state().done += work;
        self.show(false);
    }
}

/// Ends work when the page stops listening: it is dropped with the response.
struct Listening(Arc<AtomicBool>);

impl Drop for Listening {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Work that is watched, and what ends it when it is dropped.
fn watched(events: UnboundedSender<Event>) -> (Watch, Listening) {
    let is_unwanted = Arc::new(AtomicBool::new(false));
    let listening = Listening(Arc::clone(&is_unwanted));
    let watch = Watch {
        is_unwanted,
        start: Instant::now(),
        longest: limits::ANALYSIS,
        events,
        told: AtomicU64::new(0),
        state: Mutex::default(),
    };
    (watch, listening)
}

/// What work comes to, which keeps its memory as long as it lasts.
fn outcome<T>(
    watch: &Watch,
    permit: OwnedSemaphorePermit,
    work: impl FnOnce(&Watch) -> Result<T, Refused>,
) -> Result<T, Refused> {
    let _permit = permit;
    catch_unwind(AssertUnwindSafe(|| work(watch))).unwrap_or_else(|cause| Err(ended(&*cause)))
}

/// The answer to a request whose `work` takes a while: events `progress`, those that it tells, and at last `done` or `error`. It waits
/// for its memory, `bytes`, first.
pub fn answer(
    budget: Arc<Budget>,
    bytes: u128,
    work: impl FnOnce(&Watch) -> Result<(), Refused> + Send + 'static,
) -> Response {
    let (events, receiver) = unbounded_channel();
    let (watch, listening) = watched(events.clone());
    tokio::spawn(async move {
        let taken = budget.take(bytes).await;
        // A thread that is not one of the server's: it lasts as long as its work.
        tokio::task::spawn_blocking(move || {
            let last = match taken.and_then(|permit| outcome(&watch, permit, work)) {
                Ok(()) => Event::default().event("done").data("{}"),
                Err(refused) => Event::default().event("error").data(json!(refused).to_string()),
            };
            let _ = events.send(last);
        });
    });
    let events = stream::unfold((receiver, listening), |(mut receiver, listening)| async move {
        let event = receiver.recv().await?;
        Some((Ok::<Event, Infallible>(event), (receiver, listening)))
    });
    Sse::new(events).keep_alive(KeepAlive::default()).into_response()
}

/// What `work` gives, which ends where its request does.
pub async fn value<T: Send + 'static>(
    budget: Arc<Budget>,
    bytes: u128,
    work: impl FnOnce(&Watch) -> Result<T, Refused> + Send + 'static,
) -> Result<T, Refused> {
    let (watch, _listening) = watched(unbounded_channel().0);
    let permit = budget.take(bytes).await?;
    let done = tokio::task::spawn_blocking(move || outcome(&watch, permit, work)).await;
    done.unwrap_or_else(|error| Err(Refused::new(error.to_string())))
}

/// What a page says of work that did not come to its end.
fn ended(cause: &(dyn Any + Send)) -> Refused {
    match cause.downcast_ref::<Ended>() {
        Some(Ended::Unwanted) => Refused::new("cancelled"),
        Some(Ended::TooLong) => Refused::new(format!(
            "this took longer than {} min, the most that the workbench allows; `experiment run` has no such limit",
            limits::ANALYSIS.as_secs() / 60
        )),
        None => {
            let text = cause.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("unknown");
            Refused::new(format!("internal error, please report it with the spec: {text}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn watch(longest: Duration) -> Watch {
        Watch {
            is_unwanted: Arc::default(),
            start: Instant::now(),
            longest,
            events: unbounded_channel().0,
            told: AtomicU64::new(0),
            state: Mutex::default(),
        }
    }

    #[test]
    fn work_ends_at_its_limit_of_time_and_says_so() {
        let cause = catch_unwind(AssertUnwindSafe(|| watch(Duration::ZERO).advance(1.0))).unwrap_err();
        let refused = ended(&*cause);
        assert!(
            refused.message.contains("longer than 30 min") && refused.message.contains("experiment run"),
            "{refused}"
        );
        watch(Duration::from_secs(60)).advance(1.0);
    }

    #[test]
    fn analyses_share_their_memory_and_wait_for_each_other() {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
        runtime.block_on(async {
            let budget = Budget::new(10 * UNIT);
            let soon =
                |bytes: u64| tokio::time::timeout(Duration::from_millis(20), budget.take(u128::from(bytes)));
            let first = soon(6 * UNIT).await.unwrap().unwrap();
            assert!(soon(6 * UNIT).await.is_err(), "6 of 10 are taken");
            drop(soon(4 * UNIT).await.unwrap().unwrap());
            drop(first);
            assert!(soon(10 * UNIT).await.is_ok());
            assert!(soon(10 * UNIT + 1).await.unwrap().is_err(), "there are never so many");
        });
    }
}
