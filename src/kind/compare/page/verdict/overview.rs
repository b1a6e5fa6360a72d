//! Where both models agree with the reference, over all surfaces, laws and thicknesses.

use asperity::compare::{ComparedQuantity, Difference, Estimate, Kind, NEARER, Verdict};
use asperity_framework::report::format::number;
use asperity_framework::report::page::Page;

use super::nearer::ORDER;
use super::words::{loads, name};
use crate::kind::compare::findings::{ReferenceVerdicts, Verdicts};

/// How often which model is nearer.
#[derive(Default)]
struct Count {
    statistical: usize,
    sum: usize,
    open: usize,
}

/// A surface under a law and a thickness.
pub struct Case<'a> {
    /// What it is called.
    pub name: String,
    /// Nayak's alpha of the map.
    pub alpha: Option<f64>,
    /// The verdicts on it.
    pub verdicts: &'a Verdicts,
}

/// One row per case and quantity; nothing for a single case.
pub fn overview(page: &mut Page, all: &[Case]) {
    let referred: Vec<(&Case, &ReferenceVerdicts)> =
        all.iter().filter_map(|case| Some((case, case.verdicts.reference.as_ref()?))).collect();
    if referred.len() < 2 {
        return;
    }
    page.heading(2, "Which model agrees with the reference?");
    let (mut told, mut here) = (Count::default(), Count::default());
    let mut rows = Vec::new();
    for (case, reference) in referred {
        let verdicts = case.verdicts;
        for quantity in ORDER {
            let Some(nearer) = Nearer::of(verdicts, reference, quantity) else { continue };
            told.add(nearer.told);
            here.add(nearer.here);
            rows.push(vec![
                case.name.clone(),
                case.alpha.map_or_else(|| "–".to_owned(), number),
                name(quantity).to_owned(),
                within(verdicts, reference, quantity, 0),
                within(verdicts, reference, quantity, 1),
                nearer.words(),
            ]);
        }
    }
    let total = rows.len();
    page.table(
        ["case", "Nayak's α", "quantity", "statistical model within", "sum within", "nearer at most loads"],
        rows,
    );
    page.paragraph(&format!(
        "Within: the valid loads of the reference at which the difference from it, with its 95 % interval, lies inside what is accepted; \
         in brackets those at which that holds on this very map, with the error of the reference but without an interval for other maps \
         of such a surface. Nearer: by more than a tenth of what is accepted, at more than half of the loads. Of {total} rows the sum is nearer in {}, the statistical model in {}, and {} cannot be told; on these very \
         maps the sum is nearer in {}, the statistical model in {}.",
        told.sum, told.statistical, told.open, here.sum, here.statistical,
    ));
}

impl Count {
    fn add(&mut self, nearer: Option<Kind>) {
        match nearer {
            Some(Kind::Statistical) => self.statistical += 1,
            Some(Kind::Deterministic) => self.sum += 1,
            None => self.open += 1,
        }
    }
}

/// The model that is nearer at more than half of the valid loads.
struct Nearer {
    told: Option<Kind>,
    here: Option<Kind>,
}

impl Nearer {
    fn of(verdicts: &Verdicts, reference: &ReferenceVerdicts, quantity: ComparedQuantity) -> Option<Self> {
        let each: Vec<Estimate> =
            valid(&reference.against.nearness).filter_map(|at| at.estimates[quantity as usize]).collect();
        let least = NEARER * verdicts.accepted.band(quantity)[1];
        let most = |side: &dyn Fn(&Estimate) -> Option<[f64; 2]>| {
            let count = |is_side: &dyn Fn([f64; 2]) -> bool| {
                each.iter().filter(|one| side(one).is_some_and(|ends| is_side(ends))).count()
            };
            let [statistical, sum] = [count(&|ends| ends[1] < -least), count(&|ends| ends[0] > least)];
            let is_most = |count: usize| 2 * count > each.len();
            match () {
                () if is_most(statistical) => Some(Kind::Statistical),
                () if is_most(sum) => Some(Kind::Deterministic),
                () => None,
            }
        };
        let told = most(&Estimate::interval);
        let of_map = |one: &Estimate| {
            verdicts.has_one_surface().then(|| [one.contrast - one.bound, one.contrast + one.bound])
        };
        (!each.is_empty()).then(|| Self { told, here: most(&of_map) })
    }

    fn words(&self) -> String {
        let name = |kind| if kind == Kind::Statistical { "statistical model" } else { "sum" };
        match (self.told, self.here) {
            (Some(kind), _) => name(kind).to_owned(),
            (None, Some(kind)) => format!("({})", name(kind)),
            (None, None) => "cannot tell".to_owned(),
        }
    }
}

fn valid(differences: &[Difference]) -> impl Iterator<Item = &Difference> {
    differences.iter().filter(|at| at.exceeded().is_none())
}

/// The loads at which a model is within what is accepted; in brackets on this very map.
fn within(
    verdicts: &Verdicts,
    reference: &ReferenceVerdicts,
    quantity: ComparedQuantity,
    model: usize,
) -> String {
    let band = verdicts.accepted.band(quantity);
    let is_within = |at: &Difference| {
        let estimate = at.estimates[quantity as usize];
        estimate.is_some_and(|estimate| Verdict::of(&estimate, band) == Verdict::Within)
    };
    let is_here = |at: &Difference| {
        let here = |one: Estimate| Estimate { error: Some(0.0), quantile: 0.0, ..one };
        let estimate = at.estimates[quantity as usize].map(here);
        estimate.is_some_and(|estimate| Verdict::of(&estimate, band) == Verdict::Within)
    };
    let told = spans(&reference.against.models[model], &is_within);
    let here = spans(&reference.against.models[model], &is_here);
    match (told.is_empty(), here.is_empty() || !verdicts.has_one_surface()) {
        (true, true) => "no load".to_owned(),
        (true, false) => format!("({here})"),
        (false, _) if here == told || !verdicts.has_one_surface() => told,
        (false, _) => format!("{told} ({here})"),
    }
}

/// Stretches of neighbouring valid loads that `is_in` picks.
fn spans(differences: &[Difference], is_in: &dyn Fn(&Difference) -> bool) -> String {
    let all: Vec<&Difference> = valid(differences).collect();
    let stretches = all.chunk_by(|a, b| is_in(a) == is_in(b)).filter(|stretch| is_in(stretch[0]));
    let each: Vec<String> =
        stretches.map(|stretch| loads([stretch[0].load, stretch[stretch.len() - 1].load])).collect();
    each.join("; ")
}
