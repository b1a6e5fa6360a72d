//! What to use instead of the integral.

use asperity::MeanRadius;
use asperity::compare::{ComparedQuantity, Difference, Verdict};
use asperity::distribution::HeightModel;
use asperity::numeric::two_digits;
use asperity::study::{Against, HeldOut, JointModel, Ranked, Ranking, StatisticalModel};
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{alternatives, capitalised, number};

use super::limit::{is_steep, size_in_signs};
use super::{Card, State, name};
use crate::presentation::difference_unit;

enum Choice<'a> {
    /// The cheapest one within what is accepted in all quantities.
    Within(&'a Ranked),
    /// None is; this one is the nearest.
    Nearest(&'a Ranked),
}

impl Card<'_> {
    /// The cheapest statistical model within what is accepted, or that none is; the remedy where neither model may be used.
    pub(super) fn instead(&self, at: &Difference) -> Option<String> {
        match self.state(at) {
            State::Unfit => return None,
            State::NeitherModel => return Some(as_alternatives("", &self.remedies(at))),
            State::FewContacts => {
                return Some(as_alternatives(
                    "The sum on this surface; for such surfaces ",
                    &self.more_contacts(at),
                ));
            }
            State::Admissible => {}
        }
        if let Some(difference) = self.sum_beyond_reference(at) {
            return Some(format!(
                "Boundary elements: the sum differs from them by {difference} in contact area."
            ));
        }
        if self.is_integral_enough(at) {
            return Some("Nothing else: the integral is within what is accepted.".to_owned());
        }
        let Some((choice, ranking)) = self.choice() else {
            return Some("The sum over the asperities.".to_owned());
        };
        Some(match choice {
            Choice::Within(ranked) => {
                let model = capitalised(&words(&ranked.model));
                let sizes = self.sizes(ranked);
                let on = tested_on(ranked, ranking);
                fitting([
                    format!("{model}: {} within {}{on}.", sizes[0].0, sizes[0].1),
                    format!("{model}: {} within {}.", sizes[0].0, sizes[0].1),
                ])
            }
            Choice::Nearest(ranked) => {
                let worst = self.worst(ranked);
                let model = words(&ranked.model);
                let size = worst
                    .map_or_else(String::new, |(quantity, size)| format!(" ({} {size})", name(quantity)));
                fitting([
                    format!("The sum: no statistical model is near enough; nearest overall: {model}{size}."),
                    format!("The sum: no statistical model is near enough{size}."),
                ])
            }
        })
    }

    /// The model to use in a cell of a table; empty where nothing is known.
    pub(super) fn instead_in_short(&self, at: &Difference) -> String {
        match self.state(at) {
            State::Unfit => "a fit map".to_owned(),
            State::NeitherModel if is_steep(at) || self.leaves_yielding_out() => {
                "a filter or lower loads".to_owned()
            }
            State::NeitherModel => "boundary elements".to_owned(),
            State::FewContacts => "the sum".to_owned(),
            State::Admissible if self.sum_beyond_reference(at).is_some() => "boundary elements".to_owned(),
            State::Admissible if self.is_integral_enough(at) => "the integral".to_owned(),
            State::Admissible => match self.choice() {
                Some((Choice::Within(ranked), _)) => format!("`{}`", ranked.model.name()),
                _ => "the sum".to_owned(),
            },
        }
    }

    /// Whether the integral is within what is accepted from the sum in all quantities, surely or very likely.
    fn is_integral_enough(&self, at: &Difference) -> bool {
        self.of_such_surfaces(at).iter().all(|(_, verdict)| verdict.is_within())
    }

    /// The difference in area of the sum from boundary elements at the load, where it is beyond what is accepted, whatever another solution in
    /// their bounds would give; `None` where they stay elastic while the sum yields.
    fn sum_beyond_reference(&self, at: &Difference) -> Option<String> {
        if self.leaves_yielding_out() {
            return None;
        }
        let [_, sum] = &self.verdicts().reference.as_ref()?.against.models;
        let of_sum = sum.iter().find(|one| one.load == at.load)?;
        let estimate = of_sum.estimates[ComparedQuantity::Area as usize]?.here();
        let is_beyond =
            Verdict::from_estimate(&estimate, self.verdicts().accepted.band(ComparedQuantity::Area))
                .is_beyond();
        is_beyond.then(|| size_in_signs(ComparedQuantity::Area, [estimate.contrast; 2]))
    }

    /// The model to use by the ranking; `None` where there is none.
    fn choice(&self) -> Option<(Choice<'_>, &Ranking)> {
        let ranking = self.case.ranking.as_ref()?;
        let compared: Vec<&Ranked> =
            ranking.models.iter().filter(|ranked| self.excess(ranked).is_some()).collect();
        let within = compared.iter().filter(|ranked| self.excess(ranked).is_some_and(|excess| excess <= 1.0));
        let cheapest = within.min_by(|a, b| a.evaluations.total_cmp(&b.evaluations));
        let nearest = || {
            compared.iter().min_by(|a, b| {
                self.excess(a).partial_cmp(&self.excess(b)).unwrap_or(std::cmp::Ordering::Equal)
            })
        };
        let choice = match cheapest {
            Some(ranked) => Choice::Within(ranked),
            None => Choice::Nearest(nearest()?),
        };
        Some((choice, ranking))
    }

    /// The largest difference of a model from the sum over what is accepted, of all quantities; `None` where one has none.
    fn excess(&self, ranked: &Ranked) -> Option<f64> {
        let each = self.compared().map(|quantity| self.relative(ranked, quantity));
        each.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
    }

    fn relative(&self, ranked: &Ranked, quantity: ComparedQuantity) -> Option<f64> {
        let (contrast, _) = ranked.ranked_by(Against::Sum, quantity)?;
        Some(quantity.reported(contrast).abs() / self.verdicts().accepted.limit(quantity))
    }

    /// The quantities that are compared at some load.
    fn compared(&self) -> impl Iterator<Item = ComparedQuantity> {
        let differences = &self.verdicts().differences;
        let is_compared = |quantity: &ComparedQuantity| {
            differences.iter().any(|at| at.estimates[*quantity as usize].is_some())
        };
        ComparedQuantity::REPORTED.into_iter().filter(is_compared)
    }

    /// The largest differences of a model, quantity by quantity.
    fn sizes(&self, ranked: &Ranked) -> Vec<(&'static str, String)> {
        let size = |quantity: ComparedQuantity| Some((name(quantity), size(quantity, ranked)?));
        self.compared().filter_map(size).collect()
    }

    /// The quantity in which a model is farthest from what is accepted.
    fn worst(&self, ranked: &Ranked) -> Option<(ComparedQuantity, String)> {
        let by_excess = |a: &ComparedQuantity, b: &ComparedQuantity| {
            let [a, b] = [a, b].map(|quantity| self.relative(ranked, *quantity).unwrap_or(0.0));
            a.total_cmp(&b)
        };
        let quantity = self.compared().max_by(by_excess)?;
        Some((quantity, size(quantity, ranked)?))
    }
}

/// The largest difference of a model in a quantity: "8.1 %".
fn size(quantity: ComparedQuantity, ranked: &Ranked) -> Option<String> {
    let (contrast, _) = ranked.ranked_by(Against::Sum, quantity)?;
    let (unit, factor) = difference_unit(quantity);
    Some(format!("{} {unit}", number(two_digits((factor * quantity.reported(contrast)).abs()))))
}

/// Where the largest difference of a model was found.
fn tested_on(ranked: &Ranked, ranking: &Ranking) -> &'static str {
    match ranking.tested_on.filter(|_| ranked.model.is_fitted()) {
        Some(HeldOut::MapHalves) => " on the other half of the map",
        Some(HeldOut::RandomHalves) => " on the other half of the asperities",
        Some(HeldOut::Realisations(_)) => " on the other realisations",
        None => " on this surface",
    }
}

fn words(model: &StatisticalModel) -> String {
    if let Some(joint) = model.joint {
        return match joint {
            JointModel::NayakGreenwood => "Nayak's summits of a Gaussian surface".to_owned(),
            JointModel::FivePoint => "five-point summits of a Gaussian surface".to_owned(),
        };
    }
    let heights = match &model.heights {
        None => "Gaussian heights".to_owned(),
        Some(HeightModel::Own) => "the surface's own heights".to_owned(),
        Some(HeightModel::FittedWeibull) => "Weibull heights".to_owned(),
        Some(HeightModel::FittedJohnson) => "Johnson heights".to_owned(),
        Some(HeightModel::Given(given)) => format!("{} heights", capitalised(given.name())),
    };
    let radius = match model.mean_radius {
        MeanRadius::Arithmetic => "the arithmetic mean radius",
        MeanRadius::InverseMeanCurvature => "the radius of the mean curvature",
        MeanRadius::InContact => "the mean radius in contact",
    };
    format!("{heights} with {radius}")
}

/// As many of some ways, the first first, as the words allow.
fn as_alternatives(prefix: &str, ways: &[String]) -> String {
    let text = |count: usize| {
        let ways = alternatives(&ways[..count]);
        let ways = if prefix.is_empty() { capitalised(&ways) } else { ways };
        format!("{prefix}{ways}.")
    };
    fitting((1..=ways.len()).rev().map(text))
}

#[cfg(test)]
mod tests {
    use asperity::bem::Boundary;
    use asperity::compare::{AgainstReference, ReferenceCurve};
    use asperity::study::{LargestErrors, ReferenceVerdicts};

    use super::super::tests::{verdicts, with_case};
    use super::*;

    /// A model whose area differs by so much in sample, and held out.
    fn ranked(heights: HeightModel, area: f64, held_out: Option<f64>, evaluations: f64) -> Ranked {
        let errors = |area: f64| LargestErrors {
            from_sum: [None, Some((area.ln_1p(), 1e6)), None, None, None, None],
            from_reference: [None; 6],
        };
        let model =
            StatisticalModel { heights: Some(heights), mean_radius: MeanRadius::InContact, joint: None };
        Ranked { model, in_sample: errors(area), held_out: held_out.map(errors), evaluations }
    }

    fn text(contrast: f64, models: Vec<Ranked>) -> String {
        let ranking = Ranking { models, tested_on: Some(HeldOut::MapHalves), ..Ranking::default() };
        with_case(
            verdicts(90.0, [contrast, contrast], Some(0.01)),
            |case| case.ranking = Some(ranking),
            |card, at| card.instead(at).unwrap(),
        )
    }

    #[test]
    fn the_cheapest_model_within_what_is_accepted_on_other_asperities_is_named() {
        let models = vec![
            ranked(HeightModel::Own, 0.01, Some(0.08), 90.0),
            ranked(HeightModel::FittedJohnson, 0.01, Some(0.3), 10.0),
            ranked(HeightModel::FittedWeibull, 0.01, Some(0.01), 200.0),
        ];
        assert_eq!(
            text(0.3, models),
            "The surface's own heights with the mean radius in contact: contact area within 8 % on the other half of the map."
        );
    }

    #[test]
    fn boundary_elements_come_first_where_the_sum_is_far_from_them() {
        let of = |contrast: f64, yields: bool| {
            let mut verdicts = verdicts(90.0, [0.01, 0.01], Some(0.01));
            let mut sum = verdicts.differences.clone();
            sum[0].estimates[1].as_mut().unwrap().contrast = contrast;
            let against = AgainstReference { models: [Vec::new(), sum], nearness: Vec::new() };
            verdicts.reference = Some(ReferenceVerdicts {
                against,
                stretches: [Vec::new(), Vec::new()],
                nearer: Vec::new(),
                yields,
                is_layered: false,
            });
            let elastic = ReferenceCurve {
                boundary: Boundary::Periodic,
                cap: None,
                interpolated: 0,
                points: Vec::new(),
                blocks: Vec::new(),
                clusters: Vec::new(),
                unreached: Vec::new(),
            };
            with_case(
                verdicts,
                |case| case.realisations[0].reference = Some(elastic),
                |card, at| [card.instead(at).unwrap(), card.instead_in_short(at)],
            )
        };
        assert_eq!(
            of(0.2, false),
            ["Boundary elements: the sum differs from them by +22.1 % in contact area.", "boundary elements"]
        );
        assert_eq!(
            of(0.05, false),
            ["Nothing else: the integral is within what is accepted.", "the integral"]
        );
        // Elastic boundary elements say nothing of a sum that yields.
        assert_eq!(of(0.2, true), of(0.05, false));
    }

    #[test]
    fn none_is_named_where_all_are_beyond_or_tested_on_their_own_asperities_only() {
        let far = text(0.3, vec![ranked(HeightModel::Own, 0.01, Some(0.52), 90.0)]);
        assert!(
            far.starts_with(
                "The sum: no statistical model is near enough; nearest overall: the surface's own"
            ),
            "{far}"
        );
        assert!(far.contains("(contact area 52 %)"), "{far}");
        let untested = text(0.3, vec![ranked(HeightModel::Own, 0.01, None, 90.0)]);
        assert_eq!(untested, "The sum over the asperities.");
        let within = text(0.01, vec![ranked(HeightModel::Own, 0.01, Some(0.01), 90.0)]);
        assert_eq!(within, "Nothing else: the integral is within what is accepted.");
    }
}
