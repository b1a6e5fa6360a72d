//! The tables of both models that several kinds have: `curves.csv` and `comparison.csv`.

use asperity::compare::{
    Attribution, Cause, ComparedQuantity, Comparison, CurvePoint, ModelKind, Pair, ReferencePoint,
};
use asperity::spot::{SpotProperties, SpotQuantity, tube_factor};
use asperity::study::CaseResults;
use asperity::{ByRegime, Exceeded, Limit, Response};
use asperity_contact_framework::report::table::{Column, Heading, Row, Table, Value};
use asperity_contact_framework::{columns, rows};

#[derive(Debug, Clone)]
pub(crate) struct RowCase {
    surface: String,
    realisation: usize,
    law: String,
    thickness: Option<f64>,
}

impl RowCase {
    pub(crate) fn bare(surface: &str, realisation: usize, law: &str) -> Self {
        Self { surface: surface.to_owned(), realisation, law: law.to_owned(), thickness: None }
    }

    /// Of a law under a layer of a thickness (m), if there is one.
    pub(crate) fn layered(surface: &str, law: &str, thickness: Option<f64>) -> Self {
        Self { thickness, ..Self::bare(surface, 1, law) }
    }

    pub(crate) fn from_results(surface: &str, realisation: usize, case: &CaseResults) -> Self {
        Self { thickness: case.thickness, ..Self::bare(surface, realisation, &case.law) }
    }

    /// The columns of the case that a row belongs to.
    pub(crate) fn columns<R>(case: impl Fn(&R) -> &Self + Copy + 'static) -> Vec<Column<R>> {
        columns! { row: R =>
            surface["text"] = case(row).surface.as_str(), "Name of the surface; in `[limit]` the set of asperities, `random-N` or `quantiles-N`, or `population` for the integral.";
            realisation["count"] = case(row).realisation, "Number of the realisation of the surface, from 1; a given or measured surface has one.";
            law["text"] = case(row).law.as_str(), "Contact law of an asperity.";
            layer_thickness_m["m", label("layer"), thickness] = case(row).thickness, "Thickness of the layer, 0 for the bare substrate and inf for the bulk of the layer's material; empty where the spec has no layer.";
        }
    }
}

/// A point of the curve of a model or of the reference.
pub struct CurveRow {
    pub(crate) case: RowCase,
    pub(crate) point: AnyPoint,
    /// E* of the pair without a layer, Pa.
    pub(crate) reduced_modulus: f64,
}

pub(crate) enum AnyPoint {
    /// Of a model, with the limits that one of the models exceeds there.
    Model(CurvePoint, Exceeded),
    Reference(ReferencePoint),
}

rows! { CurveRow => "curves.csv", is_long true;
    "One row for each surface, realisation, law, layer thickness, model and control point.";
    ..RowCase::columns(|row: &Self| &row.case);
    row =>
    model["text"] = row.either(|point| point.kind.name(), |_| REFERENCE), "Model: `statistical` (integral over the height density), `deterministic` (sum over the asperities, Eq. 13) or `reference` (boundary elements on the same map; columns about asperities are empty).";
    control["text"] = row.either(|point| point.control, |point| point.control).name(), "Quantity that is prescribed: `separation`, `pressure` or `force`; for the reference the loads of a separation sweep are pressures.";
    target["1, Pa or N"] = row.either(|point| point.target, |point| point.target), "Prescribed value: separation over sigma, nominal pressure or force on the nominal area.";
    separation_m["m"] = row.either(|point| Some(point.response.separation), |point| point.separation), "Separation d of the flat from the mean asperity height; for the reference the mean gap, zero at points in contact, less the height of the mean asperity above the mean plane of the map, and empty with a finite boundary; of a map without summits of different heights the mean gap.";
    separation_over_sigma["1"] = row.either(|point| Some(point.response.separation_over_sigma), |point| point.separation_over_sigma), "Separation over sigma, the standard deviation of the asperity heights.";
    pressure_pa["Pa", prefix("M")] = row.pressure(), "Nominal pressure, load over nominal area; above the target where the law jumps past it.";
    load_ratio["1"] = row.pressure() / row.reduced_modulus, "Nominal pressure over E* (Eq. 3) of the pair without a layer.";
    area_ratio["1"] = row.either(|point| point.response.area_ratio.total(), |point| point.area_ratio), "Real contact area over nominal area, never clamped; for the reference corrected for the perimeter of the contacts, but for maps without summits of different heights, where it is `raw_area_ratio`.";
    contact_density_per_m2["1/m²"] = row.model(|response| response.contact_density), "Contacts per nominal area.";
    mean_real_pressure_pa["Pa", prefix("M")] = row.either(|point| point.response.mean_real_pressure(), ReferencePoint::mean_real_pressure), "Load over real contact area; empty where there is no contact.";
    stiffness_pa_per_m["Pa/m"] = row.either(|point| Some(point.response.stiffness), |point| point.stiffness), "Contact stiffness -dp/dd per nominal area; jumps of a law are excluded for the sum and included for the integral; for the reference of the points in contact below the cap, held fixed; empty with a finite boundary and where there are none.";
    electrical_conductance_s_per_m2["S/m²", part(ELECTRICAL), prefix("M")] = row.of_spots(ComparedQuantity::ElectricalConductance), "Electrical conductance per nominal area: of a sum or integral 2 a/s of each spot without interaction, of the reference the current through all points in contact; there only where it is asked for.";
    thermal_conductance_w_per_m2_k["W/(m² K)", part(THERMAL), prefix("k")] = row.of_spots(ComparedQuantity::ThermalConductance), "Thermal conductance per nominal area, likewise.";
    tube_factor["1", part(CONDUCTION)] = row.model(|response| tube_factor(response.area_ratio.total())), "Factor of the constriction resistance of the spots by their neighbours on an interface without end, (1 - (A/A_nom)^0.5)^1.5 (Cooper, Mikic and Yovanovich 1969): the conductance of a model over it counts them; empty for the reference, which does.";
    tangential_stiffness_pa_per_m["Pa/m", part(FRICTION)] = row.model_value(|response| Some(response.spots[SpotQuantity::TangentialStiffness as usize]).filter(|stiffness| *stiffness > 0.0)), "Tangential stiffness per nominal area while no spot slips, 8 G* a of each (Mindlin 1949); empty for the reference and under a layer of finite thickness.";
    friction["1", part(FRICTION)] = row.of_spots(ComparedQuantity::Friction), "Coefficient of boundary friction: shear forces of all spots over the load; there only where it is asked for.";
    elastic_load_share["1", label("elastic"), percent] = row.model_value(|response| share(&response.pressure, 0)), "Share of the load in elastic contacts; empty where there is no contact.";
    elastic_plastic_load_share["1", label("elastic-plastic"), percent] = row.model_value(|response| share(&response.pressure, 1)), "Share of the load in elastic-plastic contacts.";
    plastic_load_share["1", label("plastic"), percent] = row.model_value(|response| share(&response.pressure, 2)), "Share of the load in plastic contacts.";
    elastic_area_share["1"] = row.model_value(|response| share(&response.area_ratio, 0)), "Share of the real contact area in elastic contacts; empty where there is no contact.";
    elastic_plastic_area_share["1"] = row.model_value(|response| share(&response.area_ratio, 1)), "Share of the real contact area in elastic-plastic contacts.";
    plastic_area_share["1"] = row.model_value(|response| share(&response.area_ratio, 2)), "Share of the real contact area in plastic contacts.";
    pressure_standard_error_pa["Pa"] = row.model_value(|response| Some(response.sampling?.pressure)), "Standard error of the nominal pressure of the sum at fixed separation, for independent asperities; empty for the integral.";
    area_ratio_standard_error["1"] = row.model_value(|response| Some(response.sampling?.area_ratio)), "Standard error of the area ratio of the sum, likewise.";
    beyond_model["true/false"] = row.model(Response::is_beyond_model), "Whether the area ratio exceeds 0.05, where neighbouring asperities interact and no asperity model holds; empty for the reference.";
    effective_contacts["1"] = row.model_value(|response| Some(response.sharing?.effective_contacts)), "Effective contacts of the sum: 1 over the sum of squared load shares; empty for the integral and without contact.";
    largest_load_share["1"] = row.model_value(|response| Some(response.sharing?.largest_share)), "Share of the load in the most heavily loaded contact of the sum.";
    large_strain_load_share["1"] = row.model_value(|response| Some(response.sharing?.large_strain_share)), "Share of the load of the sum in contacts whose radius exceeds 0.3 of the asperity radius.";
    limits["text"] = limits(row.exceeded()), "Limits of admissible loads that one of the models exceeds at this control point, separated by spaces: `few-contacts` (fewer than 30 effective), `dominant-contact` (more than 10 % of the load in one), `interaction` (area ratio above 0.05), `large-strain` (more than 10 % of the load in contacts whose radius exceeds 0.3 of the asperity radius); empty admissible, and for the reference.";
    contact_radius_over_thickness["1", label("a/t")] = row.radius_over_thickness(), "Mean contact radius over the thickness of the layer; empty without a layer of finite thickness and without contact.";
    raw_area_ratio["1"] = row.either(|_| None, |point| Some(point.raw_area_ratio)), "Points in contact over all points of the reference; empty for the models.";
}

/// The name of the reference in tables.
pub(crate) const REFERENCE: &str = "reference";

impl CurveRow {
    /// The points of both models' curves in a comparison under a law, with E* of the pair without a layer (Pa).
    pub fn from_comparison(law: &str, comparison: &Comparison, reduced_modulus: f64) -> Vec<Self> {
        Self::of_case(&RowCase::bare("", 1, law), comparison, reduced_modulus)
    }

    pub(crate) fn of_case(case: &RowCase, comparison: &Comparison, reduced_modulus: f64) -> Vec<Self> {
        let row = |point| Self { case: case.clone(), point, reduced_modulus };
        of_models(comparison).map(row).collect()
    }

    /// A response of a model at its own separation.
    pub(crate) fn at_separation(
        case: RowCase,
        kind: ModelKind,
        response: Response,
        reduced_modulus: f64,
    ) -> Self {
        let point = AnyPoint::Model(CurvePoint::at_separation(kind, response), response.exceeded());
        Self { case, point, reduced_modulus }
    }

    fn either<T>(&self, of_model: fn(&CurvePoint) -> T, of_reference: fn(&ReferencePoint) -> T) -> T {
        match &self.point {
            AnyPoint::Model(point, _) => of_model(point),
            AnyPoint::Reference(point) => of_reference(point),
        }
    }

    fn pressure(&self) -> f64 {
        self.either(|point| point.response.pressure.total(), |point| point.pressure)
    }

    /// A value of a model; `None` for the reference.
    fn model<T>(&self, of: fn(&Response) -> T) -> Option<T> {
        match &self.point {
            AnyPoint::Model(point, _) => Some(of(&point.response)),
            AnyPoint::Reference(_) => None,
        }
    }

    /// A value that a model may lack; `None` for the reference.
    fn model_value(&self, of: fn(&Response) -> Option<f64>) -> Option<f64> {
        self.model(of).flatten()
    }

    fn radius_over_thickness(&self) -> Option<f64> {
        let thickness = self.case.thickness.filter(|t| *t > 0.0 && t.is_finite())?;
        Some(self.model_value(Response::mean_contact_radius)? / thickness)
    }

    /// A quantity that follows from the spots of the contact.
    fn of_spots(&self, quantity: ComparedQuantity) -> Option<f64> {
        match &self.point {
            AnyPoint::Model(point, _) => quantity.value(&point.response),
            AnyPoint::Reference(point) => point.value(quantity),
        }
    }

    /// The limits of the models; the reference has none.
    fn exceeded(&self) -> Exceeded {
        match &self.point {
            AnyPoint::Model(_, exceeded) => *exceeded,
            AnyPoint::Reference(_) => Exceeded::default(),
        }
    }
}

/// Names of limits, separated by spaces.
pub(crate) fn limits(exceeded: Exceeded) -> String {
    exceeded.limits().map(Limit::name).collect::<Vec<_>>().join(" ")
}

/// The share of one of [`Regime::ALL`](asperity::Regime::ALL).
fn share(of: &ByRegime, regime: usize) -> Option<f64> {
    of.shares().map(|shares| shares[regime])
}

/// Both models at equal load or at equal separation.
pub(crate) struct PairRow {
    pub(crate) case: RowCase,
    pub(crate) pair: Pair,
    /// Nominal area, m^2.
    pub(crate) nominal_area: f64,
    pub(crate) plasticity_index: Option<f64>,
    /// The difference at the load of the pair divided among its causes.
    pub(crate) attribution: Option<Attribution>,
    /// The reference at the load of the pair.
    pub(crate) reference: Option<ReferencePoint>,
}

/// Result of one model of a pair.
struct ModelValues {
    model: ModelKind,
    response: Response,
    /// Nominal area, m^2.
    nominal_area: f64,
}

impl ModelValues {
    /// What the models are compared in; each of these becomes a column per model and one of their difference.
    fn columns() -> Vec<Column<Self>> {
        columns! { answer: Self =>
            separation_over_sigma["1"] = answer.response.separation_over_sigma, "separation from the mean asperity height over sigma, the standard deviation of the asperity heights.";
            area_ratio["1"] = answer.response.area_ratio.total(), "real contact area over nominal area.";
            contact_density_per_m2["1/m²"] = answer.response.contact_density, "contacts per nominal area.";
            mean_real_pressure_pa["Pa", prefix("M")] = answer.response.mean_real_pressure(), "load over real contact area; empty where there is no contact.";
            pressure_pa["Pa", prefix("M")] = answer.response.pressure.total(), "nominal pressure, load over nominal area.";
            stiffness_pa_per_m["Pa/m"] = answer.response.stiffness, "contact stiffness -dp/dd per nominal area.";
            electrical_conductance_s_per_m2["S/m²", part(ELECTRICAL), prefix("M")] = ComparedQuantity::ElectricalConductance.value(&answer.response), "electrical conductance per nominal area, of spots without interaction.";
            thermal_conductance_w_per_m2_k["W/(m² K)", part(THERMAL), prefix("k")] = ComparedQuantity::ThermalConductance.value(&answer.response), "thermal conductance per nominal area, of spots without interaction.";
            friction["1", part(FRICTION)] = ComparedQuantity::Friction.value(&answer.response), "coefficient of boundary friction.";
            contacts["1"] = answer.contacts(), "number of contacts on the nominal area.";
        }
    }

    /// Contacts on the nominal area. The sum's are a count: the rounding of the density goes.
    fn contacts(&self) -> f64 {
        let contacts = self.response.contact_density * self.nominal_area;
        match self.model {
            ModelKind::Statistical => contacts,
            ModelKind::Deterministic => contacts.round(),
        }
    }
}

impl PairRow {
    /// Of both models, without causes and reference.
    pub(crate) fn of_models(
        case: RowCase,
        pair: Pair,
        nominal_area: f64,
        plasticity_index: Option<f64>,
    ) -> Self {
        Self { case, pair, nominal_area, plasticity_index, attribution: None, reference: None }
    }

    fn reference(&self, of: fn(&ReferencePoint) -> Option<f64>) -> Option<f64> {
        self.reference.as_ref().and_then(of)
    }

    fn contribution(&self, quantity: ComparedQuantity, cause: Cause) -> Option<f64> {
        Some(self.attribution.as_ref()?.contributions(quantity)?.part(cause))
    }

    /// A contrast of the deterministic model over the reference.
    fn missed(&self, of: fn(&Response, &ReferencePoint) -> Option<f64>) -> Option<f64> {
        of(&self.pair.deterministic, self.reference.as_ref()?)
    }

    fn answer(&self, model: ModelKind) -> ModelValues {
        let response = match model {
            ModelKind::Statistical => self.pair.statistical,
            ModelKind::Deterministic => self.pair.deterministic,
        };
        ModelValues { model, response, nominal_area: self.nominal_area }
    }

    fn by(&self, model: ModelKind, quantity: &Column<ModelValues>) -> Value {
        quantity.value(&self.answer(model))
    }

    /// A quantity by the statistical model minus that by the deterministic model.
    fn difference(&self, quantity: &Column<ModelValues>) -> Value {
        let [statistical, deterministic] =
            [ModelKind::Statistical, ModelKind::Deterministic].map(|model| self.by(model, quantity).number());
        statistical.zip(deterministic).map(|(statistical, deterministic)| statistical - deterministic).into()
    }

    /// The columns `statistical_X`, `deterministic_X` and `difference_X` of a quantity X.
    fn compared(quantity: &Column<ModelValues>) -> [Column<Self>; 3] {
        let column = |prefix, title, value: fn(&Self, &Column<ModelValues>) -> Value| {
            let Heading { name, unit, meaning, part, .. } = &quantity.heading;
            let quantity = quantity.clone();
            let value = move |row: &Self| value(row, &quantity);
            let column = Column::new(format!("{prefix}_{name}"), unit, format!("{title}: {meaning}"), value);
            match part {
                Some(part) => column.part(part),
                None => column,
            }
        };
        [
            column("statistical", "Statistical model", |row, x| row.by(ModelKind::Statistical, x)),
            column("deterministic", "Deterministic model", |row, x| row.by(ModelKind::Deterministic, x)),
            column("difference", "Statistical minus deterministic", Self::difference)
                .scale_of(format!("statistical_{}", quantity.heading.name)),
        ]
    }
}

impl Row for PairRow {
    const FILE: &'static str = "comparison.csv";
    const ROWS: &'static str = "One row for each surface, realisation, law, layer thickness and pair of results; a separation sweep also gives pairs at the loads of the deterministic model.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        let mut columns = RowCase::columns(|row: &Self| &row.case);
        columns.extend(columns! { row: Self =>
            pairing["text"] = row.pair.pairing.name(), "What the models have in common: `load` or `separation`.";
            target["Pa or 1"] = row.pair.target, "Its value: nominal pressure, or separation over sigma.";
        });
        columns.extend(ModelValues::columns().iter().flat_map(Self::compared));
        columns.extend(columns! { row: Self =>
            plasticity_index["1"] = row.plasticity_index, "Plasticity index (E*/H)(sigma/R)^0.5 of Greenwood and Williamson (1966); empty where nothing yields.";
            beyond_model["true/false"] = row.pair.is_beyond_model(), "Whether either area ratio exceeds 0.05, where neighbouring asperities interact and no asperity model holds.";
            limits["text"] = limits(row.pair.exceeded()), "Limits of admissible loads that one of the models exceeds, as in `curves.csv`.";
            separation_from_heights["1", part(CAUSES)] = row.contribution(ComparedQuantity::Separation, Cause::Heights), "Contribution of the height distribution to the difference in separation over sigma at equal load: the mean over three orders in which heights, radii and their correlation are changed from those of the statistical to those of the deterministic model. The three contributions add up to the difference. Empty where fewer than 30 effective contacts or one with more than 10 % of the load carry it, and at equal separation.";
            separation_from_radii["1", part(CAUSES)] = row.contribution(ComparedQuantity::Separation, Cause::Radii), "The same of the spread of radii.";
            separation_from_correlation["1", part(CAUSES)] = row.contribution(ComparedQuantity::Separation, Cause::Correlation), "The same of the correlation of heights and radii; with equal radii, of replacing a sum by its integral.";
            log_area_from_heights["1", part(CAUSES)] = row.contribution(ComparedQuantity::Area, Cause::Heights), "Contribution of the height distribution to ln(statistical/deterministic) of the real contact area.";
            log_area_from_radii["1", part(CAUSES)] = row.contribution(ComparedQuantity::Area, Cause::Radii), "The same of the spread of radii.";
            log_area_from_correlation["1", part(CAUSES)] = row.contribution(ComparedQuantity::Area, Cause::Correlation), "The same of the correlation of heights and radii.";
            reference_separation_over_sigma["1", part(REFERENCE)] = row.reference(|point| point.separation_over_sigma), "Reference: separation as in `curves.csv`; this and the next columns are there only where a reference was run, and empty at loads without it.";
            reference_area_ratio["1", part(REFERENCE)] = row.reference(|point| Some(point.area_ratio)), "Reference: real contact area over nominal area, corrected for the perimeter of the contacts.";
            reference_mean_real_pressure_pa["Pa", prefix("M"), part(REFERENCE)] = row.reference(ReferencePoint::mean_real_pressure), "Reference: load over real contact area.";
            reference_pressure_pa["Pa", prefix("M"), part(REFERENCE)] = row.reference(|point| Some(point.pressure)), "Reference: nominal pressure.";
            reference_stiffness_pa_per_m["Pa/m", part(REFERENCE)] = row.reference(|point| point.stiffness), "Reference: contact stiffness -dp/dd per nominal area, of the points in contact below the cap, held fixed.";
            separation_from_interaction["1", part(REFERENCE)] = row.missed(|deterministic, point| Some(deterministic.separation_over_sigma - point.separation_over_sigma?)), "Deterministic model minus reference: what the sum leaves out, in separation over sigma. Interaction of the asperities and their shape; where a law yields or under a layer, the difference between that law and the reference, too.";
            log_area_from_interaction["1", part(REFERENCE)] = row.missed(|deterministic, point| Some((deterministic.area_ratio.total() / point.area_ratio).ln()).filter(|log| log.is_finite())), "The same of the real contact area: ln(deterministic/reference).";
        });
        columns
    }
}

/// The columns about causes, and those about the reference, which a table holds where these were run.
pub(crate) const CAUSES: &str = "causes";

/// The columns of conductances, of each of them, and of friction, which a table holds where they are asked for.
pub(crate) const CONDUCTION: &str = "conduction";
pub(crate) const ELECTRICAL: &str = "electrical";
pub(crate) const THERMAL: &str = "thermal";
pub(crate) const FRICTION: &str = "friction";

/// A table without the columns of what is not asked of spots.
pub(crate) fn of_asked_spots(table: Table, asked: &SpotProperties) -> Table {
    let SpotProperties { electrical, thermal, shear, .. } = asked;
    let parts = [
        (CONDUCTION, asked.conducts()),
        (ELECTRICAL, electrical.is_some()),
        (THERMAL, thermal.is_some()),
        (FRICTION, shear.is_some()),
    ];
    let left_out = parts.into_iter().filter(|(_, is_asked)| !is_asked);
    left_out.fold(table, |table, (part, _)| table.without_part(part))
}

/// The points of both models' curves.
pub(crate) fn of_models(comparison: &Comparison) -> impl Iterator<Item = AnyPoint> {
    let points = comparison.curves.iter().copied().zip(comparison.exceeded());
    points.map(|(point, exceeded)| AnyPoint::Model(point, exceeded))
}

/// `curves.csv` of models of whose spots nothing is asked.
pub(crate) fn curves_of_models(rows: impl IntoIterator<Item = CurveRow>) -> Table {
    of_asked_spots(Table::new(rows), &SpotProperties::default())
}

/// `comparison.csv` of both models, without causes and reference.
pub(crate) fn comparison_of_models(rows: impl IntoIterator<Item = PairRow>) -> Table {
    let table = Table::new(rows).without_part(CAUSES).without_part(REFERENCE);
    of_asked_spots(table, &SpotProperties::default())
}
