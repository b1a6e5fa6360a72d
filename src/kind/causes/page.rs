//! The page: which cause leads where, a map for each load, the contributions over the skewness, and all numbers.

use asperity::Exceeded;
use asperity::compare::{Cause, ComparedQuantity, Contributions};
use asperity_framework::report::format::{
    capitalised, count, input_number, input_quantity, listed, number, percent,
};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;
use asperity_plot::{Axis, Colour, Figure, Layer, Legend, Marker, Plot};

use super::findings::{Findings, Lead};
use super::results::{CausesResults, GridPoint, QUANTITIES};
use crate::kind::compare::page::causes::colour;
use crate::kind::compare::page::verdict::{limit_words, loads, name, signed};

pub fn page(results: &CausesResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    let each = |load: usize| QUANTITIES.map(|quantity| Findings::of(results, quantity, load));
    let findings: Vec<Findings> = (0..results.loads.len()).flat_map(each).collect();
    sections::findings(
        &mut page,
        findings.iter().map(|found| sentence(results, found)).chain(of_radii(&findings)),
    );
    for (load, pressure) in results.loads.iter().enumerate() {
        page.figure(
            &format!("causes-{}.svg", load + 1),
            map(results, load),
            &format!(
                "Leading cause of the difference between the models at {} ({} E* times the gradient), by skewness of the surface heights and \
                 Nayak's α. In each cell: the difference, statistical − deterministic. Grey: no cause leads; empty: beyond the valid range.",
                loads([*pressure; 2]),
                number(pressure / results.unit)
            ),
        );
    }
    sections::warnings(&mut page, &asperity_framework::Outcome::warnings(results));
    over_skewness(&mut page, results);
    sections::notes(&mut page, &results.metadata);
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    page.paragraph(&format!(
        "Law {}. {} surfaces of each skewness and bandwidth: {} points along each side, σ = {}, root mean square gradient {}, self-affine with the Hurst \
         exponent {}. The kurtosis of the heights is that of a gamma distribution of the skewness, 3 + 1.5 s². The bandwidth follows from the longest over the \
         shortest wavelength. A cause leads where it is the largest contribution in the direction of the difference and its 95 % \
         interval, from the scatter of the surfaces, lies beyond zero and beyond the intervals of the others.",
        escape(&results.law),
        results.realisations,
        results.points.first().map_or(0, |point| point.points),
        input_quantity(results.sigma, "m"),
        number(results.gradient),
        number(results.hurst)
    ));
    page.details(2, "Surfaces", |page| surfaces(page, results));
    for load in 0..results.loads.len() {
        let title = format!("Contributions at {}", loads([results.loads[load]; 2]));
        page.details(2, &title, |page| table(page, results, load));
    }
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// The contributions at each load, over the skewness.
fn over_skewness(page: &mut Page, results: &CausesResults) {
    page.heading(2, "Contributions over the skewness");
    for (load, pressure) in results.loads.iter().enumerate() {
        for quantity in QUANTITIES {
            page.figure(
                &format!("contributions-{}-{}.svg", load + 1, quantity.name()),
                contributions(results, quantity, load),
                &format!(
                    "Contributions to the difference in {} at {}, means over the surfaces with their 95 % intervals, over the skewness; one panel \
                     for each bandwidth.",
                    name(quantity),
                    loads([*pressure; 2])
                ),
            );
        }
    }
}

/// Which cause leads at one load in one quantity.
fn sentence(results: &CausesResults, found: &Findings) -> String {
    let at = loads([results.loads[found.load]; 2]);
    let about = format!("**{} at {at}**", capitalised(name(found.quantity)));
    if found.divided == 0 {
        return format!("{about}: at no point of the grid are all surfaces within the valid range.");
    }
    let missing = results.points.len() - found.divided;
    let valid = if missing == 0 { "" } else { " within the valid range" };
    let clause = |lead: &Lead| {
        let cause =
            lead.cause.map_or_else(|| "no cause".to_owned(), |cause| format!("the {}", cause.label()));
        let skewnesses: Vec<String> = lead.at_every_bandwidth.iter().copied().map(plain).collect();
        let everywhere = if skewnesses.is_empty() {
            String::new()
        } else {
            format!(" (at every bandwidth{valid} for a skewness of {})", listed(&skewnesses))
        };
        format!("{cause} leads at {}{everywhere}", lead.points)
    };
    let exceeded = results.points.iter().filter(|point| point.parts(found.load, found.quantity).is_none());
    let exceeded = exceeded.fold(Exceeded::default(), |all, point| all.union(point.at[found.load].exceeded));
    let beyond: Vec<String> = exceeded.limits().map(limit_words).collect();
    let beyond = if missing == 0 {
        String::new()
    } else {
        let others = if missing == 1 { "one".to_owned() } else { missing.to_string() };
        format!("; at the other {others} some surfaces are beyond the valid range ({})", listed(&beyond))
    };
    let leads: Vec<String> = found.leads.iter().map(clause).collect();
    format!("{about}: of {} points of the grid, {}{beyond}.", found.divided, listed(&leads))
}

/// A number with a minus sign.
fn plain(value: f64) -> String {
    input_number(value).replace('-', "−")
}

/// What the cause that Pasaribu and Schipper give comes to; nothing where nothing is divided.
fn of_radii(findings: &[Findings]) -> Option<String> {
    let divided: usize = findings.iter().map(|found| found.divided).sum();
    let of_radii = |found: &Findings| {
        found
            .leads
            .iter()
            .filter(|lead| lead.cause == Some(Cause::Radii))
            .map(|lead| lead.points)
            .sum::<usize>()
    };
    let leads: usize = findings.iter().map(of_radii).sum();
    let shares = findings.iter().filter_map(|found| found.share_of_radii);
    let [low, high] = shares.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    Some(format!(
        "**The spread of radii**, which Pasaribu and Schipper (2005) give as the cause, leads in {} of these {divided} cases; of the contributions, taken by \
         magnitude, it has {} to {}.",
        if leads == 0 { "none".to_owned() } else { leads.to_string() },
        percent(low),
        percent(high)
    ))
}

/// The points of equal wavelengths.
fn rows(results: &CausesResults) -> Vec<&[GridPoint]> {
    results.points.chunk_by(|a, b| a.wavelengths == b.wavelengths).collect()
}

/// Nayak's alpha of a row.
fn alpha(row: &[GridPoint]) -> f64 {
    row.iter().map(|point| point.reached.alpha).sum::<f64>() / row.len() as f64
}

/// Edges half way between values.
fn edges(values: &[f64]) -> Vec<f64> {
    let inner = values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let (first, last) = (values[0], values[values.len() - 1]);
    let (low, high) = (values[1] - first, last - values[values.len() - 2]);
    std::iter::once(first - 0.5 * low).chain(inner).chain([last + 0.5 * high]).collect()
}

fn map(results: &CausesResults, load: usize) -> Figure {
    let panels = QUANTITIES.map(|quantity| map_of(results, quantity, load));
    Figure::row("Leading causes over skewness and bandwidth", panels.into())
}

fn map_of(results: &CausesResults, quantity: ComparedQuantity, load: usize) -> Plot {
    let rows = rows(results);
    let x = edges(&rows[0].iter().map(|point| point.skewness).collect::<Vec<_>>());
    let y: Vec<f64> = edges(&rows.iter().map(|row| alpha(row).ln()).collect::<Vec<_>>());
    let y: Vec<f64> = y.into_iter().map(f64::exp).collect();
    let axes = (Axis::linear("skewness of the heights"), Axis::log("Nayak's α"));
    let range = |axis: Axis, edges: &[f64]| axis.range(edges[0], edges[edges.len() - 1]);
    let unit = if quantity == ComparedQuantity::Separation { "σ" } else { "%" };
    let title = format!("{}, difference in {unit}", capitalised(name(quantity)));
    let mut plot = Plot::new(title, range(axes.0, &x), range(axes.1, &y)).height(300.0).legend(Legend::Below);
    for (row, points) in rows.iter().enumerate() {
        for (column, point) in points.iter().enumerate() {
            let Some(parts) = point.parts(load, quantity) else { continue };
            let (colour, label) = match parts.leading() {
                Some(cause) => (colour(cause), cause.label()),
                None => (Colour::Neutral, "none leads"),
            };
            let (from, to) = ((x[column], y[row]), (x[column + 1], y[row + 1]));
            // The unit is in the title.
            let text = signed(quantity, parts.gap());
            let text = text.trim_end_matches(unit).trim_end();
            plot = plot.with(Layer::tile(from, to, text).coloured(colour).named(label));
        }
    }
    plot
}

fn contributions(results: &CausesResults, quantity: ComparedQuantity, load: usize) -> Figure {
    let panels = rows(results).into_iter().map(|row| lines(row, quantity, load));
    Figure::row("Contributions over the skewness", panels.collect())
}

fn lines(row: &[GridPoint], quantity: ComparedQuantity, load: usize) -> Plot {
    let label = match quantity {
        ComparedQuantity::Separation => "separation (σ)",
        _ => "ln(area ratio)",
    };
    let title = format!("α = {}", number(alpha(row)));
    let x = edges(&row.iter().map(|point| point.skewness).collect::<Vec<_>>());
    let mut plot = Plot::new(
        title,
        Axis::linear("skewness of the heights").range(x[0], x[x.len() - 1]),
        Axis::linear(label),
    )
    .height(240.0)
    .with_zero();
    let divided = || row.iter().filter_map(|point| Some((point.skewness, point.parts(load, quantity)?)));
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle];
    for (cause, marker) in Cause::ALL.into_iter().zip(markers) {
        let points: Vec<(f64, f64)> = divided().map(|(x, parts)| (x, parts.of(cause))).collect();
        let band = divided().map(|(x, parts)| {
            let half = parts.estimates[cause as usize].half_width().unwrap_or(0.0);
            (x, parts.of(cause) - half, parts.of(cause) + half)
        });
        let colour = colour(cause);
        plot = plot
            .with(Layer::band(band).coloured(colour).named(cause.label()))
            .with(Layer::line(points.iter().copied()).coloured(colour).named(cause.label()))
            .with(Layer::points(points, marker).coloured(colour).named(cause.label()));
    }
    let gap = divided().map(|(x, parts)| (x, parts.gap()));
    plot.with(Layer::line(gap).coloured(Colour::Sum).thick().named("statistical − deterministic"))
}

fn surfaces(page: &mut Page, results: &CausesResults) {
    let header = [
        "skewness",
        "kurtosis",
        "longest/shortest wave",
        "α",
        "gradient",
        "asperities",
        "skewness of the asperity heights",
        "spread of radii",
        "height-radius correlation",
        "plasticity index",
    ];
    let row = |point: &GridPoint| {
        let reached = &point.reached;
        vec![
            format!("{} ({})", plain(point.skewness), number(reached.skewness)),
            format!("{} ({})", number(point.kurtosis), number(reached.kurtosis)),
            input_number(point.wavelengths),
            number(reached.alpha),
            number(reached.gradient),
            count(reached.asperities.round() as usize),
            number(reached.asperity_skewness),
            number(reached.radius_cv),
            number(reached.height_radius_correlation),
            number(reached.plasticity_index),
        ]
    };
    page.table(header, results.points.iter().map(row));
    page.paragraph(
        "Means over the surfaces; skewness and kurtosis of the surface heights asked for, and reached (in parentheses). Spread: standard deviation over \
         mean.",
    );
}

fn table(page: &mut Page, results: &CausesResults, load: usize) {
    let mut header = vec!["skewness".to_owned(), "α".to_owned()];
    for quantity in QUANTITIES {
        header.push(format!("{}: difference", name(quantity)));
        header.extend(Cause::ALL.map(|cause| cause.label().to_owned()));
        header.push("leads".to_owned());
    }
    let of_quantity = |quantity: ComparedQuantity, parts: Option<&Contributions>| {
        let Some(parts) = parts else { return vec!["–".to_owned(); Cause::ALL.len() + 2] };
        let mut cells = vec![signed(quantity, parts.gap())];
        cells.extend(Cause::ALL.map(|cause| {
            let estimate = parts.estimates[cause as usize];
            let half_width = estimate.half_width().unwrap_or(0.0);
            match quantity {
                ComparedQuantity::Separation => {
                    format!("{} ± {}", signed(quantity, estimate.contrast), number(half_width))
                }
                _ => {
                    let [low, high] =
                        [-half_width, half_width].map(|side| signed(quantity, estimate.contrast + side));
                    format!("{} ({low} to {high})", signed(quantity, estimate.contrast))
                }
            }
        }));
        cells.push(parts.leading().map_or("none", Cause::label).to_owned());
        cells
    };
    let row = |point: &GridPoint| {
        let mut cells = vec![plain(point.skewness), number(point.reached.alpha)];
        cells.extend(
            QUANTITIES.into_iter().flat_map(|quantity| of_quantity(quantity, point.parts(load, quantity))),
        );
        cells
    };
    page.table(header, results.points.iter().map(row));
    page.paragraph(
        "With 95 % intervals of the means. Separations in σ of the asperities add up, areas multiply.",
    );
}
