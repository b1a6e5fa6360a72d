//! The verdict map: cases down, load along, a panel for each quantity.

use asperity::compare::{ComparedQuantity, Difference, Verdict};
use asperity::study::Verdicts;
use asperity_contact_framework::report::format::capitalised;
use asperity_plot::{Axis, Colour, Figure, Layer, Legend, Plot};

use super::differences::{MARGIN, megapascals};
use crate::presentation::quantity_name;

/// What a stretch of loads says: colour, name in the legend, and sign.
pub type Mark = (Colour, &'static str, &'static str);

const WITHIN: Mark = (Colour::Reference, "= within what is accepted", "=");
const TOO_LARGE: Mark = (Colour::Deterministic, "+ integral too large", "+");
const TOO_SMALL: Mark = (Colour::Statistical, "− integral too small", "−");
const OPEN: Mark = (Colour::Neutral, "? cannot be told", "?");
const UNFIT: Mark = (Colour::Others, "× map not fit", "×");

pub const MARKS: [Mark; 5] = [WITHIN, TOO_LARGE, TOO_SMALL, OPEN, UNFIT];

/// The verdicts on several cases at their admissible loads; blank where a load is not admissible. `None` where no load is admissible.
pub fn figure(cases: &[(String, &Verdicts)], title: &str) -> Option<Figure> {
    /// Longer names leave too little room for panels side by side.
    const LONGEST: usize = 10;
    let of_quantity =
        |quantity| cases.iter().map(|(_, verdicts)| tiles(verdicts, quantity)).collect::<Vec<_>>();
    let panels: Vec<(ComparedQuantity, Vec<Tiles>)> = ComparedQuantity::REPORTED
        .map(|quantity| (quantity, of_quantity(quantity)))
        .into_iter()
        .filter(|(_, rows)| rows.iter().any(|tiles| !tiles.is_empty()))
        .collect();
    let is_shown =
        |mark: &Mark| panels.iter().flat_map(|(_, rows)| rows).flatten().any(|(_, shown)| shown == mark);
    let marks: Vec<Mark> = MARKS.into_iter().filter(is_shown).collect();
    let plots: Vec<Plot> =
        panels.iter().map(|(quantity, rows)| panel(cases, *quantity, rows, &marks)).collect();
    let is_narrow = cases.iter().all(|(name, _)| name.chars().count() <= LONGEST);
    let arranged = if is_narrow { Figure::row } else { Figure::column };
    (!plots.is_empty()).then(|| arranged(title, plots))
}

/// A panel, with a key for each of the `marks` of the figure.
fn panel(cases: &[(String, &Verdicts)], quantity: ComparedQuantity, rows: &[Tiles], marks: &[Mark]) -> Plot {
    const ROW: f64 = 24.0;
    let loads = cases.iter().flat_map(|(_, verdicts)| &verdicts.differences).map(|at| megapascals(at.load));
    let [low, high] = [loads.clone().fold(f64::INFINITY, f64::min), loads.fold(0.0, f64::max)];
    let mut plot = Plot::new(
        capitalised(quantity_name(quantity)),
        Axis::log("nominal pressure (MPa)").range(low / MARGIN, high * MARGIN),
        Axis::named(cases.iter().map(|(name, _)| name.clone())),
    )
    .height(ROW * cases.len() as f64)
    .legend(Legend::Below);
    for (colour, name, _) in marks {
        plot = plot.with(Layer::key().coloured(*colour).named(*name));
    }
    for (row, tiles) in rows.iter().enumerate() {
        let row = row as f64;
        for ([from, to], (colour, _, sign)) in tiles {
            plot = plot.with(Layer::tile((*from, row - 0.42), (*to, row + 0.42), *sign).coloured(*colour));
        }
    }
    plot
}

/// Stretches of loads, MPa, with what they say.
type Tiles = Vec<([f64; 2], Mark)>;

/// The stretches of admissible loads (MPa) that say the same, each to half way to its neighbours.
fn tiles(verdicts: &Verdicts, quantity: ComparedQuantity) -> Tiles {
    let mut sorted: Vec<&Difference> =
        verdicts.differences.iter().filter(|at| at.estimates[quantity as usize].is_some()).collect();
    sorted.sort_by(|a, b| a.load.total_cmp(&b.load));
    let half_way = |a: usize, b: usize| megapascals((sorted[a].load * sorted[b].load).sqrt());
    let ends = |k: usize| {
        let at = megapascals(sorted[k].load);
        let before = if k > 0 { half_way(k - 1, k) } else { at / MARGIN.sqrt() };
        let after = if k + 1 < sorted.len() { half_way(k, k + 1) } else { at * MARGIN.sqrt() };
        [before, after]
    };
    let mut tiles = Tiles::new();
    for (k, at) in sorted.iter().enumerate() {
        let Some(mark) = mark(at, verdicts, quantity) else { continue };
        let [from, to] = ends(k);
        match tiles.last_mut() {
            Some((last, same)) if *same == mark && last[1] == from => last[1] = to,
            _ => tiles.push(([from, to], mark)),
        }
    }
    tiles
}

/// What one load says; `None` where it is not admissible.
fn mark(at: &Difference, verdicts: &Verdicts, quantity: ComparedQuantity) -> Option<Mark> {
    let estimate = at.estimates[quantity as usize].filter(|_| at.exceeded().is_none())?;
    if verdicts.is_blocked {
        return Some(UNFIT);
    }
    Some(of_verdict(Verdict::from_estimate(&estimate, verdicts.accepted.band(quantity)), estimate.contrast))
}

fn of_verdict(verdict: Verdict, difference: f64) -> Mark {
    match verdict {
        Verdict::Within | Verdict::VeryLikelyWithin => WITHIN,
        Verdict::Beyond | Verdict::VeryLikelyBeyond if difference > 0.0 => TOO_LARGE,
        Verdict::Beyond | Verdict::VeryLikelyBeyond => TOO_SMALL,
        Verdict::CannotTell => OPEN,
    }
}

/// What a verdict as tables name it says of a difference; `None` where there is none.
pub fn named(verdict: &str, difference: f64) -> Option<Mark> {
    match verdict {
        "blocked" => Some(UNFIT),
        name => {
            let known = Verdict::ALL.into_iter().find(|one| one.name() == name)?;
            Some(of_verdict(known, difference))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::card::tests::verdicts;
    use super::*;

    #[test]
    fn loads_that_say_the_same_are_one_tile() {
        let signs = |contrasts, error| -> Vec<&str> {
            let verdicts = verdicts(90.0, contrasts, error);
            tiles(&verdicts, ComparedQuantity::Area).iter().map(|(_, (_, _, sign))| *sign).collect()
        };
        assert_eq!(signs([0.2, 0.3], Some(0.01)), ["+"]);
        assert_eq!(signs([-0.2, 0.01], Some(0.01)), ["−", "="]);
        assert_eq!(signs([0.2, 0.3], None), ["?"]);
    }

    #[test]
    fn inadmissible_loads_are_blank_and_an_unfit_map_has_its_own_sign() {
        let few = verdicts(9.0, [0.2, 0.3], Some(0.01));
        assert!(tiles(&few, ComparedQuantity::Area).is_empty());
        assert!(figure(&[("few".to_owned(), &few)], "").is_none());
        let unfit = Verdicts { is_blocked: true, ..verdicts(90.0, [0.2, 0.3], Some(0.01)) };
        assert_eq!(tiles(&unfit, ComparedQuantity::Area)[0].1, UNFIT);
    }
}
