//! The page of a convergence study: does the sum converge to the integral, and at which rate?

use asperity::compare::{ErrorSlope, LimitPoint, Quantity, Sampling};
use asperity_framework::contact::ContactSummary;
use asperity_framework::metadata::Metadata;
use asperity_framework::report::format::{input_number, input_quantity, number};
use asperity_framework::report::page::Page;
use asperity_framework::report::sections;
use asperity_framework::report::table::{Table, Tables};
use asperity_framework::{Outcome, fields};
use asperity_plot::{Axis, Colour, Figure, Layer, Marker, Plot};
use serde_json::{Map, Value};

use super::rows::{ConvergenceRow, SlopeRow, tables};
use super::run::LimitResults;

impl Outcome for LimitResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.contact.caveats.clone()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&answer(&self.slopes));
        for law in &self.laws {
            for quantity in Quantity::ALL {
                page.figure(
                    &format!("{law}-{}.svg", quantity.name()).replace(['(', ')', ' ', '='], "-"),
                    figure(self, law, quantity),
                    "Relative error against the number of asperities. Crosses: single random sets; line on the left: their root mean square; \
                     circles: more than 30 expected contacts, fitted.",
                );
            }
        }
        page.heading(2, "Slopes of the error").view(&tables.view::<SlopeRow>());
        page.details(2, "Errors of the load by number of asperities", |page| {
            page.view(&tables.view::<ConvergenceRow>().only("quantity", "load").without(&["fitted"]));
        });
        sections::notes(&mut page, &self.metadata);
        page.heading(2, "Method").note(include_str!("notes/method.md"));
        sections::what_was_run(&mut page, &self.metadata, &self.contact);
        page.paragraph(&format!(
            "Radius {}, σ = {}, η = {} /m²; {} random sets of each size, each with its own seed.",
            input_quantity(self.sets.population.radius, "m"),
            input_quantity(self.sets.population.sigma, "m"),
            input_number(self.sets.population.density),
            self.sets.draws,
        ));
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        fields(&ContactSummary::of(&self.contact))
    }
}

/// The range of the slopes, and how far they are from the expected ones.
fn answer(slopes: &[ErrorSlope]) -> String {
    let range = |sampling: Sampling| {
        let slopes = slopes.iter().filter(|slope| slope.sampling == sampling);
        let fits: Vec<f64> = slopes.clone().map(|slope| slope.fit.slope).collect();
        let deviation = slopes.map(|slope| (slope.fit.slope - slope.expected).abs()).fold(0.0, f64::max);
        format!(
            "{:.3} to {:.3} with {} heights ({} fits, each within {} of the expected slope)",
            fits.iter().copied().fold(f64::MAX, f64::min),
            fits.iter().copied().fold(f64::MIN, f64::max),
            sampling.name(),
            fits.len(),
            number(deviation),
        )
    };
    match slopes {
        [] => "Too few contacts are expected for a slope of the error.".to_owned(),
        _ => format!(
            "The sum converges to the integral: the error decreases with the slopes {}.",
            Sampling::ALL.map(range).join(" and ")
        ),
    }
}

fn figure(results: &LimitResults, law: &str, quantity: Quantity) -> Figure {
    let separations = &results.sets.separations;
    let panel = |(sampling, slope, label): (Sampling, f64, &str)| {
        let error = |point: &LimitPoint| (point.count as f64, point.error_of_sets(sampling, quantity));
        let axis = Axis::log(format!("relative error of the {}", quantity.name()));
        let title = format!("Heights: {}", sampling.name());
        let mut plot = Plot::new(title, Axis::log("number of asperities n"), axis);
        for (index, &separation) in separations.iter().enumerate() {
            let colour = Colour::Ordered { index, of: separations.len() };
            let is_shown = |point: &&LimitPoint| point.law == law && point.separation() == separation;
            let points = || results.points.iter().filter(is_shown);
            let fitted = || points().filter(|point| point.is_fitted());
            if sampling == Sampling::Random {
                let errors = points().flat_map(|point| {
                    point.random.iter().map(|set| (point.count as f64, point.error(set, quantity).abs()))
                });
                plot = plot.with(Layer::points(errors, Marker::Cross).coloured(colour));
            }
            let name = format!("d/σ = {}", input_number(separation));
            plot = plot
                .with(Layer::line(points().map(error)).coloured(colour).named(name))
                .with(Layer::points(fitted().map(error), Marker::Circle).coloured(colour));
            if let (0, Some((count, error))) = (index, fitted().map(error).next()) {
                plot = plot.with(Layer::slope((count, 0.2 * error), slope, label));
            }
        }
        plot
    };
    let panels = [(Sampling::Random, -0.5, "slope −1/2"), (Sampling::Quantiles, -1.0, "slope −1")];
    Figure::row(format!("Convergence of the {} under {law}", quantity.name()), panels.map(panel).into())
}
