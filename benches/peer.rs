//! Our side of the comparisons under `benches/peers`: does what it is told on standard input, one line a task, and
//! answers each with the seconds it took and its own figures. The script runs it and its peers alternately.

use std::io::{BufRead, Write};
use std::time::Instant;

use asperity::surface::HeightMap;
use asperity::surface::generate::gaussian;
use asperity::surface::spectrum::{Lay, Shape, Spectrum};
use asperity::surface::summits::{Detail, Neighbours, find};

fn main() -> std::io::Result<()> {
    // `cargo bench` and `cargo test` run every bench: without a script there is nothing to answer.
    let mut out = std::io::stdout();
    let mut surface: Option<HeightMap> = None;
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let answer = match words[..] {
            ["generate", points, spectrum, seed] => generate(points, spectrum, seed, &mut surface),
            ["summits"] => surface.as_ref().map(summits),
            ["drop"] => {
                surface = None;
                Some("0".to_owned())
            }
            _ => None,
        };
        writeln!(out, "{}", answer.unwrap_or_else(|| format!("no task: {line}")))?;
        out.flush()?;
    }
    Ok(())
}

/// A self-affine surface on unit pixels, Hurst exponent 0.8: `full` has waves from an eighth of the side to two pixels,
/// `cut` from 32 to 8 pixels.
fn generate(points: &str, spectrum: &str, seed: &str, surface: &mut Option<HeightMap>) -> Option<String> {
    let n: usize = points.parse().ok()?;
    let (roll_off, cut_off) = match spectrum {
        "full" => (n as f64 / 8.0, 2.0),
        "cut" => (32.0, 8.0),
        _ => return None,
    };
    let spectrum = Spectrum::new(Shape::SelfAffine { hurst: 0.8, roll_off, cut_off }, Lay::default()).ok()?;
    *surface = None;
    let start = Instant::now();
    let heights = gaussian(&spectrum.on_grid([n, n], [1.0; 2]), 1.0, [seed.parse().ok()?; 32]);
    let seconds = start.elapsed().as_secs_f64();
    *surface = Some(HeightMap::new([n, n], [1.0; 2], heights, f64::EPSILON).ok()?.periodic());
    Some(format!("{seconds} {}", peak_bytes()))
}

/// Five-point summits with heights and curvatures, their number and the sum of their curvatures. The median of three
/// runs, as of the peers: threads just woken may share a processor for longer than a run takes.
fn summits(surface: &HeightMap) -> String {
    let mut answers = [0; 3].map(|_| {
        let start = Instant::now();
        let found = find(surface, Neighbours::Four, Detail::default());
        let seconds = start.elapsed().as_secs_f64();
        (seconds, found.heights.len(), found.curvatures.iter().sum::<f64>())
    });
    answers.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (seconds, count, curvatures) = answers[1];
    format!("{seconds} {count} {curvatures}")
}

/// The most memory that this process has had, bytes; 0 where the system does not say.
fn peak_bytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) * 1024
}
