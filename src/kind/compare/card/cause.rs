//! Why the models differ, in the terms of the surface.

use asperity::compare::{Cause, ComparedQuantity, Contributions, Difference, Stretch, Verdict};
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{capitalised, number, percent};

use super::limit::size_in_signs;
use super::{Card, name};

/// A cause as a surface shows it, in three lengths.
pub(super) struct Words {
    /// With the statistics of the surface.
    pub(super) full: String,
    pub(super) sentence: String,
    /// In a cell of a table.
    pub(super) short: &'static str,
}

/// What is said of the causes of a difference.
enum Finding {
    /// One leads, with an interval apart from the others'.
    Leads(Cause),
    /// On this surface one is the largest in every order of replacement.
    Largest(Cause),
    /// Two of opposite signs, each larger than what is accepted, leave less than half of the smaller one.
    Cancel([Cause; 2]),
    /// None stands out.
    Open,
}

impl Card<'_> {
    /// The cause of the difference in the first quantity that is beyond what is accepted on the compared surface, else in the first.
    pub(super) fn cause(&self, at: &Difference) -> Option<String> {
        if self.verdicts().is_blocked {
            return None;
        }
        if let Some(reason) = self.undivided {
            return Some(fitting([
                format!("Not divided: {reason}."),
                "Not divided among causes.".to_owned(),
            ]));
        }
        let (quantity, parts) = self.divided(at)?;
        let of = |cause: Cause| self.words(cause, at.load);
        let second = |first: Cause| {
            let size = |cause: Cause| parts.part(first).signum() * parts.part(cause);
            let others = Cause::ALL.into_iter().filter(|other| *other != first);
            others
                .max_by(|a, b| size(*a).total_cmp(&size(*b)))
                .filter(|other| 2.0 * size(*other) >= size(first))
        };
        let finding = self.finding(quantity, parts);
        let is_within = self.on_this_map(at).iter().all(|(_, verdict)| *verdict == Verdict::Within);
        // Where the models agree, only that causes cancel is worth a word.
        if is_within && !matches!(finding, Finding::Cancel(_)) {
            return None;
        }
        Some(match finding {
            Finding::Leads(first) => one_or_two("", of(first), second(first).map(of)),
            Finding::Largest(first) => {
                let scope = self.scope().to_lowercase();
                one_or_two(&format!("Largest {scope}: "), of(first), second(first).map(of))
            }
            Finding::Cancel([a, b]) => {
                let [a, b] = [a, b].map(of);
                let of = name(quantity);
                fitting([
                    format!("Two causes nearly cancel in {of}: {}; {}.", a.full, b.full),
                    format!("Two causes nearly cancel in {of}: {}; {}.", a.sentence, b.sentence),
                    format!("Two causes nearly cancel in {of}: {}, {}.", a.short, b.short),
                ])
            }
            Finding::Open => {
                let each = Cause::ALL.map(|cause| {
                    format!("{} {}", short_name(cause), size_in_signs(quantity, [parts.part(cause); 2]))
                });
                let of_quantity = format!("in {}", name(quantity));
                fitting([
                    format!("No cause stands out {of_quantity}: {}.", each.join(", ")),
                    "No cause stands out.".to_owned(),
                ])
            }
        })
    }

    /// The cause of the largest difference that is beyond what is accepted on such surfaces, in the first quantity where there is one, in a
    /// few words for a table; empty where there is none.
    pub(super) fn cause_in_short(&self) -> String {
        if self.undivided.is_some() {
            return "not divided".to_owned();
        }
        let verdicts = self.verdicts();
        let of_quantity = |quantity: ComparedQuantity| {
            let beyond =
                verdicts.stretches.iter().filter(|one| one.quantity == quantity && one.verdict.is_beyond());
            let [from, to] = beyond.max_by(|a, b| largest(a).total_cmp(&largest(b)))?.loads;
            let divided = verdicts.divided(quantity).filter(|(load, _)| (from..=to).contains(load));
            let (load, parts) = divided.max_by(|a, b| a.1.gap().abs().total_cmp(&b.1.gap().abs()))?;
            Some((quantity, load, parts))
        };
        let found = ComparedQuantity::REPORTED.into_iter().find_map(of_quantity);
        let Some((quantity, load, parts)) = found.filter(|_| !verdicts.is_blocked) else {
            return String::new();
        };
        let short = |cause: Cause| self.words(cause, load).short;
        let text = match self.finding(quantity, parts) {
            Finding::Leads(cause) => short(cause).to_owned(),
            Finding::Largest(cause) => format!("{} (here)", short(cause)),
            Finding::Cancel(_) => "two causes nearly cancel".to_owned(),
            Finding::Open => "none stands out".to_owned(),
        };
        if quantity == ComparedQuantity::Area { text } else { format!("{}: {text}", name(quantity)) }
    }

    /// The quantity whose difference is explained, with its parts at the load.
    fn divided(&self, at: &Difference) -> Option<(ComparedQuantity, &Contributions)> {
        let all = self.on_this_map(at);
        let beyond = all.iter().filter(|(_, verdict)| *verdict == Verdict::Beyond).chain(&all);
        beyond
            .map(|(quantity, _)| *quantity)
            .find_map(|quantity| Some((quantity, self.verdicts().contributions(quantity, at.load)?)))
    }

    fn finding(&self, quantity: ComparedQuantity, parts: &Contributions) -> Finding {
        let accepted = self.verdicts().accepted.band(quantity)[1];
        let mut by_size = Cause::ALL;
        by_size.sort_by(|a, b| parts.part(*b).abs().total_cmp(&parts.part(*a).abs()));
        let [first, second, _] = by_size;
        let smaller = parts.part(second);
        if parts.part(first) * smaller < 0.0
            && smaller.abs() > accepted
            && 2.0 * parts.gap().abs() < smaller.abs()
        {
            return Finding::Cancel([first, second]);
        }
        let largest = || parts.largest().filter(|_| self.verdicts().has_one_surface()).map(Finding::Largest);
        parts.leading().map(Finding::Leads).or_else(largest).unwrap_or(Finding::Open)
    }

    /// A cause in the direction that its contributions at the load have.
    fn words(&self, cause: Cause, load: f64) -> Words {
        let statistics = self.surface.reported_statistics();
        let part = |quantity| Some(self.verdicts().contributions(quantity, load)?.part(cause));
        match cause {
            Cause::Heights => {
                heights(part(ComparedQuantity::Separation), statistics.skewness.zip(statistics.kurtosis))
            }
            Cause::Radii => Words {
                full: format!("radii differ (scatter {} of the mean)", percent(statistics.radius_cv)),
                sentence: "radii differ".to_owned(),
                short: "spread of radii",
            },
            Cause::Correlation if statistics.radius_cv == 0.0 => Words {
                full: "the highest asperities are few".to_owned(),
                sentence: "the highest asperities are few".to_owned(),
                short: "few asperities",
            },
            Cause::Correlation => {
                correlation(part(ComparedQuantity::Area), statistics.height_radius_correlation)
            }
        }
    }
}

/// The size of the largest difference of a stretch.
fn largest(stretch: &Stretch) -> f64 {
    stretch.largest.map_or(0.0, |(_, estimate)| estimate.contrast.abs())
}

/// Heights: the integral, which has none of them, touches at a smaller separation where there are more high asperities than it assumes.
fn heights(separation: Option<f64>, moments: Option<(f64, f64)>) -> Words {
    let (direction, short) = match separation {
        Some(part) if part < 0.0 => (": more high ones than the integral assumes", "more high asperities"),
        Some(part) if part > 0.0 => (": fewer high ones than the integral assumes", "fewer high asperities"),
        _ => (" are not those that the integral assumes", "height distribution"),
    };
    let moments = moments.map_or_else(String::new, |(skewness, kurtosis)| {
        format!(" (skewness {}, kurtosis {})", number(skewness), number(kurtosis))
    });
    Words {
        full: format!("asperity heights{moments}{direction}"),
        sentence: format!("asperity heights{direction}"),
        short,
    }
}

/// Heights and radii: where high asperities are sharper, the sum has the smaller area.
fn correlation(area: Option<f64>, coefficient: Option<f64>) -> Words {
    let is_sharper = area.map(|part| part > 0.0).or(coefficient.map(|r| r < 0.0));
    let (sharper, short) = match is_sharper {
        Some(true) => ("sharper", "high asperities sharper"),
        Some(false) => ("blunter", "high asperities blunter"),
        None => {
            let sentence = "radii change with the height".to_owned();
            return Words { full: sentence.clone(), sentence, short: "radii change with height" };
        }
    };
    let sentence = format!("high asperities are {sharper} than low ones");
    // The coefficient is that of all asperities; those in contact may tell another story.
    let is_same = |r: &f64| is_sharper == Some(*r < 0.0);
    let full = coefficient.filter(is_same).map_or_else(
        || sentence.clone(),
        |r| format!("{sentence} (correlation of height and radius {})", number(r)),
    );
    Words { full, sentence, short }
}

fn short_name(cause: Cause) -> &'static str {
    match cause {
        Cause::Heights => "heights",
        Cause::Radii => "radii",
        Cause::Correlation => "correlation",
    }
}

/// One cause, then another, as full as the words allow.
fn one_or_two(prefix: &str, first: Words, second: Option<Words>) -> String {
    let sentence = |text: String| {
        let text = if prefix.is_empty() { capitalised(&text) } else { text };
        format!("{prefix}{text}.")
    };
    let Some(second) = second else { return fitting([sentence(first.full), sentence(first.sentence)]) };
    fitting([
        sentence(format!("{}; then: {}", first.full, second.full)),
        sentence(format!("{}; then: {}", first.full, second.sentence)),
        sentence(format!("{}; then: {}", first.sentence, second.sentence)),
        sentence(first.full.clone()),
        sentence(first.sentence.clone()),
    ])
}

#[cfg(test)]
mod tests {
    use asperity::compare::{Attribution, Contribution};
    use asperity::study::Verdicts;

    use super::super::tests::{estimate, verdicts, with_card};
    use super::*;

    /// Verdicts whose difference in area is divided into these parts of heights, radii and correlation; the separation has their opposites.
    fn divided(parts: [f64; 3], error: Option<f64>) -> Verdicts {
        let of = |sign: f64| {
            let causes = parts.map(|part| Contribution::from(estimate(sign * part, error)));
            Contributions {
                total: estimate(sign * parts.iter().sum::<f64>(), error),
                causes,
                radii: causes[1],
                with_other_radius: None,
            }
        };
        let gap = parts.iter().sum();
        let mut verdicts = verdicts(90.0, [gap, gap], Some(0.01));
        let load = verdicts.differences[0].load;
        verdicts.attribution =
            vec![Attribution { load, quantities: [Some(of(-1.0)), Some(of(1.0)), None, None, None, None] }];
        verdicts
    }

    fn text(parts: [f64; 3], error: Option<f64>) -> String {
        with_card(divided(parts, error), |card, at| card.cause(at)).unwrap()
    }

    #[test]
    fn a_cause_speaks_of_the_surface_in_the_direction_of_its_contribution() {
        let sure = Some(0.001);
        for (parts, error, words) in [
            ([-0.3, 0.0, -0.01], sure, "fewer high ones than the integral assumes"),
            ([0.0, 0.01, 0.3], sure, "sharper than low ones (correlation of height and radius -1)."),
            // The coefficient, -1, would contradict it.
            ([0.0, -0.01, -0.3], sure, "High asperities are blunter than low ones."),
            ([0.4, 0.0, -0.35], sure, "Two causes nearly cancel in contact area: asperity heights"),
            ([0.3, 0.0, 0.01], None, "Largest on these asperities: asperity heights"),
            ([0.15, 0.15, 0.01], None, "No cause stands out in contact area: heights +16.2 %, radii +16.2 %"),
        ] {
            let text = text(parts, error);
            assert!(text.contains(words), "{text}");
        }
        assert!(!text([0.4, 0.0, -0.1], sure).contains("cancel"));
    }

    #[test]
    fn radii_of_which_nothing_is_known_are_neither_sharper_nor_blunter() {
        let short = |area, coefficient| correlation(area, coefficient).short;
        assert_eq!(short(None, None), "radii change with height");
        assert_eq!(short(None, Some(0.3)), "high asperities blunter");
        assert_eq!(short(Some(0.1), Some(0.3)), "high asperities sharper");
    }
}
