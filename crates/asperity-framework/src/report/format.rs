//! Numbers and quantities as people read them. Files for machines carry full digits instead.

/// A number with at most four significant digits: plain between 0.001 and 100,000, else with a power
/// of ten. `1.234567e-6` gives "1.235e-6", 210 gives "210", infinity "∞" and NaN "–".
pub fn number(value: f64) -> String {
    match decimal(value) {
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

/// A quantity with the prefix that suits it, at most four significant digits: 4.8e-8 m gives
/// "48 nm", 2.1e11 Pa "210 GPa", 1e-6 m² "1 mm²". `unit` is an SI unit without prefix; prefixes of
/// squares step by a million. A compound unit such as "1/m²" takes a power of ten instead.
pub fn quantity(value: f64, unit: &str) -> String {
    let digits = match decimal(value) {
        Ok(digits) => digits,
        Err(name) => return format!("{name} {unit}"),
    };
    let letters = unit.trim_end_matches('²');
    if letters.is_empty() || !letters.chars().all(char::is_alphabetic) || digits.value == 0.0 {
        return format!("{} {unit}", number(value));
    }
    let step = if unit.ends_with('²') { 6 } else { 3 };
    let prefix = digits.exponent.div_euclid(step);
    let Some(name) = usize::try_from(prefix + 5).ok().and_then(|place| PREFIXES.get(place)) else {
        return format!("{} {unit}", number(value));
    };
    format!("{} {name}{unit}", digits.plain(digits.exponent - step * prefix))
}

/// A share of one in percent, with at most three significant digits: 0.1234 gives "12.3 %".
pub fn percent(share: f64) -> String {
    let rounded = format!("{:.2e}", 100.0 * share).parse().unwrap_or(100.0 * share);
    format!("{} %", number(rounded))
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

/// How a thickness is named.
pub fn thickness(value: f64) -> String {
    match value {
        0.0 => "no layer".to_owned(),
        f64::INFINITY => "all layer".to_owned(),
        value => quantity(value, "m"),
    }
}

/// A list as a sentence has it.
pub fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}

const PREFIXES: [&str; 10] = ["f", "p", "n", "µ", "m", "", "k", "M", "G", "T"];

/// A finite number rounded to four significant digits: value * 10^exponent, |value| from 1 to 10.
struct Digits {
    value: f64,
    exponent: i32,
}

fn decimal(value: f64) -> Result<Digits, &'static str> {
    if value.is_nan() {
        return Err("–");
    }
    if value.is_infinite() {
        return Err(if value > 0.0 { "∞" } else { "−∞" });
    }
    // Rounding comes first: 999.99 belongs to the next power of ten.
    let text = format!("{value:.3e}");
    let parts =
        text.split_once('e').and_then(|(lead, power)| Some((lead.parse().ok()?, power.parse().ok()?)));
    let (value, exponent) = parts.unwrap_or((value, 0));
    // No minus in front of zero.
    Ok(Digits { value: value + 0.0, exponent })
}

impl Digits {
    /// The digits times 10^shift, without trailing zeros.
    fn plain(&self, shift: i32) -> String {
        let decimals = (3 - shift).max(0) as usize;
        let text = format!("{:.decimals$}", self.value * 10f64.powi(shift));
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        for (value, text) in [
            (1.234567e-6, "1.235e-6"),
            (0.0, "0"),
            (-0.0, "0"),
            (210.0, "210"),
            (0.05, "0.05"),
            (0.0012345, "0.001234"),
            (99999.0, "1e5"),
            (12345.0, "12340"),
            (-3.2e20, "-3.2e20"),
            (f64::NAN, "–"),
            (f64::INFINITY, "∞"),
            (5e-324, "4.941e-324"),
        ] {
            assert_eq!(number(value), text, "{value:e}");
        }
    }

    #[test]
    fn quantities() {
        for (value, unit, text) in [
            (4.8e-8, "m", "48 nm"),
            (2.1e11, "Pa", "210 GPa"),
            (1e-6, "m²", "1 mm²"),
            (2.5e-7, "m²", "250000 µm²"),
            (999.96e-9, "m", "1 µm"),
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
    fn shares_and_counts() {
        assert_eq!(percent(0.12345), "12.3 %");
        assert_eq!(percent(-1e-9), "-1e-7 %");
        assert_eq!(count(0), "0");
        assert_eq!(count(999), "999");
        assert_eq!(count(1_234_567), "1,234,567");
    }
}
