//! Reference vectors, random numbers, derivatives and integrals. Each test program uses a part of this.
#![allow(dead_code)]

use std::collections::{BTreeSet, HashMap};
use std::path::Path;
use std::sync::Mutex;

use asperity::contact_law::named;
use asperity::numeric::Sum;
use asperity::numeric::quadrature::{Variable, panels};
use asperity::{Flat, Material, MicroContact, Population, Shape};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// One row of a reference file, by column name.
pub struct Row(HashMap<String, String>);

impl Row {
    pub fn text(&self, column: &str) -> &str {
        &self.0[column]
    }

    pub fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("{column} = {:?}", self.text(column)))
    }
}

/// All rows of `tests/reference/{name}.csv`.
pub fn rows(name: &str) -> Vec<Row> {
    // Of the package in the root, or of one below crates/.
    let folders =
        Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().map(|folder| folder.join("tests/reference"));
    let path =
        folders.map(|folder| folder.join(name).with_extension("csv")).find(|path| path.is_file()).unwrap();
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
    reader.deserialize().map(|row| Row(row.unwrap())).collect()
}

/// Asserts that a refused `input` gets the message that `messages.txt`, beside the tests of this program, has of the module. `RENEW=1 cargo test`
/// of the whole program writes what the messages are now, which a review reads.
pub fn assert_message(module: &str, input: &str, message: &str) {
    static RENEWED: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests")
        .join(env!("CARGO_CRATE_NAME"))
        .join("messages.txt");
    let module = module.split_once("::").map_or(module, |(_, module)| module);
    let [input, message] = [input, message].map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "));
    let line = format!("{module}: {input}: {message}");
    let mut renewed = RENEWED.lock().unwrap_or_else(|error| error.into_inner());
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    if std::env::var_os("RENEW").is_none() {
        return assert!(text.lines().any(|known| known == line), "not in messages.txt: {line}");
    }
    let is_first = renewed.insert(module.to_owned());
    let is_old = |known: &str| is_first && known.starts_with(&format!("{module}: "));
    let mut lines: BTreeSet<&str> = text.lines().filter(|known| !is_old(known)).collect();
    lines.insert(&line);
    std::fs::write(&path, lines.into_iter().map(|line| format!("{line}\n")).collect::<String>()).unwrap();
}

/// |found/exact - 1|, and 0 where both are 0.
pub fn relative_error(found: f64, exact: f64) -> f64 {
    if found == exact { 0.0 } else { ((found - exact) / exact).abs() }
}

/// Keeps the worst error seen and where it was.
#[derive(Default)]
pub struct Worst {
    error: f64,
    place: String,
    count: usize,
}

impl Worst {
    pub fn see(&mut self, found: f64, exact: f64, place: impl FnOnce() -> String) {
        let error = relative_error(found, exact);
        self.count += 1;
        if error.is_nan() || error > self.error {
            (self.error, self.place) = (error, format!("{}: found {found:e}, exact {exact:e}", place()));
        }
    }

    /// The worst relative error seen.
    pub fn error(&self) -> f64 {
        self.error
    }

    pub fn assert_within(&self, bound: f64, at_least: usize) {
        assert!(self.count >= at_least, "only {} comparisons", self.count);
        assert!(self.error <= bound, "relative error {:e} > {bound:e} at {}", self.error, self.place);
        println!("worst of {}: {:e} at {}", self.count, self.error, self.place);
    }
}

/// Random numbers that a seed fixes.
pub struct Random(ChaCha8Rng);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in the logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    pub fn one_of<T: Clone>(&mut self, all: &[T]) -> T {
        all[(self.unit() * all.len() as f64) as usize].clone()
    }
}

pub fn steel() -> Material {
    Material::new(210e9, 0.3, Some(7.6e9), None).unwrap()
}

pub fn lead() -> Material {
    Material::new(18e9, 0.35, Some(0.17e9), None).unwrap()
}

/// The contact of a registered law with some of its options set. Built from the law's type it would be compiled again here.
pub fn contact(law: &str, options: &[(&str, f64)], rough: &Material, flat: &Flat) -> Box<dyn MicroContact> {
    named(law).unwrap().with_options(options).unwrap().interface(rough, flat).unwrap()
}

/// The same of two equal bodies.
pub fn bare_contact(law: &str, options: &[(&str, f64)], body: &Material) -> Box<dyn MicroContact> {
    contact(law, options, body, &Flat::Bare(*body))
}

/// A rough body, a layer and a substrate: moduli over eight decades, hardnesses over six, the rough body harder, softer,
/// equal or never yielding; of the others both yield, or neither.
pub fn bodies(random: &mut Random) -> [Material; 3] {
    let young = random.log(1e9, 1e12);
    let soft = young * random.log(1e-3, 0.1);
    let hard = soft * random.log(1e-3, 1e3);
    let between = hard * (soft / hard).powf(random.unit());
    let beside = soft * random.log(1e-2, 1e2);
    let of_rough = random.one_of(&[None, Some(soft), Some(beside), Some(between)]);
    let never = random.unit() < 0.1;
    [of_rough, Some(hard).filter(|_| !never), Some(soft).filter(|_| !never)].map(|hardness| {
        let any_poisson = 0.499 * random.unit();
        let poisson = random.one_of(&[0.0, 0.3, 0.499, any_poisson, any_poisson]);
        let strength = hardness.filter(|_| random.unit() < 0.3).map(|h| h * random.log(0.05, 1.0));
        Material::new(young * random.log(1e-4, 1e4), poisson, hardness, strength).unwrap()
    })
}

/// dy/d ln w at `w`, from four values beside it, the outer ones `reach` away in ln w.
pub fn slope(value: impl Fn(f64) -> f64, w: f64, reach: f64) -> f64 {
    let step = 0.5 * reach;
    let at = |shift: f64| value(w * (shift * step).exp());
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step)
}

/// A scan of the pressure from 4 to -10 sigma, and levels: next to each of the first three peaks, and three anywhere.
pub fn scan_and_levels(pressure: impl Fn(f64) -> f64, random: &mut Random) -> (Vec<(f64, f64)>, Vec<f64>) {
    let scan: Vec<_> = (0..=700).map(|k| 4.0 - 0.02 * f64::from(k)).map(|h| (h, pressure(h))).collect();
    let is_peak = |w: &[(f64, f64)]| w[1].1 >= w[0].1 && w[1].1 > w[2].1;
    let tops = scan.windows(3).filter(|w| is_peak(w)).map(|w| w[1].1).take(3);
    let mut levels: Vec<f64> = tops.flat_map(|top| [0.999 * top, 1.0005 * top]).collect();
    levels.extend((0..3).map(|_| scan[700].1 * random.log(1e-3, 1.0)));
    (scan, levels)
}

/// Area, load and stiffness per nominal area at the separation `h`: the integrals of the statistical model by panels a
/// fifth of an octave wide, and between the indentations `kinks`, of heights that are integrated over the indentation.
pub fn dense(
    contact: &dyn MicroContact,
    shape: Shape,
    kinks: &[f64],
    population: &Population,
    h: f64,
) -> [f64; 3] {
    let &Population { sigma, density, ref heights, .. } = population;
    let [start, end] = heights.window(h);
    let mut ends: Vec<f64> = (0..170).map(|k| end * 1.5f64.powi(-k)).collect();
    ends.extend((0..40).map(|k| start + (end - start) * f64::from(k) / 40.0));
    ends.extend(kinks.iter().map(|w| w / sigma));
    ends.push(-h);
    ends.retain(|x| (start..=end).contains(x));
    ends.sort_by(f64::total_cmp);
    let mut sums = [Sum::default(); 3];
    for range in ends.windows(2).filter(|range| range[0] < range[1]) {
        for panel in panels(range[0], range[1], Variable::SquareRoot, 1) {
            for (x, weight) in panel.points.into_iter().zip(panel.weights) {
                let found = contact.contact(x * sigma, shape);
                let share = weight * heights.relative_density(h, x);
                for (sum, value) in sums.iter_mut().zip([found.area, found.load, found.stiffness]) {
                    *sum += share * value;
                }
            }
        }
    }
    sums.map(|sum| sum.value() * heights.scale(h) * density)
}
