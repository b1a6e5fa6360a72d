//! The summary of `[solver-validation]`: a sentence for each problem.

use super::super::findings::{AreaOf, Deviation, LOWEST_ORDER, MOST_SAMPLING, PUBLISHED_WITHIN};
use super::super::run::SolverResults;
use super::of_problem;
use crate::solver::ensemble::{bush_gibson_thomas, persson};
use crate::solver::published::ENSEMBLE;
use crate::solver::{Measured, Problem, Quantity};
use asperity_framework::report::format::{input_number, mean_and_deviation, number, percent, ratio};

/// The largest error of a quantity at the finest resolution.
pub fn at_finest<'a>(all: &[&'a Measured], quantity: Quantity) -> Option<&'a Measured> {
    let finest = all.iter().map(|one| one.points).max()?;
    let of_quantity = all.iter().filter(|one| one.points == finest && one.quantity == quantity);
    of_quantity.max_by(|a, b| a.error.abs().total_cmp(&b.error.abs())).copied()
}

/// "at most 1e-5 (allowed: 2e-5)", and the resolution.
fn bounded(one: &Measured) -> String {
    let allowed = one.allowed.map_or_else(String::new, |allowed| format!(" (allowed: {})", number(allowed)));
    format!("{}{allowed}", number(one.error.abs()))
}

/// An error near rounding, to one digit: more would differ between machines.
pub fn rounding(error: f64) -> String {
    format!("{error:.0e}")
}

/// The summary, a line each.
pub fn lines(results: &SolverResults) -> Vec<String> {
    let beyond = results.measured.iter().filter(|one| !one.holds()).count();
    let bounds = results.measured.iter().filter(|one| one.allowed.is_some()).count();
    let mut lines = Vec::new();
    if bounds > 0 {
        lines.push(match beyond {
            0 => format!("**Known solutions**: all {bounds} errors that have a bound are within it."),
            several => format!("**Known solutions**: {several} of {bounds} errors exceed their bound."),
        });
    }
    lines.extend(hertz_line(results));
    lines.extend(sinusoid_line(results));
    lines.extend(full_contact_line(results));
    lines.extend(layered_line(results));
    lines.extend(ensemble_line(results));
    lines.extend(resolution_line(results));
    lines.extend(kappa_line(results));
    lines.extend(work_line(results));
    lines
}

fn hertz_line(results: &SolverResults) -> Option<String> {
    let all = of_problem(results, Problem::Hertz);
    let indentation = at_finest(&all, Quantity::Indentation)?;
    let order = results.findings.order.map_or_else(String::new, |order| {
        format!("; it converges with order {} (allowed: at least {LOWEST_ORDER})", ratio(order))
    });
    Some(format!(
        "**Hertz**: at {} pixels per contact radius the relative error of the indentation is {}{order}.",
        indentation.points,
        bounded(indentation)
    ))
}

fn sinusoid_line(results: &SolverResults) -> Option<String> {
    let all = of_problem(results, Problem::Sinusoid);
    let [width, gap] = [Quantity::Area, Quantity::MeanGap].map(|quantity| at_finest(&all, quantity));
    let (width, gap) = (width?, gap?);
    Some(format!(
        "**Wavy surface**: at {} points per wavelength the contact is at most {} points too wide or too narrow (corrected; \
         allowed: {}), and the error of the mean gap is at most {} of the wave's height (allowed: {}).",
        width.points,
        number(width.error.abs() * width.points as f64),
        number(width.allowed.unwrap_or(f64::INFINITY) * width.points as f64),
        number(gap.error.abs()),
        number(gap.allowed.unwrap_or(f64::INFINITY)),
    ))
}

fn full_contact_line(results: &SolverResults) -> Option<String> {
    let all = of_problem(results, Problem::FullContact);
    let largest = at_finest(&all, Quantity::Pressures)?;
    Some(format!(
        "**Full contact**, with and without a layer: pressures within {} of their amplitude (allowed: {}).",
        rounding(largest.error),
        rounding(largest.allowed.unwrap_or(f64::INFINITY))
    ))
}

fn layered_line(results: &SolverResults) -> Option<String> {
    let all = of_problem(results, Problem::LayeredSphere);
    let worst = at_finest(&all, Quantity::Indentation)?;
    Some(format!(
        "**Sphere on a layer**: at {} pixels per contact radius the relative error of the indentation is at most {} over {} cases.",
        worst.points,
        bounded(worst),
        all.iter().filter(|one| one.quantity == Quantity::Indentation).count()
    ))
}

fn ensemble_line(results: &SolverResults) -> Option<String> {
    let farthest = results.findings.farthest()?;
    let difference = farthest.difference;
    let beside = &results.findings.beside;
    let all_hold = beside.iter().all(|one| one.holds());
    let resolved: Vec<f64> = beside
        .iter()
        .map(|one| one.difference)
        .filter(|difference| difference.mean.abs() > 2.0 * difference.error)
        .map(|difference| difference.mean)
        .collect();
    let signed = |share: f64| format!("{}{}", if share < 0.0 { "−" } else { "+" }, percent(share.abs()));
    let ends = resolved.iter().fold(None, |ends: Option<[f64; 2]>, &share| {
        let [low, high] = ends.unwrap_or([share; 2]);
        Some([low.min(share), high.max(share)])
    });
    let offset = ends.map_or_else(String::new, |[low, high]| {
        format!(
            " At {} of {} loads the difference exceeds two standard errors: {} to {}.",
            resolved.len(),
            beside.len(),
            signed(low),
            signed(high)
        )
    });
    Some(format!(
        "**Published ensemble**: extrapolated areas differ from the published ones by at most {} ± {} (at p/E* = {}); {} {} and two \
         standard errors.{offset}",
        percent(difference.mean),
        percent(difference.error),
        input_number(farthest.pressure),
        if all_hold { "all are within" } else { "not all are within" },
        percent(PUBLISHED_WITHIN)
    ))
}

pub fn area_name(of: AreaOf) -> String {
    match of {
        AreaOf::Raw(points) => format!("points counted on {points} x {points} points"),
        AreaOf::Corrected(points) => format!("corrected areas on {points} x {points} points"),
        AreaOf::Extrapolated => "extrapolated areas".to_owned(),
    }
}

pub fn pixels(points: usize) -> f64 {
    points as f64 * ENSEMBLE.cut_off / ENSEMBLE.side
}

/// What the resolution explains of the differences.
fn resolution_line(results: &SolverResults) -> Option<String> {
    let deviations = &results.findings.deviations;
    let nearest = deviations.first()?;
    let of_earlier = |deviation: &Deviation| deviation.earlier.unwrap_or(f64::INFINITY);
    let to_earlier = deviations.iter().min_by(|a, b| of_earlier(a).total_cmp(&of_earlier(b)))?;
    let per_wave = match nearest.of {
        AreaOf::Raw(points) | AreaOf::Corrected(points) => {
            format!(" ({} per shortest wave)", number(pixels(points)))
        }
        AreaOf::Extrapolated => String::new(),
    };
    let earlier = to_earlier.earlier.map_or_else(String::new, |apart| {
        format!(
            " An earlier file of the authors, which does not say whether its surfaces are the same, is nearest to {} ({}).",
            area_name(to_earlier.of),
            percent(apart)
        )
    });
    let explained = match nearest.of {
        AreaOf::Raw(_) => {
            ": the published areas may be points counted at such a resolution, which is not published"
        }
        AreaOf::Corrected(_) | AreaOf::Extrapolated => "",
    };
    Some(format!(
        "**Resolution**: at the loads with standard errors of at most {}, published areas are nearest to {}{per_wave}, with an r.m.s. \
         difference of {}{explained}.{earlier}",
        percent(MOST_SAMPLING),
        area_name(nearest.of),
        percent(nearest.published),
    ))
}

fn kappa_line(results: &SolverResults) -> Option<String> {
    let kappa = &results.findings.kappa;
    let (at, lightest) = kappa.first()?;
    let (low, high) = (persson(), bush_gibson_thomas());
    let is_near = |theory: f64| (lightest.mean - theory).abs() <= 2.0 * lightest.error;
    let names = [("Persson's", low), ("Bush, Gibson and Thomas's", high)]
        .map(|(name, theory)| format!("{name} {}", number(theory)));
    let [of_persson, of_bush] = &names;
    let place = match (is_near(low), is_near(high)) {
        (true, true) => format!("within two standard errors of {of_persson} and {of_bush}"),
        (false, true) => format!("within two standard errors of {of_bush}, not of {of_persson}"),
        (true, false) => format!("within two standard errors of {of_persson}, not of {of_bush}"),
        (false, false) if lightest.mean < low => format!("below {of_persson} and {of_bush}"),
        (false, false) if lightest.mean > high => format!("above {of_persson} and {of_bush}"),
        (false, false) => format!("between {of_persson} and {of_bush}"),
    };
    let falls = kappa.windows(2).all(|pair| pair[1].1.mean < pair[0].1.mean) && kappa.len() > 1;
    let last = kappa.last().filter(|_| falls).map_or_else(String::new, |(at, kappa)| {
        format!("; it falls with the load, to {} at {}", number(kappa.mean), number(*at))
    });
    Some(format!(
        "**Light loads**: κ = A E* g/(A₀ p) is {} at p/(E* g) = {}, {place}{last}.",
        mean_and_deviation(lightest.mean, lightest.error),
        number(*at),
    ))
}

fn work_line(results: &SolverResults) -> Option<String> {
    let most = results.work.iter().max_by_key(|point| point.convolutions)?;
    let growth = results.findings.growth.iter().map(|(_, fit)| fit.slope);
    let growth = growth.fold(None, |range, slope| {
        let [low, high] = range.unwrap_or([slope; 2]);
        Some([slope.min(low), slope.max(high)])
    });
    let growth = growth.map_or_else(String::new, |[low, high]| {
        format!(
            " Convolutions grow with the points along a side to the power {} to {}.",
            ratio(low),
            ratio(high)
        )
    });
    Some(format!(
        "**Work**: at most {} convolutions to a dual gap of {}, on {} x {} points at p/(E* g) = {}.{growth}",
        most.convolutions,
        number(results.work_error.unwrap_or(most.error)),
        most.points,
        most.points,
        number(most.pressure)
    ))
}
