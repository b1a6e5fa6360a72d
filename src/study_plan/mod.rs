//! What the kinds that study surfaces have in common in their specs: bodies under laws and layers, loads, surfaces and the statistical
//! model, resolved.

mod spots;

use std::fmt;
use std::ops::Range;

use asperity::compare::{Control, Controls, ModelKind, ModulusCheck, ModulusFindings, NotReached};
use asperity::distribution::{HeightModel, HeightsError};
use asperity::law::Body;
use asperity::study::{Film, JointModel, LawContact, Setup, StatisticalModel};
use asperity::{ContactError, ContactLaw, Flat, Material, MeanRadius, Paper};
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::schema::TYPE;
use asperity_contact_framework::input::{Forms, InputError, Spanned, SpecFile, heights};
use asperity_contact_framework::metadata::{Bodies, LayerMetadata};
use asperity_contact_framework::report::format::{input_quantity, quantity};
use asperity_contact_framework::{RunContext, written_schema};
use schemars::JsonSchema;
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer};
use serde_json::json;
use spots::SpottedBodies;
pub use spots::{Breakdowns, ConductanceSpec, ShearStrengthSpec, SpotKeys};

use crate::layer::{LayerPlan, LayerSpec, layer, thickness_words};
use crate::plausibility;
use crate::surface::{SurfacePlan, describe, surfaces};

/// The tables and keys of a spec that a study needs.
pub struct StudyKeys<'a> {
    /// Position of the table of the kind.
    pub table: Range<usize>,
    pub rough: &'a Spanned<RoughBody>,
    pub flat: &'a Spanned<String>,
    pub law: &'a Spanned<Laws>,
    pub layer: Option<&'a LayerSpec>,
    /// What is asked of the spots of the contact.
    pub spots: SpotKeys<'a>,
    pub statistical: Option<&'a Spanned<StatisticalSpec>>,
    /// The largest differences between the models that are accepted.
    pub accept: AcceptSpec,
    /// Names of the surfaces; all of the file where there are none.
    pub surfaces: Option<&'a [Spanned<String>]>,
    /// What the surfaces are pressed to.
    pub controls: Controls,
    /// The area that forces act on, m²; that of each surface where there is none.
    pub nominal_area: Option<f64>,
    /// Positions of pressures and forces, for errors about loads out of reach.
    pub load_keys: [Option<Range<usize>>; 2],
}

pub struct StudyPlan {
    pub bodies: Bodies,
    /// The rough body and the flat.
    pub pair: [Material; 2],
    pub layer: Option<Box<LayerPlan>>,
    /// How the layer shears; `None` where its friction is not asked for.
    pub film: Option<Film>,
    /// The laws, each under every thickness of the layer.
    pub laws: Vec<LawContact>,
    /// The laws alone.
    pub law_specs: Vec<ContactLaw>,
    /// The body that the layer is on, the flat where there is none, bare or with each thickness of the layer.
    pub flats: Vec<(Option<f64>, Flat)>,
    pub statistical: StatisticalModel,
    /// Its position in the spec, for surfaces that it does not apply to.
    pub statistical_key: Option<Range<usize>>,
    /// The largest differences between the models that are accepted.
    pub accept: AcceptSpec,
    /// What the surfaces are pressed to.
    pub controls: Controls,
    /// The area that forces act on, m², where the spec gives it: nominal pressures times this area are forces, too. `None`: forces
    /// act on the nominal area of each surface.
    pub nominal_area: Option<f64>,
    /// Positions of pressures and forces in the spec, for errors about loads out of reach.
    pub load_keys: [Option<Range<usize>>; 2],
    pub surfaces: Vec<SurfacePlan>,
    /// Warnings about materials, lengths, loads and separations that are hardly meant.
    pub implausible: Vec<String>,
}

impl StudyPlan {
    pub fn new(file: &SpecFile, keys: StudyKeys) -> Result<Self, InputError> {
        let (named, table) = (keys.surfaces, keys.table.clone());
        Self::on(file, keys, |as_ellipses| surfaces(file, named, table, as_ellipses))
    }

    /// Refuses surfaces whose asperities have no positions, of a study with sums; `models` is the key that asks for these, if there is one.
    pub fn check_summed(&self, file: &SpecFile, models: Option<Range<usize>>) -> Result<(), InputError> {
        let Some(composite) = self.surfaces.iter().find(|surface| surface.is_composite()) else {
            return Ok(());
        };
        let message = format!(
            "found the deterministic model on {}, the {}: their asperities have no positions at which they could be summed; allowed: \
             [compare] with models = [\"statistical\"], maps of both bodies, or their composite as a [surface.NAME.population]",
            composite.name,
            composite.describe()
        );
        Err(file.source.error_at(models.unwrap_or_else(|| composite.size_key.clone()), message))
    }

    /// The same on surfaces of the kind's own, made with ellipses or without.
    pub fn on(
        file: &SpecFile,
        keys: StudyKeys,
        surfaces: impl FnOnce(bool) -> Result<Vec<SurfacePlan>, InputError>,
    ) -> Result<Self, InputError> {
        let rough_name = &keys.rough.get_ref().0;
        let rough = file.body(rough_name, keys.rough.span())?;
        let flat_name = keys.flat.get_ref();
        let flat = file.body(flat_name, keys.flat.span())?;
        if keys.controls.points() == 0 {
            return Err(file.source.error_at(
                keys.table,
                "found no separation, pressure or force; allowed: at least one of separation, pressure, force",
            ));
        }
        // The rule and the laws do not tell the bodies apart: a layer on the rough body exchanges their roles.
        let (rough, flat) = ((rough_name.as_str(), rough), (flat_name.as_str(), flat));
        let (bare, coated) = match keys.layer.map(LayerSpec::body) {
            Some(Body::Rough) => (flat, rough),
            Some(Body::Flat) | None => (rough, flat),
        };
        let mut layer = keys.layer.map(|spec| layer(file, spec, &coated.1).map(Box::new)).transpose()?;
        if keys.layer.is_some_and(|spec| spec.thickness.stands_alone) {
            // One thickness is compared with none.
            layer.iter_mut().for_each(|layer| layer.add_uncoated());
        }
        let flats = match &layer {
            None => vec![(None, Flat::Bare(coated.1))],
            Some(layer) => {
                let on = |&t: &f64| layer.coating.flat(t).map(|flat| (Some(t), flat));
                let flats: Result<Vec<_>, _> = layer.thicknesses.iter().map(on).collect();
                flats.map_err(|error| InputError::file(&file.source.path, error))?
            }
        };
        let materials = coated_materials(layer.as_deref(), (coated.0, &coated.1));
        let bare = (bare.0, &bare.1);
        file.check_laws(keys.law, bare, &materials)?;
        let origins = file.origins();
        let is_given =
            |name: &str, key: &str| origins.get(name).is_none_or(|origin| origin.overridden.contains(&key));
        let mut implausible = plausibility::of_bodies(bare, &materials, is_given);
        let thicknesses = layer.iter().filter_map(|l| plausibility::of_thicknesses(&l.name, &l.thicknesses));
        implausible.extend(thicknesses);
        implausible.extend(plausibility::of_pressures(&keys.controls.pressures));
        implausible.extend(plausibility::of_separations(&keys.controls.separations));
        let law_specs = keys.law.get_ref().0.clone();
        let as_ellipses = law_specs.iter().any(ContactLaw::is_elliptic);
        let surfaces = surfaces(as_ellipses)?;
        let has_own_areas = keys.nominal_area.is_none() && !keys.controls.forces.is_empty();
        let without_area =
            |surface: &&SurfacePlan| surface.is_composite() || (surface.is_pair() && !surface.is_periodic());
        if let Some(pair) = surfaces.iter().find(without_area).filter(|_| has_own_areas) {
            let message = "found a `force` on a pair that has no nominal area: populations, or maps that do not repeat, whose overlap changes with the \
                           relative position; allowed: nominal-area = \"4 mm2\" beside it, or `pressure`";
            return Err(file.source.error_at(pair.size_key.clone(), message));
        }
        keys.spots.check_gap(file, &surfaces)?;
        let pixels = surfaces.iter().filter_map(|surface| Some((surface, surface.pixel()?)));
        implausible
            .extend(pixels.filter_map(|(surface, pixel)| plausibility::of_pixel(&surface.name, pixel)));
        let laws = file.law_plans(keys.law, bare, &flats, coated.0)?;
        let bodies =
            SpottedBodies { bare, coated: (coated.0, &coated.1), layer: layer.as_deref().zip(keys.layer) };
        let laws = keys.spots.add_to(file, bodies, laws)?;
        let mut plan = Self {
            bodies: Bodies { rough: rough_name.clone(), flat: flat_name.clone() },
            pair: [rough.1, flat.1],
            law_specs,
            laws,
            film: keys.spots.film(keys.layer),
            flats,
            layer,
            statistical: statistical_model(file, keys.statistical)?,
            statistical_key: keys.statistical.map(Spanned::span),
            accept: keys.accept,
            controls: keys.controls,
            nominal_area: keys.nominal_area,
            load_keys: keys.load_keys,
            surfaces,
            implausible,
        };
        plan.implausible.extend(own_area(&plan));
        Ok(plan)
    }

    /// What both models are run with.
    pub fn setup<'a>(&'a self, context: &RunContext<'a>) -> Setup<'a> {
        Setup {
            laws: &self.laws,
            law_specs: &self.law_specs,
            models: &[ModelKind::Statistical, ModelKind::Deterministic],
            statistical: &self.statistical,
            is_attributed: true,
            is_ranked: false,
            generates: true,
            controls: &self.controls,
            nominal_area: self.nominal_area,
            seed: context.seed,
            progress: context.progress,
        }
    }

    /// The body without the layer, and the one that has it or could have it: the rough one and the flat without a layer.
    pub fn bare_and_coated(&self) -> [&Material; 2] {
        let [rough, flat] = &self.pair;
        match self.layer.as_ref().map(|layer| layer.on) {
            Some(Body::Rough) => [flat, rough],
            Some(Body::Flat) | None => [rough, flat],
        }
    }

    /// Whether some contact is under a layer of finite thickness: of a listed one, or of one at which the layer begins to
    /// matter, which is looked for at given loads.
    pub fn uses_rule(&self, layer: &LayerPlan) -> bool {
        let has_loads = !(self.controls.pressures.is_empty() && self.controls.forces.is_empty());
        layer.thicknesses.iter().any(|&t| t > 0.0 && (t.is_finite() || has_loads))
    }

    /// An estimate of the asperities and nodes that are evaluated.
    pub fn work(&self) -> u128 {
        let all = |surface: &SurfacePlan| surface.most_asperities() * surface.realisations as u128;
        let asperities: u128 = self.surfaces.iter().map(all).sum();
        asperities * (self.controls.points() * self.laws.len()) as u128
    }

    /// The bodies with laws and layer, the points of `models`, the loads, the surfaces; a line each.
    pub fn describe(&self, models: &[ModelKind], f: &mut fmt::Formatter) -> fmt::Result {
        let laws: Vec<String> = self.law_specs.iter().map(ContactLaw::label).collect();
        writeln!(f, "  {} on {}, law {}", self.bodies.rough, self.bodies.flat, laws.join(", "))?;
        let each = match &self.layer {
            Some(layer) => {
                writeln!(f, "  layer: {layer}")?;
                "law, thickness and surface"
            }
            None => "law and surface",
        };
        let points = self.controls.points();
        let unit = if points == 1 { "point" } else { "points" };
        if !models.is_empty() {
            let models: Vec<&str> = models.iter().map(|model| model.name()).collect();
            writeln!(f, "  {} at {points} {unit} a {each}", models.join(" and "))?;
        }
        describe_loads(self, f)?;
        describe(&self.surfaces, f)
    }

    /// The warnings about bodies, separations and surfaces; a line each.
    pub fn warn(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let surfaces = self.surfaces.iter().flat_map(SurfacePlan::implausible);
        let mut warnings = self.implausible.iter().cloned().chain(surfaces);
        warnings.try_for_each(|warning| writeln!(f, "  warning: {warning}"))
    }
}

impl fmt::Display for StudyPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.describe(&[ModelKind::Statistical, ModelKind::Deterministic], f)?;
        self.warn(f)
    }
}

/// The materials of the coated body whose properties some law needs: zero thickness needs none of the layer, infinite thickness none of the
/// substrate.
fn coated_materials<'a>(
    layer: Option<&'a LayerPlan>,
    substrate: (&'a str, &'a Material),
) -> Vec<(&'a str, &'a Material)> {
    let coat = layer.filter(|layer| layer.thicknesses.iter().any(|&t| t > 0.0));
    let is_substrate_felt = layer.is_none_or(|layer| layer.thicknesses.iter().any(|t| t.is_finite()));
    let coat = coat.map(|layer| (layer.name.as_str(), &layer.coating.material));
    is_substrate_felt.then_some(substrate).into_iter().chain(coat).collect()
}

fn statistical_model(
    file: &SpecFile,
    spec: Option<&Spanned<StatisticalSpec>>,
) -> Result<StatisticalModel, InputError> {
    let Some(spec) = spec else { return Ok(StatisticalModel::default()) };
    spec.get_ref().model().map_err(|message| file.source.error_at(spec.span(), message))
}

/// `statistical` as a spec writes it: a height density and one radius, independent of each other, or a joint density of both.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StatisticalSpec {
    /// The height density.
    #[schemars(extend("x-default" = "gaussian, or that of the population", "examples" = ["own"]))]
    heights: Option<HeightModelSpec>,
    /// Which mean radius all asperities have.
    #[schemars(extend("default" = "arithmetic", "examples" = ["in-contact"]))]
    mean_radius: Option<MeanRadius>,
    /// A joint density of height and curvature, on surfaces with a map; instead of `heights` and `mean-radius`.
    #[schemars(extend("x-default" = "none", "examples" = ["nayak-greenwood"]))]
    model: Option<JointModel>,
}

impl StatisticalSpec {
    pub fn model(&self) -> Result<StatisticalModel, String> {
        if let Some(joint) = self.model
            && (self.heights.is_some() || self.mean_radius.is_some())
        {
            return Err(format!(
                "model = \"{}\" has its own heights and radii; leave out `heights` and `mean-radius`, or `model`",
                joint.name()
            ));
        }
        Ok(StatisticalModel {
            heights: self.heights.as_ref().map(|heights| heights.0.clone()),
            mean_radius: self.mean_radius.unwrap_or_default(),
            joint: self.model,
        })
    }
}

/// `heights` of the statistical model: a distribution, or how it follows from the set.
#[derive(Debug, Clone)]
struct HeightModelSpec(HeightModel);

asperity_contact_framework::written_schema!(HeightModelSpec, |_| heights::schema(
    &HeightModel::FITTED.map(|fitted| fitted.name())
));

impl<'de> Deserialize<'de> for HeightModelSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let fitted = HeightModel::FITTED.map(|fitted| (fitted.name(), fitted));
        heights::read_or(deserializer, &fitted, HeightModel::Given).map(Self)
    }
}

/// The name of one material: that of the other body is `flat`, also where it is rough.
#[derive(Debug, Clone)]
pub struct RoughBody(pub String);

written_schema!(RoughBody, |_| json!({ "type": "string", TYPE: "name of a material" }));

impl<'de> Deserialize<'de> for RoughBody {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new("the name of one material")
            .text(|name| Ok(Self(name.to_owned())))
            .list(|_: Vec<IgnoredAny>| {
                Err("found a list; allowed: one material, that of the rough body. For two rough bodies use \
                     [surface.NAME.pair], the sum of both height maps, with the second material as `flat`; or a population with the \
                     composite sigma and curvature"
                    .to_owned())
            })
            .read(deserializer)
    }
}

/// The layer, and the check of its rule where some contact is under it, whose sources are added to `papers`.
pub fn layer_metadata(
    context: &RunContext,
    plan: &StudyPlan,
    papers: &mut Vec<Paper>,
) -> Result<Option<LayerMetadata>, InputError> {
    let Some(layer) = &plan.layer else { return Ok(None) };
    let mut check = None;
    if plan.uses_rule(layer) {
        let (findings, rules) =
            rule_check(plan, layer).map_err(|error| InputError::file(&context.source.path, error))?;
        papers.extend(rules);
        check = Some(findings);
    }
    let thicknesses = layer.thicknesses.clone();
    Ok(Some(LayerMetadata { name: layer.name.clone(), rule: layer.rule, on: layer.on, thicknesses, check }))
}

/// How good both rules are between the materials of a study.
fn rule_check(plan: &StudyPlan, layer: &LayerPlan) -> Result<(ModulusFindings, Vec<Paper>), ContactError> {
    /// a/t, from and to.
    const RANGE: [f64; 2] = [0.1, 10.0];
    let [bare, substrate] = plan.bare_and_coated();
    let check = ModulusCheck::new(bare, &layer.coating.material, substrate)?;
    Ok((check.findings(RANGE[0], RANGE[1]), check.papers()))
}

/// A line for each load that is asked for, on each area that it acts on: the nominal area of the spec, or that of each surface.
fn describe_loads(plan: &StudyPlan, f: &mut fmt::Formatter) -> fmt::Result {
    let Controls { pressures, forces, .. } = &plan.controls;
    for (area, owner) in areas(plan) {
        for (values, is_force) in [(pressures, false), (forces, true)] {
            if values.is_empty() {
                continue;
            }
            let count = if values.len() > 1 { format!(", {} loads", values.len()) } else { String::new() };
            let unit = |is_force| if is_force { "N" } else { "Pa" };
            let asked_for = range(values, unit(is_force), input_quantity);
            match area {
                Some(area) => {
                    let factor = if is_force { area.recip() } else { area };
                    let other: Vec<f64> = values.iter().map(|value| value * factor).collect();
                    let other = range(&other, unit(!is_force), quantity);
                    let [force, pressure] = if is_force { [asked_for, other] } else { [other, asked_for] };
                    writeln!(f, "  load: {force} on {} ({owner}): {pressure}{count}", quantity(area, "m²"))?;
                }
                None => {
                    writeln!(f, "  load: {asked_for} on the area of {owner}, known once it is made{count}")?
                }
            }
        }
    }
    Ok(())
}

/// The caveat of a force that acts on a measured map's own area, which is seldom the area of the contact.
pub fn own_area(plan: &StudyPlan) -> Vec<String> {
    if plan.nominal_area.is_some() || plan.controls.forces.is_empty() {
        return Vec::new();
    }
    let measured = plan.surfaces.iter().filter(|surface| surface.is_measured());
    let caveat = |surface: &SurfacePlan| {
        let area = surface.nominal_area()?;
        let forces = &plan.controls.forces;
        let pressures: Vec<f64> = forces.iter().map(|force| force / area).collect();
        Some(format!(
            "surface {}: {} on the map's own {}: {}; if the force acts on another area, write it, as in `nominal-area = \"4 mm2\"`",
            surface.name,
            range(forces, "N", input_quantity),
            quantity(area, "m²"),
            range(&pressures, "Pa", quantity),
        ))
    };
    measured.filter_map(caveat).collect()
}

/// The areas that loads act on (m²; `None` where it is not known yet), and whose they are: each once.
fn areas(plan: &StudyPlan) -> Vec<(Option<f64>, String)> {
    /// More surfaces are counted.
    const NAMED: usize = 3;
    if plan.nominal_area.is_some() {
        return vec![(plan.nominal_area, "nominal-area".to_owned())];
    }
    let mut areas: Vec<(Option<f64>, Vec<&str>)> = Vec::new();
    for surface in &plan.surfaces {
        let area = surface.nominal_area();
        match areas.iter_mut().find(|(other, _)| *other == area) {
            Some((_, names)) => names.push(&surface.name),
            None => areas.push((area, vec![&surface.name])),
        }
    }
    let owner = |names: Vec<&str>| match &names[..] {
        [one] => format!("surface {one}"),
        few if few.len() <= NAMED => format!("each of the surfaces {}", few.join(", ")),
        many => format!("each of {} surfaces", many.len()),
    };
    areas.into_iter().map(|(area, names)| (area, owner(names))).collect()
}

/// "5 N", or "1 N to 5 N".
fn range(values: &[f64], unit: &str, written: fn(f64, &str) -> String) -> String {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if least == most {
        written(least, unit)
    } else {
        format!("{} to {}", written(least, unit), written(most, unit))
    }
}

/// Points at the statistical model that does not apply to a surface.
pub fn inapplicable(
    context: &RunContext,
    plan: &StudyPlan,
    surface: &str,
    error: &HeightsError,
) -> InputError {
    let message = format!("the statistical model does not apply to surface {surface}: {error}");
    match &plan.statistical_key {
        Some(span) => context.source.error_at(span.clone(), message),
        None => InputError::file(&context.source.path, message),
    }
}

/// Points at the sweep with a load out of reach.
pub fn unreachable_load(
    context: &RunContext,
    plan: &StudyPlan,
    surface: &str,
    law: &LawContact,
    error: &NotReached,
) -> InputError {
    let layer =
        law.thickness.map_or_else(String::new, |t| format!(", layer of thickness {}", thickness_words(t)));
    let message = format!("surface {surface}, law {}{layer}: {error}", law.label);
    if let Some(error) = implausible_error(context, plan, surface, &message) {
        return error;
    }
    let span = match error.control {
        Control::Pressure => plan.load_keys[0].clone(),
        Control::Force => plan.load_keys[1].clone(),
        Control::Separation => None,
    };
    match span {
        Some(span) => context.source.error_at(span, message),
        None => InputError::file(&context.source.path, message),
    }
}

/// Young's moduli below that of any solid body that is modelled as rough, Pa.
const SOFTEST: f64 = 1e6;

/// Hardnesses below that of any solid, Pa.
const LEAST_HARDNESS: f64 = 1e3;

/// The error at the property or the length that explains why a load is not reached on a surface, `message`; `None` if the
/// properties are those of solids and the surface is one that can be.
pub fn implausible_error(
    context: &RunContext,
    plan: &StudyPlan,
    surface: &str,
    message: &str,
) -> Option<InputError> {
    let of_surface = || {
        let planned = plan.surfaces.iter().find(|planned| planned.name == surface)?;
        planned.implausible_unit(context.source, message)
    };
    of_bodies(context, plan, message).or_else(of_surface)
}

fn of_bodies(context: &RunContext, plan: &StudyPlan, message: &str) -> Option<InputError> {
    let layer = plan.layer.as_ref().map(|layer| layer.name.as_str());
    let names = [Some(plan.bodies.rough.as_str()), Some(plan.bodies.flat.as_str()), layer];
    let properties =
        names.into_iter().flatten().filter_map(|name| Some((name, context.materials.get(name)?)));
    let mut implausible = properties.flat_map(|(name, material)| {
        let young = Some(material.young()).filter(|&young| young < SOFTEST);
        let hardness = material.hardness().filter(|&hardness| hardness < LEAST_HARDNESS);
        let found = [("young", "Young's modulus", "GPa", young), ("hardness", "hardness", "HV", hardness)];
        found.into_iter().filter_map(move |(key, word, unit, value)| Some((name, key, word, unit, value?)))
    });
    let (name, key, word, unit, value) = implausible.next()?;
    let (span, _) = context.source.value_at(&["material", name, key])?;
    Some(context.source.error_at(
        span,
        format!("found a {word} of {value:e} Pa, lower than that of any solid, so that a load is not reached; check the unit, as in {key} = \"210 {unit}\". {message}"),
    ))
}
