//! `[limit]`: sets of growing size against the statistical integral.

use std::fmt;
use std::time::Instant;

use asperity::compare::{
    ErrorSlope, HeightSampling, LimitCase, LimitPoint, LimitQuantity, LimitSets, ModelKind, convergence,
};
use asperity::numeric::extremes;
use asperity::study::LawContact;
use asperity::work::{CountedContact, Counter, Item};
use asperity::{Flat, Heights, Population, plasticity_index};
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{ArealNumberDensity, Length, Pure, Quantity};
use asperity_contact_framework::input::sweep::{LinearSweep, LogSweep};
use asperity_contact_framework::input::{InputError, Spanned, SpecFile, Whole};
use asperity_contact_framework::metadata::{
    Bodies, ContactMetadata, ContactSummary, Metadata, Timing, contact_metadata, papers_of,
};
use asperity_contact_framework::report::format::{count, input_number, input_quantity, number, signed};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Schema, Table, Tables};
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext, fields, rows, set_memory};
use asperity_plot::{Axis, Colour, Figure, Layer, Plot};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Map, Value};

use crate::model_tables::{CurveRow, PairRow, RowCase, comparison_of_models, curves_of_models};

pub struct Limit;

impl Kind for Limit {
    const NAME: &'static str = "limit";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = LimitSpec;
    type Plan = LimitPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<LimitPlan, InputError> {
        let raw = table.get_ref();
        let (rough, flat) = (raw.rough.get_ref(), raw.flat.get_ref());
        let pair = [file.body(rough, raw.rough.span())?, file.body(flat, raw.flat.span())?];
        let counts = file.counts(&raw.count)?;
        let draws = file.several(&raw.draws, "random sets of each size")?;
        file.spheres_only(&raw.law, "the asperities of [limit] are spheres of equal radius")?;
        let laws = file.law_plans(&raw.law, (rough, &pair[0]), &[(None, Flat::Bare(pair[1]))], flat)?;
        let (radius, sigma, density) = (raw.radius.value(), raw.sigma.value(), raw.density.value());
        let population = Population { radius, sigma, density, heights: Heights::GAUSSIAN };
        let sets = LimitSets { population, separations: raw.separation.0.clone(), counts, draws };
        Ok(LimitPlan { bodies: Bodies { rough: rough.clone(), flat: flat.clone() }, laws, sets })
    }

    fn tables() -> Vec<Schema> {
        vec![
            Schema::of::<CurveRow>(),
            Schema::of::<PairRow>(),
            Schema::of::<ConvergenceRow>(),
            Schema::of::<SlopeRow>(),
        ]
    }
}

/// Sets of growing size against their limit.
pub struct LimitPlan {
    pub bodies: Bodies,
    pub laws: Vec<LawContact>,
    pub sets: LimitSets,
}

#[derive(Debug)]
pub struct LimitResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    pub sets: LimitSets,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Size by size, law by law, separation by separation.
    pub points: Vec<LimitPoint>,
    pub slopes: Vec<ErrorSlope>,
}

impl Plan for LimitPlan {
    fn memory(&self) -> Memory {
        let largest = self.sets.counts.iter().copied().max().unwrap_or(0);
        Memory { bytes: set_memory(largest as u128), key: None }
    }

    fn work(&self) -> u128 {
        (self.sets.asperities() * self.laws.len() * self.sets.separations.len()) as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        let start = Instant::now();
        let Self { bodies, laws, sets } = self;
        let counter = Counter::default();
        let counted = |contact| CountedContact::new(contact, &counter);
        let contacts: Vec<_> = laws.iter().map(|law| counted(&*law.contact)).collect();
        context.progress.stage("integrals", contacts.len() as f64);
        let cases = laws.iter().zip(&contacts);
        let cases: Vec<_> = cases
            .map(|(law, contact)| {
                let case = LimitCase::new(&law.spec, contact, sets);
                context.progress.advance(1.0);
                case
            })
            .collect();
        let statistical = start.elapsed();
        context.progress.stage("random sets", sets.asperities() as f64);
        let seed = |count, draw| context.stream_seed(&format!("limit {count} {draw}"));
        let points = convergence(&cases, sets, seed, |count| {
            counter.add(Item::Surfaces, 1);
            context.progress.advance(count as f64);
        });
        let points = points.map_err(|error| InputError::file(&context.source.path, error))?;
        let total = start.elapsed();
        let deterministic = total - statistical;
        let timing = Timing { statistical, deterministic, total, ..Timing::default() };
        let population = &sets.population;
        Ok(Box::new(LimitResults {
            metadata: context.metadata(papers_of(laws), timing, Some(counter.work())),
            contact: contact_metadata(context.materials, laws, bodies, None),
            plasticity_index: plasticity_index(&*laws[0].contact, population.sigma, population.radius),
            sets: sets.clone(),
            slopes: ErrorSlope::all(&points),
            points,
        }))
    }
}

impl fmt::Display for LimitPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let LimitSets { counts, draws, .. } = &self.sets;
        let laws: Vec<&str> = self.laws.iter().map(|law| law.label.as_str()).collect();
        writeln!(f, "  {} on {}, law {}", self.bodies.rough, self.bodies.flat, laws.join(", "))?;
        write!(f, "  {draws} random sets and one set at the quantiles for each size, ")?;
        writeln!(f, "{counts:?} asperities")
    }
}

/// Convergence of the sum to the integral: sets of equal radii and Gaussian heights, of growing size.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LimitSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<String>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws.
    pub law: Spanned<Laws>,
    /// Radius of every asperity.
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// Standard deviation of the asperity heights.
    #[schemars(extend("examples" = ["48 nm"]))]
    pub sigma: Quantity<Length>,
    /// Asperities per nominal area.
    #[schemars(extend("examples" = ["6e10 /m^2"]))]
    pub density: Quantity<ArealNumberDensity>,
    /// Separations, d/sigma.
    #[schemars(extend("examples" = [[0, 1, 2]]))]
    pub separation: LinearSweep,
    /// Numbers of asperities of the sets.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [{ "from": 100, "to": 1e6, "points": 9 }]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Random sets of each size.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [100]))]
    pub draws: Spanned<Whole>,
}

/// The errors of sets of one size at one separation.
pub struct ConvergenceRow<'a> {
    point: &'a LimitPoint,
    quantity: LimitQuantity,
}

rows! { ConvergenceRow<'_> => "convergence.csv";
    "One row for each quantity, law, number of asperities and separation: errors of the sum relative to the integral.";
    row =>
    law["text"] = row.point.law.as_str(), "Contact law of an asperity.";
    quantity["text"] = row.quantity.name(), "Quantity whose error is given: `area` or `load`.";
    separation_over_sigma["1", label("d/σ"), input] = row.point.separation_over_sigma(), "Separation over sigma, the standard deviation of the asperity heights.";
    asperities["count"] = row.point.count, "Asperities in a set.";
    expected_contacts["1"] = row.point.expected_contacts(), "Expected number of contacts.";
    random_mean_error["1", scale(1e-3)] = row.point.scatter(row.quantity).0, "Mean relative error of the random sets.";
    random_rms_error["1", scale(1e-3)] = row.point.scatter(row.quantity).1, "Root mean square of the relative errors of the random sets.";
    quantile_error["1", scale(1e-3)] = row.point.quantile_error(row.quantity), "Relative error, without sign, of the set with heights at the quantiles.";
    expected_quantile_error["1", scale(1e-3)] = row.point.expected_quantile_error(row.quantity), "Leading term of that error, of the midpoint rule in probability at the tail of the heights.";
    fitted["true/false"] = row.point.is_fitted(), "Whether more than 30 contacts are expected, so that the row takes part in the fit of the slopes.";
}

pub struct SlopeRow<'a>(&'a ErrorSlope);

rows! { SlopeRow<'_> => "slopes.csv";
    "One row for each law, separation, quantity and way to take the heights: the slope of the logarithm of the error over that of the number of asperities.";
    row =>
    law["text"] = row.0.law.as_str(), "Contact law of an asperity.";
    quantity["text"] = row.0.quantity.name(), "Quantity whose error is fitted: `area` or `load`.";
    heights["text"] = row.0.sampling.name(), "How the heights are taken: `random` or at the `quantiles`.";
    separation_over_sigma["1", label("d/σ"), input] = row.0.separation, "Separation over sigma.";
    slope["1"] = row.0.fit.slope, "Slope of the root mean square error of the random sets, or of the error of the set at the quantiles.";
    standard_error["1", label("± s.e."), scale(1.0)] = row.0.fit.standard_error, "Its standard error.";
    expected_slope["1"] = row.0.expected, "Slope that theory expects over the fitted numbers of asperities.";
    deviation["1", signed, scale(1.0)] = row.0.fit.slope - row.0.expected, "Slope less the expected one.";
    points["count"] = row.0.fit.points, "Numbers of asperities fitted.";
}

/// In `curves.csv` and `comparison.csv` a set is a surface, a random draw a realisation, and the integral the surface `population`.
pub fn tables(results: &LimitResults) -> Vec<Table> {
    let LimitResults { points, contact, slopes, .. } = results;
    let integrals = points.iter().take_while(|point| point.count == points[0].count);
    let integrals = integrals.map(|LimitPoint { law, exact, .. }| {
        (RowCase::bare("population", 1, law), ModelKind::Statistical, exact.statistical)
    });
    let sums = pairs(results).map(|row| (row.case, ModelKind::Deterministic, row.pair.deterministic));
    let curves = integrals
        .chain(sums)
        .map(|(case, kind, response)| CurveRow::at_separation(case, kind, response, contact.reduced_modulus));
    let errors =
        LimitQuantity::ALL.map(|quantity| points.iter().map(move |point| ConvergenceRow { point, quantity }));
    let tables = [
        curves_of_models(curves),
        comparison_of_models(pairs(results)),
        Table::new(errors.into_iter().flatten()),
        Table::new(slopes.iter().map(SlopeRow)),
    ];
    tables.into_iter().filter(|table| table.rows() > 0).collect()
}

fn pairs(results: &LimitResults) -> impl Iterator<Item = PairRow> {
    results.points.iter().flat_map(move |point| {
        let area = point.count as f64 / results.sets.population.density;
        point.pairs().map(move |(sampling, draw, pair)| {
            let case = RowCase::bare(&format!("{}-{}", sampling.name(), point.count), draw, &point.law);
            PairRow::of_models(case, pair, area, results.plasticity_index)
        })
    })
}

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
