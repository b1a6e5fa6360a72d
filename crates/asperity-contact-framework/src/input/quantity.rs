//! Quantities with units at the file's edge; inside the program everything is SI in plain `f64`.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use asperity::numeric::{LARGEST, is_positive};
use asperity::units;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::bare::Bare;
use super::schema::{RANGE, TYPE};
use super::{Forms, schema};

/// A kind of quantity that a spec may hold.
pub trait Dimension {
    /// Its units; `None` of a pure number.
    const UNITS: Option<units::Dimension>;

    /// What it is called, and what may be written.
    fn allowed() -> String {
        let Some(of) = Self::UNITS else { return "number without a unit".to_owned() };
        format!(
            "{} such as \"{}\" ({}; a bare number is in {})",
            of.name(),
            of.example(),
            of.documented().join(", "),
            of.si_unit()
        )
    }
}

macro_rules! dimensions {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum $name {}

        impl Dimension for $name {
            const UNITS: Option<units::Dimension> = Some(units::Dimension::$name);
        }
    )*};
}

dimensions! {
    /// Moduli, hardnesses, pressures.
    Pressure;
    Length;
    Area;
    ArealNumberDensity;
    Angle;
    Force;
    Resistivity;
    ThermalConductivity;
    /// Electrical resistances times area.
    ElectricalFilm;
    /// Thermal resistances times area.
    ThermalFilm;
}

/// A pure number: no unit is allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pure {}

impl Dimension for Pure {
    const UNITS: Option<units::Dimension> = None;
}

/// A range that values must lie in.
pub trait Range {
    /// How an error names it.
    const WORDS: &'static str;
    /// The SI magnitudes that it ends at, where [`Self::WORDS`] do not say so.
    const MAGNITUDES: Option<&'static str> = None;
    /// The range in a table.
    const IN_SHORT: &'static str;
    /// Keywords of a JSON schema with their values, SI.
    const BOUNDS: &'static [(&'static str, f64)];
    /// What may be written without a unit, where that is less than the range.
    const BARE: Option<Bare> = None;
    /// Whether `value` lies in it.
    fn holds(value: f64) -> bool;
}

/// Positive, and far from both ends of the floating-point range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Positive {}

impl Range for Positive {
    const WORDS: &'static str = "a positive finite";
    const MAGNITUDES: Option<&'static str> = Some("1e-30 to 1e30");
    const IN_SHORT: &'static str = "above 0";
    const BOUNDS: &'static [(&'static str, f64)] = &[("exclusiveMinimum", 0.0), ("maximum", LARGEST)];
    fn holds(value: f64) -> bool {
        is_positive(value)
    }
}

/// Any finite value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finite {}

impl Range for Finite {
    const WORDS: &'static str = "a finite";
    const MAGNITUDES: Option<&'static str> = Some("at most 1e30");
    const IN_SHORT: &'static str = "any finite value";
    const BOUNDS: &'static [(&'static str, f64)] = &[("minimum", -LARGEST), ("maximum", LARGEST)];
    fn holds(value: f64) -> bool {
        value.abs() <= LARGEST
    }
}

/// Zero, or positive and far from both ends of the floating-point range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotNegative {}

impl Range for NotNegative {
    const WORDS: &'static str = "zero or a positive finite";
    const MAGNITUDES: Option<&'static str> = Some("1e-30 to 1e30");
    const IN_SHORT: &'static str = "0 or above";
    const BOUNDS: &'static [(&'static str, f64)] = &[("minimum", 0.0), ("maximum", LARGEST)];
    fn holds(value: f64) -> bool {
        value == 0.0 || is_positive(value)
    }
}

/// A separation in units of sigma; beyond this range d/sigma is rounded more coarsely than the heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SeparationRange {}

impl Range for SeparationRange {
    const WORDS: &'static str = "from -1000 to 1000 sigma, a";
    const IN_SHORT: &'static str = "-1000 to 1000";
    const BOUNDS: &'static [(&'static str, f64)] = &[("minimum", -1000.0), ("maximum", 1000.0)];
    fn holds(value: f64) -> bool {
        value.abs() <= 1000.0
    }
}

/// Poisson's ratio of a stable solid: 0 to 0.5, which is incompressible. No contact equation divides by 1 - 2 nu.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PoissonRange {}

impl Range for PoissonRange {
    const WORDS: &'static str = "from 0 to 0.5, a";
    const IN_SHORT: &'static str = "0 to 0.5";
    const BOUNDS: &'static [(&'static str, f64)] = &[("minimum", 0.0), ("maximum", 0.5)];
    fn holds(value: f64) -> bool {
        (0.0..=0.5).contains(&value)
    }
}

/// A value of dimension `D` within the range `R`, in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity<D, R = Positive> {
    value: f64,
    kind: PhantomData<(D, R)>,
}

impl<D: Dimension, R: Range> Quantity<D, R> {
    /// The value, SI.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// A value in SI, which an error calls `found`.
    pub fn checked(value: f64, found: &dyn fmt::Display) -> Result<Self, String> {
        if R::holds(value) {
            return Ok(Self { value, kind: PhantomData });
        }
        Err(match R::MAGNITUDES {
            // The value has the right sign, so that the words of the range do not say what is wrong.
            Some(magnitudes) if value.is_finite() && (value > 0.0 || R::holds(-1.0)) => {
                let unit = D::UNITS.map_or_else(String::new, |units| format!(" {}", units.si_unit()));
                format!("{}, of magnitude {magnitudes}{unit}", Self::error(found))
            }
            _ => Self::error(found),
        })
    }

    /// A value that a spec writes without a unit, as `found`.
    pub fn bare(value: f64, found: &str) -> Result<Self, String> {
        let checked = Self::checked(value, &found)?;
        R::BARE.map_or(Ok(()), |bare| bare.check(value, found))?;
        Ok(checked)
    }

    fn error(found: &dyn fmt::Display) -> String {
        format!("found {found}; allowed: {} {}", R::WORDS, D::allowed())
    }

    /// A value with its unit.
    pub fn parse(text: &str) -> Result<Self, String> {
        let found = format!("\"{text}\"");
        let parse = |text: &str| D::UNITS.and_then(|units| units.parse(text));
        if let Some(value) = parse(text) {
            return Self::checked(value, &found);
        }
        let error = Self::error(&found);
        let with_point = text.replacen(',', ".", 1);
        Err(match parse(&with_point) {
            Some(_) => format!("{error}; the decimal separator is a point: \"{with_point}\""),
            None => error,
        })
    }
}

impl<D: Dimension, R: Range> JsonSchema for Quantity<D, R> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "quantity".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        schema::of(schema::quantity::<D, R>())
    }
}

impl<'de, D: Dimension, R: Range> Deserialize<'de> for Quantity<D, R> {
    fn deserialize<T: Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        Forms::new(&format!("{} {}", R::WORDS, D::allowed()))
            .text(Self::parse)
            .number(Self::bare)
            .read(deserializer)
    }
}

/// A whole number from zero on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Whole(pub u64);

const ALLOWED: &str = "a whole number such as 1000 or 1e3, without quotes, up to 18446744073709551615";

fn refused<E: Error>(found: impl fmt::Display) -> E {
    E::custom(format!("found {found}; allowed: {ALLOWED}"))
}

crate::written_schema!(Whole, |_| json!({
    "type": "integer", "minimum": 0, TYPE: "whole number", RANGE: "0 to 18446744073709551615", "examples": [1000],
}));

impl<'de> Deserialize<'de> for Whole {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;

        impl Visitor<'_> for Reader {
            type Value = Whole;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(ALLOWED)
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Whole, E> {
                Ok(Whole(value))
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Whole, E> {
                u64::try_from(value).map(Whole).map_err(|_| refused(value))
            }
            fn visit_u128<E: Error>(self, value: u128) -> Result<Whole, E> {
                u64::try_from(value).map(Whole).map_err(|_| refused(value))
            }
            fn visit_i128<E: Error>(self, value: i128) -> Result<Whole, E> {
                u64::try_from(value).map(Whole).map_err(|_| refused(value))
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Whole, E> {
                /// 2^64.
                const END: f64 = 18_446_744_073_709_551_616.0;
                let is_whole = (0.0..END).contains(&value) && value.fract() == 0.0;
                if is_whole { Ok(Whole(value as u64)) } else { Err(refused(format!("{value:?}"))) }
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Whole, E> {
                Err(refused(format!("\"{text}\"")))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(text: &str) -> Result<f64, String> {
        Quantity::<Length>::parse(text).map(|q| q.value())
    }

    #[test]
    fn a_quantity_has_its_unit_and_its_range() {
        assert_eq!(length("50 nm"), Ok(5e-8));
        assert_eq!(Quantity::<Pressure>::parse("775 HV").unwrap().value(), 775.0 * 9.80665e6);
        assert_eq!(Quantity::<Angle, Finite>::parse("-180 deg").unwrap().value(), -std::f64::consts::PI);
    }

    #[test]
    fn what_is_refused_says_what_is_allowed() {
        for text in
            ["", "nm", "1.2", "1.2 GPa", "-3 nm", "0 nm", "inf nm", "nan nm", "1 2 nm", "1.2 nmm", "0,5,1 um"]
        {
            let message = length(text).unwrap_err();
            assert!(!message.contains("decimal separator") && !message.contains("magnitude"), "{message}");
            assert!(
                message.starts_with(&format!("found \"{text}\"; allowed: a positive finite length")),
                "{message}"
            );
        }
        assert!(Quantity::<Pure>::parse("3 nm").is_err());
        let large = Quantity::<Length, Finite>::parse("-1e31 m").unwrap_err();
        assert!(large.contains("magnitude at most 1e30 m"), "{large}");
    }

    fn read(text: &str) -> Result<u64, String> {
        let value = toml::de::ValueDeserializer::parse(text).map_err(|error| error.message().to_owned())?;
        Whole::deserialize(value).map(|whole| whole.0).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn a_whole_number_may_be_written_as_a_float() {
        assert_eq!(read("1000"), Ok(1000));
        assert_eq!(read("1e3"), Ok(1000));
        assert_eq!(read("1e18"), Ok(1_000_000_000_000_000_000));
        assert_eq!(read("18446744073709551615"), Ok(u64::MAX));
    }

    #[test]
    fn other_numbers_are_refused_in_plain_words() {
        for text in
            ["-3", "2.5", "1e20", "18446744073709551616", "nan", "inf", "\"1e3\"", "true", "[1]", "{ a = 1 }"]
        {
            let message = read(text).unwrap_err();
            assert!(message.contains("a whole number such as 1000"), "{text}: {message}");
        }
    }
}
