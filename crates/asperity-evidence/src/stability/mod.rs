//! Numerical error of `f64`: thousands of random and adversarial cases over the whole range of representable inputs, each checked by an
//! evaluation of about 32 digits that shares nothing with the models but the equations.

mod cases;
mod check;
mod groups;

pub use cases::{Layout, SetParameters};
pub use groups::{CheckKind, CheckedQuantity, Counts, Group, GroupResults, WorstCase, check_group};

use crate::exact::{CoveredLaw, density_of};
use crate::{Drawing, Evidence, Failed, Form, Program, Task};
use asperity::contact_law::registry;
use asperity::distribution::{Entry, REGISTRY};
use asperity::{ContactLaw, literature};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::format::{count, listed, one_digit};
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};
use asperity_plot::{Axis, Colour, Layer, Marker, Plot};
use check::Failure;

/// Cases of each group; of the full form the last digit of an error is better known.
const SHORT: Counts = Counts { contacts: 1000, sums: 200, integrals: 250, loads: 50, millions: 2 };
const FULL: Counts = Counts { contacts: 20_000, sums: 4000, integrals: 5000, loads: 1000, millions: 10 };

pub const STABILITY: Program = Program {
    name: "stability",
    forms: [
        Form::new("8,004 cases in 25 groups", 4e8, 5e7),
        Form::new("160,020 cases in 25 groups", 4e8, 9.3e8),
    ],
    tables: || vec![Schema::of::<&GroupResults>(), Schema::of::<WorstRow>()],
    run,
};

fn run(task: &Task) -> Result<Evidence, Failed> {
    let counts = if task.is_full { FULL } else { SHORT };
    let progress = task.progress;
    progress.steps(Group::ALL.len() as u64);
    let seed = task.stream_seed("stability");
    let groups = Group::ALL.map(|group| {
        let count = counts.in_group(group);
        progress.stage(group.name(), count as f64);
        let results = check_group(group, count, seed, progress);
        progress.step();
        results
    });
    let worst = groups.iter().flat_map(|group| group.worst.iter().map(move |worst| WorstRow(group, worst)));
    let of_layers = [
        literature::PASARIBU_SCHIPPER_2005,
        literature::GAO_CHIU_LEE_1992,
        literature::SWAIN_MENCIK_1994,
        literature::SONG_PHARR_1999,
        literature::BHATTACHARYA_NIX_1988,
    ];
    let method = "Method: [stability](../../docs/stability.md).".to_owned();
    Ok(Evidence {
        claim: claim(&groups),
        warnings: groups.iter().filter_map(warning).collect(),
        drawings: vec![drawing(&groups)],
        tables: vec![Table::new(&groups), Table::new(worst)],
        hidden: WorstRow::FILE,
        set_up: not_covered().into_iter().chain([method]).collect(),
        papers: registry().iter().flat_map(ContactLaw::papers).chain(of_layers).collect(),
    })
}

/// The number of cases, whether all are within their bounds, and the largest error.
fn claim(groups: &[GroupResults]) -> String {
    let cases: u64 = groups.iter().map(|group| group.cases).sum();
    let cases = count(cases as usize);
    let verdict = match groups.iter().filter(|group| !group.is_within_bounds()).count() {
        0 => format!("All {cases} cases are within their error bounds"),
        beyond => format!("{beyond} of {} groups of cases are not within their error bounds", groups.len()),
    };
    let errors = groups
        .iter()
        .flat_map(|group| group.worst.iter().map(move |worst| (worst.largest, group.group.kind())));
    let largest = errors.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(error, kind)| {
        format!(" The largest relative error against 32 digits is {} ({}).", one_digit(error), kind.name())
    });
    format!("{verdict}.{}", largest.unwrap_or_default())
}

/// What is wrong first in a group.
fn warning(group: &GroupResults) -> Option<String> {
    let violations: Vec<_> = group.violations().collect();
    let (violation, case) = violations.first()?;
    let others = match violations.len() - 1 {
        0 => String::new(),
        others => format!(", and {others} more"),
    };
    Some(format!("{}, case {}: {violation}{others}", group.group.name(), case.index))
}

/// Laws and heights without an evaluation in 32 digits; `None` if there are none.
fn not_covered() -> Option<String> {
    let is_covered = |entry: &&Entry| entry.example().is_ok_and(|heights| density_of(&heights).is_some());
    let heights = REGISTRY.iter().filter(|entry| !is_covered(entry));
    let heights = heights.map(|entry| format!("integrals over {} heights", entry.name));
    let [_, laws] = CoveredLaw::coverage();
    let names: Vec<String> = laws.into_iter().map(|law| format!("law {law}")).chain(heights).collect();
    (!names.is_empty())
        .then(|| format!("Not covered, because there is no evaluation in 32 digits: {}.", listed(&names)))
}

/// The largest errors of each group, and their bound.
fn drawing(groups: &[GroupResults]) -> Drawing {
    /// Smaller errors are shown at this value.
    const FLOOR: f64 = 1e-17;
    let names = Axis::named(Group::ALL.map(|group| group.name().to_owned()));
    let error = Axis::log("largest relative error").range(FLOOR / 2.0, 2e-11);
    let plot = Plot::new("Errors against 32 digits", error, names).height(560.0);
    let places = |of: &dyn Fn(&GroupResults) -> Option<f64>| -> Vec<(f64, f64)> {
        let values = groups.iter().enumerate();
        values.filter_map(|(k, group)| Some((of(group)?.max(FLOOR), k as f64))).collect()
    };
    let bounds = places(&|group| Some(group.group.bound(CheckedQuantity::Load)));
    let plot = plot.with(Layer::points(bounds, Marker::Cross).coloured(Colour::Neutral).named("bound"));
    let plot = CheckedQuantity::ALL.into_iter().enumerate().fold(plot, |plot, (k, quantity)| {
        let points = Layer::points(places(&|group| group.largest_error(quantity)), Marker::Circle);
        plot.with(points.coloured(Colour::Series(k)).named(quantity.name()))
    });
    Drawing {
        file: "stability.svg",
        figure: plot.into(),
        caption: "Largest error of each quantity in each group of cases, and the bound of the group; of stiffnesses that are slopes of \
                  tables it is 1e-11. Smaller errors are shown at 1e-17."
            .to_owned(),
    }
}

impl Row for &GroupResults {
    const FILE: &'static str = "groups.csv";
    const ROWS: &'static str = "One row for each group of cases: the largest errors relative to an evaluation of 32 digits, zero where the result is exact for a separation within rounding of the given one. Empty where the group does not have the quantity.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            kind["text"] = row.group.kind().name(), "What is evaluated: `single contact`, `sum`, `integral` or `load control`.";
            group["text"] = row.group.name(), "Group of cases.";
            description["text"] = row.group.about(), "Its cases.";
            cases["count"] = row.cases, "Cases checked.";
            failures["count"] = row.failures.len(), "Cases that failed or could not be checked.";
            not_finite["count"] = row.failures.iter().filter(|(_, failure)| matches!(failure, Failure::NotFinite(_))).count(), "Of these, cases with a NaN or an infinity.";
            within_bounds["true/false"] = row.is_within_bounds(), "Whether every case was checked and every quantity is within its bound.";
            bound["1", one_digit] = row.group.bound(CheckedQuantity::Load), "Bound of all errors but those of slopes of tables, before the factor of a narrow transition; without a layer, of laws in closed form.";
            area_error["1", label("area"), one_digit, ignored] = row.largest_error(CheckedQuantity::Area), "Error of the area.";
            load_error["1", label("load"), one_digit, ignored] = row.largest_error(CheckedQuantity::Load), "Error of the load or nominal pressure.";
            stiffness_error["1", label("stiffness"), one_digit, ignored] = row.largest_error(CheckedQuantity::Stiffness), "Error of the stiffness.";
            contact_density_error["1", label("contact density"), one_digit, ignored] = row.largest_error(CheckedQuantity::Density), "Error of the contacts per nominal area.";
            regime_share_error["1", label("regime shares"), one_digit, ignored] = row.largest_error(CheckedQuantity::Shares), "Absolute error of the parts of area and load in each regime.";
            sampling_error["1", one_digit, ignored] = row.largest_error(CheckedQuantity::Sampling), "Error of the variances of area and load over the mean square.";
            pressure_error["1", label("pressure reached"), one_digit, ignored] = row.largest_error(CheckedQuantity::Reached), "Error of the pressure on which load control ends.";
        }
    }
}

/// The errors of one quantity over the cases of a group.
pub struct WorstRow<'a>(&'a GroupResults, &'a WorstCase);

impl Row for WorstRow<'_> {
    const FILE: &'static str = "stability.csv";
    const ROWS: &'static str =
        "One row for each group of cases and quantity: errors relative to an evaluation of 32 digits.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            kind["text"] = row.0.group.kind().name(), "What is evaluated: `single contact`, `sum`, `integral` or `load control`.";
            group["text"] = row.0.group.name(), "Group of cases.";
            quantity["text"] = row.1.quantity.name(), "Quantity whose error is given.";
            cases["count"] = row.0.cases, "Cases checked.";
            failures["count"] = row.0.failures.len(), "Cases that failed or could not be checked.";
            median_error["1", one_digit, ignored] = row.1.median, "Median of the errors.";
            worst_error["1", one_digit, ignored] = row.1.checked, "Error of the case closest to its bound; zero where the result is exact for a separation within rounding of the given one.";
            bound["1", one_digit] = row.0.group.bound(row.1.quantity), "Bound of the error under most laws.";
            plain_error["1", one_digit, ignored] = row.1.error, "Largest error, the rounding of the separation included.";
            worst_bound["1", label("bound of the worst case"), one_digit, ignored] = row.1.bound(), "Bound of the case closest to its bound, which a narrow elastic-plastic transition makes larger.";
            worst_scene["count", label("worst case"), ignored] = row.1.case.index, "Number of that case within its group.";
            worst_inputs["text", ignored] = row.1.case.inputs(), "Every input of that case, to run it again.";
        }
    }
}
