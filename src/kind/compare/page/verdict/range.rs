//! The valid range, what is accepted, and what the intervals rest on.

use asperity::compare::{Accepted, CONTACTS_PER_GROUP, ComparedQuantity, GROUPS};
use asperity::sphere::LARGEST_SLOPE;
use asperity::topography::{BLOCK_LENGTHS, MIN_BLOCKS};
use asperity::{Exceeded, INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, MIN_CONTACTS};
use asperity_framework::report::format::{alternatives, input_number, listed, number, percent, quantity};

use super::words::{accepted_separation, forces, loads, nominal_area};

use crate::kind::compare::findings::{Basis, Verdicts};

/// What lies beyond a limit.
pub fn limit_words(limit: Limit) -> String {
    match limit {
        Limit::FewContacts => format!("fewer than {MIN_CONTACTS} effective contacts"),
        Limit::DominantContact => {
            format!("more than {} of the load in one contact", percent(LARGEST_LOAD_SHARE))
        }
        Limit::Interaction => format!("contact area above {}", percent(INTERACTION)),
        Limit::LargeStrain => {
            format!("more than {} of the load at a/R above {LARGEST_SLOPE}", percent(LARGE_STRAIN_SHARE))
        }
    }
}

/// What lies beyond several limits at one load.
fn exceeded_words(exceeded: Exceeded) -> String {
    listed(&exceeded.limits().map(limit_words).collect::<Vec<_>>())
}

/// What lies beyond limits of which each load exceeds at least one.
pub fn any_exceeded_words(exceeded: Exceeded) -> String {
    alternatives(&exceeded.limits().map(limit_words).collect::<Vec<_>>())
}

/// "Valid for 0.5 to 40 MPa (0.5 to 40 N on 1 mm²)", with the limit at either end.
pub fn range_line(verdicts: &Verdicts) -> String {
    let valid = &verdicts.valid;
    if valid.stretches.is_empty() {
        return format!("Valid for no load of this experiment: {}.", any_exceeded_words(valid.below));
    }
    let each: Vec<String> = valid
        .stretches
        .iter()
        .map(|&stretch| {
            let [forces, area] = [forces(stretch, verdicts.area), nominal_area(verdicts.area)];
            format!("{} ({forces} on {area})", loads(stretch))
        })
        .collect();
    let ends = [("below", valid.below), ("above", valid.above)].into_iter();
    let ends: Vec<String> = ends
        .filter(|(_, exceeded)| !exceeded.is_none())
        .map(|(side, exceeded)| format!("{side}: {}", exceeded_words(exceeded)))
        .collect();
    let ends = if ends.is_empty() { "all loads of this experiment".to_owned() } else { ends.join("; ") };
    let count = verdicts.differences.len();
    let loads_line = match count {
        0 => String::new(),
        1 => " Judged at one load.".to_owned(),
        _ => format!(
            " Judged at {count} loads from {}.",
            loads([verdicts.differences[0].load, verdicts.differences[count - 1].load])
        ),
    };
    format!("Valid for {}; {ends}.{loads_line}", listed(&each))
}

/// Why the stiffness is not compared, if it is not.
pub fn stiffness_line(verdicts: &Verdicts) -> Option<String> {
    let is_compared =
        verdicts.differences.iter().any(|at| at.estimates[ComparedQuantity::Stiffness as usize].is_some());
    (!is_compared).then(|| {
        "the stiffness is not compared, because the load of an asperity jumps by more than 1 %: the stiffness of the sum \
         leaves jumps out, that of the integral includes them."
            .to_owned()
    })
}

/// What the user accepts, on a surface of `sigma` (m).
pub fn accepted_line(accepted: &Accepted, sigma: f64) -> String {
    format!(
        "Accepted (key `accept`): {} of the real contact area, {} in separation, {} of the stiffness. *Within*: the 95 % \
         interval of the difference at equal load lies inside what is accepted; *beyond*: outside it; *cannot tell*: across its \
         edge, or no interval is claimed.",
        percent(accepted.area),
        accepted_separation(accepted.separation, sigma),
        percent(accepted.stiffness),
    )
}

/// What the intervals rest on.
pub fn basis_line(verdicts: &Verdicts) -> String {
    let times = verdicts.over_independent.map_or_else(String::new, |ratio| {
        format!(
            " Their standard errors are {} times those for independent asperities (separation, median).",
            number(ratio)
        )
    });
    let few = |groups: usize| {
        let contacts = CONTACTS_PER_GROUP * groups as f64;
        format!("None is claimed with fewer than {contacts} effective contacts.")
    };
    match verdicts.basis {
        Basis::Realisations(count) => format!(
            "95 % intervals are pointwise, from the scatter of {count} realisations (Student's quantile); differences are their \
             means.{times}"
        ),
        Basis::Blocks { count, sides, lengths } => {
            let [x, y] = sides.map(|side| quantity(side, "m"));
            let [nx, ny] = lengths.map(number);
            format!(
                "95 % intervals are pointwise, from a jackknife over {count} blocks of {x} × {y}, {nx} × {ny} correlation \
                 lengths of the heights: both models are computed again without each block. {}{times}",
                few(count)
            )
        }
        Basis::TooSmall { correlation } => {
            let lengths = correlation.map(|length| {
                if length.is_finite() {
                    quantity(length, "m")
                } else {
                    "more than half of the side".to_owned()
                }
            });
            format!(
                "No interval is claimed: the map does not hold {MIN_BLOCKS} blocks of {} correlation lengths each (correlation \
                 length of the heights: {} along x, {} along y).",
                input_number(BLOCK_LENGTHS),
                lengths[0],
                lengths[1]
            )
        }
        Basis::Asperities => format!(
            "95 % intervals are pointwise, from a jackknife over {GROUPS} random groups of asperities, which are taken as \
             independent draws: both models are computed again without each group. {}",
            few(GROUPS)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::{at, verdicts};
    use super::*;

    #[test]
    fn the_valid_range_names_the_limit_at_either_end() {
        let none = [(0.0, Some(0.01)); 3];
        let mut loads =
            vec![at(1e5, 12.0, none), at(1e6, 40.0, none), at(2e6, 50.0, none), at(4e6, 60.0, none)];
        loads[3].area_ratio = 0.06;
        let found = verdicts(loads.clone(), Basis::Asperities);
        assert_eq!(
            range_line(&found),
            "Valid for 1 to 2 MPa (1 to 2 N on 1 mm²); below: fewer than 30 effective contacts; above: contact area above 5 %. \
             Judged at 4 loads from 100 kPa to 4 MPa."
        );
        let found = verdicts(loads[1..3].to_vec(), Basis::Asperities);
        assert!(range_line(&found).contains("all loads of this experiment. Judged at 2 loads"));
        loads[0].sharing.as_mut().unwrap().largest_share = 0.2;
        let found = verdicts(vec![loads[0].clone(), loads[3].clone()], Basis::Asperities);
        assert_eq!(
            range_line(&found),
            "Valid for no load of this experiment: fewer than 30 effective contacts, more than 10 % of the load in one contact \
             or contact area above 5 %."
        );
        loads[0].sharing.as_mut().unwrap().largest_share = 0.01;
        let found = verdicts(loads[..1].to_vec(), Basis::Asperities);
        assert_eq!(
            range_line(&found),
            "Valid for no load of this experiment: fewer than 30 effective contacts."
        );
    }

    #[test]
    fn without_blocks_no_interval_is_claimed() {
        let of = |basis| basis_line(&verdicts(Vec::new(), basis));
        assert!(
            of(Basis::TooSmall { correlation: [1e-5, f64::INFINITY] }).starts_with("No interval is claimed")
        );
        assert!(of(Basis::Realisations(8)).contains("8 realisations"));
        assert!(of(Basis::Asperities).contains("independent draws"));
        assert!(of(Basis::Asperities).contains("fewer than 64 effective contacts"));
        let blocks = Basis::Blocks { count: 20, sides: [1e-4; 2], lengths: [9.0; 2] };
        assert!(of(blocks).contains("fewer than 80 effective contacts"));
    }
}
