//! `[material.NAME]`: one body, by its properties or from the library.

use asperity::Material;
use asperity::material_library::{self, LibraryMaterial, Sourced};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::input::bare::{
    HardnessRange, ModulusRange, ResistivityRange, ThermalConductivityRange, YieldRange,
};
use crate::input::quantity::{PoissonRange, Pressure, Pure, Quantity, Resistivity, ThermalConductivity};

/// A body as a spec states it, checked.
#[derive(Debug, Clone, Deserialize)]
#[serde(try_from = "Keys")]
pub struct MaterialSpec {
    /// The body.
    pub body: Material,
    /// Where its values are from, if some are from the library.
    pub origin: Option<MaterialOrigin>,
}

/// A body whose values are from the library, but for those that the spec gives.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialOrigin {
    pub from: &'static LibraryMaterial,
    /// The keys that the spec gives itself.
    pub overridden: Vec<&'static str>,
}

impl MaterialOrigin {
    /// The values that contact needs of the body and that are from the library: key and source of each.
    pub fn sources(&self) -> Vec<(&'static str, String)> {
        self.sources_of([
            (YOUNG, Some(self.from.young)),
            (POISSON, Some(self.from.poisson)),
            (HARDNESS, self.from.hardness),
            (YIELD_STRENGTH, self.from.yield_strength),
        ])
    }

    /// The same of how it conducts, electrically and thermally, where that `is_used`.
    pub fn sources_of_conduction(&self, [electrical, thermal]: [bool; 2]) -> Vec<(&'static str, String)> {
        self.sources_of([
            (RESISTIVITY, self.from.resistivity.filter(|_| electrical)),
            (THERMAL_CONDUCTIVITY, self.from.thermal_conductivity.filter(|_| thermal)),
        ])
    }

    fn sources_of<const N: usize>(
        &self,
        all: [(&'static str, Option<Sourced>); N],
    ) -> Vec<(&'static str, String)> {
        let taken = all.into_iter().filter(|(key, _)| !self.overridden.contains(key));
        taken.filter_map(|(key, value)| Some((key, value?.source()))).collect()
    }
}

const YOUNG: &str = "young";
const POISSON: &str = "poisson";
const HARDNESS: &str = "hardness";
const YIELD_STRENGTH: &str = "yield-strength";
/// The key of the electrical resistivity.
pub const RESISTIVITY: &str = "resistivity";
pub const THERMAL_CONDUCTIVITY: &str = "thermal-conductivity";

/// One body: by its properties, or from the library.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Keys {
    /// Name of a material of the library, whose values the other keys replace; `experiment materials` lists them.
    #[schemars(extend("examples" = ["steel-100Cr6"]))]
    from: Option<String>,
    /// Young's modulus; needed without `from`.
    young: Option<Quantity<Pressure, ModulusRange>>,
    /// Poisson's ratio; needed without `from`.
    #[schemars(extend("examples" = [0.3]))]
    poisson: Option<Quantity<Pure, PoissonRange>>,
    /// Indentation hardness; left out for a body that never yields.
    #[schemars(extend("examples" = ["775 HV"]))]
    hardness: Option<Quantity<Pressure, HardnessRange>>,
    /// Yield strength, for the law `jackson-green`.
    #[schemars(extend("examples" = ["2.2 GPa"]))]
    yield_strength: Option<Quantity<Pressure, YieldRange>>,
    /// Electrical resistivity, for electrical conductance.
    #[schemars(extend("examples" = ["17 nohm m"]))]
    resistivity: Option<Quantity<Resistivity, ResistivityRange>>,
    /// Thermal conductivity, for thermal conductance.
    thermal_conductivity: Option<Quantity<ThermalConductivity, ThermalConductivityRange>>,
}

crate::written_schema!(MaterialSpec, |generator| Keys::json_schema(generator));

impl TryFrom<Keys> for MaterialSpec {
    type Error = String;

    fn try_from(keys: Keys) -> Result<Self, String> {
        let from = keys.from.as_deref().map(in_library).transpose()?;
        let given = [
            (YOUNG, keys.young.map(|q| q.value())),
            (POISSON, keys.poisson.map(|q| q.value())),
            (HARDNESS, keys.hardness.map(|q| q.value())),
            (YIELD_STRENGTH, keys.yield_strength.map(|q| q.value())),
            (RESISTIVITY, keys.resistivity.map(|q| q.value())),
            (THERMAL_CONDUCTIVITY, keys.thermal_conductivity.map(|q| q.value())),
        ];
        let library = from.map_or([None; 6], |from| {
            [
                Some(from.young),
                Some(from.poisson),
                from.hardness,
                from.yield_strength,
                from.resistivity,
                from.thermal_conductivity,
            ]
            .map(|value| value.map(|sourced| sourced.value))
        });
        let value = |index: usize| given[index].1.or(library[index]);
        let needed = |index: usize, example: &str| {
            value(index).ok_or_else(|| {
                let key = given[index].0;
                format!(
                    "found no `{key}`, which is needed; allowed: {key} = {example}, or from = \"steel-100Cr6\" for all values \
                     of a material of the library (`experiment materials` lists them)"
                )
            })
        };
        let (young, poisson) = (needed(0, "\"210 GPa\"")?, needed(1, "0.3")?);
        let body = Material::new(young, poisson, value(2), value(3))
            .and_then(|body| body.conducting(value(4), value(5)))
            .map_err(|error| error.to_string())?;
        let overridden = given.iter().filter(|(_, value)| value.is_some()).map(|(key, _)| *key).collect();
        Ok(Self { body, origin: from.map(|from| MaterialOrigin { from, overridden }) })
    }
}

fn in_library(name: &str) -> Result<&'static LibraryMaterial, String> {
    material_library::find(name).ok_or_else(|| {
        let similar: Vec<String> =
            material_library::similar(name).iter().map(|name| format!("\"{name}\"")).collect();
        let near = if similar.is_empty() {
            String::new()
        } else {
            format!(" (similar names: {})", similar.join(", "))
        };
        format!(
            "found from = \"{name}\"; allowed: the name of a material of the library{near}; `experiment materials` lists them"
        )
    })
}
