//! The page: which results have a limit, then the criterion, then surface by surface tables and figures.

mod figures;
mod words;

use asperity::compare::{Cause, ComparedQuantity};
use asperity_framework::report::format::{input_quantity, listed, number, percent, quantity, with_sign};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;
use asperity_framework::report::table::Tables;

use super::findings::{gap, main_load};
use super::quantity::Quantity;
use super::results::{Found, IntervalResults, Scale, Series, SurfaceResults, Variation};
use super::trend::{FASTEST, HALVINGS, SHRINKS};
use crate::kind::compare::outline::limit_words;
use crate::surface::section;

const NONE: &str = "–";

pub fn page(results: &IntervalResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    words::over_surfaces(results).iter().for_each(|sentence| {
        page.lead(sentence);
    });
    sections::warnings(&mut page, &asperity_framework::Outcome::warnings(results));
    for surface in &results.surfaces {
        of_surface(&mut page, surface);
    }
    criterion(&mut page);
    sections::notes(&mut page, &results.metadata);
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    page.paragraph(&format!("Law {}.", escape(&results.law)));
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// What is called a limit.
fn criterion(page: &mut Page) {
    page.heading(2, "What is called a limit");
    page.paragraph(&format!(
        "No finite set of intervals proves a limit: the words describe the three finest lengths, and lengths below the finest are \
         extrapolated. Let c be the change from the second finest to the finest length, of the logarithm of positive quantities and of \
         the ratio of areas, and q = |c| over the change before, both over the same ratio of lengths. A power law has q = 1 wherever it \
         is sampled; what converges as length^p has q = 2^−p per halving, a smooth surface q = 1/4. The tolerance is what the spec \
         accepts of a gap (`accept`), else {}, of a correlation 0.05.",
        percent(0.05)
    ));
    page.bullets([
        format!(
            "**Limit**: |c| with its 95 % interval is within the tolerance, and c cannot be told from zero, or q is at most {} and the \
             sum of all further changes, |c| q/(1 − q), is within the tolerance too, or {HALVINGS} further changes as large as this one \
             are. In any case q counts as {FASTEST} if it is smaller: a sudden stop is an accident.",
            number(SHRINKS)
        ),
        format!("**No limit**: |c| exceeds the tolerance beyond its interval, and q exceeds {}.", number(SHRINKS)),
        format!(
            "**Still changing, less and less**: q is at most {}, its interval included, but c or what is left exceeds the tolerance.",
            number(SHRINKS)
        ),
        "**Cannot be told**: anything else.".to_owned(),
    ]);
    page.paragraph(
        "Intervals are those of the change itself: the same blocks of the map are left out at both lengths, so that what both have in \
         common cancels. The leading part of a gap is the largest one in its direction, where its interval lies beyond zero and beyond the intervals of the \
         others. Gaps are given within the valid range only. A filtered map tells of the surface, not of the pixel, as long as the nesting index is a few \
         pixels long.",
    );
}

fn of_surface(page: &mut Page, surface: &SurfaceResults) {
    let name = &surface.surface.name;
    page.heading(2, &format!("Surface {name}"));
    page.bullets(words::summary(surface));
    page.figure(
        &format!("{name}-over-length.svg"),
        figures::asperities(surface),
        "Asperity density and radii against the sampling interval (solid) and the nesting index of the S filter (dashed). A straight \
         line is a power law without a limit, a level end towards the left a limit.",
    );
    let Some(load) = main_load(surface) else {
        page.paragraph("At no load any variant is within the valid range: no gap is given.");
        trends(page, surface, 0);
        tables(page, surface);
        return;
    };
    page.heading(3, &format!("Gap between the models at {}", input_quantity(surface.loads[load], "Pa")));
    gaps(page, surface, load);
    for series in &surface.series {
        let file = match series.variation {
            Variation::Interval => "interval",
            Variation::Filter => "filter",
        };
        let what = words::varied(series.variation);
        if let Some(figure) = figures::gap(series, load) {
            page.figure(
                &format!("{name}-gap-{file}.svg"),
                figure,
                &format!(
                    "The gap between the models (black, with its 95 % interval) and its parts, stacked, against the {what}, at {}.",
                    input_quantity(surface.loads[load], "Pa")
                ),
            );
        }
    }
    trends(page, surface, load);
    tables(page, surface);
}

/// The surface, and its asperities at every length.
fn tables(page: &mut Page, surface: &SurfaceResults) {
    let name = &surface.surface.name;
    page.details(3, &format!("{name}: asperities by length"), |page| asperities(page, surface));
    page.details(3, &format!("{name}: the surface"), |page| {
        section::section(page, &Tables::default(), &surface.surface, None)
    });
}

/// Every variant of a surface with its length.
fn scales(surface: &SurfaceResults) -> impl Iterator<Item = (&Series, &Scale)> {
    surface.series.iter().flat_map(|series| series.scales.iter().map(move |scale| (series, scale)))
}

/// "sampling interval", "102 nm".
fn place(series: &Series, scale: &Scale) -> Vec<String> {
    let what = match series.variation {
        Variation::Interval => "interval",
        Variation::Filter => "S filter",
    };
    vec![what.to_owned(), number(scale.multiple), quantity(scale.length, "m")]
}

fn asperities(page: &mut Page, surface: &SurfaceResults) {
    let row = |(series, scale): (&Series, &Scale)| {
        let mut row = place(series, scale);
        match &scale.found {
            Err(reason) => row.push(reason.clone()),
            Ok(found) => {
                let statistics = &found.statistics;
                let optional = |value: Option<f64>| value.map_or_else(|| NONE.to_owned(), number);
                row.extend([
                    found.asperities.to_string(),
                    number(found.density),
                    quantity(statistics.mean_radius, "m"),
                    quantity(statistics.radius_of_mean_curvature, "m"),
                    quantity(statistics.sigma, "m"),
                    optional(found.alpha),
                    number(statistics.radius_cv),
                    optional(statistics.height_radius_correlation),
                    optional(found.plasticity_index),
                ]);
            }
        }
        row
    };
    page.table(
        [
            "variation",
            "multiple",
            "length",
            "asperities",
            "density (1/m²)",
            "mean radius",
            "1/(mean curvature)",
            "σ of asperities",
            "Nayak's α",
            "radius CV",
            "height-radius correlation",
            "plasticity index",
        ],
        scales(surface).map(row),
    );
    let base = surface.series.iter().find(|series| series.variation == Variation::Filter);
    let base = base.and_then(|series| series.scales.first()).map_or_else(String::new, |scale| {
        format!(
            " Of S filters (Gaussian, ISO 16610-61, on the map at one pixel) the multiple is of {}.",
            quantity(scale.length / scale.multiple, "m")
        )
    });
    page.paragraph(&format!(
        "Intervals take every so many points of the prepared map along x and y, from the first; the multiple is in pixels, the length is \
         the longer one of x and y.{base}"
    ));
}

/// A row for each variant at one load.
fn gaps(page: &mut Page, surface: &SurfaceResults, load: usize) {
    let parts = |found: &Found, quantity: ComparedQuantity| -> Vec<String> {
        let parts = found.parts(load, quantity).map(|parts| parts.estimates);
        let of = |cause: Cause| {
            parts.map_or_else(|| NONE.to_owned(), |all| words::estimate(&all[cause as usize], 1.0))
        };
        Cause::ALL.map(of).to_vec()
    };
    let row = |(series, scale): (&Series, &Scale)| {
        let mut row = place(series, scale);
        let Ok(found) = &scale.found else { return row };
        let contacts = found.differences[load].sharing.map(|sharing| sharing.effective_contacts);
        row.push(contacts.map_or_else(|| NONE.to_owned(), number));
        let [separation, area] =
            [ComparedQuantity::Separation, ComparedQuantity::Area].map(|quantity| gap(found, load, quantity));
        let (Some(separation), Some(area)) = (separation, area) else {
            row.push(beyond(found, load));
            return row;
        };
        row.push(words::estimate(&separation, 1.0));
        row.push(words::estimate(&separation, 1e9 * found.sigma));
        row.extend(parts(found, ComparedQuantity::Separation));
        row.push(words::change(Quantity::AreaGap, area.contrast, area.half_width()));
        row.extend(parts(found, ComparedQuantity::Area));
        row
    };
    page.table(
        [
            "variation",
            "multiple",
            "length",
            "effective contacts",
            "separation (σ)",
            "separation (nm)",
            "from heights",
            "from radii",
            "from correlation",
            "area",
            "ln: from heights",
            "ln: from radii",
            "ln: from correlation",
        ],
        scales(surface).map(row),
    );
    page.paragraph(
        "Statistical minus deterministic at equal load, with 95 % intervals where the map is large enough; parts of the separation in σ, \
         of the area of ln(statistical/deterministic). Other loads: `sampling_interval_gaps.csv`.",
    );
}

fn beyond(found: &Found, load: usize) -> String {
    let limits: Vec<String> = found.exceeded(load).limits().map(limit_words).collect();
    if limits.is_empty() { "no contact".to_owned() } else { format!("not valid: {}", listed(&limits)) }
}

/// The change of every quantity towards the finest length.
fn trends(page: &mut Page, surface: &SurfaceResults, load: usize) {
    page.heading(3, "Towards the finest length");
    let rows = surface.series.iter().flat_map(|series| {
        let row = move |quantity: Quantity| {
            let trend = series.trend(quantity, load)?;
            let exponent = trend.exponent.map_or_else(
                || NONE.to_owned(),
                |fit| format!("{} ± {}", with_sign(fit.slope, number), number(fit.standard_error)),
            );
            Some(vec![
                words::varied(series.variation).to_owned(),
                quantity.label().to_owned(),
                words::change(quantity, trend.change, trend.half_width),
                words::change(quantity, trend.previous, None),
                exponent,
                words::outcome(trend.outcome).to_owned(),
            ])
        };
        Quantity::ALL.into_iter().filter_map(row)
    });
    page.table(
        ["variation", "quantity", "last change", "change before", "exponent ± s.e.", "outcome"],
        rows.collect::<Vec<_>>(),
    );
    page.paragraph(
        "Last change: from the second finest to the finest length, with its 95 % interval where the map is large enough. Exponent: of a \
         power law of the length through all lengths, by least squares.",
    );
}
