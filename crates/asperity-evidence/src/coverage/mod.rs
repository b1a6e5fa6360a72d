//! Coverage of 95 % intervals: how often the interval that one map gives holds the mean over many maps of one process, the truth.

mod process;
mod tables;
mod window;

pub use process::EndlessProcess;
pub use tables::{Coverage, IntervalCount, VerdictCount, upper_limit};
pub use window::{QuantityEstimate, WindowResults, WindowTask, WindowVerdict};

use crate::{Drawing, Evidence, Failed, Form, Program, Task};
use asperity::compare::{ByQuantity, ComparedQuantity, Verdict};
use asperity::contact_law::named;
use asperity::distribution::Johnson;
use asperity::numeric::{extremes, median};
use asperity::spot::{Conduction, SpotProperties};
use asperity::study::LawContact;
use asperity::topography::generate::{Plateau, Process, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use asperity::{Heights, Material, WithSpots, literature};
use asperity_contact_framework::report::format::{count, input_quantity, percent};
use asperity_contact_framework::report::table::{Schema, Table};
use asperity_plot::{Axis, Colour, Figure, Layer, Legend, Marker, Plot, series_colours};
use process::WINDOWS_PER_MAP;
use rayon::prelude::*;
use tables::ProcessRow;

/// Young's modulus (Pa), Poisson's ratio and hardness (Pa) of both bodies, under ZMC.
const STEEL: (f64, f64, f64) = (210e9, 0.3, 7.6e9);

/// Of all surfaces: standard deviation and pixel (m), Hurst exponent, and shortest waves (m).
const SIGMA: f64 = 1e-7;
const PIXEL: f64 = 1e-6;
const HURST: f64 = 0.8;
const CUT_OFF: f64 = 3e-6;

/// A finer roughness that truncates the summits of a plateau: standard deviation, longest waves, height of its mean plane (m).
const PLATEAU: [f64; 3] = [3e-8, 12e-6, 3e-8];

/// Correlation length of an amplitude that varies from place to place, m.
const PATCHES: f64 = 40e-6;

/// Relative positions of a pair of bodies.
const SHIFTS: usize = 8;

#[derive(Debug, Clone, Copy)]
struct Case {
    name: &'static str,
    /// Longest waves, m.
    roll_off: f64,
    /// Wavelengths along x over those along y.
    elongation: f64,
    heights: CaseHeights,
    has_plateau: bool,
    /// Standard deviation of the logarithm of the amplitude, where it varies from place to place.
    modulation: Option<f64>,
    /// The case whose process is that of a second rough body.
    against: Option<&'static str>,
    windows: usize,
    /// Effective contacts of the loads in the mean of a pilot map.
    contacts: &'static [f64],
}

#[derive(Debug, Clone, Copy)]
enum CaseHeights {
    Gaussian,
    Exponential,
    /// By skewness and kurtosis.
    Johnson(f64, f64),
}

/// Plateaus with valleys, and peaks.
const WORN: CaseHeights = CaseHeights::Johnson(-1.0, 4.5);
const PEAKED: CaseHeights = CaseHeights::Johnson(1.0, 4.5);

const fn case(name: &'static str, roll_off: f64, windows: usize, contacts: &'static [f64]) -> Case {
    Case {
        name,
        roll_off,
        elongation: 1.0,
        heights: CaseHeights::Gaussian,
        has_plateau: false,
        modulation: None,
        against: None,
        windows,
        contacts,
    }
}

#[derive(Debug, Clone, Copy)]
struct Size {
    /// Points along each side of a window.
    points: usize,
    cases: &'static [Case],
    /// Windows of each case that are studied under other treatments.
    studied: usize,
    /// Whether the windows are too small for blocks, so that intervals are model-based.
    is_small: bool,
}

impl Size {
    /// The coverage that intervals of 95 % may have, and the share of the windows from which on those with an interval count as typical.
    /// Model-based intervals are wide rather than narrow, and are withheld by what is measured on a window.
    fn band(&self) -> ([f64; 2], f64) {
        if self.is_small { ([0.93, 0.98], 0.5) } else { ([0.93, 0.97], 0.9) }
    }
}

/// 5 waves lie along a block of the short processes, which is a quarter of the side, 3 along one of the long ones: just enough for an
/// interval, which patchy and too long ones may not have. Of those between only some windows are found patchy.
const LARGE: Size = {
    const CONTACTS: &[f64] = &[64.0, 100.0, 190.0, 380.0];
    const SHORT: Case = case("short-gaussian", 24e-6, 800, CONTACTS);
    const LONG: Case = case("long-gaussian", 38e-6, 800, CONTACTS);
    const PATCHY: Case = case("patchy", 16e-6, 300, &[64.0, 100.0, 190.0]);
    Size {
        points: 512,
        cases: &[
            SHORT,
            Case { name: "short-worn", heights: WORN, ..SHORT },
            LONG,
            Case { name: "long-peaked", heights: PEAKED, ..LONG },
            Case { name: "exponential", heights: CaseHeights::Exponential, ..SHORT },
            Case { name: "plateau", has_plateau: true, ..SHORT },
            Case { name: "lay", roll_off: 16e-6, elongation: 4.0, ..SHORT },
            Case { name: "pair-alike", against: Some("short-gaussian"), windows: 400, ..SHORT },
            Case { name: "pair-worn-on-lay", heights: WORN, against: Some("lay"), windows: 400, ..SHORT },
            Case { name: "slightly-patchy", roll_off: 16e-6, modulation: Some(0.1), ..SHORT },
            Case { name: "between", roll_off: 16e-6, modulation: Some(0.15), windows: 400, ..SHORT },
            Case { modulation: Some(0.5), ..PATCHY },
            case("too-long", 160e-6, 300, &[64.0, 110.0, 180.0]),
        ],
        studied: 32,
        is_small: false,
    }
};

const SHORT_LARGE: Size = {
    const SHORT: Case = case("short", 6e-6, 8, &[20.0, 80.0]);
    Size {
        points: 128,
        cases: &[SHORT, Case { name: "pair", against: Some("short"), ..SHORT }],
        studied: 4,
        is_small: false,
    }
};

/// About 14, 10 and 8 correlation lengths lie along a side of the Gaussian processes; half of the windows of the last are too short. No
/// process is that of a plateau. Waves as long as the side, without bend, may have no interval.
const SMALL: Size = {
    const CONTACTS: &[f64] = &[40.0, 80.0, 150.0];
    const GAUSSIAN: Case = case("gaussian", 75e-6, 1000, CONTACTS);
    Size {
        points: 256,
        cases: &[
            case("short-gaussian", 55e-6, 1000, CONTACTS),
            GAUSSIAN,
            case("long-gaussian", 95e-6, 1000, CONTACTS),
            Case { elongation: 2.0, ..case("lay", 40e-6, 1000, CONTACTS) },
            Case { name: "worn", heights: WORN, ..GAUSSIAN },
            Case { name: "peaked", heights: PEAKED, ..GAUSSIAN },
            Case { name: "exponential", heights: CaseHeights::Exponential, ..GAUSSIAN },
            Case { name: "plateau", has_plateau: true, ..GAUSSIAN },
            Case { name: "slightly-patchy", modulation: Some(0.1), windows: 400, ..GAUSSIAN },
            Case { name: "patchy", modulation: Some(0.3), windows: 400, ..GAUSSIAN },
            case("too-long", 256e-6, 400, &[40.0, 80.0]),
        ],
        studied: 0,
        is_small: true,
    }
};

const SHORT_SMALL: Size = Size {
    points: 256,
    cases: &[case("short-gaussian", 55e-6, 8, &[40.0, 80.0])],
    studied: 0,
    is_small: true,
};

/// Of windows that are large enough for blocks.
pub const COVERAGE: Program = Program {
    name: "coverage",
    forms: [
        Form::new("16 windows of 128 x 128 points, 2 processes", 7e6, 5e7),
        Form::new("8,200 windows of 512 x 512 points, 13 processes", 1.01e8, 1.2e11),
    ],
    tables: || vec![Schema::of::<&ProcessRow>(), Schema::of::<&Coverage>()],
    run: |task| run(task, if task.is_full { &LARGE } else { &SHORT_LARGE }),
};

/// Of windows of 8 to 15 correlation lengths, which are too small for blocks.
pub const COVERAGE_OF_SMALL_MAPS: Program = Program {
    name: "coverage-of-small-maps",
    forms: [
        Form::new("8 windows of 256 x 256 points, 1 process", 2.6e7, 1e7),
        Form::new("9,200 windows of 256 x 256 points, 11 processes", 2.6e7, 8.4e9),
    ],
    run: |task| run(task, if task.is_full { &SMALL } else { &SHORT_SMALL }),
    ..COVERAGE
};

fn run(task: &Task, size: &Size) -> Result<Evidence, Failed> {
    let law = law(!size.is_small)?;
    let maps: usize = size.cases.iter().map(|case| case.windows.div_ceil(WINDOWS_PER_MAP)).sum();
    task.progress.stage("maps", maps as f64);
    let (mut processes, mut coverages) = (Vec::new(), Vec::new());
    for case in size.cases {
        let (of_case, rows) =
            run_case(task, size, case, &law).map_err(|error| format!("case {}: {error}", case.name))?;
        coverages.extend(of_case);
        processes.extend(rows);
    }
    let mut papers = law.contact.papers();
    papers.extend(law.spec.papers());
    papers.extend([
        literature::PASARIBU_SCHIPPER_2005,
        literature::ZHAO_MAIETTA_CHANG_2000,
        literature::BUSING_1999,
    ]);
    for case in size.cases.iter().filter(|case| !matches!(case.heights, CaseHeights::Gaussian)) {
        papers.extend(case.heights.heights()?.papers());
    }
    Ok(Evidence {
        claim: claim(size, &coverages, &processes),
        drawings: vec![drawing(size, &coverages)],
        tables: vec![Table::new(&processes), Table::new(&coverages)],
        set_up: vec![format!(
            "ZMC, steel on steel. Self-affine surfaces of standard deviation {}, Hurst exponent {HURST} and cut-off {}, seen in windows of \
             {points} x {points} points at a distance of {}. Method: [theory](../../docs/theory.md#coverage).",
            input_quantity(SIGMA, "m"),
            input_quantity(CUT_OFF, "m"),
            input_quantity(PIXEL, "m"),
            points = size.points,
        )],
        papers,
        ..Evidence::default()
    })
}

/// ZMC between steel bodies; that conduct, if asked for: unit conductivity, since differences of conductances do not depend on it.
fn law(conducts: bool) -> Result<LawContact, Failed> {
    let (young, poisson, hardness) = STEEL;
    let steel = Material::new(young, poisson, Some(hardness), None)?;
    let law = LawContact::bare(named("zmc").ok_or("no such law")?, &steel, &steel)?;
    if !conducts {
        return Ok(law);
    }
    let spots = SpotProperties { thermal: Some(Conduction::new([1.0; 2])?), ..SpotProperties::default() };
    Ok(LawContact { contact: Box::new(WithSpots::new(law.contact, spots)), ..law })
}

impl CaseHeights {
    fn heights(self) -> Result<Heights, Failed> {
        Ok(match self {
            Self::Gaussian => Heights::GAUSSIAN,
            Self::Exponential => Heights::EXPONENTIAL,
            Self::Johnson(skewness, kurtosis) => Heights::new(Johnson::from_moments(skewness, kurtosis)?),
        })
    }
}

impl Case {
    /// The process of windows of `points` along a side.
    fn process(&self, size: &Size, seed: u64) -> Result<EndlessProcess, Failed> {
        let of = |roll_off: f64, sigma: f64, heights: Heights, lay: Lay| -> Result<Process, SpectrumError> {
            let shape = SpectrumShape::SelfAffine { hurst: HURST, roll_off, cut_off: CUT_OFF };
            Ok(Process { spectrum: Spectrum::new(shape, lay)?, of: SpectrumOf::Gaussian, sigma, heights })
        };
        let [sigma, roll_off, height] = PLATEAU;
        let plateau = of(roll_off, sigma, Heights::GAUSSIAN, Lay::default())?;
        let lay = Lay { elongation: self.elongation, angle: 0.0 };
        let patches = Spectrum::new(SpectrumShape::Gaussian(PATCHES), Lay::default())?;
        let second = size.cases.iter().find(|case| Some(case.name) == self.against);
        let second = second.map(|case| case.process(size, seed)).transpose()?;
        Ok(EndlessProcess {
            name: self.name,
            generator: SurfaceGenerator {
                points: [2 * size.points; 2],
                pixel: [PIXEL; 2],
                process: of(self.roll_off, SIGMA, self.heights.heights()?, lay)?,
                plateau: self.has_plateau.then_some(Plateau { process: plateau, height }),
            },
            patches: self.modulation.map(|modulation| (modulation, patches)),
            second: second.map(|second| (Box::new(second), SHIFTS)),
            seed,
        })
    }

    /// What the roughness is, besides its heights, in words; empty where it is isotropic and homogeneous.
    fn roughness(&self) -> String {
        let parts = [
            (self.elongation != 1.0).then(|| format!("elongated {}:1", self.elongation)),
            self.has_plateau.then(|| "truncated by a finer roughness".to_owned()),
            self.modulation
                .map(|of| format!("patchy, modulation {of} over {}", input_quantity(PATCHES, "m"))),
            self.against.map(|name| format!("against {name} at {SHIFTS} positions")),
        ];
        parts.into_iter().flatten().collect::<Vec<String>>().join(", ")
    }
}

/// Examines all windows of a process.
fn run_case(
    task: &Task,
    size: &Size,
    case: &Case,
    law: &LawContact,
) -> Result<(Vec<Coverage>, Vec<ProcessRow>), Failed> {
    let process = case.process(size, task.seed)?;
    let loads = process.loads(&*law.contact, case.contacts)?;
    let window = WindowTask { law, loads: &loads, generates: size.is_small, seed: task.seed };
    // Pairs have no other treatments.
    let studied = if case.against.is_some() { 0 } else { size.studied.div_ceil(WINDOWS_PER_MAP) };
    let of_map = |map: usize| -> Result<Vec<WindowResults>, Failed> {
        let windows = process.windows(&format!("map {map}"))?;
        let name = |index: usize| format!("window {index} of map {map} of {}", case.name);
        let run = |(index, positions)| window.run(&name(index), positions, map < studied);
        let results = windows.iter().map(Vec::as_slice).enumerate().map(run).collect();
        task.progress.advance(1.0);
        results
    };
    let maps = case.windows.div_ceil(WINDOWS_PER_MAP);
    let each: Result<Vec<Vec<WindowResults>>, Failed> = (0..maps).into_par_iter().map(of_map).collect();
    let windows = each?.concat();
    let coverage = |load: f64, quantity: ComparedQuantity| {
        let estimate = |(k, window): (usize, &WindowResults)| {
            let mut estimate = window.estimate(load, quantity)?;
            // The windows of a map are neighbours: asperities are taken as independent in one of them only.
            if size.is_small || k % WINDOWS_PER_MAP > 0 {
                estimate.independent_error = None;
            }
            Some(estimate)
        };
        let estimates: Vec<_> = windows.iter().enumerate().filter_map(estimate).collect();
        Coverage::new(case.name, load, quantity, &estimates)
    };
    let coverages: Vec<ByQuantity<Option<Coverage>>> =
        loads.iter().map(|&load| ComparedQuantity::ALL.map(|quantity| coverage(load, quantity))).collect();
    let truths: Vec<ByQuantity<Option<f64>>> =
        coverages.iter().map(|at_load| at_load.map(|coverage| Some(coverage?.truth))).collect();
    let mut correlations: Vec<f64> = windows.iter().map(|window| window.correlation).collect();
    let patchy = windows.iter().filter(|window| window.is_patchy).count();
    let row = |(kind, count): (&'static str, VerdictCount)| ProcessRow {
        case: case.name,
        heights: process.generator.process.heights.to_string(),
        roughness: case.roughness(),
        roll_off: case.roll_off,
        correlation: median(&mut correlations).unwrap_or(f64::INFINITY),
        windows: windows.len(),
        patchy: patchy as f64 / windows.len() as f64,
        kind,
        count,
    };
    let rows = verdicts(&windows, &truths).into_iter().filter(|(_, count)| count.windows > 0).map(row);
    let rows = rows.collect();
    Ok((coverages.into_iter().flatten().flatten().collect(), rows))
}

/// Kinds of verdicts.
const DECIDED: &str = "decided";
const LIKELY: &str = "very likely";
const ROBUST: &str = "decided, robust";

fn verdicts(windows: &[WindowResults], truths: &tables::Truths) -> [(&'static str, VerdictCount); 5] {
    let is_likely =
        |one: &WindowVerdict| matches!(one.verdict, Verdict::VeryLikelyWithin | Verdict::VeryLikelyBeyond);
    let all = || windows.iter().map(|window| window.verdicts.as_slice());
    let studied = || windows.iter().filter_map(|window| window.studied.as_deref());
    let by_interval = |one: &WindowVerdict| is_likely(one) && !one.is_on_halves;
    [
        (DECIDED, VerdictCount::over(all(), truths, |one| !is_likely(one))),
        (LIKELY, VerdictCount::over(all(), truths, by_interval)),
        ("very likely, without interval", VerdictCount::over(all(), truths, |one| one.is_on_halves)),
        ("decided, windows studied", VerdictCount::over(studied(), truths, |_| true)),
        (ROBUST, VerdictCount::over(studied(), truths, |one| one.depends_on.is_empty())),
    ]
}

/// How often claimed intervals hold the truth, and how many decided verdicts are wrong.
fn claim(size: &Size, coverages: &[Coverage], processes: &[ProcessRow]) -> String {
    let ([low, high], typical) = size.band();
    let wrong = [DECIDED, LIKELY, ROBUST].into_iter().filter_map(|kind| {
        let counts = || processes.iter().filter(|row| row.kind == kind).map(|row| row.count);
        let decided: usize = counts().map(|count| count.decided).sum();
        let wrong: usize = counts().map(|count| count.wrong).sum();
        (decided > 0)
            .then(|| format!("of {} {kind}, {}", count(decided), percent(wrong as f64 / decided as f64)))
    });
    let wrong = format!("Wrong verdicts: {}.", wrong.collect::<Vec<String>>().join("; "));
    let claiming: Vec<&Coverage> = coverages.iter().filter(|of| of.claimed_share() >= typical).collect();
    let shares: Vec<f64> = claiming.iter().filter_map(|coverage| coverage.claimed.coverage()).collect();
    let Some([lowest, highest]) = extremes(shares.iter().copied()) else {
        return format!("No combination of load and quantity has intervals in enough windows. {wrong}");
    };
    format!(
        "95 % intervals cover the truth in {:.1} to {:.1} % of the windows ({} of {} processes have them). Outside {} to {}: {} of {} \
         combinations of load and quantity with intervals in at least {} of the windows. {wrong}",
        100.0 * lowest,
        100.0 * highest,
        claiming.chunk_by(|a, b| a.case == b.case).count(),
        size.cases.len(),
        percent(low),
        percent(high),
        shares.iter().filter(|share| !(low..=high).contains(*share)).count(),
        shares.len(),
        percent(typical),
    )
}

/// Coverage against effective contacts; below, of intervals that take asperities as independent.
fn drawing(size: &Size, coverages: &[Coverage]) -> Drawing {
    let (band, typical) = size.band();
    let [low, high] = band.map(|share| 100.0 * share);
    let panel = |title: &str, share: &dyn Fn(&Coverage) -> Option<f64>| {
        let plot = Plot::new(title, Axis::log("effective contacts"), Axis::linear("coverage (%)"))
            .height(260.0)
            .legend(Legend::Below)
            .with(Layer::region_y(low, high, format!("{low} to {high} %")));
        coverages.chunk_by(|a, b| a.case == b.case).enumerate().fold(plot, |plot, (k, of_case)| {
            let point = |of: &Coverage| Some((of.contacts, 100.0 * share(of)?));
            let points: Vec<(f64, f64)> = of_case.iter().filter_map(point).collect();
            if points.is_empty() {
                return plot;
            }
            // Another marker for the series whose colour is that of an earlier one.
            let marker = if k < series_colours().len() { Marker::Circle } else { Marker::Square };
            plot.with(Layer::points(points, marker).coloured(Colour::Series(k)).named(of_case[0].case))
        })
    };
    let claimed = |of: &Coverage| of.claimed.coverage().filter(|_| of.claimed_share() >= typical);
    let mut panels = vec![panel("Intervals that are claimed", &claimed)];
    if !size.is_small {
        panels.push(panel("Asperities taken as independent", &|of| of.independent.coverage()));
    }
    Drawing {
        file: "coverage.svg",
        figure: Figure::column("Coverage of 95 % intervals", panels),
        caption: format!(
            "Coverage against effective contacts where at least {} of the windows have an interval; a point is a quantity at a load, the \
             band {low} to {high} %. Intervals that take asperities as independent are for comparison.",
            percent(typical)
        ),
    }
}
