//! Several laws: run, and the tables besides those of a comparison.

use std::f64::consts::PI;

use asperity::compare::{
    AtLoad, Difference, Dominance, Effect, Group, Influence, Measure, ModelKind, UnderLaw,
};
use asperity::sphere::{Boundary, Curve, LARGEST_SLOPE, Point, boundaries};
use asperity::study::{CaseStudy, LawContact};
use asperity::work::{CountedContact, Counter};
use asperity::{Contact, Paper};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::report::table::{Column, Schema, Table};
use asperity_contact_framework::{RunContext, columns, rows};

use super::super::compare::results::{CompareResults, SurfaceResults};
use super::super::compare::{rows, run_compare};
use super::{Critical, LawsPlan};
use crate::model_tables::limits;

pub struct LawRow<'a>(&'a LawOnAsperity);

rows! { LawRow<'_> => "law_list.csv";
    "One row for each law; the first is the reference law, which the others are compared with.";
    row =>
    law["text"] = row.0.law.as_str(), "Contact law.";
    elastic_plastic["true/false", label("elastic-plastic")] = row.0.is_elastic_plastic, "Whether contacts pass from elastic to another regime; a law of a single regime is a limiting case.";
    description["text", label("description and range of validity")] = row.0.about, "Description and range of validity.";
    sources["text"] = row.0.papers.iter().map(|paper| paper.short.to_owned()).collect::<Vec<String>>(), "Its sources.";
}

/// A point of one asperity under one law.
struct PointRow<'a> {
    results: &'a LawsResults,
    law: &'a str,
    point: &'a Point,
}

rows! { PointRow<'_> => "laws.csv", is_long true;
    "One row for each law and indentation of the single asperity.";
    row =>
    law["text"] = row.law, "Contact law.";
    indentation_over_critical["1"] = row.point.indentation / row.results.critical.indentation, "Indentation over the critical indentation, at which yield begins.";
    indentation_m["m"] = row.point.indentation, "Indentation w (Eq. 1).";
    load_n["N"] = row.point.contact.load, "Load P of the asperity.";
    area_m2["m²"] = row.point.contact.area, "Real contact area A of the asperity.";
    load_over_critical["1"] = row.point.contact.load / row.results.critical.load, "Load over the load at the critical indentation.";
    area_over_critical["1"] = row.point.contact.area / row.results.critical.area, "Area over the area at the critical indentation.";
    mean_pressure_pa["Pa"] = row.point.contact.load / row.point.contact.area, "Mean contact pressure P/A.";
    stiffness_n_per_m["N/m"] = row.point.contact.stiffness, "Contact stiffness dP/dw within the regime.";
    regime["text"] = row.point.contact.regime.name(), "Regime: `elastic`, `elastic-plastic` or `plastic`.";
    beyond_small_strains["true/false"] = row.results.is_beyond_small_strains(&row.point.contact), "Whether the contact radius exceeds 0.3 of the asperity radius, beyond which strains are not small.";
}

/// A boundary between two formulas of a law.
pub struct BoundaryRow<'a> {
    results: &'a LawsResults,
    law: &'a str,
    boundary: &'a Boundary,
}

rows! { BoundaryRow<'_> => "boundaries.csv";
    "One row for each indentation at which a law changes from one formula to the next.";
    row =>
    law["text"] = row.law, "Contact law.";
    indentation_over_critical["1", label("w/wc")] = row.boundary.indentation / row.results.critical.indentation, "Indentation of the boundary over the critical indentation, at which yield begins.";
    indentation_m["m", label("w")] = row.boundary.indentation, "Indentation w of the boundary.";
    regime_below["text", label("below")] = row.boundary.below.regime.name(), "Regime just below the boundary.";
    regime_above["text", label("above")] = row.boundary.above.regime.name(), "Regime just above the boundary.";
    load_below_n["N"] = row.boundary.below.load, "Load just below the boundary.";
    load_above_n["N"] = row.boundary.above.load, "Load just above the boundary.";
    area_below_m2["m²"] = row.boundary.below.area, "Real contact area just below the boundary.";
    area_above_m2["m²"] = row.boundary.above.area, "Real contact area just above the boundary.";
    load_jump["1", label("jump of the load"), signed_percent, scale(1.0)] = row.boundary.load_jump(), "Jump of the load over the load below; 0 where it is continuous.";
    area_jump["1", label("jump of the area"), signed_percent, scale(1.0)] = row.boundary.area_jump(), "Jump of the area over the area below; 0 where it is continuous.";
    beyond_small_strains["true/false", label("beyond small strains")] = row.results.is_beyond_small_strains(&row.boundary.above), "Whether the contact radius exceeds 0.3 of the asperity radius, beyond which strains are not small.";
}

/// All laws and both models on a surface at one load, by one measure.
pub struct InfluenceRow<'a> {
    surface: &'a SurfaceInfluence,
    measure: Measure,
    at_load: &'a AtLoad,
}

rows! { InfluenceRow<'_> => "influence.csv";
    "One row for each surface, realisation, measure and load: the range of the laws under each model, and the difference between the models under each law. Separations are compared by their difference, areas by their ratio.";
    ..influence_columns(|row: &Self| (row.surface, row.measure));
    row =>
    pressure_pa["Pa"] = row.at_load.pressure, "Nominal pressure.";
    counts["true/false", label("admissible")] = row.at_load.exceeded.is_none(), "Whether the load is admissible under every law.";
    limits["text"] = limits(row.at_load.exceeded), "Limits of admissible loads that are exceeded under some law, as in `curves.csv`.";
    fewest_contacts["1", scale(1.0)] = row.at_load.fewest_contacts, "Fewest effective contacts of the deterministic model under any law.";
    all_laws_statistical["1", scale(1.0), label("all laws, integral")] = row.spread(Group::All, ModelKind::Statistical), "Highest over lowest of all laws under the statistical model.";
    all_laws_deterministic["1", scale(1.0), label("all laws, sum")] = row.spread(Group::All, ModelKind::Deterministic), "Highest over lowest of all laws under the deterministic model.";
    passing_laws_statistical["1", scale(1.0), label("elastic-plastic, integral")] = row.spread(Group::ElasticPlastic, ModelKind::Statistical), "Highest over lowest of the elastic-plastic laws, without the limits `hertz` and `fully-plastic`, under the statistical model.";
    passing_laws_deterministic["1", scale(1.0), label("elastic-plastic, sum")] = row.spread(Group::ElasticPlastic, ModelKind::Deterministic), "Highest over lowest of the elastic-plastic laws under the deterministic model.";
    models_first_law["1", scale(1.0), label("models, reference law")] = row.compared(row.at_load.gap(row.measure, 0)), "Statistical over deterministic model under the first law.";
    passing_laws_models_most["1", scale(1.0), label("models, largest")] = row.largest_gap().map(|(_, gap)| row.compared(gap)), "Statistical over deterministic model under the elastic-plastic law for which they differ most.";
    passing_laws_models_most_law["text", label("under the law")] = row.largest_gap().map(|(law, _)| row.surface.influence.laws[law].as_str()), "The law of the previous column.";
    sampling_error["1", scale(1.0), label("± s.e.")] = row.at_load.sampling_error(row.measure, 0), "Standard error of the difference between the models under the first law, of an area relative to it.";
}

impl InfluenceRow<'_> {
    /// Separations are compared by their difference, areas by their ratio.
    fn compared(&self, difference: f64) -> f64 {
        match self.measure {
            Measure::Separation => difference,
            Measure::Area => difference.exp(),
        }
    }

    fn spread(&self, group: Group, kind: ModelKind) -> Option<f64> {
        self.at_load.spread(self.measure, group, kind).map(|spread| self.compared(spread))
    }

    /// The elastic-plastic law under which the models differ most.
    fn largest_gap(&self) -> Option<(usize, f64)> {
        self.at_load.largest_gap(self.measure, Group::ElasticPlastic)
    }
}

/// What a row on the influence of the law belongs to.
fn influence_columns<R>(
    key: impl for<'r> Fn(&'r R) -> (&'r SurfaceInfluence, Measure) + Copy + 'static,
) -> Vec<Column<R>> {
    columns! { row: R =>
        surface["text"] = key(row).0.surface.as_str(), "Name of the surface.";
        realisation["count"] = key(row).0.realisation, "Number of the realisation of the surface, from 1.";
        measure["text"] = key(row).1.name(), "What is compared at equal load: `separation_over_sigma` or `area_ratio`.";
    }
}

/// A difference of d/sigma, or of an area relative to what it is compared with.
pub(super) fn reported(measure: Measure, difference: f64) -> f64 {
    match measure {
        Measure::Separation => difference,
        Measure::Area => difference.exp_m1(),
    }
}

/// One law on a surface, by one measure.
pub struct ChoiceRow<'a> {
    surface: &'a SurfaceInfluence,
    measure: Measure,
    law: usize,
}

impl ChoiceRow<'_> {
    /// The effect of the law instead of the first one.
    fn choice(&self, kind: ModelKind) -> Option<Effect> {
        self.surface.influence.of_choice(self.measure, self.law, kind).filter(|_| self.law > 0)
    }

    fn summation(&self) -> Option<Effect> {
        self.surface.influence.of_summation(self.measure, self.law)
    }

    fn standard_errors(&self) -> Option<f64> {
        Some(self.surface.influence.of_standard_errors(self.measure, self.law)?.largest.abs())
    }

    fn largest(&self, effect: Option<Effect>) -> Option<f64> {
        effect.map(|effect| reported(self.measure, effect.largest))
    }
}

rows! { ChoiceRow<'_> => "influence_of_laws.csv";
    "One row for each surface, realisation, measure and law: the largest differences over the loads that are admissible under every law, of separations in sigma, of areas relative.";
    ..influence_columns(|row: &Self| (row.surface, row.measure));
    row =>
    law["text"] = row.surface.influence.laws[row.law].as_str(), "Contact law.";
    statistical_from_first["1", label("integral, from reference law"), signed, scale(1.0)] = row.largest(row.choice(ModelKind::Statistical)), "Largest difference of the statistical model under this law from that under the first; empty of the first.";
    statistical_from_first_at_pa["Pa", label("at"), prefix("M")] = row.choice(ModelKind::Statistical).map(|effect| effect.at), "The load at which it is.";
    deterministic_from_first["1", label("sum, from reference law"), signed, scale(1.0)] = row.largest(row.choice(ModelKind::Deterministic)), "The same of the deterministic model.";
    deterministic_from_first_at_pa["Pa", label("at"), prefix("M")] = row.choice(ModelKind::Deterministic).map(|effect| effect.at), "The load at which it is.";
    statistical_from_deterministic["1", label("integral from sum"), signed, scale(1.0)] = row.largest(row.summation()), "Largest difference of the statistical from the deterministic model under this law.";
    statistical_from_deterministic_at_pa["Pa", label("at"), prefix("M")] = row.summation().map(|effect| effect.at), "The load at which it is.";
    largest_in_standard_errors["1", label("largest in s.e."), scale(1.0)] = row.standard_errors(), "Largest difference between the models in its standard errors; empty where no interval is claimed.";
}

/// Contact law and summation method on a surface, by one measure.
pub struct DominanceRow<'a> {
    surface: &'a SurfaceInfluence,
    dominance: &'a Dominance,
}

impl<'a> DominanceRow<'a> {
    fn all(results: &'a LawsResults) -> impl Iterator<Item = Self> {
        results
            .influences
            .iter()
            .flat_map(|surface| surface.dominances.iter().map(move |dominance| Self { surface, dominance }))
    }

    fn reported(&self, difference: f64) -> f64 {
        reported(self.dominance.measure, difference)
    }

    /// The law that deviates most from the first.
    fn furthest(&self) -> Option<&str> {
        let (law, _) = self.dominance.without_furthest?;
        Some(&self.surface.influence.laws[law])
    }
}

rows! { DominanceRow<'_> => "law_or_summation.csv";
    "One row for each surface, realisation and measure with a load that is admissible under every law: means over these loads, of separations in sigma, of areas relative.";
    ..influence_columns(|row: &Self| (row.surface, row.dominance.measure));
    row =>
    loads["count"] = row.surface.influence.counting().count(), "Loads that are admissible under every law.";
    matters_more["text", label("matters more")] = row.dominance.dominant().name(), "What matters more: `contact-law`, `summation-method`, `equal` (their effects differ by less than 5 %) or `cannot-tell` (the difference between the models is not larger than two standard errors, or has none).";
    laws["text"] = row.dominance.group.name(), "The laws of the range: `elastic-plastic` or `all`.";
    law_range["1", label("range over the laws"), scale(1.0)] = row.reported(row.dominance.law.mean), "Mean range of these laws under the deterministic model; of areas, the largest over the smallest, minus 1.";
    largest_law_range["1", label("at most"), scale(1.0)] = row.reported(row.dominance.law.largest), "The largest.";
    largest_law_range_at_pa["Pa", label("at"), prefix("M")] = row.dominance.law.at, "The load of the largest.";
    models_difference["1", label("difference of the models"), scale(1.0)] = row.reported(row.dominance.summation.mean), "Mean magnitude of the difference between the models under the first law; of areas, the larger over the smaller, minus 1.";
    largest_models_difference["1", label("largest"), signed, scale(1.0)] = row.reported(row.dominance.summation.largest), "The largest, statistical minus deterministic.";
    largest_models_difference_at_pa["Pa", label("at"), prefix("M")] = row.dominance.summation.at, "The load of the largest.";
    standard_error["1", label("± s.e."), scale(1.0)] = row.dominance.sampling.map(|error| row.reported(error.mean)), "Mean standard error of that difference; empty where no interval is claimed.";
    most_deviating_law["text", label("most deviating law")] = row.furthest(), "The law of the range that deviates most from the first under the deterministic model; empty of two laws.";
    law_range_without_it["1", label("range without it"), scale(1.0)] = row.dominance.without_furthest.map(|(_, rest)| row.reported(rest.mean)), "Mean range of the laws without it.";
}

/// Those of a comparison, and those of the laws.
pub fn schemas() -> Vec<Schema> {
    let mut schemas = rows::schemas();
    schemas.extend([
        Schema::of::<LawRow>(),
        Schema::of::<PointRow>(),
        Schema::of::<BoundaryRow>(),
        Schema::of::<InfluenceRow>(),
        Schema::of::<ChoiceRow>(),
        Schema::of::<DominanceRow>(),
    ]);
    schemas
}

pub fn tables(results: &LawsResults) -> Vec<Table> {
    let points = results
        .laws
        .iter()
        .flat_map(|law| law.curve.points.iter().map(move |point| PointRow { results, law: &law.law, point }));
    let boundaries = results.laws.iter().flat_map(|law| {
        law.boundaries.iter().map(move |boundary| BoundaryRow { results, law: &law.law, boundary })
    });
    let measured =
        || results.influences.iter().flat_map(|surface| Measure::ALL.map(|measure| (surface, measure)));
    let loads = measured().flat_map(|(surface, measure)| {
        surface.influence.loads.iter().map(move |at_load| InfluenceRow { surface, measure, at_load })
    });
    let choices = measured().flat_map(|(surface, measure)| {
        (0..surface.influence.laws.len()).map(move |law| ChoiceRow { surface, measure, law })
    });
    let mut tables = rows::tables(&results.compare);
    tables.extend([
        Table::new(results.laws.iter().map(LawRow)),
        Table::new(points),
        Table::new(boundaries),
        Table::new(loads),
        Table::new(choices),
        Table::new(DominanceRow::all(results)),
    ]);
    tables
}

pub fn run(context: &RunContext, laws_plan: &LawsPlan) -> Result<LawsResults, InputError> {
    let counter = Counter::default();
    let mut compare = run_compare(context, &laws_plan.compare, &counter)?;
    let mut influences = Vec::new();
    for surface in &compare.surfaces {
        influences.extend((0..surface.realisations.len()).map(|index| {
            let realisation = index + 1;
            let influence = influence(&laws_plan.compare.study.laws, surface, index);
            let by = |measure| Dominance::new(&influence, measure);
            let dominances = Measure::ALL.into_iter().filter_map(by).collect();
            SurfaceInfluence { surface: surface.surface.name.clone(), realisation, influence, dominances }
        }));
    }
    let laws: Vec<LawOnAsperity> =
        laws_plan.compare.study.laws.iter().map(|law| on_asperity(laws_plan, law, &counter)).collect();
    compare.metadata.work = Some(counter.work());
    Ok(LawsResults {
        compare,
        radius: laws_plan.radius,
        curvature_ratio: laws_plan.curvature_ratio,
        critical: laws_plan.critical,
        laws,
        influences,
    })
}

fn on_asperity(plan: &LawsPlan, law: &LawContact, counter: &Counter) -> LawOnAsperity {
    let contact = CountedContact::new(&*law.contact, counter);
    let shape = plan.shape(&law.spec);
    let indentations: Vec<f64> = plan.ratios.iter().map(|ratio| ratio * plan.critical.indentation).collect();
    LawOnAsperity {
        law: law.label.clone(),
        about: law.spec.about(),
        papers: law.spec.papers(),
        is_elastic_plastic: law.spec.has_ranges(),
        curve: Curve::new(&contact, shape, &indentations),
        boundaries: boundaries(&contact, shape),
    }
}

/// Of one realisation of a surface. Its sampling errors are those of the verdicts, which are of the mean over all
/// realisations.
fn influence(laws: &[LawContact], surface: &SurfaceResults, realisation: usize) -> Influence {
    let of_single = (surface.realisations.len() as f64).sqrt();
    let of_case = |case: &CaseStudy| {
        let mut differences = case.verdicts.differences.clone();
        for estimate in differences.iter_mut().flat_map(|at| &mut at.estimates).flatten() {
            estimate.error = estimate.error.map(|error| of_single * error);
        }
        differences
    };
    let differences: Vec<Vec<Difference>> = surface.cases.iter().map(of_case).collect();
    let cases = surface.cases.iter().map(|case| &case.realisations[realisation]).zip(&differences);
    let under = laws.iter().zip(cases).map(|(law, (case, differences))| UnderLaw {
        law: &case.law,
        is_elastic_plastic: law.spec.has_ranges(),
        pairs: &case.comparison.pairs,
        differences,
    });
    Influence::new(&under.collect::<Vec<_>>())
}

/// Several laws on one asperity and on surfaces.
#[derive(Debug)]
pub struct LawsResults {
    /// Both models on the surfaces under every law.
    pub compare: CompareResults,
    /// 1/(mean curvature) of the single asperity, m.
    pub radius: f64,
    /// Its larger principal curvature over the smaller one.
    pub curvature_ratio: f64,
    /// The unit of indentation, load and area.
    pub critical: Critical,
    /// Law by law; the others are compared with the first.
    pub laws: Vec<LawOnAsperity>,
    /// Surface by surface, realisation by realisation.
    pub influences: Vec<SurfaceInfluence>,
}

impl LawsResults {
    /// The effects on the first realisation of a surface.
    pub fn first_influence(&self, surface: &str) -> Option<&SurfaceInfluence> {
        self.influences.iter().find(|influence| influence.surface == surface)
    }

    /// Whether strains are not small in a contact on the single asperity: a/R is larger than [`LARGEST_SLOPE`].
    pub fn is_beyond_small_strains(&self, contact: &Contact) -> bool {
        (contact.area / PI).sqrt() / self.radius > LARGEST_SLOPE
    }

    /// The smallest indentation (m) of the single asperity at which strains are not small under one of the laws.
    pub fn end_of_small_strains(&self) -> Option<f64> {
        let end = |law: &LawOnAsperity| {
            let mut trace = law.curve.trace.iter();
            Some(trace.find(|point| self.is_beyond_small_strains(&point.contact))?.indentation)
        };
        self.laws.iter().filter_map(end).reduce(f64::min)
    }
}

/// The single asperity under one law.
#[derive(Debug)]
pub struct LawOnAsperity {
    /// The law, as tables name it.
    pub law: String,
    /// Description and range of validity, in one line.
    pub about: &'static str,
    pub papers: Vec<Paper>,
    /// Whether contacts under it pass from elastic to something else.
    pub is_elastic_plastic: bool,
    /// Load, area and regime against indentation.
    pub curve: Curve,
    pub boundaries: Vec<Boundary>,
}

/// Effect of contact law and summation method on one realisation of a surface.
#[derive(Debug)]
pub struct SurfaceInfluence {
    pub surface: String,
    /// From 1.
    pub realisation: usize,
    pub influence: Influence,
    /// Which of the two matters more: one per measure that allows a conclusion.
    pub dominances: Vec<Dominance>,
}
