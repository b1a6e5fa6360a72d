//! Scales from values to places on the page, and positions and labels of the ticks of an axis.

use crate::{Axis, Spread};

/// One division of an axis; minor ones have no label.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// 0 at the beginning of the axis, 1 at its end.
    pub(super) place: f64,
    pub(super) label: Option<String>,
}

/// Divides an axis as finely as its labels fit, into about `most` parts: `fits` judges one set of labelled ticks. Of one
/// label nobody reads a scale: rather than that there are a few more than `most`.
pub(super) fn ticks(scale: &Scale, most: usize, fits: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
    /// Steps of 1, 2 and 5 are at most so much finer than the next.
    const FINER: usize = 3;
    let most = most.max(1);
    let divided = |count: usize| match scale.spread {
        Spread::Linear => linear(scale, count),
        Spread::Log => log(scale, count),
    };
    let labels = |ticks: &[Tick]| ticks.iter().filter(|tick| tick.label.is_some()).count();
    let mut best = divided(1);
    for count in (1..=most).rev() {
        let ticks = divided(count);
        if labels(&ticks) <= most.max(2) && fits(&ticks) {
            best = ticks;
            break;
        }
    }
    if labels(&best) > 1 {
        return best;
    }
    let is_scale = |ticks: &Vec<Tick>| labels(ticks) > 1 && fits(ticks);
    let finer = || (1..=FINER * most).map(divided);
    let found = finer().skip(most).find(is_scale).or_else(|| finer().map(every_other).find(is_scale));
    found.unwrap_or(best)
}

/// The same ticks, of which every second label is left out.
fn every_other(mut ticks: Vec<Tick>) -> Vec<Tick> {
    let labelled = ticks.iter_mut().filter(|tick| tick.label.is_some());
    labelled.skip(1).step_by(2).for_each(|tick| tick.label = None);
    ticks
}

/// Equal steps of 1, 2 or 5 times a power of ten.
fn linear(scale: &Scale, count: usize) -> Vec<Tick> {
    let (low, high) = scale.bounds();
    let rough = (high - low) / count as f64;
    let mut exponent = rough.log10().floor() as i32;
    let lead = rough / 10f64.powi(exponent);
    let lead = [1.0, 2.0, 5.0].into_iter().find(|step| lead <= step * 1.0001).unwrap_or_else(|| {
        exponent += 1;
        1.0
    });
    let step = lead * 10f64.powi(exponent);
    // A step is lost where powers of ten run out; the ends still stand.
    if step.is_normal() {
        within(low / step, high / step)
            .map(|k| Tick {
                place: scale.place_measured(k as f64 * step),
                label: Some(decimal(k as f64 * lead, exponent, low.abs().max(high.abs()))),
            })
            .collect()
    } else {
        Vec::new()
    }
}

/// Whole numbers from `low` to `high`, with a hair's breadth of tolerance so that ends count.
fn within(low: f64, high: f64) -> std::ops::RangeInclusive<i64> {
    let hair = 1e-6;
    (low - hair).ceil() as i64..=(high + hair).floor() as i64
}

/// `lead * 10^exponent`, plain or as a power, as suits the largest value on the axis.
fn decimal(lead: f64, exponent: i32, largest: f64) -> String {
    if lead == 0.0 {
        return "0".into();
    }
    if (1e-3..1e5).contains(&largest) {
        let digits = (-exponent).clamp(0, 12) as usize;
        return minus(&grouped(&format!("{:.digits$}", lead * 10f64.powi(exponent))));
    }
    // All labels of an axis carry the power of its largest value.
    let power = largest.log10().floor() as i32;
    let digits = (power - exponent).clamp(0, 12) as usize;
    format!("{}×{}", minus(&format!("{:.digits$}", lead * 10f64.powi(exponent - power))), power_of_ten(power))
}

/// Whole numbers of five digits and more in groups of three, as in the text of a report.
fn grouped(number: &str) -> String {
    let digits = number.trim_start_matches('-');
    if number.contains('.') || digits.len() < 5 {
        return number.to_owned();
    }
    let sign = &number[..number.len() - digits.len()];
    let (first, rest) = digits.split_at((digits.len() - 1) % 3 + 1);
    let groups = rest.as_bytes().chunks(3).map(|group| String::from_utf8_lossy(group));
    groups.fold(format!("{sign}{first}"), |text, group| format!("{text},{group}"))
}

fn minus(number: &str) -> String {
    number.replace('-', "−")
}

/// Logarithmic axes up to this power of ten have plain numbers.
const PLAIN: f64 = 5.301;

/// Powers of ten, thinned to every 2nd, 3rd, 5th ... as needed; within few decades, parts of them.
fn log(scale: &Scale, count: usize) -> Vec<Tick> {
    let (low, high) = scale.bounds();
    let decades = high - low;
    let whole = within(low, high).count();
    if whole < 2 && decades < 0.7 {
        return within_a_decade(scale, count);
    }
    let step = [1, 2, 3, 5, 10, 20, 50, 100, 200, 500]
        .into_iter()
        .find(|step| decades / f64::from(*step) <= count as f64)
        .unwrap_or(1000);
    let plain = low >= -3.001 && high <= PLAIN;
    let name = |lead: u8, power: i64| match (plain, lead) {
        (true, _) => {
            grouped(&format!("{:.*}", (-power).max(0) as usize, f64::from(lead) * 10f64.powi(power as i32)))
        }
        (false, 1) => power_of_ten(power as i32),
        (false, _) => format!("{lead}×{}", power_of_ten(power as i32)),
    };
    let mut ticks = Vec::new();
    // One power beyond each end, for the parts of its decade that lie inside.
    for power in low.floor() as i64 - 1..=high.ceil() as i64 {
        let leads = if step == 1 && decades < 11.0 { 1..=9u8 } else { 1..=1 };
        for lead in leads {
            let value = power as f64 + f64::from(lead).log10();
            if value < low - 1e-6 || value > high + 1e-6 {
                continue;
            }
            let labelled = match lead {
                1 => power.rem_euclid(step.into()) == 0,
                2 | 5 => (plain && decades * 3.0 <= count as f64) || whole < 2,
                _ => false,
            };
            let label = labelled.then(|| name(lead, power));
            ticks.push(Tick { place: scale.place_measured(value), label });
        }
    }
    ticks
}

/// A logarithmic axis that holds no power of ten to speak of is labelled at round values.
fn within_a_decade(scale: &Scale, count: usize) -> Vec<Tick> {
    let (low, high) = scale.bounds();
    let power = low.floor();
    let values =
        Scale { spread: Spread::Linear, from: 10f64.powf(low - power), to: 10f64.powf(high - power) };
    let mut ticks = linear(&values, count);
    let power = power as i32;
    for tick in &mut ticks {
        let value = values.from + tick.place * (values.to - values.from);
        tick.place = scale.place_measured(value.log10() + f64::from(power));
        if !(-3..4).contains(&power) {
            tick.label = tick.label.take().map(|label| format!("{label}×{}", power_of_ten(power)));
        } else if power != 0 {
            // As many digits as the label had, at the right place.
            let digits =
                tick.label.as_ref().and_then(|label| label.split_once('.')).map_or(0, |(_, part)| part.len());
            let digits = (digits as i32 - power).max(0) as usize;
            tick.label = Some(format!("{:.digits$}", value * 10f64.powi(power)));
        }
    }
    ticks
}

/// "10⁻⁶".
pub(super) fn power_of_ten(power: i32) -> String {
    let raised = power.to_string();
    let raised = raised.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    });
    std::iter::once('1').chain(std::iter::once('0')).chain(raised).collect()
}

/// Values beyond this are not shown: their differences would overflow.
const LARGEST: f64 = 1e300;

/// A range of values laid on a stretch of the page. The ends are in the axis's own measure: values,
/// or their decimal logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) spread: Spread,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Scale {
    /// The axis's own range, or that of the values with some room at both ends. `tight` leaves no
    /// room below a lowest value of zero, where bars and shares stand.
    pub(super) fn new(axis: &Axis, values: impl Iterator<Item = f64>, tight: bool) -> Self {
        let spread = axis.spread;
        if let Some((from, to)) = axis.range
            && let (Some(from), Some(to)) = (measure(spread, from), measure(spread, to))
            && apart(from, to)
        {
            return Self { spread, from, to };
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let zero = axis.zero.then_some(0.0);
        for value in values.chain(zero).filter_map(|value| measure(spread, value)) {
            low = low.min(value);
            high = high.max(value);
        }
        if low > high {
            return Self { spread, from: 0.0, to: 1.0 };
        }
        if !apart(low, high) {
            // One value only: it stands in the middle.
            let room = match spread {
                Spread::Log => 0.5,
                Spread::Linear if low == 0.0 => 1.0,
                Spread::Linear => 0.5 * low.abs(),
            };
            return Self { spread, from: low - room, to: high + room };
        }
        let room = 0.03 * (high - low);
        let from = if tight && low == 0.0 && spread == Spread::Linear { low } else { low - room };
        Self { spread, from, to: high + room }
    }

    /// Position of a value, 0 at the beginning of the axis and 1 at its end; values outside lie
    /// beyond. None for what the axis cannot show.
    pub(super) fn place(&self, value: f64) -> Option<f64> {
        measure(self.spread, value).map(|value| self.place_measured(value))
    }

    /// As [`Scale::place`], for a value in the axis's own measure.
    pub(super) fn place_measured(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }

    /// The lowest and highest shown, in the axis's own measure.
    pub(super) fn bounds(&self) -> (f64, f64) {
        (self.from.min(self.to), self.from.max(self.to))
    }
}

/// A value in the axis's own measure, if it has one.
pub(super) fn measure(spread: Spread, value: f64) -> Option<f64> {
    match spread {
        Spread::Linear => (value.abs() <= LARGEST).then_some(value),
        Spread::Log => (value > 0.0 && value <= LARGEST).then(|| value.log10()),
    }
}

/// Whether two values differ by more than the last digits, which no axis can divide.
fn apart(from: f64, to: f64) -> bool {
    (to - from).abs() > 1e-9 * from.abs().max(to.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(spread: Spread, from: f64, to: f64, most: usize) -> Vec<String> {
        let ends = |v: f64| if spread == Spread::Log { v.log10() } else { v };
        let scale = Scale { spread, from: ends(from), to: ends(to) };
        ticks(&scale, most, |_| true).into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn labels_are_round_and_as_many_as_fit() {
        use Spread::{Linear, Log};
        for (spread, from, to, most, expected) in [
            (Linear, 0.0, 2.0, 5, "0 0.5 1.0 1.5 2.0"),
            (Linear, 4.0, 0.0, 5, "0 1 2 3 4"),
            // Rather five labels than one.
            (Linear, -0.45, 0.42, 4, "−0.4 −0.2 0 0.2 0.4"),
            (Linear, -2e-7, 2e-7, 5, "−2×10⁻⁷ −1×10⁻⁷ 0 1×10⁻⁷ 2×10⁻⁷"),
            (Linear, 0.0, 40_000.0, 2, "0 20,000 40,000"),
            (Log, 1e-9, 1e-2, 8, "10⁻⁹ 10⁻⁸ 10⁻⁷ 10⁻⁶ 10⁻⁵ 10⁻⁴ 10⁻³ 10⁻²"),
            (Log, 1e-15, 1.0, 8, "10⁻¹⁴ 10⁻¹² 10⁻¹⁰ 10⁻⁸ 10⁻⁶ 10⁻⁴ 10⁻² 10⁰"),
            (Log, 3.0, 300.0, 8, "5 10 20 50 100 200"),
            (Log, 3.0, 20_000.0, 8, "10 100 1000 10,000"),
            (Log, 0.01, 10.0, 6, "0.01 0.1 1 10"),
            (Log, 2e-6, 3e-6, 3, "2.0×10⁻⁶ 2.5×10⁻⁶ 3.0×10⁻⁶"),
            (Log, 0.02, 0.04, 3, "0.02 0.03 0.04"),
        ] {
            assert_eq!(labels(spread, from, to, most).join(" "), expected);
        }
        assert!(labels(Log, 1e-300, 1e300, 8).len() <= 8 && labels(Log, 2.0, 3.0, 6).len() >= 2);
        assert_eq!(grouped("-1234567"), "-1,234,567");
    }

    /// Labels that all together do not fit are halved rather than reduced to one.
    #[test]
    fn rather_every_second_label_than_one() {
        let scale = Scale { spread: Spread::Log, from: 16f64.log10(), to: 375f64.log10() };
        let of = |most: usize| -> Vec<String> {
            let fits = |ticks: &[Tick]| ticks.iter().filter(|tick| tick.label.is_some()).count() <= most;
            ticks(&scale, 4, fits).into_iter().filter_map(|tick| tick.label).collect()
        };
        assert_eq!(of(4), ["20", "50", "100", "200"]);
        assert_eq!(of(2), ["20", "100"]);
        assert_eq!(of(1), ["100"]);
    }

    fn scale(axis: Axis, values: &[f64]) -> Scale {
        Scale::new(&axis, values.iter().copied(), false)
    }

    #[test]
    fn log_axes_skip_what_has_no_logarithm() {
        let scale = scale(Axis::log(""), &[-1.0, 0.0, f64::NAN, f64::INFINITY, 1e-6, 1e-2]);
        assert!(scale.from < -6.0 && scale.from > -6.2);
        assert!(scale.to > -2.0 && scale.to < -1.8);
        assert_eq!(scale.place(0.0), None);
        assert_eq!(scale.place(-1.0), None);
    }

    #[test]
    fn one_value_stands_in_the_middle() {
        for (axis, value) in [(Axis::linear(""), 3.0), (Axis::linear(""), 0.0), (Axis::log(""), 1e-9)] {
            let place = scale(axis, &[value, value]).place(value).unwrap();
            assert!((place - 0.5).abs() < 1e-12);
        }
    }

    #[test]
    fn a_falling_range_turns_the_axis() {
        let scale = scale(Axis::linear("").range(4.0, 0.0), &[]);
        assert_eq!(scale.place(4.0), Some(0.0));
        assert_eq!(scale.place(1.0), Some(0.75));
    }

    #[test]
    fn a_range_that_cannot_be_shown_gives_way_to_the_data() {
        assert_eq!(scale(Axis::log("").range(0.0, 1.0), &[1.0, 10.0]).from, -0.03);
        assert_eq!(scale(Axis::linear("").range(2.0, 2.0), &[0.0, 1.0]).to, 1.03);
        assert_eq!(scale(Axis::linear("").range(f64::NAN, 2.0), &[0.0, 1.0]).to, 1.03);
    }
}
