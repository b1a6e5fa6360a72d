//! Running `[limit]`: sets of growing size against the statistical integral.

use std::fmt;
use std::time::Instant;

use asperity::compare::{ErrorSlope, LimitCase, LimitPoint, LimitSets, convergence};
use asperity::plasticity_index;
use asperity::study::LawContact;
use asperity::work::{CountedContact, Counter, Item};
use asperity_contact_framework::contact::{Bodies, ContactMetadata, contact_metadata, papers_of};
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{ArealNumberDensity, Length, Pure, Quantity};
use asperity_contact_framework::input::sweep::{LinearSweep, LogSweep};
use asperity_contact_framework::input::{InputError, Spanned, Whole};
use asperity_contact_framework::metadata::{Metadata, Timing};
use asperity_contact_framework::{Memory, Outcome, Plan, RunContext, set_memory};
use schemars::JsonSchema;
use serde::Deserialize;

/// Sets of growing size against their limit.
pub struct LimitPlan {
    pub bodies: Bodies,
    pub laws: Vec<LawContact>,
    pub sets: LimitSets,
}

#[derive(Debug)]
pub struct LimitResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    pub sets: LimitSets,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Size by size, law by law, separation by separation.
    pub points: Vec<LimitPoint>,
    pub slopes: Vec<ErrorSlope>,
}

impl Plan for LimitPlan {
    fn memory(&self) -> Memory {
        let largest = self.sets.counts.iter().copied().max().unwrap_or(0);
        Memory { bytes: set_memory(largest as u128), key: None }
    }

    fn work(&self) -> u128 {
        (self.sets.asperities() * self.laws.len() * self.sets.separations.len()) as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        let start = Instant::now();
        let Self { bodies, laws, sets } = self;
        let counter = Counter::default();
        let counted = |contact| CountedContact::new(contact, &counter);
        let contacts: Vec<_> = laws.iter().map(|law| counted(&*law.contact)).collect();
        context.progress.stage("integrals", contacts.len() as f64);
        let cases = laws.iter().zip(&contacts);
        let cases: Vec<_> = cases
            .map(|(law, contact)| {
                let case = LimitCase::new(&law.spec, contact, sets);
                context.progress.advance(1.0);
                case
            })
            .collect();
        let statistical = start.elapsed();
        context.progress.stage("random sets", sets.asperities() as f64);
        let seed = |count, draw| context.stream_seed(&format!("limit {count} {draw}"));
        let points = convergence(&cases, sets, seed, |count| {
            counter.add(Item::Surfaces, 1);
            context.progress.advance(count as f64);
        });
        let points = points.map_err(|error| InputError::file(&context.source.path, error))?;
        let total = start.elapsed();
        let deterministic = total - statistical;
        let timing = Timing { statistical, deterministic, total, ..Timing::default() };
        let population = &sets.population;
        Ok(Box::new(LimitResults {
            metadata: context.metadata(papers_of(laws), timing, Some(counter.work())),
            contact: contact_metadata(context.materials, laws, bodies, None),
            plasticity_index: plasticity_index(&*laws[0].contact, population.sigma, population.radius),
            sets: sets.clone(),
            slopes: ErrorSlope::all(&points),
            points,
        }))
    }
}

impl fmt::Display for LimitPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let LimitSets { counts, draws, .. } = &self.sets;
        let laws: Vec<&str> = self.laws.iter().map(|law| law.label.as_str()).collect();
        writeln!(f, "  {} on {}, law {}", self.bodies.rough, self.bodies.flat, laws.join(", "))?;
        write!(f, "  {draws} random sets and one set at the quantiles for each size, ")?;
        writeln!(f, "{counts:?} asperities")
    }
}

/// Convergence of the sum to the integral: sets of equal radii and Gaussian heights, of growing size.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LimitSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<String>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws.
    pub law: Spanned<Laws>,
    /// Radius of every asperity.
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// Standard deviation of the asperity heights.
    #[schemars(extend("examples" = ["48 nm"]))]
    pub sigma: Quantity<Length>,
    /// Asperities per nominal area.
    #[schemars(extend("examples" = ["6e10 /m^2"]))]
    pub density: Quantity<ArealNumberDensity>,
    /// Separations, d/sigma.
    #[schemars(extend("examples" = [[0, 1, 2]]))]
    pub separation: LinearSweep,
    /// Numbers of asperities of the sets.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [{ "from": 100, "to": 1e6, "points": 9 }]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Random sets of each size.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [100]))]
    pub draws: Spanned<Whole>,
}
