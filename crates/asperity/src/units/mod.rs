//! Parsing of quantities with units. Inside the library all quantities are SI in `f64`.
//!
//! | dimension | documented units | bare number |
//! |---|---|---|
//! | pressure | Pa, kPa, MPa, GPa, N/mm^2, HV (9.80665 MPa), kgf/mm^2, bar, psi, ksi | Pa |
//! | length | m, cm, mm, um, nm, pm, Å, in, mil | m |
//! | area | m^2, cm^2, mm^2, um^2 | m^2 |
//! | density (number per area) | /m^2, /mm^2, /um^2 | 1/m^2 |
//! | angle | deg, rad | rad |
//! | force | N, mN, uN, kN, kgf, lbf | N |
//! | resistivity | ohm m, uohm cm, nohm m, ohm mm^2/m | ohm m |
//! | thermal conductivity | W/(m K), mW/(m K) | W/(m K) |
//! | electrical resistance times area | ohm m^2, ohm cm^2, mohm cm^2, ohm mm^2 | ohm m^2 |
//! | thermal resistance times area | m^2 K/W, cm^2 K/W, mm^2 K/W | m^2 K/W |
//!
//! SI units take prefixes from pico to tera, m those up to kilo. `u` may be `µ`, `^2` may be `²` or `2` (`mm2`), and `/m^2` may be `1/m^2`
//! or `m⁻²`.
//!
//! ```
//! use asperity::units::Dimension;
//!
//! assert_eq!(Dimension::Pressure.parse("210 GPa"), Some(210e9));
//! assert_eq!(Dimension::Length.parse("1.2µm"), Some(1.2e-6));
//! assert_eq!(Dimension::Length.parse("1.2 GPa"), None);
//! ```

mod table;

use table::{
    ANGLE, AREA, CONDUCTIVITY, DENSITY, ELECTRICAL_FILM, FORCE, LENGTH, PREFIXES, PRESSURE, RESISTIVITY,
    THERMAL_FILM, Units,
};

use crate::named_enum;

/// The longest text that may be a quantity.
const MOST_BYTES: usize = 400;

named_enum! {
    /// A physical dimension, by its name in messages.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Dimension {
        /// Pressure, modulus or hardness.
        Pressure = "pressure",
        /// m.
        Length = "length",
        /// m^2.
        Area = "area",
        /// Number per area.
        ArealNumberDensity = "density",
        /// rad.
        Angle = "angle",
        /// N.
        Force = "force",
        /// Electrical resistivity.
        Resistivity = "resistivity",
        /// W/(m K).
        ThermalConductivity = "thermal conductivity",
        /// Electrical resistance times area.
        ElectricalFilm = "electrical resistance times area",
        /// Thermal resistance times area.
        ThermalFilm = "thermal resistance times area",
    }
}

impl Dimension {
    const fn units(self) -> &'static Units {
        match self {
            Self::Pressure => &PRESSURE,
            Self::Length => &LENGTH,
            Self::Area => &AREA,
            Self::ArealNumberDensity => &DENSITY,
            Self::Angle => &ANGLE,
            Self::Force => &FORCE,
            Self::Resistivity => &RESISTIVITY,
            Self::ThermalConductivity => &CONDUCTIVITY,
            Self::ElectricalFilm => &ELECTRICAL_FILM,
            Self::ThermalFilm => &THERMAL_FILM,
        }
    }

    /// An example of a quantity, such as "210 GPa".
    pub const fn example(self) -> &'static str {
        self.units().example
    }

    /// The SI unit, assumed for a bare number.
    pub const fn si_unit(self) -> &'static str {
        self.units().si_unit
    }

    /// The units listed in documentation and messages; more are accepted.
    pub const fn documented(self) -> &'static [&'static str] {
        self.units().documented
    }

    /// The SI value of one `unit`; `None` if it is not a unit of this dimension.
    pub fn factor(self, unit: &str) -> Option<f64> {
        if unit.len() > MOST_BYTES {
            return None;
        }
        self.canonical_factor(&canonical(unit.trim()))
    }

    /// The SI value of one `unit`; `None` unless it is one of the [documented](Self::documented) ones.
    pub fn documented_factor(self, unit: &str) -> Option<f64> {
        if unit.len() > MOST_BYTES {
            return None;
        }
        let unit = canonical(unit);
        self.documented().contains(&unit.as_str()).then(|| self.canonical_factor(&unit))?
    }

    /// The SI value of a number followed by a unit, such as "1.2 um"; `None` if the number or a unit of this dimension
    /// is missing. For a unit that is a power of ten the result is correctly rounded: "50 nm" is 5e-8.
    pub fn parse(self, text: &str) -> Option<f64> {
        let text = text.trim();
        if text.len() > MOST_BYTES {
            return None;
        }
        // "6e10 /m^2", but also "210GPa": the number is the longest prefix that parses as one.
        let end = (1..=text.len()).rev().find(|&end| text.get(..end).is_some_and(is_number))?;
        let (number, unit) = text.split_at(end);
        Some(scaled(number, self.factor(unit)?))
    }

    fn canonical_factor(self, unit: &str) -> Option<f64> {
        if self == Self::ArealNumberDensity {
            return area_of_density(unit).and_then(|area| Self::Area.canonical_factor(&area)).map(f64::recip);
        }
        let units = self.units();
        let known = units.others.iter().find(|(spelling, _)| *spelling == unit);
        units.prefixed(unit).or(known.map(|&(_, factor)| factor))
    }
}

/// The area unit of a density unit: "mm^2" for "/mm^2", "1/mm^2" and "mm^-2".
fn area_of_density(unit: &str) -> Option<String> {
    if let Some(length) = unit.strip_suffix("^-2") {
        return Some(format!("{length}^2"));
    }
    let area = ["/", "1/"].iter().find_map(|per| unit.strip_prefix(per));
    area.map(str::to_owned)
}

impl Units {
    /// The SI value of one `unit` if it is the SI unit, with or without a prefix.
    fn prefixed(&self, unit: &str) -> Option<f64> {
        let prefix = unit.strip_suffix(self.si_unit).filter(|_| self.power > 0)?;
        let (_, exponent) =
            PREFIXES.iter().find(|(symbol, exponent)| *symbol == prefix && *exponent <= self.largest)?;
        Some(power_of_ten(exponent * self.power))
    }
}

/// The spelling of a unit in the table: `u` for both signs of micro, `^2` for `²` and for a `2` after a letter, `^-2` for `⁻²`,
/// the letter Å for the ångström sign, `ohm` for both signs of it, a space for a dot between units.
fn canonical(unit: &str) -> String {
    let plain = unit.replace(['µ', 'μ'], "u").replace('\u{212b}', "\u{c5}");
    let plain = plain.replace(['Ω', 'Ω'], "ohm").replace(['·', '⋅', '*'], " ");
    let plain = plain.replace('⁻', "^-").replace('²', "^2").replace("^-^2", "^-2");
    match plain.strip_suffix('2') {
        Some(base) if base.ends_with(|c: char| c.is_ascii_alphabetic()) => format!("{base}^2"),
        _ => plain,
    }
}

fn is_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) && text.parse::<f64>().is_ok()
}

/// The double nearest to 10^`exponent`.
fn power_of_ten(exponent: i32) -> f64 {
    // Always parses.
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// `number` times `factor`. If the factor is a power of ten, the number is parsed with another exponent, which rounds
/// once.
fn scaled(number: &str, factor: f64) -> f64 {
    let power = factor.log10().round() as i32;
    if (factor / power_of_ten(power) - 1.0).abs() < 1e-12 {
        let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
        let exponent = exponent.parse::<i32>().ok().and_then(|exponent| exponent.checked_add(power));
        if let Some(value) = exponent.and_then(|exponent| format!("{digits}e{exponent}").parse().ok()) {
            return value;
        }
    }
    number.parse::<f64>().map_or(f64::NAN, |number| number * factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_of_tens_rounds_once() {
        assert_eq!(Dimension::Length.parse("50 nm"), Some(5e-8));
        assert_eq!(Dimension::Length.parse("0.3 um"), Some(3e-7));
        assert_eq!(Dimension::Length.parse("1.5e3 nm"), Some(1.5e-6));
        assert_eq!(Dimension::Length.parse("2 in"), Some(0.0508));
    }

    #[test]
    fn documented_units_are_in_the_table_and_the_si_unit_is_one() {
        for dimension in Dimension::ALL {
            assert!(dimension.parse(dimension.example()).is_some(), "{dimension:?}");
            assert_eq!(dimension.factor(dimension.si_unit()), Some(1.0), "{dimension:?}");
            for unit in dimension.documented() {
                assert!(dimension.documented_factor(unit).is_some(), "{unit}");
                assert_eq!(dimension.documented_factor(unit), dimension.factor(unit));
            }
        }
        for micrometre in ["um", "µm", "μm"] {
            assert_eq!(Dimension::Length.documented_factor(micrometre), Some(1e-6));
        }
        for area in ["mm^2", "mm²", "mm2"] {
            assert_eq!(Dimension::Area.documented_factor(area), Some(1e-6), "{area}");
        }
        assert_eq!(Dimension::Pressure.parse("2 N/mm2"), Some(2e6));
        assert_eq!(Dimension::ArealNumberDensity.parse("3 /mm2"), Some(3e6));
        assert_eq!(Dimension::Length.documented_factor("\u{212b}"), Some(1e-10));
        assert_eq!(Dimension::Length.documented_factor("inch"), None);
    }

    #[test]
    fn what_is_no_quantity_of_a_dimension() {
        for text in [
            "", "nm", "1.2", "1.2 GPa", "2 parsec", "1 m2", "nan nm", "1 2 nm", "1.2 nmm", "1.2 µ", "µm",
            "e9 m", "m 1",
        ] {
            assert_eq!(Dimension::Length.parse(text), None, "{text}");
        }
        // Units of lengths that no surface has.
        for text in ["2 parsec", "1 pc", "3 light years", "1 fathom", "1 Mm", "1 fm"] {
            assert_eq!(Dimension::Length.parse(text), None, "{text}");
        }
        // These read as a sum and as a misprint.
        assert_eq!(Dimension::Length.parse("2 1/6 in"), None);
        assert_eq!(Dimension::ArealNumberDensity.parse("2 11/m^2"), None);
        assert_eq!(Dimension::ArealNumberDensity.parse("2 m^2"), None);
    }

    #[test]
    fn extreme_numbers_stay_numbers() {
        assert_eq!(Dimension::Length.parse("1e400 m"), Some(f64::INFINITY));
        assert_eq!(Dimension::Length.parse("-1e999999999999 nm"), Some(f64::NEG_INFINITY));
        assert_eq!(Dimension::Length.parse("1e-2147483648 nm"), Some(0.0));
        assert_eq!(Dimension::Length.parse("+inf nm"), Some(f64::INFINITY));
    }
}
