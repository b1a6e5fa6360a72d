//! The gap between both models divided among its causes, at every load of a case.

use super::law::LawContact;
use crate::ContactLaw;
use crate::compare::{Division, GroupsLeftOut, Rearranged, StatesAtLoads};
use crate::numeric::stream_seed;
use crate::work::{CountedContact, Counter};

use super::models::SurfaceModels;
use super::results::CaseResults;
use super::setup::Setup;
use crate::surface::{Independence, Surface};

/// The asperities of a surface rearranged, for laws of spheres and of ellipses.
struct ForLaws<'a>([Option<Rearranged<'a>>; 2]);

impl<'a> ForLaws<'a> {
    fn new(models: &'a SurfaceModels, laws: &[LawContact], of: fn(Rearranged<'a>) -> Rearranged<'a>) -> Self {
        Self([false, true].map(|is_elliptic| {
            // All contacts are asked for the same medium.
            let law = laws.iter().find(|law| law.spec.is_elliptic() == is_elliptic)?;
            Some(of(Rearranged::new(models.inputs(&*law.contact, &law.spec)?)))
        }))
    }

    fn for_law(&self, law: &ContactLaw) -> Option<&Rearranged<'a>> {
        self.0[usize::from(law.is_elliptic())].as_ref()
    }
}

/// Divides the gap of every case of a surface; with its sampling error, where the surface allows one and `has_errors`.
/// Nothing where only one model was run, or no attribution is asked for.
pub fn attribute(
    setup: Setup,
    surface: &Surface,
    models: &SurfaceModels,
    cases: &mut [CaseResults],
    has_errors: bool,
) {
    if !(setup.has_both_models() && setup.is_attributed) {
        return;
    }
    setup.progress.stage("causes", cases.len() as f64);
    let all = ForLaws::new(models, setup.laws, |all| all);
    let states: Vec<Option<StatesAtLoads>> = setup
        .laws
        .iter()
        .zip(&*cases)
        .map(|(law, case)| {
            let counter = Counter::default();
            let contact = CountedContact::new(&*law.contact, &counter).watched_by(setup.progress);
            let attributions = all.for_law(&law.spec)?.at_loads(&contact, &case.comparison.pairs);
            setup.progress.advance(1.0);
            Some(attributions)
        })
        .collect();
    let groups = if has_errors { left_out(setup, (surface, models), &all, &states) } else { Vec::new() };
    for (index, (case, states)) in cases.iter_mut().zip(&states).enumerate() {
        let Some(states) = states else { continue };
        case.attribution = states.attributions(groups.get(index));
        // What the sum leaves out of the stiffness at a load jump is not a cause.
        for (at, difference) in case.attribution.iter_mut().zip(&case.differences) {
            for (parts, estimate) in at.quantities.iter_mut().zip(&difference.estimates) {
                if estimate.is_none() {
                    *parts = None;
                }
            }
        }
    }
}

/// The states of each case with each group of asperities left out; nothing where the surface allows no sampling error.
fn left_out(
    setup: Setup,
    (surface, models): (&Surface, &SurfaceModels),
    all: &ForLaws,
    states: &[Option<StatesAtLoads>],
) -> Vec<GroupsLeftOut> {
    if states.iter().all(Option::is_none) {
        return Vec::new();
    }
    let seed = stream_seed(setup.seed, &format!("groups of {}", surface.name));
    let drawn = match &surface.independence {
        Independence::Asperities => Division::independent(surface.set.count(), seed, setup.progress),
        _ => None,
    };
    let division = match &surface.independence {
        Independence::Blocks(blocks) => &blocks.division,
        _ => match &drawn {
            Some(division) => division,
            None => return Vec::new(),
        },
    };
    let of_case = |(law, states): (&LawContact, &Option<StatesAtLoads>)| {
        let slopes = |states: &StatesAtLoads| Some(states.slopes(all.for_law(&law.spec)?, &*law.contact));
        states.as_ref().and_then(slopes).unwrap_or_default()
    };
    let slopes: Vec<_> = setup.laws.iter().zip(states).map(of_case).collect();
    setup.progress.stage("sampling errors of the causes", division.shares().len() as f64);
    let without = |group: usize| {
        setup.progress.advance(0.0);
        let rest = surface.without(division, group)?;
        setup.progress.advance(0.0);
        let models = models.of_part(&rest, setup.law_specs, true).ok()?;
        setup.progress.advance(0.0);
        let rearranged = ForLaws::new(&models, setup.laws, Rearranged::coarse);
        let case = |(index, law): (usize, &LawContact)| {
            let counter = Counter::default();
            let contact = &CountedContact::new(&*law.contact, &counter).watched_by(setup.progress);
            let (states, rest) = (states[index].as_ref()?, rearranged.for_law(&law.spec)?);
            Some(states.without(rest, contact, &slopes[index]))
        };
        let all: Vec<_> = setup.laws.iter().enumerate().map(case).collect();
        setup.progress.advance(1.0);
        Some(all)
    };
    let Some(groups) = division.for_each_group(without).into_iter().collect::<Option<Vec<_>>>() else {
        return Vec::new();
    };
    let of_case = |index: usize| GroupsLeftOut {
        states: groups.iter().map(|group| group[index].clone().unwrap_or_default()).collect(),
        shares: division.shares().to_vec(),
    };
    (0..states.len()).map(of_case).collect()
}
