//! Differences, loads and needs in words.

use asperity::compare::{ComparedQuantity, Stretch, Verdict};
use asperity_framework::report::format::{input_quantity, number, percent, quantity};

use crate::kind::compare::findings::{Basis, Verdicts};

/// A quantity as a table names it.
pub fn name(compared: ComparedQuantity) -> &'static str {
    match compared {
        ComparedQuantity::Separation => "separation",
        ComparedQuantity::Area => "real contact area",
        ComparedQuantity::Stiffness => "stiffness",
    }
}

/// A verdict as a table names it.
pub fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Within => "within",
        Verdict::Beyond => "beyond",
        Verdict::CannotTell => "cannot tell",
    }
}

/// "between 0.5 and 40 MPa", or "at 1 MPa".
pub fn between(range: [f64; 2]) -> String {
    if range[0] == range[1] {
        format!("at {}", loads(range))
    } else {
        format!("between {}", loads(range).replacen(" to ", " and ", 1))
    }
}

/// "from 0.5 to 40 MPa", or "at 1 MPa".
pub fn over(range: [f64; 2]) -> String {
    format!("{} {}", if range[0] == range[1] { "at" } else { "from" }, loads(range))
}

/// "0.5 to 40 MPa", or one load.
pub fn loads([from, to]: [f64; 2]) -> String {
    if from == to {
        return input_quantity(from, "Pa");
    }
    span(&input_quantity(from, "Pa"), &input_quantity(to, "Pa"), " to ")
}

/// The same as forces on the nominal area (m^2).
pub fn forces(pressures: [f64; 2], area: f64) -> String {
    let [from, to] = pressures.map(|pressure| quantity(pressure * area, "N"));
    if from == to { from } else { span(&from, &to, " to ") }
}

/// Two quantities, their unit once where it is the same.
pub fn span(from: &str, to: &str, between: &str) -> String {
    match (from.rsplit_once(' '), to.rsplit_once(' ')) {
        (Some((number, unit)), Some((_, same))) if unit == same => format!("{number}{between}{to}"),
        _ => format!("{from}{between}{to}"),
    }
}

/// The magnitude of a contrast: a length with its part of sigma (m), or a share.
pub fn size(compared: ComparedQuantity, contrast: f64, sigma: f64) -> String {
    match compared {
        ComparedQuantity::Separation => distance(contrast, sigma),
        ComparedQuantity::Area | ComparedQuantity::Stiffness => percent(compared.reported(contrast).abs()),
    }
}

/// The magnitude of a distance of `contrast` sigma (m): "15 nm (0.31 σ)".
pub fn distance(contrast: f64, sigma: f64) -> String {
    format!("{} ({} σ)", quantity(contrast.abs() * sigma, "m"), number(contrast.abs()))
}

/// Smaller differences, in sigma or relative, are written as zero to as many digits.
const NEGLIGIBLE: f64 = 5e-5;

/// A contrast with its sign: "+0.32 σ", "−7.9 %".
pub fn signed(compared: ComparedQuantity, contrast: f64) -> String {
    let reported = compared.reported(contrast);
    let size = match compared {
        ComparedQuantity::Separation => format!("{} σ", number(reported.abs())),
        ComparedQuantity::Area | ComparedQuantity::Stiffness => percent(reported.abs()),
    };
    match reported {
        0.0 => size,
        little if little.abs() < NEGLIGIBLE => match compared {
            ComparedQuantity::Separation => "0.0000 σ".to_owned(),
            ComparedQuantity::Area | ComparedQuantity::Stiffness => "0.00 %".to_owned(),
        },
        negative if negative < 0.0 => format!("−{size}"),
        _ => format!("+{size}"),
    }
}

/// What is accepted: "10 %", or "4.8 nm = 0.1 σ".
pub fn accepted(stretch: &Stretch, sigma: f64) -> String {
    match stretch.quantity {
        ComparedQuantity::Separation => accepted_separation(stretch.accepted, sigma),
        ComparedQuantity::Area | ComparedQuantity::Stiffness => percent(stretch.accepted),
    }
}

/// An accepted separation, in sigma (m) and as a length.
pub fn accepted_separation(accepted: f64, sigma: f64) -> String {
    format!("{} = {} σ", quantity(accepted * sigma, "m"), number(accepted))
}

/// A nominal area (m^2): in mm² from a tenth on.
pub fn nominal_area(area: f64) -> String {
    if (1e-8..1.0).contains(&area) { format!("{} mm²", number(1e6 * area)) } else { quantity(area, "m²") }
}

/// How much more surface would tell at half of the loads: "about 2.5 mm² of surface (now 1 mm²)", "about 12 realisations (now
/// 3)"; where there is no interval, the least that would give one.
pub fn need(stretch: &Stretch, verdicts: &Verdicts) -> Option<String> {
    if stretch.verdict != Verdict::CannotTell {
        return None;
    }
    if let (Basis::Realisations(now), Some(growth)) = (verdicts.basis, stretch.growth) {
        let needed = (growth * now as f64).ceil();
        return Some(format!("about {} realisations (now {now})", number(needed.max(now as f64 + 1.0))));
    }
    let area = verdicts.area_needed(stretch)?;
    let (least, purpose) =
        if stretch.area_needed.is_some() { ("at least", " for an interval") } else { ("about", "") };
    Some(format!(
        "{least} {} of surface{purpose} (now {})",
        nominal_area(two_digits(area)),
        nominal_area(verdicts.area)
    ))
}

/// An estimate is no better than that.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
