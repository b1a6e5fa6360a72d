//! `[material.NAME]`: one body.

use asperity::{Material, MaterialError};
use serde::Deserialize;

use crate::input::quantity::{PoissonRange, Pressure, Pure, Quantity};

/// A body as a spec states it, checked.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "Keys")]
pub struct MaterialSpec(pub Material);

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Keys {
    young: Quantity<Pressure>,
    poisson: Quantity<Pure, PoissonRange>,
    hardness: Option<Quantity<Pressure>>,
    yield_strength: Option<Quantity<Pressure>>,
}

impl TryFrom<Keys> for MaterialSpec {
    type Error = MaterialError;

    fn try_from(keys: Keys) -> Result<Self, MaterialError> {
        let value = |quantity: Option<Quantity<Pressure>>| quantity.map(|q| q.value());
        let (hardness, yield_strength) = (value(keys.hardness), value(keys.yield_strength));
        Material::new(keys.young.value(), keys.poisson.value(), hardness, yield_strength).map(Self)
    }
}
