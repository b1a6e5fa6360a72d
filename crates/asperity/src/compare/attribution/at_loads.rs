//! The states at the loads of pairs, and the gap divided among the causes.

use super::states::{Arrangement, Rearranged, STATES};
use super::{Attribution, Cause, Contribution, Contributions, Order};
use crate::compare::difference::{CONTACTS_PER_GROUP, ComparedQuantity, Estimate, State, Support};
use crate::compare::sampling::{jackknife_error, jackknife_quantile, moved, slopes, state};
use crate::compare::{Pair, Pairing};
use crate::interface::MicroContact;
use crate::model::{Limit, Model, Response, reached_at};
use crate::numeric::parallel;

/// Every state at some loads under one law.
#[derive(Debug, Clone)]
pub struct StatesAtLoads {
    at: Vec<AtLoad>,
}

/// Every state at one load.
#[derive(Debug, Clone)]
struct AtLoad {
    load: f64,
    /// `None` where too few contacts carry the load, or a state does not reach it.
    states: Option<[Response; STATES]>,
    /// The statistical model and that with the own heights, both with the other mean radius.
    with_other_radius: Option<[Response; 2]>,
    effective_contacts: f64,
}

/// Every state at the same loads, with each group of the asperities left out.
#[derive(Debug, Clone)]
pub struct GroupsLeftOut {
    /// Without each group, at each load; `None` where a state has no contact.
    pub states: Vec<Vec<Option<[State; STATES]>>>,
    /// The groups' shares of the nominal area.
    pub shares: Vec<f64>,
}

impl Rearranged<'_> {
    /// The states at the loads of the `pairs` at equal load, in their order. Left out are loads that fewer than 30
    /// effective contacts carry, or one contact more than 10 % of: there the parts would be those of single asperities.
    pub fn at_loads(&self, contact: &dyn MicroContact, pairs: &[Pair]) -> StatesAtLoads {
        let pairs: Vec<&Pair> = pairs.iter().filter(|pair| pair.pairing == Pairing::Load).collect();
        let is_carried_by_many = |pair: &Pair| {
            let few = |limit: Limit| matches!(limit, Limit::FewContacts | Limit::DominantContact);
            pair.deterministic.sharing.is_some() && !pair.exceeded().limits().any(few)
        };
        let chosen: Vec<usize> = (0..pairs.len()).filter(|&k| is_carried_by_many(pairs[k])).collect();
        let loads: Vec<f64> = chosen.iter().map(|&k| pairs[k].target).collect();
        // Those of the sum: most states are not far from it.
        let near: Vec<f64> = chosen.iter().map(|&k| pairs[k].deterministic.separation_over_sigma).collect();
        // Both ends are the models of the pair. Side by side: one state of few nodes does not keep all threads busy.
        let (between, with_other_radius) = rayon::join(
            || {
                if loads.is_empty() {
                    return Vec::new();
                }
                self.with_models(contact, &near, |models| {
                    let between = &models[1..STATES - 1];
                    // The same sum may stand for two states, and would find this for each.
                    between.iter().for_each(|model| _ = model.may_decrease());
                    parallel::map(between.len(), |k| reached_at(between[k], &loads))
                })
            },
            || {
                self.with_other_radius(contact, &near, |models| {
                    parallel::map(models.len(), |k| reached_at(models[k], &loads))
                })
            },
        );
        let mut at: Vec<AtLoad> = pairs
            .iter()
            .map(|pair| AtLoad {
                load: pair.target,
                states: None,
                with_other_radius: None,
                effective_contacts: pair
                    .deterministic
                    .sharing
                    .map_or(0.0, |sharing| sharing.effective_contacts),
            })
            .collect();
        for (index, &k) in chosen.iter().enumerate() {
            at[k].with_other_radius = with_other_radius
                .as_ref()
                .and_then(|models| Some([models[0][index]?.response, models[1][index]?.response]));
            let inner: Option<Vec<Response>> =
                between.iter().map(|all| all[index].map(|reached| reached.response)).collect();
            let Some(&[own_heights, own_radii, independent, paired]) = inner.as_deref() else { continue };
            let Pair { statistical, deterministic, .. } = *pairs[k];
            at[k].states = Some([statistical, own_heights, own_radii, independent, paired, deterministic]);
        }
        StatesAtLoads { at }
    }
}

impl StatesAtLoads {
    /// The states without a group of the asperities: of `rest`, evaluated at the separations of all in units of its own
    /// sigma, and moved along the slopes over the load to the load of all. `slopes` are those of [`Self::slopes`].
    pub fn without(
        &self,
        rest: &Rearranged,
        contact: &dyn MicroContact,
        slopes: &[Vec<Option<State>>],
    ) -> Vec<Option<[State; STATES]>> {
        let known: Vec<(usize, &[Response; STATES])> =
            self.at.iter().enumerate().filter_map(|(k, at)| Some((k, at.states.as_ref()?))).collect();
        let mut found = vec![None; self.at.len()];
        if known.is_empty() {
            return found;
        }
        let responses: Vec<Vec<Response>> = rest.with_models(contact, &[], |models| {
            let all = models.into_iter().enumerate();
            all.map(|(state, model)| model.respond_all(&separations(&known, state))).collect()
        });
        for (index, (k, states)) in known.iter().enumerate() {
            let of = |which: usize| {
                let (at, pressure) = state(&responses[which][index])?;
                Some(moved(at, slopes[which][index]?, pressure, states[which].pressure.total()))
            };
            let all: Option<Vec<State>> = (0..STATES).map(of).collect();
            found[*k] = all.and_then(|all| all.try_into().ok());
        }
        found
    }

    /// The slopes of each state over the logarithm of the load, at the loads that have states.
    pub fn slopes(&self, all: &Rearranged, contact: &dyn MicroContact) -> Vec<Vec<Option<State>>> {
        let known: Vec<(usize, &[Response; STATES])> =
            self.at.iter().enumerate().filter_map(|(k, at)| Some((k, at.states.as_ref()?))).collect();
        if known.is_empty() {
            return Vec::new();
        }
        all.with_models(contact, &[], |models: [&dyn Model; STATES]| {
            let each = models.into_iter().enumerate();
            each.map(|(state, model)| slopes(model, &separations(&known, state))).collect()
        })
    }

    /// The gap divided at each load. With `groups`, each contribution has the sampling error of a jackknife over them where
    /// at least [`CONTACTS_PER_GROUP`] effective contacts per group carry the load.
    pub fn attributions(&self, groups: Option<&GroupsLeftOut>) -> Vec<Attribution> {
        let at = |(index, at): (usize, &AtLoad)| {
            let needed = |groups: &&GroupsLeftOut| CONTACTS_PER_GROUP * groups.shares.len() as f64;
            let groups = groups.filter(|groups| at.effective_contacts >= needed(groups));
            let contributions = |quantity| {
                Some(QuantityStates::new(at, index, groups, quantity)?.contributions(at, quantity))
            };
            Attribution { load: at.load, quantities: ComparedQuantity::ALL.map(contributions) }
        };
        self.at.iter().enumerate().map(at).collect()
    }
}

/// A quantity in every state at one load.
struct QuantityStates<'a> {
    values: [f64; STATES],
    /// Without each group of asperities, with the groups' shares of the nominal area.
    without: Option<(Vec<[f64; STATES]>, &'a [f64])>,
}

impl<'a> QuantityStates<'a> {
    /// At the load of number `index`; `None` where a state has no value.
    fn new(
        at: &AtLoad,
        index: usize,
        groups: Option<&'a GroupsLeftOut>,
        quantity: ComparedQuantity,
    ) -> Option<Self> {
        let values: Option<Vec<f64>> =
            at.states.as_ref()?.iter().map(|response| value(response, quantity)).collect();
        let without = groups.and_then(|groups| {
            let of_group = |all: &Vec<Option<[State; STATES]>>| {
                all[index].map(|states| states.map(|state| state[quantity as usize]))
            };
            let without: Option<Vec<[f64; STATES]>> = groups.states.iter().map(of_group).collect();
            Some((without?, &groups.shares[..]))
        });
        Some(Self { values: values?.try_into().ok()?, without })
    }

    fn contributions(&self, at: &AtLoad, quantity: ComparedQuantity) -> Contributions {
        let with_other_radius = at.with_other_radius.and_then(|[statistical, own_heights]| {
            let mut values = self.values;
            values[Arrangement::Statistical as usize] = value(&statistical, quantity)?;
            values[Arrangement::OwnHeights as usize] = value(&own_heights, quantity)?;
            let by_order = divided(&values);
            Some(Cause::ALL.map(|cause| over_orders(&by_order, &[cause])))
        });
        let gap = |values: &[f64; STATES]| {
            values[Arrangement::Statistical as usize] - values[Arrangement::Deterministic as usize]
        };
        Contributions {
            total: self.estimate(gap),
            causes: Cause::ALL.map(|cause| self.contribution(&[cause])),
            radii: self.contribution(&[Cause::Radii, Cause::Correlation]),
            with_other_radius,
        }
    }

    /// What some causes contribute together.
    fn contribution(&self, causes: &[Cause]) -> Contribution {
        Contribution {
            by_order: std::array::from_fn(|order| {
                self.estimate(|values| together(&divided(values)[order], causes))
            }),
            mean: self.estimate(|values| over_orders(&divided(values), causes)),
        }
    }

    fn estimate(&self, value: impl Fn(&[f64; STATES]) -> f64) -> Estimate {
        let contrast = value(&self.values);
        let error = |(without, shares): &(Vec<[f64; STATES]>, &[f64])| {
            jackknife_error(contrast, &without.iter().map(&value).collect::<Vec<_>>(), shares)
        };
        Estimate {
            contrast,
            error: self.without.as_ref().map(error),
            quantile: self
                .without
                .as_ref()
                .map_or(f64::INFINITY, |(_, shares)| jackknife_quantile(shares.len())),
            bound: 0.0,
            independent_error: None,
            support: Support::Sampled,
        }
    }
}

/// A quantity of a response, on the scale of contrasts.
fn value(response: &Response, quantity: ComparedQuantity) -> Option<f64> {
    state(response)?;
    quantity.value(response).map(|value| quantity.scaled(value))
}

/// The sum of the parts of some causes.
fn together(parts: &[f64; 3], causes: &[Cause]) -> f64 {
    causes.iter().map(|&cause| parts[cause as usize]).sum()
}

/// The mean of that sum over the orders.
fn over_orders(by_order: &[[f64; 3]; 3], causes: &[Cause]) -> f64 {
    by_order.iter().map(|parts| together(parts, causes)).sum::<f64>() / by_order.len() as f64
}

/// The separations of one state, d/sigma.
fn separations(known: &[(usize, &[Response; STATES])], state: usize) -> Vec<f64> {
    known.iter().map(|(_, states)| states[state].separation_over_sigma).collect()
}

/// The contribution of each cause in each order, from the values of a quantity in each state.
fn divided(values: &[f64; STATES]) -> [[f64; 3]; 3] {
    Order::ALL.map(|order| {
        let path = match order {
            Order::HeightsFirst => [Arrangement::OwnHeights, Arrangement::Independent],
            Order::RadiiFirst => [Arrangement::OwnRadii, Arrangement::Independent],
            Order::HeightsLast => [Arrangement::OwnRadii, Arrangement::PairedByRank],
        };
        let [first, second] = path.map(|state| values[state as usize]);
        let values = [
            values[Arrangement::Statistical as usize],
            first,
            second,
            values[Arrangement::Deterministic as usize],
        ];
        let mut of_cause = [0.0; 3];
        for (step, cause) in order.causes().into_iter().enumerate() {
            of_cause[cause as usize] = values[step] - values[step + 1];
        }
        of_cause
    })
}
