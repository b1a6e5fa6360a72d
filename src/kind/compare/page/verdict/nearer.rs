//! Both models against the reference, in words and in a table.

use asperity::compare::{ComparedQuantity, Difference, Estimate, Kind, NearerStretch, Verdict};
use asperity::numeric::decades;
use asperity_framework::report::format::{capitalised, listed, number, with_sign};
use asperity_framework::report::page::Page;

use super::words::{loads, name, over, signed, verdict};
use crate::kind::compare::findings::{ReferenceVerdicts, Verdicts};

/// The order in which quantities are spoken of.
pub(super) const ORDER: [ComparedQuantity; 3] = ComparedQuantity::REPORTED;

/// A model as sentences name it.
fn model(kind: Kind) -> &'static str {
    match kind {
        Kind::Statistical => "the statistical model",
        Kind::Deterministic => "the sum",
    }
}

/// Which model is nearer to the reference, in one sentence: of each quantity its widest stretch of load with an answer, or
/// the widest where there is none. `None` where no reference was compared at a valid load.
pub fn nearer_sentence(verdicts: &Verdicts) -> Option<String> {
    let reference = verdicts.reference.as_ref()?;
    let widest = |quantity: ComparedQuantity| {
        let of = reference.nearer.iter().filter(move |stretch| stretch.quantity == quantity);
        let told = |stretch: &NearerStretch| (stretch.nearer.is_some(), stretch.nearer_here.is_some());
        let rank = |stretch: &NearerStretch| (told(stretch), decades(stretch.loads));
        of.max_by(|a, b| {
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    };
    let main: Vec<&NearerStretch> = ORDER.into_iter().filter_map(widest).collect();
    if main.is_empty() {
        return None;
    }
    let (told, open): (Vec<&NearerStretch>, Vec<&NearerStretch>) =
        main.into_iter().partition(|stretch| stretch.nearer.is_some());
    let mut sentences = Vec::new();
    if !told.is_empty() {
        let clause = |one: &&NearerStretch| clause(reference, one, Reach::Surfaces);
        let clauses: Vec<String> = told.iter().filter_map(clause).collect();
        sentences.push(format!("nearer to it is {}.", clauses.join("; ")));
    }
    // What holds on this very map may be said where no interval allows more.
    let (here, open): (Vec<&NearerStretch>, Vec<&NearerStretch>) =
        open.into_iter().partition(|stretch| stretch.nearer_here.is_some() && verdicts.has_one_surface());
    if !here.is_empty() {
        let clause = |one: &&NearerStretch| clause(reference, one, Reach::ThisMap);
        let clauses: Vec<String> = here.iter().filter_map(clause).collect();
        sentences.push(format!(
            "on this map nearer to it is {}; whether that holds for such surfaces cannot be told.",
            clauses.join("; ")
        ));
    }
    if !open.is_empty() {
        let names: Vec<String> = open.iter().map(|stretch| open_clause(stretch)).collect();
        sentences.push(format!(
            "which model is nearer cannot be told, or both are as near, in {}.",
            listed(&names)
        ));
    }
    let rest = sentences.split_off(1).into_iter().map(|sentence| capitalised(&sentence));
    Some(sentences.into_iter().chain(rest).collect::<Vec<_>>().join(" "))
}

/// What a statement is about.
#[derive(Clone, Copy)]
enum Reach {
    /// Surfaces of which the map is a sample.
    Surfaces,
    /// The map alone.
    ThisMap,
}

impl Reach {
    fn nearer(self, stretch: &NearerStretch) -> Option<Kind> {
        match self {
            Self::Surfaces => stretch.nearer,
            Self::ThisMap => stretch.nearer_here,
        }
    }

    fn verdicts(self, stretch: &NearerStretch) -> [Verdict; 2] {
        match self {
            Self::Surfaces => stretch.verdicts,
            Self::ThisMap => stretch.verdicts_here,
        }
    }
}

/// "the statistical model in real contact area from 1 to 20 MPa (−9 % at 1 MPa; the sum −40 % at 20 MPa), but the sum at 50 MPa".
fn clause(reference: &ReferenceVerdicts, stretch: &NearerStretch, reach: Reach) -> Option<String> {
    let nearer = reach.nearer(stretch)?;
    let (near, far) = match nearer {
        Kind::Statistical => (0, 1),
        Kind::Deterministic => (1, 0),
    };
    let other = [Kind::Statistical, Kind::Deterministic][far];
    let largest = |model: usize| {
        let (load, estimate) = stretch.largest[model];
        let at = if stretch.loads[0] == stretch.loads[1] {
            String::new()
        } else {
            format!(" at {}", loads([load; 2]))
        };
        format!("{}{at}", signed(stretch.quantity, estimate.contrast))
    };
    let end = match reach.verdicts(stretch) {
        [Verdict::Within, Verdict::Within] => ", both within what is accepted",
        [Verdict::Beyond, Verdict::Beyond] => ", neither within what is accepted",
        verdicts if verdicts[near] == Verdict::Within => ", within what is accepted",
        verdicts if verdicts[near] == Verdict::Beyond => ", beyond what is accepted",
        _ => "",
    };
    let turned = reference.nearer.iter().filter(|one| one.quantity == stretch.quantity);
    let turned = turned.filter(|one| reach.nearer(one) == Some(other));
    let turned: Vec<String> = turned.map(|one| over(one.loads)).collect();
    let turn =
        if turned.is_empty() { String::new() } else { format!(", but {} {}", model(other), listed(&turned)) };
    Some(format!(
        "{} in {} {} ({}; {} {}){end}{turn}",
        model(nearer),
        name(stretch.quantity),
        over(stretch.loads),
        largest(near),
        model(other),
        largest(far),
    ))
}

/// "stiffness at 1 MPa (statistical model −3 %, sum −5 %)".
fn open_clause(stretch: &NearerStretch) -> String {
    let at = |model: usize| signed(stretch.quantity, stretch.largest[model].1.contrast);
    format!("{} {} (statistical model {}, sum {})", name(stretch.quantity), over(stretch.loads), at(0), at(1))
}

/// One row per quantity and stretch of load at which both models stand alike.
pub fn nearer(page: &mut Page, verdicts: &Verdicts, reference: &ReferenceVerdicts) {
    let largest = |quantity: ComparedQuantity, (load, estimate): (f64, Estimate)| {
        let interval = estimate.interval().map_or_else(
            || " (no interval)".to_owned(),
            |ends| {
                let [low, high] = ends.map(|end| signed(quantity, end));
                format!(" ({low} to {high})")
            },
        );
        format!("{}{interval} at {}", signed(quantity, estimate.contrast), loads([load; 2]))
    };
    let row = |stretch: &NearerStretch| {
        let nearer = match stretch.nearer {
            Some(Kind::Statistical) => "statistical",
            Some(Kind::Deterministic) => "sum",
            None => match stretch.nearer_here.filter(|_| verdicts.has_one_surface()) {
                Some(Kind::Statistical) => "on this map: statistical",
                Some(Kind::Deterministic) => "on this map: sum",
                None => "cannot tell",
            },
        };
        let blocked = if verdicts.is_blocked { "blocked: " } else { "" };
        vec![
            name(stretch.quantity).to_owned(),
            loads(stretch.loads),
            largest(stretch.quantity, stretch.largest[0]),
            verdict(stretch.verdicts[0]).to_owned(),
            largest(stretch.quantity, stretch.largest[1]),
            verdict(stretch.verdicts[1]).to_owned(),
            format!("{blocked}{nearer}"),
        ]
    };
    let of = |quantity| reference.nearer.iter().filter(move |stretch| stretch.quantity == quantity);
    page.table(
        [
            "quantity",
            "load",
            "statistical − reference (95 %)",
            "verdict",
            "sum − reference (95 %)",
            "verdict",
            "nearer",
        ],
        ORDER.into_iter().flat_map(of).map(row),
    );
}

/// The difference of the sum from the reference at its lightest and heaviest valid load, with Nayak's `alpha` of the map.
pub fn misses(reference: &ReferenceVerdicts, alpha: Option<f64>) -> Option<String> {
    let valid = || reference.against.models[1].iter().filter(|at| at.exceeded().is_none());
    let (first, last) = (valid().next()?, valid().next_back()?);
    let of = |at: &Difference| {
        let part = |quantity: ComparedQuantity, shown: &dyn Fn(f64) -> String| {
            let Estimate { contrast, bound, .. } = at.estimates[quantity as usize]?;
            let doubt = if contrast.abs() <= bound { ", less than the error of the reference" } else { "" };
            Some(format!("{}{doubt}", shown(contrast)))
        };
        let separation = part(ComparedQuantity::Separation, &|h| {
            format!("{} of separation", signed(ComparedQuantity::Separation, h))
        });
        let area = part(ComparedQuantity::Area, &|log| {
            format!("{} in ln(A) ({} of area)", with_sign(log, number), signed(ComparedQuantity::Area, log))
        });
        let parts: Vec<String> = [separation, area].into_iter().flatten().collect();
        format!("at {} {}", loads([at.load; 2]), listed(&parts))
    };
    let causes = ["interaction", "geometry"].into_iter();
    let causes = causes.chain(reference.yields.then_some("plasticity"));
    let causes = causes.chain(reference.is_layered.then_some("the effective modulus of the layer"));
    let what = listed(&causes.map(str::to_owned).collect::<Vec<_>>());
    let values = if first.load == last.load { of(first) } else { format!("{}; {}", of(first), of(last)) };
    let alpha = alpha.map_or_else(String::new, |alpha| format!(" Nayak's α of the map: {}.", number(alpha)));
    Some(format!("What the sum misses ({what}; sum minus reference): {values}.{alpha}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::compare::findings::Basis;
    use crate::kind::compare::page::verdict::examples::against_reference;

    /// The verdicts and the sentence.
    fn against(
        statistical: [f64; 2],
        sum: [f64; 2],
        error: Option<f64>,
        basis: Basis,
    ) -> (Verdicts, Option<String>) {
        let verdicts = against_reference(statistical, sum, error, basis);
        let sentence = nearer_sentence(&verdicts);
        (verdicts, sentence)
    }

    #[test]
    fn the_nearer_model_with_both_differences_and_whether_it_is_accepted() {
        let sentence = against([0.3, 0.05], [0.02, -0.5], Some(0.001), Basis::Asperities).1.unwrap();
        assert_eq!(
            sentence,
            "nearer to it is the statistical model in real contact area from 1 to 10 MPa (+5.13 % at 10 MPa; the sum −39.3 % at 10 MPa), \
             within what is accepted; the sum in separation from 1 to 10 MPa (+0.02 σ at 10 MPa; the statistical model +0.3 σ at \
             10 MPa), within what is accepted."
        );
        let sentence = against([0.5, 0.2], [0.3, 0.02], Some(0.001), Basis::Asperities).1.unwrap();
        assert!(sentence.contains(
            "the sum in separation from 1 to 10 MPa (+0.3 σ at 10 MPa; the statistical model +0.5 σ at 10 MPa), neither within"
        ));
        let sentence = against([0.05, 0.02], [0.01, 0.01], Some(0.001), Basis::Asperities).1.unwrap();
        assert!(sentence.contains(
            "(+0.01 σ at 10 MPa; the statistical model +0.05 σ at 10 MPa), both within what is accepted"
        ));
    }

    #[test]
    fn without_an_interval_this_map_alone_is_spoken_of() {
        let sentence = against([0.3, 0.05], [0.02, -0.5], None, Basis::Asperities).1.unwrap();
        assert!(
            sentence.starts_with("on this map nearer to it is the statistical model in real contact area"),
            "{sentence}"
        );
        assert!(sentence.ends_with("whether that holds for such surfaces cannot be told."));
        let sentence = against([0.3, 0.05], [0.02, -0.5], Some(0.5), Basis::Realisations(3)).1.unwrap();
        assert_eq!(
            sentence,
            "which model is nearer cannot be told, or both are as near, in real contact area from 1 to 10 MPa (statistical model \
             +5.13 %, sum −39.3 %) and separation from 1 to 10 MPa (statistical model +0.3 σ, sum +0.02 σ)."
        );
    }

    #[test]
    fn a_ranking_that_turns_is_said() {
        let (mut found, _) = against([0.3, 0.4], [0.02, -0.05], Some(0.001), Basis::Asperities);
        let reference = found.reference.as_mut().unwrap();
        let turned =
            NearerStretch { loads: [5e7; 2], nearer: Some(Kind::Statistical), ..reference.nearer[0].clone() };
        reference.nearer.push(turned);
        let sentence = nearer_sentence(&found).unwrap();
        assert!(
            sentence.ends_with("within what is accepted, but the statistical model at 50 MPa."),
            "{sentence}"
        );
        let (found, sentence) = against([0.5, 0.4], [0.3, -0.3], None, Basis::Asperities);
        assert_eq!(found.reference.unwrap().nearer[0].verdicts, [Verdict::CannotTell; 2]);
        assert!(
            sentence
                .unwrap()
                .contains("the statistical model +0.5 σ at 10 MPa), neither within what is accepted")
        );
    }

    #[test]
    fn what_the_sum_misses() {
        let (found, _) = against([0.3, 0.05], [-0.02, -0.5], Some(0.001), Basis::Asperities);
        assert_eq!(
            misses(found.reference.as_ref().unwrap(), Some(12.34)).unwrap(),
            "What the sum misses (interaction and geometry; sum minus reference): at 1 MPa −0.02 σ of separation and −0.5 in ln(A) \
             (−39.3 % of area); at 10 MPa −0.02 σ of separation and −0.5 in ln(A) (−39.3 % of area). Nayak's α of the map: 12.3."
        );
        let (mut found, _) = against([0.3, 0.05], [-0.02, 0.5], Some(0.001), Basis::Asperities);
        let reference = found.reference.as_mut().unwrap();
        let of_sum = reference.against.models[1].iter_mut().flat_map(|at| at.estimates.iter_mut().flatten());
        of_sum.for_each(|estimate| estimate.bound = 0.1);
        let missed = misses(reference, None).unwrap();
        assert!(missed.contains(
            "at 1 MPa −0.02 σ of separation, less than the error of the reference and +0.5 in ln(A)"
        ));
    }
}
