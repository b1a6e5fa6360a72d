//! Both models on arrays.

use std::sync::Arc;

use asperity::compare::{Comparison, Controls, Models, NotReached, compare};
use asperity::{Deterministic, Ellipses, MicroContact, Model, ReferencePlane, SetError, Statistical};
use asperity_contact_framework::input::bare::{NominalPressureRange, SigmaRange};
use asperity_contact_framework::input::quantity::{Finite, Length, Pressure, Pure};
use asperity_experiment::model_tables::CurveRow;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::asperities::{Asperities, Population};
use crate::interface::Interface;
use crate::quantity::{list, si_or_none};
use crate::refuse;
use crate::table::Table;
use crate::watch::{guarded, interruptible};

/// At what a model is evaluated.
fn controls(separations: Option<&Bound<PyAny>>, pressures: Option<&Bound<PyAny>>) -> PyResult<Controls> {
    let separations = separations.map_or(Ok(Vec::new()), |all| list::<Pure, Finite>(all, "separations"))?;
    let of_pressures = list::<Pressure, NominalPressureRange>;
    let pressures = pressures.map_or(Ok(Vec::new()), |all| of_pressures(all, "pressures"))?;
    if separations.is_empty() && pressures.is_empty() {
        return Err(refuse("found no separation and no pressure; allowed: at least one"));
    }
    /// The lowest and highest d/sigma of a spec.
    const RANGE: std::ops::RangeInclusive<f64> = -1e6..=1e6;
    if let Some(h) = separations.iter().find(|h| !RANGE.contains(*h)) {
        return Err(refuse(format!("separations: found {h}; allowed: d/sigma from -1e6 to 1e6")));
    }
    if let Some(p) = pressures.iter().find(|p| !(**p > 0.0 && p.is_finite())) {
        return Err(refuse(format!("pressures: found {p}; allowed: positive and finite, Pa")));
    }
    Ok(Controls { separations, pressures, forces: Vec::new() })
}

fn rows(interface: &Interface, comparison: Result<Comparison, NotReached>) -> PyResult<Vec<CurveRow>> {
    let comparison = comparison.map_err(refuse)?;
    Ok(CurveRow::from_comparison(
        &interface.law.0.label(),
        &comparison,
        interface.contact.reference_modulus(),
    ))
}

/// An argument that is another kind of object.
fn wrong_type(name: &str, found: &Bound<PyAny>, allowed: &str) -> PyErr {
    let kind = found.get_type();
    PyTypeError::new_err(format!("{name}: found an object of {kind}; allowed: {allowed}"))
}

/// The statistical model: the integral of a law over the heights of a population (Greenwood and Williamson 1966; Zhao, Maietta
/// and Chang 2000).
///
/// Parameters
/// ----------
/// interface : Interface
///     Bodies, law and layer; a law for spheres.
/// population : Population
///     Radius, sigma, density and height distribution.
/// separations : float or array_like, optional
///     d/sigma. At least one of separations and pressures is needed.
/// pressures : float, str or array_like, optional
///     Nominal pressures in Pa, or with their units; the largest separation that bears each is found.
///
/// Returns
/// -------
/// Table
///     The columns of ``curves.csv``: separations first, then pressures.
///
/// Raises
/// ------
/// ValueError
///     A value out of range, or a pressure that is not reached.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
/// >>> contact = asperity.Interface(steel, steel)
/// >>> population = asperity.Population(20e-6, 48e-9, 6e10)
/// >>> curve = asperity.statistical(contact, population, pressures=[1e6, 1e7])
/// >>> curve["separation_over_sigma"].round(3)
/// array([2.358, 1.527])
#[pyfunction]
#[pyo3(signature = (interface, population, *, separations=None, pressures=None))]
pub fn statistical(
    py: Python,
    interface: &Interface,
    population: &Bound<PyAny>,
    separations: Option<&Bound<PyAny>>,
    pressures: Option<&Bound<PyAny>>,
) -> PyResult<Table> {
    let population = population.cast::<Population>().map_err(|_| {
        wrong_type("population", population, "a Population, such as topography.find_summits().population()")
    })?;
    if interface.law.0.is_elliptic() {
        return Err(refuse(
            "found a law for ellipses; allowed: a law for spheres, or run(...) with a population and its curvature-ratio",
        ));
    }
    let controls = controls(separations, pressures)?;
    let asperities = population.get().0.clone();
    let found = guarded(py, || {
        let model = Statistical::new(&*interface.contact, asperities);
        compare(Models { statistical: Some(&model), deterministic: None }, &controls, 1.0)
    })?;
    Ok(Table::of_curves(py, rows(interface, found)?))
}

/// A sum that cannot be made, or does not reach a load.
#[derive(Debug)]
enum NoSum {
    Set(SetError),
    EqualHeights,
    NoCurvatures,
    NotReached(NotReached),
}

impl std::fmt::Display for NoSum {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Set(error) => error.fmt(f),
            Self::EqualHeights => f.write_str(
                "all heights are equal, and separations are measured in their standard deviation; allowed: sigma = ..., the unit \
                 of separations in m",
            ),
            Self::NoCurvatures => f.write_str(
                "the asperities have no principal curvatures, which a law for ellipses needs; allowed: Asperities(..., curvatures=...)",
            ),
            Self::NotReached(error) => error.fmt(f),
        }
    }
}

/// What a sum needs, without the interpreter.
struct Sum {
    contact: Arc<dyn MicroContact>,
    is_elliptic: bool,
    sigma: Option<f64>,
    controls: Controls,
}

impl Sum {
    fn compared(&self, asperities: &Asperities) -> Result<Comparison, NoSum> {
        let spheres = asperities.spheres().map_err(NoSum::Set)?;
        if !self.is_elliptic && !spheres.is_far_from_zero() {
            return self.over(spheres);
        }
        let set = asperities.set().map_err(NoSum::Set)?;
        if self.is_elliptic {
            let ellipses = Ellipses::new(&set).ok_or(NoSum::NoCurvatures)?;
            self.over(ellipses.asperities())
        } else {
            self.over(set.spheres())
        }
    }

    fn over(&self, asperities: asperity::Asperities) -> Result<Comparison, NoSum> {
        let mut plane = ReferencePlane::from(asperities);
        plane.sigma = self.sigma.unwrap_or(plane.sigma);
        if plane.sigma == 0.0 {
            return Err(NoSum::EqualHeights);
        }
        let model = Deterministic::new(&*self.contact, asperities, plane);
        let models = Models { statistical: None, deterministic: Some(&model as &dyn Model) };
        compare(models, &self.controls, asperities.nominal_area()).map_err(NoSum::NotReached)
    }
}

/// The deterministic model: the sum of a law over given asperities (Pasaribu and Schipper 2005, Eqs. 1 and 13).
///
/// The interpreter runs on meanwhile, and Ctrl-C ends the wait.
///
/// Parameters
/// ----------
/// interface : Interface
///     Bodies, law and layer.
/// asperities : Asperities
///     Heights and radii; for laws for ellipses with their curvatures.
/// separations : float or array_like, optional
///     d/sigma. At least one of separations and pressures is needed.
/// pressures : float, str or array_like, optional
///     Nominal pressures in Pa, or with their units; the largest separation that bears each is found.
/// sigma : float or str, optional
///     The unit of separations in m; by default the standard deviation of the heights.
///
/// Returns
/// -------
/// Table
///     The columns of ``curves.csv``: separations first, then pressures.
///
/// Raises
/// ------
/// ValueError
///     A value out of range, or a pressure that is not reached.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
/// >>> contact = asperity.Interface(steel, steel)
/// >>> asperities = asperity.draw(10_000, radius=20e-6, sigma=48e-9, density=6e10)
/// >>> curve = asperity.deterministic(contact, asperities, separations=[2.0, 1.0])
/// >>> curve["effective_contacts"] > 30
/// array([ True,  True])
#[pyfunction]
#[pyo3(signature = (interface, asperities, *, separations=None, pressures=None, sigma=None))]
pub fn deterministic(
    py: Python,
    interface: &Interface,
    asperities: &Bound<PyAny>,
    separations: Option<&Bound<PyAny>>,
    pressures: Option<&Bound<PyAny>>,
    sigma: Option<&Bound<PyAny>>,
) -> PyResult<Table> {
    /// More evaluations may take longer than a user waits without Ctrl-C.
    const SHORT: usize = 1_000_000;
    let asperities = asperities.cast::<Asperities>().map_err(|_| {
        wrong_type("asperities", asperities, "Asperities, such as topography.find_summits() of a Topography")
    })?;
    let sigma = si_or_none::<Length, SigmaRange>(sigma, "sigma")?;
    if let Some(sigma) = sigma.filter(|sigma| !(*sigma > 0.0 && sigma.is_finite())) {
        return Err(refuse(format!("sigma: found {sigma}; allowed: positive and finite, m")));
    }
    let controls = controls(separations, pressures)?;
    let points = controls.points();
    let sum = Sum {
        contact: Arc::clone(&interface.contact),
        is_elliptic: interface.law.0.is_elliptic(),
        sigma,
        controls,
    };
    let own = asperities.get();
    let found = if own.heights.values().len().saturating_mul(points) <= SHORT {
        guarded(py, || sum.compared(own))?
    } else {
        let kept = asperities.clone().unbind();
        interruptible(py, move |_| sum.compared(kept.get()))?
    };
    let comparison = found.map_err(refuse)?;
    Ok(Table::of_curves(py, rows(interface, Ok(comparison))?))
}
