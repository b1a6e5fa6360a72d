//! Errors by the grid against the bounds that the reference states: the same waves on coarser grids and on a fine one.

use asperity::HeightMap;
use asperity::bem::{Boundary, GridError, Options, Solver};
use asperity::literature;
use asperity::progress::{Progress, Silent};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::format::{capitalised, percent};
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};
use asperity_plot::{Axis, Colour, Figure, Layer, Marker};

use super::{SelfAffine, plot, rms, unit_pair};
use crate::{Drawing, Evidence, Failed, Form, Program, Task};

/// The surfaces and loads of both forms of `grid-bounds`.
const SHORT: Grids = Grids { points: 256, realisations: 2, pressures: &[0.02], error: 1e-6 };
const FULL: Grids = Grids { points: 1024, realisations: 60, pressures: &[0.002, 0.006, 0.02], error: 1e-6 };

/// Points of the fine grid per shortest wave.
const FINE: usize = 32;

/// The part of the contacts whose error may exceed its bound.
pub const MAY_EXCEED: f64 = 0.05;

/// Points per shortest wave along x and y: square pixels, and pixels elongated along either axis.
pub const GRIDS: [[usize; 2]; 7] = [[8, 8], [4, 4], [2, 2], [8, 2], [2, 8], [16, 4], [4, 16]];

/// Surfaces and their contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridCase {
    pub name: &'static str,
    boundary: Boundary,
    elongation: f64,
    /// Over E* g.
    cap: Option<f64>,
}

pub const CASES: [GridCase; 5] = {
    const ISOTROPIC: GridCase =
        GridCase { name: "isotropic", boundary: Boundary::Periodic, elongation: 1.0, cap: None };
    [
        ISOTROPIC,
        GridCase { name: "elongated", elongation: 3.0, ..ISOTROPIC },
        GridCase { name: "mirrored", boundary: Boundary::Mirrored, ..ISOTROPIC },
        GridCase { name: "mirrored elongated", boundary: Boundary::Mirrored, elongation: 3.0, ..ISOTROPIC },
        GridCase { name: "capped", cap: Some(0.2), ..ISOTROPIC },
    ]
};

#[derive(Debug, Clone, Copy)]
pub struct Grids {
    /// Points along a side of the fine grid, a multiple of 32.
    pub points: usize,
    pub realisations: usize,
    /// p/(E* g), below the cap.
    pub pressures: &'static [f64],
    /// Relative dual gap.
    pub error: f64,
}

/// Errors and bounds of one quantity over surfaces and loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridCheck {
    pub exceeded: usize,
    /// The error that 95 % of the contacts do not exceed.
    pub error: f64,
    pub bound: f64,
}

impl GridCheck {
    fn new(contacts: &[[f64; 2]]) -> Self {
        let mut errors: Vec<f64> = contacts.iter().map(|[error, _]| error.abs()).collect();
        errors.sort_by(f64::total_cmp);
        let within = ((1.0 - MAY_EXCEED) * errors.len() as f64).ceil() as usize;
        Self {
            exceeded: contacts.iter().filter(|[error, bound]| error.abs() > *bound).count(),
            error: errors[within.max(1) - 1],
            bound: contacts.iter().map(|[_, bound]| bound).sum::<f64>() / contacts.len() as f64,
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct GridPoint {
    pub case: GridCase,
    /// Points per shortest wave along x and y.
    pub points: [usize; 2],
    pub contacts: usize,
    /// Of ln(corrected area), of the mean gap over the r.m.s. height, of ln(stiffness).
    pub checks: [GridCheck; 3],
}

impl GridPoint {
    /// The part of the contacts whose error of each quantity exceeds its bound.
    fn exceeded(&self) -> [f64; 3] {
        self.checks.map(|check| check.exceeded as f64 / self.contacts as f64)
    }
}

/// ln(area), mean gap over r.m.s. height and ln(stiffness), with the bounds of their errors.
type Sample = [[f64; 2]; 3];

impl Grids {
    /// `None` where no point may change its pressure.
    fn samples(&self, map: &HeightMap, case: GridCase, height: f64) -> Result<Vec<Option<Sample>>, Failed> {
        let pair = unit_pair()?;
        let options = Options { boundary: case.boundary, error: self.error, cap: case.cap };
        let solver = Solver::new(map, &pair, &options)?;
        let sample = |&pressure: &f64| -> Result<Option<Sample>, Failed> {
            let contact = solver.at_pressure(pressure, &Silent)?;
            let bounds = GridError::new(&contact);
            let Some(tangent) = solver.tangent(&contact, &Silent) else { return Ok(None) };
            let stiffness = tangent.stiffness();
            Ok(Some([
                [contact.area_ratio().ln(), bounds.area],
                [contact.mean_gap() / height, bounds.load * pressure / stiffness / height],
                [stiffness.ln(), bounds.stiffness],
            ]))
        };
        self.pressures.iter().map(sample).collect()
    }
}

/// Errors and bounds of each case on each grid. One unit of progress for each surface.
pub fn grid_errors(
    grids: &Grids,
    seed: impl Fn(usize) -> [u8; 32],
    progress: &dyn Progress,
) -> Result<Vec<GridPoint>, Failed> {
    let mut points = Vec::new();
    // A little longer than 32 points: two points per wave are just more than enough.
    let cut_off = 1.04 * FINE as f64 / grids.points as f64;
    for case in CASES {
        let elongation = case.elongation;
        let process =
            SelfAffine { side: 1.0, hurst: 0.8, roll_off: 0.25, cut_off, gradient: 1.0, elongation };
        let mut contacts: Vec<[Vec<[f64; 2]>; 3]> = vec![Default::default(); GRIDS.len()];
        for realisation in 0..grids.realisations {
            let surface = process.surface(2 * grids.points, seed(realisation))?;
            let fine = centres(&surface, case, [1, 1])?;
            let height = rms(fine.heights());
            let exact = grids.samples(&fine, case, height)?;
            for (contacts, grid) in contacts.iter_mut().zip(GRIDS) {
                let coarse = centres(&surface, case, grid.map(|points| FINE / points))?;
                let found = grids.samples(&coarse, case, height)?;
                for (found, exact) in found.iter().zip(&exact) {
                    let Some((found, exact)) = found.as_ref().zip(exact.as_ref()) else { continue };
                    for (quantity, contacts) in contacts.iter_mut().enumerate() {
                        let [value, bound] = found[quantity];
                        contacts.push([value - exact[quantity][0], bound]);
                    }
                }
            }
            progress.advance(1.0);
        }
        let on_grid = contacts.iter().zip(GRIDS).filter(|(contacts, _)| !contacts[0].is_empty());
        points.extend(on_grid.map(|(contacts, grid)| GridPoint {
            case,
            points: grid,
            contacts: contacts[0].len(),
            checks: [0, 1, 2].map(|quantity| GridCheck::new(&contacts[quantity])),
        }));
    }
    Ok(points)
}

/// The map of a case whose pixels are `steps` pixels of the fine grid, from a surface on twice as many points as that: pixels
/// of all sizes fill the same rectangle, which heights at their centres need points between those of the fine grid.
fn centres(surface: &HeightMap, case: GridCase, steps: [usize; 2]) -> Result<HeightMap, Failed> {
    let [nx, ny] = surface.points();
    let part = if case.boundary == Boundary::Mirrored { 2 } else { 1 };
    let points = [nx / (2 * part * steps[0]), ny / (2 * part * steps[1])];
    let centre = |pixel: usize, axis: usize| (2 * pixel + 1) * steps[axis];
    let row = |i: usize| (0..points[1]).map(move |j| surface.heights()[centre(i, 0) * ny + centre(j, 1)]);
    let heights = (0..points[0]).flat_map(row).collect();
    let pixel = [0, 1].map(|axis| surface.pixel()[axis] * (2 * steps[axis]) as f64);
    let map = HeightMap::new(points, pixel, heights, 0.0)?;
    Ok(if part == 1 { map.periodic() } else { map })
}

pub const GRID_BOUNDS: Program = Program {
    name: "grid-bounds",
    forms: [
        Form::new("5 x 2 surfaces on 256 points a side and 7 coarser grids, 1 load", 8e6, 4e7),
        Form::new("5 x 60 surfaces on 1024 points a side and 7 coarser grids, 3 loads", 1.08e8, 5.7e10),
    ],
    tables: || vec![Schema::of::<&GridPoint>()],
    run,
};

fn run(task: &Task) -> Result<Evidence, Failed> {
    let grids = if task.is_full { &FULL } else { &SHORT };
    task.progress.stage("grids", (CASES.len() * grids.realisations) as f64);
    let grid = grid_errors(grids, |k| task.stream_seed(&format!("solver grid {k}")), task.progress)?;
    Ok(Evidence {
        claim: claim(&grid),
        warnings: warnings(&grid),
        drawings: vec![drawing(&grid)],
        tables: vec![Table::new(&grid)],
        set_up: vec!["Method: [theory](../../docs/theory.md#how-the-reference-is-checked).".to_owned()],
        papers: vec![literature::POLONSKY_KEER_1999, literature::YASTREBOV_2017],
        ..Evidence::default()
    })
}

const QUANTITIES: [&str; 3] = ["area", "separation", "stiffness"];

/// The part of all contacts whose error of each quantity exceeds its bound.
fn exceeded(grid: &[GridPoint]) -> [f64; 3] {
    let contacts: usize = grid.iter().map(|point| point.contacts).sum();
    let exceeded = |quantity: usize| grid.iter().map(|point| point.checks[quantity].exceeded).sum::<usize>();
    [0, 1, 2].map(|quantity| exceeded(quantity) as f64 / contacts as f64)
}

/// How many errors exceed the bounds that the reference states, on average and in the worst class.
fn claim(grid: &[GridPoint]) -> String {
    let contacts: usize = grid.iter().map(|point| point.contacts).sum();
    let most = |parts: [f64; 3]| parts.into_iter().fold(0.0, f64::max);
    let classes = grid.iter().map(|point| (most(point.exceeded()), point.case.name));
    let (in_class, class) = classes.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
    format!(
        "At most {} of the errors on {contacts} coarse contacts exceed their stated bound (allowed: {}); of {class} surfaces on the worst \
         grid, {}.",
        percent(most(exceeded(grid))),
        percent(MAY_EXCEED),
        percent(in_class),
    )
}

/// Bounds that too many errors exceed, a line each.
fn warnings(grid: &[GridPoint]) -> Vec<String> {
    let parts = QUANTITIES.into_iter().zip(exceeded(grid)).filter(|(_, part)| *part > MAY_EXCEED);
    let line = |(quantity, part): (&str, f64)| {
        let (part, allowed) = (percent(part), percent(MAY_EXCEED));
        format!("grid: {part} of the errors of the {quantity} exceed their bound; allowed: {allowed}")
    };
    parts.map(line).collect()
}

/// The share of the contacts whose errors exceed their bounds, against points per shortest wave on the coarser axis.
fn drawing(grid: &[GridPoint]) -> Drawing {
    const MARKERS: [Marker; 5] =
        [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Cross, Marker::Ring];
    let panel = |(quantity, name): (usize, &str)| {
        let points = Axis::log("points per shortest wave").range(1.6, 10.0);
        let plot = plot(&capitalised(name), points, Axis::linear("errors beyond their bound (%)"));
        let plot = plot.with_zero().with(Layer::at_y(100.0 * MAY_EXCEED, "allowed of all"));
        CASES.into_iter().zip(MARKERS).enumerate().fold(plot, |plot, (k, (case, marker))| {
            let of_case = grid.iter().filter(|point| point.case == case);
            let places = of_case.map(|point| {
                (point.points[0].min(point.points[1]) as f64, 100.0 * point.exceeded()[quantity])
            });
            plot.with(Layer::points(places, marker).coloured(Colour::Series(k)).named(case.name))
        })
    };
    let panels = QUANTITIES.into_iter().enumerate().map(panel);
    Drawing {
        file: "grid.svg",
        figure: Figure::row("Errors by the grid beyond their bounds", panels.collect()),
        caption: "Share of the contacts whose error exceeds the bound that the reference states, against points per shortest wave on the \
                  coarser axis; of all contacts 5 % may."
            .to_owned(),
    }
}

impl Row for &GridPoint {
    const FILE: &'static str = "grid.csv";
    const ROWS: &'static str = "One row for each case and coarse grid: errors against 32 points per shortest wave, and the bounds that the reference states.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            grid_case["text", label("surfaces")] = row.case.name, "Surfaces and contact: `isotropic`, `elongated` (lengths along x three times those along y), a quarter of such a surface `mirrored`, or `capped` (isotropic, pressures up to 0.2 E* g).";
            points_per_wave_x["count", label("points per wave, x")] = row.points[0], "Points along x per shortest wave; of elongated surfaces per shortest wave across the lay.";
            points_per_wave_y["count", label("y")] = row.points[1], "The same along y.";
            contacts["count"] = row.contacts, "Surfaces times loads.";
            area_exceeded["count", label("area: beyond bound")] = row.checks[0].exceeded, "Contacts whose error of ln(corrected area) exceeds its bound.";
            area_error["1", label("95 % of errors")] = row.checks[0].error, "Error of ln(corrected area) that 95 % of the contacts do not exceed.";
            area_bound["1", label("mean bound")] = row.checks[0].bound, "Mean of the bounds.";
            separation_exceeded["count", label("separation: beyond bound")] = row.checks[1].exceeded, "Contacts whose error of the mean gap exceeds its bound.";
            separation_error["1", label("95 % of errors")] = row.checks[1].error, "Error of the mean gap over the r.m.s. height that 95 % of the contacts do not exceed.";
            separation_bound["1", label("mean bound")] = row.checks[1].bound, "Mean of the bounds over the r.m.s. height.";
            stiffness_exceeded["count", label("stiffness: beyond bound")] = row.checks[2].exceeded, "Contacts whose error of ln(stiffness) exceeds its bound.";
            stiffness_error["1", label("95 % of errors")] = row.checks[2].error, "Error of ln(stiffness) that 95 % of the contacts do not exceed.";
            stiffness_bound["1", label("mean bound")] = row.checks[2].bound, "Mean of the bounds.";
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_twentieth_of_the_errors_may_be_larger() {
        let contacts: Vec<[f64; 2]> = (1..=40).map(|k| [-0.01 * f64::from(k), 0.385]).collect();
        let check = GridCheck::new(&contacts);
        assert_eq!(check.exceeded, 2);
        assert!((check.error - 0.38).abs() < 1e-15 && (check.bound - 0.385).abs() < 1e-15);
        assert_eq!(GridCheck::new(&contacts[..1]).error, 0.01);
    }

    #[test]
    fn the_claim_has_the_mean_of_all_and_the_worst_class() {
        let point = |case: usize, exceeded: usize| {
            let check = |exceeded| GridCheck { exceeded, error: 0.1, bound: 0.2 };
            GridPoint {
                case: CASES[case],
                points: [2, 2],
                contacts: 50,
                checks: [check(exceeded), check(0), check(1)],
            }
        };
        let claim = claim(&[point(0, 1), point(1, 4)]);
        let worst = format!("of {} surfaces on the worst grid, 8 %.", CASES[1].name);
        assert!(
            claim.starts_with("At most 5 % of the errors on 100 coarse contacts") && claim.ends_with(&worst),
            "{claim}"
        );
    }
}
