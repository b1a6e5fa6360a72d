//! A target under libFuzzer: that of the name of the program.
#![no_main]

mod targets;

use std::sync::{LazyLock, Mutex};

use targets::{Place, Taken, Target};

static PLACE: LazyLock<Place> = LazyLock::new(Place::new);
static TARGET: LazyLock<&Target> = LazyLock::new(|| {
    let program = std::env::current_exe().expect("the path of the program");
    let name = program.file_name().expect("a name").to_string_lossy();
    targets::TARGETS.iter().find(|target| target.name == name).expect("the name of a target")
});

/// The most that an input has taken so far.
static MOST: Mutex<Option<Taken>> = Mutex::new(None);

/// Says where an input takes more than all before it by a tenth.
fn report(taken: Taken, length: usize) {
    let mut most = MOST.lock().expect("no other thread");
    let most = most.get_or_insert_default();
    if taken.time.as_secs_f64() > 1.1 * most.time.as_secs_f64() {
        most.time = taken.time;
        eprintln!("SLOWEST {:.1} ms for {length} bytes", 1e3 * taken.time.as_secs_f64());
    }
    if taken.memory > most.memory + most.memory / 10 {
        most.memory = taken.memory;
        eprintln!("LARGEST {:.1} MB for {length} bytes, {} points", 1e-6 * taken.memory as f64, taken.points);
    }
}

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if bytes.len() <= targets::MOST_BYTES {
        let taken = TARGET.check(&PLACE, bytes);
        report(taken, bytes.len());
    }
});
