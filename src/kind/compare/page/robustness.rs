//! Whether the verdicts survive other treatments of the map: a sentence, a table, and the differences against the filter.

use asperity::MeanRadius;
use asperity::compare::{ComparedQuantity, Difference, Verdict};
use asperity_framework::report::format::{capitalised, listed, number, quantity};
use asperity_framework::report::page::{Page, escape_around_code};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use super::verdict::{loads, name, signed, verdict};
use crate::kind::compare::findings::Verdicts;
use crate::kind::compare::results::SurfaceResults;
use crate::kind::compare::robustness::{Choice, Dependence, Robustness, Treatment};

const ORDER: [ComparedQuantity; 3] = ComparedQuantity::REPORTED;

/// What the verdicts of case `index` depend on, in a sentence; `None` where they depend on no choice.
pub fn sentence(found: &SurfaceResults, index: usize) -> Option<String> {
    let robustness = found.robustness.as_ref()?;
    let all = robustness.dependences.get(index)?;
    let clauses: Vec<String> = main_dependences(all)
        .into_iter()
        .map(|(first, has_others)| clause(first, robustness, found, has_others))
        .collect();
    let differences = &found.findings.cases[index].verdicts.differences;
    let has_interval =
        |at: &Difference| at.estimates.iter().flatten().any(|estimate| estimate.interval().is_some());
    // Without an interval there is no verdict to depend on anything.
    let what =
        if differences.iter().any(has_interval) { "The verdict depends" } else { "The differences depend" };
    (!clauses.is_empty()).then(|| format!("{what} on {}.", clauses.join("; and on ")))
}

/// Of each choice that decides, the dependence of the quantity that the headline names first, and whether it decides others too.
fn main_dependences(all: &[Dependence]) -> Vec<(&Dependence, bool)> {
    let of_choice = |choice: &Choice| {
        let of: Vec<&Dependence> = all.iter().filter(|one| one.choice == *choice).collect();
        let first = ORDER.into_iter().find_map(|compared| of.iter().find(|one| one.quantity == compared))?;
        Some((*first, of.len() > 1))
    };
    Choice::ALL.iter().filter_map(of_choice).collect()
}

/// On which choices the verdicts of how many cases (`what`: thicknesses, laws) depend; `None` where none does.
pub fn over_cases(found: &SurfaceResults, what: &str) -> Option<String> {
    let cases = &found.robustness.as_ref()?.dependences;
    let of_choice = |one: &Choice| {
        let depends = |all: &&Vec<Dependence>| all.iter().any(|dependence| dependence.choice == *one);
        let count = cases.iter().filter(depends).count();
        (count > 0).then(|| format!("{} for {count} of {}", choice(*one), cases.len()))
    };
    let clauses: Vec<String> = Choice::ALL.iter().filter_map(of_choice).collect();
    (!clauses.is_empty()).then(|| format!("The differences depend on {} {what}.", listed(&clauses)))
}

/// "the short-wavelength cut-off (separation at 1 MPa: −0.88 σ without an S filter, +0.25 σ with S = 3.2 um)".
fn clause(
    dependence: &Dependence,
    robustness: &Robustness,
    found: &SurfaceResults,
    has_others: bool,
) -> String {
    let ends = [0, 1].map(|end| {
        let how = match dependence.treatments[end] {
            Some(place) => label(&robustness.treated[place].treatment),
            None => own(dependence.choice, robustness, found),
        };
        format!("{} {how}", signed(dependence.quantity, dependence.contrasts[end]))
    });
    let others = if has_others { ", other quantities too" } else { "" };
    format!(
        "{} ({} at {}: {}, {}{others})",
        choice(dependence.choice),
        name(dependence.quantity),
        loads([dependence.load; 2]),
        ends[0],
        ends[1]
    )
}

fn choice(choice: Choice) -> &'static str {
    match choice {
        Choice::ShortWaves => "the short-wavelength cut-off",
        Choice::Summits => "the definition of a summit",
        Choice::MeanRadius => "the mean radius of the statistical model",
        Choice::Level => "the form removed",
        Choice::Spikes => "a few spikes",
        Choice::Part => "the part of the map",
    }
}

/// A treatment after a value.
fn label(treatment: &Treatment) -> String {
    match treatment {
        Treatment::ShortWaves(None) => "without an S filter".to_owned(),
        Treatment::ShortWaves(Some(s)) => format!("with S = {}", quantity(*s, "m")),
        Treatment::Summits(neighbours) => format!("with {} summits", neighbours.name()),
        Treatment::MeanRadius(MeanRadius::Arithmetic) => "with the arithmetic mean radius".to_owned(),
        Treatment::MeanRadius(MeanRadius::InverseMeanCurvature) => "with 1/(mean curvature)".to_owned(),
        Treatment::MeanRadius(MeanRadius::InContact) => "with the mean radius in contact".to_owned(),
        Treatment::Level(level) => format!("with level = \"{}\"", level.name()),
        Treatment::SpikesRemoved => "without the spikes".to_owned(),
        Treatment::Half(0) => "on the first half".to_owned(),
        Treatment::Half(_) => "on the second half".to_owned(),
    }
}

/// The map's own way of making a choice, after a value.
fn own(choice: Choice, robustness: &Robustness, found: &SurfaceResults) -> String {
    let map = found.surface.map.as_ref();
    match choice {
        Choice::ShortWaves => label(&Treatment::ShortWaves(robustness.own_cut_off)),
        Choice::Summits => map.map_or_else(String::new, |map| label(&Treatment::Summits(map.neighbours))),
        Choice::Level => map.map_or_else(String::new, |map| label(&Treatment::Level(map.level))),
        Choice::MeanRadius | Choice::Spikes | Choice::Part => "as analysed".to_owned(),
    }
}

/// Table and figure for case `index`; nothing where no treatments were examined.
pub fn section(page: &mut Page, found: &SurfaceResults, index: usize, title: &str, stem: &str) {
    let Some(robustness) = &found.robustness else { return };
    let examined = robustness.loads(index);
    let Some(load) = shown_load(robustness, index) else { return };
    let verdicts = &found.findings.cases[index].verdicts;
    let all = examined.len();
    let finding = sentence(found, index).map_or_else(
        || "No other treatment of the map changes the answer.".to_owned(),
        |found| escape_around_code(&found),
    );
    page.paragraph(&format!(
        "{finding} Both models were computed again under each treatment at {all} valid loads from {}; the table shows them at {}.",
        loads([examined[0], examined[all - 1]]),
        loads([load; 2])
    ));
    let own = verdicts.differences.iter().find(|at| at.load == load);
    let mut rows = vec![row("as analysed", own, verdicts)];
    rows.extend(robustness.treated.iter().map(|one| {
        let at = one.differences(index).iter().find(|at| at.load == load);
        row(&label(&one.treatment), at, verdicts)
    }));
    page.table(["treatment", "real contact area", "separation", "stiffness", "effective contacts"], rows);
    page.paragraph(
        "Statistical minus deterministic model at equal load, with the verdict by its 95 % interval. A verdict depends on a choice \
         where two ways of making it give opposite verdicts at one load; without intervals, where they give differences on \
         different sides of what is accepted, further apart than that.",
    );
    if let Some(svg) = against_filter(robustness, verdicts, index, found) {
        page.figure(
            &format!("{stem}-filter.svg"),
            svg,
            &format!(
                "{title}: differences between the models against the nesting index of the S filter, the shortest wavelength left, \
                 at up to three loads. Without a filter the points are drawn at one pixel. Green: accepted."
            ),
        );
    }
}

/// The load (Pa) of the table: that of the first dependence in the headline, else the middle one.
fn shown_load(robustness: &Robustness, index: usize) -> Option<f64> {
    let examined = robustness.loads(index);
    let middle = examined.get(examined.len() / 2).copied();
    main_dependences(&robustness.dependences[index]).first().map(|(first, _)| first.load).or(middle)
}

fn row(treatment: &str, at: Option<&Difference>, verdicts: &Verdicts) -> Vec<String> {
    let mut row = vec![treatment.to_owned()];
    row.extend(ORDER.map(|compared| {
        let estimate = at.and_then(|at| at.estimates[compared as usize]);
        let Some(estimate) = estimate else { return "–".to_owned() };
        let value = signed(compared, estimate.contrast);
        match at.filter(|at| at.exceeded().is_none()) {
            None => format!("{value} (not valid)"),
            Some(_) => {
                format!("{value} ({})", verdict(Verdict::of(&estimate, verdicts.accepted.band(compared))))
            }
        }
    }));
    let contacts = at.and_then(|at| at.sharing).map(|sharing| sharing.effective_contacts);
    row.push(contacts.map_or_else(|| "–".to_owned(), number));
    row
}

/// How much of the axis is shown at least, in accepted differences.
const VIEW: f64 = 1.5;

/// Differences of area and separation against the nesting index; `None` where fewer than two filters gave an answer.
fn against_filter(
    robustness: &Robustness,
    verdicts: &Verdicts,
    index: usize,
    found: &SurfaceResults,
) -> Option<Figure> {
    let map = found.surface.map.as_ref()?;
    let pixel = 1e6 * map.pixel[0].max(map.pixel[1]);
    let mut filtered: Vec<(f64, &[Difference])> = robustness
        .treated
        .iter()
        .filter_map(|one| match one.treatment {
            Treatment::ShortWaves(s) => Some((s.map_or(pixel, |s| 1e6 * s), one.differences(index))),
            _ => None,
        })
        .filter(|(_, differences)| !differences.is_empty())
        .collect();
    let has_none = robustness.own_cut_off.is_none()
        || robustness.treated.iter().any(|one| one.treatment == Treatment::ShortWaves(None));
    filtered.push((robustness.own_cut_off.map_or(pixel, |s| 1e6 * s), &verdicts.differences));
    filtered.sort_by(|a, b| a.0.total_cmp(&b.0));
    if filtered.len() < 2 {
        return None;
    }
    let examined = robustness.loads(index);
    let mut shown = vec![examined[0], shown_load(robustness, index)?, examined[examined.len() - 1]];
    shown.dedup();
    let ends = [filtered[0].0 / 1.2, filtered[filtered.len() - 1].0 * 1.2];
    let panels = [
        (ComparedQuantity::Area, "difference (%)", 100.0),
        (ComparedQuantity::Separation, "difference (σ)", 1.0),
        (ComparedQuantity::Stiffness, "difference (%)", 100.0),
    ];
    let is_compared = |compared: ComparedQuantity| {
        verdicts.differences.iter().any(|at| at.estimates[compared as usize].is_some())
    };
    let panels = panels.into_iter().filter(|(compared, ..)| is_compared(*compared));
    let plots = panels.map(|(compared, label, unit)| {
        let accepted = unit * verdicts.accepted.of(compared);
        let axis = Axis::log("S filter (µm)").range(ends[0], ends[1]);
        let values = filtered.iter().flat_map(|(_, differences)| differences.iter());
        let values = values.filter(|at| shown.contains(&at.load));
        let values =
            values.filter_map(|at| Some(unit * compared.reported(at.estimates[compared as usize]?.contrast)));
        let [low, high] = values.fold([-VIEW * accepted, VIEW * accepted], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        let room = 0.05 * (high - low);
        let mut plot =
            Plot::new(capitalised(name(compared)), axis, Axis::linear(label).range(low - room, high + room))
                .height(210.0)
                .with(Layer::region_y(-accepted, accepted, "accepted").coloured(Colour::Series(2)))
                .with_zero();
        if has_none {
            plot = plot.with(Layer::at_x(pixel, "no filter"));
        }
        for ((place, load), dash) in shown.iter().enumerate().zip([Dash::Solid, Dash::Dashed, Dash::Dotted]) {
            let points = filtered.iter().filter_map(|(s, differences)| {
                let at = differences.iter().find(|at| at.load == *load)?;
                Some((*s, unit * compared.reported(at.estimates[compared as usize]?.contrast)))
            });
            let points: Vec<(f64, f64)> = points.collect();
            let colour = Colour::Series(place);
            plot = plot
                .with(Layer::line(points.clone()).coloured(colour).dashed(dash).named(loads([*load; 2])))
                .with(Layer::points(points, Marker::Circle).coloured(colour));
        }
        plot
    });
    let title =
        format!("{}: statistical − deterministic model at equal load, by S filter", found.surface.name);
    Some(Figure::row(title.clone(), plots.collect()).headed(title))
}
