//! Error of a result.

use rayon::prelude::*;

use super::cases::{Case, CaseInput, SetParameters};
use super::groups::{CheckedQuantity, Group};
use crate::exact::{Contact, Exact, Integral, Shape, Total};
use crate::wide::{Wide, relative_error};
use asperity::{
    AsperitySet, Deterministic, MicroContact, Model, Population, ReferencePlane, Response, Statistical,
    at_pressure, law,
};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    pub quantity: CheckedQuantity,
    /// Relative error against the exact result for the unrounded input.
    pub error: f64,
    /// Relative error against the exact results for all separations within rounding of the input; the same as
    /// `error` where the input is not rounded.
    pub checked: f64,
}

impl Deviation {
    /// Of an input that is not rounded.
    fn unrounded(quantity: CheckedQuantity, error: f64) -> Self {
        Self { quantity, error, checked: error }
    }

    /// From `exact` results, the first for the unrounded input and any others for the ends of its rounding: all between them is right.
    fn new(quantity: CheckedQuantity, value: f64, exact: &[Wide], measure: fn(f64, Wide) -> f64) -> Self {
        let wide = Wide::new(value);
        let is_between = exact.iter().any(|exact| *exact <= wide) && exact.iter().any(|exact| *exact >= wide);
        let nearest = exact.iter().map(|exact| measure(value, *exact)).fold(f64::INFINITY, f64::min);
        let checked = if is_between { 0.0 } else { nearest };
        Self { quantity, error: measure(value, exact[0]), checked }
    }

    /// The largest absolute error of several numbers; `exact` as of [`Self::new`].
    fn largest<const N: usize>(quantity: CheckedQuantity, values: [f64; N], exact: &[[Wide; N]]) -> Self {
        let absolute_error = |value: f64, exact: Wide| (exact - value).abs().hi();
        let of_number = |(k, value): (usize, f64)| {
            let exact: Vec<Wide> = exact.iter().map(|exact| exact[k]).collect();
            Self::new(quantity, value, &exact, absolute_error)
        };
        let all = values.into_iter().enumerate().map(of_number);
        all.fold(Self::unrounded(quantity, 0.0), |largest, one| Self {
            quantity,
            error: largest.error.max(one.error),
            checked: largest.checked.max(one.checked),
        })
    }
}

/// What keeps a case from being checked as right.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    #[error("no finite {}", .0.name())]
    NotFinite(CheckedQuantity),
    /// Another regime than the exact one, away from a boundary.
    #[error("the wrong regime")]
    WrongRegime,
    #[error("refused: {0}")]
    Refused(String),
    /// The wide rule did not settle: the case is not checked.
    #[error("not checked, for the wide rule does not settle")]
    Unsettled,
}

#[derive(Debug, Clone)]
pub struct CheckedCase {
    pub case: Case,
    pub outcome: Result<Vec<Deviation>, Failure>,
}

pub(super) fn check(case: Case) -> CheckedCase {
    let contact = case.bodies.contact().map_err(|error| Failure::Refused(error.to_string()));
    let outcome = contact.and_then(|contact| deviations(&case, &*contact));
    CheckedCase { case, outcome }
}

fn deviations(case: &Case, contact: &dyn MicroContact) -> Result<Vec<Deviation>, Failure> {
    let exact = Exact::new(&case.bodies);
    match &case.input {
        CaseInput::Contact { w, radius } if case.group == Group::Denormals => {
            denormal_contact(&exact, contact, *w, *radius)
        }
        CaseInput::Contact { w, radius } => nearest_side(
            &contact.contact(*w, law::Shape::sphere(*radius)),
            &exact.contacts(*w, &Shape::sphere(*radius)),
        ),
        CaseInput::Ellipse { w, mean_curvature, ratio } => nearest_side(
            &contact.contact(*w, law::Shape::ellipse(*mean_curvature, *ratio)),
            &exact.contacts(*w, &Shape::ellipse(*mean_curvature, *ratio)),
        ),
        CaseInput::Sum(set, h) if case.group.is_large() => large_sum(contact, set, *h),
        CaseInput::Sum(set, h) => sum(&exact, contact, set, *h),
        CaseInput::Integral(population, h) if case.group == Group::Vanishing => {
            vanishing_integral(&exact, contact, population, *h)
        }
        CaseInput::Integral(population, h) => integral(&exact, contact, population, *h),
        CaseInput::LoadOfIntegral(population, h) => {
            let pressure = |h: f64| Some(exact_integral(&exact, population, h).ok()?.total_load());
            load_control(&Statistical::new(contact, population.clone()), *h, 0.0, &pressure)
        }
        CaseInput::LoadOfSum(set, h) => {
            let asperities = set.asperities(*h);
            let pressure = |h: f64| {
                let separation = Wide::new(h) * set.sigma + set.mean;
                Some(exact.total(&asperities, separation, false).total_load())
            };
            let (near_zero, origin) = near_zero(&asperities)?;
            let model = Deterministic::new(contact, near_zero.spheres(), reference_plane(set, origin));
            load_control(&model, *h, (set.mean - origin).abs() / set.sigma, &pressure)
        }
    }
}

fn finite(values: &[(CheckedQuantity, f64)]) -> Result<(), Failure> {
    match values.iter().find(|(_, value)| !value.is_finite()) {
        Some((quantity, _)) => Err(Failure::NotFinite(*quantity)),
        None => Ok(()),
    }
}

fn relative(values: &[(CheckedQuantity, f64)], exact: &[Wide]) -> Vec<Deviation> {
    let pairs = values.iter().zip(exact);
    pairs
        .map(|((quantity, value), of)| Deviation::unrounded(*quantity, relative_error(*value, *of)))
        .collect()
}

fn contact_values(contact: &asperity::Contact) -> Result<[(CheckedQuantity, f64); 3], Failure> {
    let asperity::Contact { area, load, stiffness, .. } = *contact;
    let values = [
        (CheckedQuantity::Area, area),
        (CheckedQuantity::Load, load),
        (CheckedQuantity::Stiffness, stiffness),
    ];
    finite(&values).map(|()| values)
}

/// Within the rounding of a boundary whichever side is nearer.
fn nearest_side(contact: &asperity::Contact, exact: &[Contact]) -> Result<Vec<Deviation>, Failure> {
    let values = contact_values(contact)?;
    let sides = exact.iter().filter(|side| side.regime == contact.regime);
    let sides = sides.map(|side| relative(&values, &[side.area, side.load, side.stiffness]));
    let worst = |side: &Vec<Deviation>| side.iter().map(|d| d.checked).fold(0.0, f64::max);
    sides.min_by(|a, b| worst(a).total_cmp(&worst(b))).ok_or(Failure::WrongRegime)
}

/// Lengths go in, areas and loads come out 2^600 and 2^1200 times as large: every law scales so.
fn denormal_contact(
    exact: &Exact,
    contact: &dyn MicroContact,
    w: f64,
    radius: f64,
) -> Result<Vec<Deviation>, Failure> {
    const SCALE: i32 = 600;
    /// m^2, N, N/m: values far below it count as zero.
    const NOTHING: f64 = 1e-130;
    let grown = 2f64.powi(SCALE);
    let contact = contact.contact(w, law::Shape::sphere(radius));
    let values = contact_values(&contact)?;
    let sides = exact.contacts(w * grown, &Shape::sphere(radius * grown));
    let side = sides.iter().find(|side| side.regime == contact.regime).ok_or(Failure::WrongRegime)?;
    let scaled = [(side.area, 2), (side.load, 2), (side.stiffness, 1)];
    let of_value = |((quantity, value), (exact, times)): ((CheckedQuantity, f64), (Wide, usize))| {
        let exact = (0..times).fold(exact.hi(), |value, _| value / grown);
        Deviation::unrounded(quantity, (value - exact).abs() / (exact + NOTHING))
    };
    Ok(values.into_iter().zip(scaled).map(of_value).collect())
}

/// The quantities of a response but for regime shares and sampling errors; all that reports make of it must be finite.
fn response_values(response: &Response, sigma: f64) -> Result<[(CheckedQuantity, f64); 4], Failure> {
    let values = [
        (CheckedQuantity::Area, response.area_ratio.total()),
        (CheckedQuantity::Load, response.pressure.total()),
        (CheckedQuantity::Stiffness, response.stiffness),
        (CheckedQuantity::Density, response.contact_density),
    ];
    finite(&values)?;
    finite(&shares(response).map(|share| (CheckedQuantity::Shares, share)))?;
    let real_pressure = response.mean_real_pressure().map(|pressure| (CheckedQuantity::Load, pressure));
    let error = response.separation_error(sigma).filter(|_| response.contact_density > 0.0);
    let errors =
        error.into_iter().chain(sampling_errors(response)).map(|error| (CheckedQuantity::Sampling, error));
    finite(&real_pressure.into_iter().chain(errors).collect::<Vec<_>>())?;
    Ok(values)
}

fn exact_values(total: &Total) -> [Wide; 4] {
    [total.total_area(), total.total_load(), total.stiffness, total.contacts]
}

/// The parts that each regime has of the area and of the load.
fn shares(response: &Response) -> [f64; 6] {
    let parts = [response.area_ratio, response.pressure].map(|of| of.shares().unwrap_or_default());
    std::array::from_fn(|k| parts[k / 3][k % 3])
}

fn exact_shares(total: &Total) -> [Wide; 6] {
    let parts = [(total.area, total.total_area()), (total.load, total.total_load())];
    std::array::from_fn(|k| {
        let (part, whole) = parts[k / 3];
        if whole > Wide::ZERO { part[k % 3] / whole } else { Wide::ZERO }
    })
}

fn sampling_errors(response: &Response) -> [f64; 2] {
    response.sampling.map_or([0.0; 2], |sampling| [sampling.area_ratio, sampling.pressure])
}

fn exact_integral(exact: &Exact, population: &Population, separation: f64) -> Result<Total, Failure> {
    let integral = Integral::new(population, separation);
    let total = integral.and_then(|integral| exact.integral(&integral, &Shape::sphere(population.radius)));
    total.ok_or(Failure::Unsettled)
}

fn integral(
    exact: &Exact,
    contact: &dyn MicroContact,
    population: &Population,
    h: f64,
) -> Result<Vec<Deviation>, Failure> {
    let response = Statistical::new(contact, population.clone()).respond(h);
    let values = response_values(&response, population.sigma)?;
    let total = exact_integral(exact, population, h)?;
    let mut deviations = relative(&values, &exact_values(&total));
    deviations.push(Deviation::largest(CheckedQuantity::Shares, shares(&response), &[exact_shares(&total)]));
    Ok(deviations)
}

/// Errors over the result at the last separation that is checked relatively.
fn vanishing_integral(
    exact: &Exact,
    contact: &dyn MicroContact,
    population: &Population,
    h: f64,
) -> Result<Vec<Deviation>, Failure> {
    let response = Statistical::new(contact, population.clone()).respond(h);
    let values = response_values(&response, population.sigma)?;
    let [totals, last] = [h, 37.0].map(|h| exact_integral(exact, population, h));
    let pairs = exact_values(&totals?).into_iter().zip(exact_values(&last?));
    let of_value = |((quantity, value), (exact, last)): ((CheckedQuantity, f64), (Wide, Wide))| {
        Deviation::unrounded(quantity, ((exact - value) / last).abs().hi())
    };
    Ok(values.into_iter().zip(pairs).map(of_value).collect())
}

/// The set on the nominal area 1 m^2 and the origin of its heights.
fn near_zero(asperities: &[(f64, f64)]) -> Result<(AsperitySet, f64), Failure> {
    let (heights, radii) = asperities.iter().copied().unzip();
    let set = AsperitySet::new(heights, radii, 1.0).map_err(|error| Failure::Refused(error.to_string()))?;
    Ok(set.near_zero())
}

fn reference_plane(set: &SetParameters, origin: f64) -> ReferencePlane {
    ReferencePlane { mean: set.mean - origin, sigma: set.sigma }
}

fn sum(
    exact: &Exact,
    contact: &dyn MicroContact,
    set: &SetParameters,
    h: f64,
) -> Result<Vec<Deviation>, Failure> {
    /// Half an ulp of a separation and of each of the terms that it is made of, over what they add up to.
    const ROUNDING: f64 = f64::EPSILON;
    let asperities = set.asperities(h);
    let (near_zero, origin) = near_zero(&asperities)?;
    let plane = reference_plane(set, origin);
    let response = Deterministic::new(contact, near_zero.spheres(), plane).respond(h);
    let values = response_values(&response, set.sigma)?;
    let separation = Wide::new(h) * set.sigma + set.mean;
    let rounding = ROUNDING * (plane.mean.abs() + (h * set.sigma).abs());
    let totals = [0.0, -rounding, rounding].map(|step| exact.total(&asperities, separation + step, true));
    let exact = totals.map(|total| exact_values(&total));
    let of_value = |(k, &(quantity, value)): (usize, &(CheckedQuantity, f64))| {
        Deviation::new(quantity, value, &exact.map(|exact| exact[k]), relative_error)
    };
    let mut deviations: Vec<Deviation> = values.iter().enumerate().map(of_value).collect();
    let exact_shares = totals.map(|total| exact_shares(&total));
    deviations.push(Deviation::largest(CheckedQuantity::Shares, shares(&response), &exact_shares));
    // Variances over the mean square.
    let squares = totals[0].squares.map(|squares| if squares > Wide::ZERO { squares } else { Wide::ONE });
    let variances = totals.map(|total| {
        let sums = [total.total_area(), total.total_load()];
        [0, 1].map(|k| (total.squares[k] - sums[k] * sums[k] / set.count as f64) / squares[k])
    });
    let errors = sampling_errors(&response);
    let sampled = [0, 1].map(|k| (Wide::new(errors[k]) * errors[k] / squares[k]).hi());
    deviations.push(Deviation::largest(CheckedQuantity::Sampling, sampled, &variances));
    Ok(deviations)
}

/// A large sum against the exact sum of its terms.
fn large_sum(contact: &dyn MicroContact, set: &SetParameters, h: f64) -> Result<Vec<Deviation>, Failure> {
    const CHUNK: usize = 1 << 14;
    let asperities = set.asperities(h);
    let (near_zero, origin) = near_zero(&asperities)?;
    let plane = reference_plane(set, origin);
    let response = Deterministic::new(contact, near_zero.spheres(), plane).respond(h);
    let values = [
        (CheckedQuantity::Area, response.area_ratio.total()),
        (CheckedQuantity::Load, response.pressure.total()),
    ];
    finite(&values)?;
    let separation = plane.mean + h * set.sigma;
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
    Ok(relative(&values, &exact))
}

/// The pressure at `h` is asked for again: the exact pressure at the separation that is found must be it, or lie on
/// both sides of it within the rounding of that separation.
fn load_control(
    model: &dyn Model,
    h: f64,
    offset: f64,
    pressure: &dyn Fn(f64) -> Option<Wide>,
) -> Result<Vec<Deviation>, Failure> {
    /// Ulp of a separation that the search may be off.
    const ULP: f64 = 4.0;
    let wanted = model.respond(h).pressure.total();
    finite(&[(CheckedQuantity::Reached, wanted)])?;
    if wanted == 0.0 {
        return Ok(Vec::new());
    }
    let reached = at_pressure(model, wanted).map_err(|error| Failure::Refused(error.to_string()))?;
    let separation = reached.response.separation_over_sigma;
    finite(&[
        (CheckedQuantity::Reached, separation),
        (CheckedQuantity::Reached, reached.response.pressure.total()),
    ])?;
    let step = ULP * f64::EPSILON * (separation.abs() + offset).max(1.0);
    // A law that jumps over the pressure carries more than was asked.
    let steps: &[f64] = if reached.in_jump { &[0.0, -step, step] } else { &[0.0] };
    let exact: Option<Vec<Wide>> = steps.iter().map(|step| pressure(separation + step)).collect();
    let exact = exact.ok_or(Failure::Unsettled)?;
    Ok(vec![Deviation::new(CheckedQuantity::Reached, wanted, &exact, relative_error)])
}
