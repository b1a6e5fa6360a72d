//! Asperities as arrays, and the population of the integral.

use std::sync::Arc;

use asperity::{AsperityList, AsperitySet, MeanRadius, SetError, Statistics};
use asperity_contact_framework::input::InMemory;
use asperity_contact_framework::input::bare::{NominalAreaRange, SigmaRange};
use asperity_contact_framework::input::heights::HeightsSpec;
use asperity_contact_framework::input::quantity::{Area, ArealNumberDensity, Length, Positive};
use asperity_experiment::surface::rows::statistics_columns;
use numpy::PyArrayDyn;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::array::Array;
use crate::quantity::si;
use crate::refuse;
use crate::spec::toml_of;

/// Asperities on a nominal area: what the sum runs over.
///
/// Contiguous float64 arrays are not copied; they are checked again whenever they are used.
///
/// Parameters
/// ----------
/// heights : array_like, shape (n,)
///     Heights in m.
/// radii : array_like, shape (n,)
///     1/(mean curvature) in m.
/// nominal_area : float or str
///     The area that they are from in m^2, or with its unit.
/// curvatures : array_like, shape (2, n), optional
///     Principal curvatures kx and ky in 1/m, for laws for ellipses.
/// places : array_like, shape (2, n), optional
///     Their places x and y in m, which divide them into blocks for intervals.
/// independent : bool
///     Whether they are independent draws, whose scatter gives intervals. Neighbouring asperities of a surface are not.
///
/// Raises
/// ------
/// ValueError
///     The first invalid value.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> asperity.Asperities([0.0, 5e-8], [2e-5, 1e-5], nominal_area=1e-9)
/// <Asperities: 2 on 1e-9 m^2>
#[pyclass(module = "asperity", frozen)]
pub struct Asperities {
    pub heights: Array,
    pub radii: Array,
    pub curvatures: Option<Array>,
    pub places: Option<Array>,
    /// Whether they are independent draws.
    #[pyo3(get)]
    pub independent: bool,
    /// The area that they are from in m^2.
    #[pyo3(get)]
    pub nominal_area: f64,
}

impl Asperities {
    /// The asperities where they lie.
    pub fn spheres(&self) -> Result<asperity::Asperities<'_>, SetError> {
        asperity::Asperities::of_spheres(self.heights.values(), self.radii.values(), self.nominal_area)
    }

    fn list(&self) -> AsperityList {
        let both = |array: &Array| {
            let (first, second) = array.values().split_at(self.heights.values().len());
            [first.to_vec(), second.to_vec()]
        };
        let curvatures = self.curvatures.as_ref().map(both);
        let list =
            AsperityList::new(self.heights.values().to_vec(), self.radii.values().to_vec(), curvatures);
        match &self.places {
            Some(places) => list.at_places(both(places)),
            None => list,
        }
    }

    /// A copy in the frame of its lowest height where all are far from zero; with ellipses where they are known.
    pub fn set(&self) -> Result<AsperitySet, SetError> {
        Ok(self.list().set(self.nominal_area)?.near_zero().0)
    }

    /// As a surface of a spec.
    pub fn in_memory(&self) -> InMemory {
        InMemory::List(Arc::new(self.list()))
    }
}

#[pymethods]
impl Asperities {
    #[new]
    #[pyo3(signature = (heights, radii, nominal_area, *, curvatures=None, places=None, independent=false))]
    fn new(
        heights: &Bound<PyAny>,
        radii: &Bound<PyAny>,
        nominal_area: &Bound<PyAny>,
        curvatures: Option<&Bound<PyAny>>,
        places: Option<&Bound<PyAny>>,
        independent: bool,
    ) -> PyResult<Self> {
        let (heights, radii) = (Array::new(heights, 1, "heights")?, Array::new(radii, 1, "radii")?);
        let nominal_area = si::<Area, NominalAreaRange>(nominal_area, "nominal_area")?;
        let both = |given: Option<&Bound<PyAny>>, name: &str, columns: &str| {
            let Some(given) = given else { return Ok(None) };
            let (array, count) = (Array::new(given, 2, name)?, heights.values().len());
            let found = array.shape();
            if found != [2, count] {
                let message = format!("{name}: found the shape {found:?}; allowed: [2, {count}], {columns}");
                return Err(refuse(message));
            }
            Ok(Some(array))
        };
        let curvatures = both(curvatures, "curvatures", "kx and ky")?;
        let places = both(places, "places", "x and y")?;
        if places.as_ref().is_some_and(|places| places.values().iter().any(|place| !place.is_finite())) {
            return Err(refuse("places: found one that is not finite; allowed: finite numbers, m"));
        }
        let made = Self { heights, radii, curvatures, places, independent, nominal_area };
        made.spheres().map_err(refuse)?;
        if made.curvatures.is_some() {
            made.set().map_err(refuse)?;
        }
        Ok(made)
    }

    /// Heights in m, shape (n,).
    #[getter]
    fn heights(&self, py: Python) -> Py<PyArrayDyn<f64>> {
        self.heights.object(py)
    }

    /// 1/(mean curvature) in m, shape (n,).
    #[getter]
    fn radii(&self, py: Python) -> Py<PyArrayDyn<f64>> {
        self.radii.object(py)
    }

    /// Principal curvatures in 1/m, shape (2, n), or None.
    #[getter]
    fn curvatures(&self, py: Python) -> Option<Py<PyArrayDyn<f64>>> {
        self.curvatures.as_ref().map(|both| both.object(py))
    }

    /// Places x and y in m, shape (2, n), or None.
    #[getter]
    fn places(&self, py: Python) -> Option<Py<PyArrayDyn<f64>>> {
        self.places.as_ref().map(|both| both.object(py))
    }

    /// Asperities per nominal area in 1/m^2.
    #[getter]
    fn density(&self) -> f64 {
        self.heights.values().len() as f64 / self.nominal_area
    }

    fn __len__(&self) -> usize {
        self.heights.values().len()
    }

    /// Mean values and moments, with divisor n and the names of ``summary.json``.
    ///
    /// Returns
    /// -------
    /// dict of str to float or None
    ///     ``mean_height_m``, ``sigma_m``, ``skewness``, ``kurtosis`` (3 if Gaussian), ``mean_radius_m``,
    ///     ``radius_of_mean_curvature_m``, ``radius_cv`` and ``height_radius_correlation``; None where it is undefined.
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = py.detach(|| self.set().map(|set| Statistics::new(&set))).map_err(refuse)?;
        let mean_height = asperity::ReferencePlane::from(self.spheres().map_err(refuse)?).mean;
        let statistics = Statistics { mean_height, ..found };
        let dict = PyDict::new(py);
        for column in statistics_columns(|statistics: &Statistics| statistics) {
            dict.set_item(&column.heading.name, column.value(&statistics).number())?;
        }
        Ok(dict)
    }

    /// The Gaussian population of the same sigma and density, and of the mean radius: what the integral takes for them.
    ///
    /// Parameters
    /// ----------
    /// mean_radius : {"arithmetic", "inverse-mean-curvature"}
    ///     The mean of the radii, or 1/(mean curvature).
    #[pyo3(signature = (*, mean_radius="arithmetic"))]
    fn population(&self, py: Python, mean_radius: &str) -> PyResult<Population> {
        let named = [
            ("arithmetic", MeanRadius::Arithmetic),
            ("inverse-mean-curvature", MeanRadius::InverseMeanCurvature),
        ];
        let Some((_, mean)) = named.into_iter().find(|(name, _)| *name == mean_radius) else {
            let names = named.map(|(name, _)| format!("\"{name}\"")).join(", ");
            return Err(refuse(format!("mean_radius: found \"{mean_radius}\"; allowed: {names}")));
        };
        let statistics = py.detach(|| self.set().map(|set| Statistics::new(&set))).map_err(refuse)?;
        let radius = match mean {
            MeanRadius::InverseMeanCurvature => statistics.radius_of_mean_curvature,
            MeanRadius::Arithmetic | MeanRadius::InContact => statistics.mean_radius,
        };
        Population::checked(radius, statistics.sigma, self.density(), asperity::Heights::GAUSSIAN)
    }

    fn __repr__(&self) -> String {
        format!("<Asperities: {} on {:e} m^2>", self.__len__(), self.nominal_area)
    }
}

/// Asperities of one radius whose heights follow a distribution: what the integral runs over.
///
/// Parameters
/// ----------
/// radius : float or str
///     1/(mean curvature) of every asperity in m, or with its unit, as the others.
/// sigma : float or str
///     Standard deviation of the asperity heights in m.
/// density : float or str
///     Asperities per nominal area in 1/m^2.
/// heights : str or dict, optional
///     Their distribution, as in a spec: ``"gaussian"``, ``{"weibull": {"shape": 2}}``,
///     ``{"johnson": {"skewness": -1, "kurtosis": 4.5}}``.
///
/// Raises
/// ------
/// ValueError
///     A value that is not positive, or an unknown distribution.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> asperity.Population(20e-6, 48e-9, 6e10)
/// Population(radius=2e-5, sigma=4.8e-8, density=6e10, heights="gaussian")
#[pyclass(module = "asperity", frozen)]
pub struct Population(pub asperity::Population);

impl Population {
    fn checked(radius: f64, sigma: f64, density: f64, heights: asperity::Heights) -> PyResult<Self> {
        for (name, unit, value) in
            [("radius", "m", radius), ("sigma", "m", sigma), ("density", "1/m^2", density)]
        {
            if !(value > 0.0 && value.is_finite()) {
                return Err(refuse(format!("{name}: found {value}; allowed: positive and finite, {unit}")));
            }
        }
        Ok(Self(asperity::Population { radius, sigma, density, heights }))
    }
}

#[pymethods]
impl Population {
    #[new]
    #[pyo3(signature = (radius, sigma, density, heights=None))]
    fn new(
        radius: &Bound<PyAny>,
        sigma: &Bound<PyAny>,
        density: &Bound<PyAny>,
        heights: Option<&Bound<PyAny>>,
    ) -> PyResult<Self> {
        let radius = si::<Length, Positive>(radius, "radius")?;
        let sigma = si::<Length, SigmaRange>(sigma, "sigma")?;
        let density = si::<ArealNumberDensity, Positive>(density, "density")?;
        let heights = match heights {
            None => asperity::Heights::GAUSSIAN,
            Some(given) => {
                let read: Result<HeightsSpec, _> = toml_of(given, "heights")?.try_into();
                read.map_err(|error| refuse(format!("heights: {}", error.message())))?.0
            }
        };
        Self::checked(radius, sigma, density, heights)
    }

    /// Radius in m.
    #[getter]
    fn radius(&self) -> f64 {
        self.0.radius
    }

    /// Standard deviation of the heights in m.
    #[getter]
    fn sigma(&self) -> f64 {
        self.0.sigma
    }

    /// Asperities per nominal area in 1/m^2.
    #[getter]
    fn density(&self) -> f64 {
        self.0.density
    }

    /// Their distribution, as it is given.
    #[getter]
    fn heights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (name, parameters) = (self.0.heights.name(), self.0.heights.parameters());
        if parameters.is_empty() {
            return name.into_bound_py_any(py);
        }
        Ok([(name, parameters.into_iter().into_py_dict(py)?)].into_py_dict(py)?.into_any())
    }

    fn __repr__(&self) -> String {
        let asperity::Population { radius, sigma, density, heights } = &self.0;
        format!(
            "Population(radius={radius:e}, sigma={sigma:e}, density={density:e}, heights=\"{}\")",
            heights.name()
        )
    }
}
