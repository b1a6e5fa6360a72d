//! Running `[limit]`: sets of growing size against the statistical integral.

use std::time::Instant;

use asperity::compare::{Exact, LimitCase, LimitPoint, convergence};
use asperity::distribution::gaussian_moment;
use asperity::study::LawContact;
use asperity::work::{CountedContact, Counter, Item};
use asperity::{MicroContact, Model, Population, Statistical, plasticity_index};
use asperity_framework::RunContext;
use asperity_framework::contact::{ContactMetadata, contact_metadata, papers_of};
use asperity_framework::input::InputError;
use asperity_framework::metadata::{Metadata, Timing};

use super::findings::{Slope, SlopeRange, ranges, slopes};
use super::plan::LimitPlan;

/// Sets of growing size against their limit.
#[derive(Debug)]
pub struct LimitResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The bodies.
    pub contact: ContactMetadata,
    /// What the sets were drawn from.
    pub population: Population,
    /// The laws, and the reference of each.
    pub laws: Vec<(String, &'static str)>,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Random sets of each size.
    pub draws: usize,
    /// Size by size, law by law, separation by separation.
    pub points: Vec<LimitPoint>,
    /// The power laws of the errors: law by law, separation by separation.
    pub slopes: Vec<Slope>,
    /// Their ranges: of random sets, then of those at the quantiles.
    pub slope_ranges: Vec<SlopeRange>,
}

/// Draws the sets and compares them with their limit.
pub(super) fn run(context: &RunContext, limit: &LimitPlan) -> Result<LimitResults, InputError> {
    let start = Instant::now();
    let mut timing = Timing::default();
    let counter = Counter::default();
    let contacts: Vec<CountedContact> =
        limit.laws.iter().map(|law| CountedContact::new(&*law.contact, &counter)).collect();
    let integrals = Instant::now();
    context.progress.stage("integrals", contacts.len() as f64);
    let laws = limit.laws.iter().zip(&contacts);
    let cases: Vec<LimitCase> = laws
        .map(|(law, contact)| LimitCase {
            law: law.label.clone(),
            contact,
            exact: limit.separations.iter().map(|&h| exact(law, contact, &limit.population, h)).collect(),
        })
        .inspect(|_| context.progress.advance(1.0))
        .collect();
    timing.statistical = integrals.elapsed();

    let sets = (limit.draws + 1) as u64;
    let asperities = limit.counts.iter().map(|&count| count as u64 * sets).sum::<u64>();
    context.progress.stage("random sets", asperities as f64);
    let sums = Instant::now();
    let seed = |count, draw| context.stream_seed(&format!("limit {count} {draw}"));
    let points = convergence(&cases, &limit.population, &limit.counts, limit.draws, seed, |count| {
        counter.add(Item::Surfaces, 1);
        context.progress.advance(count as f64);
    })
    .map_err(|error| InputError::file(&context.source.path, error))?;
    timing.deterministic = sums.elapsed();
    let labels = limit.laws.iter().map(|law| law.label.as_str());
    let slopes = slopes(&points, labels, &limit.separations);
    timing.total = start.elapsed();
    Ok(LimitResults {
        metadata: context.metadata(papers_of(&limit.laws), timing, Some(counter.work())),
        contact: contact_metadata(context.materials, &limit.laws, &limit.bodies, None),
        population: limit.population.clone(),
        plasticity_index: plasticity_index(
            &*limit.laws[0].contact,
            limit.population.sigma,
            limit.population.radius,
        ),
        laws: limit.laws.iter().map(|law| (law.label.clone(), reference(law))).collect(),
        separations: limit.separations.clone(),
        draws: limit.draws,
        points,
        slope_ranges: ranges(&slopes),
        slopes,
    })
}

fn reference(law: &LawContact) -> &'static str {
    if law.spec.is_greenwood_williamson() {
        "the closed form of Greenwood and Williamson"
    } else {
        "the statistical integral"
    }
}

/// The limit at d/sigma = `h`: Greenwood and Williamson's closed form for Hertz, else the integral.
fn exact(law: &LawContact, contact: &dyn MicroContact, population: &Population, h: f64) -> Exact {
    let &Population { radius, sigma, density, .. } = population;
    let integral = Statistical::new(contact, population.clone()).respond(h);
    let limit = Exact::of_integral(integral, density);
    if !law.spec.is_greenwood_williamson() {
        return limit;
    }
    let modulus = contact.reference_modulus();
    Exact {
        area_ratio: std::f64::consts::PI * density * radius * sigma * gaussian_moment(1.0, h),
        pressure: 4.0 / 3.0 * density * modulus * radius.sqrt() * sigma.powf(1.5) * gaussian_moment(1.5, h),
        ..limit
    }
}
