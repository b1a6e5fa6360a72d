//! Progress on standard error: a bar in a terminal, else a plain line now and then.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use asperity_contact_framework::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Between two updates of a bar.
const BAR_PERIOD: Duration = Duration::from_millis(100);

/// Between two plain lines.
const LINE_PERIOD: Duration = Duration::from_secs(5);

/// A stage as an integer, to which threads add without waiting for each other.
const WHOLE: f64 = 1e12;

/// Shows the progress of a run.
pub struct Monitor {
    stem: String,
    display: Display,
    /// Between two updates.
    period: Duration,
    start: Instant,
    /// Time of the last update since the start, ms.
    shown: AtomicU64,
    /// The work of a stage, as the bits of a number.
    total: AtomicU64,
    /// The part of the stage that is done, times [`WHOLE`].
    done: AtomicU64,
    place: Mutex<Place>,
}

enum Display {
    Bar(ProgressBar),
    Lines(Mutex<Box<dyn Write + Send>>),
}

/// The place of a stage in a run.
#[derive(Clone)]
struct Place {
    /// All steps, and those done.
    steps: [u64; 2],
    /// When the last step was done; of the first the start.
    end_of_step: Instant,
    stage: String,
    start_of_stage: Instant,
}

impl Monitor {
    /// The progress of the run `stem` on standard error: a bar if it is a terminal, else a line at most every 5 s.
    pub fn new(stem: &str) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self::with(stem, Display::Lines(Mutex::new(Box::new(std::io::stderr()))), LINE_PERIOD);
        }
        let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %  {elapsed}{prefix}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        // Each of the three parts of an update is drawn, so that the last one leaves all of them.
        let target = ProgressDrawTarget::stderr_with_hz(u8::MAX);
        let bar = ProgressBar::with_draw_target(Some(1000), target).with_style(style);
        // The time goes on where a stage stands.
        bar.enable_steady_tick(Duration::from_millis(500));
        Self::with(stem, Display::Bar(bar), BAR_PERIOD)
    }

    fn with(stem: &str, display: Display, period: Duration) -> Self {
        let start = Instant::now();
        let place = Place { steps: [1, 0], end_of_step: start, stage: String::new(), start_of_stage: start };
        Self {
            stem: stem.to_owned(),
            display,
            period,
            start,
            shown: AtomicU64::new(0),
            total: AtomicU64::new(1f64.to_bits()),
            done: AtomicU64::new(0),
            place: Mutex::new(place),
        }
    }

    pub fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }

    fn place(&self) -> MutexGuard<'_, Place> {
        self.place.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows the state, unless it was shown within the last period.
    fn show(&self) {
        let now = self.start.elapsed();
        let shown = self.shown.load(Ordering::Relaxed);
        let millis = now.as_millis() as u64;
        if millis < shown + self.period.as_millis() as u64 {
            return;
        }
        // One of several threads shows it.
        if self.shown.compare_exchange(shown, millis, Ordering::Relaxed, Ordering::Relaxed).is_err() {
            return;
        }
        let place = self.place().clone();
        let state = State {
            steps: place.steps,
            stage: &place.stage,
            fraction: (self.done.load(Ordering::Relaxed) as f64 / WHOLE).min(1.0),
            in_stage: place.start_of_stage.elapsed(),
            in_steps: place.end_of_step.duration_since(self.start),
            in_step: place.end_of_step.elapsed(),
        };
        match &self.display {
            Display::Bar(bar) => {
                bar.set_position((1000.0 * state.fraction) as u64);
                bar.set_prefix(state.remaining().map_or_else(String::new, |left| format!(", {left}")));
                bar.set_message(format!("{}: {}", self.stem, state.name()));
            }
            Display::Lines(lines) => {
                let mut lines = lines.lock().unwrap_or_else(PoisonError::into_inner);
                let percent = (100.0 * state.fraction) as u64;
                let left = state.remaining().map_or_else(String::new, |left| format!(", {left}"));
                // A closed pipe does not stop the run.
                let _ = writeln!(lines, "{}: {} {percent} %{left}", self.stem, state.name());
            }
        }
    }
}

impl Progress for Monitor {
    fn steps(&self, count: u64) {
        let mut place = self.place();
        place.steps = [count, 0];
        place.end_of_step = self.start;
    }

    fn step(&self) {
        let mut place = self.place();
        place.steps[1] += 1;
        place.end_of_step = Instant::now();
        drop(place);
        self.show();
    }

    fn stage(&self, name: &str, total: f64) {
        let mut place = self.place();
        name.clone_into(&mut place.stage);
        place.start_of_stage = Instant::now();
        self.total.store(total.to_bits(), Ordering::Relaxed);
        self.done.store(0, Ordering::Relaxed);
        drop(place);
        self.show();
    }

    fn advance(&self, work: f64) {
        let part = work / f64::from_bits(self.total.load(Ordering::Relaxed));
        self.done.fetch_add((part * WHOLE) as u64, Ordering::Relaxed);
        self.show();
    }
}

struct State<'a> {
    steps: [u64; 2],
    stage: &'a str,
    /// Of the stage.
    fraction: f64,
    in_stage: Duration,
    /// What the steps took that are done.
    in_steps: Duration,
    /// Since the last of them.
    in_step: Duration,
}

impl State<'_> {
    /// The stage, and the step that it belongs to if there are several.
    fn name(&self) -> String {
        let [steps, done] = self.steps;
        if steps > 1 {
            format!("{} of {steps}, {}", (done + 1).min(steps), self.stage)
        } else {
            self.stage.to_owned()
        }
    }

    /// The remaining time of the run once a step is done, else that of the stage; `None` where it is too early to tell, and where the
    /// last step takes longer than those before.
    fn remaining(&self) -> Option<String> {
        let [steps, done] = self.steps;
        if done == 0 {
            return Some(format!("{} left of the stage", words(self.of_stage()?)));
        }
        let a_step = self.in_steps.as_secs_f64() / done as f64;
        let after_this = steps.saturating_sub(done + 1) as f64 * a_step;
        // A step that takes longer than those before adds nothing that grows.
        let of_this = if done < steps { (a_step - self.in_step.as_secs_f64()).max(0.0) } else { 0.0 };
        let seconds = after_this + of_this;
        (seconds > 0.0).then(|| format!("{} left of the run", words(seconds)))
    }

    /// The remaining time of the stage, s; `None` where it is too early to tell.
    fn of_stage(&self) -> Option<f64> {
        /// The least part that is extrapolated.
        const LEAST: f64 = 0.02;
        let fraction = self.fraction;
        (LEAST..1.0).contains(&fraction).then(|| self.in_stage.as_secs_f64() * (1.0 - fraction) / fraction)
    }
}

/// A time, s, in the unit that suits it.
pub fn words(seconds: f64) -> String {
    if seconds < 100.0 {
        format!("{seconds:.0} s")
    } else if seconds < 6000.0 {
        format!("{:.0} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    #[derive(Clone, Default)]
    struct Page(Arc<Mutex<Vec<u8>>>);

    impl Write for Page {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.lock().unwrap().write(bytes)
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    fn lines(period: Duration, run: impl Fn(&Monitor)) -> String {
        let page = Page::default();
        run(&Monitor::with("fine", Display::Lines(Mutex::new(Box::new(page.clone()))), period));
        String::from_utf8(page.0.lock().unwrap().clone()).unwrap()
    }

    #[test]
    fn a_line_has_stage_and_fraction_and_short_runs_have_none() {
        let run = |monitor: &Monitor| {
            monitor.steps(3);
            monitor.step();
            monitor.stage("summits", 2.0);
            rayon::join(|| monitor.advance(0.5), || monitor.advance(0.5));
        };
        let all = lines(Duration::ZERO, run);
        let last = all.lines().last().unwrap();
        assert!(last.starts_with("fine: 2 of 3, summits 50 %"), "{all}");
        assert_eq!(lines(LINE_PERIOD, run), "");
    }

    #[test]
    fn remaining_time_is_extrapolated_from_the_stage_and_then_from_the_steps() {
        let seconds = Duration::from_secs;
        // The steps that are done took 600 s.
        let at = |steps, fraction, in_step| State {
            steps,
            stage: "summits",
            fraction,
            in_stage: seconds(10),
            in_steps: seconds(600),
            in_step: seconds(in_step),
        };
        assert_eq!(at([1, 0], 0.25, 0).remaining().unwrap(), "30 s left of the stage");
        assert_eq!(at([4, 1], 0.25, 0).remaining().unwrap(), "30 min left of the run");
        assert_eq!(at([9, 1], 0.0, 0).remaining().unwrap(), "80 min left of the run");
        assert_eq!(at([1, 0], 0.01, 0).remaining(), None);
        assert_eq!(at([4, 4], 0.5, 0).remaining(), None);
        assert_eq!(at([1, 0], 0.5, 0).name(), "summits");
        assert_eq!(words(7200.0), "2.0 h");
    }

    #[test]
    fn the_remaining_time_of_a_run_counts_down_within_a_step_and_never_grows() {
        let at = |in_step| {
            let [in_steps, in_step] = [50, in_step].map(Duration::from_secs);
            State { steps: [2, 1], stage: "summits", fraction: 0.0, in_stage: in_step, in_steps, in_step }
        };
        assert_eq!(at(0).remaining().unwrap(), "50 s left of the run");
        assert_eq!(at(45).remaining().unwrap(), "5 s left of the run");
        assert_eq!(at(60).remaining(), None);
        let of_three = State { steps: [3, 1], ..at(60) };
        assert_eq!(of_three.remaining().unwrap(), "50 s left of the run");
    }
}
