//! Areas and loads of every law (docs/theory.md, section 1).

use super::YieldLimits;
use crate::stability::bodies::Law;
use crate::stability::wide::{PI, Wide};
use asperity::contact::Regime;

/// `numerator`/`denominator`: a decimal to all digits.
fn decimal(numerator: f64, denominator: f64) -> Wide {
    Wide::new(numerator) / denominator
}

fn power(base: Wide, exponent: Wide) -> Wide {
    (exponent * base.ln()).exp()
}

/// Critical indentations over b (onset/E*)^2, ascending.
pub(super) fn boundaries(law: Law) -> Vec<Wide> {
    let critical = PI * PI / 4.0;
    match law {
        Law::Hertz | Law::FullyPlastic => Vec::new(),
        Law::Zmc { onset, transition_ratio } => {
            let onset = onset.map_or(PI * PI * 9.0 / 100.0, Wide::new);
            vec![onset, onset * transition_ratio]
        }
        Law::Ceb => vec![critical],
        Law::KogutEtsion => [1.0, 6.0, 110.0].map(|u| critical * u).to_vec(),
        Law::JacksonGreen => vec![critical * 19.0 / 10.0],
    }
}

/// What a body of Poisson's ratio `nu`, hardness and yield strength (Pa) sets against yielding.
pub(super) fn yield_limits(
    law: Law,
    nu: Wide,
    hardness: Option<Wide>,
    strength: Option<Wide>,
) -> Option<YieldLimits> {
    let factor = match law {
        Law::Hertz => return None,
        Law::Zmc { .. } | Law::FullyPlastic => Wide::ONE,
        Law::Ceb | Law::KogutEtsion => decimal(454.0, 1000.0) + decimal(41.0, 100.0) * nu,
        Law::JacksonGreen => decimal(1295.0, 1000.0) * (decimal(736.0, 1000.0) * nu).exp(),
    };
    let limit = if law == Law::JacksonGreen { strength } else { hardness };
    limit.map(|strength| YieldLimits { onset: factor * strength, strength })
}

/// Area, load and regime of a sphere of radius `b` at indentation `w` in the range of the law that begins at its
/// `range`th boundary.
pub(super) fn answer(
    law: Law,
    range: usize,
    w: Wide,
    b: Wide,
    modulus: Wide,
    yield_limits: Option<YieldLimits>,
) -> (Wide, Wide, Regime) {
    let elastic_area = PI * b * w;
    let elastic = || {
        let load = modulus * (b * w).sqrt() * w * 4.0 / 3.0;
        (elastic_area, load, Regime::Elastic)
    };
    let Some(YieldLimits { onset, strength }) = yield_limits else { return elastic() };
    let plastic = || (elastic_area * 2.0, strength * elastic_area * 2.0, Regime::Plastic);
    let strain = onset / modulus;
    let critical = PI * PI / 4.0 * b * strain * strain;
    match (law, range) {
        (Law::FullyPlastic, _) => plastic(),
        (Law::Hertz, _) | (_, 0) => elastic(),
        (Law::Zmc { .. }, 1) => {
            let [first, second] = [0, 1].map(|k| boundaries(law)[k] * b * strain * strain);
            let x = (w - first) / (second - first);
            let area = elastic_area * (Wide::ONE + x * x * 3.0 - x * x * x * 2.0);
            let share = (second / w).ln() / (second / first).ln();
            (area, strength * (Wide::ONE - decimal(6.0, 10.0) * share) * area, Regime::ElasticPlastic)
        }
        (Law::Zmc { .. }, _) | (Law::KogutEtsion, 3) => plastic(),
        (Law::Ceb, _) => {
            let area = elastic_area * (Wide::new(2.0) - critical / w);
            (area, onset * area, Regime::ElasticPlastic)
        }
        (Law::KogutEtsion, _) => {
            let u = w / critical;
            let thousandths =
                if range == 1 { [930.0, 1136.0, 1030.0, 1425.0] } else { [940.0, 1146.0, 1400.0, 1263.0] };
            let [area, of_area, load, of_load] = thousandths.map(|value| decimal(value, 1000.0));
            let unit = PI * b * critical;
            (
                unit * area * power(u, of_area),
                onset * unit * 2.0 / 3.0 * load * power(u, of_load),
                Regime::ElasticPlastic,
            )
        }
        (Law::JacksonGreen, _) => {
            let u = w / critical;
            let exponent = decimal(14.0, 100.0) * (strength / modulus * 23.0).exp();
            let area = elastic_area * power(u * 10.0 / 19.0, exponent);
            let width = (area / PI).sqrt() / b;
            let limit = decimal(284.0, 100.0)
                * (Wide::ONE - (-(decimal(82.0, 100.0) * power(width, decimal(-7.0, 10.0)))).exp());
            let half = PI * onset / 2.0;
            let unit = b / modulus * (b / modulus) * half * half * half * 4.0 / 3.0;
            let elastic = (-(power(u, decimal(5.0, 12.0)) / 4.0)).exp() * u * u.sqrt();
            let spread = power(u, decimal(5.0, 9.0)) / 25.0;
            let plastic = limit * strength / onset * 4.0 * (Wide::ONE - (-spread).exp()) * u;
            (area, unit * (elastic + plastic), Regime::ElasticPlastic)
        }
    }
}
