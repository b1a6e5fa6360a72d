//! Which model is nearer to boundary elements.

use asperity::compare::{ComparedQuantity, Difference, ModelKind, NearerStretch};
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::listed;

use super::limit::size_in_signs;
use super::replace::stretch;
use super::{Card, State};
use crate::kind::compare::reference::SMALL_YIELDING;

/// Which model is nearer to boundary elements in contact area, over the admissible loads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nearer {
    /// The sum at some of them, the integral at none.
    Sum,
    /// The integral at some of them, the sum at none.
    Integral,
    ByLoad,
    Undecided,
}

impl Nearer {
    /// What a cell of a table says.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sum => "the sum",
            Self::Integral => "the integral",
            Self::ByLoad => "depends on load",
            Self::Undecided => "?",
        }
    }
}

impl Card<'_> {
    /// `None` where it was not computed, no such load is admissible, or the map is not fit.
    pub(super) fn nearer_over_loads(&self) -> Option<Nearer> {
        let stretches = self.nearer_by_load(ComparedQuantity::Area);
        if self.verdicts().is_blocked || stretches.is_empty() {
            return None;
        }
        let is_somewhere = |model| stretches.iter().any(|(_, nearer)| *nearer == Some(model));
        Some(match [ModelKind::Deterministic, ModelKind::Statistical].map(is_somewhere) {
            [true, true] => Nearer::ByLoad,
            [true, false] => Nearer::Sum,
            [false, true] => Nearer::Integral,
            [false, false] => Nearer::Undecided,
        })
    }

    /// Stretches of load (Pa) in their order, and which model is nearer over each.
    fn nearer_by_load(&self, compared: ComparedQuantity) -> Vec<([f64; 2], Option<ModelKind>)> {
        let is_one_map = self.verdicts().has_one_surface();
        let all = self.verdicts().reference.iter().flat_map(|reference| &reference.nearer);
        // Others hold for lower surfaces of the same shape.
        let is_compared = |one: &&NearerStretch| one.quantity == compared && one.beyond.is_none();
        let nearer = |one: &NearerStretch| if is_one_map { one.nearer_here } else { one.nearer };
        let mut stretches: Vec<_> = all.filter(is_compared).map(|one| (one.loads, nearer(one))).collect();
        stretches.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
        stretches
    }

    /// In contact area, or why that is not told.
    pub(super) fn nearer(&self, at: &Difference) -> Option<String> {
        if self.state(at) == State::Unfit {
            return None;
        }
        if self.surface.map.is_none() {
            return Some("Not possible: the surface has no map.".to_owned());
        }
        let Some(curve) = &self.case.first().reference else {
            if !self.can_be_pressed() {
                return Some("Not possible: more than 1 % of the map is missing; boundary elements need a part without holes (`crop`).".to_owned());
            }
            return Some(
                "Not computed: it needs `models = [\"statistical\", \"deterministic\", \"reference\"]`."
                    .to_owned(),
            );
        };
        if curve.unreached.contains(&at.load) {
            return Some("None: no contact carries so high a pressure.".to_owned());
        }
        if self.verdicts().reference.is_none() {
            return Some("Not told: no load was compared with them.".to_owned());
        }
        let elastic = if self.is_elastic_alone() { " (elastic ones)" } else { "" };
        let area = self.nearer_in(ComparedQuantity::Area, &format!("contact area{elastic}"), at.load);
        Some(area.unwrap_or_else(|| "Not told: no load of theirs is admissible.".to_owned()))
    }

    /// The same in the conductance that is asked for; of both the electrical one.
    pub(super) fn nearer_in_conductance(&self, at: &Difference) -> Option<String> {
        let conductances = [ComparedQuantity::ElectricalConductance, ComparedQuantity::ThermalConductance];
        let name = if self.is_elastic_alone() { "conductance (elastic ones)" } else { "conductance" };
        let is_told = self.state(at) != State::Unfit;
        let found = conductances.into_iter().filter(|_| is_told).find_map(|one| self.nearest_parts(one));
        // The differences stand with the conductance.
        found.map(|parts| format!("In {name} {parts}."))
    }

    /// Whether the sum yields and the boundary elements do not.
    fn is_elastic_alone(&self) -> bool {
        let is_elastic = self.case.first().reference.as_ref().is_some_and(|curve| curve.cap.is_none());
        is_elastic && self.verdicts().reference.as_ref().is_some_and(|reference| reference.yields)
    }

    /// Whether the boundary elements stay elastic at the load of the card while contacts of the sum yield there.
    pub(super) fn leaves_yielding_out(&self) -> bool {
        let at_load = self.case.results_at_load();
        let sum = at_load.models.iter().find(|one| one.model == Some(ModelKind::Deterministic));
        let elastic = sum.and_then(|sum| sum.point.shares).map(|shares| shares[0]);
        self.is_elastic_alone() && elastic.is_none_or(|share| share < 1.0 - SMALL_YIELDING)
    }

    /// A text in which boundary elements that are elastic where the sum yields are called so.
    pub(super) fn elastic(&self, text: String) -> String {
        if self.is_elastic_alone() {
            text.replace("boundary elements", "elastic boundary elements")
        } else {
            text
        }
    }

    /// "In contact area the sum, from 1 to 40 MPa; at this load sum -5 %, integral +82 % against them."; `None` without admissible loads.
    fn nearer_in(&self, compared: ComparedQuantity, name: &str, load: f64) -> Option<String> {
        let nearest = self.nearest_parts(compared)?;
        let sizes =
            self.sizes_against_reference(compared, load).map_or_else(String::new, |[integral, sum]| {
                format!("; at this load sum {sum}, integral {integral} against them")
            });
        Some(fitting([
            format!("In {name} {nearest}{sizes}."),
            format!("In {name} {nearest}."),
            format!("In {name} it changes with the load{sizes}."),
        ]))
    }

    /// "the sum from 1 to 40 MPa; undecided at 50 MPa"; `None` without admissible loads.
    fn nearest_parts(&self, compared: ComparedQuantity) -> Option<String> {
        let stretches = self.nearer_by_load(compared);
        let said = [
            (Some(ModelKind::Deterministic), "the sum"),
            (Some(ModelKind::Statistical), "the integral"),
            (None, "undecided"),
        ];
        let parts = said.into_iter().filter_map(|(model, words)| {
            let groups = stretches.chunk_by(|a, b| a.1 == b.1).filter(|group| group[0].1 == model);
            let loads: Vec<String> =
                groups.map(|group| stretch([group[0].0[0], group[group.len() - 1].0[1]])).collect();
            (!loads.is_empty()).then(|| format!("{words} {}", listed(&loads)))
        });
        let parts: Vec<String> = parts.collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The differences of integral and sum in a quantity from the reference at a load.
    fn sizes_against_reference(&self, compared: ComparedQuantity, load: f64) -> Option<[String; 2]> {
        let models = &self.verdicts().reference.as_ref()?.against.models;
        let size = |model: usize| {
            let at = models[model].iter().find(|at| at.load == load)?;
            let contrast = at.estimates[compared as usize]?.contrast;
            Some(size_in_signs(compared, [contrast; 2]))
        };
        Some([size(0)?, size(1)?])
    }
}

#[cfg(test)]
mod tests {
    use asperity::Limit;
    use asperity::compare::{AgainstReference, Verdict};
    use asperity::study::{Basis, ReferenceVerdicts, Verdicts};

    use super::super::tests::{estimate, verdicts, with_card};
    use super::*;

    const SUM: Option<ModelKind> = Some(ModelKind::Deterministic);
    const INTEGRAL: Option<ModelKind> = Some(ModelKind::Statistical);

    /// Of the compared surface; of such surfaces it is the integral.
    fn stretch(nearer_here: Option<ModelKind>) -> NearerStretch {
        NearerStretch {
            quantity: ComparedQuantity::Area,
            loads: [1e6, 2e6],
            beyond: None,
            nearer: INTEGRAL,
            nearer_here,
            verdicts: [Verdict::CannotTell; 2],
            verdicts_here: [Verdict::CannotTell; 2],
            largest: [(1e6, estimate(0.1, None)); 2],
        }
    }

    fn compared(nearer: Vec<NearerStretch>) -> Verdicts {
        let against = AgainstReference::default();
        let reference = ReferenceVerdicts {
            against,
            stretches: [const { Vec::new() }; 2],
            nearer,
            yields: false,
            is_layered: false,
        };
        Verdicts { reference: Some(reference), ..verdicts(90.0, [0.2, 0.3], None) }
    }

    fn over_loads(verdicts: Verdicts) -> Option<Nearer> {
        with_card(verdicts, |card, _| card.nearer_over_loads())
    }

    #[test]
    fn a_model_is_the_nearer_one_where_the_other_is_at_no_load() {
        let of = |nearer: &[_]| over_loads(compared(nearer.iter().map(|one| stretch(*one)).collect()));
        assert_eq!(of(&[SUM, None]), Some(Nearer::Sum));
        assert_eq!(of(&[INTEGRAL]), Some(Nearer::Integral));
        assert_eq!(of(&[SUM, None, INTEGRAL]), Some(Nearer::ByLoad));
        assert_eq!(of(&[None, None]), Some(Nearer::Undecided));
        assert_eq!(of(&[]), None);
    }

    #[test]
    fn it_counts_in_area_at_admissible_loads_of_fit_maps() {
        assert_eq!(over_loads(verdicts(90.0, [0.2, 0.3], None)), None, "not computed");
        let separation = NearerStretch { quantity: ComparedQuantity::Separation, ..stretch(SUM) };
        let strained = NearerStretch { beyond: Some(Limit::LargeStrain), ..stretch(SUM) };
        assert_eq!(over_loads(compared(vec![separation, strained])), None);
        let unfit = Verdicts { is_blocked: true, ..compared(vec![stretch(SUM)]) };
        assert_eq!(over_loads(unfit), None);
        let realisations = Verdicts { basis: Basis::Realisations(8), ..compared(vec![stretch(SUM)]) };
        assert_eq!(over_loads(realisations), Some(Nearer::Integral), "that of such surfaces");
    }
}
