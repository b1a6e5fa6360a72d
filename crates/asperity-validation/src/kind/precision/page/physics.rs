//! Effect of more asperities, more points and more surface.

use super::{figures, file, time, two_digits};
use crate::kind::precision::run::{CasePrecision, PrecisionResults};
use crate::precision::grid::{Doubling, GridFindings, GridPoint};
use crate::precision::sampling::{SamplingFindings, separation, stated};
use asperity::MIN_CONTACTS;
use asperity::compare::Quantity;
use asperity_framework::report::format::{count, input_number, number, percent};
use asperity_framework::report::page::{Page, escape};

/// Summary of these effects.
pub fn summary_lines(results: &PrecisionResults) -> Vec<String> {
    let mut lines: Vec<String> = results.cases.iter().filter_map(asperities_line).collect();
    lines.extend(results.grid.as_ref().and_then(grid_line));
    lines
}

fn asperities_line(case: &CasePrecision) -> Option<String> {
    let tenfold = case.sampling.as_ref()?.tenfold()?;
    Some(format!(
        "**Asperities, {}**: ten times as many cost {} times the time and make the sampling error of the load {} times smaller (theory: √10 = 3.16).",
        escape(&case.name),
        number(two_digits(tenfold.time)),
        number(two_digits(tenfold.error)),
    ))
}

fn grid_line(found: &GridFindings) -> Option<String> {
    let Doubling { bias, scatter, time } = found.doubling()?;
    Some(format!(
        "**Surface**: twice the points per correlation length cost {cost} times the time and make the bias of the radius \
         {} times smaller; twice the side costs the same and makes the scatter of the density {} times smaller. A finer grid does not help where the map is too small, nor a larger map where the grid is too coarse.",
        number(two_digits(bias)),
        number(two_digits(scatter)),
        cost = number(two_digits(time)),
    ))
}

/// The sections on random sets and on random maps.
pub fn sections(page: &mut Page, results: &PrecisionResults) {
    if results.cases.iter().any(|case| case.sampling.is_some()) {
        page.heading(2, "Number of asperities");
        page.paragraph(&format!(
            "{} random sets of each size are summed and compared with the integral, their limit. The root mean square of \
             their errors is the error of a single set; each sum also estimates its sampling error from its own \
             asperities. With fewer than {MIN_CONTACTS} contacts neither is reliable.",
            results.draws
        ));
        for case in &results.cases {
            if let Some(found) = &case.sampling {
                sets(page, case, found);
            }
        }
    }
    if let Some(found) = &results.grid {
        maps(page, found);
    }
}

fn sets(page: &mut Page, case: &CasePrecision, found: &SamplingFindings) {
    page.heading(3, &case.name);
    page.figure(
        &format!("{}-sampling.svg", file(&case.name)),
        figures::sampling(found),
        "Left: error of the load against the number of asperities, measured (circles) and estimated by the sums (dashed). \
         Right: time to draw a set and sum it at all these separations, against the measured error.",
    );
    let largest = found.points.iter().map(|point| point.count).max().unwrap_or(0);
    let seconds =
        found.seconds.iter().find(|(count, _)| *count == largest).map_or(0.0, |(_, seconds)| *seconds);
    page.paragraph(&format!("Sets of {} asperities, {} to draw and sum:", count(largest), time(seconds)));
    page.table(
        ["d/σ", "expected contacts", "area error", "estimated", "load error", "estimated"],
        found.points.iter().filter(|point| point.count == largest).map(|point| {
            let pair = |quantity| [percent(point.scatter(quantity).1), percent(stated(point, quantity))];
            let mut row = vec![input_number(separation(point)), number(point.expected_contacts())];
            row.extend(pair(Quantity::Area).into_iter().chain(pair(Quantity::Load)));
            row
        }),
    );
    page.paragraph(&format!(
        "A load within 1 % at d/σ = {} requires about {} asperities, within 0.1 % about {}: a hundred times as many.",
        input_number(found.least_separation()),
        number(two_digits(found.needed(0.01))),
        number(two_digits(found.needed(0.001))),
    ));
}

fn maps(page: &mut Page, found: &GridFindings) {
    page.heading(2, "Size of the surface");
    page.paragraph(
        "Random Gaussian surfaces with the autocorrelation exp(-(r/l)²), for which the five-point summits on a grid are known in theory. *Bias*: \
         theory on this grid relative to theory on a fine grid; it does not decrease with the size of the map. *Scatter*: \
         deviation of a single map from theory on its own grid, root mean square; it does not decrease with a finer grid. The fine grid has 1.306 times the summits of a continuous \
         surface (Nayak), since the five-point criterion also counts saddles, on any grid.",
    );
    page.figure(
        "grid.svg",
        figures::grid(found),
        "Left: bias against points per correlation length. Right: scatter against the number of summits, maps of all \
         grids.",
    );
    page.figure(
        "surface-work.svg",
        figures::surface_work(found),
        "Time for a map and its summits against both errors of the radius together. The size of the map increases along \
         each line; where the line turns up, only a finer grid reduces the error.",
    );
    page.table(
        [
            "points per length",
            "density bias",
            "radius bias",
            "σ bias",
            "sides [l]",
            "points",
            "summits",
            "density scatter",
            "radius",
            "σ",
            "time",
        ],
        found.points.iter().map(|point| {
            let GridPoint { per_length, lengths, points, summits, bias, scatter, seconds } = *point;
            let mut row = vec![input_number(per_length)];
            row.extend(bias.map(percent));
            row.extend([input_number(lengths), format!("{points} x {points}"), number(summits)]);
            row.extend(scatter.map(percent));
            row.push(time(seconds));
            row
        }),
    );
    if let Some(text) = cheapest(found) {
        page.paragraph(&text);
    }
}

/// The cheapest map for a radius within some percent.
fn cheapest(found: &GridFindings) -> Option<String> {
    let best = |error: f64| {
        let best = found.cheapest(error)?;
        Some(format!(
            "within {} it has {} points per length and {} lengths per side ({})",
            percent(error),
            input_number(best.per_length),
            input_number(best.lengths),
            time(best.seconds)
        ))
    };
    let lines: Vec<String> = [0.1, 0.03, 0.01, 0.003].into_iter().filter_map(best).collect();
    (!lines.is_empty())
        .then(|| format!("The cheapest map for the radius of the mean curvature: {}.", lines.join("; ")))
}
