//! A sphere on layers: run, and its tables.

use std::collections::HashSet;
use std::f64::consts::PI;
use std::time::Instant;

use asperity::compare::{ModulusCheck, ModulusError, ModulusFindings, apart};
use asperity::layer::exact_sphere::{ElasticContact, LayeredSphere};
use asperity::sphere::{Curve, Decrease, Point, RegimeChange};
use asperity::work::{CountedContact, Counter, Item};
use asperity::{
    Contact, ContactError, Flat, Material, MicroContact, ModulusModel, Regime, Shape, literature,
    reduced_modulus,
};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{Metadata, Timing};
use asperity_contact_framework::report::format::input_quantity;
use asperity_contact_framework::report::table::{Column, Schema, Table};
use asperity_contact_framework::{RunContext, columns, rows};
use indexmap::IndexMap;
use rayon::prelude::*;

use super::{IndentationPlan, Show};
use crate::layer::LayerPlan;
use crate::presentation::SphereFigure;

/// A layer under a law; without one for the exact elastic contact.
#[derive(Clone, Copy)]
struct Case<'a> {
    layer: &'a LayerResults,
    law: Option<&'a LawCurves>,
}

/// The columns of the layer that a row belongs to.
fn layer_columns<R>(layer: impl Fn(&R) -> &LayerResults + Copy + 'static) -> Vec<Column<R>> {
    columns! { row: R =>
        layer["text"] = layer(row).name.as_str(), "Material of the layer.";
        layer_thickness_m["m", label("thickness"), thickness] = layer(row).thickness, "Thickness of the layer.";
        rule["text"] = layer(row).rule.name(), "Effective-modulus model of the layered flat: `gao` (Eqs. 14 and 15) or `series` (compliances in series).";
    }
}

/// The same and the law.
fn case_columns<R>(case: impl for<'r> Fn(&'r R) -> &'r Case<'r> + Copy + 'static) -> Vec<Column<R>> {
    let mut columns = layer_columns(move |row| case(row).layer);
    columns.extend(columns! { row: R => law["text"] = case(row).law.map_or("", |law| law.law.as_str()), "Contact law; empty for the exact elastic contact."; });
    columns
}

struct CurveRow<'a> {
    case: Case<'a>,
    curve: &'static str,
    indentation: f64,
    contact: Contact,
}

rows! { CurveRow<'_> => "indentation.csv", is_long true;
    "One row for each layer, law, curve and indentation.";
    ..case_columns(|row: &Self| &row.case);
    row =>
    curve["text"] = row.curve, "Curve: `coated`, `uncoated`, `all-layer` (a flat of the layer's material) or `exact-elastic`.";
    indentation_m["m"] = row.indentation, "Indentation w (Eq. 1).";
    load_n["N"] = row.contact.load, "Load P on the sphere.";
    area_m2["m²"] = row.contact.area, "Real contact area A.";
    contact_radius_m["m"] = (row.contact.area / PI).sqrt(), "Contact radius (A/pi)^0.5.";
    mean_pressure_pa["Pa"] = row.contact.load / row.contact.area, "Mean contact pressure P/A.";
    stiffness_n_per_m["N/m"] = row.contact.stiffness, "Contact stiffness dP/dw.";
    regime["text"] = row.case.law.map(|_| row.contact.regime.name()), "Regime: `elastic`, `elastic-plastic` or `plastic`; empty for the exact elastic contact.";
}

/// A change of the regime along a curve.
pub struct ChangeRow<'a> {
    case: Case<'a>,
    name: &'static str,
    curve: &'a Curve,
    change: &'a RegimeChange,
}

rows! { ChangeRow<'_> => "regimes.csv";
    "One row for each change of the regime along a curve, also beyond the sweep.";
    ..case_columns(|row: &Self| &row.case);
    row =>
    curve["text"] = row.name, "Curve: `coated`, `uncoated` or `all-layer` (a flat of the layer's material).";
    indentation_m["m"] = row.change.indentation, "Indentation w at which the regime changes (coated: Eqs. 2 and 4 with the effective properties at w).";
    load_n["N"] = row.change.load, "Load just below that indentation.";
    from["text"] = row.change.from.name(), "Regime below it.";
    to["text"] = row.change.to.name(), "Regime above it.";
    within_sweep["true/false"] = row.curve.is_within(row.change), "Whether it lies within the specified indentations.";
}

/// A range in which the coated area or load decreases.
pub struct DecreaseRow<'a> {
    case: Case<'a>,
    decrease: &'a Decrease,
}

rows! { DecreaseRow<'_> => "coated_decreases.csv";
    "One row for each range in which the area or load of a coated curve decreases with increasing indentation.";
    ..case_columns(|row: &Self| &row.case);
    row =>
    of["text", label("decreasing quantity")] = row.decrease.of.name(), "What decreases: `area` or `load`.";
    from_indentation_m["m"] = row.decrease.from.indentation, "First indentation of the range.";
    to_indentation_m["m"] = row.decrease.to.indentation, "Last indentation of the range.";
    from["SI"] = row.decrease.of.value(&row.decrease.from.contact), "Area in m² or load in N at the first indentation.";
    to["SI"] = row.decrease.of.value(&row.decrease.to.contact), "The same at the last.";
}

/// The end of the sweep under a law.
pub struct LawRow<'a> {
    case: Case<'a>,
    law: &'a LawCurves,
    overlay: &'a [(f64, f64)],
}

impl LawRow<'_> {
    /// Logarithms of the measured over the coated loads.
    fn logs(&self) -> impl Iterator<Item = f64> {
        let pairs = self.overlay.iter().zip(&self.law.at_overlay);
        pairs.map(|((_, measured), coated)| (measured / coated).ln())
    }
}

rows! { LawRow<'_> => "loads.csv";
    "One row for each layer and law: regimes, loads at the largest indentation, and measured loads.";
    ..case_columns(|row: &Self| &row.case);
    row =>
    regimes["text"] = row.law.coated.sequence().into_iter().map(|regime| regime.name().to_owned()).collect::<Vec<_>>(), "Regimes of the coated curve with increasing indentation, also beyond the sweep.";
    indentation_m["m", label("largest indentation"), input] = row.law.coated.points.last().map(|point| point.indentation), "Largest indentation of the sweep.";
    coated_load_n["N"] = last_load(&row.law.coated), "Load there.";
    uncoated_load_n["N"] = last_load(&row.law.uncoated), "The same without the layer.";
    all_layer_load_n["N", label("load on bulk layer material")] = last_load(&row.law.all_layer), "The same on a flat of the layer's material.";
    measured_over_coated["1"] = (!row.overlay.is_empty()).then(|| (row.logs().sum::<f64>() / row.overlay.len() as f64).exp()), "Geometric mean of measured over coated load; empty without measured points.";
    largest_measured_factor["1"] = row.logs().map(f64::abs).reduce(f64::max).map(f64::exp), "Largest factor, at least 1, between a measured and a coated load.";
}

/// An effective-modulus model and the exact elastic contact.
pub struct RuleRow<'a> {
    layer: &'a LayerResults,
    rule: ModulusModel,
    indentation: f64,
    error: &'a ModulusError,
}

rows! { RuleRow<'_> => "rule.csv";
    "One row for each layer, each effective-modulus model and each indentation at which the exact elastic contact is solved.";
    row =>
    layer["text"] = row.layer.name.as_str(), "Material of the layer.";
    layer_thickness_m["m"] = row.layer.thickness, "Thickness of the layer.";
    rule["text"] = row.rule.name(), "Effective-modulus model: `gao` (Eqs. 14 and 15) or `series` (compliances in series).";
    indentation_m["m"] = row.indentation, "Indentation w (Eq. 1).";
    contact_radius_over_thickness["1", label("a/t")] = row.error.contact_ratio, "Contact radius of the exact contact over the thickness of the layer.";
    load_over_exact["1"] = row.error.ratio, "Elastic load by the model over the exact one.";
    area_over_exact["1"] = row.error.indentation_ratio / row.error.contact_ratio.powi(2), "Area pi R w of both models over the exact one.";
}

/// A layer and the largest errors of both models.
pub struct LayerRow<'a> {
    layer: &'a LayerResults,
    radius: f64,
}

impl LayerRow<'_> {
    fn worst(&self, model: ModulusModel) -> Option<ModulusError> {
        self.layer.check.worst_of(model).copied()
    }
}

rows! { LayerRow<'_> => "layers.csv";
    "One row for each layer: the largest error of both effective-modulus models without yielding, at equal indentation.";
    ..layer_columns(|row: &Self| row.layer);
    row =>
    modulus_ratio["1", label("E_l/E_s")] = row.layer.check.modulus_ratio, "Young's modulus of the layer over that of the substrate.";
    is_modulus_ratio_good["true/false", label("accurate for gao")] = row.layer.check.is_good(), "Whether it is in the range 0.5 to 2 in which `gao` is accurate (Perriot and Barthel 2004).";
    gao_load_over_exact["1", label("gao / exact, worst")] = row.worst(ModulusModel::Gao).map(|error| error.ratio), "Load by `gao` over the exact one where its error is largest; empty where no contact is small enough for the exact solution.";
    gao_contact_radius_over_thickness["1", label("at a/t")] = row.worst(ModulusModel::Gao).map(|error| error.contact_ratio), "Contact radius over thickness there.";
    gao_indentation_ratio["1", label("w R/t²")] = row.worst(ModulusModel::Gao).map(|error| error.indentation_ratio), "Indentation times radius over the square of the thickness there.";
    series_load_over_exact["1", label("series / exact, worst")] = row.worst(ModulusModel::Series).map(|error| error.ratio), "Load by `series` over the exact one where its error is largest; empty where no contact is small enough for the exact solution.";
    series_contact_radius_over_thickness["1", label("at a/t")] = row.worst(ModulusModel::Series).map(|error| error.contact_ratio), "Contact radius over thickness there.";
    series_indentation_ratio["1", label("w R/t²")] = row.worst(ModulusModel::Series).map(|error| error.indentation_ratio), "Indentation times radius over the square of the thickness there.";
    largest_contact_radius_over_radius["1", label("largest a/R")] = row.layer.largest_slope(row.radius), "Largest contact radius over that of the ball; beyond 0.3 the ball is no paraboloid and strains are not small.";
    exact_points_left_out["count"] = row.layer.exact.iter().filter(|exact| exact.is_none()).count(), "Indentations whose exact contact is too wide for the layer to be solved.";
}

/// A measured point and the coated curve.
pub struct OverlayRow<'a> {
    case: Case<'a>,
    indentation: f64,
    measured_load: f64,
    coated_load: f64,
}

rows! { OverlayRow<'_> => "overlay.csv";
    "One row for each layer, law and measured point; written where `overlay` names a file of points.";
    ..case_columns(|row: &Self| &row.case);
    row =>
    indentation_m["m", input] = row.indentation, "Measured indentation.";
    measured_load_n["N"] = row.measured_load, "Measured load.";
    coated_load_n["N"] = row.coated_load, "Load of the coated curve at that indentation.";
    measured_over_coated["1"] = row.measured_load / row.coated_load, "Measured over computed load.";
}

fn last_load(curve: &Curve) -> Option<f64> {
    Some(curve.points.last()?.contact.load)
}

pub(super) fn schemas() -> Vec<Schema> {
    vec![
        Schema::of::<CurveRow>(),
        Schema::of::<ChangeRow>(),
        Schema::of::<RuleRow>(),
        Schema::of::<OverlayRow>(),
        Schema::of::<LawRow>(),
        Schema::of::<DecreaseRow>(),
        Schema::of::<LayerRow>(),
    ]
}

/// Those of [`schemas`] that have rows.
pub(super) fn tables(results: &IndentationResults) -> Vec<Table> {
    let IndentationResults { layers, overlay, radius, .. } = results;
    let laws = || layers.iter().flat_map(|layer| layer.laws.iter().map(move |law| (layer, law)));
    let case = |layer, law| Case { layer, law: Some(law) };
    let changes = laws().flat_map(|(layer, law)| {
        law.curves().into_iter().flat_map(move |(name, curve)| {
            curve.changes.iter().map(move |change| ChangeRow { case: case(layer, law), name, curve, change })
        })
    });
    let measured = laws().flat_map(|(layer, law)| {
        overlay.iter().zip(&law.at_overlay).map(move |(&(indentation, measured_load), &coated_load)| {
            OverlayRow { case: case(layer, law), indentation, measured_load, coated_load }
        })
    });
    let decreases = laws().flat_map(|(layer, law)| {
        law.coated.decreases.iter().map(move |decrease| DecreaseRow { case: case(layer, law), decrease })
    });
    let tables = [
        Table::new(layers.iter().flat_map(curves)),
        Table::new(changes),
        Table::new(rules(results)),
        Table::new(measured),
        Table::new(laws().map(|(layer, law)| LawRow { case: case(layer, law), law, overlay })),
        Table::new(decreases),
        Table::new(layers.iter().map(|layer| LayerRow { layer, radius: *radius })),
    ];
    tables.into_iter().filter(|table| table.rows() > 0).collect()
}

/// Each law's curves; then the exact one, without a law.
fn curves(layer: &LayerResults) -> impl Iterator<Item = CurveRow<'_>> {
    let of_laws = layer.laws.iter().flat_map(move |law| {
        law.curves().into_iter().flat_map(move |(curve, Curve { points, .. })| {
            let case = Case { layer, law: Some(law) };
            points.iter().map(move |&Point { indentation, contact }| CurveRow {
                case,
                curve,
                indentation,
                contact,
            })
        })
    });
    of_laws.chain(layer.exact.iter().flatten().map(move |exact| {
        let &ElasticContact { indentation, contact_radius, load, stiffness, .. } = exact;
        let area = PI * contact_radius.powi(2);
        let contact = Contact { area, load, stiffness, regime: Regime::Elastic };
        CurveRow { case: Case { layer, law: None }, curve: "exact-elastic", indentation, contact }
    }))
}

/// The exact contact is solved up to some indentation only.
fn rules(results: &IndentationResults) -> impl Iterator<Item = RuleRow<'_>> {
    results.distinct_layers().into_iter().flat_map(move |layer| {
        ModulusModel::ALL.into_iter().zip(&layer.errors).flat_map(move |(rule, errors)| {
            let solved = results.indentations.iter().zip(errors);
            solved.map(move |(&indentation, error)| RuleRow { layer, rule, indentation, error })
        })
    })
}

#[derive(Debug)]
pub struct IndentationResults {
    pub metadata: Metadata,
    pub materials: IndexMap<String, Material>,
    pub ball: String,
    /// Of the ball, m.
    pub radius: f64,
    pub flat: String,
    /// E* of the pair without a layer, Pa.
    pub reduced_modulus: f64,
    /// m, ascending.
    pub indentations: Vec<f64>,
    /// Axes of the load figure.
    pub show: Show,
    pub figure_of_paper: Option<SphereFigure>,
    /// Layer by layer, thickness by thickness.
    pub layers: Vec<LayerResults>,
    /// Measured indentations (m) and loads (N).
    pub overlay: Vec<(f64, f64)>,
}

#[derive(Debug)]
pub struct LayerResults {
    pub name: String,
    /// m.
    pub thickness: f64,
    pub rule: ModulusModel,
    pub laws: Vec<LawCurves>,
    /// The exact elastic contact at each indentation; `None` where it is too large to be solved.
    pub exact: Vec<Option<ElasticContact>>,
    /// Both effective-modulus models over the contacts of the sweep that are solved exactly.
    pub check: ModulusFindings,
    /// The errors of both at the specified indentations at which the exact contact is solved.
    pub errors: [Vec<ModulusError>; 2],
}

#[derive(Debug)]
pub struct LawCurves {
    /// The law, as tables name it.
    pub law: String,
    pub coated: Curve,
    pub uncoated: Curve,
    /// The flat all of the layer's material.
    pub all_layer: Curve,
    /// Coated loads at the indentations of the measured points, N.
    pub at_overlay: Vec<f64>,
}

impl LawCurves {
    /// The curves and their names in tables.
    pub fn curves(&self) -> [(&'static str, &Curve); 3] {
        [("coated", &self.coated), ("uncoated", &self.uncoated), ("all-layer", &self.all_layer)]
    }
}

impl IndentationResults {
    /// Layers of different material or thickness: the errors of both models are the same whichever of them the spec chose.
    pub fn distinct_layers(&self) -> Vec<&LayerResults> {
        let mut seen = HashSet::new();
        let is_new = |layer: &&LayerResults| seen.insert((layer.name.clone(), layer.thickness.to_bits()));
        self.layers.iter().filter(is_new).collect()
    }
}

impl LayerResults {
    /// a/R at the last indentation: the largest of all curves.
    pub fn largest_slope(&self, radius: f64) -> f64 {
        let last = |law: &LawCurves| law.coated.points.last().map(|point| point.contact.area);
        let areas = self.laws.iter().filter_map(last).map(|area| (area / std::f64::consts::PI).sqrt());
        let exact = self.exact.last().copied().flatten().map(|contact| contact.contact_radius);
        areas.chain(exact).fold(0.0, f64::max) / radius
    }

    pub fn label(&self) -> String {
        format!("{} {}", self.name, input_quantity(self.thickness, "m"))
    }
}

pub(super) fn run(context: &RunContext, plan: &IndentationPlan) -> Result<IndentationResults, InputError> {
    let start = Instant::now();
    context.progress.stage("layers", plan.cases() as f64);
    let counter = Counter::default();
    counter.add(Item::Files, plan.overlay.iter().len());
    let mut papers = vec![literature::PASARIBU_SCHIPPER_2005];
    let mut layers = || {
        let uncoated = computed(plan, &contacts(plan, &Flat::Bare(plan.flat.1))?, &counter);
        let mut layers = Vec::new();
        for layer in &plan.layers {
            let all_layer = Flat::AllLayer { substrate: plan.flat.1, layer: layer.coating.material };
            let all_layer = computed(plan, &contacts(plan, &all_layer)?, &counter);
            let check = ModulusCheck::new(&plan.ball.1, &layer.coating.material, &plan.flat.1)?;
            papers.extend(check.papers());
            for &thickness in &layer.thicknesses {
                let coated = contacts(plan, &layer.coating.flat(thickness)?)?;
                papers.extend(coated.iter().flat_map(|contact| contact.papers()));
                let laws = laws(plan, &coated, [&uncoated, &all_layer], &counter);
                layers.push(layer_results(plan, layer, thickness, laws, &check));
                context.progress.advance(1.0);
            }
        }
        Ok(layers)
    };
    let layers = layers().map_err(|error: ContactError| InputError::file(&context.source.path, error))?;
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    Ok(IndentationResults {
        metadata: context.metadata(papers, timing, Some(counter.work())),
        materials: context.materials.clone(),
        ball: plan.ball.0.clone(),
        radius: plan.radius,
        flat: plan.flat.0.clone(),
        reduced_modulus: reduced_modulus(&plan.ball.1, &plan.flat.1),
        indentations: plan.indentations.clone(),
        show: plan.show,
        figure_of_paper: plan.figure_of_paper,
        layers,
        overlay: plan.overlay.iter().flat_map(|overlay| overlay.points.clone()).collect(),
    })
}

/// The ball on a flat, law by law.
fn contacts(plan: &IndentationPlan, flat: &Flat) -> Result<Vec<Box<dyn MicroContact>>, ContactError> {
    plan.laws.iter().map(|law| Ok(law.interface(&plan.ball.1, flat)?)).collect()
}

fn computed(plan: &IndentationPlan, contacts: &[Box<dyn MicroContact>], counter: &Counter) -> Vec<Curve> {
    let counted = contacts.iter().map(|contact| CountedContact::new(&**contact, counter));
    counted.map(|contact| Curve::new(&contact, Shape::sphere(plan.radius), &plan.indentations)).collect()
}

fn laws(
    plan: &IndentationPlan,
    coated: &[Box<dyn MicroContact>],
    [uncoated, all_layer]: [&[Curve]; 2],
    counter: &Counter,
) -> Vec<LawCurves> {
    let curves = computed(plan, coated, counter);
    let law = |(k, curve): (usize, Curve)| {
        let contact = CountedContact::new(&*coated[k], counter);
        let measured = plan.overlay.iter().flat_map(|overlay| &overlay.points);
        LawCurves {
            law: plan.laws[k].label(),
            coated: curve,
            uncoated: uncoated[k].clone(),
            all_layer: all_layer[k].clone(),
            at_overlay: measured.map(|&(w, _)| contact.contact(w, Shape::sphere(plan.radius)).load).collect(),
        }
    };
    curves.into_iter().enumerate().map(law).collect()
}

fn layer_results(
    plan: &IndentationPlan,
    layer: &LayerPlan,
    thickness: f64,
    laws: Vec<LawCurves>,
    check: &ModulusCheck,
) -> LayerResults {
    let LayerPlan { name, rule, coating, .. } = layer;
    let sphere =
        LayeredSphere::new(Some(&plan.ball.1), plan.radius, &coating.material, &plan.flat.1, thickness);
    let exact = |&w: &f64| Some(ElasticContact { indentation: w, ..sphere.at_indentation(w)? });
    let exact: Vec<Option<ElasticContact>> = plan.indentations.par_iter().map(exact).collect();
    let errors = exact.iter().flatten().map(|contact| check.beside(contact, plan.radius, thickness));
    let errors = apart(errors);
    let [from, to] = match &errors[0][..] {
        [first, .., last] => [first.contact_ratio, last.contact_ratio],
        [only] => [only.contact_ratio; 2],
        [] => [f64::NAN; 2],
    };
    let check = check.findings(from, to);
    LayerResults { name: name.clone(), thickness, rule: *rule, laws, exact, check, errors }
}
