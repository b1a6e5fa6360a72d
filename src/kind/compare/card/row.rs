//! The answer on one case in a row of a table and at one load, and on several cases in a sentence.

use asperity::compare::{ByQuantity, ComparedQuantity, ModelKind, Stretch};
use asperity::study::{ModelResult, Verdicts};
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{input_quantity, listed, number, percent, quantity, signed};

use super::super::rows::SurfaceCase;
use super::{Card, Nearer, area};

/// May the integral replace the sum in one quantity, over the admissible loads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answered {
    /// At all of them, surely or very likely.
    Yes,
    /// At some of them; at the others it cannot be told.
    YesWhereTold,
    /// At none where it can be told.
    No,
    /// At some of them, at others not.
    InPart,
    /// It cannot be told.
    Open,
    /// No load is admissible.
    Outside,
    Unfit,
}

impl Answered {
    /// What a cell of a table says.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::YesWhereTold => "yes/?",
            Self::No => "no",
            Self::InPart => "in part",
            Self::Open => "?",
            Self::Outside => "outside",
            Self::Unfit => "unfit",
        }
    }
}

pub struct CaseAnswer {
    /// In the order of [`ComparedQuantity::REPORTED`]: the answer and the largest difference, as reported; `None` of a quantity that is not compared.
    pub quantities: ByQuantity<Option<(Answered, Option<f64>)>>,
    /// The cause of the largest difference that is beyond what is accepted, in a few words.
    pub why: String,
    /// What to use at the load of its card, in a few words.
    pub instead: String,
    /// Which model is nearer to boundary elements; `None` where that was not computed.
    pub nearer: Option<Nearer>,
}

impl CaseAnswer {
    /// `None` of a case whose models are not compared at equal load.
    pub fn new(case: SurfaceCase) -> Option<Self> {
        let card = Card::new(case);
        let at = case.case.reported_load()?;
        Some(Self {
            quantities: ComparedQuantity::REPORTED.map(|quantity| of_quantity(case.verdicts(), quantity)),
            why: card.cause_in_short(),
            instead: card.instead_in_short(at),
            nearer: card.nearer_over_loads(),
        })
    }

    /// The answer in all quantities together.
    fn overall(&self) -> Answered {
        let mut each: Vec<Answered> = self.quantities.iter().flatten().map(|(answer, _)| *answer).collect();
        each.dedup();
        match each[..] {
            [only] => only,
            _ if each.contains(&Answered::No) => Answered::No,
            _ if each.contains(&Answered::InPart) => Answered::InPart,
            _ if each.contains(&Answered::Open) => Answered::Open,
            _ => Answered::YesWhereTold,
        }
    }
}

fn of_quantity(verdicts: &Verdicts, quantity: ComparedQuantity) -> Option<(Answered, Option<f64>)> {
    let stretches: Vec<&Stretch> = verdicts.stretches.iter().filter(|one| one.quantity == quantity).collect();
    // Of a difference that is beyond what is accepted where it is known to be.
    let is_beyond = |one: &&&Stretch| one.verdict.is_beyond();
    let any_is_beyond = stretches.iter().any(|one| one.verdict.is_beyond());
    let shown = stretches.iter().filter(|one| !any_is_beyond || is_beyond(one));
    let largest = shown.filter_map(|one| Some(one.largest?.1.contrast));
    let largest =
        largest.max_by(|a, b| a.abs().total_cmp(&b.abs())).map(|contrast| quantity.reported(contrast));
    let has = |is_wanted: fn(&&&Stretch) -> bool| stretches.iter().any(|one| is_wanted(&one));
    let [beyond, within, open] = [
        has(|one| one.verdict.is_beyond()),
        has(|one| one.verdict.is_within()),
        has(|one| !one.verdict.is_told()),
    ];
    let answer = match () {
        () if stretches.is_empty() => return None,
        () if verdicts.is_blocked => Answered::Unfit,
        () if verdicts.admissible.stretches.is_empty() => Answered::Outside,
        () if within && beyond => Answered::InPart,
        () if within && open => Answered::YesWhereTold,
        () if within => Answered::Yes,
        () if beyond => Answered::No,
        () => Answered::Open,
    };
    Some((answer, largest))
}

/// How many cases have which answer.
pub struct Counts<'a>(&'a [CaseAnswer]);

impl<'a> Counts<'a> {
    pub const fn new(answers: &'a [CaseAnswer]) -> Self {
        Self(answers)
    }

    /// "May the integral replace the sum? Of 7 cases: no in 3, at some loads in 2 and cannot be told in 2." With boundary elements also:
    /// "Nearer to boundary elements in contact area, where decided: the sum in 5 and undecided in 2."
    pub fn sentences(&self) -> String {
        const ANSWERS: [(Answered, &str); 7] = [
            (Answered::Yes, "yes in"),
            (Answered::YesWhereTold, "yes where it can be told in"),
            (Answered::InPart, "at some loads in"),
            (Answered::No, "no in"),
            (Answered::Open, "cannot be told in"),
            (Answered::Outside, "no admissible load in"),
            (Answered::Unfit, "unfit map in"),
        ];
        const NEARER: [(Nearer, &str); 4] = [
            (Nearer::Sum, "the sum in"),
            (Nearer::Integral, "the integral in"),
            (Nearer::ByLoad, "depending on the load in"),
            (Nearer::Undecided, "undecided in"),
        ];
        let Self(answers) = self;
        let overall: Vec<Answered> = answers.iter().map(CaseAnswer::overall).collect();
        let nearer: Vec<Nearer> = answers.iter().filter_map(|one| one.nearer).collect();
        let replace = format!(
            "May the integral replace the sum? Of {}: {}.",
            cases(overall.len()),
            counted(&overall, &ANSWERS)
        );
        if nearer.is_empty() {
            return replace;
        }
        let of = if nearer.len() == overall.len() {
            String::new()
        } else {
            format!(" (of {})", cases(nearer.len()))
        };
        format!(
            "{replace} Nearer to boundary elements in contact area, where decided{of}: {}.",
            counted(&nearer, &NEARER)
        )
    }
}

fn cases(count: usize) -> String {
    if count == 1 { "1 case".to_owned() } else { format!("{count} cases") }
}

/// "yes in 2 and no in 5", "no in all".
fn counted<T: PartialEq>(found: &[T], words: &[(T, &str)]) -> String {
    let part = |(wanted, words): &(T, &str)| match found.iter().filter(|one| *one == wanted).count() {
        0 => None,
        all if all == found.len() => Some(format!("{words} all")),
        some => Some(format!("{words} {some}")),
    };
    listed(&words.iter().filter_map(part).collect::<Vec<_>>())
}

impl Card<'_> {
    /// "5 N on 4 mm² (1.25 MPa): 3200 µm² in 180 contacts at 1.55 GPa, 97 % elastic-plastic (sum); integral +13 %, boundary elements -5 %."
    /// `None` where nothing was run.
    pub(super) fn result(&self) -> Option<String> {
        let at_load = self.case.results_at_load();
        let find = |kind| at_load.models.iter().find(|one| one.model == kind);
        let order = [Some(ModelKind::Deterministic), Some(ModelKind::Statistical), None];
        let model = order.into_iter().find_map(find)?;
        let nominal = self.load_area;
        let pressure = model.point.pressure;
        let load = format!(
            "{} on {} ({})",
            quantity(pressure * nominal, "N"),
            area(nominal),
            input_quantity(pressure, "Pa")
        );
        let real = area(model.point.area_ratio * nominal);
        let others: Vec<String> = at_load
            .models
            .iter()
            .filter(|other| other.model != model.model)
            .filter_map(|other| relative_to(other, model, |one| Some(one.point.area_ratio)))
            .collect();
        let others = if others.is_empty() { String::new() } else { format!("; {}", others.join(", ")) };
        let others = self.elastic(others);
        let [contacts, mean, regime] = details(model, nominal);
        let text = |contacts: &str, mean: &str, regime: &str| {
            format!("{load}: {real}{contacts}{mean}{regime} ({}){others}.", model_name(model.model))
        };
        Some(fitting([
            text(&contacts, &mean, &regime),
            text(&contacts, &mean, ""),
            text(&contacts, "", ""),
            text("", "", ""),
        ]))
    }
}

pub(super) fn model_name(model: Option<ModelKind>) -> &'static str {
    match model {
        Some(ModelKind::Deterministic) => "sum",
        Some(ModelKind::Statistical) => "integral",
        None => "boundary elements",
    }
}

/// "integral +13 %": a quantity `of` a model against that of another; `None` without contact.
pub(super) fn relative_to(
    other: &ModelResult,
    model: &ModelResult,
    of: impl Fn(&ModelResult) -> Option<f64>,
) -> Option<String> {
    let ratio = of(other)? / of(model)?;
    // Less is beyond the digits of every result.
    const LEAST: f64 = 0.05;
    let percent = 100.0 * (ratio - 1.0);
    let difference = if percent.abs() < LEAST { "< 0.1".to_owned() } else { signed(percent) };
    (ratio > 0.0 && ratio.is_finite()).then(|| format!("{} {difference} %", model_name(other.model)))
}

/// The number of contacts, their mean pressure, and the regime with the largest share of the load.
fn details(model: &ModelResult, nominal: f64) -> [String; 3] {
    let point = &model.point;
    let contacts = point.contact_density.map_or_else(String::new, |density| {
        let count = density * nominal;
        let count = if count < 99.5 { number(count) } else { number(count.round()) };
        format!(" in {count} {}", if count == "1" { "contact" } else { "contacts" })
    });
    let mean =
        point.mean_real_pressure().map_or_else(String::new, |mean| format!(" at {}", quantity(mean, "Pa")));
    let regime = point.shares.map_or_else(String::new, |shares| {
        let names = ["elastic", "elastic-plastic", "plastic"];
        let largest = (0..3).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0);
        format!(", {} {}", percent(shares[largest]), names[largest])
    });
    [contacts, mean, regime]
}

#[cfg(test)]
mod tests {
    use super::super::tests::verdicts;
    use super::*;

    #[test]
    fn an_answer_over_the_loads_says_where_it_holds() {
        let of = |verdicts: &Verdicts| of_quantity(verdicts, ComparedQuantity::Area).unwrap();
        let answered = |contrasts, error| of(&verdicts(90.0, contrasts, error)).0;
        assert_eq!(answered([0.01, 0.02], Some(0.01)), Answered::Yes);
        assert_eq!(answered([0.01, 0.1], Some(0.01)), Answered::YesWhereTold);
        assert_eq!(answered([0.01, 0.2], Some(0.01)), Answered::InPart);
        assert_eq!(answered([0.1, 0.1], Some(0.01)), Answered::Open);
        assert_eq!(of(&verdicts(9.0, [0.01, 0.2], Some(0.01))).0, Answered::Outside);
        let unfit = Verdicts { is_blocked: true, ..verdicts(90.0, [0.2, 0.3], Some(0.01)) };
        assert_eq!(of(&unfit).0, Answered::Unfit);
        // The larger difference is not known to be beyond.
        let mut wide = verdicts(90.0, [0.2, 0.5], Some(0.01));
        wide.differences[1].estimates[1].as_mut().unwrap().error = Some(0.3);
        wide.stretches = Stretch::all(&wide.differences, &wide.accepted);
        let (answer, largest) = of(&wide);
        assert_eq!(answer, Answered::No);
        assert!((largest.unwrap() - 0.2f64.exp_m1()).abs() < 1e-12, "{largest:?}");
        assert!(of_quantity(&wide, ComparedQuantity::Stiffness).is_none());
    }

    fn answer(quantities: [Answered; 3]) -> CaseAnswer {
        CaseAnswer {
            quantities: std::array::from_fn(|place| Some((*quantities.get(place)?, None))),
            why: String::new(),
            instead: String::new(),
            nearer: None,
        }
    }

    #[test]
    fn one_quantity_that_is_beyond_makes_a_no() {
        use Answered::{InPart, No, Open, Yes};
        let overall = |quantities| answer(quantities).overall();
        assert_eq!(overall([Yes; 3]), Yes);
        assert_eq!(overall([Yes, No, Open]), No);
        assert_eq!(overall([Yes, InPart, Open]), InPart);
        assert_eq!(overall([Yes, Open, Yes]), Open);
        assert_eq!(overall([Yes, Answered::YesWhereTold, Yes]), Answered::YesWhereTold);
    }

    #[test]
    fn cases_are_counted_in_a_sentence() {
        use Answered::{No, Unfit, Yes};
        let sentence = |all: &[CaseAnswer]| Counts::new(all).sentences();
        let [yes, no] = [Yes, No].map(|one| answer([one; 3]));
        assert_eq!(
            sentence(&[yes, no, answer([Unfit; 3])]),
            "May the integral replace the sum? Of 3 cases: yes in 1, no in 1 and unfit map in 1."
        );
        assert!(sentence(&[answer([No; 3]), answer([Yes, No, Yes])]).ends_with("Of 2 cases: no in all."));
    }

    #[test]
    fn the_model_that_is_nearer_to_boundary_elements_is_counted_where_they_were_run() {
        let near = |nearer| CaseAnswer { nearer, ..answer([Answered::No; 3]) };
        let said = |all: &[Option<Nearer>]| {
            Counts::new(&all.iter().map(|one| near(*one)).collect::<Vec<_>>()).sentences()
        };
        assert!(!said(&[None, None]).contains("boundary elements"));
        assert!(
            said(&[Some(Nearer::Sum); 2])
                .ends_with(" Nearer to boundary elements in contact area, where decided: the sum in all.")
        );
        assert!(
            said(&[Some(Nearer::Integral), Some(Nearer::Undecided), None])
                .ends_with(", where decided (of 2 cases): the integral in 1 and undecided in 1.")
        );
    }
}
