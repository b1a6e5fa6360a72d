//! The page of a surface in tiles: how far is the integral from the sum over all of it?

use asperity::compare::{Kind, Pair};
use asperity_framework::Outcome;
use asperity_framework::report::format::{
    count, input_number, number, percent, quantity, thickness, with_sign,
};
use asperity_framework::report::page::Page;
use asperity_framework::report::sections;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Plot};

use super::results::{LawResults, TiledResults, TiledSurface};
use crate::kind::compare::tables::limits;

/// Half-width of a 95 % interval in standard errors.
const INTERVAL: f64 = 1.96;

pub(super) fn page(results: &TiledResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::findings(&mut page, results.laws.iter().map(finding));
    sections::warnings(&mut page, &results.warnings());
    for law in &results.laws {
        of_law(&mut page, law);
    }
    sections::notes(&mut page, &results.metadata);
    surface(&mut page, &results.surface);
    page.heading(2, "Method");
    let own = "Where separations are measured in the σ of these asperities, which is the integral's too, part of this scatter is common to both \
               models: for Gaussian heights and one radius the intervals are then wider than those of the difference, so that the integral may \
               be within them and differ all the same.";
    page.paragraph(
        "The sum runs over every asperity, tile by tile; the tiles are fixed by the input, so that the result is the same to the bit in one \
         process and in parts on many machines (docs/clusters.md). The integral runs at the same separations, and at the pressures of the \
         sum. Standard errors follow from the scatter of the tiles, taken as independent: a ratio estimate of load over area. They are \
         errors of the sum as an estimate for a larger surface of the same kind; the sum over this surface has none.",
    );
    if !results.surface.is_nominal {
        page.paragraph(own);
    }
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// A law and its layer, in words.
fn name(law: &LawResults) -> String {
    match law.thickness {
        None => law.law.clone(),
        Some(at) => format!("{}, layer {}", law.law, thickness(at)),
    }
}

/// Pressure of the integral over that of the sum, less one; `None` where the sum carries none.
fn excess(pair: &Pair) -> Option<f64> {
    let sum = pair.deterministic.pressure.total();
    (sum > 0.0).then(|| pair.statistical.pressure.total() / sum - 1.0)
}

/// How far the models are apart: at equal separation, as far as the sampling error lets that be known, then at equal load.
fn finding(law: &LawResults) -> String {
    let name = name(law);
    let valid: Vec<AtSeparation> = law.at_separations().filter_map(AtSeparation::of).collect();
    let Some(first) = valid.first() else { return without_errors(law, &name) };
    let tightest = valid.iter().fold(first, |a, b| if b.error < a.error { b } else { a });
    let beyond: Vec<&AtSeparation> = valid.iter().filter(|at| at.is_beyond()).collect();
    let largest = beyond.iter().max_by(|a, b| a.excess.abs().total_cmp(&b.excess.abs()));
    let interval = format!(
        "narrowest at d/σ = {}, ±{}",
        input_number(tightest.separation),
        percent(INTERVAL * tightest.error)
    );
    let mut words = match largest {
        None => format!(
            "**{name}**: at equal separation the pressure of the integral is within the 95 % interval of the sum at all {} separations \
             within the valid range of both models ({interval}).",
            valid.len()
        ),
        Some(at) => format!(
            "**{name}**: at equal separation the pressure of the integral is outside the 95 % interval of the sum at {} of {} separations \
             within the valid range of both models (one in twenty would be by chance); of these it differs most at d/σ = {}, by {} \
             (interval ±{}; {interval}).",
            beyond.len(),
            valid.len(),
            input_number(at.separation),
            signed(at.excess),
            percent(INTERVAL * at.error)
        ),
    };
    let heaviest = law.valid_loads().max_by(|a, b| a.target.total_cmp(&b.target));
    if let Some(Pair { target, statistical, deterministic, .. }) = heaviest {
        let area = statistical.area_ratio.total() / deterministic.area_ratio.total() - 1.0;
        let apart = statistical.separation_over_sigma - deterministic.separation_over_sigma;
        words += &format!(
            " At equal load, at {} as the highest in the valid range, its contact area differs by {} and its separation by {} σ.",
            quantity(*target, "Pa"),
            signed(area),
            with_sign(apart, number)
        );
    }
    words
}

/// The finding where the sum has no standard error.
fn without_errors(law: &LawResults, name: &str) -> String {
    let valid = law.at_separations().filter(|(pair, _)| pair.is_valid());
    let largest = valid
        .filter_map(|(pair, _)| Some((pair.target, excess(pair)?)))
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    match largest {
        None => {
            format!(
                "**{name}**: no separation is within the valid range of both models; the table names the limits."
            )
        }
        Some((separation, excess)) => format!(
            "**{name}**: at equal separation the pressure of the integral differs from that of the sum by at most {}, at d/σ = {}, within \
             the valid range of both models. The sum has no interval: its heights are at the quantiles, or fewer than eight tiles carry load.",
            signed(excess),
            input_number(separation)
        ),
    }
}

/// Both models at equal separation within the valid range of both, relative to the sum.
struct AtSeparation {
    separation: f64,
    excess: f64,
    /// Standard error of the sum.
    error: f64,
}

impl AtSeparation {
    fn of((pair, error): (&Pair, Option<f64>)) -> Option<Self> {
        let error = error.filter(|_| pair.is_valid())? / pair.deterministic.pressure.total();
        Some(Self { separation: pair.target, excess: excess(pair)?, error })
    }

    fn is_beyond(&self) -> bool {
        self.excess.abs() > INTERVAL * self.error
    }
}

fn signed(share: f64) -> String {
    with_sign(share, percent)
}

/// Figures and table under one law.
fn of_law(page: &mut Page, law: &LawResults) {
    let name = name(law);
    page.heading(2, &format!("Law {name}"));
    let layer = law.thickness.map_or_else(String::new, |at| format!("-layer-{at:e}"));
    let file = format!("{}{layer}-pressure.svg", law.law).replace(['(', ')', ' ', '=', ','], "-");
    page.figure(
        &file,
        figure(&name, law),
        "Left: nominal pressure against separation. Right: pressure of the integral over that of the sum, less one; the band is the 95 % \
         interval of the sum from the scatter of the tiles.",
    );
    page.table(
        [
            "d/σ",
            "pressure of the sum",
            "± s.e.",
            "pressure of the integral",
            "difference",
            "area ratio of the sum",
            "limits exceeded",
        ],
        law.at_separations().map(|(pair, error)| {
            let sum = pair.deterministic.pressure.total();
            vec![
                input_number(pair.target),
                quantity(sum, "Pa"),
                error.filter(|_| sum > 0.0).map_or_else(|| "–".to_owned(), |error| percent(error / sum)),
                quantity(pair.statistical.pressure.total(), "Pa"),
                excess(pair).map_or_else(|| "–".to_owned(), signed),
                number(pair.deterministic.area_ratio.total()),
                limits(pair.exceeded()),
            ]
        }),
    );
    if !law.comparison.unpaired.is_empty() {
        page.paragraph(&format!(
            "The integral does not reach {} of the pressures of the sum.",
            law.comparison.unpaired.len(),
        ));
    }
}

fn figure(name: &str, law: &LawResults) -> Figure {
    let curve = |kind: Kind| {
        let points = law.comparison.curves.iter().filter(move |point| point.kind == kind);
        points.map(|point| (point.target, point.response.pressure.total())).collect::<Vec<_>>()
    };
    let loaded = |points: Vec<(f64, f64)>| points.into_iter().filter(|(_, p)| *p > 0.0).collect::<Vec<_>>();
    let curves = Plot::new(
        format!("{name}: both models"),
        Axis::linear("separation d/σ"),
        Axis::log("nominal pressure in Pa"),
    )
    .with(
        Layer::line(loaded(curve(Kind::Deterministic)))
            .coloured(Colour::Deterministic)
            .named("deterministic"),
    )
    .with(
        Layer::line(loaded(curve(Kind::Statistical)))
            .coloured(Colour::Statistical)
            .dashed(Dash::Dashed)
            .named("statistical"),
    );
    let differences: Vec<_> =
        law.at_separations().filter_map(|(pair, _)| Some((pair.target, excess(pair)?))).collect();
    let band: Vec<_> = law
        .at_separations()
        .filter_map(|(pair, error)| {
            let half = INTERVAL * error? / pair.deterministic.pressure.total();
            Some((pair.target, excess(pair)? - half, excess(pair)? + half))
        })
        .collect();
    let difference = Plot::new(
        format!("{name}: difference"),
        Axis::linear("separation d/σ"),
        Axis::linear("integral over sum, less one"),
    )
    .with(Layer::band(band).coloured(Colour::Statistical))
    .with(Layer::line(differences).coloured(Colour::Statistical).named("difference"))
    .with_zero();
    Figure::row(format!("Both models under {name}"), vec![curves, difference])
}

fn surface(page: &mut Page, surface: &TiledSurface) {
    page.heading(2, "Surface");
    let TiledSurface { count: asperities, nominal_area, tiles, statistics, population, .. } = surface;
    let shape = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), number);
    page.paragraph(&format!(
        "`{}`: {} asperities on {} m² in {} tiles.",
        surface.name,
        count(*asperities),
        number(*nominal_area),
        count(*tiles)
    ));
    page.table(
        ["", "of all asperities", "in the integral"],
        [
            ("σ of the heights", quantity(statistics.sigma, "m"), quantity(population.sigma, "m")),
            ("mean radius", quantity(statistics.mean_radius, "m"), quantity(population.radius, "m")),
            ("density in 1/m²", number(*asperities as f64 / nominal_area), number(population.density)),
            ("skewness of the heights", shape(statistics.skewness), number(population.heights.skewness())),
            ("kurtosis of the heights", shape(statistics.kurtosis), number(population.heights.kurtosis())),
            ("scatter of the radii", percent(statistics.radius_cv), percent(0.0)),
            ("correlation of height and radius", shape(statistics.height_radius_correlation), number(0.0)),
        ]
        .map(|(what, of_all, in_integral)| vec![what.to_owned(), of_all, in_integral]),
    );
    let source = if surface.is_nominal {
        "The integral has the parameters of the population that the asperities are drawn from; separations are measured from its mean in its σ."
    } else {
        "The integral has Gaussian heights with the σ, mean radius and density of all asperities; separations are measured from their mean \
         height in their σ."
    };
    page.paragraph(source);
}
