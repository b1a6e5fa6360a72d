//! Quantities with units at the file's edge; inside the program everything is SI in plain `f64`.
//!
//! The unit tables are uom's. What a spec may write beside them is spelt out here: `um` for `µm`,
//! `^2` for `²`, `/m^2` for `m⁻²`, `HV` for kgf/mm².

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, Visitor};

use asperity::numeric::is_positive;

/// A kind of quantity that a spec may hold.
pub trait Dimension {
    /// What it is called.
    const NAME: &'static str;
    /// What may be written.
    const ALLOWED: &'static str;
    /// The SI value of "number unit" in uom's spelling, `None` for an unknown unit.
    fn si(text: &str) -> Option<f64>;
}

macro_rules! dimensions {
    ($($(#[$doc:meta])* $name:ident, $words:literal, $allowed:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum $name {}

        impl Dimension for $name {
            const NAME: &'static str = $words;
            const ALLOWED: &'static str = $allowed;
            fn si(text: &str) -> Option<f64> {
                text.parse::<uom::si::f64::$name>().ok().map(|quantity| quantity.value)
            }
        }
    )*};
}

dimensions! {
    /// Moduli, hardnesses, pressures.
    Pressure, "pressure", "such as \"210 GPa\" (Pa, kPa, MPa, GPa, N/mm^2, HV; a bare number is in Pa)";
    /// Lengths.
    Length, "length", "such as \"1.2 um\" (m, mm, um, nm, pm; a bare number is in m)";
    /// Areas.
    Area, "area", "such as \"1 mm^2\" (m^2, cm^2, mm^2, um^2; a bare number is in m^2)";
    /// Numbers per area.
    ArealNumberDensity, "density", "such as \"6e10 /m^2\" (/m^2, /mm^2, /um^2; a bare number is in 1/m^2)";
    /// Angles.
    Angle, "angle", "such as \"30 deg\" (deg, rad; a bare number is in rad)";
    /// Forces.
    Force, "force", "such as \"10 N\" (N, mN, uN, kN; a bare number is in N)";
}

/// A pure number: no unit is allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pure {}

impl Dimension for Pure {
    const NAME: &'static str = "number";
    const ALLOWED: &'static str = "without a unit";
    fn si(_: &str) -> Option<f64> {
        None
    }
}

/// A range that values must lie in.
pub trait Range {
    /// How an error names it.
    const WORDS: &'static str;
    /// Whether `value` lies in it.
    fn holds(value: f64) -> bool;
}

/// Positive, and far from both ends of the floating-point range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Positive {}

impl Range for Positive {
    const WORDS: &'static str = "a positive finite";
    fn holds(value: f64) -> bool {
        is_positive(value)
    }
}

/// Any finite value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finite {}

impl Range for Finite {
    const WORDS: &'static str = "a finite";
    fn holds(value: f64) -> bool {
        value.abs() <= asperity::numeric::LARGEST
    }
}

/// Zero, or positive and far from both ends of the floating-point range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotNegative {}

impl Range for NotNegative {
    const WORDS: &'static str = "zero or a positive finite";
    fn holds(value: f64) -> bool {
        value == 0.0 || is_positive(value)
    }
}

/// A separation in units of sigma: beyond, rounding of d/sigma leaves nothing of the heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SeparationRange {}

impl Range for SeparationRange {
    const WORDS: &'static str = "from -1000 to 1000 sigma, a";
    fn holds(value: f64) -> bool {
        value.abs() <= 1000.0
    }
}

/// Poisson's ratio of a stable solid that is not incompressible: [0, 0.5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PoissonRange {}

impl Range for PoissonRange {
    const WORDS: &'static str = "at least 0 and below 0.5, a";
    fn holds(value: f64) -> bool {
        (0.0..0.5).contains(&value)
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

    fn checked(value: f64, found: &dyn fmt::Display) -> Result<Self, String> {
        if R::holds(value) { Ok(Self { value, kind: PhantomData }) } else { Err(Self::error(found)) }
    }

    fn error(found: &dyn fmt::Display) -> String {
        format!("found {found}; allowed: {} {} {}", R::WORDS, D::NAME, D::ALLOWED)
    }

    fn parse(text: &str) -> Result<Self, String> {
        let found = format!("\"{text}\"");
        let value = in_uoms_spelling(text).and_then(|spelt| Some(in_tens(&spelt, D::si(&spelt)?)));
        value.map_or_else(|| Err(Self::error(&found)), |value| Self::checked(value, &found))
    }
}

/// The value of "50 nm", which is `value` but for rounding: where the unit is a power of ten it is read as "50e-9",
/// which is the nearest number there is.
fn in_tens(spelt: &str, value: f64) -> f64 {
    let number = spelt.split_whitespace().next().unwrap_or_default();
    let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let unit = value / number.parse().unwrap_or(f64::NAN);
    let power = unit.log10().round();
    let off = (unit / 10f64.powf(power) - 1.0).abs();
    if off.is_nan() || off > 1e-12 {
        return value;
    }
    let shifted = exponent.parse::<i32>().map(|exponent| format!("{digits}e{}", exponent + power as i32));
    shifted.ok().and_then(|text| text.parse().ok()).unwrap_or(value)
}

/// "1.2 um" as uom reads it, "1.2 µm"; `None` if there is no number in front.
fn in_uoms_spelling(text: &str) -> Option<String> {
    let text = text.trim();
    let is_number = |part: &str| {
        part.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) && part.parse::<f64>().is_ok()
    };
    // "6e10 /m^2", but also "210GPa": the number is the longest beginning that reads as one.
    let end = (1..=text.len()).rev().find(|&end| text.is_char_boundary(end) && is_number(&text[..end]))?;
    let (number, unit) = (&text[..end], text[end..].trim_start());
    let unit = match unit {
        "HV" => "kgf/mm²".to_owned(),
        "deg" => "°".to_owned(),
        _ => {
            let metric = unit.replace("um", "µm").replace("uN", "µN").replace('μ', "µ").replace("^2", "²");
            match metric.trim_start_matches('1').strip_prefix('/').and_then(|area| area.strip_suffix('²')) {
                Some(length) => format!("{length}⁻²"),
                None => metric,
            }
        }
    };
    Some(format!("{number} {unit}"))
}

impl<'de, D: Dimension, R: Range> Deserialize<'de> for Quantity<D, R> {
    fn deserialize<T: Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        struct Reader<D, R>(PhantomData<(D, R)>);

        impl<D: Dimension, R: Range> Visitor<'_> for Reader<D, R> {
            type Value = Quantity<D, R>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "{} {} {}", R::WORDS, D::NAME, D::ALLOWED)
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
                Quantity::parse(text).map_err(E::custom)
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
                Quantity::checked(value, &value).map_err(E::custom)
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
                Quantity::checked(value as f64, &value).map_err(E::custom)
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
                Quantity::checked(value as f64, &value).map_err(E::custom)
            }
        }
        deserializer.deserialize_any(Reader(PhantomData))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(text: &str) -> Result<f64, String> {
        Quantity::<Length>::parse(text).map(|q| q.value())
    }

    #[test]
    fn a_unit_of_tens_rounds_once() {
        assert_eq!(length("50 nm"), Ok(5e-8));
        assert_eq!(length("0.3 um"), Ok(3e-7));
        assert_eq!(length("1.5e3 nm"), Ok(1.5e-6));
        assert_eq!(in_tens("2 in", 0.0508), 0.0508);
    }

    #[test]
    fn the_units_that_a_spec_may_write() {
        let close = |found: f64, exact: f64| (found / exact - 1.0).abs() < 4e-16;
        for (text, metres) in [
            ("1.2 um", 1.2e-6),
            ("1.2 µm", 1.2e-6),
            ("1.2 μm", 1.2e-6),
            ("1.2um", 1.2e-6),
            ("48 nm", 48e-9),
            ("2e1 mm", 0.02),
        ] {
            assert!(close(length(text).unwrap(), metres), "{text}");
        }
        let pressure = |text| Quantity::<Pressure>::parse(text).unwrap().value();
        assert!(close(pressure("210 GPa"), 210e9));
        assert!(close(pressure("775 HV"), 775.0 * 9.80665e6));
        assert!(close(pressure("5 N/mm^2"), 5e6));
        let density = |text| Quantity::<ArealNumberDensity>::parse(text).unwrap().value();
        assert!(close(density("6e10 /m^2"), 6e10));
        assert!(close(density("0.06 /um^2"), 6e10));
        assert!(close(density("6e4 1/mm^2"), 6e10));
        assert!(close(Quantity::<Area>::parse("1 mm^2").unwrap().value(), 1e-6));
        assert!(close(Quantity::<Force>::parse("3 uN").unwrap().value(), 3e-6));
        assert!(close(Quantity::<Angle>::parse("30 deg").unwrap().value(), std::f64::consts::FRAC_PI_6));
    }

    #[test]
    fn what_is_refused_says_what_is_allowed() {
        for text in ["", "nm", "1.2", "1.2 GPa", "-3 nm", "0 nm", "inf nm", "nan nm", "1 2 nm", "1.2 nmm"] {
            let message = length(text).unwrap_err();
            assert!(
                message.starts_with(&format!("found \"{text}\"; allowed: a positive finite length")),
                "{message}"
            );
        }
        assert!(Quantity::<Pure>::parse("3 nm").is_err());
    }
}
