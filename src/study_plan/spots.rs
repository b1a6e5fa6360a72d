//! `conductance` and `shear-strength` in a spec: what is asked of the spots of a contact.

use std::ops::Range;

use asperity::spot::{
    Conduction, ConductionError, GapMedium, Shear, ShearStrength, SpotProperties, Tangential,
};
use asperity::study::{Film, LawContact};
use asperity::{Material, WithSpots};
use asperity_contact_framework::input::bare::{
    ElectricalFilmRange, GapConductivityRange, GapJumpRange, ThermalFilmRange,
};
use asperity_contact_framework::input::material::{RESISTIVITY, THERMAL_CONDUCTIVITY};
use asperity_contact_framework::input::quantity::{
    ElectricalFilm, Length, NotNegative, Positive, Pressure, Pure, Quantity, ThermalConductivity, ThermalFilm,
};
use asperity_contact_framework::input::{Forms, InputError, OneOrMany, Spanned, SpecFile, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use crate::layer::{LayerPlan, LayerSpec};
use crate::surface::SurfacePlan;

/// `conductance = "thermal"`, `["electrical", "thermal"]`, or `{ electrical = { film = "1e-12 ohm m^2" } }`.
#[derive(Debug, Clone, Default)]
pub struct ConductanceSpec {
    electrical: Option<ElectricalSpec>,
    thermal: Option<ThermalSpec>,
}

/// How spots conduct a current.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ElectricalSpec {
    /// Resistance times area of a film on each spot, such as an oxide: in series with the spot.
    #[schemars(extend("x-default" = "none"))]
    film: Option<Quantity<ElectricalFilm, ElectricalFilmRange>>,
}

/// How spots and gap conduct heat.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ThermalSpec {
    /// Resistance times area of a film on each spot, such as an oxide: in series with the spot.
    #[schemars(extend("x-default" = "none"))]
    film: Option<Quantity<ThermalFilm, ThermalFilmRange>>,
    /// Thermal conductivity of a medium in the gap, in parallel with the spots: over the mean gap of the deformed surfaces, a lower bound. On
    /// surfaces with a map.
    #[schemars(extend("x-default" = "none: a vacuum", "examples" = ["0.026 W/(m K)"]))]
    gap_conductivity: Option<Quantity<ThermalConductivity, GapConductivityRange>>,
    /// Thickness that the medium resists more for the jumps of temperature at both borders; of gases.
    #[schemars(extend("default" = 0, "examples" = ["0.4 um"]))]
    gap_jump: Option<Spanned<Quantity<Length, GapJumpRange>>>,
}

/// The table form.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ConductanceTable {
    /// Electrical conductance; the materials need a `resistivity`.
    electrical: Option<ElectricalSpec>,
    /// Thermal conductance; the materials need a `thermal-conductivity`.
    thermal: Option<ThermalSpec>,
}

const ALLOWED: &str = "\"electrical\", \"thermal\", a list of both, or a table such as { electrical = { film = \"1e-12 ohm m^2\" } }";

written_schema!(ConductanceSpec, |generator| {
    let names = json!({ "type": "string", "enum": ["electrical", "thermal"] });
    let list = json!({ "type": "array", "items": names, "minItems": 1, "uniqueItems": true });
    json!({ "anyOf": [names, list, ConductanceTable::json_schema(generator).to_value()] })
});

impl ConductanceSpec {
    fn add(&mut self, name: &str) -> Result<(), String> {
        let is_second = match name {
            "electrical" => self.electrical.replace(ElectricalSpec::default()).is_some(),
            "thermal" => self.thermal.replace(ThermalSpec::default()).is_some(),
            _ => return Err(format!("found \"{name}\"; allowed: {ALLOWED}")),
        };
        if is_second { Err(format!("found \"{name}\" twice; allowed: {ALLOWED}")) } else { Ok(()) }
    }

    fn of_names(names: &[String]) -> Result<Self, String> {
        let mut spec = Self::default();
        names.iter().try_for_each(|name| spec.add(name))?;
        spec.filled()
    }

    fn filled(self) -> Result<Self, String> {
        if self.electrical.is_none() && self.thermal.is_none() {
            return Err(format!("found no conductance; allowed: {ALLOWED}"));
        }
        Ok(self)
    }
}

impl<'de> Deserialize<'de> for ConductanceSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new(ALLOWED)
            .text(|name| Self::of_names(&[name.to_owned()]))
            .list(|names: Vec<String>| Self::of_names(&names))
            .table(|ConductanceTable { electrical, thermal }| Self { electrical, thermal }.filled())
            .read(deserializer)
    }
}

/// `shear-strength = { tau0 = "20 MPa", alpha = 0.05 }`.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a shear strength such as { tau0 = \"20 MPa\", alpha = 0.05 }"
)]
pub struct ShearStrengthSpec {
    /// Shear strength of the real contact area without pressure.
    #[schemars(extend("examples" = ["20 MPa"]))]
    tau0: Quantity<Pressure, NotNegative>,
    /// Growth of the shear strength with the mean pressure of a spot.
    #[schemars(extend("default" = 0, "examples" = [0.05]))]
    alpha: Option<Quantity<Pure, NotNegative>>,
}

impl ShearStrengthSpec {
    fn strength(&self) -> ShearStrength {
        ShearStrength { tau0: self.tau0.value(), alpha: self.alpha.map_or(0.0, |alpha| alpha.value()) }
    }
}

/// Where spots break through a layer, over its thickness: at least one value.
#[derive(Debug, Clone, PartialEq)]
pub struct Breakdowns(Vec<f64>);

written_schema!(Breakdowns, |_| schema::one_or_many(
    schema::quantity::<Pure, Positive>(),
    "number, or a list of numbers"
));

impl<'de> Deserialize<'de> for Breakdowns {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let values: OneOrMany<Quantity<Pure, Positive>> =
            OneOrMany::read(deserializer, "a positive number, or a list of positive numbers")?;
        let values = values.at_least_one::<D::Error>("breakdown")?;
        let values: Vec<f64> = values.into_iter().map(|value| value.value()).collect();
        match values.iter().enumerate().find(|(k, value)| values[..*k].contains(value)) {
            Some((_, twice)) => {
                Err(D::Error::custom(format!("found {twice} twice; allowed: each breakdown once")))
            }
            None => Ok(Self(values)),
        }
    }
}

/// The breakdown of a layer where the spec does not say.
const BREAKDOWN: f64 = 1.0;

/// The keys of a spec about spots.
#[derive(Debug, Clone, Copy, Default)]
pub struct SpotKeys<'a> {
    pub conductance: Option<&'a Spanned<ConductanceSpec>>,
    pub shear_strength: Option<&'a Spanned<ShearStrengthSpec>>,
}

fn breakdowns(layer: &LayerSpec) -> Vec<f64> {
    layer.breakdown.as_ref().map_or_else(|| vec![BREAKDOWN], |values| values.get_ref().0.clone())
}

/// The bodies whose spots are asked for.
#[derive(Clone, Copy)]
pub struct SpottedBodies<'a> {
    /// The body without a layer: its name and itself.
    pub bare: (&'a str, &'a Material),
    /// The other one.
    pub coated: (&'a str, &'a Material),
    /// The layer on it: as resolved, and as the spec has it.
    pub layer: Option<(&'a LayerPlan, &'a LayerSpec)>,
}

impl SpotKeys<'_> {
    /// Adds what is asked of their spots to `laws`.
    pub fn add_to(
        &self,
        file: &SpecFile,
        bodies: SpottedBodies,
        laws: Vec<LawContact>,
    ) -> Result<Vec<LawContact>, InputError> {
        let shear_of_layer = bodies.layer.and_then(|(_, spec)| spec.shear_strength.as_ref());
        if let (None, Some(layer)) = (self.shear_strength, shear_of_layer) {
            let message = "found the shear strength of the layer without that of the interface, which shears without the layer and where it is \
                           broken; allowed: shear-strength = { tau0 = \"...\" } in [compare], too";
            return Err(file.source.error_at(layer.span(), message));
        }
        let breakdown = bodies.layer.and_then(|(_, spec)| spec.breakdown.as_ref());
        if let (None, Some(breakdown)) = (shear_of_layer, breakdown) {
            let message = "found `breakdown` of a layer that shears as the interface; allowed: shear-strength = { tau0 = \"...\" } of the layer \
                           beside it, or no `breakdown`";
            return Err(file.source.error_at(breakdown.span(), message));
        }
        if self.conductance.is_none() && self.shear_strength.is_none() {
            return Ok(laws);
        }
        let strengths = [self.shear_strength, shear_of_layer];
        if let Some(none) = strengths.into_iter().flatten().find(|spec| spec.get_ref().strength().is_none()) {
            let message = "found a shear strength of 0; allowed: a `tau0` or an `alpha` above 0";
            return Err(file.source.error_at(none.span(), message));
        }
        let thermal = self.conductance.and_then(|conductance| conductance.get_ref().thermal.as_ref());
        if let Some(ThermalSpec { gap_conductivity: None, gap_jump: Some(jump), .. }) = thermal {
            let message = "found a temperature jump without a medium; allowed: gap-conductivity = \"...\" beside it, or no `gap-jump`";
            return Err(file.source.error_at(jump.span(), message));
        }
        let with_spots = |law: LawContact| {
            let properties = self.properties(file, bodies, law.thickness)?;
            Ok(LawContact { contact: Box::new(WithSpots::new(law.contact, properties)), ..law })
        };
        laws.into_iter().map(with_spots).collect()
    }

    /// How the layer shears; `None` without its shear strength.
    pub fn film(&self, layer: Option<&LayerSpec>) -> Option<Film> {
        let layer = layer?;
        Some(Film {
            strength: layer.shear_strength.as_ref()?.get_ref().strength(),
            interface: self.shear_strength?.get_ref().strength(),
            breakdowns: breakdowns(layer),
        })
    }

    /// Refuses a medium in the gap of surfaces without a mean plane.
    pub fn check_gap(&self, file: &SpecFile, surfaces: &[SurfacePlan]) -> Result<(), InputError> {
        let Some(conductance) = self.conductance else { return Ok(()) };
        let has_medium =
            conductance.get_ref().thermal.as_ref().is_some_and(|spec| spec.gap_conductivity.is_some());
        match surfaces.iter().find(|surface| surface.map_points().is_none()).filter(|_| has_medium) {
            Some(surface) => {
                let message = format!(
                    "found a medium in the gap on surface {} ({}), which has no height map to take a mean gap from; allowed: surfaces made by \
                     [surface.NAME.generate] or read by [surface.NAME.file], or no `gap-conductivity`",
                    surface.name,
                    surface.describe()
                );
                Err(file.source.error_at(conductance.span(), message))
            }
            None => Ok(()),
        }
    }

    /// Under a thickness of the layer (m).
    fn properties(
        &self,
        file: &SpecFile,
        bodies: SpottedBodies,
        thickness: Option<f64>,
    ) -> Result<SpotProperties, InputError> {
        let thickness = thickness.unwrap_or(0.0);
        let shear = self.shear_strength.map(|interface| {
            let interface = interface.get_ref().strength();
            match bodies.layer.and_then(|(_, spec)| Some((spec.shear_strength.as_ref()?, spec))) {
                Some((film, spec)) => {
                    Shear::under_film(interface, film.get_ref().strength(), thickness, breakdowns(spec)[0])
                }
                None => Shear { strength: interface, broken: None },
            }
        });
        // Under a layer of finite thickness it is not known.
        let outermost = match bodies.layer {
            Some(_) if thickness > 0.0 && thickness.is_finite() => None,
            Some((layer, _)) if thickness > 0.0 => Some(&layer.coating.material),
            _ => Some(bodies.coated.1),
        };
        let tangential = shear.and(outermost).map(|outermost| Tangential::new(bodies.bare.1, outermost));
        let Some(conductance) = self.conductance else {
            return Ok(SpotProperties { shear, tangential, ..SpotProperties::default() });
        };
        let span = conductance.span();
        let (electrical, thermal) = (&conductance.get_ref().electrical, &conductance.get_ref().thermal);
        let of_electrical = Bodies { file, bodies, thickness, key: RESISTIVITY, span: span.clone() };
        let of_thermal = Bodies { key: THERMAL_CONDUCTIVITY, ..of_electrical.clone() };
        let electrical = electrical
            .as_ref()
            .map(|spec| of_electrical.conduction(Material::resistivity, spec.film.map(|film| film.value())));
        let thermal = thermal.as_ref().map(|spec| {
            let resistivity = |body: &Material| body.thermal_conductivity().map(f64::recip);
            of_thermal.conduction(resistivity, spec.film.map(|film| film.value()))
        });
        let medium = conductance.get_ref().thermal.as_ref().and_then(|spec| {
            let jump = spec.gap_jump.as_ref().map_or(0.0, |jump| jump.get_ref().value());
            Some(GapMedium::new(spec.gap_conductivity?.value(), jump))
        });
        let medium =
            medium.transpose().map_err(|error| file.source.error_at(span, format!("found {error}")))?;
        Ok(SpotProperties {
            electrical: electrical.transpose()?,
            thermal: thermal.transpose()?,
            medium,
            shear,
            tangential,
        })
    }
}

/// Bodies whose property of the name `key` is asked for at `span`.
#[derive(Clone)]
struct Bodies<'a> {
    file: &'a SpecFile<'a>,
    bodies: SpottedBodies<'a>,
    thickness: f64,
    key: &'static str,
    span: Range<usize>,
}

impl Bodies<'_> {
    fn conduction(
        &self,
        resistivity: impl Fn(&Material) -> Option<f64>,
        film: Option<f64>,
    ) -> Result<Conduction, InputError> {
        let Self { bodies: SpottedBodies { bare, coated, layer }, thickness, .. } = *self;
        let needed = |(name, body): (&str, &Material)| {
            resistivity(body).ok_or_else(|| {
                let message = format!(
                    "found no `{key}` in [material.{name}], which the conductance needs; allowed: {key} = \"...\" with its unit",
                    key = self.key
                );
                let span = self.file.material_at(name).unwrap_or_else(|| self.span.clone());
                self.file.source.error_at(span, message)
            })
        };
        let bare = needed(bare)?;
        let found = match layer.filter(|_| thickness > 0.0) {
            None => Conduction::new([bare, needed(coated)?]),
            Some((layer, _)) => {
                let of_layer = needed((&layer.name, &layer.coating.material))?;
                if thickness.is_finite() {
                    Conduction::layered(bare, needed(coated)?, of_layer, thickness)
                } else {
                    Conduction::new([bare, of_layer])
                }
            }
        };
        let refuse =
            |error: ConductionError| self.file.source.error_at(self.span.clone(), format!("found {error}"));
        found.and_then(|found| found.with_film(film.unwrap_or(0.0))).map_err(refuse)
    }
}
