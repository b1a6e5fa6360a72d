//! Where both models agree with the reference, over all surfaces, laws and thicknesses.

use asperity::compare::{ComparedQuantity, Difference, Estimate, Kind, NEARER, Verdict};
use asperity_framework::report::format::number;
use asperity_framework::report::page::Page;

use super::nearer::ORDER;
use super::words::{loads, name, signed};
use crate::kind::compare::findings::{ReferenceVerdicts, Verdicts};

/// How often which model is nearer.
#[derive(Default)]
struct Count {
    statistical: usize,
    sum: usize,
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

/// Where both models agree with the reference, over several cases.
pub struct Overview {
    rows: Vec<Row>,
    /// The model that is nearer for surfaces of the kind, and on the maps themselves.
    told: Count,
    here: Count,
}

/// A quantity of a case.
struct Row {
    case: String,
    alpha: Option<f64>,
    quantity: ComparedQuantity,
    /// Loads at which the statistical model and the sum are within what is accepted.
    within: [String; 2],
    /// Their largest differences from the reference, with the load (Pa).
    largest: [(Estimate, f64); 2],
    has_one_surface: bool,
    nearer: Nearer,
}

impl Overview {
    /// Of cases with a reference; `None` where there are not several.
    pub fn of(all: &[Case]) -> Option<Self> {
        let referred: Vec<(&Case, &ReferenceVerdicts)> =
            all.iter().filter_map(|case| Some((case, case.verdicts.reference.as_ref()?))).collect();
        let rows = || {
            referred.iter().flat_map(|(case, reference)| ORDER.map(|quantity| (case, reference, quantity)))
        };
        let rows: Vec<Row> = rows()
            .filter_map(|(case, reference, quantity)| {
                let verdicts = case.verdicts;
                Some(Row {
                    case: case.name.clone(),
                    alpha: case.alpha,
                    quantity,
                    within: [0, 1].map(|model| within(verdicts, reference, quantity, model)),
                    largest: [largest(reference, quantity, 0)?, largest(reference, quantity, 1)?],
                    has_one_surface: verdicts.has_one_surface(),
                    nearer: Nearer::of(verdicts, reference, quantity)?,
                })
            })
            .collect();
        let (mut told, mut here) = (Count::default(), Count::default());
        for Row { nearer, .. } in &rows {
            told.add(nearer.told);
            here.add(nearer.here);
        }
        (referred.len() > 1 && !rows.is_empty()).then_some(Self { rows, told, here })
    }

    /// Which model is nearer how often.
    pub fn nearer(&self) -> String {
        let Self { rows, told, here } = self;
        let on_maps = if rows.iter().any(|row| row.has_one_surface) {
            format!(" On these maps alone they are {} and {}.", here.sum, here.statistical)
        } else {
            String::new()
        };
        format!(
            "Of {} comparisons with the reference (case and quantity) the sum is nearer in {}, the statistical model in {}; the others \
             cannot be told with the sampling error of such surfaces.{on_maps}",
            rows.len(),
            told.sum,
            told.statistical,
        )
    }

    /// How far each model is from the reference at worst, and which is nearer how often.
    pub fn sentence(&self) -> String {
        let of_quantity = |quantity: ComparedQuantity| {
            let rows = || self.rows.iter().filter(move |row| row.quantity == quantity);
            let worst = |model: usize| {
                let size = |row: &&Row| quantity.reported(row.largest[model].0.contrast).abs();
                let row = rows().max_by(|a, b| size(a).total_cmp(&size(b)))?;
                let (estimate, load) = row.largest[model];
                Some(format!(
                    "{} ({} at {})",
                    signed(quantity, estimate.contrast),
                    row.case,
                    loads([load; 2])
                ))
            };
            Some(format!(
                "in {} the statistical model differs by up to {}, the sum by up to {}",
                name(quantity),
                worst(0)?,
                worst(1)?
            ))
        };
        let quantities: Vec<String> = ORDER.into_iter().filter_map(of_quantity).collect();
        let Self { rows, told, here } = self;
        // Over several realisations there is no single map to speak of.
        let has_map = rows.iter().any(|row| row.has_one_surface);
        let here =
            has_map.then(|| format!("; judged on these maps alone in {} and {}", here.sum, here.statistical));
        format!(
            "at valid loads, {}. With the sampling error of such surfaces the sum is nearer in {} of the {} rows of the next table, the \
             statistical model in {}{}. Pasaribu and Schipper (2005) conclude that the sum is the more accurate model: of the rows, which \
             overlap, {} agree with that, {} contradict it, and {} cannot be told.",
            quantities.join("; "),
            told.sum,
            rows.len(),
            told.statistical,
            here.unwrap_or_default(),
            told.sum,
            told.statistical,
            rows.len() - told.sum - told.statistical,
        )
    }

    /// One row per case and quantity.
    pub fn section(&self, page: &mut Page) {
        page.heading(2, "Which model agrees with the reference?");
        let shown = |row: &Row| {
            let [statistical, sum] = &row.within;
            let worst = |(estimate, _): (Estimate, f64)| {
                let interval = estimate.interval().map(|ends| ends.map(|end| signed(row.quantity, end)));
                let interval = interval.map_or_else(String::new, |[low, high]| format!(" ({low} to {high})"));
                format!("{}{interval}", signed(row.quantity, estimate.contrast))
            };
            let [worst_statistical, worst_sum] = row.largest.map(worst);
            vec![
                row.case.clone(),
                row.alpha.map_or_else(|| "–".to_owned(), number),
                name(row.quantity).to_owned(),
                statistical.clone(),
                worst_statistical,
                sum.clone(),
                worst_sum,
                row.nearer.words(),
            ]
        };
        page.table(
            [
                "case",
                "Nayak's α",
                "quantity",
                "statistical model within",
                "largest",
                "sum within",
                "largest",
                "nearer at most loads",
            ],
            self.rows.iter().map(shown),
        );
        page.paragraph(
            "Within: the valid loads of the reference at which the difference from it, with its 95 % interval, lies inside what is accepted; \
             in brackets those at which that holds on this very map, with the error of the reference but without an interval for other maps \
             of such a surface. Largest: the largest difference from the reference at a valid load, with its 95 % interval where one is claimed. Nearer: by more than a tenth of what is \
             accepted, at more than half of the loads.",
        );
    }
}

/// The largest difference of a model from the reference at a valid load, and that load (Pa).
fn largest(
    reference: &ReferenceVerdicts,
    quantity: ComparedQuantity,
    model: usize,
) -> Option<(Estimate, f64)> {
    let each = valid(&reference.against.models[model])
        .filter_map(|at| Some((at.estimates[quantity as usize]?, at.load)));
    let size = |one: &(Estimate, f64)| quantity.reported(one.0.contrast).abs();
    each.max_by(|a, b| size(a).total_cmp(&size(b)))
}

impl Count {
    fn add(&mut self, nearer: Option<Kind>) {
        match nearer {
            Some(Kind::Statistical) => self.statistical += 1,
            Some(Kind::Deterministic) => self.sum += 1,
            None => {}
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
                each.iter().filter(|one| side(one).is_some_and(is_side)).count()
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
            verdicts.has_one_surface().then_some([one.contrast - one.bound, one.contrast + one.bound])
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
        let estimate = at.estimates[quantity as usize].map(|estimate| estimate.here());
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
    let words = |stretch: &[&Difference]| match stretch {
        [only] => format!("at {}", loads([only.load; 2])),
        _ => loads([stretch[0].load, stretch[stretch.len() - 1].load]),
    };
    let each: Vec<String> = stretches.map(words).collect();
    each.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::compare::findings::Basis;
    use crate::kind::compare::page::verdict::examples::against_reference;

    fn overview(all: &[Verdicts]) -> Option<Overview> {
        let names = ["first", "second", "third"].into_iter();
        let case = |(name, verdicts): (&str, _)| Case { name: name.to_owned(), alpha: Some(4.0), verdicts };
        Overview::of(&names.zip(all).map(case).collect::<Vec<_>>())
    }

    #[test]
    fn the_largest_differences_and_how_often_the_sum_is_nearer() {
        let nearer_sum = against_reference([0.3, 0.4], [0.02, -0.05], Some(0.001), Basis::Asperities);
        let nearer_statistical = against_reference([0.01, 0.02], [-0.2, -0.5], None, Basis::Asperities);
        assert!(overview(&[against_reference([0.3; 2], [0.1; 2], None, Basis::Asperities)]).is_none());
        let found = overview(&[nearer_sum, nearer_statistical]).unwrap();
        assert_eq!(
            found.sentence(),
            "at valid loads, in real contact area the statistical model differs by up to +49.2 % (first at 10 MPa), the sum by up to \
             −39.3 % (second at 10 MPa); in separation the statistical model differs by up to +0.3 σ (first at 10 MPa), the sum by up to \
             −0.2 σ (second at 10 MPa). With the sampling error of such surfaces the sum is nearer in 2 of the 4 rows of the next \
             table, the statistical model in 0; judged on these maps alone in 2 and 2. Pasaribu and Schipper (2005) conclude that the \
             sum is the more accurate model: of the rows, which overlap, 2 agree with that, 0 contradict it, and 2 cannot be told."
        );
    }

    #[test]
    fn over_realisations_no_map_is_spoken_of() {
        let over = |error| against_reference([0.3, 0.4], [0.02, -0.05], error, Basis::Realisations(3));
        let found = overview(&[over(Some(0.001)), over(Some(0.5))]).unwrap().sentence();
        assert!(
            found.contains(
                "nearer in 2 of the 4 rows of the next table, the statistical model in 0. Pasaribu"
            ),
            "{found}"
        );
    }

    #[test]
    fn a_model_within_on_the_map_alone_is_in_brackets() {
        let told = against_reference([0.3, 0.4], [0.02, -0.05], Some(0.001), Basis::Asperities);
        let here = against_reference([0.3, 0.4], [0.02, -0.05], None, Basis::Asperities);
        let found = overview(&[told, here]).unwrap();
        let within: Vec<&str> = found.rows.iter().map(|row| row.within[1].as_str()).collect();
        assert_eq!(within, ["1 to 10 MPa", "1 to 10 MPa", "(1 to 10 MPa)", "(1 to 10 MPa)"]);
        assert!(found.rows.iter().all(|row| row.within[0] == "no load"));
    }
}
