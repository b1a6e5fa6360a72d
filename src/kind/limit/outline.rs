//! The page of a convergence study: does the sum converge to the integral, and at which rate?

use asperity::compare::{ErrorSlope, HeightSampling, LimitQuantity};
use asperity::numeric::extremes;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{count, input_number, input_quantity, number, signed};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Outcome, fields};
use asperity_plot::{Axis, Colour, Figure, Layer, Plot};
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
        for slopes in self.slopes.chunk_by(|a, b| a.law == b.law) {
            for quantity in LimitQuantity::ALL {
                let file = format!("{}-{}.svg", slopes[0].law, quantity.name());
                let file = file.replace(['(', ')', ' ', '='], "-");
                page.figure(&file, figure(slopes, quantity), &caption(slopes, quantity));
            }
        }
        page.details(2, "Slopes of the error", |page| {
            page.view(&tables.view::<SlopeRow>());
        });
        page.details(2, "Errors of the load by number of asperities", |page| {
            page.view(&tables.view::<ConvergenceRow>().only("quantity", "load").without(&["fitted"]));
        });
        sections::notes(&mut page, &self.metadata);
        sections::what_was_run(&mut page, &self.metadata, &self.contact, |page| {
            page.paragraph(&format!(
                "Radius {}, σ = {}, η = {} /m²; {} random sets of each size, each with its own seed. Method: \
             [theory](../../docs/theory.md#7-surfaces).",
                input_quantity(self.sets.population.radius, "m"),
                input_quantity(self.sets.population.sigma, "m"),
                input_number(self.sets.population.density),
                self.sets.draws,
            ));
        });
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        fields(&ContactSummary::new(&self.contact))
    }
}

/// The fitted slopes under one law.
fn caption(slopes: &[ErrorSlope], quantity: LimitQuantity) -> String {
    let range = |sampling: HeightSampling| {
        let of_sampling =
            slopes.iter().filter(|slope| (slope.quantity, slope.sampling) == (quantity, sampling));
        let Some(ends) = extremes(of_sampling.map(|slope| slope.fit.slope)) else {
            return "no fit".to_owned();
        };
        let [steepest, flattest] = ends.map(signed);
        if steepest == flattest { steepest } else { format!("{steepest} to {flattest}") }
    };
    format!(
        "Relative error of the {} against the number of asperities. Left: random heights, root mean square, slope {} (theory −½). Right: \
         heights at the quantiles, slope {}.",
        quantity.name(),
        range(HeightSampling::Random),
        range(HeightSampling::Quantiles),
    )
}

/// At which rate the sum approaches the integral, and how far that is from the expected one.
fn answer(slopes: &[ErrorSlope]) -> String {
    let deviation = |sampling: HeightSampling| {
        let of_sampling = slopes.iter().filter(|slope| slope.sampling == sampling);
        number(of_sampling.map(ErrorSlope::deviation).fold(0.0, f64::max))
    };
    let counts = slopes.iter().flat_map(|slope| slope.errors.iter().map(|(count, _)| *count));
    let Some([_, to]) = extremes(counts) else {
        return "Too few contacts are expected for a fit to the error.".to_owned();
    };
    format!(
        "The sum approaches the integral: its error falls with the number of random asperities (up to {}) to the power −½ within {}. With \
         heights at the quantiles the power is the expected one within {}.",
        count(to as usize),
        deviation(HeightSampling::Random),
        deviation(HeightSampling::Quantiles),
    )
}

fn figure(slopes: &[ErrorSlope], quantity: LimitQuantity) -> Figure {
    let panel = |(sampling, slope, label): (HeightSampling, f64, &str)| {
        let axis = Axis::log(format!("relative error of the {}", quantity.name()));
        let title = format!("Heights: {}", sampling.name());
        let mut plot = Plot::new(title, Axis::log("number of asperities n"), axis);
        let series = slopes.iter().filter(|slope| (slope.quantity, slope.sampling) == (quantity, sampling));
        let of = series.clone().count();
        for (index, ErrorSlope { separation, errors, .. }) in series.enumerate() {
            if index == 0 {
                plot = plot.with(Layer::slope((errors[0].0, 0.2 * errors[0].1), slope, label));
            }
            let line = Layer::line(errors.iter().copied()).coloured(Colour::Ordered { index, of });
            plot = plot.with(line.named(format!("d/σ = {}", input_number(*separation))));
        }
        plot
    };
    /// The slope that guides the eye.
    const PANELS: [(HeightSampling, f64, &str); 2] =
        [(HeightSampling::Random, -0.5, "slope −½"), (HeightSampling::Quantiles, -1.0, "slope −1")];
    let title = format!("Convergence of the {} under {}", quantity.name(), slopes[0].law);
    Figure::row(title, PANELS.map(panel).into())
}

#[cfg(test)]
mod tests {
    use asperity::compare::SlopeFit;

    use super::*;

    #[test]
    fn the_answer_is_the_largest_deviation_of_each_sampling() {
        let slope = |sampling, slope, expected| ErrorSlope {
            law: "hertz".to_owned(),
            separation: 0.0,
            quantity: LimitQuantity::Load,
            sampling,
            errors: vec![(100.0, 0.1), (1e4, 0.01)],
            fit: SlopeFit { slope, standard_error: 0.0, points: 3 },
            expected,
        };
        let random = [-0.49, -0.52].map(|fitted| slope(HeightSampling::Random, fitted, -0.5));
        let all = [random.to_vec(), vec![slope(HeightSampling::Quantiles, -1.04, -1.045)]].concat();
        let caption = caption(&all, LimitQuantity::Load);
        assert!(
            caption.contains("slope -0.52 to -0.49 (theory") && caption.ends_with("quantiles, slope -1.04."),
            "{caption}"
        );
        assert!(super::caption(&all[..2], LimitQuantity::Load).ends_with("slope no fit."));
        let answer = answer(&all);
        assert!(
            answer.contains("asperities (up to 10,000) to") && answer.contains("−½ within 0.02."),
            "{answer}"
        );
        assert!(answer.ends_with("within 0.005."), "{answer}");
    }

    #[test]
    fn without_fits_there_is_no_slope() {
        assert!(answer(&[]).starts_with("Too few contacts"));
    }
}
