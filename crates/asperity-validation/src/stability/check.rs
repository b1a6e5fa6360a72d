//! Error of a result.

use rayon::prelude::*;

use super::bodies::Bodies;
use super::cases::{Case, CaseInput, SetParameters};
use super::exact::{Contact, Exact};
use super::group::Group;
use super::quantity::Quantity;
use crate::stability::exact::Integral;
use crate::stability::exact::Shape;
use crate::stability::exact::Total;
use crate::stability::wide::{Wide, relative_error};
use asperity::{
    AsperitySet, Deterministic, MicroContact, Model, Population, ReferencePlane, Response, Statistical,
    at_pressure, law,
};

/// Error of one quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Of what.
    pub quantity: Quantity,
    /// Relative error against the exact result for the unrounded input.
    pub error: f64,
    /// Relative error against the exact results for all separations within rounding of the input; the same as
    /// `error` where the input is not rounded.
    pub checked: f64,
}

/// What keeps a case from being checked as right.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    /// A NaN or an infinity.
    #[error("no finite {}", .0.name())]
    NotFinite(Quantity),
    /// Another regime than the exact one, away from a boundary.
    #[error("the wrong regime")]
    WrongRegime,
    /// A case that the program refuses.
    #[error("refused: {0}")]
    Refused(String),
    /// The wide rule did not settle: the case is not checked.
    #[error("not checked, for the wide rule does not settle")]
    Unsettled,
}

/// What came of a case.
#[derive(Debug, Clone)]
pub struct CheckedCase {
    /// The case.
    pub case: Case,
    /// Errors, or why they are not known.
    pub outcome: Result<Vec<Deviation>, Failure>,
}

pub(super) fn check(case: Case) -> CheckedCase {
    let outcome = match case.bodies.contact() {
        Err(error) => Err(Failure::Refused(error.to_string())),
        Ok(contact) => of(&case, &*contact),
    };
    CheckedCase { case, outcome }
}

fn of(case: &Case, contact: &dyn MicroContact) -> Result<Vec<Deviation>, Failure> {
    match &case.input {
        CaseInput::Contact { w, radius } if case.group == Group::Denormals => {
            of_denormal(&case.bodies, contact, *w, *radius)
        }
        CaseInput::Contact { w, radius } => {
            let exact = Exact::new(&case.bodies).contacts(*w, &Shape::sphere(*radius));
            of_contact(&contact.contact(*w, law::Shape::sphere(*radius)), &exact)
        }
        CaseInput::Ellipse { w, mean_curvature, ratio } => {
            let exact = Exact::new(&case.bodies).contacts(*w, &Shape::ellipse(*mean_curvature, *ratio));
            of_contact(&contact.contact(*w, law::Shape::ellipse(*mean_curvature, *ratio)), &exact)
        }
        CaseInput::Sum(set, h) if case.group.is_large() => of_terms(contact, set, *h),
        CaseInput::Sum(set, h) => of_sum(&case.bodies, contact, set, *h),
        CaseInput::Integral(population, h) => of_integral(case, contact, population, *h),
        CaseInput::LoadOfIntegral(population, h) => {
            let exact = Exact::new(&case.bodies);
            let shape = Shape::sphere(population.radius);
            let pressure = |h: f64| Some(exact.integral(&Integral::of(population, h)?, &shape)?.total_load());
            of_load(&Statistical::new(contact, population.clone()), *h, 0.0, &pressure)
        }
        CaseInput::LoadOfSum(set, h) => {
            let exact = Exact::new(&case.bodies);
            let asperities = set.asperities(*h);
            let pressure = |h: f64| {
                let separation = Wide::new(h) * set.sigma + set.mean;
                Some(exact.total(&asperities, separation, false).total_load())
            };
            with_sum(contact, set, &asperities, |model, origin| {
                of_load(model, *h, (set.mean - origin).abs() / set.sigma, &pressure)
            })
        }
    }
}

/// Within the rounding of a boundary whichever side is nearer.
fn of_contact(found: &asperity::Contact, exact: &[Contact]) -> Result<Vec<Deviation>, Failure> {
    let values =
        [(Quantity::Area, found.area), (Quantity::Load, found.load), (Quantity::Stiffness, found.stiffness)];
    finite(&values)?;
    let sides = exact.iter().filter(|side| side.regime == found.regime).map(|side| {
        let of = [side.area, side.load, side.stiffness];
        values
            .iter()
            .zip(of)
            .map(|((quantity, value), of)| plain(*quantity, relative_error(*value, of)))
            .collect()
    });
    let worst = |side: &Vec<Deviation>| side.iter().map(|d| d.checked).fold(0.0, f64::max);
    sides.min_by(|a, b| worst(a).total_cmp(&worst(b))).ok_or(Failure::WrongRegime)
}

fn plain(quantity: Quantity, error: f64) -> Deviation {
    Deviation { quantity, error, checked: error }
}

fn finite(values: &[(Quantity, f64)]) -> Result<(), Failure> {
    match values.iter().find(|(_, value)| !value.is_finite()) {
        Some((quantity, _)) => Err(Failure::NotFinite(*quantity)),
        None => Ok(()),
    }
}

/// m^2, N, N/m: values far below it count as zero.
const NOTHING: f64 = 1e-130;

/// Lengths go in, areas and loads come out 2^600 and 2^1200 times as large: every law scales so.
fn of_denormal(
    bodies: &Bodies,
    contact: &dyn MicroContact,
    w: f64,
    radius: f64,
) -> Result<Vec<Deviation>, Failure> {
    const SCALE: i32 = 600;
    let grown = 2f64.powi(SCALE);
    let found = contact.contact(w, law::Shape::sphere(radius));
    let values = [
        (Quantity::Area, found.area, 2),
        (Quantity::Load, found.load, 2),
        (Quantity::Stiffness, found.stiffness, 1),
    ];
    finite(&values.map(|(quantity, value, _)| (quantity, value)))?;
    let exact = Exact::new(bodies).contacts(w * grown, &Shape::sphere(radius * grown));
    let side = exact.iter().find(|side| side.regime == found.regime).ok_or(Failure::WrongRegime)?;
    let back = |value: Wide, times: i32| (0..times).fold(value.hi(), |value, _| value / grown);
    let of = [side.area, side.load, side.stiffness];
    Ok(values
        .iter()
        .zip(of)
        .map(|((quantity, value, times), of)| {
            let of = back(of, *times);
            plain(*quantity, (value - of).abs() / (of + NOTHING))
        })
        .collect())
}

/// The quantities of a response but for its sampling errors.
fn values(response: &Response) -> [(Quantity, f64); 4] {
    [
        (Quantity::Area, response.area_ratio.total()),
        (Quantity::Load, response.pressure.total()),
        (Quantity::Stiffness, response.stiffness),
        (Quantity::Density, response.contact_density),
    ]
}

/// What reports make of a response in which something touches.
fn derived(response: &Response, sigma: f64) -> Vec<(Quantity, f64)> {
    let shares = [response.area_ratio, response.pressure].into_iter().filter_map(|of| of.shares()).flatten();
    let mut found: Vec<(Quantity, f64)> = shares.map(|share| (Quantity::Shares, share)).collect();
    found.extend(response.mean_real_pressure().map(|pressure| (Quantity::Load, pressure)));
    let error = response.separation_error(sigma).filter(|_| response.contact_density > 0.0);
    found.extend(error.map(|error| (Quantity::Sampling, error)));
    found
}

fn exact_values(total: &Total) -> [Wide; 4] {
    [total.total_area(), total.total_load(), total.stiffness, total.contacts]
}

/// The parts that each regime has of area and load.
fn shares(area: [Wide; 3], load: [Wide; 3]) -> [Wide; 6] {
    let part = |of: [Wide; 3], k: usize| {
        let whole = of[0] + of[1] + of[2];
        if whole > Wide::ZERO { of[k] / whole } else { Wide::ZERO }
    };
    std::array::from_fn(|k| if k < 3 { part(area, k) } else { part(load, k - 3) })
}

fn found_shares(response: &Response) -> [f64; 6] {
    let [area, load] = [response.area_ratio, response.pressure].map(|of| of.shares().unwrap_or_default());
    std::array::from_fn(|k| if k < 3 { area[k] } else { load[k - 3] })
}

/// The largest absolute error of several numbers, and the same with all between the exact ones right.
fn absolute<const N: usize>(quantity: Quantity, found: [f64; N], exact: &[[Wide; N]]) -> Deviation {
    let (mut error, mut checked) = (0.0f64, 0.0f64);
    for (k, found) in found.into_iter().enumerate() {
        let off = || exact.iter().map(|of| (of[k] - found).abs().hi());
        let found = Wide::new(found);
        let is_between = exact.iter().any(|of| of[k] <= found) && exact.iter().any(|of| of[k] >= found);
        error = error.max(off().next().unwrap_or(0.0));
        checked = checked.max(if is_between { 0.0 } else { off().fold(f64::INFINITY, f64::min) });
    }
    Deviation { quantity, error, checked }
}

fn of_integral(
    case: &Case,
    contact: &dyn MicroContact,
    population: &Population,
    h: f64,
) -> Result<Vec<Deviation>, Failure> {
    let response = Statistical::new(contact, population.clone()).respond(h);
    let values = values(&response);
    finite(&values)?;
    finite(&derived(&response, population.sigma))?;
    let exact = Exact::new(&case.bodies);
    let shape = Shape::sphere(population.radius);
    let at = |separation: f64| exact.integral(&Integral::of(population, separation)?, &shape);
    let total = at(h).ok_or(Failure::Unsettled)?;
    let of = exact_values(&total);
    if case.group == Group::Vanishing {
        // Absolute, over the result at the last separation that is checked relatively.
        let whole = exact_values(&at(37.0).ok_or(Failure::Unsettled)?);
        let error = |value: f64, of: Wide, whole: Wide| ((of - value) / whole).abs().hi();
        let each = values.iter().zip(of.iter().zip(whole));
        return Ok(each
            .map(|((quantity, value), (of, whole))| plain(*quantity, error(*value, *of, whole)))
            .collect());
    }
    let each = values.iter().zip(of);
    let mut found: Vec<Deviation> =
        each.map(|((quantity, value), of)| plain(*quantity, relative_error(*value, of))).collect();
    found.push(absolute(Quantity::Shares, found_shares(&response), &[shares(total.area, total.load)]));
    Ok(found)
}

/// Does something with the model of a sum on the nominal area 1 m^2 and the origin of its heights.
fn with_sum<T>(
    contact: &dyn MicroContact,
    set: &SetParameters,
    asperities: &[(f64, f64)],
    act: impl FnOnce(&dyn Model, f64) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let (heights, radii) = asperities.iter().copied().unzip();
    let given = AsperitySet::new(heights, radii, 1.0).map_err(|error| Failure::Refused(error.to_string()))?;
    let (given, origin) = given.near_zero();
    let plane = ReferencePlane { mean: set.mean - origin, sigma: set.sigma };
    act(&Deterministic::new(contact, given.spheres(), plane), origin)
}

/// Half an ulp of a separation and of each of the terms that it is made of, over what they add up to.
const ROUNDING: f64 = f64::EPSILON;

fn of_sum(
    bodies: &Bodies,
    contact: &dyn MicroContact,
    set: &SetParameters,
    h: f64,
) -> Result<Vec<Deviation>, Failure> {
    let asperities = set.asperities(h);
    let (response, origin) =
        with_sum(contact, set, &asperities, |model, origin| Ok((model.respond(h), origin)))?;
    let values = values(&response);
    finite(&values)?;
    finite(&derived(&response, set.sigma))?;
    let sampling = response.sampling.map_or([0.0; 2], |sampling| [sampling.area_ratio, sampling.pressure]);
    finite(&sampling.map(|value| (Quantity::Sampling, value)))?;
    let exact = Exact::new(bodies);
    let separation = Wide::new(h) * set.sigma + set.mean;
    let rounding = ROUNDING * ((set.mean - origin).abs() + (h * set.sigma).abs());
    let totals = [0.0, -rounding, rounding].map(|step| exact.total(&asperities, separation + step, true));
    let of = totals.map(|total| exact_values(&total));
    let mut found: Vec<Deviation> = values
        .iter()
        .enumerate()
        .map(|(k, (quantity, value))| Deviation {
            quantity: *quantity,
            error: relative_error(*value, of[0][k]),
            checked: outside(*value, of.map(|of| of[k])),
        })
        .collect();
    let exact_shares = totals.map(|total| shares(total.area, total.load));
    found.push(absolute(Quantity::Shares, found_shares(&response), &exact_shares));
    // Variances over the mean square.
    let squares = totals[0].squares.map(|squares| if squares > Wide::ZERO { squares } else { Wide::ONE });
    let variances = totals.map(|total| {
        let totals = [total.total_area(), total.total_load()];
        [0, 1].map(|k| (total.squares[k] - totals[k] * totals[k] / set.count as f64) / squares[k])
    });
    let sampled = [0, 1].map(|k| (Wide::new(sampling[k]) * sampling[k] / squares[k]).hi());
    found.push(absolute(Quantity::Sampling, sampled, &variances));
    Ok(found)
}

/// Distance of `value` from the interval of the `exact` ones, relative to the nearest.
fn outside(value: f64, exact: [Wide; 3]) -> f64 {
    let wide = Wide::new(value);
    let is_between = exact.iter().any(|of| *of <= wide) && exact.iter().any(|of| *of >= wide);
    let nearest = exact.iter().map(|of| relative_error(value, *of)).fold(f64::INFINITY, f64::min);
    if is_between { 0.0 } else { nearest }
}

/// A large sum against the exact sum of the very terms that it is of.
fn of_terms(contact: &dyn MicroContact, set: &SetParameters, h: f64) -> Result<Vec<Deviation>, Failure> {
    const CHUNK: usize = 1 << 14;
    let asperities = set.asperities(h);
    let (response, origin) =
        with_sum(contact, set, &asperities, |model, origin| Ok((model.respond(h), origin)))?;
    let found = [(Quantity::Area, response.area_ratio.total()), (Quantity::Load, response.pressure.total())];
    finite(&found)?;
    let separation = (set.mean - origin) + h * set.sigma;
    let parts: Vec<[Wide; 2]> = asperities
        .par_chunks(CHUNK)
        .map(|chunk| {
            let relative = chunk.iter().map(|&(height, radius)| (height - origin, radius));
            let pressed = relative.filter(|(height, _)| *height > separation);
            let contacts = pressed
                .map(|(height, radius)| contact.contact(height - separation, law::Shape::sphere(radius)));
            contacts.fold([Wide::ZERO; 2], |[area, load], c| [area + c.area, load + c.load])
        })
        .collect();
    let exact = parts.iter().fold([Wide::ZERO; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    let each = found.iter().zip(exact);
    Ok(each.map(|((quantity, value), of)| plain(*quantity, relative_error(*value, of))).collect())
}

/// The pressure at `h` is asked for again: the exact pressure at the separation that is found must be it, or lie on
/// both sides of it within the rounding of that separation.
fn of_load(
    model: &dyn Model,
    h: f64,
    offset: f64,
    pressure: &dyn Fn(f64) -> Option<Wide>,
) -> Result<Vec<Deviation>, Failure> {
    /// Ulp of a separation that the search may be off.
    const ULP: f64 = 4.0;
    let wanted = model.respond(h).pressure.total();
    finite(&[(Quantity::Reached, wanted)])?;
    if wanted == 0.0 {
        return Ok(Vec::new());
    }
    let reached = at_pressure(model, wanted).map_err(|error| Failure::Refused(error.to_string()))?;
    let found = reached.response.separation_over_sigma;
    finite(&[(Quantity::Reached, found), (Quantity::Reached, reached.response.pressure.total())])?;
    let step = ULP * f64::EPSILON * (found.abs() + offset).max(1.0);
    let mut exact = [Wide::ZERO; 3];
    for (exact, step) in exact.iter_mut().zip([0.0, -step, step]) {
        *exact = pressure(found + step).ok_or(Failure::Unsettled)?;
    }
    let error = relative_error(wanted, exact[0]);
    // A law that jumps over the pressure carries more than was asked.
    let checked = if reached.in_jump { outside(wanted, exact) } else { error };
    Ok(vec![Deviation { quantity: Quantity::Reached, error, checked }])
}
