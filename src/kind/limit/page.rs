//! The page of a convergence study: does the sum converge to the integral, and at which rate?

use super::findings::{Heights, SlopeRange, series};
use super::run::LimitResults;
use asperity::MIN_CONTACTS;
use asperity::compare::{LimitPoint, Quantity};
use asperity_framework::report::format::{input_number, input_quantity, number};
use asperity_framework::report::page::Page;
use asperity_framework::report::sections;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

pub fn page(results: &LimitResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::findings(&mut page, results.slope_ranges.iter().map(finding));
    for (law, reference) in &results.laws {
        of_law(&mut page, results, law, reference);
    }
    sections::notes(&mut page, &results.metadata);
    page.heading(2, "Method");
    page.paragraph(&format!(
        "Sets of asperities with equal radii and Gaussian heights are summed and compared with their limit: {}. The error \
         of a sum of n independent draws decreases as n^-½. Heights at the quantiles are a midpoint rule in probability; \
         the tail of the highest asperities, where the height grows as a logarithm, makes its error n⁻¹ times a slowly \
         varying factor: as n → ∞, (ln n)^-½ for an area or load ∝ w and (ln n)^-¼ for a load ∝ w^1.5. Its slope over a \
         range of n is therefore not exactly −1; the expected slope is that of the leading term at the fitted n \
         (docs/theory.md, section 7). Slopes are least-squares fits to the logarithms, for points with more than \
         {MIN_CONTACTS} expected contacts.",
        results.laws.iter().map(|(law, reference)| format!("for {law}, {reference}")).collect::<Vec<_>>().join("; "),
    ));
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    page.paragraph(&format!(
        "Radius {}, σ = {}, η = {} /m²; {} random sets of each size, each with its own seed.",
        input_quantity(results.population.radius, "m"),
        input_quantity(results.population.sigma, "m"),
        input_number(results.population.density),
        results.draws,
    ));
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// Figures and tables under one law.
fn of_law(page: &mut Page, results: &LimitResults, law: &str, reference: &str) {
    page.heading(2, &format!("Law {law}"));
    for wanted in Quantity::ALL {
        let name = format!("{law}-{}.svg", wanted.name()).replace(['(', ')', ' ', '='], "-");
        page.figure(
                &name,
                figure(results, law, wanted),
                &format!(
                    "Relative error of the {} against the number of asperities; limit: {reference}. Crosses: single random \
                     sets; lines: their root mean square. Grey: points with at most {MIN_CONTACTS} expected contacts, \
                     not fitted.",
                    wanted.name()
                ),
            );
    }
    page.table(
        ["d/σ", "quantity", "heights", "slope", "± s.e.", "expected slope", "points"],
        results.slopes.iter().filter(|slope| slope.law == *law).map(|slope| {
            vec![
                input_number(slope.separation),
                slope.quantity.name().to_owned(),
                slope.heights.name().to_owned(),
                format!("{:.3}", slope.fit.slope),
                format!("{:.3}", slope.fit.standard_error),
                format!("{:.3}", slope.expected),
                slope.fit.points.to_string(),
            ]
        }),
    );
    page.paragraph("Errors of the load by number of asperities:");
    page.table(
        [
            "n",
            "d/σ",
            "expected contacts",
            "mean of random sets",
            "r.m.s. of random sets",
            "at the quantiles",
            "expected at the quantiles",
        ],
        results.points.iter().filter(|point| point.law == law).map(|point| {
            let (mean, scatter) = point.scatter(Quantity::Load);
            vec![
                point.count.to_string(),
                input_number(point.exact.statistical.separation_over_sigma),
                number(point.expected_contacts()),
                number(mean),
                number(scatter),
                number(point.quantile_error(Quantity::Load)),
                number(point.expected_quantile_error(Quantity::Load)),
            ]
        }),
    );
}

/// The fitted slopes, in a sentence.
fn finding(found: &SlopeRange) -> String {
    let SlopeRange { heights, quantity, fits, mean, lowest, highest, expected, largest_deviation } = found;
    let what = match heights {
        Heights::Random => "heights drawn at random",
        Heights::Quantiles => "heights at the quantiles",
    };
    format!(
        "**{what}, {}**: the error decreases with a mean slope of {mean:.3} over {fits} fits ({lowest:.3} to {highest:.3}); \
         expected {expected:.3}. Each fit is within {} of its expected slope.",
        quantity.name(),
        number(*largest_deviation),
    )
}

fn figure(results: &LimitResults, law: &str, quantity: Quantity) -> Figure {
    let panel = |heights: Heights| {
        let (title, label) = match heights {
            Heights::Random => ("Heights drawn at random", "slope −1/2"),
            Heights::Quantiles => ("Heights at the quantiles", "slope −1"),
        };
        let axis = Axis::log(format!("relative error of the {}", quantity.name()));
        let mut plot = Plot::new(title, Axis::log("number of asperities n"), axis);
        let of = results.separations.len();
        for (index, &separation) in results.separations.iter().enumerate() {
            let colour = Colour::Ordered { index, of };
            let points: Vec<&LimitPoint> = series(&results.points, law, separation).collect();
            if heights == Heights::Random {
                let single = points.iter().flat_map(|point| {
                    point.random.iter().map(|r| (point.count as f64, point.error(r, quantity).abs()))
                });
                plot = plot.with(Layer::points(single.collect::<Vec<_>>(), Marker::Cross).coloured(colour));
            }
            let all = points.iter().map(|point| (point.count as f64, heights.error(point, quantity)));
            plot = plot
                .with(Layer::line(all.collect::<Vec<_>>()).coloured(Colour::Neutral).dashed(Dash::Dotted));
            let fitted = points.iter().filter(|point| point.is_fitted());
            let fitted: Vec<_> = fitted.map(|p| (p.count as f64, heights.error(p, quantity))).collect();
            plot = plot
                .with(
                    Layer::line(fitted.clone())
                        .coloured(colour)
                        .named(format!("d/σ = {}", input_number(separation))),
                )
                .with(Layer::points(fitted, Marker::Circle).coloured(colour));
        }
        let slope = match heights {
            Heights::Random => -0.5,
            Heights::Quantiles => -1.0,
        };
        let reference = series(&results.points, law, results.separations[0]).find(|point| point.is_fitted());
        match reference {
            Some(point) => {
                let through = (point.count as f64, 0.2 * heights.error(point, quantity));
                plot.with(Layer::slope(through, slope, label))
            }
            None => plot,
        }
    };
    Figure::row(
        format!("Convergence of the {} under {law}", quantity.name()),
        Heights::ALL.map(panel).to_vec(),
    )
}
