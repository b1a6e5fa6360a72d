//! Numbers and quantities as people read them. Files for machines carry full digits instead.

const RESULT_DIGITS: usize = 3;
/// Most significant digits of an input.
const INPUT_DIGITS: usize = 6;

/// A result with at most three significant digits: plain between 0.001 and 100,000, else with a power
/// of ten. `1.234567e-6` gives "1.23e-6", 210 gives "210", infinity "∞" and NaN "–".
pub fn number(value: f64) -> String {
    plain_number(value, RESULT_DIGITS)
}

/// A result with the prefix that suits it, at most three significant digits: 4.8e-8 m gives
/// "48 nm", 2.1e11 Pa "210 GPa", 1e-6 m² "1 mm²". `unit` is an SI unit without prefix; prefixes of
/// squares step by a million. A compound unit such as "1/m²" takes a power of ten instead.
pub fn quantity(value: f64, unit: &str) -> String {
    with_prefix(value, unit, RESULT_DIGITS)
}

/// An input as the user gave it, with up to six significant digits: 7.625 gives "7.625". Values that have more, such
/// as the inner points of a logarithmic sweep, are written like a result.
pub fn input_number(value: f64) -> String {
    plain_number(value, input_digits(value))
}

/// An input with the prefix that suits it; digits as in [`input_number`].
pub fn input_quantity(value: f64, unit: &str) -> String {
    with_prefix(value, unit, input_digits(value))
}

/// An error to one digit, of which more would differ between machines: 3.2e-16 gives "3e-16".
pub fn one_digit(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.0e}") }
}

/// Six digits where they are exact up to the rounding of a conversion of units.
fn input_digits(value: f64) -> usize {
    let rounded = format!("{value:.*e}", INPUT_DIGITS - 1).parse().unwrap_or(value);
    if (rounded - value).abs() <= 1e-12 * value.abs() { INPUT_DIGITS } else { RESULT_DIGITS }
}

fn plain_number(value: f64, significant: usize) -> String {
    match decimal(value, significant) {
        Ok(digits) => {
            let exponent = digits.exponent;
            if (-3..5).contains(&exponent) {
                digits.plain(exponent)
            } else {
                format!("{}e{exponent}", digits.plain(0))
            }
        }
        Err(name) => name.into(),
    }
}

fn with_prefix(value: f64, unit: &str, significant: usize) -> String {
    let digits = match decimal(value, significant) {
        Ok(digits) => digits,
        Err(name) => return format!("{name} {unit}"),
    };
    let letters = unit.trim_end_matches('²');
    if letters.is_empty() || !letters.chars().all(char::is_alphabetic) || digits.value == 0.0 {
        return format!("{} {unit}", plain_number(value, significant));
    }
    let step = if unit.ends_with('²') { 6 } else { 3 };
    let prefix = digits.exponent.div_euclid(step);
    let Some(name) = usize::try_from(prefix + 5).ok().and_then(|place| PREFIXES.get(place)) else {
        return format!("{} {unit}", plain_number(value, significant));
    };
    format!("{} {name}{unit}", digits.plain(digits.exponent - step * prefix))
}

/// A ratio with three significant digits, zeros included, for columns of ratios near one: "1.00", "0.998".
pub fn ratio(value: f64) -> String {
    let magnitude = decimal(value, RESULT_DIGITS).map_or(0, |digits| digits.exponent);
    let decimals = (RESULT_DIGITS as i32 - 1 - magnitude).max(0) as usize;
    format!("{value:.decimals$}")
}

/// A range in one unit: "0.24 to 100 MPa"; of equal ends one value.
pub fn range([from, to]: [f64; 2], unit: &str) -> String {
    let Prefix { name, size } = Prefix::for_value(to, unit);
    let [first, last] = [from, to].map(|value| plain_number(value / size, input_digits(value)));
    if first == last { format!("{last} {name}") } else { format!("{first} to {last} {name}") }
}

/// A result with its sign: "+1.2", "-3", and "0".
pub fn signed(value: f64) -> String {
    let number = number(value);
    if value > 0.0 && number != "0" { format!("+{number}") } else { number }
}

/// The same, and "< 0.001" of what is closer to zero than `least`, of which the sign says nothing.
pub fn signed_or_small(value: f64, least: f64) -> String {
    if value != 0.0 && value.abs() < least { format!("< {}", number(least)) } else { signed(value) }
}

/// A share of one in percent, with at most three significant digits: 0.1234 gives "12.3 %".
pub fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

/// The text with a capital first letter.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A count with commas between thousands: 1234567 gives "1,234,567".
pub fn count(value: usize) -> String {
    let digits = value.to_string();
    let mut grouped = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// Name of a layer thickness that the user gave: "uncoated" for 0, "bulk" for infinity.
pub fn thickness(value: f64) -> String {
    match value {
        0.0 => "uncoated".to_owned(),
        f64::INFINITY => "bulk".to_owned(),
        value => input_quantity(value, "m"),
    }
}

/// A list as in a sentence: "a, b and c".
pub fn listed(names: &[String]) -> String {
    joined(names, "and")
}

/// "one", "one or two", "one, two or three".
pub fn alternatives(names: &[String]) -> String {
    joined(names, "or")
}

fn joined(names: &[String], last_by: &str) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} {last_by} {last}", others.join(", ")),
    }
}

/// A unit with a prefix, and its size in the unit without.
#[derive(Debug, Clone, PartialEq)]
pub struct Prefix {
    /// Such as "µm".
    pub name: String,
    /// Such as 1e-6.
    pub size: f64,
}

impl Prefix {
    /// The prefix that suits a value in an SI unit; compound units take none, since their numbers take powers of ten.
    pub fn for_value(value: f64, unit: &str) -> Self {
        let none = || Self { name: unit.to_owned(), size: 1.0 };
        let letters = unit.trim_end_matches('²');
        if letters.is_empty() || !letters.chars().all(char::is_alphabetic) {
            return none();
        }
        let step = if unit.ends_with('²') { 6 } else { 3 };
        let Some(digits) = decimal(value, RESULT_DIGITS).ok().filter(|digits| digits.value != 0.0) else {
            return none();
        };
        let prefix = digits.exponent.div_euclid(step);
        let name = usize::try_from(prefix + 5).ok().and_then(|place| PREFIXES.get(place));
        name.map_or_else(none, |name| Self::named(name, unit))
    }

    pub fn named(name: &str, unit: &str) -> Self {
        // Of a square, not of a compound unit: a prefix is that of its first unit.
        let is_square = unit.ends_with('²') && !unit.contains('/');
        let step = if is_square { 6 } else { 3 };
        let place = PREFIXES.iter().position(|prefix| *prefix == name);
        let size = place.map_or(1.0, |place| 10f64.powi(step * (place as i32 - 5)));
        Self { name: format!("{name}{unit}"), size }
    }
}

const PREFIXES: [&str; 10] = ["f", "p", "n", "µ", "m", "", "k", "M", "G", "T"];

/// A finite number rounded to some significant digits: value * 10^exponent, |value| from 1 to 10.
struct Digits {
    value: f64,
    exponent: i32,
    significant: usize,
}

fn decimal(value: f64, significant: usize) -> Result<Digits, &'static str> {
    if value.is_nan() {
        return Err("–");
    }
    if value.is_infinite() {
        return Err(if value > 0.0 { "∞" } else { "−∞" });
    }
    // Rounding comes first: 999.99 belongs to the next power of ten.
    let text = format!("{value:.*e}", significant - 1);
    let parts =
        text.split_once('e').and_then(|(lead, power)| Some((lead.parse().ok()?, power.parse().ok()?)));
    let (value, exponent) = parts.unwrap_or((value, 0));
    // No minus in front of zero.
    Ok(Digits { value: value + 0.0, exponent, significant })
}

impl Digits {
    /// The digits times 10^shift, without trailing zeros.
    fn plain(&self, shift: i32) -> String {
        let decimals = (self.significant as i32 - 1 - shift).max(0) as usize;
        let text = format!("{:.decimals$}", self.value * 10f64.powi(shift));
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_differences_and_ranges_are_written_as_people_do() {
        assert_eq!(signed_or_small(-9.52e-4, 1e-3), "< 0.001");
        assert_eq!([0.0, 1.24, -0.002].map(|value| signed_or_small(value, 1e-3)), ["0", "+1.24", "-0.002"]);
        assert_eq!(range([2.4e5, 1e8], "Pa"), "0.24 to 100 MPa");
        assert_eq!(range([1e6, 1e6], "Pa"), "1 MPa");
    }

    #[test]
    fn numbers() {
        for (value, text) in [
            (1.234567e-6, "1.23e-6"),
            (0.0, "0"),
            (-0.0, "0"),
            (210.0, "210"),
            (0.05, "0.05"),
            (0.0012345, "0.00123"),
            (99999.0, "1e5"),
            (12345.0, "12300"),
            (-3.2e20, "-3.2e20"),
            (f64::NAN, "–"),
            (f64::INFINITY, "∞"),
            (5e-324, "4.94e-324"),
        ] {
            assert_eq!(number(value), text, "{value:e}");
        }
        assert_eq!([3.2e-16, 0.0].map(one_digit), ["3e-16", "0"]);
    }

    #[test]
    fn quantities() {
        for (value, unit, text) in [
            (4.8e-8, "m", "48 nm"),
            (2.1e11, "Pa", "210 GPa"),
            (1e-6, "m²", "1 mm²"),
            (2.5e-7, "m²", "250000 µm²"),
            (999.6e-9, "m", "1 µm"),
            (6e10, "1/m²", "6e10 1/m²"),
            (0.0, "Pa", "0 Pa"),
            (f64::INFINITY, "m", "∞ m"),
            (1e30, "Pa", "1e30 Pa"),
            (1e-30, "m", "1e-30 m"),
            (-1.5e-6, "m", "-1.5 µm"),
        ] {
            assert_eq!(quantity(value, unit), text, "{value:e} {unit}");
        }
    }

    #[test]
    fn inputs() {
        for (value, text) in [
            (7.625, "7.625"),
            (0.123456, "0.123456"),
            (1e6 / 3.0, "3.33e5"),
            (0.1 + 0.2, "0.3"),
            (123456.0, "1.23456e5"),
            (f64::NAN, "–"),
            (f64::INFINITY, "∞"),
            (0.0, "0"),
        ] {
            assert_eq!(input_number(value), text, "{value:e}");
        }
        assert_eq!(input_quantity(196.75e-9, "m"), "196.75 nm");
        assert_eq!(input_quantity(2.71429e9, "Pa"), "2.71429 GPa");
        assert_eq!(input_quantity(10f64.powf(5.5), "Pa"), "316 kPa");
        assert_eq!(thickness(1.25e-9), "1.25 nm");
    }

    #[test]
    fn prefixes_and_signs() {
        let named = |name, unit| (Prefix::named(name, unit).name, Prefix::named(name, unit).size);
        assert_eq!(named("m", "m²"), ("mm²".to_owned(), 1e-6));
        assert_eq!(named("M", "S/m²"), ("MS/m²".to_owned(), 1e6));
        assert_eq!([1.234, 0.0, -2.0].map(signed), ["+1.23", "0", "-2"]);
    }

    #[test]
    fn ratios_keep_their_zeros() {
        for (value, text) in [
            (1.004, "1.00"),
            (0.9984, "0.998"),
            (0.9996, "1.00"),
            (2.349, "2.35"),
            (0.04, "0.0400"),
            (250.0, "250"),
        ] {
            assert_eq!(ratio(value), text);
        }
    }

    #[test]
    fn shares_and_counts() {
        assert_eq!(percent(0.12345), "12.3 %");
        assert_eq!(percent(-1e-9), "-1e-7 %");
        assert_eq!(count(0), "0");
        assert_eq!(count(999), "999");
        assert_eq!(count(1_234_567), "1,234,567");
    }
}
