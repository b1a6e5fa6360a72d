//! Error of a result.

use rayon::prelude::*;

use super::cases::{Case, CaseInput, SetParameters};
use super::groups::{CheckedQuantity, Group};
use crate::exact::{Contact, Exact, Integral, Shape, Total};
use crate::wide::{Wide, relative_error};
use CheckedQuantity::{Area, Density, Load, Reached, Sampling, Shares, Stiffness};
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
    /// From `exact` results, the first for the unrounded input and any others for the ends of its rounding: all between them is right.
    fn new(
        quantity: CheckedQuantity,
        value: f64,
        exact: &[Wide],
        measure: impl Fn(f64, Wide) -> f64,
    ) -> Result<Self, Failure> {
        finite(quantity, [value])?;
        let wide = Wide::new(value);
        let is_between = exact.iter().any(|exact| *exact <= wide) && exact.iter().any(|exact| *exact >= wide);
        let nearest = exact.iter().map(|exact| measure(value, *exact)).fold(f64::INFINITY, f64::min);
        let checked = if is_between { 0.0 } else { nearest };
        Ok(Self { quantity, error: measure(value, exact[0]), checked })
    }

    /// The largest absolute error of several numbers; `exact` as of [`Self::new`].
    fn largest<const N: usize>(
        quantity: CheckedQuantity,
        values: [f64; N],
        exact: &[[Wide; N]],
    ) -> Result<Self, Failure> {
        let mut largest = Self { quantity, error: 0.0, checked: 0.0 };
        for (k, value) in values.into_iter().enumerate() {
            let exact: Vec<Wide> = exact.iter().map(|exact| exact[k]).collect();
            let one = Self::new(quantity, value, &exact, |value, exact| (exact - value).abs().hi())?;
            largest.error = largest.error.max(one.error);
            largest.checked = largest.checked.max(one.checked);
        }
        Ok(largest)
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

pub type Checked = Result<Vec<Deviation>, Failure>;

pub(super) fn check(case: &Case) -> Checked {
    let contact = case.bodies.contact().map_err(|error| Failure::Refused(error.to_string()))?;
    let (exact, contact) = (Exact::new(&case.bodies), &*contact);
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
        CaseInput::Integral(population, h) => {
            let response = Statistical::new(contact, population.clone()).respond(*h);
            let total = exact_integral(&exact, population, *h)?;
            if case.group == Group::Vanishing {
                // Errors over the result at the last separation that is checked relatively.
                let last = quantities_of(&exact_integral(&exact, population, 37.0)?);
                return response_deviations(&response, population.sigma, &[total], |k, value, exact| {
                    ((exact - value) / last[k]).abs().hi()
                });
            }
            let mut deviations = relative_deviations(&response, population.sigma, &[total])?;
            deviations.push(Deviation::largest(Shares, shares(&response), &[exact_shares(&total)])?);
            Ok(deviations)
        }
        CaseInput::LoadOfIntegral(population, h) => {
            let pressure = |h: f64| Some(exact_integral(&exact, population, h).ok()?.total_load());
            load_control(&Statistical::new(contact, population.clone()), *h, 0.0, &pressure)
        }
        CaseInput::LoadOfSum(set, h) => {
            let drawn = DrawnSet::new(set, *h)?;
            let pressure = |h: f64| {
                let separation = Wide::new(h) * set.sigma + set.mean;
                Some(exact.total(&drawn.asperities, separation, false).total_load())
            };
            let offset = drawn.plane.mean.abs() / set.sigma;
            load_control(&drawn.model(contact), *h, offset, &pressure)
        }
    }
}

fn finite(quantity: CheckedQuantity, values: impl IntoIterator<Item = f64>) -> Result<(), Failure> {
    values.into_iter().all(f64::is_finite).then_some(()).ok_or(Failure::NotFinite(quantity))
}

/// Within the rounding of a boundary whichever side is nearer.
fn nearest_side(contact: &asperity::Contact, exact: &[Contact]) -> Checked {
    let of_side = |side: &Contact| -> Checked {
        let asperity::Contact { area, load, stiffness, .. } = *contact;
        let values =
            [(Area, area, side.area), (Load, load, side.load), (Stiffness, stiffness, side.stiffness)];
        let deviation = |(quantity, value, exact)| Deviation::new(quantity, value, &[exact], relative_error);
        values.into_iter().map(deviation).collect()
    };
    let sides = exact.iter().filter(|side| side.regime == contact.regime).map(of_side);
    let sides = sides.collect::<Result<Vec<_>, _>>()?.into_iter();
    let worst = |side: &Vec<Deviation>| side.iter().map(|d| d.checked).fold(0.0, f64::max);
    sides.min_by(|a, b| worst(a).total_cmp(&worst(b))).ok_or(Failure::WrongRegime)
}

/// Lengths go in, areas and loads come out 2^600 and 2^1200 times as large: every law scales so.
fn denormal_contact(exact: &Exact, contact: &dyn MicroContact, w: f64, radius: f64) -> Checked {
    const SCALE: i32 = 600;
    /// m^2, N, N/m: values far below it count as zero.
    const NOTHING: f64 = 1e-130;
    let grown = 2f64.powi(SCALE);
    let contact = contact.contact(w, law::Shape::sphere(radius));
    let sides = exact.contacts(w * grown, &Shape::sphere(radius * grown));
    let side = sides.iter().find(|side| side.regime == contact.regime).ok_or(Failure::WrongRegime)?;
    let values = [
        (Area, contact.area, side.area.hi() / grown / grown),
        (Load, contact.load, side.load.hi() / grown / grown),
        (Stiffness, contact.stiffness, side.stiffness.hi() / grown),
    ];
    let deviation = |(quantity, value, exact): (CheckedQuantity, f64, f64)| {
        let measure = |value: f64, _| (value - exact).abs() / (exact + NOTHING);
        Deviation::new(quantity, value, &[Wide::new(exact)], measure)
    };
    values.into_iter().map(deviation).collect()
}

/// Area, load, stiffness and density against those of exact totals, as of [`Deviation::new`]: `measure` gives the error of the value of
/// a place among them. All that reports make of a response must be finite.
fn response_deviations(
    response: &Response,
    sigma: f64,
    totals: &[Total],
    measure: impl Fn(usize, f64, Wide) -> f64,
) -> Checked {
    finite(Shares, shares(response))?;
    finite(Load, response.mean_real_pressure())?;
    finite(Sampling, response.separation_error(sigma).filter(|_| response.contact_density > 0.0))?;
    finite(Sampling, sampling_errors(response))?;
    let values = [
        (Area, response.area_ratio.total()),
        (Load, response.pressure.total()),
        (Stiffness, response.stiffness),
        (Density, response.contact_density),
    ];
    let exact: Vec<[Wide; 4]> = totals.iter().map(quantities_of).collect();
    let deviation = |(k, (quantity, value))| {
        let exact: Vec<Wide> = exact.iter().map(|exact| exact[k]).collect();
        Deviation::new(quantity, value, &exact, |value, exact| measure(k, value, exact))
    };
    values.into_iter().enumerate().map(deviation).collect()
}

fn relative_deviations(response: &Response, sigma: f64, totals: &[Total]) -> Checked {
    response_deviations(response, sigma, totals, |_, value, exact| relative_error(value, exact))
}

fn quantities_of(total: &Total) -> [Wide; 4] {
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

/// A set on the nominal area 1 m^2, its heights relative to an origin near them.
struct DrawnSet {
    asperities: Vec<(f64, f64)>,
    near_zero: AsperitySet,
    origin: f64,
    plane: ReferencePlane,
}

impl DrawnSet {
    fn new(set: &SetParameters, h: f64) -> Result<Self, Failure> {
        let asperities = set.asperities(h);
        let (heights, radii) = asperities.iter().copied().unzip();
        let all = AsperitySet::new(heights, radii, 1.0);
        let (near_zero, origin) = all.map_err(|error| Failure::Refused(error.to_string()))?.near_zero();
        let plane = ReferencePlane { mean: set.mean - origin, sigma: set.sigma };
        Ok(Self { asperities, near_zero, origin, plane })
    }

    fn model<'a>(&'a self, contact: &'a dyn MicroContact) -> Deterministic<'a> {
        Deterministic::new(contact, self.near_zero.spheres(), self.plane)
    }
}

fn sum(exact: &Exact, contact: &dyn MicroContact, set: &SetParameters, h: f64) -> Checked {
    /// Half an ulp of a separation and of each of the terms that it is made of, over what they add up to.
    const ROUNDING: f64 = f64::EPSILON;
    let drawn = DrawnSet::new(set, h)?;
    let response = drawn.model(contact).respond(h);
    let separation = Wide::new(h) * set.sigma + set.mean;
    let rounding = ROUNDING * (drawn.plane.mean.abs() + (h * set.sigma).abs());
    let totals =
        [0.0, -rounding, rounding].map(|step| exact.total(&drawn.asperities, separation + step, true));
    let mut deviations = relative_deviations(&response, set.sigma, &totals)?;
    let exact_shares = totals.map(|total| exact_shares(&total));
    deviations.push(Deviation::largest(Shares, shares(&response), &exact_shares)?);
    // Variances over the mean square.
    let squares = totals[0].squares.map(|squares| if squares > Wide::ZERO { squares } else { Wide::ONE });
    let variances = totals.map(|total| {
        let sums = [total.total_area(), total.total_load()];
        [0, 1].map(|k| (total.squares[k] - sums[k] * sums[k] / set.count as f64) / squares[k])
    });
    let errors = sampling_errors(&response);
    let sampled = [0, 1].map(|k| (Wide::new(errors[k]) * errors[k] / squares[k]).hi());
    deviations.push(Deviation::largest(Sampling, sampled, &variances)?);
    Ok(deviations)
}

/// A large sum against the exact sum of its terms.
fn large_sum(contact: &dyn MicroContact, set: &SetParameters, h: f64) -> Checked {
    const CHUNK: usize = 1 << 14;
    let drawn = DrawnSet::new(set, h)?;
    let response = drawn.model(contact).respond(h);
    let separation = drawn.plane.mean + h * set.sigma;
    let of_chunk = |chunk: &[(f64, f64)]| {
        let relative = chunk.iter().map(|&(height, radius)| (height - drawn.origin - separation, radius));
        let pressed = relative.filter(|(w, _)| *w > 0.0);
        let contacts = pressed.map(|(w, radius)| contact.contact(w, law::Shape::sphere(radius)));
        contacts.fold([Wide::ZERO; 2], |[area, load], c| [area + c.area, load + c.load])
    };
    let parts: Vec<[Wide; 2]> = drawn.asperities.par_chunks(CHUNK).map(of_chunk).collect();
    let [area, load] = parts.iter().fold([Wide::ZERO; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    Ok(vec![
        Deviation::new(Area, response.area_ratio.total(), &[area], relative_error)?,
        Deviation::new(Load, response.pressure.total(), &[load], relative_error)?,
    ])
}

/// The pressure at `h` is asked for again: the exact pressure at the separation that is found must be it, or lie on
/// both sides of it within the rounding of that separation.
fn load_control(model: &dyn Model, h: f64, offset: f64, pressure: &dyn Fn(f64) -> Option<Wide>) -> Checked {
    /// Ulp of a separation that the search may be off.
    const ULP: f64 = 4.0;
    let wanted = model.respond(h).pressure.total();
    finite(Reached, [wanted])?;
    if wanted == 0.0 {
        return Ok(Vec::new());
    }
    let reached = at_pressure(model, wanted).map_err(|error| Failure::Refused(error.to_string()))?;
    let separation = reached.response.separation_over_sigma;
    finite(Reached, [separation, reached.response.pressure.total()])?;
    let step = ULP * f64::EPSILON * (separation.abs() + offset).max(1.0);
    // A law that jumps over the pressure carries more than was asked.
    let steps: &[f64] = if reached.in_jump { &[0.0, -step, step] } else { &[0.0] };
    let exact: Option<Vec<Wide>> = steps.iter().map(|step| pressure(separation + step)).collect();
    let exact = exact.ok_or(Failure::Unsettled)?;
    Ok(vec![Deviation::new(Reached, wanted, &exact, relative_error)?])
}
