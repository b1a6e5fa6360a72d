//! The states at the loads of pairs, and the gap divided among the causes.

use super::states::{Arrangement, Rearranged, STATES};
use super::{Attribution, Cause, Contributions, Order};
use crate::compare::difference::{CONTACTS_PER_GROUP, ComparedQuantity, Estimate, State};
use crate::compare::sampling::{jackknife_error, jackknife_quantile, moved, slopes, state};
use crate::compare::{Pair, Pairing};
use crate::interface::MicroContact;
use crate::model::{Limit, Model, Response, reached_at};

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
        let between = if loads.is_empty() {
            Vec::new()
        } else {
            // Both ends are the models of the pair.
            self.with_models(contact, |models| {
                models[1..STATES - 1].iter().map(|model| reached_at(*model, &loads)).collect()
            })
        };
        let mut at: Vec<AtLoad> = pairs
            .iter()
            .map(|pair| AtLoad {
                load: pair.target,
                states: None,
                effective_contacts: pair
                    .deterministic
                    .sharing
                    .map_or(0.0, |sharing| sharing.effective_contacts),
            })
            .collect();
        for (index, &k) in chosen.iter().enumerate() {
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
        let responses: Vec<Vec<Response>> = rest.with_models(contact, |models| {
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
        all.with_models(contact, |models: [&dyn Model; STATES]| {
            let each = models.into_iter().enumerate();
            each.map(|(state, model)| slopes(model, &separations(&known, state))).collect()
        })
    }

    /// The gap divided at each load. With `groups`, each contribution has the sampling error of a jackknife over them where
    /// at least [`CONTACTS_PER_GROUP`] effective contacts per group carry the load.
    pub fn attributions(&self, groups: Option<&GroupsLeftOut>) -> Vec<Attribution> {
        let at = |(index, at): (usize, &AtLoad)| {
            let Some(responses) = &at.states else {
                return Attribution { load: at.load, quantities: [None; 3] };
            };
            let needed = |groups: &&GroupsLeftOut| CONTACTS_PER_GROUP * groups.shares.len() as f64;
            let groups = groups.filter(|groups| at.effective_contacts >= needed(groups));
            let quantity = |quantity: ComparedQuantity| {
                let of = |response: &Response| Some(state(response)?.0[quantity as usize]);
                let values: Option<Vec<f64>> = responses.iter().map(of).collect();
                let by_order = divided(&values?.try_into().ok()?);
                let without: Option<Vec<[[f64; 3]; 3]>> = groups.and_then(|groups| {
                    let of = |all: &Vec<Option<[State; STATES]>>| {
                        Some(divided(&all[index]?.map(|state| state[quantity as usize])))
                    };
                    groups.states.iter().map(of).collect()
                });
                let estimate = |cause: Cause| {
                    let mean = |by_order: &[[f64; 3]; 3]| {
                        by_order.iter().map(|order| order[cause as usize]).sum::<f64>()
                            / by_order.len() as f64
                    };
                    let contrast = mean(&by_order);
                    let error = groups.zip(without.as_ref()).map(|(groups, without)| {
                        let without: Vec<f64> = without.iter().map(mean).collect();
                        jackknife_error(contrast, &without, &groups.shares)
                    });
                    Estimate {
                        contrast,
                        error,
                        quantile: groups
                            .map_or(f64::INFINITY, |groups| jackknife_quantile(groups.shares.len())),
                        bound: 0.0,
                        independent_error: None,
                    }
                };
                Some(Contributions { by_order, estimates: Cause::ALL.map(estimate) })
            };
            Attribution { load: at.load, quantities: ComparedQuantity::ALL.map(quantity) }
        };
        self.at.iter().enumerate().map(at).collect()
    }
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
