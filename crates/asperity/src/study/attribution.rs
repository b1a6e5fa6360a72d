//! The gap between both models divided among its causes, at every load of a case.

use super::models::SurfaceModels;
use super::results::CaseResults;
use super::setup::{LawContact, Setup};
use super::verdicts::Verdicts;
use crate::ContactLaw;
use crate::compare::{
    Cause, ComparedQuantity, Contribution, Contributions, Division, Estimate, GroupsLeftOut, Rearranged,
    StatesAtLoads, Stretch, Verdict, largest, leading,
};
use crate::numeric::stream_seed;
use crate::surface::{Independence, Surface};
use crate::work::{CountedContact, Counter};

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

/// The cause that contributes most to a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeadingCause {
    /// One between the statistical and the deterministic model.
    Between(Cause),
    /// What the sum leaves out beside the reference: interaction and shape of the asperities, under a cap also the law, and under a
    /// layer also the rule of the effective modulus.
    LeftOut,
}

impl LeadingCause {
    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Between(cause) => cause.name(),
            Self::LeftOut => "left-out",
        }
    }

    /// The name in sentences.
    pub fn label(self) -> &'static str {
        match self {
            Self::Between(cause) => cause.label(),
            Self::LeftOut => "what the sum leaves out",
        }
    }
}

/// What can be said of the cause of a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatedCause {
    /// It leads: its 95 % interval is apart from those of all others.
    Leading(LeadingCause),
    /// None leads, but on the one surface that was compared this is the largest in every order of replacement.
    LargestOnSurface(LeadingCause),
}

impl StatedCause {
    /// The cause that leads.
    pub fn leading(self) -> Option<LeadingCause> {
        if let Self::Leading(cause) = self { Some(cause) } else { None }
    }

    /// The largest cause on this surface, where none leads.
    pub fn largest_on_surface(self) -> Option<LeadingCause> {
        if let Self::LargestOnSurface(cause) = self { Some(cause) } else { None }
    }
}

impl Verdicts {
    /// The contributions to the difference between the models in a quantity at a load (Pa).
    pub fn contributions(&self, quantity: ComparedQuantity, load: f64) -> Option<&Contributions> {
        self.attribution.iter().find(|at| at.load == load)?.contributions(quantity)
    }

    /// The loads of the admissible range at which a quantity is divided, by growing load, with the contributions.
    pub fn divided(&self, quantity: ComparedQuantity) -> impl Iterator<Item = (f64, &Contributions)> {
        let is_admissible =
            |load: f64| self.differences.iter().any(|at| at.load == load && at.exceeded().is_none());
        let divided =
            self.attribution.iter().filter_map(move |at| Some((at.load, at.contributions(quantity)?)));
        divided.filter(move |(load, _)| is_admissible(*load))
    }

    /// The cause of the largest difference of a stretch between the models, unless it is known to be within what is accepted.
    pub fn cause(&self, stretch: &Stretch) -> Option<StatedCause> {
        let (_, parts) = self.largest_divided(stretch)?;
        let causes = Cause::ALL.map(|cause| (LeadingCause::Between(cause), *parts.of_cause(cause)));
        self.stated(&parts.total, &causes)
    }

    /// The part of a difference that leads, or that is the largest on the one surface that was compared; none on one that is not fit.
    fn stated(&self, total: &Estimate, parts: &[(LeadingCause, Contribution)]) -> Option<StatedCause> {
        if self.is_blocked {
            return None;
        }
        let on_surface =
            || largest(total, parts).filter(|_| self.has_one_surface()).map(StatedCause::LargestOnSurface);
        leading(total, parts).map(StatedCause::Leading).or_else(on_surface)
    }

    /// The load of the largest difference of a stretch that is divided, with the contributions; `None` where the stretch is within
    /// what is accepted. With several realisations the largest difference of all may be at a load that not all of them divide.
    fn largest_divided(&self, stretch: &Stretch) -> Option<(f64, &Contributions)> {
        if stretch.verdict == Verdict::Within {
            return None;
        }
        let [from, to] = stretch.loads;
        let in_stretch = self.divided(stretch.quantity).filter(|(load, _)| (from..=to).contains(load));
        in_stretch.max_by(|a, b| a.1.gap().abs().total_cmp(&b.1.gap().abs()))
    }

    /// The same of a stretch of the statistical model against the reference. The difference of the sum is not divided: all of it is
    /// what the sum leaves out.
    pub fn cause_against_reference(&self, stretch: &Stretch) -> Option<StatedCause> {
        let (load, total) = stretch.largest.filter(|_| stretch.verdict != Verdict::Within)?;
        let missed = (LeadingCause::LeftOut, self.missed(stretch.quantity, load)?.into());
        let between = self.contributions(stretch.quantity, load)?;
        let causes = Cause::ALL.map(|cause| (LeadingCause::Between(cause), *between.of_cause(cause)));
        self.stated(&total, &std::iter::once(missed).chain(causes).collect::<Vec<_>>())
    }

    /// The sum minus the reference at a load (Pa), where both are there.
    pub fn missed(&self, quantity: ComparedQuantity, load: f64) -> Option<Estimate> {
        let sum = &self.reference.as_ref()?.against.models[1];
        sum.iter().find(|at| at.load == load)?.estimates[quantity as usize]
    }
}
