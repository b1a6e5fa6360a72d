//! Words and colours that pages of several kinds share, and the figures of Pasaribu and Schipper (2005) that specs reproduce.

use std::fmt;

use asperity::Regime;
use asperity::compare::{Cause, ComparedQuantity};
use asperity_contact_framework::input::{OneOrMany, schema};
use asperity_contact_framework::report::format::listed;
use asperity_contact_framework::written_schema;
use asperity_plot::Colour;
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::json;

pub fn quantity_name(compared: ComparedQuantity) -> &'static str {
    match compared {
        ComparedQuantity::Separation => "separation",
        ComparedQuantity::Area => "real contact area",
        ComparedQuantity::Stiffness => "stiffness",
        ComparedQuantity::ElectricalConductance => "electrical conductance",
        ComparedQuantity::ThermalConductance => "thermal conductance",
        ComparedQuantity::Friction => "coefficient of friction",
    }
}

/// The unit of a difference in a quantity, and the factor to it from sigma or from a relative difference.
pub fn difference_unit(compared: ComparedQuantity) -> (&'static str, f64) {
    match compared {
        ComparedQuantity::Separation => ("σ", 1.0),
        _ => ("%", 100.0),
    }
}

pub fn cause_colour(cause: Cause) -> Colour {
    match cause {
        Cause::Heights => Colour::Heights,
        Cause::Radii => Colour::Radii,
        Cause::Correlation => Colour::Correlation,
    }
}

pub fn regime_colour(regime: Regime) -> Colour {
    match regime {
        Regime::Elastic => Colour::Elastic,
        Regime::ElasticPlastic => Colour::ElasticPlastic,
        Regime::Plastic => Colour::Plastic,
    }
}

/// What a figure of the paper shows, `what`, as the title of one in a report.
pub fn title(figure: u8, what: &str) -> String {
    format!("Fig. {figure} of Pasaribu and Schipper (2005): {what}")
}

/// Figures of two rough surfaces: 3 (radii against heights of the asperities), 4 (separation against load) and 6 (separation and area
/// against load by layer thickness).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SurfaceFigures(pub Vec<u8>);

/// Fig. 5: load and normal approach of a sphere on a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SphereFigure;

const OF_SURFACES: [u8; 3] = [3, 4, 6];
const OF_SPHERE: [u8; 1] = [5];

written_schema!(SurfaceFigures, |_| schema::one_or_many(
    json!({ "enum": OF_SURFACES }),
    "3, 4 or 6, or a list of them"
));
written_schema!(SphereFigure, |_| json!({ "enum": OF_SPHERE }));

impl<'de> Deserialize<'de> for SurfaceFigures {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer, &OF_SURFACES, "Fig. 5 is one of [indentation]").map(Self)
    }
}

impl<'de> Deserialize<'de> for SphereFigure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer, &OF_SPHERE, "Figs. 3, 4 and 6 are those of [compare]").map(|_| Self)
    }
}

/// The number of a figure that the paper may not have.
struct Number(i64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Integer;

        impl Visitor<'_> for Integer {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(
                    "the number of a figure of Pasaribu and Schipper (2005) from 3 to 6, without quotes",
                )
            }
            fn visit_i64<E: Error>(self, number: i64) -> Result<Number, E> {
                Ok(Number(number))
            }
        }
        deserializer.deserialize_any(Integer)
    }
}

/// Numbers of figures among those `allowed`, at least one, each once.
fn read<'de, D: Deserializer<'de>>(
    deserializer: D,
    allowed: &[u8],
    others: &str,
) -> Result<Vec<u8>, D::Error> {
    let names = listed(&allowed.iter().map(u8::to_string).collect::<Vec<_>>());
    let expected = format!("the number of a figure of Pasaribu and Schipper (2005): {names}");
    let numbers: Vec<Number> = OneOrMany::read(deserializer, &expected)?.at_least_one("figure")?;
    let mut figures = Vec::new();
    for Number(number) in numbers {
        let known = allowed.iter().copied().find(|&figure| i64::from(figure) == number);
        match known.filter(|figure| !figures.contains(figure)) {
            Some(figure) => figures.push(figure),
            None => {
                let message = format!("found the figure {number}; allowed: {names}, each once ({others})");
                return Err(D::Error::custom(message));
            }
        }
    }
    Ok(figures)
}
